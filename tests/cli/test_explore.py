"""`jumpcad explore`, with the capsule robot."""

import re
from contextlib import contextmanager
from pathlib import Path

import pytest
from support.searches import NARROW, QUICK, data, refusal, run


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
        ("feasibility", ("--points", 3), 3 * 3),
        ("pca", ("--samples", 40), 40),
    ],
)
def test_the_designs_that_progress_expects_are_those_that_a_view_evaluates(folder, monkeypatch, view, options, designs):
    """A sweep has its points for each free parameter, of which there are three, a map along each of its axes."""
    expected, done = [], []

    @contextmanager
    def watching(total, quiet):
        expected.append(total)
        yield lambda trial, computed: done.append(trial)

    monkeypatch.setattr("jumpcad.cli.explore.watching", watching)
    data("explore", view, *QUICK, *NARROW, *options)
    assert (expected, len(done)) == ([designs], designs)
