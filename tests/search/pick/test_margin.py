"""Proposals at a distance from a constraint."""

from dataclasses import dataclass

import numpy as np
import pytest
from support.hills import SMALL, Hill

from jumpcad.search.pick.margin import propose_robust
from jumpcad.search.pick.robust import rank_candidates
from jumpcad.search.pick.tolerances import LENGTHS_ALONE
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.variant import Variant


@dataclass(frozen=True)
class Cliff(Hill):
    """Fitness grows with the compression ratio up to 0.7, above which designs are rejected (`loop`)."""

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
    best, *_ = ranked = rank_candidates(one, one.trials, seed=0, making=LENGTHS_ALONE, evaluations=200)
    assert best.trial.phase == "margin"
    # 1 % above it is still feasible, and it gives away no more than twice what that costs.
    assert 0.98 * 0.7 < best.trial.design.compression_ratio < 0.7 / 1.008
    assert best.rejections.get("loop", 0) <= 1
    safer = [trial.design.compression_ratio for trial in one.trials if trial.phase == "margin"][:3]
    assert 0.7 > safer[0] > safer[1] > safer[2]  # more confidence keeps farther off
    # Of those on the edge every second neighbour is rejected; a few may be lucky while few are known.
    edge = [one for one in ranked if one.trial.design.compression_ratio > 0.6985]
    assert all(one.neighbours < best.neighbours for one in edge)
    assert all(one.robust_score < 5.0 for one in edge if one.neighbours >= 8)


@pytest.mark.thorough
def test_proposals_off_an_edge_follow_from_the_seed(evaluator):
    points = SMALL.spread(16, np.random.default_rng(1))
    runs = []
    for seed in (0, 0, 1):
        one = evaluator(model=Cliff())
        one.evaluate([SMALL.to_design(point) for point in points], "bo", 0)
        runs.append([trial.key for trial in propose_robust(one, one.trials, 0, seed, 0.01)])
    assert len(runs[0]) == 3
    assert runs[0] == runs[1] != runs[2]


def test_only_what_was_made_as_the_space_says_is_learned_from(evaluator):
    """Not designs of other values of what is fixed, above or below, nor ones that were made otherwise than designed."""
    points = SMALL.spread(16, np.random.default_rng(1))
    runs = []
    for others in (False, True):
        one = evaluator(model=Cliff())
        own = one.evaluate([SMALL.to_design(point) for point in points], "bo", 0)
        if others:
            designs = [trial.design for trial in own[:4]]
            changed = [
                design.model_copy(update={"carrying_link_mm": length}) for design in designs for length in (90, 110)
            ]
            made = [Variant(design, {"process.infill": 0.3}) for design in designs]
            one.evaluate([*changed, *made], "bo", 1)
        runs.append([trial.key for trial in propose_robust(one, own, 2, 0, 0.01)])
    assert len(runs[0]) == 3
    assert runs[0] == runs[1]
