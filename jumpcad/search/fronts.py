"""Fronts of score against spring energy: the trials on a front, and a measure of the whole front."""

import math
from collections.abc import Sequence

import numpy as np

from jumpcad.arguments import typed
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.search.trial import Trial
from jumpcad.transforms import Array

REFERENCE_ENERGY_J = 1.5
"""Energy of the hypervolume's reference point, whose score is 0."""


@typed
def energy_j(design: Design) -> float:
    """Return the energy of a design's loaded springs (J); infinite if it has no assembled pose."""
    try:
        return design.spring_energy_j
    except CannotBuildError:
        return np.inf


def energies_j(values: Array) -> Array:
    """Return the energies (n,) of designs given as vectors (n, 8), as `energy_j` does of each; see `Design`."""
    l2, c, d, _, ratio, rest_deg, stiffness_nmm_per_deg, _ = values.T
    rest, l3, l4 = np.radians(rest_deg), c * l2, d * l2
    rise, surplus = (l3 - l2) * np.sin(rest), l3 - l2
    assembled = l4 > np.maximum(np.abs(rise), surplus)
    # not numpy's arcsine, whose last digit differs between processors
    beta = np.array([math.asin(sine) for sine in np.where(assembled, rise / l4, 0.0).tolist()])
    stiffness = stiffness_nmm_per_deg * 180.0 / np.pi / 1000.0
    energies: Array = np.where(assembled, 0.5 * stiffness * (ratio * (rest + beta)) ** 2, np.inf)
    return energies


@typed
def front(trials: Sequence[Trial]) -> list[Trial]:
    """Return the trials whose positive score no other trial reaches with less energy, sorted by energy."""
    scored = [trial for trial in trials if trial.score is not None]
    best, chosen = 0.0, []
    for trial in sorted(scored, key=lambda trial: (energy_j(trial.design), -(trial.score or 0.0))):
        if trial.score is not None and trial.score > best:
            best = trial.score
            chosen.append(trial)
    return chosen


@typed
def hypervolume(trials: Sequence[Trial], reference_energy_j: float = REFERENCE_ENERGY_J) -> float:
    """Return the area that a front dominates, from score 0 and the reference energy (score units times J)."""
    chosen = [trial for trial in front(trials) if energy_j(trial.design) < reference_energy_j]
    ends = [energy_j(trial.design) for trial in chosen[1:]] + [reference_energy_j]
    return sum((trial.score or 0.0) * (end - energy_j(trial.design)) for trial, end in zip(chosen, ends, strict=False))
