"""`jumpcad explore`, with the capsule robot."""

import re
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from support.searches import NARROW, QUICK, data, refusal, run
from support.told import told_default

from jumpcad.cli import explore
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.search.explore import Sweep
from jumpcad.workshop import load_workshop

CHOSEN = ("--choose", "stiffness_nmm_per_deg=20,25")


def test_views_of_the_space(folder):
    views = {
        "sweep": [*NARROW, "--points", 3],
        "pca": [*NARROW, "--samples", 80],
        "importance": [*NARROW, "--samples", 80],
        "feasibility": ["--points", 4],
    }
    for view, options in views.items():
        found = data("explore", view, *QUICK, *options, "--plots", "pics")
        assert all(Path(picture).is_file() for picture in found["pictures"])
    assert re.search(r"feasible at \d of 3 values", run("explore", "sweep", *QUICK, "--points", 3))
    assert "they say nothing about the robot" in run("explore", "pca", *QUICK, "--samples", 80)
    assert "did you mean sweep" in refusal("explore", "sweeps", *QUICK)


@pytest.mark.parametrize("view", ["sweep", "pca", "importance", "feasibility"])
@pytest.mark.parametrize(
    ("option", "value", "views"),
    [
        ("samples", "50", "pca and importance"), ("points", "3", "sweep and feasibility"),
        ("around", "best-ga", "sweep and feasibility"), ("over", "c_coef,e_coef", "feasibility"),
    ],
)  # fmt: skip
def test_an_option_of_another_view_is_refused_and_not_ignored(folder, monkeypatch, view, option, value, views):
    """As the help says what each is for; where it is for this view, the robot is looked for next."""

    def begun(*_):
        raise JumpcadError("begun")

    monkeypatch.setattr("jumpcad.search.models.robot_model", begun)
    said = refusal("explore", view, *QUICK, f"--{option}", value)
    other = f"jumpcad: --{option} {value}: does not apply to {view}, only to {views}"
    assert said == ("jumpcad: begun" if view in views.split(" and ") else other)


@pytest.mark.parametrize(("option", "least", "most"), [("--samples", 20, 100_000), ("--points", 2, 1000)])
def test_counts_have_ends_that_are_told(folder, option, least, most):
    """At an end they are taken, and something else is wrong."""
    for count in (least, most):
        assert "did you mean sweep" in refusal("explore", "sweeps", *QUICK, option, count)
    for count, words in ((least - 1, f"greater than or equal to {least}"), (most + 1, f"less than or equal to {most}")):
        assert words in refusal("explore", "sweeps", *QUICK, option, count)


@pytest.mark.parametrize(
    ("view", "options", "designs"),
    [
        ("sweep", ("--points", 4), 3 * 4),
        ("sweep", ("--points", 4, *CHOSEN), 2 * 4 + 2),
        ("feasibility", ("--points", 3), 3 * 3),
        ("feasibility", ("--points", 3, "--over", "rest_angle_deg,stiffness_nmm_per_deg", *CHOSEN), 3 * 2),
        ("pca", ("--samples", 40), 40),
    ],
)
def test_the_designs_that_progress_expects_are_those_that_a_view_evaluates(folder, monkeypatch, view, options, designs):
    """A sweep has its points for each free parameter, of which there are three, a map along each of its axes.

    Where values are chosen, they are the points.
    """
    expected, done = [], []

    @contextmanager
    def watching(total, quiet):
        expected.append(total)
        yield lambda trial, computed: done.append(trial)

    monkeypatch.setattr("jumpcad.cli.explore.watching", watching)
    data("explore", view, *QUICK, *NARROW, *options)
    assert (expected, len(done)) == ([designs], designs)


@pytest.mark.parametrize(
    ("view", "words", "maker", "given"),
    [
        ("sweep", ["--points", 7], "_swept", ("best-ga", 7)),
        ("feasibility", ["--points", 7, "--over", "c_coef,e_coef"], "_mapped", ("best-ga", "c_coef,e_coef", 7)),
        ("pca", ["--samples", 40, "--seed", 3], "_sampled", ("pca", 40, 3)),
    ],
)
def test_a_view_is_of_what_is_asked_for(folder, monkeypatch, view, words, maker, given):
    """And its study is known by that, so that another question does not go on with it."""
    asked, identities = [], []
    monkeypatch.setattr(explore, maker, lambda *values: asked.append(values))

    def stop(path, identity):
        identities.append(identity)
        raise JumpcadError("enough")

    monkeypatch.setattr("jumpcad.search.study.store.StudyStore.write", stop)
    if view != "pca":
        words, given = [*words, "--around", given[0]], (load_design(given[0]), *given[1:])
    assert "enough" in refusal("explore", view, *QUICK, *words)
    assert asked == [given]
    around = load_design(explore.AROUND if view == "pca" else "best-ga").model_dump()
    seed = 3 if view == "pca" else 0
    assert [(one["method"], one["around"], one["seed"]) for one in identities] == [(f"explore {view}", around, seed)]


def test_what_is_chosen_of_a_workshop_is_chosen_of_the_one_that_is_named(folder, monkeypatch):
    asked = []

    def stop(*_, workshop=None):
        asked.append(workshop)
        raise JumpcadError("enough")

    monkeypatch.setattr("jumpcad.search.space.Space.parse", stop)
    assert "enough" in refusal("explore", "sweep", "--workshop", "fine")
    assert asked == [load_workshop("fine")]


def test_views_tell_in_json_what_they_looked_at(folder):
    """A map has a verdict for every pair of values of its axes; choices that are names are told by them."""
    found = data("explore", "feasibility", *QUICK, "--points", 3, "--over", "rest_angle_deg,compression_ratio")
    x, y = found["x"], found["y"]
    assert (x["name"], y["name"]) == ("rest_angle_deg", "compression_ratio")
    assert (x["values"], y["values"]) == ([20.0, 45.0, 70.0], pytest.approx([0.1, 0.45, 0.8]))
    assert [len(line) for line in found["verdicts"]] == [3, 3, 3]
    assert {word for line in found["verdicts"] for word in line} > {"jump"}
    swept = data("explore", "sweep", *QUICK, *NARROW, "--points", 3)["sweeps"]
    assert list(swept) == ["compression_ratio", "rest_angle_deg", "stiffness_nmm_per_deg"]
    for rows in swept.values():
        assert [row["value"] for row in rows] == sorted(row["value"] for row in rows)
        assert all((row["score"] is not None) == (row["verdict"] == "jump") for row in rows)
    views = data("explore", "pca", *QUICK, *NARROW, "--samples", 40)
    for name in ("sampled", "elite"):
        assert sum(views[name]["shares"]) == pytest.approx(1.0)
        assert np.array(views[name]["directions"]).shape == (3, 3)
    assert views["parameters"] == list(swept)
    shares = data("explore", "importance", *QUICK, *NARROW, "--samples", 80)["importance"]
    assert set(shares) == set(swept)
    assert list(shares.values()) == sorted(shares.values(), reverse=True)
    assert views["sampled"]["designs"] == 40 >= views["elite"]["designs"] > 0


def test_a_map_tells_each_axis_by_its_own_values(monkeypatch):
    """Choices that are names by them; a verdict for every place, and how often each reason was."""

    def trial(*reasons):
        return SimpleNamespace(evaluation=SimpleNamespace(reasons=reasons))

    trials = [[trial(), trial("tips", "loop")], [trial(), trial()], [trial("tips"), trial()]]
    names, numbers = ("one", "two", "three"), [1.5, 2.5]
    asked = []
    for turned in (False, True):
        x, y = ((), names) if not turned else (names, ())
        found = SimpleNamespace(x_name="a", y_name="b", x=numbers, y=numbers, x_names=x, y_names=y, trials=trials)
        monkeypatch.setattr(
            "jumpcad.search.explore.feasibility_map", lambda *given, told=found: asked.append(given) or told
        )
        data, lines, _ = explore._mapped("centre", " a , b", 3)("evaluator")
        assert (data["x"]["values"], data["y"]["values"]) == ((names, numbers) if turned else (numbers, names))
        assert (data["x"]["name"], data["y"]["name"]) == ("a", "b")
        assert data["verdicts"] == [["jump", "tips loop"], ["jump", "jump"], ["tips", "jump"]]
        assert [line.split(maxsplit=1) for line in lines] == [["4", "jump"], ["1", "tips loop"], ["1", "tips"]]
    assert asked == [("evaluator", "centre", "a", "b", 3)] * 2
    for names in ("a", "a,b,c"):
        with pytest.raises(JumpcadError, match="a map has two parameters"):
            explore._mapped("centre", names, 3)


def test_a_sweep_tells_the_least_and_the_largest_score_and_how_many_jump(monkeypatch):
    """Wherever along the parameter they are; choices that are names by them."""

    def trial(score):
        """A robot that jumps may still be rejected by a limit."""
        rejected = ("leg_strength",) if score is None else ()
        return SimpleNamespace(score=score, evaluation=SimpleNamespace(verdict="jump", reasons=rejected))

    scores = [0.5, None, 2.25, 0.125, 1.0]
    sweeps = [
        Sweep("a", np.array([1.0, 2.0, 3.0, 4.0, 5.0]), [trial(score) for score in scores]),
        Sweep("b", np.array([0.0, 1.0]), [trial(None), trial(None)], ("one", "two")),
    ]
    monkeypatch.setattr("jumpcad.search.explore.sweep", lambda *given: sweeps)
    data, lines, _ = explore._swept("centre", 5)("evaluator")
    first, second = data["sweeps"]["a"], data["sweeps"]["b"]
    assert [row["value"] for row in first] == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert [row["score"] for row in first] == scores
    assert [row["verdict"] for row in first] == ["jump"] * 5
    assert [row["reasons"] for row in first] == [(), ("leg_strength",), (), (), ()]
    assert [row["value"] for row in second] == ["one", "two"]
    assert [" ".join(line.split()) for line in lines] == [
        "a 0.1250 … 2.2500 feasible at 4 of 5 values", "b never feasible feasible at 0 of 2 values",
    ]  # fmt: skip


def test_components_say_whose_parts_they_are(monkeypatch):
    """A column of the directions belongs to a parameter; the text shows three components of the best designs."""
    directions = np.array([[0.6, 0.8, 0.0, 0.0], [-0.8, 0.6, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
    names, shares = ("a", "b", "c", "d"), np.array([0.5, 0.25, 0.125, 0.125])
    elite = SimpleNamespace(names=names, shares=shares, directions=directions, designs=1)
    whole = SimpleNamespace(names=names, shares=shares[::-1], directions=np.eye(4), designs=3)
    monkeypatch.setattr("jumpcad.search.explore.sample", lambda *given: ["one", "two", "three"])
    monkeypatch.setattr("jumpcad.search.explore.elite", lambda trials: trials[:1])
    views = {("evaluator", 1): elite, ("evaluator", 3): whole}
    monkeypatch.setattr("jumpcad.search.explore.components", lambda given, trials: views[given, len(trials)])
    data, lines, _ = explore._sampled("pca", 30, 5)("evaluator")
    assert [line.split() for line in lines[1:3]] == [
        ["sampled", "(3", "designs):", "0.125", "0.125", "0.250", "0.500"],
        ["elite", "(1", "design):", "0.500", "0.250", "0.125", "0.125"],
    ]
    assert (data["sampled"]["directions"] == whole.directions).all()
    assert (data["elite"]["directions"] == elite.directions).all()
    assert data["parameters"] == names
    assert [line.split() for line in lines[-5:-1]] == [
        ["a", "+0.600", "-0.800", "+0.000"], ["b", "+0.800", "+0.600", "+0.000"], ["c", "+0.000", "+0.000", "+1.000"],
        ["d", "+0.000", "+0.000", "+0.000"],
    ]  # fmt: skip


def test_importance_is_that_of_all_that_was_sampled_the_largest_first(monkeypatch):
    """Only the components have a view of the best designs alone."""
    asked = []
    found = SimpleNamespace(
        names=("a", "b", "c"), mean=np.array([0.1, 0.7, 0.4]), deviation=np.array([0.01, 0.02, 0.03]), r_squared=0.9,
        designs=3,
    )  # fmt: skip
    monkeypatch.setattr("jumpcad.search.explore.sample", lambda *given: asked.append(given) or ["one", "two", "three"])
    monkeypatch.setattr("jumpcad.search.explore.elite", lambda trials: trials[:1])
    monkeypatch.setattr("jumpcad.search.explore.importance", lambda *given: asked.append(given) or found)
    data, lines, _ = explore._sampled("importance", 30, 5)("evaluator")
    assert asked == [("evaluator", 30, 5), ("evaluator", ["one", "two", "three"], 5)]
    assert list(data["importance"].items()) == [("b", 0.7), ("c", 0.4), ("a", 0.1)]
    assert data["deviation"] == {"b": 0.02, "c": 0.03, "a": 0.01}
    assert [line.split()[:4] for line in lines[:3]] == [
        ["b", "0.700", "±", "0.020"], ["c", "0.400", "±", "0.030"], ["a", "0.100", "±", "0.010"],
    ]  # fmt: skip
    assert "(3 of 3 designs jump)" in lines[3]


def test_what_cannot_be_written_is_told_before_anything_is_evaluated(folder, monkeypatch):
    """Nor is a file replaced that is read, or that somebody made."""
    monkeypatch.setattr("jumpcad.search.study.store.StudyStore.write", lambda *_: pytest.fail("begun"))
    (folder / "own.toml").write_text(load_design("best-ga").to_toml())
    (folder / "pics").mkdir()
    (folder / "pics" / "pca.svg").write_text("<svg/>")
    for words, said in (
        (("sweep", "--around", "own.toml", "--study", "own.toml"), "--study own.toml: is --around itself"),
        (("sweep", "--study", "s.sqlite"), "a study file must end in .db"),
        (("pca", "--plots", "pics"), "pics/pca.svg: exists already"),
    ):
        assert said in refusal("explore", *words, *QUICK)


def test_what_is_not_said_of_a_view_is_what_the_reference_says(folder, monkeypatch):
    asked = []
    for maker in ("_swept", "_mapped", "_sampled"):
        monkeypatch.setattr(explore, maker, lambda *values: asked.append(values))

    def stop(*_):
        raise JumpcadError("enough")

    monkeypatch.setattr("jumpcad.search.study.store.StudyStore.write", stop)
    for view in ("sweep", "feasibility", "pca"):
        assert "enough" in refusal("explore", view, *QUICK)
    around, over = load_design(told_default("explore", "--around")), told_default("explore", "--over")
    points, samples = (int(told_default("explore", option)) for option in ("--points", "--samples"))
    assert asked == [(around, points), (around, over.replace(", ", ","), points), ("pca", samples, 0)]
