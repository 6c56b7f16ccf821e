"""The figure p10 of a design that jumps: the score that nine of ten robots reach that are made a little otherwise."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from jumpcad.design import Design
from jumpcad.findings import Finding
from jumpcad.search.objective import COST, QUANTILE, Evaluation, Objective
from jumpcad.search.tolerances import Making, tenth
from jumpcad.search.variant import Variant

NEIGHBOURS = 10
"""Neighbours of a design that the objective p10 looks at, half of each kind."""


def neighbours(design: Design, making: Making) -> list[Variant]:
    """Return neighbours of a design, varied and made otherwise in turn.

    They deviate alike from every design, so that the figure is as smooth as the score.
    """
    varied = making.varied(Variant(design), np.random.default_rng(0))
    made = making.neighbours(Variant(design), np.random.default_rng(1))
    return [one for pair in zip(varied, made, strict=True) for one in pair][:NEIGHBOURS]


def with_neighbours(
    found: Evaluation, beside: Sequence[Variant], evaluate: Callable[[Variant], Evaluation], objective: Objective
) -> Evaluation:
    """Return an evaluation with the figure `p10` of its neighbours by an objective.

    They are evaluated one after the other; the first to be rejected rejects it, and none follows.
    """
    scores: list[float] = []
    for number, neighbour in enumerate(beside, start=1):
        evaluation = evaluate(neighbour)
        score = objective.score(evaluation)
        if score is None:
            reasons = ", ".join(evaluation.reasons)
            failed = Finding(
                "neighbours", "error", (number - 1) / NEIGHBOURS - 1.0, "",
                f"neighbour {number} of {NEIGHBOURS} within the tolerances is rejected: {reasons}",
                "keep away from the limits that reject it",
            )  # fmt: skip
            metrics = {**found.metrics, COST: 1.0 + number}
            return replace(found, metrics=metrics, findings=(*found.findings, failed), detail=reasons)
        scores.append(score)
    passed = Finding("neighbours", "info", 1.0 / NEIGHBOURS, "", "all neighbours jump", "")
    metrics = {**found.metrics, QUANTILE: tenth(scores), COST: 1.0 + NEIGHBOURS}
    return replace(found, metrics=metrics, findings=(*found.findings, passed))
