"""The command line as a function, and a bundle."""

from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest
from support.commands import Run, exit_code_of
from support.kept import once, robot_key
from support.pictures import with_plain_figures
from support.places import ROOT
from support.proposals import with_less_work

from jumpcad.bundle import export
from jumpcad.exporters.registry import Exporter, Files
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Jump


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    """Run `jumpcad ARGUMENTS` in an empty folder; return exit code, standard output and standard error."""
    monkeypatch.chdir(tmp_path)

    def call(*arguments: object) -> tuple[int, str, str]:
        code = exit_code_of(*map(str, arguments))
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return call


@pytest.fixture(scope="session", autouse=True)
def contents() -> Iterator[None]:
    """Let the files of a bundle without pictures be made once: these tests show what commands do with them."""
    make = export.contents
    known = once({}, make, robot_key)

    def contents(robot: Robot, exporters: Iterable[Exporter], pictures: bool, jump: Jump) -> Files:
        return make(robot, exporters, pictures, jump) if pictures else known(robot, exporters, pictures, jump)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(export, "contents", contents)
        yield


@pytest.fixture(autouse=True)
def findings(built_once: None, checked_once: None) -> None:
    """Let a robot be built once and checked once: these tests show what commands do with it and its findings."""


@pytest.fixture(autouse=True)
def quick_searches(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let searches make proposals and plots with less work: these tests show what commands do with them."""
    with_less_work(monkeypatch)
    with_plain_figures(monkeypatch)


@pytest.fixture(scope="session")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bundle of Kenan 2.0 without pictures; a test that changes it takes a copy."""
    folder = tmp_path_factory.mktemp("exports") / "kenan-2.0"
    assert exit_code_of("build", "kenan-2.0", "-o", str(folder), "--no-pictures") == 0
    return folder


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, which is empty."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.chdir(tmp_path)
    return tmp_path
