"""The posterior of a calibration: sampled by emcee, and compared with the prior."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from jumpcad.arguments import check_arguments
from jumpcad.calibration.likelihood import CalibrationModel, Datum, Predicted, energy_per_mass, predict
from jumpcad.calibration.priors import QUANTILES
from jumpcad.calibration.subject import load_subject, renamed, require_each_once, require_pairs
from jumpcad.errors import JumpcadError
from jumpcad.transforms import Array, ByValue

WALKERS_EACH = 6
"""Walkers for each parameter."""
STEPS, MOST_STEPS = 1500, 12_000
"""First length of the chains, and the length at which they are no longer extended."""
AUTOCORRELATION_TIMES = 50
"""Least length of a chain (Foreman-Mackey et al. 2013; emcee's documentation)."""
KEPT = 20_000
"""Draws that are kept."""
IDENTIFIED, PARTLY = 0.5, 0.85
"""Largest standard deviation of z at which a parameter is identified, or partly; 1 is the prior's."""
CORRELATED = 0.5
"""Least correlation that is reported."""


@dataclass(frozen=True, repr=False, eq=False)
class CalibrationPosterior(ByValue):
    """Draws of a calibration's parameters: `z` (draws, parameters) are standard normals under the prior.

    `autocorrelation` is the longest time (steps), `steps` the length of the `walkers` chains without burn-in.
    """

    model: CalibrationModel
    z: Array
    autocorrelation: float
    steps: int
    walkers: int

    @cached_property
    def values(self) -> dict[str, Array]:
        """The parameters of every draw, by key."""
        return self.model.values(self.z)

    @cached_property
    def predicted(self) -> dict[str, Predicted]:
        """What each robot does at every draw."""
        return {subject.name: predict(subject, self.values) for subject in self.model.subjects}

    @property
    def effective(self) -> float:
        """Effective sample size."""
        return self.steps * self.walkers / self.autocorrelation

    @property
    def converged(self) -> bool:
        """Whether the chains are long enough."""
        return self.steps >= AUTOCORRELATION_TIMES * self.autocorrelation

    def summaries(self) -> list[dict[str, Any]]:
        """Return each parameter's prior and posterior quantiles (10, 50, 90 %), and if the data identify it."""
        deviation = self.z.std(axis=0)
        return [
            {
                "key": one.key, "label": one.label, "prior": list(one.prior.quantiles(QUANTILES)),
                "posterior": np.quantile(self.values[one.key], QUANTILES).tolist(), "spread": float(deviation[index]),
                "verdict": _verdict(float(deviation[index]), float(self.z[:, index].mean())),
                "source": one.prior.source,
            }
            for index, one in enumerate(self.model.parameters)
        ]  # fmt: skip

    def energies(self) -> dict[str, list[float]]:
        """Return, by robot, quantiles of the springs' energy per mass over the model's: jumps determine it best."""
        return {
            subject.name: np.quantile(energy_per_mass(subject, self.values), QUANTILES).tolist()
            for subject in self.model.subjects
        }

    def correlated(self) -> list[tuple[str, str, float]]:
        """Return pairs of correlated parameters with their correlation, strongest first."""
        found = np.atleast_2d(np.corrcoef(self.z, rowvar=False))
        keys = [one.key for one in self.model.parameters]
        strong = np.argwhere(np.triu(np.abs(found) >= CORRELATED, 1)).tolist()
        pairs = [(keys[i], keys[j], float(found[i, j])) for i, j in strong]
        return sorted(pairs, key=lambda pair: -abs(pair[2]))

    def residuals(self) -> list[dict[str, Any]]:
        """Return every measurement with its predicted quantiles and the probability of each reading."""
        return [_residual(datum, self.predicted[datum.subject]) for datum in self.model.data]


@check_arguments
def calibrate(files: Sequence[str | Path], seed: int = 0, landing: bool = False) -> CalibrationPosterior:
    """Calibrate on the measurements of one or several robots: templates' names or TOML files.

    With `landing` the travel after landing is that of simulated landings (MuJoCo), not anything up to some 200 mm.
    """
    if not files:
        raise JumpcadError("no measurements: name at least one file, or the template kenan-1.0")
    require_each_once(files)
    subjects = renamed([load_subject(file) for file in files])
    require_pairs(subjects)
    if landing:
        subjects = [subject.landing() for subject in subjects]
    return sampled(CalibrationModel(subjects), seed)


def sampled(
    model: CalibrationModel, seed: int = 0, steps: int = STEPS, most_steps: int = MOST_STEPS,
    walkers_each: int = WALKERS_EACH,
) -> CalibrationPosterior:  # fmt: skip
    """Sample the posterior of a model; chains of `steps` are doubled until they have converged or have `most_steps`."""
    for subject in model.subjects:
        if not any(datum.subject == subject.name and datum.what != "battery" for datum in model.data):
            raise JumpcadError(
                f"{subject.name}: too little to calibrate on: give at least one [[jumps]] with distance_mm and "
                "distance_of, or one of [[videos]]"
            )
    try:
        import emcee
    except ImportError:
        raise JumpcadError('emcee, the sampler, is not installed: pip install "jumpcad[calibrate]"') from None
    dimension = len(model.parameters)
    walkers = 2 * (walkers_each * dimension // 2)
    sampler = emcee.EnsembleSampler(
        walkers, dimension, model.log_probability, vectorize=True,
        moves=[(emcee.moves.DEMove(), 0.8), (emcee.moves.DESnookerMove(), 0.2)],
    )  # fmt: skip
    generator = np.random.default_rng(seed)
    start = _start(model, walkers, generator)
    state = emcee.State(start, random_state=np.random.RandomState(seed).get_state())  # what emcee takes
    sampler.run_mcmc(state, steps)
    while True:
        burn_in = sampler.iteration // 3
        autocorrelation = float(np.max(sampler.get_autocorr_time(discard=burn_in, tol=0)))
        if not math.isfinite(autocorrelation):
            autocorrelation = float(sampler.iteration)
        left = sampler.iteration - burn_in
        if left >= AUTOCORRELATION_TIMES * autocorrelation or sampler.iteration >= most_steps:
            break
        sampler.run_mcmc(None, sampler.iteration)
    chain = sampler.get_chain(discard=burn_in, flat=True)
    # At random: every n-th draw could be from the same few walkers.
    chosen = np.sort(generator.choice(len(chain), min(KEPT, len(chain)), replace=False))
    return CalibrationPosterior(model, chain[chosen], autocorrelation, left, walkers)


def _start(model: CalibrationModel, walkers: int, generator: np.random.Generator) -> Array:
    """Return starting points (walkers, parameters): the likeliest of many draws from the prior."""
    drawn = generator.standard_normal((100 * walkers, len(model.parameters)))
    chance = model.log_probability(drawn)
    order = np.argsort(-chance, kind="stable")[:walkers]
    if not np.isfinite(chance[order]).all():
        raise JumpcadError(
            "no masses, springs and floors that the priors allow give these jumps: check the units, what distance and "
            "height are of, and weigh the robot"
        )
    return np.array(drawn[order] + 1e-3 * generator.standard_normal((walkers, len(model.parameters))))


def _verdict(spread: float, shift: float) -> str:
    """Return whether the data identify a parameter, from standard deviation and mean of its z."""
    if spread <= IDENTIFIED:
        return "identified"
    return "partly identified" if spread <= PARTLY or abs(shift) >= 1.0 else "stays at its prior"


def _residual(datum: Datum, predicted: Predicted) -> dict[str, Any]:
    """Return one measurement with its predicted quantiles under the most probable reading."""
    chances = CalibrationModel.log_readings(datum, predicted)
    share = np.exp(chances - np.logaddexp.reduce(chances, axis=0)).mean(axis=1)
    likeliest = datum.readings[int(np.argmax(share))]
    value = predicted.of(datum.what, likeliest)
    middle = float(np.median(value))
    deviation = float(np.median(predicted.deviation(datum, likeliest, value)))
    return {
        "robot": datum.subject, "what": datum.what, "of": datum.of, "measured": datum.value,
        "predicted": np.quantile(value, QUANTILES).tolist(), "as": likeliest,
        "readings": dict(zip(datum.readings, share.tolist(), strict=True)),
        "off_by_deviations": (datum.value - middle) / deviation,
    }  # fmt: skip
