"""Take-off, found from the ground's force alone: a foot that chatters is on the ground, one that stays up has left."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import pytest

from jumpcad.mechanism.model import Mechanism
from jumpcad.settings import Settings
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.mechanics import State
from jumpcad.simulation.run import Run

pytest.importorskip("pybullet")

DT_S = 0.0005
WITHIN_CONTACT_S, CONTACT_LOST_S = 0.003, 0.006
"""A foot of 10 g on a ground of 10 kN/m swings once in 6 ms, so that half a swing, the time off the ground in one
bounce, is 3 ms; a flight of 6 ms is more than that of any contact."""


class Scripted:
    """A robot that stands with its springs at rest and is off the ground at given times."""

    joint_damping_j = 0.0

    def __init__(self, start: State, flights_s: list[tuple[float, float]], speed_m_s: float) -> None:
        self.flights_s, self.steps, self.start = flights_s, 0, start
        self.speed_m_s = speed_m_s

    def advance(self, steps: int) -> float:
        self.steps += steps
        return 0.0

    def loaded(self) -> bool:
        time = self.steps * DT_S
        return not any(begin - DT_S / 2 < time < end - DT_S / 2 for begin, end in self.flights_s)

    def state(self) -> State:
        if self.steps == 0:
            return self.start
        velocity = 0.0 * self.start.velocity_m_s
        velocity[:, 2] = self.speed_m_s
        return replace(self.start, velocity_m_s=velocity, leg_rad=0.0)


@contextmanager
def released(mechanism: Mechanism) -> Iterator[State]:
    with engine_named("pybullet").world(mechanism, Settings(dt_s=DT_S)) as world:
        yield world.state()


def takeoff_s(mechanism: Mechanism, flights_s: list[tuple[float, float]], speed_m_s: float = 0.1) -> float | None:
    """Return when a robot with these flights is said to take off."""
    with released(mechanism) as start:
        run = Run(Scripted(start, flights_s, speed_m_s), mechanism, Settings(dt_s=DT_S))
        run.go()
    return run.takeoff.time_s if run.takeoff else None


def test_chatter_is_no_takeoff_and_a_hop_is(kenan: Mechanism) -> None:
    chatter, hop = (0.010, 0.010 + WITHIN_CONTACT_S), (0.020, 0.020 + CONTACT_LOST_S)
    assert takeoff_s(kenan, [chatter]) is None
    assert takeoff_s(kenan, [chatter, hop]) == pytest.approx(0.020)
    assert takeoff_s(kenan, [hop]) == pytest.approx(0.020)


def test_a_robot_that_sinks_has_not_taken_off(kenan: Mechanism) -> None:
    """Legs that fold faster than the robot falls lift the foot, and not the robot."""
    assert takeoff_s(kenan, [(0.010, 0.040)], speed_m_s=-0.1) is None


def test_who_stands_60_ms_after_the_springs_came_to_rest_does_not_jump(kenan: Mechanism) -> None:
    """The legs are at rest from the start here, and nothing drives the robot any more."""
    assert takeoff_s(kenan, [(0.050, 0.060)]) == pytest.approx(0.050)
    assert takeoff_s(kenan, [(0.080, 0.090)]) is None
