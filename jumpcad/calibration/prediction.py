"""What a calibration says of other jumps: those of a robot that was not calibrated on, and settings of simulations."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from jumpcad.arguments import check_arguments
from jumpcad.calibration.likelihood import STUDENT_T_DEGREES, CalibrationModel, Predicted, predict
from jumpcad.calibration.posterior import CalibrationPosterior
from jumpcad.calibration.priors import QUANTILES, WEIGHED_SHARE
from jumpcad.calibration.subject import Subject
from jumpcad.errors import JumpcadError
from jumpcad.files import to_toml
from jumpcad.files.outputs import sealed
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
        rows, drawn = [], self.generator
        for datum, reading in ((one, of) for one in CalibrationModel([self.subject]).data for of in one.readings):
            value = self.predicted.of(datum.what, reading)
            far, count = datum.what == "distance", len(value)
            noise = drawn.standard_t(STUDENT_T_DEGREES, count) if far else drawn.standard_normal(count)
            seen = np.nan_to_num(value + noise * self.predicted.deviation(datum, reading, value))
            predicted, below = np.quantile(seen, QUANTILES).tolist(), float((seen < datum.value).mean())
            row = {"what": datum.what, "as": reading, "measured": datum.value}
            rows.append(row | {"predicted": predicted, "below_share": below})
        return rows


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


SAVED = 100
"""Draws in the file."""
DIGITS = 4
MOST_DEVIATIONS = 10.0
"""By how many standard deviations a measurement may be off: beyond, it is a mistake, not an error; judgement."""
LIMITS = {"spring_efficiency": (0.1, 1.5), "pin_friction": (0.0, 2.0)}
"""What settings take."""


@check_arguments
def settings_toml(posterior: CalibrationPosterior) -> str:
    """Return the settings file of a calibration; what belongs to workshop and design is said by `elsewhere`."""
    for one in posterior.residuals():
        if abs(off := one["off_by_deviations"]) > MOST_DEVIATIONS:
            unit = {"battery": "J", "speed": "m/s", "angle": "°"}.get(one["what"], "m")
            raise JumpcadError(
                f"{one['robot']}: {one['what']} = {one['measured']:.3g} {unit} is off by {off:+.1f} standard "
                f"deviations, more than {MOST_DEVIATIONS:g}: no settings are written: check it, or leave it out"
            )
    values = {key: np.clip(np.round(posterior.values[key], DIGITS), *limits) for key, limits in LIMITS.items()}
    names = ", ".join(subject.name for subject in posterior.model.subjects)
    comment = [f"# Calibrated on {names} by jumpcad calibrate: medians, and under [draws] what stays open."]
    if "drive_efficiency" in posterior.values:
        drive = float(np.median(posterior.values["drive_efficiency"]))
        comment.append(f"# Drive: the battery gives what jumpcad build says of the winding, over {drive:.2f}.")
    settings = {key: round(float(np.median(found)), DIGITS) for key, found in values.items()}
    chosen = np.linspace(0, len(posterior.z) - 1, SAVED).astype(int)
    draws = {key: found[chosen].tolist() for key, found in values.items()}
    return sealed("\n".join(comment) + "\n" + to_toml({**settings, "draws": draws}))


def elsewhere(posterior: CalibrationPosterior) -> Iterator[str]:
    """Yield where what was found of one robot is to be written: its parts, weight, tested floor, springs' rate."""
    for subject in posterior.model.subjects:
        name, robot, weighed = subject.name, subject.robot, subject.measured.mass
        if weighed.parts_g:
            parts = ", ".join(f"{part} = {grams:g}" for part, grams in weighed.parts_g.items())
            yield f"{name}, in its workshop: [mass.weighed_g] {parts}"
        factor, model_g = float(np.median(posterior.values[f"mass:{name}"])), 1000.0 * robot.mass_kg
        if weighed.robot_g is not None and abs(factor - 1.0) > WEIGHED_SHARE:
            yield (
                f"{name}, in its workshop: [mass.weighed_g] of its parts, which are to be weighed one by one: it has "
                f"{factor * model_g:.4g} g, by the model {model_g:.4g} g"
            )
        if subject.floor.shape == "lognormal":
            key = "friction" if robot.workshop.ground.pad else "bare_friction"
            yield f"{name}, in its workshop: [ground] {key} = {np.median(posterior.values[f'floor:{name}']):.2f}"
        factor, stock = float(np.median(posterior.values[f"rate:{subject.pair}"])), robot.workshop.stock_spring
        if stock is None:
            yield f"{name}, in its design: stiffness_nmm_per_deg = {factor * robot.design.stiffness_nmm_per_deg:.3g}"
        else:
            yield f"{name}, in [springs.{stock.name}]: rate_nmm_per_deg = {factor * stock.rate_nmm_per_deg:.3g}"
