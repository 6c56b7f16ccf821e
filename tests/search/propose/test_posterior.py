"""What is learned of score and limits: improvement against numerical integration, feasibility against drawing."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm
from support.hills import SMALL, Hill

from jumpcad.findings import Finding
from jumpcad.search.propose.posterior import VERDICT, SearchPosterior, constraint_margins, forwards, warped
from jumpcad.search.propose.surrogate import Surrogate
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial


def rows_of(count, model=None):
    points = SMALL.spread(count, np.random.default_rng(0))
    found = []
    for place, point in enumerate(points):
        design = SMALL.to_design(point)
        evaluation = (model or Hill())(design)
        score = evaluation.metrics.get("fitness") if evaluation.feasible else None
        found.append(Trial("bo", 0, place, design, evaluation, score, "m", 0.0))
    return found


def test_expected_improvement_is_the_integral_over_the_posterior():
    posterior = SearchPosterior.from_trials(SMALL, rows_of(24), {}, True)
    points = SMALL.spread(8, np.random.default_rng(5))
    mean, deviation = posterior.score.predict(points)
    for best in (1.0, 8.0, 12.0):
        found = np.exp(posterior.log_improvement(points, best))
        for value, m, s in zip(found, mean, deviation, strict=True):
            target = float(warped(best))
            integral = quad(
                lambda y, m=m, s=s, target=target: (y - target) * norm.pdf(y, m, s), target, max(target, m) + 12 * s
            )[0]
            assert value == pytest.approx(integral, rel=1e-4, abs=1e-14)


def test_improvement_keeps_its_slope_far_below_the_best():
    posterior = SearchPosterior.from_trials(SMALL, rows_of(24), {}, True)
    points = SMALL.spread(8, np.random.default_rng(5))
    far = [posterior.log_improvement(points, best) for best in (1e2, 1e4, 1e6, 1e8)]
    assert np.isfinite(far).all()
    assert (np.diff(far, axis=0) < 0).all()


def test_probability_of_feasibility_learns_the_border():
    posterior = SearchPosterior.from_trials(SMALL, rows_of(64), {}, True)
    border = [parameter.name for parameter in SMALL.free].index("compression_ratio")
    points = SMALL.spread(256, np.random.default_rng(7))
    ratio = 0.1 + 0.7 * points[:, border]
    probability = np.exp(posterior.log_feasible(points))
    assert probability[ratio < 0.65].min() > 0.9
    assert probability[ratio > 0.75].max() < 0.1


def test_margins_of_constraints_that_refuse():
    trials = rows_of(40)
    margins = constraint_margins(trials)
    assert set(margins) == {"loop", VERDICT}
    assert margins["loop"] == pytest.approx([0.7 - trial.design.compression_ratio for trial in trials])
    assert set(margins[VERDICT]) == {1.0, -1.0}
    assert constraint_margins([trial for trial in trials if trial.score is not None]) == {}


def test_a_margin_that_an_early_refusal_leaves_unknown_is_left_out():
    def two_gates(design):
        if design.rest_angle_deg < 40.0:
            return Evaluation("below_ground", {}, (Finding("below_ground", "error", -1.0, "mm", "", ""),))
        return Hill()(design)

    trials = rows_of(40, two_gates)
    margins = constraint_margins(trials)
    flat = np.array([trial.design.rest_angle_deg < 40.0 for trial in trials])
    assert (np.isnan(margins["loop"]) == flat).all()
    SearchPosterior.from_trials(SMALL, trials, {}, True)


def test_nothing_feasible_yet_leaves_feasibility_to_decide():
    trials = [trial for trial in rows_of(64) if trial.score is None]
    posterior = SearchPosterior.from_trials(SMALL, trials, {}, True)
    assert posterior.score is None
    assert (posterior.log_improvement(np.full((2, 3), 0.5), 0.0) == 0.0).all()


def test_a_jump_backwards_counts_as_none_once_something_jumps_forwards():
    some, none = np.array([2.0, -3.0, 0.5]), np.array([-2.0, -3.0])
    assert forwards(some, some).tolist() == [2.0, 0.0, 0.5]
    assert forwards(none, none).tolist() == [-2.0, -3.0]  # as for energies, of which less is better
    assert forwards(none, some).tolist() == [0.0, 0.0]  # guesses are treated as what they are compared with
    assert forwards(some, none).tolist() == some.tolist()


def test_guesses_that_are_wrong_by_a_constant_tell_the_scores_elsewhere():
    """Four measured scores and forty guesses, each a quarter of a root too low, know the hill; four alone do not."""
    trials = [trial for trial in rows_of(64) if trial.score is not None]
    guesses = {
        one.key: (SMALL.to_unit(one.variant), (np.sqrt(one.score) - 0.25) ** 2) for one in trials if one.score > 1
    }
    known = [one for one in trials if one.key in guesses]
    measured, others = known[:4], known[4:]
    points = np.array([SMALL.to_unit(one.variant) for one in others])
    exact = np.sqrt([one.score for one in others])

    def error(posterior):
        mean, _ = posterior.score.predict(points)
        more = 0.0 if posterior.guess is None else posterior.guess.predict(points)[0]
        return np.abs(mean + more - exact).max()

    alone = SearchPosterior.from_trials(SMALL, measured, {}, True)
    guided = SearchPosterior.from_trials(SMALL, measured, {}, True, guesses)
    assert error(guided) < 0.05 < 0.5 < error(alone)
    assert set(guided.thetas) == {"guess", "more"}
    parts = [one.predict(points) for one in (guided.score, guided.guess)]
    mean = parts[0][0] + parts[1][0]
    deviation = np.sqrt(parts[0][1] ** 2 + parts[1][1] ** 2 + guided.score.scatter**2)
    z = (mean - 2.0) / deviation
    promised = deviation * (norm.pdf(z) + z * norm.cdf(z))  # over a score of 4
    assert np.exp(guided.log_improvement(points, 4.0)) == pytest.approx(promised, rel=1e-6, abs=1e-12)
    fewer = dict(list(guesses.items())[4:])  # of no trial that was measured
    assert SearchPosterior.from_trials(SMALL, measured, {}, True, fewer).guess is None


def test_a_believed_proposal_is_believed_of_every_limit_and_of_the_score():
    x, theta = SMALL.spread(12, np.random.default_rng(0)), [0.0, -1.0, -1.0, -1.0, -6.0]
    score, limit, other = (Surrogate(x, x[:, axis], theta, fit=False) for axis in range(3))
    point = np.array([0.31, 0.42, 0.53])
    after = SearchPosterior(score, {"loop": limit, "tips": other}).condition_on(point)
    assert after.guess is None
    pairs = ((score, after.score), (limit, after.constraints["loop"]), (other, after.constraints["tips"]))
    for before, then in pairs:
        assert then.predict(point[None])[0] == pytest.approx(before.predict(point[None])[0])
        assert then.predict(point[None])[1] < before.predict(point[None])[1]


def test_a_score_is_learned_from_two_jumps_on():
    trials = [trial for trial in rows_of(24) if trial.score is not None]
    known = [SearchPosterior.from_trials(SMALL, trials[:count], {}, True).score for count in (1, 2)]
    assert known[0] is None
    assert known[1].predict(np.array([SMALL.to_unit(trials[0].variant)]))[0] == pytest.approx(
        np.sqrt(trials[0].score), rel=0.01
    )
