"""Scatter of measurements: what more jumps reduce, and what they do not."""

import math
import re
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy import stats
from support.calibrations import stand_in
from support.places import ROOT

from jumpcad.calibration import priors
from jumpcad.calibration.likelihood import (
    ANGLE_DEG,
    BODY_ANGLE_DEG,
    STUDENT_T_DEGREES,
    CalibrationModel,
    Datum,
    Predicted,
    _log_density,
    data_of,
    energy_per_mass,
    predict,
)
from jumpcad.calibration.measurements import Jumps, Measurements
from jumpcad.calibration.priors import Prior
from jumpcad.calibration.subject import Subject
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
    distance, height, battery, *videos = data_of(subject)  # type: ignore[arg-type]
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


def test_what_is_measured_alike_is_one_datum_in_however_many_series() -> None:
    """The model's error is common to all: ten series of a jump each tell no more than one series of ten jumps."""
    far, rates = (180.0, 200.0, 210.0, 230.0), (1.4, 1.7)

    def found(*jumps: dict[str, Any]) -> list[Datum]:
        return data_of(measured_robot(jumps=jumps))

    def series(*values: float, of: str = "centre-of-mass", **more: Any) -> dict[str, Any]:
        return {"distance_mm": values, "distance_of": of} | more

    whole = found(series(*far, battery_j=rates))
    alone = found(*map(series, far), *({"battery_j": (rate,)} for rate in rates))
    assert [(one.what, one.count) for one in whole] == [("distance", 4), ("battery", 1)]
    for one, other in zip(whole, alone, strict=True):
        assert other.value == pytest.approx(one.value)
        assert (one.count, one.scatter, one.error) == (other.count, other.scatter, other.error)
    (mean,) = found(series(160.0, jumps=3), series(10.0, jumps=1))  # (3 ln 160 + ln 10)/4 = ln 80
    assert (mean.value, mean.count) == (pytest.approx(0.08), 4)
    kinds = found(series(180.0), series(200.0, of="first-touchdown"), series(190.0, of="unknown"),
                  series(320.0, of="unknown"))  # fmt: skip
    assert [one.value for one in kinds] == pytest.approx([0.18, 0.2, 0.19, 0.32])


def test_videos_of_one_point_are_one_speed_and_one_angle() -> None:
    """Four with a scatter of 4 % each and an error of the model of 3 % that is theirs together."""
    point = SimpleNamespace(point="centre-of-mass")
    seen = [SimpleNamespace(speed_m_s=v, speed_error_m_s=0.0, angle_deg=a, angle_error_deg=2.0)
            for v, a in ((1.0, 40.0), (4.0, 44.0), (1.0, 40.0), (4.0, 44.0))]  # fmt: skip
    robot = SimpleNamespace(name="a", measured=SimpleNamespace(jumps=(), videos=[point] * 4), seen=seen)
    speed, angle = data_of(robot)  # type: ignore[arg-type]
    assert (speed.value, speed.count) == (pytest.approx(2.0), 4)
    assert (speed.scatter, speed.error) == pytest.approx((0.04, 0.03))
    assert (angle.value, angle.error) == pytest.approx((42.0, math.hypot(ANGLE_DEG, 1.0)))


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


def measured_robot(name: str = "a", **said: Any) -> Any:
    """A robot that jumps 0.1 m for each of the model's energies, with priors of its own."""

    def at(energy: Any, pins: Any, floor: Any) -> JumpAt:
        return JumpAt(0.1 * energy, 0.05 * energy, energy, energy)

    video = SimpleNamespace(speed_m_s=1.4, speed_error_m_s=0.0, angle_deg=47.0, angle_error_deg=0.0)
    measured = Measurements(**{"design": "kenan-2.0", "source": "a test", "release": "dog"} | said)
    return stand_in(
        Subject, name=name, pair=measured.spring.pair or name, measured=measured, surface=SimpleNamespace(at=at),
        seen=(video,) * len(measured.videos), electrical_j=2.0, beyond_m=(0.02, 0.005), standing_m=0.1,
        travel=priors.TRAVEL_MM, mass=Prior("normal", 1.0, 0.2, "model", 0.1), floor=Prior("uniform", 0.3, 1.0, ""),
        rate=Prior("normal", 1.0, 0.03, "measured" if measured.spring.rate_nmm_per_deg else "workshop", 0.3),
    )  # fmt: skip


JUMPED = ({"distance_mm": (200.0,), "distance_of": "unknown", "battery_j": (1.5,)},)
VIDEOS = ({"points": "a.csv", "point": "centre-of-mass"}, {"points": "b.csv", "point": "body"})


def test_errors_are_those_that_the_documentation_says() -> None:
    """docs/calibration.md, the table of errors."""
    page = (ROOT / "docs" / "calibration.md").read_text(encoding="utf-8").split("| measured | error, of n jumps")[1]
    words = re.search(
        r"Student's t with (\d+) degrees of freedom, (\d+) %/√n and (\d+) % \|\n"
        r"\| height \| (\d+) mm/√n, (\d+) %/√n and (\d+) % \|\n\| ln battery energy \| (\d+) % \|\n"
        r"\| speed \| (\d+) % and (\d+) %; of a point of the body (\d+) % \|\n"
        r"\| angle \| (\d+)°; of a point of the body (\d+)°",
        page,
    )
    assert words is not None
    degrees, jumps, model, height, heights, height_share, battery, speed, seen, body, angle, body_angle = map(
        float, words.groups()
    )
    jumped = ({"distance_mm": (200.0,), "distance_of": "unknown", "battery_j": (1.5,)},
              {"height_mm": (90.0,), "height_of": "rise"})  # fmt: skip
    distance, rise, energy, *videos = data_of(measured_robot(jumps=jumped, videos=VIDEOS))
    assert degrees == STUDENT_T_DEGREES
    assert (distance.scatter, distance.error) == pytest.approx((jumps / 100.0, model / 100.0))
    assert (energy.scatter, energy.error) == pytest.approx((0.0, battery / 100.0))
    assert (rise.scatter, rise.error) == pytest.approx((heights / 100.0, height_share / 100.0))
    assert deviation("height", "rise", 1, 0.0, 0.0) == pytest.approx(height / 1000.0)
    assert [one.scatter for one in videos] == pytest.approx([speed / 100.0, 0.0] * 2)
    assert [one.error for one in videos] == pytest.approx([seen / 100.0, angle, body / 100.0, body_angle])


def test_parameters_are_what_the_measurements_leave_open() -> None:
    """Shared ones first; of a release without a dog, and of a battery, one more; of each robot its mass and floor.

    Two robots with one pair of springs have one rate, and what one of them says is measured stays.
    """

    def keys(*subjects: Any) -> list[str]:
        return [one.key for one in CalibrationModel(subjects).parameters]

    shared = ["spring_efficiency", "pin_friction"]
    assert keys(measured_robot()) == [*shared, "rate:a", "mass:a", "floor:a"]
    assert keys(measured_robot(release="fixed")) == [*shared, "back_efficiency", "rate:a", "mass:a", "floor:a"]
    mixed = keys(measured_robot(), measured_robot("b", release="unknown"))
    assert mixed == [*shared, "back_efficiency", *(f"{what}:{of}" for of in "ab" for what in ("rate", "mass", "floor"))]
    both = keys(
        measured_robot(jumps=JUMPED), measured_robot("b", jumps=({"height_mm": (9.0,), "height_of": "unknown"},))
    )
    assert both == [
        *shared,
        "drive_efficiency",
        "rate:a",
        "mass:a",
        "floor:a",
        "travel:a",
        "rate:b",
        "mass:b",
        "floor:b",
    ]
    known = measured_robot("c", spring={"pair": "ours", "rate_nmm_per_deg": 4.6, "springs": 2})
    for pair in (
        (known, measured_robot("d", spring={"pair": "ours"})),
        (measured_robot("d", spring={"pair": "ours"}), known),
    ):
        (rate,) = (one for one in CalibrationModel(pair).parameters if one.key.startswith("rate:"))
        assert (rate.key, rate.prior.source) == ("rate:ours", "measured")


def test_energy_over_mass_is_that_of_the_springs_over_the_scale_s() -> None:
    """Efficiency 0.9, springs 10 % stiffer, a robot 20 % heavier; a release that keeps 0.4 + 0.6 x 0.5 = 0.7 of it."""
    values = {"spring_efficiency": 0.9 * ONE, "rate:a": 1.1 * ONE, "mass:a": 1.2 * ONE, "back_efficiency": 0.5 * ONE}
    assert energy_per_mass(measured_robot(), values) == pytest.approx([0.9 * 1.1 / 1.2])
    assert energy_per_mass(measured_robot(release="fixed"), values) == pytest.approx([0.7 * 0.9 * 1.1 / 1.2])


def test_springs_of_a_pair_have_the_pair_s_rate() -> None:
    """Whatever the robot is called: 10 % more, in the energy of the jump and of the battery (2 J by the model)."""
    values = {"spring_efficiency": ONE, "pin_friction": ONE, "rate:ours": 1.1 * ONE, "mass:a": ONE, "floor:a": ONE}
    robot = measured_robot(spring={"pair": "ours"})
    assert energy_per_mass(robot, values) == pytest.approx([1.1])
    assert predict(robot, values).battery_j == pytest.approx([2.2])


def test_a_posterior_is_prior_times_the_mean_of_the_readings() -> None:
    """Bayes, for one distance of which it is not known what it is of, and the energy from the battery."""
    model = CalibrationModel([measured_robot(jumps=JUMPED)])
    z = np.array([[0.3, -0.2, 0.5, -1.0, 0.4, 0.1, 0.7], np.zeros(7)])
    values = model.values(z)
    energy = values["spring_efficiency"] * values["rate:a"] / values["mass:a"]
    touchdown = 0.1 * energy + 0.02
    readings = [(0.1 * energy, 0.0), (touchdown, 0.005), (touchdown + values["travel:a"] / 1000.0, 0.005)]
    share = math.hypot(0.08, 0.03)
    density = np.mean([
        stats.t(4.0).pdf(np.log(0.2 / where) / np.hypot(share, off / where)) / np.hypot(share, off / where)
        for where, off in readings
    ], axis=0)  # fmt: skip
    battery = 2.0 * values["rate:a"] / values["drive_efficiency"]
    known = np.log(density) - 0.5 * (np.log(1.5 / battery) / 0.1) ** 2 - math.log(0.1) - 0.5 * (z**2).sum(axis=1)
    assert model.log_probability(z) == pytest.approx(known)


def test_what_does_not_jump_is_not_believed() -> None:
    robot = measured_robot(jumps=({"distance_mm": (200.0,), "distance_of": "centre-of-mass"},))
    vars(robot)["surface"] = SimpleNamespace(at=lambda *_: JumpAt(np.nan * ONE, ONE, ONE, ONE))
    assert CalibrationModel([robot]).log_probability(np.zeros((1, 5))).tolist() == [-math.inf]


def test_of_several_robots_all_measurements_count() -> None:
    """Each with what its own robot does: together they are as probable as one after the other."""
    robots = [
        measured_robot(jumps=({"distance_mm": (200.0,), "distance_of": "centre-of-mass"},)),
        measured_robot("b", jumps=({"distance_mm": (150.0,), "distance_of": "centre-of-mass"},)),
    ]
    model = CalibrationModel(robots)
    assert [(datum.subject, datum.value) for datum in model.data] == [
        ("a", pytest.approx(0.2)),
        ("b", pytest.approx(0.15)),
    ]
    z = np.array([[0.3, -0.2, 0.5, -1.0, 0.4, 0.1, 0.7, -0.6]])
    keys = [one.key for one in model.parameters]
    parts = []
    for robot in robots:
        alone = CalibrationModel([robot])
        own = z[:, [keys.index(one.key) for one in alone.parameters]]
        parts.append(alone.log_probability(own) + 0.5 * (own**2).sum(axis=1))
    assert model.log_probability(z) == pytest.approx(parts[0] + parts[1] - 0.5 * (z**2).sum(axis=1))
