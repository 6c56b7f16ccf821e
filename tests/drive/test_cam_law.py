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


@pytest.mark.parametrize("preload", [0.0, 0.1])
def test_the_springs_torque_is_the_energy_that_a_little_more_angle_brings(preload: float) -> None:
    """2 N·m/rad wound by 0.8 rad, and by a tenth more that is there at rest: 1.6 and 1.8 N·m."""
    laws = [CamLaw(angle, 2.0, LIFT_RAD, RAMP_RAD, preload) for angle in (0.799, 0.8, 0.801)]
    assert laws[1].spring_torque_nm == pytest.approx(1.6 + 2.0 * preload)
    assert (laws[2].energy_j - laws[0].energy_j) / 0.002 == pytest.approx(laws[1].spring_torque_nm)
