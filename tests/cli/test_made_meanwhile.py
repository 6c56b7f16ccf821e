"""A file that the user makes while a command runs is the user's: each command that writes one looks again."""

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from support.built import built
from support.calibrations import with_coarse_calibration
from support.commands import Run

from jumpcad.files import outputs
from jumpcad.landing import lightest_cage

SEARCH = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "4", "--workers", "0", "--study", "s.db")
COMMANDS = {
    ("new", "f.toml"): "f.toml",
    ("new", "w.toml", "--material", "PLA"): "w.toml",
    (*SEARCH, "-o", "s.toml"): "s.toml",
    ("study", "s.db", "--export", "f.csv"): "f.csv",
    ("study", "s.db", "--plots", "."): "history.png",
    ("report", "s.db", "-o", "s.html"): "s.html",
    ("report", "kenan-2.0", "-o", "r.html"): "r.html",
    ("compare", "kenan-2.0", "best-bo", "-o", "c.html"): "c.html",
    ("simulate", "kenan-2.0", "--capsule", "--trajectory", "f.json"): "f.json",
    ("simulate", "kenan-2.0", "--jumps", "1", "--trajectory", "j.csv"): "j.csv",
    ("coupon", "--measured", "readings.toml", "-o", "m.toml"): "m.toml",
    ("cage", "kenan-2.0", "-o", "k.toml"): "k.toml",
    ("calibrate", "kenan-2.0", "-o", "c.toml"): "c.toml",
    ("render", "kenan-2.0", "-o", "."): "rest.png",
}


@pytest.mark.thorough
def test_it_is_kept(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def then_made(check: Callable[..., None]) -> Callable[..., None]:
        def checked(path: Path, *arguments: Any) -> None:
            check(path, *arguments)
            if path.name == made:
                path.write_text("mine")

        return checked

    with_coarse_calibration(monkeypatch)
    landed = SimpleNamespace(drops_righted=1.0, share_righted=1.0)
    monkeypatch.setattr(lightest_cage, "lightest_cage", lambda *_: (built("kenan-2.0"), landed))
    (tmp_path / "readings.toml").write_text("[gauge.PETG]\naxle_press_mm = 0.15\n")
    for command, made in COMMANDS.items():
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("jumpcad.search.study.trial.require_target", then_made(outputs.require_target))
            patch.setattr("jumpcad.search.study.result.require_target", then_made(outputs.require_target))
            patch.setattr(outputs, "require_target", then_made(outputs.require_target))
            if made.endswith(".png"):
                patch.setattr(outputs, "require_writable", lambda folder, made=made: (folder / made).write_text("mine"))
            code, _, err = run(*command)
        assert (code, (tmp_path / made).read_text()) == (2, "mine"), command
        assert err.endswith(f"{made}: exists already; choose another name, or replace it with --force\n"), err
    assert run("new", "f.toml", "--force")[0] == 0
