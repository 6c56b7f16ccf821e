"""What the studio opens: a bundle in the workshop that it was built in."""

import sys
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import ANY

import pytest
from support.commands import Run
from support.places import ROOT

from jumpcad.cli.studio import _design, _point
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.workshop import load_workshop


def test_a_bundle_brings_its_own_workshop() -> None:
    design, workshop = _design(str(ROOT / "exports" / "kenan-2.0"), None)
    assert design == load_design("kenan-2.0")
    assert workshop == str(ROOT / "exports" / "kenan-2.0" / "workshop.toml")
    assert load_workshop(workshop).printer == load_workshop().printer


def test_a_bundle_whose_workshop_is_not_its_own_is_not_opened(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_: object) -> None:
        raise JumpcadError("names other files")

    monkeypatch.setattr("jumpcad.bundle.inputs.kept_workshop", refuse)
    with pytest.raises(JumpcadError, match="names other files"):
        _design(str(ROOT / "exports" / "kenan-2.0"), None)


def test_a_template_comes_in_the_default_workshop() -> None:
    assert _design("best-bo", None) == (load_design("best-bo"), "default")


class Server:
    """A server that ends at once."""

    def __init__(self, port: int) -> None:
        self.port = port

    def get_port(self) -> int:
        return self.port

    def sleep_forever(self) -> None:
        """Do nothing."""


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[tuple[object, ...]]:
    """What the studio was opened with, by commands that end at once."""
    found: list[tuple[object, ...]] = []

    class Studio:
        def __init__(self, *given: object) -> None:
            found.append(given)

        def start(self) -> None:
            """Do nothing."""

        def end(self) -> None:
            """Do nothing."""

    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "jumpcad.studio", SimpleNamespace(Studio=Studio))
    monkeypatch.setitem(sys.modules, "jumpcad.studio.server", SimpleNamespace(own_server=Server))
    monkeypatch.setattr("jumpcad.cli.studio._point", lambda file, trial, shop: ("design", "its", "points", trial or 7))
    return found


def test_a_design_is_opened_with_the_workshops_to_choose_from(opened: list[tuple[object, ...]], run: Run) -> None:
    """Its own first, then those of the templates, each once; there is no study, so that its number is 1."""
    assert run("studio", "best-bo", "--port", 8123) == (0, ANY, "")
    ((design, name, shops, server, _, points, number),) = opened
    assert (design, name, points, number) == (load_design("best-bo"), "best-bo", None, 1)
    assert isinstance(shops, list)
    assert shops[0] == "default"
    assert sorted(shops) == sorted(template_names("workshops"))
    assert isinstance(server, Server)
    assert server.port == 8123


def test_a_robot_is_called_after_its_file_and_saved_where_the_command_runs(
    opened: list[tuple[object, ...]], run: Run, tmp_path: Path
) -> None:
    (tmp_path / "robots").mkdir()
    (tmp_path / "robots" / "frog.toml").write_text(load_design("best-ga").to_toml())
    code, said, _ = run("studio", "robots/frog.toml")
    assert code == 0
    assert said.startswith("http://127.0.0.1:8080 ")  # docs/reference/commands.md
    ((design, name, _, _, folder, *_),) = opened
    assert (design, name, folder) == (load_design("best-ga"), "frog", tmp_path)


def test_a_studio_is_started_and_ends_however_its_server_does(
    opened: list[tuple[object, ...]], run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    acts: list[str] = []

    def interrupted(_: Server) -> None:
        acts.append("served")
        raise KeyboardInterrupt

    studio = sys.modules["jumpcad.studio"].Studio
    monkeypatch.setattr(Server, "sleep_forever", interrupted)
    monkeypatch.setattr(studio, "start", lambda _: acts.append("started"))
    monkeypatch.setattr(studio, "end", lambda _: acts.append("ended"))
    assert run("studio", "best-bo")[0] == 130
    assert acts == ["started", "served", "ended"]


class Trials:
    """A study of five trials, the second of which is the best, and the fourth cannot be built."""

    best = 2

    def __init__(self, file: Path) -> None:
        self.file = file

    def trial(self, number: int) -> SimpleNamespace:
        return SimpleNamespace(design=f"design {number}")

    def require_built(self, number: int) -> None:
        if number == 4:
            raise JumpcadError("trial 4 cannot be built")


def test_a_study_is_opened_at_its_best_trial_or_the_one_that_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that cannot be built is refused, unless it is to be built in another workshop."""
    monkeypatch.setitem(sys.modules, "jumpcad.studio.points", SimpleNamespace(Points=Trials, STUDYS="of the study"))
    for trial, shop, number in ((None, None, 2), (3, None, 3), (4, "fine", 4), (None, "fine", 2)):
        design, workshop, points, opened = _point(Path("s.db"), trial, shop)
        assert (design, workshop, opened) == (f"design {number}", "of the study", number)
        assert points.file == Path("s.db")
    with pytest.raises(JumpcadError, match="trial 4 cannot be built"):
        _point(Path("s.db"), 4, None)


def test_a_file_that_ends_in_db_is_a_study_and_a_folder_is_not(
    opened: list[tuple[object, ...]], run: Run, tmp_path: Path
) -> None:
    (tmp_path / "s.db").touch()
    assert run("studio", "s.db", "--workshop", "fine", "--trial", 3)[0] == 0
    ((design, name, shops, _, _, points, number),) = opened
    assert (design, name, points, number) == ("design", "s", "points", 3)
    assert isinstance(shops, list)
    assert shops[:2] == ["fine", "its"]
    (tmp_path / "folder.db").mkdir()
    code, _, said = run("studio", "folder.db", "--trial", 3)
    assert (code, said) == (2, "jumpcad: --trial 3: folder.db is no study (F.db)\n")
    assert run("studio", "best-bo", "--trial", 1)[0] == 2
    assert len(opened) == 1
