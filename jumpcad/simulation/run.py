"""One run: from release through take-off to the ballistic or the simulated flight, audited throughout.

An engine moves a `World`. Take-off, flight and audit are found here, in the same way for all engines.
"""

import math
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.findings import Basis, Finding, at_most, higher, limit
from jumpcad.mechanism.model import Mechanism, Multibody
from jumpcad.settings import Settings, coefficients, takeoff_clearance_m
from jumpcad.simulation.flight import Flight, flight, seen_flight
from jumpcad.simulation.jump import EnergyBudget, Trajectory
from jumpcad.simulation.mechanics import Ballistics, Mechanics, State, ballistics, drag_m_s2, drag_per_m, loaded_state
from jumpcad.transforms import Array

AUDIT_EVERY_S = 0.008
AIRBORNE_S = 0.004
"""Without normal force for this long, and rising: the robot has taken off."""
TAKEOFF_WITHIN_S = 0.060
"""A robot on the ground this long after the springs have passed zero does not jump."""
PUSH_OFF_WITHIN_S = 0.5
"""A robot that is no five-bar and stands this long does not jump."""
ENERGY_RATIO_LIMIT = 1.005
"""Mechanical energy over that at release; the run starts at 1, and only what an engine adds can raise it."""
LOOP_GAP_LIMIT_M = 0.0005
LOOK_EVERY_S = 0.0005
"""Of the simulated flight of a robot that is no five-bar, whose steps are finer."""
BASIS = {
    "audit_energy": Basis(
        f"1 + (energy - energy at release)/U ≤ {ENERGY_RATIO_LIMIT:g}, largest of kinetic, potential and springs' "
        "energy during the run",
        "conservation of energy; limit: judgement",
    ),
    "audit_loop": Basis(
        f"largest gap between the two halves of the loop's joint ≤ {1000.0 * LOOP_GAP_LIMIT_M:g} mm",
        "the loop is closed; limit: judgement",
    ),
    "no_takeoff": Basis(
        "v ≥ √(g·z) (m/s), v and z speed and height of the centre of mass when the springs are spent; the verdict "
        "comes from the run, this from its nearest figure",
        "Froude number 1, as in walking",
    ),
}


class World(Protocol):
    """One robot on the ground in an engine, released at time 0."""

    joint_damping_j: float
    """What damping and dry friction of joints and pins have taken so far (J)."""
    slip_j: float
    """What friction on the ground has taken so far (J)."""

    def advance(self, steps: int) -> float:
        """Advance by a number of time steps, the springs acting in each.

        Return the coordinate of the leg joint before the last of them, which needs no extra work. Of a robot that is no
        five-bar, it is minus the share of the springs' energy that is left.
        """

    def pull(self, acceleration_m_s2: Array) -> None:
        """Take another gravity (3,)."""

    def loaded(self) -> bool:
        """Tell whether the ground carries any of the robot's weight."""

    def state(self) -> State:
        """Return where the bodies are and how they move."""


class Engine(Protocol):
    """Makes worlds for robots, and carries out their runs by its `run`: `Run`, or a class derived from it."""

    run: "type[Run]"

    def world(self, mechanism: Any, settings: Settings) -> AbstractContextManager[World]:
        """Put a robot on the ground, ready for release, and remove it afterwards."""


@dataclass(frozen=True)
class Takeoff:
    """The moment after the last contact, and the flight that follows from it."""

    time_s: float
    state: State = field(compare=False)
    ballistics: Ballistics
    flight: Flight | None
    energy: EnergyBudget
    energy_ratio: float


class Run:
    """A run in progress; `go` carries it out, the other attributes hold its results."""

    def __init__(self, world: World, mechanism: Multibody, settings: Settings) -> None:
        self.world, self.mechanism, self.settings = world, mechanism, settings
        self.spring_energy_j = mechanism.spring_energy_j
        self._five_bar = mechanism if isinstance(mechanism, Mechanism) else None
        self.mechanics = Mechanics(mechanism, settings.gravity_m_s2)
        self.clearance_m = takeoff_clearance_m(mechanism, settings)
        self.drag_per_m = drag_per_m(settings.drag_area_m2, mechanism.mass_kg)
        self.steps = 0
        self.takeoff: Takeoff | None = None
        self.touchdown: dict[str, float] = {}
        self.start = world.state()
        self.loaded = loaded_state(self._five_bar) if self._five_bar and mechanism.roller_off else self.start
        self.start_energy_j = self.mechanics.energies(self.start).total_j
        self.worst_energy_ratio = 0.0
        self.worst_gap_m = 0.0
        self._audit_every = max(1, round(AUDIT_EVERY_S / settings.dt_s))
        self._record_every = max(1, round(1 / (settings.trajectory_rate_hz * settings.dt_s)))
        self._records: list[tuple[float, State]] = []
        self._spent: State | None = None

    @property
    def time_s(self) -> float:
        """Time since release (s)."""
        return self.steps * self.settings.dt_s

    def go(self) -> None:
        """Carry out the run as far as the settings ask."""
        self.leave()
        self.finish()

    def leave(self) -> None:
        """Carry out the run up to the take-off."""
        self._look(self.start, self.settings.trajectory)
        self.takeoff = self._push_off()

    def finish(self) -> None:
        """Carry out the flight, if the settings ask for it."""
        if self.takeoff and self.sound and self.settings.flight == "simulated":
            self._fly(self.takeoff)
        self._look(self.world.state(), self.settings.trajectory)

    @property
    def sound(self) -> bool:
        """Tell whether the run has passed its audit so far."""
        return self.worst_energy_ratio <= ENERGY_RATIO_LIMIT and self.worst_gap_m <= LOOP_GAP_LIMIT_M

    def findings(self) -> tuple[Finding, ...]:
        """Return the audit's findings `audit_energy` and `audit_loop`."""
        remedy = "use a smaller dt_s or more solver_iterations; if that does not help, the design is at a dead point"
        return (
            at_most(
                "audit_energy", self.worst_energy_ratio, ENERGY_RATIO_LIMIT, "",
                f"mechanical energy reached {self.worst_energy_ratio:.4f} of the springs' energy; "
                f"the limit is {ENERGY_RATIO_LIMIT}", remedy,
            ),
            limit(
                "audit_loop", 1000.0 * (LOOP_GAP_LIMIT_M - self.worst_gap_m), "mm",
                f"the loop came apart by up to {1000 * self.worst_gap_m:.4f} mm; the limit is "
                f"{1000 * LOOP_GAP_LIMIT_M:g} mm", remedy,
                value=1000.0 * self.worst_gap_m, allowed=1000.0 * LOOP_GAP_LIMIT_M,
            ),
        )  # fmt: skip

    def standing(self) -> Finding:
        """Return the finding `no_takeoff` of a robot that stays on the ground.

        At the end of the push-off, its centre of mass is slower than √(g·height): what rolls over its toes with that
        speed leaves the ground (Froude number 1, as in walking). About the measured limit, not its cause: the verdict
        comes from the run.
        """
        state = self._spent or self.world.state()
        speed = float(np.linalg.norm(self.mechanics.velocity_m_s(state)))
        needed = math.sqrt(self.settings.gravity_m_s2 * max(float(self.mechanics.centre_of_mass_m(state)[2]), 0.0))
        return Finding(
            "no_takeoff", "error", min(speed - needed, 0.0), "m/s",
            f"the robot stays on the ground: its centre of mass gets {speed:.2f} m/s from the springs; about "
            f"{needed:.2f} m/s leave the ground",
            higher("stiffness_nmm_per_deg", "compression_ratio"), speed, needed,
        )  # fmt: skip

    def trajectory(self) -> Trajectory | None:
        """Return what was recorded, or None."""
        if not self._records:
            return None
        energies = [self.mechanics.energies(state) for _, state in self._records]
        rotations = np.concatenate([state.rotation for _, state in self._records])
        order = self.mechanism.order
        return Trajectory(
            order, np.array([time for time, _ in self._records]),
            np.stack([self.mechanics.frame_positions_m(state) for _, state in self._records]),
            Rotation.from_matrix(rotations).as_quat().reshape(-1, len(order), 4),
            np.array([energy.kinetic_j for energy in energies]), np.array([energy.potential_j for energy in energies]),
            np.array([energy.spring_j for energy in energies]),
        )  # fmt: skip

    def _push_off(self) -> Takeoff | None:
        """Go on to the last contact before the robot flies; return None if it does not.

        It flies once it has been in the air for `AIRBORNE_S` and cleared the ground by `clearance_m`, rising, and the
        springs are spent: the leg joint has come to rest, or opens no more. A hop before that is a part of the
        push-off, unless a robot that is to clear the ground stays in the air up to its highest point, where the leg may
        creep open against dry friction.
        """
        world, settings = self.world, self.settings
        half_wound = -self._five_bar.spring.wind_rad / 2 if self._five_bar else -0.5
        hold = max(1, round(AIRBORNE_S / settings.dt_s))
        deadline = settings.max_time_s if self._five_bar else min(settings.max_time_s, PUSH_OFF_WITHIN_S)
        leg_rad = -math.inf
        airborne, rose = 0, False
        left = 0.0, self.start, 0.0, 0.0
        while True:
            # In the first half of the springs' travel nothing leaves the ground, so contacts are not looked up.
            before, leg_rad = leg_rad, self._advance(hold if leg_rad < half_wound else 1)
            if leg_rad >= half_wound:
                airborne = 0 if world.loaded() else airborne + 1
                if airborne == 1:
                    left = self.time_s, world.state(), world.joint_damping_j, world.slip_j
            if leg_rad >= 0:
                self._spent = self._spent or world.state()
                deadline = min(deadline, self.time_s + TAKEOFF_WITHIN_S)
            if self.time_s > deadline or not self.sound:
                return None
            if airborne < hold:
                rose = False
            elif leg_rad >= 0 or leg_rad <= before:
                state = world.state()
                cleared = self.clearance_m == 0.0 or self.mechanics.clearance_m(state) >= self.clearance_m
                if cleared and self._rises(state):
                    return self._takeoff(*left)
            elif airborne % hold == 0:
                rises = self._rises(world.state())
                if rose and not rises and self.mechanics.clearance_m(world.state()) >= self.clearance_m > 0.0:
                    return self._takeoff(*left)
                rose = rises

    def _rises(self, state: State) -> bool:
        return float(self.mechanics.velocity_m_s(state)[2]) > 0.0

    def _fly(self, takeoff: Takeoff) -> None:
        """Advance to the first touch of any part; a five-bar is looked at in each step."""
        mechanics, off = self.mechanics, False
        every = 1 if self._five_bar else max(1, round(LOOK_EVERY_S / self.settings.dt_s))
        states = [takeoff.state]
        while self.time_s < self.settings.max_time_s and self.sound:
            if self.drag_per_m:  # on all bodies alike, as a part of gravity: it turns nothing
                air = drag_m_s2(mechanics.velocity_m_s(self.world.state()), self.drag_per_m)
                self.world.pull(air - np.array([0.0, 0.0, self.settings.gravity_m_s2]))
            self._advance(every)
            state = self.world.state()
            if not self._five_bar:
                states.append(state)
            above = mechanics.lowest_m(state) > 0.0
            if self.world.loaded() or (off and not above):
                here, start = (mechanics.centre_of_mass_m(one)[0] for one in (state, self.loaded))
                self.touchdown = {"touchdown_distance_m": float(here - start)}
                if not self._five_bar:
                    air_s = self.time_s - takeoff.time_s
                    self.touchdown = vars(seen_flight(self.mechanism, mechanics, self.loaded, states, air_s))
                return
            off = off or above

    def _advance(self, steps: int) -> float:
        """Like `World.advance`, but stop wherever the audit or the trajectory needs a state."""
        goal = self.steps + steps
        while True:
            stop = min(goal, self.steps + self._audit_every - self.steps % self._audit_every)
            if self.settings.trajectory:
                stop = min(stop, self.steps + self._record_every - self.steps % self._record_every)
            leg_rad = self.world.advance(stop - self.steps)
            self.steps = stop
            record = self.settings.trajectory and stop % self._record_every == 0
            if record or stop % self._audit_every == 0:
                self._look(self.world.state(), record)
            if stop == goal:
                return leg_rad

    def _look(self, state: State, record: bool) -> None:
        """Audit a state against the energy at release, counted as that of the springs, and record it if asked for.

        A state that is not finite (a run that blew up) counts as infinitely bad, and is not recorded.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            gained_j = self.mechanics.energies(state).total_j - self.start_energy_j
            ratio, gap_m = 1.0 + gained_j / self.spring_energy_j, self.mechanics.loop_gap_m(state)
        finite = math.isfinite(ratio) and math.isfinite(gap_m)
        self.worst_energy_ratio = max(self.worst_energy_ratio, ratio if finite else math.inf)
        self.worst_gap_m = max(self.worst_gap_m, gap_m if finite else math.inf)
        if finite and record and (not self._records or self._records[-1][0] < self.time_s):
            self._records.append((self.time_s, state))

    def _takeoff(self, time_s: float, state: State, joint_damping_j: float, slip_j: float) -> Takeoff:
        """Return what the state in which the robot left the ground leads to."""
        mechanics, mass = self.mechanics, self.mechanics.total_mass_kg
        energies = mechanics.energies(state)
        start, here = mechanics.centre_of_mass_m(self.loaded), mechanics.centre_of_mass_m(state)
        velocity = mechanics.velocity_m_s(state)
        forward, upward = 0.5 * mass * float(velocity[0]) ** 2, 0.5 * mass * float(velocity[2]) ** 2
        wound, loaded_j = self.spring_energy_j, mechanics.energies(self.loaded).total_j
        left, release_j = energies.total_j - loaded_j + wound, loaded_j - self.start_energy_j
        budget = EnergyBudget(
            forward_j=forward, upward_j=upward, internal_j=energies.kinetic_j - forward - upward,
            lift_j=mechanics.weight_n * float(here[2] - start[2]), spring_j=energies.spring_j, release_j=release_j,
            joint_damping_j=joint_damping_j, slip_j=slip_j,
            contact_j=wound - left - release_j - joint_damping_j - slip_j,
        )  # fmt: skip
        reach = 2.0 * self.mechanism.length_m  # farther than any contact is from the centre
        path = ballistics(start, here, velocity, self.settings.gravity_m_s2, self.drag_per_m, reach)
        flown = None
        if self._five_bar:
            damping = coefficients(self.mechanism, self.settings).joint_damping_nms_per_rad
            flown = flight(self._five_bar, mechanics, self.loaded, state, path, damping)
        return Takeoff(time_s, state, path, flown, budget, left / wound)
