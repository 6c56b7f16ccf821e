"""The stages of the published study, one after the other.

Random designs; runs of the genetic algorithm with the study's settings; from the most efficient of their best designs,
Bayesian optimisation in its two modes, two parameters over their whole range and all parameters in a small one; at the
end the links alone, with the spring unchanged. The study gives no numbers of evaluations for the stages: the shares
here are a judgement.
"""

from dataclasses import replace

import numpy as np

from jumpcad.search.fronts import energy_j
from jumpcad.search.propose.bayesian import run_bayesian
from jumpcad.search.propose.genetic import run_genetic
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.request import Stage, default_initial
from jumpcad.search.study.trial import Trial, best_trial

RUNS = 3
"""Runs of the genetic algorithm."""
EXPLORED, EVOLVED = 0.15, 0.51
"""Shares of the evaluations for the random designs, and for all runs of the genetic algorithm; the three searches near
its best design have equal shares of the rest."""
FEW = ("rest_angle_deg", "compression_ratio")
"""The two parameters of the first mode: the most important ones (permutation importance)."""
LINKS = ("carrying_link_mm", "c_coef", "d_coef", "e_coef")
NEAR_PERCENT = 10.0
"""Of each range, to either side, in the second mode."""


def run_paper(evaluator: Evaluator, stage: Stage) -> None:
    """Run the stages; each ends with its share of the evaluations."""
    space, start = evaluator.space, len(evaluator.trials)
    explored = int(EXPLORED * stage.evaluations)
    points = np.random.default_rng([stage.request.seed, 8]).random((explored, space.dimension))
    evaluator.evaluate([space.to_variant(point) for point in space.drawn(points)], "sample", 0)
    best: list[Trial] = []
    for run, seed in enumerate(seeds(stage.request.seed)):
        before = len(evaluator.trials)
        share = int(EVOLVED * stage.evaluations / RUNS)
        genetic = replace(stage.request, method="ga", seed=seed, preset="published")
        run_genetic(evaluator, Stage(genetic, "ga", share, run=run))
        found = best_trial(evaluator.trials[before:])
        best += [found] if found else []
    most = max(best, key=lambda one: (one.score or 0.0) / energy_j(one.design), default=None)
    centre = most or best_trial(evaluator.trials)
    if centre is None:
        return
    for mode, (names, percent) in enumerate(((FEW, None), ((), NEAR_PERCENT), (LINKS, None))):
        left, whole = stage.evaluations - (len(evaluator.trials) - start), evaluator.request
        share, inner = left // (3 - mode), space.near(centre.variant, names, percent)
        if inner is None or share <= 0:
            continue
        evaluator.request = replace(whole, space=inner, start=(), around=None)
        part = replace(stage, evaluations=share, initial=default_initial(inner, share), run=mode)
        try:
            run_bayesian(evaluator, part, polls=False)
        finally:
            evaluator.request = whole
        centre = best_trial([centre, *(one for one in evaluator.trials if inner.contains(one.variant))]) or centre


def seeds(seed: int) -> list[int]:
    """Return the seeds of the runs of the genetic algorithm: other ones for every seed of a search."""
    return [int(one) for one in np.random.SeedSequence([seed, 9]).generate_state(RUNS)]
