"""Prediction for a robot that was not calibrated on: its jump with an interval, beside its measurements."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from jumpcad.calibration.likelihood import (
    STUDENT_T_DEGREES,
    CalibrationModel,
    Datum,
    Predicted,
    energy_per_mass,
    predict,
)
from jumpcad.calibration.posterior import CalibrationPosterior
from jumpcad.calibration.priors import QUANTILES
from jumpcad.calibration.subject import Subject
from jumpcad.calibration.surface import ENERGY
from jumpcad.transforms import Array

FLOORS_TRIED = 101
"""Coefficients of friction, of which one that explains a distance is chosen."""


@dataclass(frozen=True, repr=False)
class Prediction:
    """A robot's jump at the draws of a calibration; the robot's own parameters are drawn from their priors.

    `values` has the parameters (draws,) by key, `generator` draws measurement errors.
    """

    subject: Subject
    values: dict[str, Array]
    generator: np.random.Generator

    @cached_property
    def predicted(self) -> Predicted:
        """What the robot does at every draw."""
        return predict(self.subject, self.values)

    @property
    def jumps_share(self) -> float:
        """Share of the draws at which the robot jumps."""
        return float(np.isfinite(self.predicted.jump.range_m).mean())

    def quantiles(self) -> dict[str, list[float]]:
        """Return quantiles (10, 50, 90 %) of the jump (m) without measurement error; no jump counts as 0."""
        found = {
            "ballistic_range_m": self.predicted.of("distance", "centre-of-mass"),
            "touchdown_distance_m": self.predicted.of("distance", "first-touchdown"),
            "com_rise_m": self.predicted.of("height", "rise"),
        }
        return {name: np.quantile(np.nan_to_num(value), QUANTILES).tolist() for name, value in found.items()}

    def beside(self) -> list[dict[str, Any]]:
        """Return each measurement of the robot under each of its readings, with predicted quantiles, errors included.

        Calls continue the generator: two calls differ.
        """
        data = CalibrationModel([self.subject]).data
        return [self._beside(datum, reading) for datum in data for reading in datum.readings]

    def _beside(self, datum: Datum, reading: str) -> dict[str, Any]:
        value = self.predicted.of(datum.what, reading)
        noise = self.generator.standard_t(STUDENT_T_DEGREES, len(value)) if datum.what == "distance" else None
        noise = self.generator.standard_normal(len(value)) if noise is None else noise
        seen = np.nan_to_num(value + noise * self.predicted.deviation(datum, reading, value))
        return {
            "what": datum.what,
            "as": reading,
            "measured": datum.value,
            "predicted": np.quantile(seen, QUANTILES).tolist(),
            "below_share": float((seen < datum.value).mean()),
        }


def predicted_jump(posterior: CalibrationPosterior, subject: Subject, seed: int = 0) -> Prediction:
    """Return the predicted jump of a robot that was not calibrated on; its own measured jumps are not used.

    Its springs are those of a calibrated robot where its measurements name their pair, never by a robot's equal name.
    """
    generator = np.random.default_rng([seed, 1])
    draws = len(posterior.z)
    values = dict(posterior.values)
    shares_springs = subject.measured.spring.pair is not None
    for one in CalibrationModel([subject]).parameters:
        of_springs = one.key == f"rate:{subject.pair}"
        own = not shares_springs if of_springs else one.key.endswith(f":{subject.name}")
        if own or one.key not in values:
            values[one.key] = one.prior.at(generator.standard_normal(draws))
    return Prediction(subject, values, generator)


@dataclass(frozen=True)
class Explanation:
    """A property, its predicted value, and the value at which the robot jumps as far as measured (None: no value)."""

    what: str
    predicted: float
    needed: float | None
    unit: str


def explanations(prediction: Prediction, distance_m: float) -> list[Explanation]:
    """Return the values of single properties at which a robot reaches a distance, all others at their medians."""
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


def growth(posterior: CalibrationPosterior, name: str, prediction: Prediction) -> Array:
    """Return the predicted range over that of a robot that was calibrated on (draws,); NaN without a jump."""
    times: Array = prediction.predicted.jump.range_m / posterior.predicted[name].jump.range_m
    return times


def _crossing(at: Array, values: Array, goal: float) -> float | None:
    """Return the first of `at` (n,) whose value (n,) reaches a goal; None if the goal is outside the values."""
    known = np.isfinite(values)
    if not known.any() or not values[known].min() <= goal <= values[known].max():
        return None
    index = int(np.argmax(np.where(known, values, -math.inf) >= goal))
    return float(at[index])
