"""What the studio opens: a bundle in the workshop that it was built in."""

import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from support.commands import Run
from support.places import ROOT

from jumpcad.cli.studio import _design, _point
from jumpcad.errors import JumpcadError


def test_a_bundle_whose_workshop_is_not_its_own_is_not_opened(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_: object) -> None:
        raise JumpcadError("names other files")

    monkeypatch.setattr("jumpcad.bundle.manifest.kept_workshop", refuse)
    with pytest.raises(JumpcadError, match="names other files"):
        _design(str(ROOT / "exports" / "kenan-2.0"), None)


def test_a_studio_is_started_and_ends_however_its_server_does(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    acts: list[str] = []

    def interrupted(sleep_s: float) -> None:
        acts.append("served")
        assert sleep_s <= 1.0, "so long no signal is seen that came just before"
        raise KeyboardInterrupt

    def opened(*_: object) -> SimpleNamespace:
        return SimpleNamespace(start=lambda: acts.append("started"), end=lambda: acts.append("ended"))

    monkeypatch.setattr("jumpcad.cli.studio.time.sleep", interrupted)
    server = SimpleNamespace(address="http://")
    monkeypatch.setitem(sys.modules, "jumpcad.studio", SimpleNamespace(Studio=opened))
    monkeypatch.setitem(sys.modules, "jumpcad.studio.server", SimpleNamespace(OwnServer=lambda _: server))
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
