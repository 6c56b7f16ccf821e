"""Prediction for a robot that was not calibrated on: its jump with an interval, beside its measurements."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from jumpcad.arguments import check_arguments
from jumpcad.calibration.likelihood import STUDENT_T_DEGREES, CalibrationModel, Datum, Predicted, predict
from jumpcad.calibration.posterior import CalibrationPosterior
from jumpcad.calibration.priors import QUANTILES
from jumpcad.calibration.subject import Subject
from jumpcad.transforms import Array, ByValue


@dataclass(frozen=True, repr=False, eq=False)
class Prediction(ByValue):
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
        count, drawn = len(value), self.generator
        noise = drawn.standard_t(STUDENT_T_DEGREES, count) if datum.what == "distance" else drawn.standard_normal(count)
        seen = np.nan_to_num(value + noise * self.predicted.deviation(datum, reading, value))
        return {
            "what": datum.what,
            "as": reading,
            "measured": datum.value,
            "predicted": np.quantile(seen, QUANTILES).tolist(),
            "below_share": float((seen < datum.value).mean()),
        }


@check_arguments
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
