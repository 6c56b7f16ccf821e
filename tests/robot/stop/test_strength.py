"""The leg's blow on its stop: a mass on a spring, and a pad that does not throw back, stepped through."""

import math

import numpy as np
import pytest

from jumpcad.mechanism.flight import Blow
from jumpcad.robot.stop.strength import BLOW_FACTOR, PEAK_SHARE, stop_blow

BLOW = Blow(takeoff_rad=0.1, stop_rad_s=40.0, inertia_kg_m2=2e-5)
ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM = 0.15, 12.0, 90.0


def test_a_pads_give_holds_the_energy_of_the_blow() -> None:
    """Half of stiffness times deflection squared, in the turn of the leg and in millimetres of the pad."""
    found = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    assert found.energy_j == pytest.approx(2e-5 * 40.0**2 / 2.0)
    assert 0.5 * found.stop.stiffness_nm_per_rad * found.give_rad**2 == pytest.approx(found.energy_j)
    assert 0.5 * PAD_N_PER_MM * found.give_mm**2 == pytest.approx(1000.0 * found.energy_j)  # N·mm are mJ


def test_what_is_an_arc_for_the_pad_is_an_angle_for_the_leg() -> None:
    found = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    assert found.give_mm == pytest.approx(RADIUS_MM * found.give_rad)
    assert found.torque_nm == pytest.approx(found.force_n * RADIUS_MM / 1000.0)


def test_the_peak_force_is_that_of_a_mass_on_a_spring_less_what_does_not_come_back() -> None:
    """v·√(k·m) of a mass m = I/r² at v = ω·r, times 0.82: here 0.48 m/s, 139 g, 90 N/mm, so 53.7 and 44.0 N."""
    found = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    mass, speed = 2e-5 / 0.012**2, 40.0 * 0.012
    assert found.force_n == pytest.approx(0.82 * speed * math.sqrt(90_000.0 * mass))
    assert found.force_n == pytest.approx(44.0, abs=0.05)
    assert found.force_n == pytest.approx(0.82 * PAD_N_PER_MM * found.give_mm)


def test_the_stop_acts_on_the_leg_from_its_angle_on() -> None:
    """With the pad's stiffness about the joint: a turn moves it by r, and its force has the lever r."""
    stop = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM).stop
    assert (stop.joint, stop.angle_rad) == ("leg", 0.15)
    turn = 1e-3
    force_n = PAD_N_PER_MM * RADIUS_MM * turn
    assert stop.stiffness_nm_per_rad * turn == pytest.approx(force_n * RADIUS_MM / 1000.0)


@pytest.mark.parametrize(
    ("times", "force", "give"),
    [
        ({"speed": 2.0}, 2.0, 2.0),
        ({"inertia": 4.0}, 2.0, 2.0),
        ({"pad": 4.0}, 2.0, 0.5),
        ({"radius": 2.0}, 1.0, 1.0),  # half of the mass's share at twice the speed: the same in N and mm
    ],
)
def test_force_and_give_grow_as_those_of_a_mass_on_a_spring(times: dict[str, float], force: float, give: float) -> None:
    usual = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    blow = Blow(0.1, 40.0 * times.get("speed", 1.0), 2e-5 * times.get("inertia", 1.0))
    other = stop_blow(blow, ANGLE_RAD, RADIUS_MM * times.get("radius", 1.0), PAD_N_PER_MM * times.get("pad", 1.0))
    assert (other.force_n / usual.force_n, other.give_mm / usual.give_mm) == pytest.approx((force, give))


def test_a_lossless_pad_stepped_through_gives_as_far_and_presses_as_hard() -> None:
    """I·q'' = -k·q from the blow's speed on, in steps of 0.1 µs, until it stands still."""
    found = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    step, turn, rate, hardest = 1e-7, 0.0, BLOW.stop_rad_s, 0.0
    while rate > 0.0:
        torque = found.stop.stiffness_nm_per_rad * turn
        rate -= torque / BLOW.inertia_kg_m2 * step
        turn += rate * step
        hardest = max(hardest, torque)
    assert turn == pytest.approx(found.give_rad, rel=1e-3)
    assert hardest * PEAK_SHARE == pytest.approx(found.torque_nm, rel=1e-3)


def test_the_share_of_the_peak_is_no_less_than_the_least_that_a_dashpot_leaves() -> None:
    """Spring and dashpot in parallel: the least peak of all dampings is 0.81 of the undamped one's.

    Damping ratio 0.26; with less the spring is pressed further, with more the dashpot resists at once.
    """
    peaks = []
    for ratio in np.linspace(0.05, 0.6, 56):
        damped = math.sqrt(1.0 - ratio**2)
        t = np.linspace(0.0, 3.0, 6001)
        decay = np.exp(-ratio * t)
        x = decay * np.sin(damped * t) / damped
        v = decay * (np.cos(damped * t) - ratio * np.sin(damped * t) / damped)
        peaks.append(float((x + 2.0 * ratio * v).max()))
    assert min(peaks) == pytest.approx(0.81, abs=0.005)
    assert min(peaks) <= PEAK_SHARE <= 1.0


def test_twice_the_force_is_borne() -> None:
    assert BLOW_FACTOR == 2.0
