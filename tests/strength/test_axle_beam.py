"""Axles as beams on two plates: handbook cases, equilibrium, and the forces of teeth."""

import math

import numpy as np
import pytest

from jumpcad.drive.gear_pair import gear_pair
from jumpcad.strength.axle_beam import AxleBeam, mesh_force_n, on_hub

UP = np.array([0.0, 1.0])


def test_one_load_bends_by_its_distances_to_both_plates() -> None:
    """M = F·a·b/l under the load, reactions F·b/l and F·a/l (Shigley, table A-9)."""
    beam = AxleBeam.of((30.0, -10.0), (20.0, 80.0 * UP))
    assert beam.largest_nmm() == pytest.approx(80.0 * 30.0 * 10.0 / 40.0)
    assert beam.on_plates_n() == pytest.approx(np.array([[0.0, 60.0], [0.0, 20.0]]))
    assert beam.plate_load_n == pytest.approx(60.0)
    # towards the right plate the moment falls evenly to nothing
    assert beam.largest_nmm(up_to_mm=5.0) == pytest.approx(0.5 * beam.largest_nmm())
    assert beam.moments_nmm(np.array([-10.0, 30.0])) == pytest.approx([0.0, 0.0])


def test_two_equal_loads_bend_evenly_between_them() -> None:
    """M = F·a, a from either plate (Shigley, table A-9); opposite ones leave half of it at each, and none between."""
    beam = AxleBeam.of((20.0, -20.0), (12.0, 50.0 * UP), (-12.0, 50.0 * UP))
    assert beam.moments_nmm(np.array([-12.0, 0.0, 5.0, 12.0])) == pytest.approx([400.0] * 4)
    couple = AxleBeam.of((20.0, -20.0), (12.0, 50.0 * UP), (-12.0, -50.0 * UP))
    assert couple.moments_nmm(np.array([-12.0, 0.0])) == pytest.approx([50.0 * 24.0 / 40.0 * 8.0, 0.0])


def test_plates_carry_force_and_moment_of_any_loads() -> None:
    random = np.random.default_rng(5)
    places, forces = random.uniform(-15.0, 20.0, 6), random.normal(size=(6, 2))
    beam = AxleBeam((24.0, -19.0), places, forces)
    left, right = beam.on_plates_n()
    assert left + right == pytest.approx(forces.sum(axis=0))
    assert 24.0 * left - 19.0 * right == pytest.approx(places @ forces)
    # planes at right angles do not help each other: the moments add as vectors
    apart = [AxleBeam((24.0, -19.0), places, forces * axis).moments_nmm(places) for axis in np.eye(2)]
    assert beam.moments_nmm(places) == pytest.approx(np.hypot(*apart))


@pytest.mark.parametrize("place", [0.0, 2.0, 7.0])
def test_a_hub_passes_on_force_and_moment(place: float) -> None:
    """Pushed where a bearing is, that bearing has it all; beyond, it has more and the other one pulls."""
    (near, most), (far, least) = on_hub(30.0 * UP, 2.0, place)
    assert most + least == pytest.approx(30.0 * UP)
    assert near * most + far * least == pytest.approx(place * 30.0 * UP)
    assert (least[1] > 0.0) == (place < 2.0 - 1e-9)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_teeth_turn_the_wheel_and_push_it_away(sense: float) -> None:
    """About the wheel's axis the force has the torque; its line touches both base circles, since it is normal there."""
    pair = gear_pair(12, 30, 1.0, 5.0, 0.2)
    wheel = np.array([3.0, -2.0])
    for direction in (0.3, 2.0, 4.4):
        pinion = wheel + pair.centre_distance_mm * np.array([math.cos(direction), math.sin(direction)])
        force = mesh_force_n(500.0, pair, wheel, pinion, sense)
        pitch = pair.wheel.teeth / (pair.wheel.teeth + pair.pinion.teeth)
        contact = wheel + pitch * (pinion - wheel)
        about = [_about_y(contact - axis, force) for axis in (wheel, pinion)]
        assert about[0] == pytest.approx(sense * 500.0)
        # the pinion feels it backwards, and turns the other way
        assert about[1] == pytest.approx(-sense * 500.0 * pair.pinion.teeth / pair.wheel.teeth)
        assert force @ (wheel - pinion) > 0.0
        assert abs(about[1]) / np.linalg.norm(force) == pytest.approx(pair.pinion.base_radius_mm)


def _about_y(arm: np.ndarray, force: np.ndarray) -> float:
    """Moment about +y of a force at an arm, both x-z."""
    return float(arm[1] * force[0] - arm[0] * force[1])
