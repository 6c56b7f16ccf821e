"""README and docs are right: their figures, the commands with their options, lines of Python (about 8 s)."""

import importlib
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
import typer
from support import needs

from jumpcad.cli.commands import app
from jumpcad.files import template_names

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
TEXT = (ROOT / "docs" / "commands.md").read_text(encoding="utf-8")
PYTHON = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
COMMANDS = dict(re.findall(r"^\| `jumpcad ([a-z]+)[^|]*(\|.*) \|$", TEXT, re.M))


@pytest.fixture(scope="module")
def readme() -> ModuleType:
    """The program that computes the figures."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    try:
        return importlib.import_module("readme")
    finally:
        sys.path.pop(0)


@pytest.mark.thorough
def test_figures_that_follow_from_the_templates(readme: ModuleType, capsys: pytest.CaptureFixture[str]) -> None:
    needs.package("pybullet")
    code = readme.main(["--cheap"])
    assert (code, capsys.readouterr().out) == (0, "every figure is what the program gives\n")


def test_wrong_figures_are_named_and_corrected(
    readme: ModuleType, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    page, picture = tmp_path / "README.md", tmp_path / "best-printable.png"
    page.write_text(re.sub(r"(`kenan-2.0` [|]) (\d+ mm)", r"\1 9\2", README, count=1), encoding="utf-8")
    picture.write_bytes(b"another picture")
    monkeypatch.setattr(readme, "PAGES", [page])
    monkeypatch.setattr(readme, "PICTURE", picture)
    monkeypatch.setattr(readme, "CHEAP", {readme.figures.of_results: 0.0})
    assert readme.main(["--cheap"]) == 1
    found = capsys.readouterr().out.splitlines()
    assert len(found) == 2
    assert found[0].startswith("best-printable.png: is not the picture")
    says = re.match(
        r"README.md, results: says .*`kenan-2.0` [|] 9(\d+ mm) .*, should say .*`kenan-2.0` [|] (\d+ mm)", found[1]
    )
    assert says
    assert says[1] == says[2]
    assert readme.main(["--cheap", "--write"]) == 0
    assert page.read_text(encoding="utf-8") == README
    assert picture.read_bytes() == (ROOT / "docs" / "best-printable.png").read_bytes()


def test_every_command_is_described_with_options_that_it_has() -> None:
    commands = typer.main.get_command(app).commands
    assert set(COMMANDS) == set(commands)
    for name, description in COMMANDS.items():
        described = set(re.findall(r"`(-{1,2}[a-z0-9-]+)", description))
        assert described <= opts(commands[name])


def test_every_command_that_is_said_to_has_json() -> None:
    assert "Every command but `studio` has `--json`" in TEXT
    commands = typer.main.get_command(app).commands
    assert {name for name, command in commands.items() if "--json" not in opts(command)} == {"studio"}


def opts(command: Any) -> set[str]:
    """Return a command's options."""
    return {option for parameter in command.params for option in parameter.opts}


def test_templates_are_named() -> None:
    (names,) = re.findall(r"a template's name \((.*?)\)", TEXT)
    assert sorted(re.findall("`([^`]+)`", names)) == template_names("robots")


def test_lines_of_python_run(capsys: pytest.CaptureFixture[str]) -> None:
    needs.package("pybullet")
    (code,) = [code for code in re.findall(r"```python\n(.*?)```", PYTHON, re.S) if "published" in code]
    names: dict[str, object] = {}
    exec(code, names)
    assert capsys.readouterr().out.startswith("jump 0.19")
    assert {"distance_m", "base_height_m", "energy_j"} <= vars(names["paper"]).keys()


def test_the_two_commands_are_where_ci_takes_them_from() -> None:
    """`.ci/run` fails where it finds another number of lines; here, what they do."""
    section = README.partition("## Two commands\n")[2].partition("\n## ")[0]
    first, second = re.findall(r"^ *```bash\n *(.*)\n *```$", section, re.M)
    assert re.fullmatch(r"python3 -m venv .*pip install .* && jumpcad build kenan-2.0", first)
    assert second == 'pip install -e ".[test]" && python -m pytest'


def test_links_lead_somewhere_and_the_picture_loads_at_once() -> None:
    links = re.findall(r"\]\(([^)#]+)", README)
    assert [link for link in links if not (ROOT / link).exists()] == []
    moving = [link for link in links if link.endswith(".gif")]
    assert moving
    assert sum((ROOT / one).stat().st_size for one in moving) < 1_500_000
