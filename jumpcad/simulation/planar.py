"""The planar engine: the push-off in x-z by a compiled loop, about fifty times as fast as in a general engine.

It models the x-z plane only. Contact of the body with the ground before take-off is not modelled; the finding
`body_contact` reports it. The compiled loop finds the take-off by the rule of `Run`, which does everything else.
"""

import math
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from jumpcad.errors import JumpcadError
from jumpcad.findings import Basis, Finding, limit
from jumpcad.mechanism.linkage import Complex as ComplexArray
from jumpcad.mechanism.model import BODY_NAMES, Mechanism, release_pose
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.settings import Settings, takeoff_clearance_m
from jumpcad.simulation import planar_kernel as kernel
from jumpcad.simulation import run
from jumpcad.simulation.flight import MOMENTS, SLOWEST, SWING_POINTS
from jumpcad.simulation.mechanics import State, surface
from jumpcad.simulation.planar_model import PushOff, StepState, planar_model
from jumpcad.simulation.run import AIRBORNE_S, AUDIT_EVERY_S, TAKEOFF_WITHIN_S, Run, Takeoff
from jumpcad.transforms import Array

LACKING = ("restitution", "rolling_friction_m")
"""Settings that a planar engine does not support."""
BASIS = {
    **run.BASIS,
    "body_contact": Basis("least height of the body above the ground during the push-off ≥ 0 (mm)", "geometry"),
}


class PlanarWorld:
    """One robot in the plane; a `World` for `Run`."""

    def __init__(self, mechanism: Mechanism, settings: Settings, pins_nm: float | None = None) -> None:
        self.model = planar_model(mechanism, settings, pins_nm)
        self.settings = settings
        self.clearance_m = takeoff_clearance_m(mechanism, settings)
        self._aside_m = [mechanism.bodies[name].com_m[1] for name in BODY_NAMES]
        self.joint_damping_j = self.slip_j = 0.0
        release = release_pose(mechanism)
        leg = mechanism.spring.joint
        self.moment = kernel.released(
            self.model, release.joint_rad[leg], release.joint_rad_s[leg], complex(0.0, mechanism.foot_depth_m)
        )

    def go_to(self, moment: StepState) -> None:
        """Go to another moment of the same motion."""
        self.moment = moment
        self.joint_damping_j = moment.losses.damping_j + moment.losses.friction_j
        self.slip_j = moment.losses.slip_j

    def push_off(self) -> PushOff:
        """Return how the push-off from this moment ends, staying where it is."""
        dt = self.settings.dt_s
        audit = max(1, round(AUDIT_EVERY_S / dt))
        return kernel.push_off(
            self.model, self.moment, dt, AIRBORNE_S, self.clearance_m, TAKEOFF_WITHIN_S, self.settings.max_time_s, audit
        )

    def advance(self, steps: int) -> float:
        """Advance by a number of time steps; return the leg joint's coordinate before the last of them."""
        before = kernel.advance(self.model, self.moment, self.settings.dt_s, steps - 1)
        self.go_to(kernel.advance(self.model, before, self.settings.dt_s, 1))
        if not self.moment.closed:
            raise JumpcadError(
                "foot and front link come into line in flight, a dead point that the planar engine cannot pass: use "
                "--engine pybullet or "
                'flight = "ballistic"'
            )
        return before.leg_rad

    def pull(self, acceleration_m_s2: Array) -> None:
        """Take another gravity (3,)."""
        self.model = self.model._replace(pull_m_s2=complex(acceleration_m_s2[0], acceleration_m_s2[2]))

    def loaded(self) -> bool:
        """Tell whether the ground carries the foot, or the body touches it."""
        contact = self.moment.contact
        return contact.first_ns + contact.second_ns > 0.0 or self.moment.belly_gap_m <= 0.0

    def state(self) -> State:
        """Return where the bodies are and how they move."""
        model, moment, speed = self.model, self.moment, self.moment.speed
        links = kernel.links_at(model, moment.leg_rad)
        turn = complex(math.cos(moment.foot_rad), -math.sin(moment.foot_rad))
        leg, front = -links.back_pivot / model.l2_m, (model.l4_m - links.front_pivot) / model.l3_m
        directions = np.array([links.pitch, leg, front, 1.0]) * turn
        place, place1 = np.array(links.place), np.array(links.place1)
        com = moment.ankle_m + place * turn
        velocity = speed.ankle + (place1 * speed.leg - 1j * place * speed.foot) * turn
        still = np.zeros(len(BODY_NAMES))
        return State(
            np.column_stack([com.real, self._aside_m, com.imag]), _about_y(directions),
            np.column_stack([velocity.real, still, velocity.imag]),
            np.column_stack([still, speed.foot + np.array(links.turn1) * speed.leg, still]), (moment.leg_rad,),
        )  # fmt: skip


class PlanarRun(Run):
    """A run whose push-off is one call of the compiled loop."""

    body_gap_m = math.inf
    """Least distance of the body from the ground during the push-off."""

    def findings(self) -> tuple[Finding, ...]:
        """Return the audit's findings, and `body_contact` where the body has touched the ground."""
        if self.body_gap_m > 0.0:
            return super().findings()
        deep_mm = -1000.0 * self.body_gap_m
        touching = limit(
            "body_contact", -deep_mm, "mm",
            f"the body reaches {deep_mm:.2f} mm below the ground during the push-off, of 0 mm at most",
            "use --engine pybullet: the planar engine stops when the body touches the ground", violated="warning",
        )  # fmt: skip
        return (*super().findings(), touching)

    def _push_off(self) -> Takeoff | None:
        """Advance to the last contact before the robot flies; record on the way if asked for."""
        world = self.world
        assert isinstance(world, PlanarWorld)
        found = world.push_off()
        gained = found.worst_gain_j / self.spring_energy_j
        self.worst_energy_ratio = max(self.worst_energy_ratio, 1.0 + gained)
        self.body_gap_m = found.belly_gap_m
        if self.settings.trajectory and found.steps:
            self._advance(found.steps)
        world.go_to(found.moment)
        self.steps = found.steps
        if not (found.flown and self.sound):
            return None
        return self._takeoff(self.time_s, world.state(), world.joint_damping_j, world.slip_j)


def touchdown(mechanism: Mechanism, settings: Settings, pins_nm: float | None = None) -> tuple[float, float] | None:
    """Return way (m) and pitch (°) at the touchdown; None of what does not take off. No gate, no audit, no air.

    Of a robot whose leg meets a stop: the jump of `simulate` in a sixth of its time, all compiled. `pins_nm` is the
    friction of the pins if known.
    """
    world = PlanarWorld(with_spring_factor(mechanism, settings.spring_efficiency), settings, pins_nm)
    found = world.push_off()
    if not found.flown:
        return None
    around = surface(mechanism)
    corners = (
        np.concatenate([at for at, _ in around.values()]),
        np.concatenate([np.full(len(at), BODY_NAMES.index(name)) for name, (at, _) in around.items()]),
        np.concatenate([radius for _, radius in around.values()]),
    )
    below_m, wind = 2.0 * mechanism.design.l_max_mm / 1000.0, mechanism.spring.wind_rad
    way, pitch = kernel.touchdown(world.model, found.moment, -wind, corners, below_m, SWING_POINTS, MOMENTS, SLOWEST)
    return way, (math.degrees(pitch) + 180.0) % 360.0 - 180.0


class PlanarEngine:
    """Makes planar worlds."""

    run = PlanarRun

    @contextmanager
    def world(self, mechanism: Mechanism, settings: Settings) -> Iterator["PlanarWorld"]:
        """Put a robot on the ground, ready for release."""
        for key in LACKING:
            if value := getattr(settings, key):
                raise JumpcadError(
                    f"{key} = {value}: the planar engine does not support it: leave it out or use --engine pybullet"
                )
        yield PlanarWorld(mechanism, settings)


def _about_y(direction: ComplexArray) -> Array:
    """Return the turns (n, 3, 3) about +y that take the x axis to directions x + iz (n,)."""
    turns = np.zeros((len(direction), 3, 3))
    turns[:, 0, 0] = turns[:, 2, 2] = direction.real
    turns[:, 2, 0], turns[:, 0, 2], turns[:, 1, 1] = direction.imag, -direction.imag, 1.0
    return turns
