"""A robot under load: what its strength checks share (N, N·mm, mm, MPa)."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from jumpcad.dimensions import GAP_MM, GRAVITY_M_S2
from jumpcad.findings import Finding, at_most
from jumpcad.layout.layout import Layout
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot import Robot
from jumpcad.strength.axles import SCREW_CORE_MM, SCREW_THREAD_MM, RoundBar, axle_bar, pin_bar
from jumpcad.strength.bearings import loaded_forces_n
from jumpcad.strength.loads import MovingMass, PushOff, landing_force_n, push_off, reflected_share, toe_reach_mm
from jumpcad.strength.stress import Shell, pin_stress_mpa
from jumpcad.transforms import Array, direction
from jumpcad.workshop import Workshop

IN_PLANE = "strength_in_plane_mpa/s (MPa)"
INTERLAYER = "strength_interlayer_mpa/s (MPa)"
"""What stresses of printed parts are compared with."""
LANDING = "F = m·g + U/safety.landing_stop_mm, a fall from the height to which U could lift the robot"
ONE_TOE = "F landing force/(1 + (x/k_y)² + (y/k_x)²) on one tip at x, y, with the body's radii of gyration k"
"""Loads, for formulas."""


@dataclass(frozen=True)
class LoadCase:
    """A robot under load."""

    robot: Robot

    @property
    def layout(self) -> Layout:
        """Where everything is."""
        return self.robot.layout

    @property
    def workshop(self) -> Workshop:
        """What the robot is made with."""
        return self.robot.workshop

    @cached_property
    def torque_nmm(self) -> float:
        return 1000.0 * self.robot.spring.peak_torque_nm

    @cached_property
    def shell(self) -> Shell:
        return Shell.of(self.workshop.process)

    @cached_property
    def holes(self) -> HoleSizes:
        return HoleSizes.of(self.workshop, self.layout.hub_bearing)

    @cached_property
    def allowable_mpa(self) -> float:
        return self.workshop.material("links").strength_in_plane_mpa / self.workshop.safety.printed_factor

    @cached_property
    def bars(self) -> dict[str, RoundBar]:
        """What axles and pins are, by the names of `steel_stresses_mpa`."""
        axle, pin = axle_bar(self.workshop), pin_bar(self.workshop)
        return {"leg_axle": axle, "cam_axle": axle, "spring_pin": axle, "foot_pin": pin, "leg_pin": pin}

    @cached_property
    def forces(self) -> PushOff:
        body = self.robot.bodies[BODY]
        gyration = 1000.0 * math.sqrt(body.inertia_kg_m2[1, 1] / body.mass_kg)
        mass = MovingMass(body.mass_kg, 1000.0 * body.com_m[[0, 2]], gyration)
        return push_off(self.robot.linkage, mass, self.layout.sections.ground_mm, self.robot.spring)

    @cached_property
    def ankle_n(self) -> float:
        return float(np.linalg.norm(self.forces.ankle_n, axis=1).max())

    @cached_property
    def front_n(self) -> float:
        return float(np.abs(self.forces.front_n).max())

    @cached_property
    def landing_n(self) -> float:
        mass = self.robot.mass_kg
        rise_m = self.robot.spring.energy_j / (mass * GRAVITY_M_S2)
        return landing_force_n(self.robot.design, mass, self.workshop.safety.landing_stop_mm, rise_m)

    @cached_property
    def toe_blow_n(self) -> float:
        """Force on a toe's tip that lands first (N): less than the landing force, since the body turns."""
        body = self.robot.bodies[BODY]
        about_x, about_y = 1000.0 * np.sqrt(np.diag(body.inertia_kg_m2)[:2] / body.mass_kg)
        return self.landing_n * reflected_share(toe_reach_mm(self.robot.design), (float(about_x), float(about_y)))

    @cached_property
    def steel_stresses_mpa(self) -> dict[str, float]:
        """Bending stresses of axles and pins: the leg's and the cam's axle, the springs' two pins, the foot's pins."""
        layout, lateral = self.layout, self.layout.lateral
        span = (sum(lateral.left_plate) - sum(lateral.right_plate)) / 2.0
        arms, cam = self.wound_forces_n
        at = sum(lateral.cam) / 2.0 - sum(lateral.right_plate) / 2.0
        thickness, lug = layout.sections.thickness_mm, layout.sections.lug_thickness_mm
        lever = lateral.lug_left[0] - thickness / 2.0 + lug / 2.0 + thickness / 4.0
        moments = {
            "leg_axle": leg_axle_moment_nmm(arms, cam, span, sum(lateral.spring_left) / 2.0),
            "cam_axle": layout.drive.cam.peak_contact_n * at * (span - at) / span,
            "spring_pin": layout.drive.spring.pin_force_n * (span / 2.0 - lateral.spring_left[1]),
            "leg_pin": layout.drive.spring.pin_force_n * (GAP_MM + layout.drive.spring.wire_mm / 2.0 + thickness / 4.0),
            "foot_pin": max(self.ankle_n, self.front_n, self.landing_n) / 2.0 * lever,
        }
        stresses = {name: self.bars[name].stress_mpa(moment) for name, moment in moments.items()}
        if layout.retention == "nuts":
            self._threads(stresses, moments, span)
        return stresses

    def _threads(self, stresses: dict[str, float], moments: dict[str, float], span_mm: float) -> None:
        """Raise the stresses of screws used as axles to those of their thread, near the right plate.

        The moment falls evenly from the middle to the plates; in the springs' pin it is the same between the arms.
        """
        lateral = self.layout.lateral
        leg = next(item for item in self.robot.hardware if item.name == "leg_axle")
        length = (
            float(np.ptp(leg.shape.bounds_mm[:, 2])) - self.workshop.catalogue.screws["M3 long"].cylinder_head_height_mm
        )
        from_plate = max(0.0, lateral.left_plate[1] - (length - SCREW_THREAD_MM) - sum(lateral.right_plate) / 2.0)
        share = min(1.0, 2.0 * from_plate / span_mm)
        for name, part in (("leg_axle", share), ("cam_axle", share), ("spring_pin", 1.0)):
            stresses[name] = max(stresses[name], pin_stress_mpa(part * moments[name], SCREW_CORE_MM))

    @cached_property
    def axial_n(self) -> float:
        """Largest axial force on an axle or pin (N): the friction of a sideways landing, all on one of them."""
        return self.robot.workshop.ground.foot_friction * self.landing_n

    @cached_property
    def wound_forces_n(self) -> tuple[tuple[Array, Array], Array]:
        """Forces (2,) of the springs' arms on leg and plates, and that of the cam on the lever.

        In the body's frame, springs loaded, roller at the end of the lift; both springs together.
        """
        spring = self.layout.drive.spring
        on_leg, on_lever = loaded_forces_n(self.robot.design, self.layout.drive)
        on_pin = 2.0 * spring.pin_force_n * direction(-(spring.plate_pin_rad + spring.arms.turn_rad))
        return (on_leg, on_pin), on_lever


def stress_finding(name: str, what: str, stress: float, allowable: float, remedy: str, grows: str = "") -> Finding:
    """Return the finding of a stress against its limit (MPa); `grows` is the section that grows where it fails."""
    message = f"{what}: {stress:.1f} of {allowable:.1f} MPa"
    return at_most(name, stress, allowable, "MPa", message, remedy, grows=grows)


def leg_axle_moment_nmm(arms_n: tuple[Array, Array], cam_n: Array, span_mm: float, coil_mm: float) -> float:
    """Return the largest bending moment in the leg's axle, a simple beam between the plates.

    The leg pushes on its middle with arm and cam forces; each coil, `coil_mm` beside it, pushes back with half of the
    force of its arms.
    """
    on_leg, on_pin = arms_n
    support = (cam_n - on_pin) / 2.0
    coil = -(on_leg + on_pin) / 2.0
    middle = support * span_mm / 2.0 - coil * coil_mm
    beside = support * (span_mm / 2.0 - coil_mm)
    return float(max(np.linalg.norm(middle), np.linalg.norm(beside)))
