"""Competing explanations: the true one has the odds, and all robots are read in one way."""

import math
from functools import partial
from typing import Any

import numpy as np
import pytest
from support.calibrations import remeasured

from jumpcad.calibration import hypotheses
from jumpcad.calibration import subject as subject_module
from jumpcad.calibration.hypotheses import _median, _with_preload, compare_hypotheses
from jumpcad.calibration.measurements import Measurements
from jumpcad.calibration.subject import Subject
from jumpcad.calibration.surface import surface_of

COARSE = ((0.45, 1.0, 1.6, 2.5), (0.0, 0.9), (0.3, 0.5, 0.65, 1.0))
SAID: dict[str, Any] = {"design": "kenan-2.0", "source": "a test", "release": "dog"}


@pytest.fixture(autouse=True)
def _short(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subject_module, "surface_of", partial(surface_of, nodes=COARSE))
    monkeypatch.setattr(Subject, "landing", lambda self: self)
    monkeypatch.setattr(hypotheses, "DRAWS", 20_000)


def test_jumps_with_twice_the_energy_are_of_two_springs(subject: Subject) -> None:
    """Jumps of the model with energy over mass 1.9, of a weighed robot on a tested floor."""
    jump = subject.surface.at(np.array([1.9]), np.array([0.25]), np.array([0.8]))
    measured = Measurements(
        **SAID, mass={"robot_g": 1000.0 * subject.robot.mass_kg}, floor={"slope_deg": (math.degrees(math.atan(0.8)),)},
        jumps=({"distance_mm": (1000.0 * jump.range_m[0],), "distance_of": "centre-of-mass",
                "height_mm": (1000.0 * jump.rise_m[0],), "height_of": "rise", "jumps": 5},),
    )  # fmt: skip
    found = {(one["name"], one["travel"]): one for one in compare_hypotheses([remeasured(subject, measured)])}
    two, shared = found["two springs of the stated rate", "prior"], found["one factor on energy over mass", "prior"]
    assert found["as designed", "prior"]["odds"] == 1.0
    assert two["odds"] > 100.0
    assert two["odds"] > shared["odds"] > 1.0  # the sharper prediction wins
    assert two["energy_per_mass"]["kenan-2.0"] == pytest.approx(1.9, rel=0.05)
    assert two["worst_share"] < 0.03
    assert found["as designed", "prior"]["worst_share"] > 0.15


def test_all_robots_are_read_in_one_way(subject: Subject) -> None:
    lengths = {"distance_of": "unknown", "height_of": "unknown"}
    first = remeasured(
        subject, Measurements(**SAID, jumps=({"distance_mm": (200.0,), "height_mm": (70.0,), **lengths},))
    )
    second = remeasured(
        subject, Measurements(**SAID, jumps=({"distance_mm": (230.0,), "height_mm": (75.0,), **lengths},))
    )
    object.__setattr__(second, "name", "twin")
    for one in compare_hypotheses([first, second]):
        read = {(row["what"], row["as"]) for row in one["figures"]}
        assert read == set(one["readings"].items()), one["name"]


def test_a_preload_adds_its_energy(subject: Subject) -> None:
    """½·k·((δ + p)² - p²); the leg leaves the cam with the same share of it."""
    before, after = subject.robot.spring, _with_preload(subject, 0.2).robot.spring
    wind = before.wind_rad
    assert after.energy_j == pytest.approx(0.5 * before.stiffness_nm_per_rad * ((wind + 0.2) ** 2 - 0.2**2))
    speeds = [one.roller_off.leg_rad_s for one in (subject.robot, _with_preload(subject, 0.2).robot) if one.roller_off]
    assert (speeds[1] / speeds[0]) ** 2 == pytest.approx(after.energy_j / before.energy_j)


def test_weighted_medians() -> None:
    assert _median(np.array([3.0, 1.0, 2.0, np.nan]), np.array([1.0, 1.0, 1.0, 50.0])) == 2.0
    assert _median(np.array([1.0, 2.0]), np.array([1.0, 3.0])) == 2.0
