"""Take-off, found from ground and leg: a foot that chatters is on the ground, one that stays away has left."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.machines import rubbing

from jumpcad.mechanism.model import BODY_NAMES, Mechanism
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

    joint_damping_j = slip_j = 0.0

    def __init__(
        self,
        start: State,
        flights_s: list[tuple[float, float]],
        speed_m_s: float,
        opening_s: float = 0.0,
        hop_m: float = 0.0,
        end_rad: float = 0.0,
    ) -> None:
        self.flights_s, self.steps, self.start = flights_s, 0, start
        self.speed_m_s, self.opening_s, self.hop_m, self.end_rad = speed_m_s, opening_s, hop_m, end_rad

    def advance(self, steps: int) -> float:
        """Return the coordinate of a leg that opens by 1 rad/s, at 0 after `opening_s` if it does not rest before."""
        self.steps += steps
        return min(self.steps * DT_S - self.opening_s, self.end_rad)

    def loaded(self) -> bool:
        time = self.steps * DT_S
        return not any(begin - DT_S / 2 < time < end - DT_S / 2 for begin, end in self.flights_s)

    def state(self) -> State:
        if self.steps == 0:
            return self.start
        velocity = 0.0 * self.start.velocity_m_s
        velocity[:, 2] = self.speed_m_s
        com = self.start.com_m.copy()
        com[:, 2] += 0.0 if self.loaded() else self.hop_m
        return replace(self.start, com_m=com, velocity_m_s=velocity, leg_rad=0.0)


@contextmanager
def released(mechanism: Mechanism) -> Iterator[State]:
    with engine_named("pybullet").world(mechanism, Settings(dt_s=DT_S)) as world:
        yield world.state()


def takeoff_s(
    mechanism: Mechanism,
    flights_s: list[tuple[float, float]],
    speed_m_s: float = 0.1,
    opening_s: float = 0.0,
    hop_m: float = 0.0,
    end_rad: float = 0.0,
    **settings: float,
) -> float | None:
    """Return when a robot with these flights, of that height, is said to take off."""
    with released(mechanism) as start:
        world = Scripted(start, flights_s, speed_m_s, opening_s, hop_m, end_rad)
        run = Run(world, mechanism, Settings(dt_s=DT_S, **settings))
        run.go()
    return run.takeoff.time_s if run.takeoff else None


def test_chatter_is_no_takeoff_and_a_hop_is(kenan: Mechanism) -> None:
    chatter, hop = (0.010, 0.010 + WITHIN_CONTACT_S), (0.020, 0.020 + CONTACT_LOST_S)
    assert takeoff_s(kenan, [chatter]) is None
    assert takeoff_s(kenan, [chatter, hop]) == pytest.approx(0.020)
    assert takeoff_s(kenan, [hop]) == pytest.approx(0.020)


def test_a_hop_while_the_springs_still_push_is_a_part_of_the_push_off(kenan: Mechanism) -> None:
    """The last contact before the leg is at rest counts, and a flight that goes on until then."""
    hop, flight = (0.010, 0.010 + CONTACT_LOST_S), (0.030, 0.060)
    assert takeoff_s(kenan, [hop, flight]) == pytest.approx(0.010)
    assert takeoff_s(kenan, [hop, flight], opening_s=0.020) == pytest.approx(0.030)
    assert takeoff_s(kenan, [hop, flight], opening_s=0.040) == pytest.approx(0.030)


def test_a_leg_that_rests_before_its_end_has_spent_its_springs(kenan: Mechanism) -> None:
    """Friction of its pins holds it there, and nothing drives the robot any more."""
    hop, flight = (0.010, 0.010 + CONTACT_LOST_S), (0.030, 0.060)
    assert takeoff_s(kenan, [hop, flight], opening_s=0.022, end_rad=-0.002) == pytest.approx(0.030)


def test_a_printed_robot_clears_the_ground_by_a_millimetre(kenan: Mechanism) -> None:
    """A robot with friction of its own is a printed one; the study's capsules, and whoever asks, take any hop."""
    flight = [(0.020, 0.060)]
    printed = rubbing(kenan)
    assert takeoff_s(kenan, flight, hop_m=0.0005) == pytest.approx(0.020)
    assert takeoff_s(printed, flight, hop_m=0.0005) is None
    assert takeoff_s(printed, flight, hop_m=0.0015) == pytest.approx(0.020)
    assert takeoff_s(printed, flight, hop_m=0.0005, takeoff_clearance_m=0.0) == pytest.approx(0.020)
    assert takeoff_s(kenan, flight, hop_m=0.0005, takeoff_clearance_m=0.002) is None


def test_a_robot_that_sinks_has_not_taken_off(kenan: Mechanism) -> None:
    """Legs that fold faster than the robot falls lift the foot, and not the robot."""
    assert takeoff_s(kenan, [(0.010, 0.040)], speed_m_s=-0.1) is None


def test_who_stands_60_ms_after_the_springs_came_to_rest_does_not_jump(kenan: Mechanism) -> None:
    """The legs are at rest from the start here, and nothing drives the robot any more."""
    assert takeoff_s(kenan, [(0.050, 0.060)]) == pytest.approx(0.050)
    assert takeoff_s(kenan, [(0.080, 0.090)]) is None


@pytest.mark.parametrize(("speed_m_s", "enough"), [(0.2, False), (0.5, False), (5.0, True)])
def test_who_stays_on_the_ground_is_told_the_speed_that_leaves_it(
    kenan: Mechanism, speed_m_s: float, enough: bool
) -> None:
    """Froude number 1: the root of gravity times the height of the centre of mass; the margin is not positive."""
    with released(kenan) as start:
        world = Scripted(start, [], speed_m_s)
        run = Run(world, kenan, Settings(dt_s=DT_S))
        run.go()
    assert run.takeoff is None
    finding, masses = run.standing(), [kenan.bodies[name].mass_kg for name in BODY_NAMES]
    needed = (9.81 * float(np.dot(masses, start.com_m[:, 2])) / sum(masses)) ** 0.5
    assert (finding.name, finding.severity) == ("no_takeoff", "error")
    assert (finding.value, finding.limit) == pytest.approx((speed_m_s, needed))
    assert finding.margin == pytest.approx(0.0 if enough else speed_m_s - needed)


@pytest.mark.parametrize(
    ("up_m_s", "clear_m", "asked_m", "flies"),
    [
        (1e-9, 0.0, 0.0, True), (0.0, 1.0, 0.0, False), (-1e-9, 1.0, 0.0, False),
        (1.0, 0.002, 0.002, True), (1.0, 0.0019, 0.002, False), (-0.05, 0.01, 0.002, False),
    ],
)  # fmt: skip
def test_a_robot_flies_that_rises_and_has_cleared_the_ground(
    up_m_s: float, clear_m: float, asked_m: float, flies: bool
) -> None:
    """By its centre of mass and its lowest sphere; any clearance will do where none is asked for."""
    run = object.__new__(Run)
    run.clearance_m = asked_m
    run.mechanics = SimpleNamespace(  # type: ignore[assignment]
        velocity_m_s=lambda _: np.array([3.0, 0.0, up_m_s]), clearance_m=lambda _: clear_m
    )
    assert run._flies(None) == flies  # type: ignore[arg-type]
