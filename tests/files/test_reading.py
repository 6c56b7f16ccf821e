"""Files that cannot be read, or are not TOML or JSON, are rejected in one line."""

import csv
import io
import os
import sys
import tomllib
from pathlib import Path

import pytest
from support.each import each

from jumpcad.errors import JumpcadError
from jumpcad.files import read_json, read_toml, reading, to_toml
from jumpcad.files.reading import BOM, to_csv


def test_file_that_is_not_text(tmp_path: Path) -> None:
    file = tmp_path / "p.toml"
    file.write_bytes(b"name = '\xff\xfe'")
    with pytest.raises(JumpcadError, match="not a text file in UTF-8"):
        read_toml(file)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("none.toml", "no such file"),
        (".", "is a folder, not a TOML file"),
        ("a\0b.toml", "cannot be the name of a file$"),
        ("file.toml/inside.toml", "Not a directory"),
        ("x" * 300 + ".toml", "too long"),
    ],
    ids=["missing", "folder", "zero", "file as folder", "too long a name"],
)
def test_files_that_cannot_be_read(tmp_path: Path, name: str, reason: str) -> None:
    (tmp_path / "file.toml").write_text("")
    with pytest.raises(JumpcadError, match=reason):
        read_toml(tmp_path / name)


def test_toml_reads_back() -> None:
    data = {"a": 0.1 + 0.2, "b": {"c": [1, 2], "d": 'quote " and\nline'}}
    assert tomllib.loads(to_toml(data)) == data


def test_a_list_of_many_decimals_is_read(tmp_path: Path) -> None:
    numbers = [n / 8 for n in range(1, 2400, 8)]
    (tmp_path / "p.toml").write_text(f"a = {numbers}\n")
    assert read_toml(tmp_path / "p.toml")[0] == {"a": numbers}


def test_pipes_and_devices_are_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.toml")
    (tmp_path / "zero.toml").symlink_to("/dev/zero")
    for name in ("pipe.toml", "zero.toml"):
        with pytest.raises(JumpcadError, match="is a pipe or a device, not a TOML file"):
            read_toml(tmp_path / name)


@pytest.mark.skipif(sys.platform != "linux", reason="these files are Linux's")
@each("made", ["/proc/kmsg", "/proc/kallsyms", "/proc/self/environ", "/sys/kernel/profiling"])
def test_what_the_system_makes_as_it_is_read_is_no_file(
    tmp_path: Path, made: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first waits for messages of the kernel, the second has more bytes than are read, the others have no size."""
    (tmp_path / "p.toml").unlink(missing_ok=True)
    (tmp_path / "p.toml").symlink_to(made)
    with monkeypatch.context() as patch:
        if made.startswith("/proc"):  # nor opened
            patch.setattr(reading, "_open_at_once", lambda *_: pytest.fail(made))
        with pytest.raises(JumpcadError, match=r"made by the system|larger than 1 MiB|no such file|may not be read"):
            read_toml(tmp_path / "p.toml")


@each(
    ("text", "reason"),
    [
        ('{"a": NaN}', "NaN is no number"),
        ("[-Infinity]", "-Infinity is no number"),
        ("[" * 5000 + "]" * 5000, "nested deeper"),
        ("[" * 21 + "]" * 21, "nested deeper"),
        ("9" * 6000, r"not valid JSON: [^;]*digits$"),  # without the way out that Python's own message names
        ('{"a": 1,\n 3}', r"not valid JSON: Expecting property name.*: line 2 column 2 \(char 10\)$"),
        (r'{"a": ["\ud83d"]}', "half of a character"),
        (r'{"\udc00": 1}', "half of a character"),
    ],
)
def test_json_that_is_none(tmp_path: Path, text: str, reason: str) -> None:
    (tmp_path / "a.json").write_text(text)
    with pytest.raises(JumpcadError, match=reason):
        read_json(tmp_path / "a.json")


def test_broken_toml_is_named_with_its_place(tmp_path: Path) -> None:
    (tmp_path / "p.toml").write_text('name = "MK4"\nnozzle_mm = \n')
    with pytest.raises(JumpcadError, match=r"p\.toml: not valid TOML: Invalid value \(at line 2"):
        read_toml(tmp_path / "p.toml")


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("a = " + "[" * 5000 + "]" * 5000, "nested deeper than 20 levels"),
        ("a = " + "{a = " * 5000 + "1" + "}" * 5000, "nested deeper than 20 levels"),
        (".".join("a" * 60) + " = 1", "nested deeper than 20 levels"),
        ("[" + ".".join("a" * 20_000) + "]", "line 1 has more than 200 dots"),
        ("a = " + "1" * 6000, "an integer of more digits than can be read"),
        ("# " + "x" * (1 << 20), "is larger than 1 MiB"),
        ("[" + " " * 200_000, "not valid TOML"),
    ],
    ids=["lists", "tables", "keys", "long key", "digits", "size", "blanks"],
)
def test_nonsense_from_strangers_is_one_short_line(tmp_path: Path, text: str, reason: str) -> None:
    (tmp_path / "p.toml").write_text(text)
    with pytest.raises(JumpcadError, match=reason) as caught:
        read_toml(tmp_path / "p.toml")
    told = str(caught.value).replace(str(tmp_path), "")
    assert told.isprintable()
    assert len(told) < 500


def test_a_byte_order_mark_before_the_text_is_no_part_of_it(tmp_path: Path) -> None:
    """Editors on Windows write one."""
    file = tmp_path / "design.toml"
    file.write_bytes(b"\xef\xbb\xbfrest = 45.0\r\n")
    assert read_toml(file) == ({"rest": 45.0}, "rest = 45.0\n")


def test_a_file_of_somebody_elses_is_told_as_one_that_may_not_be_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: object) -> int:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "stat", refused)
    with pytest.raises(JumpcadError, match=r"a\.toml: may not be read \(permission denied\)$"):
        read_toml(tmp_path / "a.toml")


@each("text", ["=1+1", "+x", "-x", "@SUM(A1)", "\tx", "\n=1", "＝1+1", "-1+cmd|' /C calc'!A0"])
def test_text_that_a_spreadsheet_would_compute_gets_an_apostrophe(text: str) -> None:
    cells = next(csv.reader(io.StringIO(to_csv([[text, "a=b"]]).removeprefix(BOM), newline="")))
    assert cells == [f"'{text}", "a=b"]


def test_numbers_stay_numbers() -> None:
    assert to_csv([[-1.5, "-1.5", "-2e-3", "+3", -4, None]]) == "-1.5,-1.5,-2e-3,+3,-4,\n"


def test_no_text_begins_a_row_of_its_own() -> None:
    rows = list(csv.reader(io.StringIO(to_csv([["a\r=1+1", "\r\n=2"], ["b", "c"]]), newline="")))
    assert rows == [["a\n=1+1", "'\n=2"], ["b", "c"]]


def test_what_is_not_ascii_opens_right_in_a_spreadsheet_on_windows() -> None:
    """Without its three bytes in front Excel reads the system's old character set: 1 N·mm/° becomes 1 NÂ·mm/Â°."""
    rows = [["rate"], ["1 N·mm/°"]]
    assert to_csv(rows).encode().startswith(b"\xef\xbb\xbfrate\n")
    assert list(csv.reader(io.StringIO(to_csv(rows).encode().decode("utf-8-sig")))) == rows
    assert to_csv([["rate"], ["1 N"]]).encode() == b"rate\n1 N\n"
