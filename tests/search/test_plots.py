"""Pictures of searches show the trials and the surrogate."""

from dataclasses import replace

import numpy as np
import pytest
from support.bumps import REST, studied

from jumpcad.search import plots
from jumpcad.search.explore import Sweep
from jumpcad.search.figures import MEANINGS, PICTURES, panels, save_figure
from jumpcad.search.objective import find_objective
from jumpcad.search.space import Space


def test_the_surrogate_in_the_picture_is_the_bump(tmp_path):
    space = Space.parse(fix=[*REST, "rest_angle_deg=50"])
    with studied(tmp_path / "s.db", space) as store:
        trials = [trial for trial in store.trials() if trial.phase == "bo"]
    from jumpcad.search.posterior import SearchPosterior

    posterior = SearchPosterior.from_trials(space, trials, trials[-1].proposal["theta"], ())
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
    assert len(lines["rejected"]) == len(trials) - len(scores)
    assert np.nanmax(lines["best so far"]) == max(scores)


def test_slices_mark_the_best(tmp_path):
    space = Space.parse(fix=REST)
    with studied(tmp_path / "s.db", space, "ga", 40) as store:
        trials = [trial for trial in store.trials() if trial.phase == "ga"]
    best = max((trial for trial in trials if trial.score is not None), key=lambda trial: trial.score)
    figure = plots.slices(space, trials, find_objective("fitness"))
    for axes, parameter in zip(figure.axes, space.free, strict=False):
        (star,) = axes.lines
        assert (star.get_xdata()[0], star.get_ydata()[0]) == (getattr(best.design, parameter.name), best.score)
        assert axes.get_ylabel().split() == ["range", "over", "the", "longest", "link", "(body", "lengths)"]


@pytest.mark.parametrize("ratio", [0.4, 0.7, 0.95], ids=["between two", "beside a rejected one", "outside"])
def test_sweeps_show_the_centre_without_a_score_that_nobody_computed(tmp_path, ratio):
    """Only the swept designs have a score: the centre is a line through the whole panel, where its value is."""
    with studied(tmp_path / "s.db", Space.parse(fix=REST), "ga", 40) as store:
        best = next(trial for trial in store.trials() if trial.score is not None)
    swept = [replace(best, score=score) for score in (5.0, 9.0, None)]
    centre = best.design.model_copy(update={"compression_ratio": ratio})
    sweep = Sweep("compression_ratio", np.array([0.3, 0.5, 0.8]), swept)
    figure = plots.sweeps([sweep], find_objective("fitness"), centre)
    (axes,) = figure.axes
    drawn = {line.get_label(): line for line in axes.lines}
    assert set(drawn) == {text.get_text() for text in figure.legends[0].get_texts()}
    assert list(drawn.pop("centre design").get_xdata()) == [ratio, ratio]
    low, high = axes.get_xlim()
    assert low < ratio < high
    points = [(x, y) for line in drawn.values() for x, y in zip(line.get_xdata(), line.get_ydata(), strict=True)]
    assert [point for point in points if np.isfinite(point[1])] == [(0.3, 5.0), (0.5, 9.0), (0.8, 0.0)]


def test_every_picture_says_what_it_means(tmp_path):
    assert set(MEANINGS) == set(PICTURES)
    figure, _ = panels(1)
    save_figure(figure, tmp_path, "history")
    said = " ".join(figure.get_supxlabel().split())
    assert said == MEANINGS["history"]
