"""The gear motor as a DC machine, at its two ends: unloaded, and at the torque that it may give."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.built import built
from support.limits import default_limits

from jumpcad.catalogue import load_catalogue
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.motor import (
    allowed_nm,
    cap_ear_mm,
    free_speed_rad_s,
    front_length_mm,
    least_ratio,
    lift_s,
    socket_half_mm,
    winding,
    window_mm,
)
from jumpcad.electronics.supply import Supply

MOTOR = load_catalogue().motors["n20-298"]
LIMITS = default_limits().train


def law(stiffness_nm_per_rad: float) -> CamLaw:
    return CamLaw(math.radians(50), stiffness_nm_per_rad, math.radians(310), math.radians(30))


def test_without_a_spring_the_cam_turns_at_the_motors_free_speed() -> None:
    turn = winding(law(1e-9), MOTOR, 3.0, 0.8)
    assert turn.seconds == pytest.approx(3.0 * 60.0 / MOTOR.no_load_rpm, rel=1e-6)
    assert turn.mean_current_a == pytest.approx(MOTOR.no_load_current_a, rel=1e-6)
    assert turn.electrical_j == pytest.approx(MOTOR.voltage_v * MOTOR.no_load_current_a * turn.seconds, rel=1e-6)


def test_a_turn_takes_the_sum_of_the_times_at_each_torque_also_where_that_falls_before_the_drop() -> None:
    """A DC motor turns at (1 - share of the stall torque) of its free speed; summed over small angles."""
    spring = replace(law(1.0), ease_rad=math.radians(25))
    ratio = spring.peak_torque_nm / (0.4 * MOTOR.stall_torque_nm)
    cam = np.linspace(0.0, spring.lift_rad, 20001)
    slower = 1.0 / (1.0 - spring.torque_nm(cam) / (ratio * MOTOR.stall_torque_nm))
    summed = ratio / free_speed_rad_s(MOTOR) * np.trapezoid(slower, cam)
    assert lift_s(spring, MOTOR, ratio, 1.0, spring.lift_rad) == pytest.approx(summed, rel=1e-6)


def test_at_half_of_its_stall_torque_a_motor_turns_half_as_fast_and_draws_half_of_the_way_to_stall() -> None:
    spring = law(1.0)
    ratio = spring.peak_torque_nm / (0.5 * MOTOR.stall_torque_nm)
    turn = winding(spring, MOTOR, ratio, 1.0)
    assert turn.peak_current_a == pytest.approx((MOTOR.no_load_current_a + MOTOR.stall_current_a) / 2.0)
    free, shorter = ratio / free_speed_rad_s(MOTOR), winding(replace(spring, lift_rad=math.radians(300)), MOTOR, 1e9, 1)
    assert shorter.peak_current_a == pytest.approx(MOTOR.no_load_current_a, rel=1e-6)
    # unloaded for 50° of the turn, at half of the free speed for 280°, in between on the ramp of 30°
    assert free * math.radians(50 + 2 * 280 + 30) < turn.seconds < free * math.radians(50 + 2 * 310)


def test_what_a_turn_draws_is_the_current_over_the_time_of_each_of_its_angles() -> None:
    """In closed form up to half of the stall torque: the ramp's share s grows evenly, at (1 - s) of the free speed."""
    spring = law(1.0)
    ratio = spring.peak_torque_nm / (0.5 * MOTOR.stall_torque_nm)
    turn, free = winding(spring, MOTOR, ratio, 1.0), ratio / free_speed_rad_s(MOTOR)
    least, more = MOTOR.no_load_current_a, MOTOR.stall_current_a - MOTOR.no_load_current_a
    ramp, even, loose = (math.radians(angle) for angle in (30.0, 280.0, 50.0))
    log = math.log(2.0)
    seconds = free * (ramp / 0.5 * log + 2.0 * even + loose)
    drawn = ramp / 0.5 * (least * log + more * (log - 0.5)) + 2.0 * even * (least + 0.5 * more) + loose * least
    assert turn.seconds == pytest.approx(seconds)
    assert turn.mean_current_a == pytest.approx(free * drawn / seconds, rel=1e-4)
    assert turn.electrical_j == pytest.approx(MOTOR.voltage_v * free * drawn, rel=1e-4)


def test_the_lift_takes_its_time_under_load() -> None:
    """At half of the stall torque: half of the free speed, and on the ramp as the logarithm of what is left of it."""
    spring = law(1.0)
    ratio = spring.peak_torque_nm / (0.5 * MOTOR.stall_torque_nm)
    free, ramp = ratio / free_speed_rad_s(MOTOR), math.radians(30.0)
    half, whole, end = (lift_s(spring, MOTOR, ratio, 1.0, math.radians(angle)) for angle in (15.0, 30.0, 310.0))
    assert lift_s(spring, MOTOR, ratio, 1.0, 0.0) == 0.0
    assert half == pytest.approx(free * ramp / 0.5 * math.log(4.0 / 3.0))
    assert whole == pytest.approx(free * ramp / 0.5 * math.log(2.0))
    assert end == pytest.approx(whole + free * 2.0 * math.radians(280.0))
    assert end == pytest.approx(winding(spring, MOTOR, ratio, 1.0).seconds - free * math.radians(50.0))


def test_the_weaker_of_stall_share_and_gearbox_limits_the_torque() -> None:
    assert allowed_nm(MOTOR, replace(LIMITS, stall_share=0.2, torque_max_nm=9.0)) == 0.2 * MOTOR.stall_torque_nm
    assert allowed_nm(MOTOR, replace(LIMITS, stall_share=0.2, torque_max_nm=0.01)) == 0.01


def test_a_motor_gives_at_most_six_tenths_of_what_it_stalls_with_on_an_empty_battery() -> None:
    supply = Supply(1.0, 3.7, 4.2, 0.5, 0.1, 1.0)
    limits = replace(LIMITS, supply=supply, stall_share=0.9, torque_max_nm=9.0)
    stall = supply.driven(MOTOR, 1.0, limits.blocked_nm).stall_torque_nm
    assert 0.0 < stall < 0.9 * MOTOR.stall_torque_nm
    assert allowed_nm(MOTOR, limits) == pytest.approx(0.6 * stall)


def test_the_least_ratio_is_that_of_torque_or_of_speed() -> None:
    """A strong spring asks for torque, through the losses of cam and pairs; a weak one only for a slow cam."""
    strong, weak = law(10.0), law(1e-6)
    losses = LIMITS.cam_efficiency * LIMITS.pair_efficiency**2
    torque = strong.peak_torque_nm / losses / allowed_nm(MOTOR, LIMITS)
    assert least_ratio(strong, MOTOR, LIMITS, 2) == pytest.approx(torque)
    assert least_ratio(weak, MOTOR, LIMITS, 1) == free_speed_rad_s(MOTOR) / LIMITS.cam_speed_max_rad_s


def test_the_cam_is_no_quicker_than_allowed_on_a_full_battery() -> None:
    """With weak springs the speed decides: that of the unloaded motor at the largest voltage."""
    supply = Supply(3.3, 3.7, 4.2, 0.5, 0.1, 1.0)
    limits = replace(LIMITS, supply=supply)
    full = supply.driven(MOTOR, 4.2, limits.blocked_nm).no_load_rpm * math.pi / 30.0
    assert full > supply.driven(MOTOR, 3.3, limits.blocked_nm).no_load_rpm * math.pi / 30.0
    assert full / least_ratio(law(1e-6), MOTOR, limits, 1) == pytest.approx(limits.cam_speed_max_rad_s)


def test_the_socket_has_walls_around_the_motor_and_ears_across() -> None:
    """A motor of 10 x 12 mm, 0.3 mm of play and a wall of 1.6 mm on every side, ears of 5.6 mm."""
    motor = built("kenan-2.0").layout.drive.train.motor
    assert (motor.width_mm, motor.height_mm) == (10.0, 12.0)
    assert socket_half_mm(motor) == pytest.approx((5.0 + 1.9, 6.0 + 1.9 + 5.6))


@pytest.mark.parametrize(("wall", "ear"), [(0.5, 5.6), (0.8, 5.64), (1.2, 6.44)])
def test_ears_have_printable_walls_on_both_sides_of_a_counterbore_of_4_mm(wall: float, ear: float) -> None:
    assert cap_ear_mm(wall) == pytest.approx(ear)


def test_a_boss_that_is_longer_than_the_cap_reaches_further() -> None:
    motor = built("kenan-2.0").layout.drive.train.motor
    capped = front_length_mm(motor.model_copy(update={"boss_length_mm": 0.0}))
    assert capped == front_length_mm(motor)
    assert front_length_mm(motor.model_copy(update={"boss_length_mm": capped + 3.0})) == capped + 3.0


def test_the_sockets_floor_holds_a_millimetre_of_the_motors_rear_on_every_side() -> None:
    """A motor of 10 x 12 mm; the rest is open for terminals and wires."""
    assert window_mm(built("kenan-2.0").layout.drive.train.motor) == (8.0, 10.0)


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
    limits.driven(motor, "empty")
    assert asked == [(motor, 3.7, 0.21), (motor, 3.3, 0.21)]
    bench = replace(limits, supply=None)
    assert bench.driven(motor) is bench.driven(motor, "empty") is motor


def test_an_idlers_wheel_passes_beside_the_spacers_of_the_cams_axle() -> None:
    """Tubes of 6.4 mm, and 0.8 mm as between all that does not touch; a motor is as high as an N20, 12 mm."""
    limits = default_limits().train
    assert limits.axle_mm == pytest.approx(6.4 / 2.0 + 0.8)
    assert limits.motor_distance_min_mm == load_catalogue().motors["n20-298"].height_mm


def test_modules_are_those_of_iso_54() -> None:
    """Its first series: 1, 1.25, 1.5, 2, 2.5, 3."""
    assert set(default_limits().train.modules_mm) <= {1.0, 1.25, 1.5, 2.0, 2.5, 3.0}
