"""Every example of CONTRIBUTING.md does what it says, on a copy of the package (about 15 s)."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from support.places import ROOT

SECTIONS = re.split(r"^## ", (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"), flags=re.M)[1:]
EXAMPLES = {title: section for title, _, section in (text.partition("\n") for text in SECTIONS) if title[:4] == "Add "}


def apply(diff: str, root: Path) -> None:
    """Apply lines to add and to remove, in their order, each found once after the context line before it."""
    heading, *lines = diff.splitlines()
    path = root / heading.removeprefix(" # ")
    text, place = path.read_text(encoding="utf-8"), 0
    for line in lines:
        kind, whole = line[0], line[1:] + "\n"
        if kind == "+":
            text = text[:place] + whole + text[place:]
            place += len(whole)
            continue
        assert text.count(f"\n{whole}") == 1, f"{path.name}: {whole}"
        place = text.index(f"\n{whole}") + 1
        if kind == "-":
            text = text[:place] + text[place + len(whole) :]
        else:
            place += len(whole)
    path.write_text(text, encoding="utf-8")


def test_every_kind_of_addition_is_shown() -> None:
    kinds = {"a printed part", "an exporter", "a check that makes a section grow", "a search method", "an engine"}
    assert set(EXAMPLES) == {f"Add {kind}" for kind in (*kinds, "a bought part")}


@pytest.mark.parametrize("title", EXAMPLES)
def test_example(title: str, tmp_path: Path) -> None:
    if title == "Add an engine":
        pytest.importorskip("mujoco")
    for folder in ("jumpcad", "templates"):
        shutil.copytree(ROOT / folder, tmp_path / folder)  # with what is compiled, which what is changed outdates
    programs = []
    for language, block in re.findall(r"```(\w+)\n(.*?)```", EXAMPLES[title], re.S):
        heading = re.match(r"# (\S+\.\w+)\n", block)
        if language == "diff":
            apply(block, tmp_path)
        elif heading:
            assert not (tmp_path / heading[1]).exists()
            (tmp_path / heading[1]).write_text(block.removeprefix(heading[0]), encoding="utf-8")
        else:
            programs.append(block)
    (program,) = programs
    command = [sys.executable, "-c", program]
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr
