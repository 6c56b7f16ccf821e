"""Losses of a gear train multiply."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from support.limits import default_limits

from jumpcad.catalogue import load_catalogue


def test_every_pair_takes_its_share_of_the_work() -> None:
    limits = replace(default_limits().train, cam_efficiency=0.8, pair_efficiency=0.5)
    assert [limits.efficiency(pairs) for pairs in (0, 1, 2)] == pytest.approx([0.8, 0.4, 0.2])


def test_a_motor_asks_for_the_room_of_its_shaft_and_of_its_sockets_flat_side() -> None:
    """A socket 10 + 2·1.9 mm wide, 12 + 2·(1.9 + 5.6) mm high: its nearer faces are 6.9 mm from the shaft."""
    limits = replace(default_limits().train, cam_room_mm=9.0, shaft_wall_mm=1.5, pinion_root_min_mm=0.0)
    motor = load_catalogue().motors["n20-298"]
    beside = limits.beside(motor)
    assert beside.motor_distance_min_mm == pytest.approx(9.0 + 6.9)
    assert beside.pinion_root_min_mm == pytest.approx(1.5 + 1.5)
    roomy = replace(limits, motor_distance_min_mm=20.0, pinion_root_min_mm=4.0).beside(motor)
    assert (roomy.motor_distance_min_mm, roomy.pinion_root_min_mm) == (20.0, 4.0)


def test_a_motor_winds_at_the_nominal_voltage_and_must_manage_with_an_empty_battery() -> None:
    """Both at the torque at which it would block; a motor on a bench supply is as its data sheet says."""
    asked = []
    supply = SimpleNamespace(nominal_v=3.7, empty_v=3.3, driven=lambda *given: asked.append(given))
    limits = replace(default_limits().train, supply=supply, blocked_nm=0.21)
    motor = load_catalogue().motors["n20-298"]
    limits.driven(motor)
    limits.weakest(motor)
    assert asked == [(motor, 3.7, 0.21), (motor, 3.3, 0.21)]
    bench = replace(limits, supply=None)
    assert bench.driven(motor) is bench.weakest(motor) is motor


def test_an_idlers_wheel_passes_beside_the_spacers_of_the_cams_axle() -> None:
    """Tubes of 6.4 mm, and 0.8 mm as between all that does not touch; a motor is as high as an N20, 12 mm."""
    limits = default_limits().train
    assert limits.axle_mm == pytest.approx(6.4 / 2.0 + 0.8)
    assert limits.motor_distance_min_mm == load_catalogue().motors["n20-298"].height_mm


def test_modules_are_those_of_iso_54() -> None:
    """Its first series: 1, 1.25, 1.5, 2, 2.5, 3."""
    assert set(default_limits().train.modules_mm) <= {1.0, 1.25, 1.5, 2.0, 2.5, 3.0}
