"""Scatter of measurements: what more jumps reduce, and what they do not."""

import math
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats

from jumpcad.calibration.likelihood import (
    ANGLE_DEG,
    BODY_ANGLE_DEG,
    STUDENT_T_DEGREES,
    Datum,
    Predicted,
    _log_density,
    data_of,
    predict,
)
from jumpcad.calibration.measurements import Jumps
from jumpcad.calibration.surface import JumpAt

ONE = np.ones(1)
STILL = Predicted(JumpAt(ONE, ONE, ONE, ONE), 0.0 * ONE, ONE, (0.0, 0.0), 0.1)


def deviation(what: str, of: str, count: int, scatter: float, error: float) -> float:
    """Return the standard deviation of a mean of some jumps of 0.2 m."""
    datum = Datum("robot", what, of, 0.2, count, scatter, error)
    return float(STILL.deviation(datum, of, 0.2 * ONE)[0])


@pytest.mark.parametrize(("what", "of"), [("height", "rise"), ("distance", "centre-of-mass")])
def test_the_mean_of_nine_jumps_has_a_third_of_the_deviation(what: str, of: str) -> None:
    """Errors of a mean fall with the root of the number, those of reading a height too; the model's stay."""
    one, nine = (deviation(what, of, count, 0.08, 0.0) for count in (1, 9))
    assert nine == pytest.approx(one / 3.0)
    assert deviation(what, of, 10**8, 0.08, 0.03) == pytest.approx(0.03 * 0.2, rel=1e-3)


def test_a_height_is_read_to_15_mm() -> None:
    assert deviation("height", "rise", 1, 0.0, 0.0) == pytest.approx(0.015)
    assert deviation("height", "rise", 1, 0.08, 0.03) == pytest.approx(math.hypot(0.015, 0.016, 0.006))


def test_a_better_drive_takes_less_from_the_battery() -> None:
    """Of 2 J by the model: a fifth more efficient, and springs that are a tenth stiffer."""
    surface = SimpleNamespace(at=lambda *_: None)
    measured = SimpleNamespace(release="dog")
    subject = SimpleNamespace(
        name="a", pair="a", measured=measured, surface=surface, electrical_j=2.0, beyond_m=(0.0, 0.0), standing_m=0.1
    )
    values = {
        "rate:a": 1.1 * ONE, "mass:a": ONE, "floor:a": ONE, "pin_friction": ONE, "spring_efficiency": ONE,
        "drive_efficiency": 1.2 * ONE,
    }  # fmt: skip
    assert predict(subject, values).battery_j == pytest.approx([2.0 * 1.1 / 1.2])  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("what", "known"),
    [
        ("distance", lambda off, scale: stats.t(STUDENT_T_DEGREES, scale=scale).logpdf(off)),
        ("speed", lambda off, scale: stats.norm(scale=scale).logpdf(off) + 0.5 * math.log(2.0 * math.pi)),
        ("battery", lambda off, scale: stats.norm(scale=scale).logpdf(off) + 0.5 * math.log(2.0 * math.pi)),
    ],
)
def test_densities_are_those_of_the_logarithms_distributions(what: str, known: Callable[[float, float], float]) -> None:
    """Of a measured 0.25 for a computed 0.2 with a deviation of 0.03: ln 1.25 in units of 0.15."""
    datum = Datum("robot", what, what, 0.25, 1, 0.0, 0.0)
    found = _log_density(datum, 0.2 * ONE, 0.03 * ONE)
    assert found == pytest.approx([known(math.log(1.25), 0.15)])
    assert _log_density(datum, -ONE, ONE).tolist() == [-math.inf]


def test_heights_and_angles_have_a_normal_density() -> None:
    datum = Datum("robot", "angle", "body", 50.0, 1, 0.0, 2.0, relative=False)
    found = _log_density(datum, 47.0 * ONE, 2.0 * ONE)
    assert found == pytest.approx([stats.norm(47.0, 2.0).logpdf(50.0) + 0.5 * math.log(2.0 * math.pi)])


def test_a_series_is_one_datum_and_a_video_two() -> None:
    """The geometric mean of 160 and 250 mm is 200 mm; a mean of nine jumps counts as nine; angles have errors in °."""
    jumps = (
        Jumps(distance_mm=(160.0, 250.0), distance_of="first-touchdown", battery_j=(1.0, 2.0)),
        Jumps(height_mm=(50.0,), height_of="rise", jumps=9),
    )
    measured = SimpleNamespace(jumps=jumps, videos=(SimpleNamespace(point="body"), SimpleNamespace(point="centre")))
    seen = SimpleNamespace(speed_m_s=1.5, speed_error_m_s=0.15, angle_deg=50.0, angle_error_deg=3.0)
    subject = SimpleNamespace(name="a", measured=measured, seen=(seen, seen))
    distance, battery, height, *videos = data_of(subject)  # type: ignore[arg-type]
    assert (distance.what, distance.of, distance.count) == ("distance", "first-touchdown", 2)
    assert distance.value == pytest.approx(0.2)
    assert (battery.value, battery.count) == (pytest.approx(1.5), 1)
    assert (height.what, height.value, height.count) == ("height", pytest.approx(0.05), 9)
    assert [one.what for one in videos] == ["speed", "angle"] * 2
    assert [one.count for one in videos] == [1] * 4
    assert [one.relative for one in videos] == [True, False] * 2
    body, centre = videos[0], videos[2]
    assert centre.error == pytest.approx(math.hypot(0.1, distance.error))
    assert body.error > centre.error
    assert videos[1].error == pytest.approx(math.hypot(BODY_ANGLE_DEG, 3.0))
    assert videos[3].error == pytest.approx(math.hypot(ANGLE_DEG, 3.0))
    assert videos[0].scatter == pytest.approx(distance.scatter / 2.0)


def test_a_measurement_is_of_what_it_is_read_as() -> None:
    """Range 1 m, touchdown 0.2 m beyond it, 0.3 m of travel after that; a rise from 0.1 m above the floor."""
    robot = Predicted(JumpAt(ONE, 1.0 * ONE, 2.0 * ONE, 50.0 * ONE), 0.3 * ONE, 4.0 * ONE, (0.2, 0.05), 0.1)
    read = {
        ("distance", "centre-of-mass"): robot.jump.range_m[0], ("distance", "first-touchdown"): 1.2,
        ("distance", "resting-place"): 1.5, ("height", "rise"): robot.jump.rise_m[0],
        ("height", "absolute"): robot.jump.rise_m[0] + 0.1, ("battery", "battery"): 4.0,
        ("speed", "body"): robot.jump.speed_m_s[0], ("angle", "body"): robot.jump.angle_deg[0],
    }  # fmt: skip
    assert robot.jump.range_m[0] == 1.0
    for (what, reading), value in read.items():
        assert robot.of(what, reading) == pytest.approx([value]), (what, reading)
    spread = robot.deviation(Datum("r", "distance", "first-touchdown", 1.0, 1, 0.0, 0.1), "first-touchdown", ONE)
    assert spread == pytest.approx([math.hypot(0.1, 0.05)])
    degrees = robot.deviation(Datum("r", "angle", "body", 50.0, 1, 0.0, 2.0, relative=False), "body", 50.0 * ONE)
    assert degrees == pytest.approx([2.0])
