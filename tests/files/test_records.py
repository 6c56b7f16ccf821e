"""Records are read from TOML files, made in Python and checked again, by the same rules."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from pydantic import TypeAdapter, ValidationError
from support.each import each
from support.tables import Bed, Printer

from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files.records import (
    NAME_RULE,
    Contradiction,
    Name,
    OptionalName,
    Record,
    Text,
    composed,
    control_character,
)


def test_good_file(tmp_path: Path) -> None:
    file = tmp_path / "p.toml"
    file.write_text('name = "MK4"\n[bed]\nwidth_mm = 250\n')
    assert Printer.from_toml(file) == Printer(name="MK4", bed=Bed(width_mm=250.0))


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_number_is_finite(value: float) -> None:
    with pytest.raises(JumpcadError, match="must be a finite number"):
        Printer(name="x", nozzle_mm=value, bed=Bed(width_mm=1.0))


def test_a_record_that_was_changed_behind_its_back_is_found_out() -> None:
    printer = Printer(name="x", bed=Bed(width_mm=1.0))
    assert printer.revalidated() == printer
    wrong = printer.model_copy(update={"bed": Bed.model_construct(width_mm=-1.0)})
    with pytest.raises(JumpcadError, match=r"^bed\.width_mm = -1\.0: must be more than 0$"):
        wrong.revalidated()


class Span(Record):
    """Two ends, in order."""

    low_mm: float = 0.0
    high_mm: float = 1.0

    def contradictions(self) -> Iterator[Contradiction]:
        if self.high_mm < self.low_mm:
            yield ("high_mm",), self.high_mm, f"must be at least low_mm = {self.low_mm:g}"
        if self.low_mm < 0.0 < self.high_mm:
            yield ("low_mm",), self.low_mm, "must be on one {side}"


def test_values_that_contradict_each_other_are_all_named(tmp_path: Path) -> None:
    """One alone too, in Python as in a file, where it is named with its line."""
    assert Span(low_mm=1.0, high_mm=2.0).high_mm == 2.0
    with pytest.raises(JumpcadError, match=r"^high_mm = 1\.0: must be at least low_mm = 3$"):
        Span(low_mm=3.0)
    with pytest.raises(JumpcadError, match=r"^low_mm = -1\.0: must be on one \{side\}$"):
        Span(low_mm=-1.0)
    (tmp_path / "s.toml").write_text("low_mm = 3.0\nhigh_mm = 2.0\n")
    where = re.escape(f"{tmp_path / 's.toml'}:2")
    with pytest.raises(JumpcadError, match=rf"^{where}: high_mm = 2\.0: must be at least low_mm = 3$"):
        Span.from_toml(tmp_path / "s.toml")


def refused(kind: object, value: str) -> str:
    """Return the reason for which a value is refused."""
    with pytest.raises(ValidationError) as caught:
        TypeAdapter(kind).validate_python(value)
    return str(caught.value.errors()[0]["msg"])


@pytest.mark.parametrize("name", ["PLA", "PETG (grey)", "机器人", "Ähnlich-1.75", "_x", "a" * 50])
def test_a_name_is_of_any_script(name: str) -> None:
    assert TypeAdapter(Name).validate_python(name) == name


@each("name", ["", " a", ".hidden", "../up", "a/b", "a\\b", "=1", "+1", "-1", "@x", "a\nb", "a" * 51])
def test_a_name_begins_no_formula_and_leads_nowhere(name: str) -> None:
    assert refused(Name, name) == NAME_RULE


def test_an_optional_name_may_be_empty() -> None:
    assert TypeAdapter(OptionalName).validate_python("") == ""
    assert refused(OptionalName, "a/b") == NAME_RULE


def test_the_same_letters_are_one_name_wherever_they_stand_in_a_file() -> None:
    """U+00FC and u with U+0308 are the same letter (Unicode, ch. 3.7): as a table's key, its value, in a list."""
    one, other = "gr\u00fcn", "gru\u0308n"
    assert composed({other: {"colours": [other, 1.0]}, "role": other}) == {one: {"colours": [one, 1.0]}, "role": one}


def test_free_text_is_one_line_of_moderate_length() -> None:
    assert TypeAdapter(Text).validate_python("ISO 15: 3 × 10 × 4 mm, 机器人") == "ISO 15: 3 × 10 × 4 mm, 机器人"
    assert refused(Text, "a\x07") == "contains the control character U+0007: leave it out"
    assert TypeAdapter(Text).validate_python("a" * 1000) == "a" * 1000
    assert refused(Text, "a" * 1001) == "has 1001 characters, more than 1000: shorten it"


@pytest.mark.parametrize(
    ("letter", "code"),
    [("\x1b", "U+001B"), ("\n", "U+000A"), ("\u2028", "U+2028"), ("\u202e", "U+202E"), ("\ud800", "U+D800")],
    ids=["escape", "end of line", "line separator", "right to left", "half of a character"],
)
def test_control_characters_are_found_and_shown_as_escapes(letter: str, code: str) -> None:
    assert control_character(f"a{letter}b") == code
    shown = without_controls(f"a{letter}b")
    assert shown.isprintable()
    assert shown.encode().decode("unicode_escape") == f"a{letter}b"
    assert (control_character("Käfer µ"), without_controls("Käfer µ")) == ("", "Käfer µ")
