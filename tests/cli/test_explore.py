"""`jumpcad explore`, with the capsule robot."""

import re
from pathlib import Path

import pytest
from support.searches import NARROW, QUICK, data, refusal, run

from jumpcad.errors import JumpcadError


@pytest.mark.thorough
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
    base, head, *rows = run("explore", "sweep", *QUICK, "--points", 3).splitlines()
    assert base.endswith("the others are those of best-bo")
    assert re.match(r"parameter +unit +values +score in link lengths +best at +feasible$", head)
    assert re.search(r"^rest_angle_deg +° +20 … 70 +\d+\.\d+ … +\d+\.\d+  (20|45|70) +\d of 3$", "\n".join(rows), re.M)
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

    monkeypatch.setattr("jumpcad.search.robot_model", begun)
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
