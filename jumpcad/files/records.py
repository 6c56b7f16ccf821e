"""Validated values that users give by keyword, in Python or in a TOML file; their names and free text."""

import re
import unicodedata
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError

from jumpcad.errors import CONTROL_CATEGORIES, JumpcadError
from jumpcad.files.complaints import Origin, complaints, described
from jumpcad.files.reading import read_toml

Contradiction = tuple[tuple[str, ...], Any, str]
"""The keys down to a value, the value, and what is wrong with it."""
NAME = re.compile(r"\w[\w .,()+-]{0,49}")
"""Pattern of a name: no formula, no hidden file, no path separator, no markup."""
NAME_RULE = "a name has 1 to 50 letters, digits, spaces and . , + - _ ( ), and begins with a letter, a digit or _"
LONGEST_TEXT = 1000


class TomlTable(BaseModel):
    """A validated group of values: no unknown keys, no NaN, no conversion of types, immutable."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True, strict=True)

    def __setattr__(self, name: str, _: Any) -> None:
        raise JumpcadError(
            f"{type(self).__name__}.{name} cannot be changed: make a copy that differs, "
            f"copy = old.model_copy(update={{{name!r}: …}})"
        )


class Record(TomlTable):
    """A `TomlTable` that users give by keyword, in Python or in a TOML file; errors are `JumpcadError`."""

    def __init__(self, /, *unnamed: Any, **values: Any) -> None:
        if unnamed:
            first = next(iter(type(self).model_fields))
            raise JumpcadError(
                f"{type(self).__name__} takes its values by name, {type(self).__name__}({first}=…), "
                f"not {described(unnamed[0])}"
            )
        try:
            super().__init__(**values)
            if wrong := list(self.contradictions()):
                told = [InitErrorDetails(type=PydanticCustomError("value_error", reason), loc=location, input=value)
                        for location, value, reason in wrong]  # fmt: skip
                raise ValidationError.from_exception_data(type(self).__name__, told)
        except ValidationError as error:
            raise JumpcadError("; ".join(complaints(error, type(self)))) from error

    def contradictions(self) -> Iterable[Contradiction]:
        """Return values that are each allowed, but not together."""
        return ()

    def revalidated(self) -> Self:
        """Return the same record, validated again: pydantic does not validate changed copies and dictionaries."""
        return type(self)(**self.model_dump(warnings=False))

    @classmethod
    def from_toml(cls, path: Path) -> Self:
        data, text = read_toml(path)
        return cls.from_data(data, source=str(path), text=text)

    @classmethod
    def from_data(cls, data: dict[str, Any], source: str, text: str = "", origins: Sequence[Origin] = ()) -> Self:
        """Validate data parsed from the file `source`; see `complaints` for `text` and `origins`."""
        try:
            return cls(**data)
        except JumpcadError as error:
            if isinstance(error.__cause__, ValidationError):
                raise JumpcadError("; ".join(complaints(error.__cause__, cls, source, text, origins))) from None
            raise


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
