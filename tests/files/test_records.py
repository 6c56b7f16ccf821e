"""TOML files that users edit: what is wrong is named by file, line, key, value and limit."""

import os
import re
from pathlib import Path
from typing import Annotated

import pytest
from pydantic import Field

from jumpcad.errors import JumpcadError
from jumpcad.files import (
    Record,
    TomlTable,
)


class Bed(TomlTable):
    """A nested section."""

    width_mm: Annotated[float, Field(gt=0, le=400)]


class Printer(Record):
    """A small file."""

    name: str
    nozzle_mm: Annotated[float, Field(ge=0.1, lt=2)] = 0.4
    bed: Bed


def complaint(tmp_path: Path, text: str) -> str:
    """The error of a file without the folder."""
    file = tmp_path / "p.toml"
    file.write_text(text)
    with pytest.raises(JumpcadError) as caught:
        Printer.from_toml(file)
    assert "\n" not in str(caught.value)
    return str(caught.value).replace(f"{tmp_path}{os.sep}", "")


def test_good_file(tmp_path: Path) -> None:
    file = tmp_path / "p.toml"
    file.write_text('name = "MK4"\n[bed]\nwidth_mm = 250\n')
    assert Printer.from_toml(file) == Printer(name="MK4", bed=Bed(width_mm=250.0))


def test_value_out_of_range_is_named_with_its_line(tmp_path: Path) -> None:
    text = 'name = "MK4"\n# a comment\nnozzle_mm = 3.5\n[bed]\nwidth_mm = 250\n'
    assert complaint(tmp_path, text) == "p.toml:3: nozzle_mm = 3.5: must be less than 2"


def test_nested_value_is_named_with_its_section_and_line(tmp_path: Path) -> None:
    text = 'name = "MK4"\n\n[bed]\nwidth_mm = 9000\n'
    assert complaint(tmp_path, text) == "p.toml:4: bed.width_mm = 9000: must be at most 400"


def test_misspelt_key_is_recognised(tmp_path: Path) -> None:
    text = 'name = "MK4"\nnozle_mm = 0.4\n[bed]\nwidth_mm = 250\nwidht_mm = 2\n'
    assert complaint(tmp_path, text) == (
        "p.toml:5: bed.widht_mm: unknown key (did you mean width_mm?); "
        "p.toml:2: nozle_mm: unknown key (did you mean nozzle_mm?)"
    )


def test_all_bad_keys_at_once(tmp_path: Path) -> None:
    text = "name = 3\nnozzle_mm = nan\n"
    assert complaint(tmp_path, text) == (
        "p.toml:1: name = 3: must be a valid string; p.toml:2: nozzle_mm = nan: must be a finite number; "
        "p.toml: bed: missing"
    )


def test_long_values_are_shortened(tmp_path: Path) -> None:
    assert len(complaint(tmp_path, f'name = "MK4"\nnozzle_mm = "{"x" * 5000}"\n')) < 200


def test_broken_toml_is_named_with_its_place(tmp_path: Path) -> None:
    assert complaint(tmp_path, 'name = "MK4"\nnozzle_mm = \n').startswith(
        "p.toml: not valid TOML: Invalid value (at line 2"
    )


def test_python_callers_get_the_same_words_without_a_file() -> None:
    with pytest.raises(JumpcadError, match=r"^nozzle_mm = 0\.01: must be at least 0\.1$"):
        Printer(name="x", nozzle_mm=0.01, bed=Bed(width_mm=1.0))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("a = " + "[" * 5000 + "]" * 5000, "nested deeper than 20 levels"),
        ("a = " + "{a = " * 5000 + "1" + "}" * 5000, "nested deeper than 20 levels"),
        (".".join("a" * 60) + " = 1", "nested deeper than 20 levels"),
        ("[" + ".".join("a" * 20_000) + "]", "line 1 has more than 200 dots"),
        ("a = " + "1" * 6000, "an integer of more digits than can be read"),
        ("nozzle_mm = 0x" + "f" * 6000, "p.toml:1: nozzle_mm = a value too long to show"),
        ("# " + "x" * (1 << 20), "is larger than 1 MiB"),
        ("self = 1", "p.toml:1: self: unknown key"),
        ('"a\\nb\\u001b" = 1', r"'a\\nb\\x1b': unknown key"),
        ("bed = 3", r"p.toml:1: bed = 3: must be a table: \[bed\] with width_mm"),
        ("[" + " " * 200_000, "not valid TOML"),
    ],
    ids=["lists", "tables", "keys", "long key", "digits", "hexadecimal", "size", "self", "control", "table", "blanks"],
)
def test_nonsense_from_strangers_is_one_short_line(tmp_path: Path, text: str, reason: str) -> None:
    told = complaint(tmp_path, text)
    assert re.search(reason, told), told
    assert told.isprintable()
    assert len(told) < 500


def test_of_twenty_thousand_unknown_keys_ten_are_named(tmp_path: Path) -> None:
    told = complaint(tmp_path, 'name = "x"\n' + "".join(f"k{number} = 1\n" for number in range(20_000)))
    assert told.count("unknown key") + told.count("missing") == 10
    assert told.endswith("and 19991 more")  # the missing bed is one of them


def test_a_record_that_was_changed_behind_its_back_is_found_out() -> None:
    printer = Printer(name="x", bed=Bed(width_mm=1.0))
    assert printer.revalidated() == printer
    wrong = printer.model_copy(update={"bed": Bed.model_construct(width_mm=-1.0)})
    with pytest.raises(JumpcadError, match=r"^bed\.width_mm = -1\.0: must be more than 0$"):
        wrong.revalidated()
