"""Proposals that keep off an edge."""

from dataclasses import dataclass

import numpy as np
from support.hills import SMALL, Hill

from jumpcad.search.objective import Evaluation
from jumpcad.search.robust import rank_candidates


@dataclass(frozen=True)
class Cliff(Hill):
    """Fitness grows with the compression ratio up to 0.7, above which designs are refused (`loop`)."""

    def __call__(self, design):
        evaluation = super().__call__(design)
        fitness = 10.0 * design.compression_ratio + 0.01 * design.stiffness_nmm_per_deg
        return (
            evaluation
            if evaluation.verdict != "jump"
            else Evaluation("jump", {"fitness": fitness}, evaluation.findings)
        )


def test_where_the_best_lie_on_an_edge_the_pick_keeps_off_it(evaluator):
    one = evaluator(model=Cliff())
    points = SMALL.spread(30, np.random.default_rng(1))
    points[:12, 0] = 0.599 / 0.7  # a compression ratio of 0.699
    one.evaluate([SMALL.to_design(point) for point in points], "bo", 0)
    best, *_ = ranked = rank_candidates(one, one.trials, seed=0, tolerance_mm=0.2)
    assert best.trial.phase == "margin"
    # 1 % above it is still feasible, and it gives away no more than twice what that costs.
    assert 0.98 * 0.7 < best.trial.design.compression_ratio < 0.7 / 1.008
    assert best.rejections.get("loop", 0) <= 1
    assert all(other.robust_score < 5.0 for other in ranked if other.trial.design.compression_ratio > 0.699)
