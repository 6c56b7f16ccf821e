"""What the studio opens: a bundle in the workshop that it was built in."""

import sys
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import ANY

import pytest
from support.commands import Run
from support.places import ROOT

from jumpcad.cli.studio import _design
from jumpcad.design import load_design
from jumpcad.files import template_names
from jumpcad.workshop import load_workshop


def test_a_bundle_brings_its_own_workshop() -> None:
    design, workshop = _design(str(ROOT / "exports" / "kenan-2.0"), None)
    assert design == load_design("kenan-2.0")
    assert workshop == str(ROOT / "exports" / "kenan-2.0" / "workshop.toml")
    assert load_workshop(workshop).printer == load_workshop().printer


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
