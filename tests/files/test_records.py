"""TOML files that users edit: what is wrong is named by file, line, key, value and limit."""

import os
import re
import tomllib
from pathlib import Path
from typing import Annotated

import pytest
from pydantic import Field

from jumpcad.errors import JumpcadError
from jumpcad.files import (
    Record,
    TomlTable,
    did_you_mean,
    find_template,
    read_json,
    read_toml,
    template_names,
    templates_folder,
    to_toml,
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


def test_file_that_is_not_text(tmp_path: Path) -> None:
    file = tmp_path / "p.toml"
    file.write_bytes(b"name = '\xff\xfe'")
    with pytest.raises(JumpcadError, match="not a text file in UTF-8"):
        read_toml(file)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("none.toml", "no such file"),
        (".", "is a folder"),
        ("file.toml/inside.toml", "Not a directory"),
        ("x" * 300 + ".toml", "too long"),
    ],
    ids=["missing", "folder", "file as folder", "too long a name"],
)
def test_files_that_cannot_be_read(tmp_path: Path, name: str, reason: str) -> None:
    (tmp_path / "file.toml").write_text("")
    with pytest.raises(JumpcadError, match=reason):
        read_toml(tmp_path / name)


def test_python_callers_get_the_same_words_without_a_file() -> None:
    with pytest.raises(JumpcadError, match=r"^nozzle_mm = 0\.01: must be at least 0\.1$"):
        Printer(name="x", nozzle_mm=0.01, bed=Bed(width_mm=1.0))


def test_templates_are_found_by_name_and_files_by_path(tmp_path: Path) -> None:
    assert {"best-bo", "best-ga", "kenan-1.0", "kenan-2.0"} <= set(template_names("robots"))
    assert find_template("robots", "kenan-2.0") == templates_folder() / "robots/kenan-2.0.toml"
    assert find_template("robots", tmp_path / "mine.toml") == tmp_path / "mine.toml"
    for wrong in ("kenan-3.0", "x" * 300):
        with pytest.raises(JumpcadError, match="neither a TOML file nor one of the robots best-bo"):
            find_template("robots", wrong)


def test_a_bare_name_is_the_template_whatever_lies_in_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("kenan-2.0", "mine"):
        (tmp_path / name).write_text("")
    assert find_template("robots", "kenan-2.0") == templates_folder() / "robots/kenan-2.0.toml"
    assert find_template("robots", "./kenan-2.0") == Path("kenan-2.0")
    assert find_template("robots", "mine") == Path("mine")


def test_hint_only_where_something_is_near() -> None:
    assert did_you_mean("kenan2", ["kenan-2.0", "best-bo"]) == " (did you mean kenan-2.0?)"
    assert did_you_mean("zzz", ["kenan-2.0", "best-bo"]) == ""


def test_toml_reads_back() -> None:
    data = {"a": 0.1 + 0.2, "b": {"c": [1, 2], "d": 'quote " and\nline'}}
    assert tomllib.loads(to_toml(data)) == data


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


def test_pipes_and_devices_are_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.toml")
    (tmp_path / "zero.toml").symlink_to("/dev/zero")
    for name in ("pipe.toml", "zero.toml"):
        with pytest.raises(JumpcadError, match="is a pipe or a device, not a TOML file"):
            read_toml(tmp_path / name)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('{"a": NaN}', "NaN is no number"),
        ("[-Infinity]", "-Infinity is no number"),
        ("[" * 5000 + "]" * 5000, "nested deeper"),
        ("[" * 21 + "]" * 21, "nested deeper"),
        ("9" * 6000, "not valid JSON"),
        ("{", "not valid JSON"),
    ],
)
def test_json_that_is_none(tmp_path: Path, text: str, reason: str) -> None:
    (tmp_path / "a.json").write_text(text)
    with pytest.raises(JumpcadError, match=reason):
        read_json(tmp_path / "a.json")


def test_a_record_that_was_changed_behind_its_back_is_found_out() -> None:
    printer = Printer(name="x", bed=Bed(width_mm=1.0))
    assert printer.revalidated() == printer
    wrong = printer.model_copy(update={"bed": Bed.model_construct(width_mm=-1.0)})
    with pytest.raises(JumpcadError, match=r"^bed\.width_mm = -1\.0: must be more than 0$"):
        wrong.revalidated()
