"""What a search writes, every reader reads: any of its options together, and after any interruption."""

import json
import os
import shutil
import sqlite3
from contextlib import closing, suppress
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from support.searches import NARROW, QUICK, data, run
from typer.testing import CliRunner

from jumpcad.cli.commands import app
from jumpcad.comparison import compare
from jumpcad.errors import CannotBuildError
from jumpcad.search.study.store import StudyStore
from jumpcad.studio.points import Points

OWN = "def aim(m):\n    return 100 * m['com_rise_m'] - m['mass_kg']\n"
FIGURES = ("com_rise_m>=0.01", "-1.5e2<=touchdown_pitch_deg<=123.4567891", "mass_kg<=0.5", "com_rise_m>=0.123456789")
EVALUATED = ("0.001<=com_rise_m", "-170<=touchdown_pitch_deg<=170", "leg_strength>=0.5", "rights_itself>=0.2")
PRINTED = ["--workers", "0", "--engine", "planar", "--evaluations", "4"]
QUIETLY = [HealthCheck.function_scoped_fixture]
EXAMPLES = settings(
    max_examples=6, deadline=None, derandomize=True, database=None, phases=[Phase.generate],
    suppress_health_check=QUIETLY,
)  # fmt: skip


def repeated(option: str, values: Any) -> list[str]:
    return [word for value in values for word in (option, value)]


@st.composite
def searches(draw: st.DrawFn) -> list[str]:
    """Draw the words of a search with the capsule robot."""
    method = draw(st.sampled_from(["", "ga", "bo", "ga+bo", "paper", "pareto", "nsga2"]))
    front, words = method in ("pareto", "nsga2"), [*QUICK, *draw(st.sampled_from([NARROW, []]))]
    words += [
        "--evaluations",
        str(draw(st.integers(10, 30))),
        *repeated("--require", sorted(draw(st.sets(st.sampled_from(FIGURES))))),
    ]
    own = draw(st.sampled_from(["", "rise", "range-per-spring-joule", "aims.py:aim"]))
    words += ["--objective", own] if own else []
    words += ["--preset", "published"] if method in ("ga", "ga+bo") and draw(st.booleans()) else []
    words += ["--batch", "3"] if method in ("", "bo") and draw(st.booleans()) else []
    words += ["--against", "mass"] if front and draw(st.booleans()) else []
    words += (
        ["--seeds", "3:5"] if not front and draw(st.booleans()) else ["--seed", str(draw(st.integers(0, 2**32 - 1)))]
    )
    words += ["--choose", "c_coef=0.9,1,1.1"] if "c_coef=1" not in words and draw(st.booleans()) else []
    words += ["--around", "best-ga", "--start", "best-bo"] if "--fix" not in words and draw(st.booleans()) else []
    words += ["--plots", "plots"] if draw(st.integers(0, 3)) == 0 else []
    return [method, *words] if method else words


def rows(study: Path) -> list[dict[str, Any]]:
    """Return all rows of a study as `jumpcad study` exports them, but for what they took."""
    with StudyStore.read(study) as store:
        return [trial.to_dict() | {"at": trial.position, "proposal": trial.proposal} for trial in store.trials()]


def interrupt(study: Path, keep: int) -> None:
    """Make of a finished study what it was after some of its rows."""
    with closing(sqlite3.connect(study)) as connection, connection:
        connection.execute("DELETE FROM trials WHERE rowid NOT IN (SELECT rowid FROM trials LIMIT ?)", (keep,))
        connection.execute("DELETE FROM study WHERE key NOT IN ('identity', 'stages')")


def search(words: list[str], *more: str) -> dict[str, Any]:
    """Search, whether or not something is found, and return its JSON document."""
    done = CliRunner().invoke(app, ["optimize", *words, *more, "--force", "--json"])
    assert done.exception is None or isinstance(done.exception, SystemExit), repr(done.exception)
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def read_and_go_on(words: list[str], keep: int) -> None:
    """Write a study with a search, and read it in every way; the rows of the search, and again, are the same."""
    first = search(words, "--study", "s.db", "-o", "one.toml")
    study = Path(first["study"])
    whole = rows(study)
    assert len(whole) >= first["searched"] > 0
    shown = data("study", study)
    assert (shown["evaluations"], shown["best"]) == (first["searched"], first["best"])
    run("study", study, "--export", "rows.csv", "--force")
    assert len(Path("rows.csv").read_text().splitlines()) > len(whole)
    run("report", study, "-o", "page.html", "--force")
    points = Points(study)
    assert points.trial(1).to_dict().items() <= whole[0].items()
    with suppress(CannotBuildError):
        points.require_built(len(whole))
    assert search(words, "--study", "s.db", "-o", "two.toml")["winner"] == first["winner"]
    assert rows(study) == whole
    interrupt(study, keep % len(whole))
    again = search(words, "--study", "s.db", "-o", "three.toml")
    assert (rows(study), again["winner"], again["candidates"]) == (whole, first["winner"], first["candidates"])
    learned = search(words, "--study", "t.db", "--from-study", str(study), "-o", "four.toml")
    assert rows(Path(learned["study"]))
    assert not [name for name in os.listdir() if name.endswith(("-wal", "-shm", "-journal"))]


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def furnish(here: Path) -> None:
    for one in here.iterdir():
        shutil.rmtree(one) if one.is_dir() else one.unlink()
    (here / "aims.py").write_text(OWN)


def test_a_search_that_requires_something_is_read_again(here: Path) -> None:
    furnish(here)
    require = repeated("--require", FIGURES[:2])
    read_and_go_on(["ga", *QUICK, *NARROW, "--evaluations", "8", "--objective", "aims.py:aim", *require], 5)


@pytest.mark.thorough
@EXAMPLES
@given(words=searches(), keep=st.integers(0, 40))
def test_any_search_is_read_again(here: Path, words: list[str], keep: int) -> None:
    furnish(here)
    read_and_go_on(words, keep)


@pytest.mark.thorough
@settings(EXAMPLES, max_examples=2)
@given(
    method=st.sampled_from([["ga", "--screen"], ["ga"], ["bo"]]),
    require=st.sets(st.sampled_from(EVALUATED)),
    seed=st.integers(0, 9),
)
def test_a_search_of_printed_robots_is_read_again(here: Path, method: list[str], require: set[str], seed: int) -> None:
    """With margins, with what holds on several floors, and with choices of the workshop."""
    furnish(here)
    choices = ["--choose", "bought.roller=623,683", "--bound", "body.plate_mm=1.6:2.4"]
    words = [*method, *PRINTED, "--seed", str(seed), *repeated("--require", sorted(require))]
    read_and_go_on(words if "--screen" in words else [*words, *choices], 3)
    with suppress(CannotBuildError):
        assert compare(["s.db#1", "kenan-2.0"]).robots
