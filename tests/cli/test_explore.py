"""`jumpcad explore`, with the capsule robot."""

import re
from pathlib import Path

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
