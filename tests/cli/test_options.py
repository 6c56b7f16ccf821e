"""What is asked for on the command line arrives where the work is done, under the name that it has in Python.

Of `jumpcad.cli.bundle`, `jumpcad.cli.report`, `jumpcad.cli.optimize`, `jumpcad.cli.explore`, `jumpcad.cli.searching`
and `jumpcad.cli.calibrate`.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from support.commands import Run

import jumpcad
import jumpcad.search.optimization  # before its pool is replaced
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.search.models import robot_model
from jumpcad.search.space import Space
from jumpcad.search.study.request import Request
from jumpcad.search.study.store import StudyStore
from jumpcad.settings import load_settings
from jumpcad.workshop import load_workshop

SEARCH = (
    "--objective", "range", "--seed", "5", "--workshop", "light", "--settings", "fine", "--engine", "mujoco",
    "--workers", "3", "--limit", "33", "--study", "mine.db",
)  # fmt: skip
"""Options that `optimize` and `explore` have in common, none at its default."""


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """What a search is asked for, by the command line or by Python; it is not run."""
    found: dict[str, Any] = {}

    @contextmanager
    def pool(workers: object = None, dask: object = None, limit_s: object = 60.0) -> Iterator[None]:
        found["pool"] = (workers, dask, limit_s)
        yield

    def run_study(request: Request, path: Path, *_: object) -> None:
        found.update(request=request, path=path)
        raise JumpcadError("enough")

    for place in ("jumpcad.search.study.pool", "jumpcad.search.optimization"):
        monkeypatch.setattr(f"{place}.open_pool", pool)
    for place in ("jumpcad.search.study.run", "jumpcad.search.optimization"):
        monkeypatch.setattr(f"{place}.run_study", run_study)
    return found


def test_every_option_of_optimize_arrives_and_is_that_of_python(run: Run, asked: dict[str, Any]) -> None:
    code, _, err = run(
        "optimize", "ga+bo", *SEARCH, "--evaluations", 77, "--preset", "published", "--batch", 4, "--from-study",
        "old.db", "--until", 2, "--hours", 1.5, "--around", "kenan-2.0", "--only", "c_coef, rest_angle_deg",
        "--within", 10,
    )  # fmt: skip
    assert (code, err) == (2, "jumpcad: enough\n")
    request, shop = asked["request"], load_workshop("light")
    assert (request.method, request.aim.name, request.evaluations, request.seed) == ("ga+bo", "range", 77, 5)
    assert (request.preset, request.batch, request.prior) == ("published", 4, Path("old.db"))
    assert (request.until_percent, request.hours, request.screen) == (2.0, 1.5, False)
    model = request.model
    assert (model.name, model.workshop, model.settings, model.engine) == (
        "printed", shop, load_settings("fine"), "mujoco",
    )  # fmt: skip
    own = load_design("kenan-2.0")
    assert [one.name for one in request.space.parameters if one.free] == ["c_coef", "rest_angle_deg"]
    assert all(one.lower <= getattr(own, one.name) <= one.upper for one in request.space.parameters)
    whole = {one.name: one.width for one in Space.make(workshop=shop).parameters}
    for one in request.space.parameters:
        assert one.width == 0.0 or one.width <= 0.2 * whole[one.name] + 1e-9
    assert asked["pool"] == (3, None, 33.0)
    assert asked["path"] == Path("mine.db")
    by_command = dict(asked)
    with pytest.raises(JumpcadError, match="enough"):
        jumpcad.optimize(
            "ga+bo", objective="range", seed=5, workshop="light", settings="fine", engine="mujoco", workers=3,
            limit_s=33.0, study="mine.db", evaluations=77, preset="published", batch=4, prior="old.db",
            until_percent=2.0, hours=1.5, around="kenan-2.0", only=["c_coef", "rest_angle_deg"],
            within_percent=10.0,
        )  # fmt: skip
    assert asked == by_command


@pytest.mark.parametrize(
    ("words", "arguments"),
    [
        ((), {}),
        (("ga", "--screen"), {"method": "ga", "screen": True}),
        (("ga", "--model", "capsule"), {"method": "ga", "model": "capsule"}),
        (("pareto", "--dask", "tcp://here:8786"), {"method": "pareto", "dask": "tcp://here:8786"}),
        (
            ("bo", "--fix", "c_coef=1", "--bound", "rest_angle_deg=50:60", "--bound", "body.plate_mm=1.6:2.4",
             "--choose", "d_coef=0.7,0.8"),
            {"method": "bo", "fixed": {"c_coef": 1}, "choices": {"d_coef": (0.7, 0.8)},
             "bounds": {"rest_angle_deg": (50, 60), "body.plate_mm": (1.6, 2.4)}},
        ),
    ],
)  # fmt: skip
def test_a_search_is_the_same_on_the_command_line_and_in_python(
    run: Run, asked: dict[str, Any], words: tuple[str, ...], arguments: dict[str, Any]
) -> None:
    """Without an option too: the defaults are the same."""
    assert run("optimize", *words, "--study", "s.db")[0] == 2
    by_command = dict(asked)
    with pytest.raises(JumpcadError, match="enough"):
        jumpcad.optimize(**({"method": "bo"} | arguments), study="s.db")
    assert asked == by_command


@pytest.mark.parametrize("view", ["sweep", "pca", "importance", "feasibility"])
def test_every_option_of_explore_arrives(
    run: Run, asked: dict[str, Any], monkeypatch: pytest.MonkeyPatch, view: str
) -> None:
    """A study of a view is another study with any other request, so its identity holds them all."""

    def write(path: Path, identity: dict[str, Any]) -> None:
        asked.update(path=path, identity=identity)
        raise JumpcadError("enough")

    monkeypatch.setattr(StudyStore, "write", staticmethod(write))
    around = ("--around", "kenan-1.0") if view in ("sweep", "feasibility") else ()
    code, _, err = run(
        "explore", view, *SEARCH, *around, "--fix", "c_coef=1", "--bound", "rest_angle_deg=50:60",
        "--choose", "d_coef=0.7,0.8",
    )  # fmt: skip
    assert (code, err) == (2, "jumpcad: enough\n")
    robot, identity = robot_model("printed", "light", "fine", "mujoco"), asked["identity"]
    assert identity["model"] == robot.describe()
    assert (identity["objective"], identity["method"], identity["seed"]) == ("range", f"explore {view}", 5)
    assert identity["around"] == load_design("kenan-1.0" if around else "best-bo").model_dump()
    space = identity["space"]
    assert [space[name] for name in ("c_coef", "rest_angle_deg", "d_coef")] == [
        {"fixed": 1.0}, {"lower": 50.0, "upper": 60.0}, {"choices": [0.7, 0.8]},
    ]  # fmt: skip
    assert (asked["path"], asked["pool"]) == (Path("mine.db"), (3, None, 33.0))


def test_no_design_or_workshop_of_one_s_own_is_replaced_unasked(run: Run, asked: dict[str, Any]) -> None:
    """A search that varies the workshop writes two files."""
    command = ("optimize", "bo", "--study", "s.db", "-o", "best.toml", "--bound", "body.plate_mm=1.6:2.4")
    for name in ("best.toml", "best-workshop.toml"):
        Path(name).write_text("mine")
        code, _, err = run(*command)
        assert (code, "request" in asked) == (2, False)
        assert f"{name}: exists already" in err
        assert run(*command, "--force")[2] == "jumpcad: enough\n"
        asked.clear()
        Path(name).unlink()
    Path("best-workshop.toml").write_text("mine")
    assert run(*command[:6])[2] == "jumpcad: enough\n"  # the workshop is not varied: it is not written
