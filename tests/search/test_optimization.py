"""`jumpcad.optimize`: the search of the command line, in one call."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

import jumpcad
from jumpcad.cli.commands import app
from jumpcad.errors import JumpcadError

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
        ({"fixed": {"c_coef": "1"}}, r"c_coef = '1' \(str\) is not a number"),
        ({"fixed": {"c_coef": 10**400}}, "c_coef = .* is outside"),
        ({"fixed": {"c_coef": float("nan")}}, "c_coef = nan is outside"),
        ({"fixed": {5: 1}}, "5 is not a parameter of a design"), ({"fixed": [1]}, "takes a table as fixed"),
        ({"bounds": {"c_coef": 1.0}}, "give several numbers"),
        ({"bounds": {"c_coef": (0.9, 1.0, 1.1)}}, "c_coef has 3 bounds"),
        ({"bounds": {"c_coef": "ab"}}, r"^c_coef = 'ab' \(str\): must be a list of values$"),
        ({"choices": {"c_coef": []}}, "no values to choose from"),
        ({"choices": {"c_coef": "abc"}}, r"^c_coef = 'abc' \(str\): must be a list of values$"),
        ({"only": "range"}, r"^optimize\(\) takes a list of str as only, not 'range' \(str\)$"),
        ({"fixed": {"c_coef": 1}, "bounds": {"c_coef": (0.9, 1.1)}}, "given twice"),
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
