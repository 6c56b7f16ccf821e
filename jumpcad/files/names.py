"""Names and free text from users and their files: the characters that they may have."""

import re
import unicodedata
from typing import Annotated, Any

from pydantic import AfterValidator
from pydantic_core import PydanticCustomError

from jumpcad.errors import CONTROL_CATEGORIES

NAME = re.compile(r"\w[\w .,()+-]{0,49}")
"""Pattern of a name: no formula, no hidden file, no path separator, no markup."""
NAME_RULE = "a name has 1 to 50 letters, digits, spaces and . , + - _ ( ), and begins with a letter, a digit or _"
LONGEST_TEXT = 1000


def control_character(text: str) -> str:
    """Return the first character that can control a terminal or break a line, as `U+0007`, or nothing."""
    if text.isprintable():  # quick for nearly every text
        return ""
    return next((f"U+{ord(letter):04X}" for letter in text if unicodedata.category(letter) in CONTROL_CATEGORIES), "")


def composed(data: Any) -> Any:
    """Return texts, also in nested lists and tables, in Unicode's composed form (NFC).

    Some systems write ä as a and a combining diaeresis; both are the same name.
    """
    if isinstance(data, str):
        return unicodedata.normalize("NFC", data)
    if isinstance(data, dict):
        return {composed(key): composed(value) for key, value in data.items()}
    return [composed(one) for one in data] if isinstance(data, list) else data


def _name(value: str) -> str:
    value = composed(value)
    if not NAME.fullmatch(value):
        raise PydanticCustomError("value_error", NAME_RULE)
    return value


def _text(value: str) -> str:
    if found := control_character(value):
        raise PydanticCustomError("value_error", f"contains the control character {found}: leave it out")
    if len(value) > LONGEST_TEXT:
        raise PydanticCustomError("value_error", f"has {len(value)} characters, more than {LONGEST_TEXT}: shorten it")
    return value


Name = Annotated[str, AfterValidator(_name)]
"""A name that may become part of a file's name."""
OptionalName = Annotated[str, AfterValidator(lambda value: value and _name(value))]
"""A name, or empty."""
Text = Annotated[str, AfterValidator(_text)]
"""A line of free text."""
