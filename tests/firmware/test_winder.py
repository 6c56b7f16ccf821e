"""The firmware's logic on a simulated robot."""

import math
from itertools import pairwise

import pytest
from support.bench_robot import NUMBERS, PRESSED_DEG, STEP_MS, TURN, WINDER, World, jumped, wound
from support.each import each


@each("seed", range(20))
@each(("speed", "jitter", "bounce"), [(180.0, 0, 0), (120.0, 8, 5), (280.0, 3, 4)])
def test_it_winds_to_the_sensor_waits_releases_and_stops(speed: float, jitter: int, bounce: int, seed: int) -> None:
    world = World(speed, jitter, bounce, seed)
    world.wait(0.2)
    assert not any(world.powers)
    world.step(wind=True)
    world.until(WINDER.READY)
    assert TURN - PRESSED_DEG <= world.cam_deg < TURN
    world.wait(5.0)
    assert world.drops == 0
    assert world.power == 0.0
    world.step(jump=True)
    world.until(WINDER.IDLE)
    assert (world.drops, world.winder.jumps) == (1, 1)
    assert max(world.powers) <= 0.9
    # beyond the drop by no more than what the motor turns in the time that it may run on, and a bounce
    assert world.cam_deg - TURN <= 0.9 * speed * (0.060 + 0.010 + 0.030) + 1.0
    world.wait(3.0)
    assert world.power == 0.0


@pytest.mark.parametrize("at_deg", [0.0, 100.0, 340.0])
def test_a_stuck_gear_stops_the_motor_in_time(at_deg: float) -> None:
    world = World()
    world.stuck_at_deg = at_deg
    world.step(wind=True)
    assert world.until(WINDER.FAULT) <= NUMBERS.WIND_MAX_MS / 1000.0 + 0.01
    assert world.power == 0.0
    assert "not wound in time" in world.winder.said


def test_a_gear_that_sticks_at_release_stops_the_motor_in_time() -> None:
    world = wound()
    world.stuck_at_deg = world.cam_deg
    world.step(jump=True)
    assert world.until(WINDER.FAULT) <= NUMBERS.RELEASE_MAX_MS / 1000.0 + 0.01
    assert (world.power, world.winder.jumps) == (0.0, 0)


@each("after_s", [0.0, 0.004, 1.0])
def test_a_sensor_that_lets_go_of_a_wound_robot_is_no_release(after_s: float) -> None:
    """Knocked or crept while it waits, or just as it is told to jump: the cam has not dropped, and the motor stands."""
    world = wound(bounce_ms=0)
    world.wait(1.0)
    world.dead_switch = False
    world.wait(after_s)
    assert (world.winder.state == WINDER.FAULT) == (1000.0 * after_s > NUMBERS.SETTLE_MS)
    world.step(jump=True)
    world.until(WINDER.FAULT, limit_s=0.1)
    assert "let go" in world.winder.said
    world.wait(1.0)
    assert (world.winder.jumps, world.drops, world.power) == (0, 0, 0.0)
    world.dead_switch = None
    world.step(wind=True)
    world.until(WINDER.READY)


@each("at_deg", [10.0, 60.0, 150.0, 250.0, 340.0])
@each("after_a_jump", [False, True])
def test_a_lead_that_breaks_while_winding_stops_the_motor_before_the_drop(at_deg: float, after_a_jump: bool) -> None:
    """Right after a release the sensor is not believed before 900 ms, in which the cam turns by 130°."""
    world = World()
    if after_a_jump:
        world = wound()
        world.step(jump=True)
        world.until(WINDER.IDLE)
        world.wait(2.0)
    drops, start_deg = world.drops, TURN * world.drops
    world.breaks_at_deg = start_deg + at_deg
    world.step(wind=True)
    world.until(WINDER.READY, WINDER.FAULT)
    assert world.power == 0.0
    assert world.drops == drops
    assert (
        world.cam_deg <= start_deg + at_deg + 0.9 * world.speed_deg_s * (NUMBERS.SETTLE_MS + 2 * STEP_MS) / 1000.0 + 1.0
    )
    world.wait(2.0)
    assert (world.power, world.drops) == (0.0, drops)
    if after_a_jump and at_deg <= 100.0:
        assert world.winder.state == WINDER.FAULT
        assert "broken lead" in world.winder.said


def test_what_a_broken_lead_left_half_wound_is_released_in_short_turns() -> None:
    world = jumped()
    world.wait(2.0)
    world.breaks_at_deg = TURN + 100.0
    world.step(wind=True)
    world.until(WINDER.FAULT)
    for _ in range(math.ceil((TURN - 100.0) / (0.9 * 0.9 * world.speed_deg_s * NUMBERS.RELEASE_MAX_MS / 1000.0))):
        world.wait(2.0)
        on = len(world.powers)
        world.step(wind=True)
        assert world.winder.state == WINDER.READY
        world.step(jump=True)
        world.until(WINDER.FAULT)
        assert sum(1 for power in world.powers[on:] if power) * STEP_MS <= NUMBERS.RELEASE_MAX_MS + 2 * STEP_MS
    assert world.drops == 2


@pytest.mark.parametrize("pressed", [False, True])
def test_a_dead_sensor_never_lets_the_motor_run_on(pressed: bool) -> None:
    """A shorted lead ends in the time-out of winding, a broken one in that of the release."""
    world = World()
    world.dead_switch = pressed
    world.wait(0.1)
    world.step(wind=True)
    world.until(WINDER.FAULT, WINDER.READY)
    if pressed:
        world.step(jump=True)
        world.until(WINDER.FAULT)
    assert sum(1 for power in world.powers if power) * STEP_MS <= NUMBERS.WIND_MAX_MS + STEP_MS
    assert world.power == 0.0


def test_the_landing_that_shakes_the_switch_starts_nothing() -> None:
    world = jumped()
    world.shaken_until_ms = world.now_ms + 1400.0
    while world.now_ms < world.shaken_until_ms:
        world.step(wind=True, jump=True)  # a button that the landing presses
        assert world.power == 0.0
    assert world.winder.jumps == 1
    world.wait(0.3)
    world.step(wind=True)
    assert world.winder.state == WINDER.WINDING


def test_a_stop_after_a_jump_is_followed_by_the_next_command_at_once() -> None:
    """Commands are ignored after a landing alone, which has not shaken this robot."""
    world = jumped()
    world.wait(1.6)
    world.step(wind=True)
    world.wait(0.2)
    world.step(stop=True)
    assert world.winder.state == WINDER.IDLE
    world.step(wind=True)
    assert world.winder.state == WINDER.WINDING


def test_it_refuses_to_wind_on_a_low_battery() -> None:
    world = World()
    world.battery_v = 3.49
    world.step(wind=True)
    assert world.winder.state == WINDER.REFUSED
    assert not any(world.powers)
    world.battery_v = 4.1
    world.step(wind=True)
    assert world.winder.state == WINDER.WINDING


def test_a_battery_that_dies_while_winding_stops_it() -> None:
    world = World()
    world.battery_v, world.drain_v_s = 3.51, 0.2
    world.step(wind=True)
    world.until(WINDER.REFUSED)
    assert world.power == 0.0
    assert world.battery_v is not None
    assert 3.25 - 0.2 * 0.25 < world.battery_v < 3.25
    assert world.drops == 0
    assert "may be loaded" in world.winder.said


def test_what_a_low_battery_left_half_wound_is_finished_when_its_voltage_has_recovered() -> None:
    world = World()
    world.battery_v, world.drain_v_s = 3.51, 0.2
    world.step(wind=True)
    world.until(WINDER.REFUSED)
    world.battery_v, world.drain_v_s = 3.29, 0.0
    world.step(wind=True)
    assert world.winder.state == WINDER.REFUSED
    world.battery_v = 3.35
    world.step(wind=True)
    world.until(WINDER.READY)
    world.step(jump=True)
    world.until(WINDER.IDLE)
    assert world.drops == 1
    world.wait(2.0)
    world.step(wind=True)  # slack springs are not wound with so little
    assert world.winder.state == WINDER.REFUSED
    assert world.power == 0.0


def test_a_short_dip_of_the_battery_at_the_start_is_borne() -> None:
    world = World()
    world.step(wind=True)
    world.battery_v = 2.9
    world.wait(0.15)
    world.battery_v = 3.9
    world.until(WINDER.READY)


def test_after_a_restart_what_is_wound_is_released_even_on_a_low_battery() -> None:
    world = wound()
    world.winder = WINDER.Winder(NUMBERS)
    world.battery_v = 3.0
    world.wait(0.5)
    world.step(wind=True)
    assert world.winder.state == WINDER.READY
    world.step(jump=True)
    world.until(WINDER.IDLE)
    assert world.drops == 1


def test_a_battery_that_is_not_measured_is_no_reason_to_refuse() -> None:
    world = World()
    world.battery_v = None
    world.step(wind=True)
    world.until(WINDER.READY)


def test_stop_switches_the_motor_off_at_once_and_winding_goes_on_later() -> None:
    world = World()
    world.step(wind=True)
    world.wait(0.5)
    world.step(stop=True)
    assert world.power == 0.0
    world.wait(1.0)
    assert world.power == 0.0
    world.step(wind=True)
    world.until(WINDER.READY)
    assert world.drops == 0


def test_what_was_stopped_after_a_jump_is_wound_on_without_a_fault() -> None:
    """The rest of a turn takes less than the least time for a whole one, which counts right after a release alone."""
    world = jumped()
    world.wait(2.0)
    world.step(wind=True)
    while world.cam_deg < 1.75 * TURN:
        world.step()
    world.step(stop=True)
    world.wait(2.0)
    world.step(wind=True)
    assert 1000.0 * world.until(WINDER.READY, WINDER.FAULT) < NUMBERS.WIND_MIN_MS
    assert world.winder.state == WINDER.READY
    assert world.drops == 1


def test_a_robot_that_was_switched_off_when_wound_knows_it() -> None:
    world = World()
    world.cam_deg = 355.0
    world.wait(0.1)
    world.step(wind=True)
    assert world.winder.state == WINDER.READY
    assert not any(world.powers)


def test_the_motor_starts_on_a_ramp() -> None:
    world = World()
    world.step(wind=True)
    first = world.power
    world.wait(0.2)
    assert 0.0 < first < 0.5 * world.power
    assert world.power == NUMBERS.PWM_CAP


def test_a_spike_of_one_reading_is_not_the_ready_position() -> None:
    world = World(bounce_ms=0)
    world.step(wind=True)
    for seen in (False, True, False, True):
        world.dead_switch = seen
        world.step()
    assert world.winder.state == WINDER.WINDING


def test_a_spike_before_the_drop_does_not_end_the_release() -> None:
    world = wound(bounce_ms=0)
    world.dead_switch = True
    world.step(jump=True)
    world.dead_switch = False
    world.step()
    world.dead_switch = True
    world.wait(0.3)
    assert world.winder.state == WINDER.RELEASING
    assert world.power > 0.0


def row_of(world: World, count: int) -> list[float]:
    """Let a robot jump in a row until that ends; return when it jumped (s)."""
    row, jumped_s, begun = WINDER.Row(world.winder), list[float](), world.now_ms
    row.begin(count)
    while row.left:
        assert world.now_ms - begun < 100_000.0, world.winder.said
        before = world.drops
        wind, jump = row.commands(round(world.now_ms))
        world.step(wind=wind, jump=jump)
        jumped_s += [world.now_ms / 1000.0] * (world.drops - before)
    return jumped_s


@each("seed", range(5))
def test_a_row_jumps_as_often_as_asked_and_rests_between(seed: int) -> None:
    """3 s to step back; then landing 1.5 s, rest 2 s, winding 2.2 s at 0.9 of 180°/s, rest 2 s."""
    world = World(180.0, 5, 4, seed)
    at = row_of(world, 4)
    assert (len(at), world.winder.jumps, world.winder.state) == (4, 4, WINDER.IDLE)
    assert at[0] > 360.0 / 180.0 / 0.9 + 3.0
    assert [later - sooner for sooner, later in pairwise(at)] == pytest.approx([7.8] * 3, abs=0.3)
    world.wait(5.0)
    assert (world.drops, world.power) == (4, 0.0)


def test_a_row_ends_on_a_low_battery_and_on_a_blocked_motor() -> None:
    low = World()
    low.drain_v_s = 0.1
    assert 0 < len(row_of(low, 9)) < 9
    assert low.winder.state == WINDER.REFUSED
    stuck = World()
    stuck.stuck_at_deg = 2.5 * TURN
    assert len(row_of(stuck, 9)) == 2
    assert (stuck.winder.state, stuck.power) == (WINDER.FAULT, 0.0)


def test_a_row_that_begins_with_a_wound_robot_leaves_time_to_step_back() -> None:
    world = wound()
    world.wait(6.0)
    row = WINDER.Row(world.winder)
    row.begin(1, round(world.now_ms))
    for waited, jumps in ((0, False), (2900, False), (3100, True)):
        assert row.commands(round(world.now_ms) + waited) == (False, jumps)


def test_a_row_that_is_ended_lets_nothing_begin() -> None:
    world = wound()
    row = WINDER.Row(world.winder)
    row.begin(3)
    row.end()
    assert row.commands(10**9) == (False, False)
    assert world.winder.state == WINDER.READY


def turned_deg(world: World, degrees: int, seconds: float) -> float:
    """Turn for a time; return by how much a robot turns whose wheel turns as fast as its voltage says (°).

    The driver's mean voltage is 2·share - 1 of the battery's (TI DRV8833, fast decay).
    """
    wheel, angle = WINDER.Wheel(world.winder), 0.0
    wheel.turn(round(world.now_ms), degrees)
    end = world.now_ms + 1000.0 * seconds
    while world.now_ms < end:
        before = world.now_ms
        world.step()
        left, right = wheel.step(round(world.now_ms), world.battery_v)
        mean_v = (2.0 * max(left, right) - 1.0) * (world.battery_v or 0.0) if left or right else 0.0
        angle += math.copysign(mean_v / NUMBERS.STEER_V * (world.now_ms - before), left - right)
    assert not wheel.turning
    return angle / NUMBERS.STEER_MS_PER_DEG


@each("battery_v", [3.4, 4.2])
@each("degrees", [30, -30, -180])
@each("measured_deg", [90.0, 63.0])
def test_a_wound_robot_turns_by_the_angle_whatever_its_battery_and_floor(
    battery_v: float, degrees: int, measured_deg: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Calibrated as the README says, by 90 over the angle that a turn of 90 was measured to be."""
    monkeypatch.setattr(NUMBERS, "STEER_MS_PER_DEG", 50.0 * 90.0 / measured_deg)
    world = wound()
    world.battery_v = battery_v
    assert turned_deg(world, degrees, 15.0) == pytest.approx(degrees, abs=0.1)
    assert (world.winder.state, world.drops) == (WINDER.READY, 0)


def test_it_turns_in_no_state_but_ready_and_no_longer_than_that_lasts() -> None:
    worlds = [World(), World(), jumped(), wound(), wound()]
    worlds[1].step(wind=True)
    worlds[3].dead_switch = False  # knocked
    worlds[4].battery_v = 3.0
    for world, most in zip(worlds, (0.0, 0.0, 0.0, 0.5, 5.0), strict=True):
        assert 0.0 <= turned_deg(world, 90, 5.0) <= most, world.winder.state
