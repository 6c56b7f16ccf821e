"""What is wrong with a value is named by file, line, key, value and limit."""

import os
import re
from pathlib import Path

import pytest
from support.tables import Printer

from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import place
from jumpcad.workshop import load_workshop


def complaint(tmp_path: Path, text: str) -> str:
    """The error of a file without the folder."""
    file = tmp_path / "p.toml"
    file.write_text(text)
    with pytest.raises(JumpcadError) as caught:
        Printer.from_toml(file)
    assert "\n" not in str(caught.value)
    return str(caught.value).replace(f"{tmp_path}{os.sep}", "")


@pytest.mark.parametrize(
    ("key", "said"), [("a", "own.toml:1"), ("b.c", "own.toml:4"), ("b.d", "own.toml"), ("", "own.toml")]
)
def test_the_place_of_a_key_is_its_line_or_the_file_alone(key: str, said: str) -> None:
    assert place("own.toml", "a = 1\n\n[b]\nc = 2\n", key) == said


def test_value_out_of_range_is_named_with_its_line(tmp_path: Path) -> None:
    text = 'name = "MK4"\n# a comment\nnozzle_mm = 3.5\n[bed]\nwidth_mm = 250\n'
    assert complaint(tmp_path, text) == "p.toml:3: nozzle_mm = 3.5: must be less than 2"


def test_nested_value_is_named_with_its_section_and_line(tmp_path: Path) -> None:
    text = 'name = "MK4"\n\n[bed]\nwidth_mm = 9000\n'
    assert complaint(tmp_path, text) == "p.toml:4: bed.width_mm = 9000: must be at most 400"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("nozzle_mm = 0x" + "f" * 6000, "p.toml:1: nozzle_mm = a value too long to show"),
        ("self = 1", "p.toml:1: self: unknown key"),
        ('"a\\nb\\u001b" = 1', r"'a\\nb\\x1b': unknown key"),
        ("bed = 3", r"p.toml:1: bed = 3: must be a table: \[bed\] with width_mm"),
    ],
    ids=["hexadecimal", "self", "control", "table"],
)
def test_any_key_and_value_is_one_short_line(tmp_path: Path, text: str, reason: str) -> None:
    told = complaint(tmp_path, text)
    assert re.search(reason, told), told
    assert told.isprintable()
    assert len(told) < 500


def test_of_twenty_thousand_unknown_keys_ten_are_named(tmp_path: Path) -> None:
    told = complaint(tmp_path, 'name = "x"\n' + "".join(f"k{number} = 1\n" for number in range(20_000)))
    assert told.count("unknown key") + told.count("missing") == 10
    assert told.endswith("and 19991 more")  # the missing bed is one of them


def test_a_missing_key_is_told_with_the_line_of_its_table(tmp_path: Path) -> None:
    """Also of a table in a table."""
    file = tmp_path / "w.toml"
    file.write_text('[batteries]\n\n[batteries.own]\nsource = "mine"\ndescription = "cell"\n')
    with pytest.raises(JumpcadError) as caught:
        load_workshop(file)
    told = str(caught.value).split("; ")
    assert f"{file}:3: batteries.own.mass_g: missing: weigh it, or take the maker's figure" in told
    assert all(one.startswith((f"{file}:3: batteries.own.", "and ")) for one in told)


@pytest.mark.parametrize(
    ("table", "key", "hint"),
    [
        ("materials.PLA", "density_gcm3", " (did you mean density_g_cm3?)"),
        ("batteries.own", "naem", ""),  # a part's name is that of its table
        ("batteries.own", "mas_g", " (did you mean mass_g?)"),
    ],
)
def test_a_key_misspelt_in_a_table_of_ones_own_is_recognised(tmp_path: Path, table: str, key: str, hint: str) -> None:
    (tmp_path / "w.toml").write_text(f"[{table}]\n{key} = 1.2\n")
    with pytest.raises(JumpcadError) as caught:
        load_workshop(tmp_path / "w.toml")
    assert f"w.toml:2: {table}.{key}: unknown key{hint}" in str(caught.value).split("/")[-1].split("; ")
