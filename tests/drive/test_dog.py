"""The dog's rule of play, and its jaws in their pockets."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from jumpcad.drive import dog
from jumpcad.drive.dog import Dog, _flight_s, damping_share, free_play_rad, largest_torques_nm


@pytest.mark.parametrize(("roll_over_deg", "play_deg"), [(5.0, 12.0), (9.0, 12.0), (12.0, 15.0), (22.0, 25.0)])
def test_the_play_is_the_roll_over_and_3_degrees_and_at_least_12(roll_over_deg: float, play_deg: float) -> None:
    assert math.degrees(free_play_rad(math.radians(roll_over_deg))) == pytest.approx(play_deg)
    assert float(free_play_rad(math.radians(roll_over_deg), 0.5)) == 0.5


def test_a_jaw_fills_its_pocket_but_for_the_play_ahead_of_it() -> None:
    """The cam turns clockwise, so that it is pushed at a jaw's counter-clockwise end, the larger angle."""
    dog = Dog(math.radians(20.0), 14.0)
    for (begin, end), (low, high) in zip(dog.cam_jaws_rad, dog.pockets_rad, strict=True):
        assert high == end
        assert begin - low == pytest.approx(math.radians(20.0))
    (begin, first), (low, second) = dog.pockets_rad
    own = low - first, begin + 2.0 * math.pi - second  # the gear's own jaws, as wide as the cam's on average
    assert sum(own) / 2.0 == pytest.approx(dog.jaw_rad)
    assert 2.0 * (2.0 * dog.jaw_rad + dog.play_rad) == pytest.approx(2.0 * math.pi)


@pytest.mark.parametrize("play_deg", [12.0, 25.0])
def test_the_gear_fits_in_one_position_only(play_deg: float) -> None:
    """Turned by half a turn, and by as much as helps most, the cam's jaws overlap the pockets' ends by 6°."""
    dog = Dog(math.radians(play_deg), 14.0)

    def overlap_rad(turned_rad: float) -> float:
        jaws = [(begin + turned_rad, end + turned_rad) for begin, end in dog.cam_jaws_rad]
        over = 0.0
        for begin, end in jaws:
            middle = (begin + end) / 2.0
            turns = (-2.0 * math.pi, 0.0, 2.0 * math.pi)
            pockets = [(low + turn, high + turn) for low, high in dog.pockets_rad for turn in turns]
            low, high = min(pockets, key=lambda pocket: abs(sum(pocket) / 2.0 - middle))
            over += max(low - begin, 0.0) + max(end - high, 0.0)
        return over

    turns = [math.radians(step / 10.0) for step in range(-300, 301)]
    assert min(map(overlap_rad, turns)) == pytest.approx(0.0, abs=1e-9)
    assert min(overlap_rad(math.pi + turn) for turn in turns) == pytest.approx(math.radians(6.0), abs=1e-6)
    first, second = ((begin + end) / 2.0 for begin, end in dog.cam_jaws_rad)
    assert second - first == pytest.approx(math.pi + math.radians(play_deg / 2.0 + 3.0))


CAM, GEAR, ROTOR = 6e-7, 2e-6, 3e-3
"""Moments of inertia at the cam (kg·m²) of a usual drive."""


@pytest.mark.parametrize("rebound", [0.4, 0.5, 0.8, 1.0])
def test_a_spring_with_a_damper_throws_back_as_said(rebound: float) -> None:
    """A mass of 1 kg on a spring of 1 N/m, until the force is zero."""
    share = damping_share(rebound)

    def pushes(_: float, state: np.ndarray) -> float:
        return float(state[0] + 2.0 * share * state[1])

    pushes.terminal, pushes.direction = True, -1.0  # type: ignore[attr-defined]
    flight = solve_ivp(
        lambda t, s: [s[1], -pushes(t, s)], (0.0, 10.0), [1e-9, 1.0], events=pushes, rtol=1e-9, atol=1e-12
    )
    assert -flight.y[1, -1] == pytest.approx(rebound, abs=1e-4)


def test_two_masses_without_losses_meet_with_the_root_of_the_stiffness() -> None:
    """½·m·v² = ½·T²/k with the reduced mass."""
    blow, _ = largest_torques_nm((CAM, GEAR, ROTOR), 60.0, 0.0, 1e6, 150.0, 1.0)
    assert blow == pytest.approx(60.0 * math.sqrt(150.0 * CAM * GEAR / (CAM + GEAR)), rel=0.01)


def test_a_light_cam_throws_the_gear_and_the_rotor_stops_it() -> None:
    """Without losses the gear leaves with 2·J/(J + Jg) of the cam's speed, and an endless rotor stops it."""
    _, kick = largest_torques_nm((CAM, GEAR, 1e6), 60.0, 0.0, 0.02, 150.0, 1.0)
    thrown = 60.0 * 2.0 * CAM / (CAM + GEAR)
    assert kick == pytest.approx(thrown * math.sqrt(150.0 * GEAR), rel=0.01)


def test_without_backlash_cam_and_gear_stop_together_at_most() -> None:
    """All of the cam's energy in the spring of the rotor is the most there can be."""
    for rebound in (0.3, 0.5, 1.0):
        _, kick = largest_torques_nm((CAM, GEAR, ROTOR), 60.0, 0.0, 0.0, 150.0, rebound)
        assert 0.0 < kick <= 60.0 * math.sqrt(150.0 * CAM) * 1.001


@pytest.mark.parametrize(
    ("backlash_deg", "heavier", "rebound", "rotor"),
    [(0.0, 1, 0.5, ROTOR), (0.3, 1, 0.5, ROTOR), (2.0, 1, 0.5, ROTOR), (2.8, 4, 0.65, ROTOR), (0.0, 0.25, 0.4, 2e-6)],
)
def test_the_torques_are_those_of_an_independent_solver(
    backlash_deg: float, heavier: float, rebound: float, rotor: float
) -> None:
    """A cam that is heavier than the gear catches up with it again on its way back from the rotor.

    With a rotor lighter than the gear, the damping between both hangs on both.
    """
    speed, motor, k, share = 60.0, 1.5, 150.0, damping_share(rebound)
    gap, cam, gear = math.radians(backlash_deg), CAM * heavier, GEAR / heavier
    dampings = [2.0 * share * math.sqrt(k * a * b / (a + b)) for a, b in ((cam, gear), (gear, rotor))]

    def torques(state: np.ndarray) -> list[float]:
        deep = (state[0] - state[1], state[1] - state[2] - gap)
        closing = (state[3] - state[4], state[4] - state[5])
        return [max(k * d + c * v, 0.0) if d > 0.0 else 0.0 for d, v, c in zip(deep, closing, dampings, strict=True)]

    def motion(_: float, state: np.ndarray) -> list[float]:
        dog, head = torques(state)
        return [*state[3:], -dog / cam, (dog - head) / gear, head / rotor]

    start = [1e-12, 0.0, 0.0, speed, motor, motor]
    solved = solve_ivp(motion, (0.0, min(0.0015 + gap / 2.0, 0.008)), start, max_step=2e-6, rtol=1e-7, atol=1e-12)
    expected = np.array([torques(state) for state in solved.y.T]).max(axis=0)
    found = largest_torques_nm((cam, gear, rotor), speed, motor, gap, k, rebound)
    assert found == pytest.approx(expected, rel=0.01)


def test_finer_steps_give_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    usual = largest_torques_nm((CAM, GEAR, ROTOR), 60.0, 1.5, 0.03, 150.0, 0.5)
    monkeypatch.setattr(dog, "STEP_SHARE", 0.002)
    assert usual == pytest.approx(largest_torques_nm((CAM, GEAR, ROTOR), 60.0, 1.5, 0.03, 150.0, 0.5), rel=0.01)


def test_a_cam_that_flies_off_ends_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """A light cam rebounds from a heavy gear more slowly than the motor turns the gear: the two never meet again."""
    flights: list[float] = []
    fly = dog._flight_s
    monkeypatch.setattr(dog, "_flight_s", lambda *state: flights.append(state[1]) or fly(*state))
    largest_torques_nm((8.3e-8, 1.67e-6, 0.0693), 1.99, 0.322, 0.014, 150.0, 0.5)
    assert len(flights) == 3  # to the gear, which flies on to the rotor, and back from it, with less than it brought
    assert flights[1] < 0.0  # after the first impact the cam falls back


@pytest.mark.parametrize(
    ("dog", "closing", "head", "ahead", "time_s"),
    [
        (-0.02, 4.0, -0.01, 0.0, 0.005),  # the cam behind the gear, which keeps its place before the rotor
        (-0.02, 4.0, -0.01, 5.0, 0.002),  # the gear meets the rotor before
        (-0.02, 4.0, -0.01, -5.0, 0.004),  # it falls back to the other end of a backlash of 0.03 rad before
        (-0.02, -4.0, -0.01, -2.0, 0.01),
        (-0.02, -4.0, -0.01, 0.0, math.inf),
        (-0.02, 0.0, -0.01, 0.0, math.inf),
    ],
)
def test_a_flight_ends_at_the_first_of_three_contacts(
    dog: float, closing: float, head: float, ahead: float, time_s: float
) -> None:
    assert _flight_s(dog, closing, head, ahead, 0.03) == pytest.approx(time_s)
