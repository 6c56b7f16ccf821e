"""What a calibration says of a robot that it has not seen: its jump with an interval, beside what was measured."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from jumpcad.calibration.likelihood import TAILS, Datum, Model, Predicted, energy_per_mass, predict
from jumpcad.calibration.posterior import SHARES, Posterior
from jumpcad.calibration.subject import Subject
from jumpcad.calibration.surface import ENERGY
from jumpcad.transforms import Array

FLOORS_TRIED = 101


@dataclass(frozen=True, repr=False)
class Prediction:
    """A robot's jump at the draws of a calibration; what is the robot's own is drawn from its priors."""

    subject: Subject
    values: dict[str, Array]
    generator: np.random.Generator

    @cached_property
    def predicted(self) -> Predicted:
        """What it does at every draw."""
        return predict(self.subject, self.values)

    @property
    def jumps_share(self) -> float:
        """Share of the draws in which it jumps."""
        return float(np.isfinite(self.predicted.jump.range_m).mean())

    def quantiles(self) -> dict[str, list[float]]:
        """Return quantiles of the jump itself, without errors of measuring; a draw without a jump counts 0."""
        found = {
            "ballistic_range_m": self.predicted.of("distance", "centre-of-mass"),
            "touchdown_distance_m": self.predicted.of("distance", "first-touchdown"),
            "com_rise_m": self.predicted.of("height", "rise"),
        }
        return {name: np.quantile(np.nan_to_num(value), SHARES).tolist() for name, value in found.items()}

    def beside(self) -> list[dict[str, Any]]:
        """Return each measurement of the robot under each of its readings, with the interval predicted for it."""
        data = Model([self.subject]).data
        return [self._beside(datum, reading) for datum in data for reading in datum.readings]

    def _beside(self, datum: Datum, reading: str) -> dict[str, Any]:
        value = self.predicted.of(datum.what, reading)
        noise = self.generator.standard_t(TAILS, len(value)) if datum.what == "distance" else None
        noise = self.generator.standard_normal(len(value)) if noise is None else noise
        seen = np.nan_to_num(value + noise * self.predicted.deviation(datum, reading, value))
        return {
            "what": datum.what,
            "as": reading,
            "measured": datum.value,
            "predicted": np.quantile(seen, SHARES).tolist(),
            "below_share": float((seen < datum.value).mean()),
        }


def predicted_jump(posterior: Posterior, subject: Subject, seed: int = 0) -> Prediction:
    """Return the jump of a robot that was not calibrated on; only its priors count, not its jumps."""
    generator = np.random.default_rng([seed, 1])
    draws = len(posterior.z)
    values = dict(posterior.values)
    for one in Model([subject]).parameters:
        own = one.key.endswith(f":{subject.name}") and not one.key.startswith("rate:")
        if own or one.key not in values:
            values[one.key] = one.prior.at(generator.standard_normal(draws))
    return Prediction(subject, values, generator)


@dataclass(frozen=True)
class Explanation:
    """A change of one property alone that makes a robot jump as far as measured; None where none does."""

    what: str
    predicted: float
    needed: float | None
    unit: str


def explanations(prediction: Prediction, distance_m: float) -> list[Explanation]:
    """Return what would have to differ for a robot to reach a distance, one property at a time, at the median draw."""
    subject, surface = prediction.subject, prediction.subject.surface
    values = {key: np.array([float(np.median(value))]) for key, value in prediction.values.items()}
    energy = float(energy_per_mass(subject, values)[0])
    pins, floor = float(values["pin_friction"][0]), float(values[f"floor:{subject.name}"][0])
    energies = np.geomspace(ENERGY[0], ENERGY[-1], 400)
    ranges = surface.at(energies, np.full(400, pins), np.full(400, floor)).range_m
    needed = _crossing(energies, ranges, distance_m)
    mass = float(values[f"mass:{subject.name}"][0]) * 1000.0 * subject.robot.mass_kg
    rate = subject.rate_nmm_per_deg * float(values[f"rate:{subject.pair}"][0])
    floors = np.linspace(0.2, 1.3, FLOORS_TRIED)
    by_floor = surface.at(np.full(FLOORS_TRIED, energy), np.full(FLOORS_TRIED, pins), floors).range_m
    touchdown = float(surface.at(np.array([energy]), np.array([pins]), np.array([floor])).range_m[0])
    touchdown += subject.beyond_m[0]
    return [
        Explanation("energy of the springs over mass, over the model's", energy, needed, ""),
        Explanation("mass, all else as predicted", mass, needed and mass * energy / needed, "g"),
        Explanation("spring rate, all else as predicted", rate, needed and rate * needed / energy, "N·mm/°"),
        Explanation("friction of the floor", floor, _crossing(floors, by_floor, distance_m), ""),
        Explanation("travel after landing", 0.0, 1000.0 * max(distance_m - touchdown, 0.0), "mm"),
    ]


def growth(posterior: Posterior, name: str, prediction: Prediction) -> Array:
    """Return how many times the range of a calibrated robot the predicted one jumps (draws,); NaN without a jump."""
    times: Array = prediction.predicted.jump.range_m / posterior.predicted[name].jump.range_m
    return times


def _crossing(at: Array, values: Array, goal: float) -> float | None:
    """Return where growing values pass a goal; None if they do not."""
    known = np.isfinite(values)
    if not known.any() or not values[known].min() <= goal <= values[known].max():
        return None
    index = int(np.argmax(np.where(known, values, -math.inf) >= goal))
    return float(at[index])
