"""Pictures of searches show the trials and the surrogate."""

from dataclasses import replace

import numpy as np
import pytest
from support.bumps import REST, studied
from support.hills import SMALL

from jumpcad.findings import Finding
from jumpcad.search.explore import FeasibilityMap, Importance, Sweep
from jumpcad.search.fronts import energy_j
from jumpcad.search.report import plots
from jumpcad.search.report.figures import PICTURES, panels, report_words, save_figure
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.trial import Trial


def test_the_surrogate_in_the_picture_is_the_bump(tmp_path):
    space = Space.parse(fix=[*REST, "rest_angle_deg=50"])
    with studied(tmp_path / "s.db", space) as store:
        trials = [trial for trial in store.trials() if trial.phase == "bo"]
    from jumpcad.search.propose.posterior import SearchPosterior

    posterior = SearchPosterior.from_trials(space, trials, trials[-1].proposal["theta"], False)
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
    (line,) = (line for line in axes.lines if line.get_label() == "best so far")
    assert list(line.get_xdata()) == list(range(1, len(trials) + 1))


def test_slices_mark_the_best(tmp_path):
    space = Space.parse(fix=REST)
    with studied(tmp_path / "s.db", space, "ga", 40) as store:
        trials = [trial for trial in store.trials() if trial.phase == "ga"]
    best = max((trial for trial in trials if trial.score is not None), key=lambda trial: trial.score)
    figure = plots.slices(space, trials, find_objective("fitness"))
    for axes, parameter in zip(figure.axes, space.free, strict=False):
        (star,) = axes.lines
        assert (star.get_xdata()[0], star.get_ydata()[0]) == (getattr(best.design, parameter.name), best.score)
        assert axes.get_ylabel().split() == ["range", "over", "the", "longest", "link", "(link", "lengths)"]


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
    points = [*zip(*drawn["jumps"].get_data(), strict=True)]
    assert [point for point in points if np.isfinite(point[1])] == [(0.3, 5.0), (0.5, 9.0)]
    assert list(drawn["rejected"].get_xdata()) == [0.8]
    assert axes.get_ylim()[0] > 0.0  # a cross is no score


def test_sweeps_of_several_parameters_have_one_scale(tmp_path):
    with studied(tmp_path / "s.db", Space.parse(fix=REST), "ga", 40) as store:
        best = next(trial for trial in store.trials() if trial.score is not None)
    swept = [[replace(best, score=score) for score in scores] for scores in ((1.0, 2.0), (5.0, 9.0))]
    found = [Sweep("c_coef", np.array([0.5, 0.7]), trials) for trials in swept]
    first, second = plots.sweeps(found, find_objective("fitness")).axes
    assert first.get_ylim() == second.get_ylim()


def trial(unit, score, *reasons):
    """Return a trial at a point of the space of compression ratio, rest angle and stiffness."""
    findings = tuple(Finding(name, "error", -1.0, "mm", "", "") for name in reasons)
    return Trial("ga", 0, 0, SMALL.to_design(unit), Evaluation("jump", {}, findings), score, "m", 0.0)


def test_a_front_is_level_from_each_design_to_the_next_that_takes_more_energy():
    """So that one reads off it the best score that an energy gives."""
    trials = [trial((0.5, 0.5, stiffness), score) for stiffness, score in ((0.9, 3.0), (0.1, 1.0), (0.5, 2.0))]
    trials.append(trial((0.5, 0.5, 0.7), 0.5))
    (axes,) = plots.pareto(trials, find_objective("fitness")).axes
    lines = {line.get_label(): line for line in axes.lines}
    shown = lines["front"]
    assert list(shown.get_xdata()) == [energy_j(trials[index].design) for index in (1, 2, 0)]
    assert (list(shown.get_ydata()), shown.get_drawstyle()) == ([1.0, 2.0, 3.0], "steps-post")
    assert list(lines["other designs"].get_ydata()) == [3.0, 1.0, 2.0, 0.5]


def test_each_importance_has_its_own_error():
    """The largest at the top."""
    mean, deviation = np.array([0.3, 0.1, 0.2]), np.array([0.01, 0.02, 0.03])
    (axes,) = plots.importance(Importance(("a", "b", "c"), mean, deviation, 0.9, 40)).axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["b", "c", "a"]
    assert [bar.get_width() for bar in axes.patches] == pytest.approx([0.1, 0.2, 0.3])
    (errors,) = axes.collections
    ends = [[float(x) for x, _ in segment] for segment in errors.get_segments()]
    assert ends == [pytest.approx(pair) for pair in ([0.08, 0.12], [0.17, 0.23], [0.29, 0.31])]


def test_a_map_has_its_ring_where_the_centre_is_and_a_colour_for_each_first_reason():
    x, y = np.array([0.2, 0.4, 0.6]), np.array([20.0, 60.0])
    rows = [
        [trial((0.5, 0.5, 0.5), 1.0)] * 3,
        [trial((0.5, 0.5, 0.5), None, name) for name in ("tips", "loop", "tips")],
    ]
    centre = SMALL.to_design((0.5, 0.5, 0.5)).model_copy(update={"compression_ratio": 0.4, "rest_angle_deg": 60.0})
    found = FeasibilityMap("compression_ratio", "rest_angle_deg", x, y, rows)
    figure = plots.feasibility(found, centre)
    (axes,) = figure.axes
    assert [(line.get_xdata()[0], line.get_ydata()[0]) for line in axes.lines] == [(0.4, 60.0)]
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert words == ["jump", "loop", "tips", "centre design"]
    assert axes.collections[0].get_array().reshape(2, 3).tolist() == [[0, 0, 0], [2, 1, 2]]


def test_every_picture_says_what_it_means(tmp_path):
    assert set(report_words("pictures")) == set(PICTURES)
    figure, _ = panels(1)
    save_figure(figure, tmp_path, "history")
    said = " ".join(figure.get_supxlabel().split())
    assert said == report_words("pictures")["history"]
