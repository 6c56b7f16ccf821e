"""The likelihood of measurements for given parameters, for many sets of parameters at once.

Parameters are shared by all robots (springs' efficiency, pins, release, drive), by a pair of springs (rate) or belong
to one robot (mass, floor, travel after landing). A length of which it is unknown what was measured has several readings
(interpretations), equally probable before the data.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import gammaln

from jumpcad.calibration import priors
from jumpcad.calibration.measurements import DISTANCES, HEIGHTS, lengths
from jumpcad.calibration.priors import Prior
from jumpcad.calibration.subject import Subject
from jumpcad.calibration.surface import JumpAt
from jumpcad.calibration.video import TakeoffSeen
from jumpcad.transforms import Array

JUMP_SHARE = 0.08
"""Relative standard deviation of the range of single jumps; judgement."""
MODEL_SHARE = 0.03
"""Relative error of the model in range, rise and speed, which more jumps do not reduce; judgement."""
HEIGHT_M = 0.015
"""Standard deviation of a measured height."""
ENERGY_SHARE = 0.10
"""Relative error of a measured energy from the battery."""
ANGLE_DEG = 2.0
"""Error of the model in the take-off angle; judgement."""
BODY_SPEED_SHARE, BODY_ANGLE_DEG = 0.05, 4.0
"""Relative error of speed, and error of angle, where a video shows the body, not the centre of mass; judgement."""
STUDENT_T_DEGREES = 4.0
"""Degrees of freedom of Student's t distribution of distances, so that outliers count less."""


@dataclass(frozen=True)
class CalibrationParameter:
    """A parameter: its key, its name in plots and tables, its prior."""

    key: str
    label: str
    prior: Prior


@dataclass(frozen=True)
class Datum:
    """One measured value (m, J, m/s or °), the mean of `count` jumps.

    `what` is the quantity, a key of `Predicted.of`; `of` says what was measured of it (`DistanceOf`, `HeightOf`).
    `scatter` is the standard deviation of one jump, `error` that common to all; relative to the value if `relative`.
    """

    subject: str
    what: str
    of: str
    value: float
    count: int
    scatter: float
    error: float
    relative: bool = True

    @property
    def readings(self) -> tuple[str, ...]:
        """The possible interpretations: `of`, or all if it is unknown."""
        if self.of != "unknown":
            return (self.of,)
        return DISTANCES if self.what == "distance" else HEIGHTS


@dataclass(frozen=True, repr=False)
class Predicted:
    """What a robot does at n sets of parameters.

    `travel_m` (n,) is the travel after landing, `battery_j` (n,) the energy from the battery; `beyond_m` and
    `standing_m` are those of `Subject`.
    """

    jump: JumpAt
    travel_m: Array
    battery_j: Array
    beyond_m: tuple[float, float]
    standing_m: float

    def of(self, what: str, reading: str) -> Array:
        """Return the values (n,) that a measurement of a quantity would give without error, under a reading."""
        if what == "distance":
            touchdown: Array = self.jump.range_m + self.beyond_m[0]
            by_reading = {"centre-of-mass": self.jump.range_m, "first-touchdown": touchdown}
            return by_reading.get(reading, touchdown + self.travel_m)
        if what == "height":
            return self.jump.rise_m + (self.standing_m if reading == "absolute" else 0.0)
        return {"battery": self.battery_j, "speed": self.jump.speed_m_s, "angle": self.jump.angle_deg}[what]

    def deviation(self, datum: Datum, reading: str, value: Array) -> Array:
        """Return the standard deviations (n,) of a measurement about the predicted values (n,)."""
        single = math.hypot(datum.scatter / math.sqrt(datum.count), datum.error)
        if datum.what == "height":
            return np.hypot(HEIGHT_M / math.sqrt(datum.count), single * value)
        spread = self.beyond_m[1] if datum.what == "distance" and reading != "centre-of-mass" else 0.0
        return np.hypot(single * value, spread) if datum.relative else np.full_like(value, single)


class CalibrationModel:
    """Parameters and data of some robots."""

    def __init__(self, subjects: Sequence[Subject]) -> None:
        self.subjects = list(subjects)
        self.data = [datum for subject in subjects for datum in data_of(subject)]

    @cached_property
    def parameters(self) -> list[CalibrationParameter]:
        """All parameters, shared ones first."""
        shared = [
            CalibrationParameter("spring_efficiency", "spring efficiency", priors.SPRING_EFFICIENCY),
            CalibrationParameter("pin_friction", "friction of pins", priors.PIN_FRICTION),
        ]
        if any(subject.measured.release != "dog" for subject in self.subjects):
            shared.append(CalibrationParameter("back_efficiency", "back efficiency of release", priors.BACK_EFFICIENCY))
        if any(datum.what == "battery" for datum in self.data):
            shared.append(CalibrationParameter("drive_efficiency", "drive efficiency / model", priors.DRIVE_EFFICIENCY))
        own: dict[str, CalibrationParameter] = {}
        for subject in self.subjects:
            key = f"rate:{subject.pair}"
            if key not in own or own[key].prior.source != "measured":
                own[key] = CalibrationParameter(key, f"{subject.pair}: spring rate / design", subject.rate)
            rows = [("mass", "mass / model", subject.mass), ("floor", "friction of floor", subject.floor)]
            if any("resting-place" in datum.readings for datum in self.data if datum.subject == subject.name):
                rows.append(("travel", "travel after landing (mm)", subject.travel))
            for name, label, prior in rows:
                key = f"{name}:{subject.name}"
                own[key] = CalibrationParameter(key, f"{subject.name}: {label}", prior)
        return [*shared, *own.values()]

    def values(self, z: Array) -> dict[str, Array]:
        """Return the parameters by key, each (n,), at standard normals (n, parameters)."""
        return {one.key: one.prior.at(z[:, index]) for index, one in enumerate(self.parameters)}

    def log_probability(self, z: Array) -> Array:
        """Return the logarithm of the posterior density of standard normals (n, parameters), less a constant."""
        values = self.values(z)
        predicted = {subject.name: predict(subject, values) for subject in self.subjects}
        found = -0.5 * np.sum(z * z, axis=1)
        for datum in self.data:
            # Unlike scipy's logsumexp, this costs next to nothing.
            found = found + np.logaddexp.reduce(self.log_readings(datum, predicted[datum.subject]), axis=0)
        return np.where(np.isfinite(found), found, -np.inf)

    @staticmethod
    def log_readings(datum: Datum, predicted: Predicted) -> Array:
        """Return the logarithm of the likelihood (readings, n) of one datum under each of its readings."""
        chances = []
        for reading in datum.readings:
            value = predicted.of(datum.what, reading)
            deviation = predicted.deviation(datum, reading, value)
            chances.append(_log_density(datum, value, deviation))
        return np.array(chances) - math.log(len(chances))


def predict(subject: Subject, values: dict[str, Array]) -> Predicted:
    """Return what a robot does at parameters by key, each (n,); the robot's own must be among them."""
    rate, mass = values[f"rate:{subject.pair}"], values[f"mass:{subject.name}"]
    energy = energy_per_mass(subject, values)
    jump = subject.surface.at(energy, values["pin_friction"], values[f"floor:{subject.name}"])
    travel_m = values.get(f"travel:{subject.name}", np.zeros_like(mass)) / 1000.0
    battery_j = subject.electrical_j * rate / values.get("drive_efficiency", np.ones_like(mass))
    return Predicted(jump, travel_m, battery_j, subject.beyond_m, subject.standing_m)


def energy_per_mass(subject: Subject, values: dict[str, Array]) -> Array:
    """Return the energy that the springs deliver per mass of the robot, over the model's (n,)."""
    kept = 1.0 if subject.measured.release == "dog" else priors.release_share(values["back_efficiency"])
    given: Array = values["spring_efficiency"] * values[f"rate:{subject.pair}"] * kept
    return np.asarray(given / values[f"mass:{subject.name}"])


def data_of(subject: Subject) -> list[Datum]:
    """Return the data from a robot's jumps and videos.

    What was measured in the same way is one datum, with the model's error: lengths and speeds are geometric means.
    """
    name, measured = subject.name, subject.measured
    found = [
        Datum(name, one.what, one.of, one.mean_mm / 1000.0, one.count, JUMP_SHARE, MODEL_SHARE)
        for one in lengths(measured.jumps)
    ]
    if battery_j := [value for series in measured.jumps for value in series.battery_j]:
        found.append(Datum(name, "battery", "battery", float(np.mean(battery_j)), 1, 0.0, ENERGY_SHARE))
    for point in dict.fromkeys(video.point for video in measured.videos):
        alike = [seen for video, seen in zip(measured.videos, subject.seen, strict=True) if video.point == point]
        found.extend(_seen_data(name, point, alike))
    return found


def _seen_data(name: str, point: str, seen: Sequence[TakeoffSeen]) -> Iterator[Datum]:
    """Yield speed and angle of the take-offs that videos of one point show."""
    share, angle_deg = (BODY_SPEED_SHARE, BODY_ANGLE_DEG) if point == "body" else (MODEL_SHARE, ANGLE_DEG)
    count = len(seen)
    speed = math.exp(sum(math.log(one.speed_m_s) for one in seen) / count)
    speed_error = math.hypot(share, *(one.speed_error_m_s / one.speed_m_s / count for one in seen))
    angle_error = math.hypot(angle_deg, *(one.angle_error_deg / count for one in seen))
    # Speed goes with the root of the energy, so half the scatter of range.
    yield Datum(name, "speed", point, speed, count, JUMP_SHARE / 2.0, speed_error)
    angle = sum(one.angle_deg for one in seen) / count
    yield Datum(name, "angle", point, angle, count, 0.0, angle_error, relative=False)


def _log_density(datum: Datum, value: Array, deviation: Array) -> Array:
    """Return the logarithm of a measurement's density: lengths along the ground by Student's t, others normal."""
    positive = value > 0.0
    safe = np.where(positive, value, 1.0)
    if datum.what in ("distance", "battery", "speed"):
        scale = deviation / safe
        off = np.log(datum.value / safe) / scale
    else:
        scale, off = deviation, (datum.value - value) / deviation
    if datum.what == "distance":
        half = STUDENT_T_DEGREES / 2.0
        constant = gammaln(half + 0.5) - gammaln(half) - 0.5 * math.log(STUDENT_T_DEGREES * math.pi)
        found = constant - (STUDENT_T_DEGREES + 1.0) / 2.0 * np.log1p(off * off / STUDENT_T_DEGREES) - np.log(scale)
    else:
        found = -0.5 * off * off - np.log(scale)
    return np.where(positive & np.isfinite(found), found, -np.inf)
