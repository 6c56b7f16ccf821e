"""Pictures of searches: complete, and the same bytes for the same data."""

from xml.etree import ElementTree

import numpy as np
import pytest

from jumpcad.design import Design
from jumpcad.search import plots
from jumpcad.search.figures import PICTURES, save_figure
from jumpcad.search.objective import Evaluation, find_objective
from jumpcad.search.pool import local_pool
from jumpcad.search.request import Request
from jumpcad.search.space import Space
from jumpcad.search.store import StudyStore
from jumpcad.search.study import run_study
from jumpcad.search.study_plots import plot_study

REST = [
    "carrying_link_mm=100",
    "c_coef=1",
    "d_coef=0.8",
    "e_coef=0.9",
    "stiffness_nmm_per_deg=20",
    "ground_link_angle_deg=30",
]


class Bump:
    """A bump at a compression ratio of 0.5 and a rest angle of 50°, refused beyond 0.7."""

    digest = "bump"

    def __call__(self, design: Design) -> Evaluation:
        if design.compression_ratio > 0.7:
            return Evaluation("loop")
        height = 9.0 - 20.0 * (design.compression_ratio - 0.5) ** 2 - ((design.rest_angle_deg - 50.0) / 20.0) ** 2
        return Evaluation("jump", {"fitness": height})

    def admits(self, design):
        return True

    def describe(self):
        return {"name": "bump"}

    def versions(self):
        return {}


def studied(path, space, method="bo", evaluations=20):
    with local_pool(0) as pool:
        run_study(Request(space, Bump(), method=method, evaluations=evaluations), path, pool)
    return StudyStore.read(path)


@pytest.mark.parametrize(
    ("fixed", "method", "names"),
    [
        ([*REST, "rest_angle_deg=50"], "bo", {"history", "slices", "acquisition-first", "acquisition"}),
        (REST, "bo", {"history", "slices", "parallel", "acquisition-first", "acquisition"}),
        (REST, "nsga2", {"history", "slices", "parallel", "pareto"}),
    ],
)
def test_a_study_has_its_pictures_and_they_repeat(tmp_path, fixed, method, names):
    with studied(tmp_path / "s.db", Space.parse(fix=fixed), method) as store:
        first = plot_study(store, tmp_path / "a")
        second = plot_study(store, tmp_path / "b")
    assert {path.stem for path in first} == names <= set(PICTURES)
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
        assert ElementTree.parse(one).getroot().tag.endswith("svg")


def test_the_surrogate_in_the_picture_is_the_bump(tmp_path):
    space = Space.parse(fix=[*REST, "rest_angle_deg=50"])
    with studied(tmp_path / "s.db", space) as store:
        trials = [trial for trial in store.trials() if trial.phase == "bo"]
    from jumpcad.search.surrogate import Posterior

    posterior = Posterior.from_trials(space, trials, trials[-1].proposal["theta"], ())
    figure = plots.acquisition(space, trials, posterior, find_objective("fitness"))
    above, below = figure.axes
    curve = next(line for line in above.lines if line.get_label() == "surrogate")
    x, y = np.asarray(curve.get_xdata()), np.asarray(curve.get_ydata())
    seen = np.array([trial.design.compression_ratio for trial in trials if trial.score is not None])
    assert np.interp(seen, x, y) == pytest.approx(9.0 - 20.0 * (seen - 0.5) ** 2, abs=0.05)
    assert abs(x[np.argmax(y)] - 0.5) < 0.01
    gain = np.asarray(below.lines[0].get_ydata())
    assert gain[x > 0.75].max() < 0.05 * max(gain.max(), 1e-12)


def test_history_shows_every_row_and_the_best_so_far(tmp_path):
    with studied(tmp_path / "s.db", Space.parse(fix=REST), "ga", 40) as store:
        trials = [trial for trial in store.trials() if trial.phase == "ga"]
    (axes,) = plots.history(trials, find_objective("fitness")).axes
    lines = {line.get_label(): np.asarray(line.get_ydata()) for line in axes.lines}
    scores = [trial.score for trial in trials if trial.score is not None]
    assert np.isfinite(lines["ga"]).sum() == len(scores)
    assert len(lines["rejected"]) == 40 - len(scores)
    assert np.nanmax(lines["best so far"]) == max(scores)


def test_an_unwritable_folder_is_one_line(tmp_path):
    from jumpcad.errors import JumpcadError
    from jumpcad.search.figures import panels

    (tmp_path / "file").write_text("")
    with pytest.raises(JumpcadError, match="cannot be written"):
        save_figure(panels(1)[0], tmp_path / "file", "x")
