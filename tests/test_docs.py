"""The documentation is right: its site builds, its reference is the program's, its examples run (about 35 s)."""

import importlib
import inspect
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from unittest.mock import Mock

import pytest
import typer
from support import needs
from support.calibrations import with_coarse_calibration
from support.pictures import with_few_pictures, with_plain_figures
from support.places import ROOT
from support.proposals import with_less_work

import jumpcad
from jumpcad.cli.commands import app, run
from jumpcad.design import PARAMETERS
from jumpcad.search import optimization
from jumpcad.workshop import Workshop

DOCS = ROOT / "docs"
CHAPTERS = {path.stem: path.read_text(encoding="utf-8") for path in sorted(DOCS.glob("*.md"))}
PAGES = ["README.md", "CONTRIBUTING.md", *(f"docs/{name}.md" for name in CHAPTERS)]
BLOCKS = {
    name: found for name, text in CHAPTERS.items() if (found := re.findall(r"^```(\w+)\n(.*?)^```", text, re.S | re.M))
}


@pytest.fixture(scope="module")
def reference() -> ModuleType:
    """The program that writes the reference pages."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    try:
        return importlib.import_module("reference")
    finally:
        sys.path.pop(0)


@pytest.mark.parametrize("page", ["commands.md", "workshop.md", "figures.md"])
def test_reference_is_what_the_program_gives(reference: ModuleType, page: str) -> None:
    name = f"reference/{page}"
    assert (DOCS / name).read_text(encoding="utf-8") == reference.PAGES[name]()


@pytest.mark.thorough
@pytest.mark.usefixtures("built_once", "checked_once")
@pytest.mark.parametrize("page", ["checks.md", "files.md"])
def test_reference_is_what_the_program_gives_figures_aside(
    reference: ModuleType, page: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With short chains, coarse jumps and quick proposals: figures are not compared."""
    if page == "files.md":
        needs.package("emcee")
        with_coarse_calibration(monkeypatch)
        with_less_work(monkeypatch)
    with_plain_figures(monkeypatch)
    name = f"reference/{page}"
    written, given = (DOCS / name).read_text(encoding="utf-8"), reference.PAGES[name]()
    assert without_figures(written) == without_figures(given)


def test_every_field_of_a_document_is_explained() -> None:
    text = (DOCS / "reference" / "files.md").read_text(encoding="utf-8")
    fields = re.findall(r"^\| `([^`]+)` \| [^|]+ \|([^|]*)\|$", text.partition("## manifest.json")[2], re.M)
    assert [name for name, words in fields if not words.strip()] == []
    assert {"jumpcad optimize --json", "jumpcad calibrate kenan-1.0 --predict kenan-2.0 --json"} <= set(
        re.findall(r"^## (.*)", text, re.M)
    )


def without_figures(text: str) -> str:
    """Return a text in which every number is #; `poe docs` compares the numbers too.

    And `together` as if it were empty: short chains may know parameters together that long ones do not.
    """
    return re.sub(r"-?\d+(?:[.,]\d+)*", "#", text.replace("`together` | list of list of text |", "`together` | list |"))


def test_every_parameter_is_explained_with_its_ranges() -> None:
    from jumpcad.design import PRINTED_BOUNDS, SEARCH_BOUNDS, Design

    rows = dict(re.findall(r"^\| `(\w+)` \|(.*)\|$", CHAPTERS["robot"], re.M))
    assert list(rows) == list(PARAMETERS)
    for name, row in rows.items():
        limits = {type(one).__name__: next(iter(vars_of(one))) for one in Design.model_fields[name].metadata}
        assert f" {limits['Ge']:g} to {limits['Le']:g} " in row
        for one in (PRINTED_BOUNDS[name], SEARCH_BOUNDS[name]):
            assert f" {one.lower:g} to {one.upper:g} " in row


def vars_of(constraint: object) -> list[float]:
    """Return the value of a constraint such as `Ge(ge=20)`."""
    return [getattr(constraint, type(constraint).__name__.lower())]


def test_keys_of_a_workshop_that_are_named_exist() -> None:
    """`fits.sliding_mm` is a key of the table `fits`; tables of own names, such as `materials`, are not looked into."""
    named = {found for text in CHAPTERS.values() for found in re.findall(r"`([a-z]+)\.([a-z_]+)\b", text)}
    tables = {name: getattr(field.annotation, "model_fields", None) for name, field in Workshop.model_fields.items()}
    assert [f"{table}.{key}" for table, key in named if tables.get(table) and key not in tables[table]] == []


@pytest.mark.thorough
@pytest.mark.usefixtures("built_once", "checked_once")
@pytest.mark.parametrize("chapter", BLOCKS)
def test_examples_run(
    chapter: str, bundle_of: Callable[[str], Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Run blocks of bash and Python in their order; of sh, whose commands cost minutes, check command and options."""
    for engine in ("mujoco", "pybullet"):
        if any(f"import {engine}" in block for _, block in BLOCKS[chapter]):
            needs.package(engine)
    with_few_pictures(monkeypatch)
    with_plain_figures(monkeypatch)
    with_less_work(monkeypatch)
    monkeypatch.chdir(tmp_path)
    if "exports/kenan-2.0" in CHAPTERS[chapter]:
        (tmp_path / "exports").mkdir()
        (tmp_path / "exports" / "kenan-2.0").symlink_to(bundle_of("kenan-2.0"))
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    names: dict[str, object] = {}
    for language, block in BLOCKS[chapter]:
        if heading := re.match(r"# (\S+\.toml)\n", block):
            (tmp_path / heading[1]).write_text(block, encoding="utf-8")
        elif language == "python":
            exec(block, names)
        elif language in ("bash", "sh"):
            for line in commands_of(block):
                assert language == "sh" or run(line) == 0, line
                require_known(line)


@pytest.mark.parametrize("page", [*PAGES, "docs/reference/commands.md"])
def test_commands_named_in_texts_and_tables_exist(page: str) -> None:
    for command in re.findall(r"`jumpcad ([a-z]+\b[^`]*)`", (ROOT / page).read_text(encoding="utf-8")):
        require_known(shlex.split(command))


@pytest.mark.thorough
@pytest.mark.usefixtures("built_once", "checked_once")
def test_python_of_the_cheat_sheet_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Row after row; of searches, whether they can be called so."""
    needs.package("pybullet")
    with_few_pictures(monkeypatch)
    monkeypatch.chdir(tmp_path)
    searched = []
    monkeypatch.setattr(jumpcad, "optimize", lambda *given, **named: searched.append(called(given, named)) or Mock())
    names: dict[str, object] = {"jumpcad": jumpcad}
    rows = re.findall(r"^\|[^|]*\|[^|]*\| `([^`]+)` \|$", CHAPTERS["cheatsheet"], re.M)
    for row in rows:
        exec(row, names)
    assert len(searched) == 6
    assert {"longer", "failed", "planar", "moon", "path", "bundle"} <= names.keys()


def called(given: tuple[object, ...], named: dict[str, object]) -> inspect.BoundArguments:
    """Return the arguments of a search, which have to be those that it takes."""
    return inspect.signature(optimization.optimize).bind(*given, **named)


def commands_of(block: str) -> list[list[str]]:
    """Return the arguments of the lines that call jumpcad."""
    lines = [shlex.split(line, comments=True) for line in block.splitlines()]
    strange = [line for line in lines if line and line[0] != "jumpcad" and not {"pip", "python3"} & set(line)]
    assert strange == []
    return [line[1:] for line in lines if line and line[0] == "jumpcad"]


def require_known(arguments: list[str]) -> None:
    """Fail where a command or one of its options does not exist."""
    command = typer.main.get_command(app).commands[arguments[0]]
    options = {option for parameter in command.params for option in [*parameter.opts, *parameter.secondary_opts]}
    assert {word for word in arguments if re.match("--?[a-z]", word)} <= options


@pytest.mark.thorough
def test_the_site_is_built_without_a_warning_and_loads_nothing_from_elsewhere(tmp_path: Path) -> None:
    for package in ("sphinx", "furo", "myst_parser", "sphinx_copybutton"):
        needs.package(package)
    site = tmp_path / "site"
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", str(DOCS), str(site)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for page in site.rglob("*.html"):
        loaded = re.findall(r"<(?:script|img|iframe)[^>]*\ssrc=\"(\w+:)?//", page.read_text(encoding="utf-8"))
        styles = re.findall(r"<link[^>]*\shref=\"(?:https?:)?//", page.read_text(encoding="utf-8"))
        assert (loaded, styles) == ([], []), page.name
