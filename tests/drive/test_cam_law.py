"""The law of the cam's lift against energy and geometry."""

import math

import numpy as np
import pytest

from jumpcad.drive.cam_law import CamLaw

LIFT_RAD, RAMP_RAD = math.radians(310), math.radians(30)


def test_the_law_stores_the_springs_energy_at_constant_torque():
    a_law = CamLaw(math.radians(52.9), 1.69, LIFT_RAD, RAMP_RAD)
    cam = np.linspace(0, a_law.lift_rad, 20001)
    torque = a_law.torque_nm(cam)
    assert np.trapezoid(torque, cam) == pytest.approx(0.5 * 1.69 * math.radians(52.9) ** 2, rel=1e-6)
    energy = 0.5 * 1.69 * a_law.wind_rad(cam) ** 2
    assert np.gradient(energy, cam)[1:-1] == pytest.approx(torque[1:-1], abs=2e-5)
    assert torque[cam > a_law.ramp_rad] == pytest.approx(torque[-1])


@pytest.mark.parametrize("preload_deg", [0.5, 3.0, 10.0])
def test_a_preloaded_spring_takes_more_energy_at_constant_torque(preload_deg):
    preload, wind = math.radians(preload_deg), math.radians(52.9)
    a_law = CamLaw(wind, 1.69, LIFT_RAD, RAMP_RAD, preload)
    cam = np.linspace(0, a_law.lift_rad, 20001)
    torque = a_law.torque_nm(cam)
    assert a_law.energy_j == pytest.approx(0.5 * 1.69 * ((wind + preload) ** 2 - preload**2))
    assert np.trapezoid(torque, cam) == pytest.approx(a_law.energy_j, rel=1e-6)
    loaded = preload + a_law.wind_rad(cam)
    assert np.gradient(0.5 * 1.69 * loaded**2, cam)[1:-1] == pytest.approx(torque[1:-1], abs=2e-5)
    assert a_law.wind_rad([0.0, LIFT_RAD]) == pytest.approx([0.0, wind])
    at, step = np.concatenate([np.linspace(0.02, 0.5, 40), np.linspace(0.54, 5.4, 90)]), 1e-5
    _, first, second = a_law.derivatives(at)
    before, here, after = (a_law.wind_rad(at + shift) for shift in (-step, 0.0, step))
    assert first == pytest.approx((after - before) / (2 * step), rel=1e-6)
    assert second == pytest.approx((after - 2 * here + before) / step**2, abs=1e-3)


@pytest.mark.parametrize("preload_deg", [0.0, 5.0])
def test_with_an_end_the_torque_falls_evenly_and_a_quarter_of_it_from_the_drop_a_sixteenth_of_its_energy_is_missing(
    preload_deg: float,
) -> None:
    """A triangle of torque over the angle that is left; the leg's angle follows from the energy, Hooke's law."""
    preload, wind, ease = math.radians(preload_deg), math.radians(52.9), math.radians(24)
    a_law = CamLaw(wind, 1.69, LIFT_RAD, RAMP_RAD, preload, ease)
    cam = np.linspace(0, LIFT_RAD, 20001)
    torque, energy = a_law.torque_nm(cam), 0.5 * 1.69 * (preload + a_law.wind_rad(cam)) ** 2
    assert np.trapezoid(torque, cam) == pytest.approx(a_law.energy_j, rel=1e-6)
    assert np.gradient(energy, cam)[1:-1] == pytest.approx(torque[1:-1], abs=2e-5)
    assert a_law.torque_nm(LIFT_RAD - ease / 4) == pytest.approx(a_law.peak_torque_nm / 4)
    missing = energy[-1] - 0.5 * 1.69 * (preload + a_law.wind_rad(LIFT_RAD - ease / 4)) ** 2
    assert missing == pytest.approx(a_law.peak_torque_nm * ease / 2 / 16)
    at, step = np.concatenate([np.linspace(0.0, 0.5, 40), np.linspace(0.54, 4.9, 90), np.linspace(5.0, 5.4, 9)]), 1e-5
    _, first, second = a_law.derivatives(at)
    before, here, after = (a_law.wind_rad(at + shift) for shift in (-step, 0.0, step))
    assert first[1:] == pytest.approx((after - before)[1:] / (2 * step), rel=1e-6)
    assert second[1:] == pytest.approx((after - 2 * here + before)[1:] / step**2, abs=1e-3)


def test_the_ramp_costs_little_torque():
    # Without a ramp, constant torque is energy over lift. The design note says 4.6 %, of a lift of 340°.
    a_law = CamLaw(math.radians(53), 1.0, math.radians(340), math.radians(30))
    assert a_law.peak_torque_nm / (a_law.energy_j / a_law.lift_rad) == pytest.approx(340 / 325, abs=1e-3)


def test_derivatives_are_those_of_the_leg_angle():
    a_law = CamLaw(math.radians(52.9), 1.69, LIFT_RAD, RAMP_RAD)
    cam, step = np.concatenate([np.linspace(0.02, 0.5, 40), np.linspace(0.54, 5.4, 90)]), 1e-5
    _, first, second = a_law.derivatives(cam)
    before, at, after = (a_law.wind_rad(cam + shift) for shift in (-step, 0.0, step))
    assert first == pytest.approx((after - before) / (2 * step), rel=1e-7)
    assert second == pytest.approx((after - 2 * at + before) / step**2, abs=1e-4)
    assert a_law.wind_rad(LIFT_RAD) == pytest.approx(math.radians(52.9))


def test_the_springs_torque_at_the_end_of_the_lift_is_their_rate_times_their_angle() -> None:
    """Hooke's law, from where they are slack."""
    assert CamLaw(0.9, 1.7, LIFT_RAD, RAMP_RAD, 0.2).spring_torque_nm == pytest.approx(1.87)
