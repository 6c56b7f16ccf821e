"""Pictures of searches show the trials and the surrogate."""

import numpy as np
import pytest
from support.bumps import REST, studied

from jumpcad.search import plots
from jumpcad.search.objective import find_objective
from jumpcad.search.space import Space


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
    assert len(lines["rejected"]) == len(trials) - len(scores)
    assert np.nanmax(lines["best so far"]) == max(scores)
