"""`jumpcad.optimize`: the search of the command line, in one call."""

import json
from pathlib import Path

import pytest
from support.each import each
from typer.testing import CliRunner

import jumpcad
from jumpcad.cli.commands import app
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.search.models import robot_model
from jumpcad.search.space import Space
from jumpcad.search.study.request import Request

WEAK = {"stiffness_nmm_per_deg": 5, "compression_ratio": 0.1}
QUICK = {"model": "capsule", "settings": "screening", "workers": 0}
OPTIONS = ["--model", "capsule", "--settings", "screening", "--workers", "0", "--json"]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def command(*arguments):
    done = CliRunner().invoke(app, [*arguments, *OPTIONS], catch_exceptions=False)
    return json.loads(done.stdout)


def test_it_finds_what_the_command_finds_and_goes_on_with_its_study(folder):
    best = jumpcad.optimize("ga", evaluations=24, seed=3, study=folder / "mine.db", **QUICK)
    found = command("optimize", "ga", "--evaluations", "24", "--seed", "3", "--study", "theirs.db", "-o", "theirs.toml")
    assert best.design.model_dump() == found["winner"]["design"]
    assert (best.score, best.fitness) == (found["winner"]["score"], found["winner"]["fitness"])
    assert len(best.trials) == found["searched"] == 18
    assert 18 < best.evaluations == found["evaluations"] <= 24
    assert best.save("mine.toml").read_bytes() == (folder / "theirs.toml").read_bytes()
    longer = jumpcad.optimize("ga", evaluations=30, seed=3, study="theirs.db", **QUICK)
    assert [trial.key for trial in longer.trials[:18]] == [trial.key for trial in best.trials]


def test_the_space_is_given_by_numbers():
    best = jumpcad.optimize(
        "bo", evaluations=6, fixed={"c_coef": 1}, bounds={"rest_angle_deg": (50, 60)},
        choices={"d_coef": [0.8, 0.7]}, **QUICK,
    )  # fmt: skip
    texts = {"fix": ["c_coef=1"], "bound": ["rest_angle_deg=50:60"], "choose": ["d_coef=0.7,0.8"]}
    assert best.request.space == jumpcad.search.Space.parse(**texts)
    for trial in best.trials:
        assert trial.design.c_coef == 1.0
        assert 50.0 <= trial.design.rest_angle_deg <= 60.0
    assert {trial.design.d_coef for trial in best.trials} == {0.7, 0.8}


def test_wrong_arguments_are_one_line_and_leave_nothing(folder):
    """What is checked alike on the command line has its tests there."""
    for options, message in (
        ({"method": 5}, r"optimize\(\) takes a text as method"),
        ({"evaluations": 1.5}, "takes a whole number as evaluations, not 1.5"),
        ({"fixed": {"c_coef": 10**400}}, "c_coef = .* is outside"),
        ({"fixed": {5: 1}}, "5 is not a parameter of a design"), ({"fixed": [1]}, "takes a table as fixed"),
        ({"bounds": {"c_coef": 1.0}}, "give several numbers"),
        ({"bounds": {"c_coef": "ab"}}, r"^c_coef = 'ab' \(str\): must be a list of values$"),
        ({"choices": {"c_coef": "abc"}}, r"^c_coef = 'abc' \(str\): must be a list of values$"),
        ({"only": "range"}, r"^optimize\(\) takes a list of str as only, not 'range' \(str\)$"),
        ({"study": "none/s.db"}, "none/s.db"), ({"study": "s.sqlite"}, "a study file must end in .db"),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match=message) as error:
            jumpcad.optimize(**({"model": "capsule", "evaluations": 2} | options))
        assert "\n" not in str(error.value)
        assert list(folder.iterdir()) == []


def test_a_search_is_around_a_design_however_it_is_named(folder, monkeypatch):
    """By a template's name, a file's path as a text or as a path, or the design itself."""
    monkeypatch.setattr("jumpcad.search.optimization.run_study", lambda request, *_: request)
    design = jumpcad.load_design("best-ga")
    (folder / "own.toml").write_text(design.to_toml())
    spaces = [
        jumpcad.optimize(around=around, within_percent=10, model="capsule", workers=0).space
        for around in ("best-ga", "own.toml", Path("own.toml"), folder / "own.toml", design)
    ]
    assert spaces == [jumpcad.search.Space.parse(around=design, within_percent=10)] * 5


@pytest.mark.thorough
@each("method", [None, "ga", "pareto", "nsga2"])
def test_what_is_known_is_evaluated_first_and_the_search_begins_with_it(folder, method):
    """It counts, is the same robot to `simulate`, and what is found is as good; what is out of bounds is told."""
    ask = QUICK | {"method": method or "bo", "evaluations": 12, "objective": "range", "until_percent": 0}
    found = jumpcad.optimize(start=["best-bo", load_design("best-bo")], around="best-ga", **ask)
    assert [trial.phase for trial in found.trials].count("start") == 2 == 12 - len(found.trials[2:])
    for trial, name in zip(found.trials, ("best-ga", "best-bo"), strict=False):
        design = load_design(name)
        assert trial.design == design
        jump = jumpcad.simulate(jumpcad.capsule_robot(design), jumpcad.load_settings("screening"))
        assert trial.score == pytest.approx(jump.ballistic_range_m, rel=1e-9)
    assert found.score >= max(trial.score for trial in found.trials[:2])
    with pytest.raises(JumpcadError, match=r"start: rest_angle_deg = 88\.2 is outside of the search"):
        jumpcad.optimize(start=["kenan-2.0"], **ask)
    told = jumpcad.optimize(around="kenan-2.0", only=["rest_angle_deg", "c_coef"], **ask)
    assert "around: rest_angle_deg = 88.2 is outside of the search, so that design is not evaluated" in told.notes
    assert not any(trial.phase == "start" for trial in told.trials)


def test_a_start_of_the_workshop_has_its_values_or_the_nearest_that_are_searched():
    robot = robot_model("printed")
    space = Space.parse(bound=["body.plate_mm=2.6:3"], choose=["bought.roller=683,682"], workshop=robot.workshop)
    (begun,) = Request(space, robot, start=[load_design("best-bo")]).first
    assert dict(begun.workshop) == {"body.plate_mm": 2.6, "bought.roller": "683"}
    with pytest.raises(JumpcadError, match="evaluations = 1 leave 1 for the search, which begins with 2 designs"):
        Request(space, robot, evaluations=1, start=[load_design("best-bo"), load_design("best-ga")])
