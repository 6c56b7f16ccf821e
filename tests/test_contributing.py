"""Every example of CONTRIBUTING.md does what it says, on a copy of the package (about 10 s)."""

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from importlib.util import find_spec
from pathlib import Path

import pytest
from support import needs
from support.places import ROOT

SECTIONS = re.split(r"^## ", (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"), flags=re.M)[1:]
EXAMPLES = {title: section for title, _, section in (text.partition("\n") for text in SECTIONS) if title[:4] == "Add "}
NEEDS_MUJOCO = "Add an engine"


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
    kinds = {"a thing", "an exporter", "a check that makes a section grow", "a search method", "an engine"}
    assert set(EXAMPLES) == {f"Add {kind}" for kind in (*kinds, "a bought part")}


def test_files_to_open_are_there() -> None:
    (section,) = (text for text in SECTIONS if text.startswith("Where things are\n"))
    named = re.findall(r"`([\w./-]+/[\w./-]+)`", section)
    assert len(named) > 10
    assert [path for path in named if not (ROOT / path).exists()] == []


def test_every_package_has_its_place_below_those_that_use_it() -> None:
    """In the table, and in the order that `lint-imports` keeps."""
    (section,) = (text for text in SECTIONS if text.startswith("Where things are\n"))
    rows = [re.findall(r"`(\w+)`", row.split("|")[1]) for row in section.splitlines() if row.startswith("| `")]
    places = {name: place for place, row in enumerate(rows) for name in row}
    packages = {
        path.stem for path in (ROOT / "jumpcad").iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()
    }
    assert set(places) == packages - {"__init__", "__main__"}
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    layers = [places[name] for layer in contracts[0]["layers"] for name in layer.split(" | ")]
    assert layers == sorted(layers, reverse=True)


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Lay a copy of the package with all examples in it; return their programs, and its folder as `folder`.

    No two examples change the same file, so that each stands for itself.
    """
    root, found = tmp_path_factory.mktemp("copy"), {}
    for folder in ("jumpcad", "templates"):
        shutil.copytree(ROOT / folder, root / folder)  # with what is compiled, which what is changed outdates
    touched: set[str] = set()
    for title, section in EXAMPLES.items():
        programs = []
        for language, block in re.findall(r"```(\w+)\n(.*?)```", section, re.S):
            heading = re.match(r" ?# (\S+\.\w+)\n", block)
            if heading is None:
                programs.append(block)
                continue
            assert heading[1] not in touched
            touched.add(heading[1])
            if language == "diff":
                apply(block, root)
            else:
                assert not (root / heading[1]).exists()
                (root / heading[1]).parent.mkdir(exist_ok=True)
                (root / heading[1]).write_text(block.removeprefix(heading[0]), encoding="utf-8")
        (found[title],) = programs
    return found | {"folder": str(root)}


RUNNER = """
import json, os, sys, traceback
os.sched_getaffinity = lambda process: set()  # no core for a worker: what is searched is computed here
import jumpcad

build, check, made = jumpcad.build, jumpcad.check, {}

def once(key, make, *arguments):
    if key not in made:
        made[key] = make(*arguments)
    return made[key]

jumpcad.build = lambda design, *workshop: build(design, *workshop) if workshop else once(str(design), build, design)
jumpcad.check = lambda robot: once(id(robot), check, robot)
said = {}
for title, program in json.load(sys.stdin).items():
    try:
        exec(program, {})
        said[title] = ""
    except Exception:
        said[title] = traceback.format_exc()
json.dump(said, sys.stdout)
"""
"""Runs programs in one process, in which a robot is built once and checked once."""


@pytest.fixture(scope="module")
def said(programs: dict[str, str]) -> dict[str, str]:
    """Return what went wrong in each program, nothing where it ended well."""
    folder = programs["folder"]
    environment = os.environ | {"PYTHONPATH": folder, "PYTHONDONTWRITEBYTECODE": "1"}
    there = {title: programs[title] for title in EXAMPLES if title != NEEDS_MUJOCO or find_spec("mujoco")}
    done = subprocess.run(
        [sys.executable, "-c", RUNNER], input=json.dumps(there), cwd=folder, capture_output=True, text=True,
        env=environment, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("title", EXAMPLES)
def test_example(title: str, said: dict[str, str]) -> None:
    if title == NEEDS_MUJOCO:
        needs.package("mujoco")
    assert said[title] == ""
