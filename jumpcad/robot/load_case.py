"""A robot under load: what its strength checks share, forces on its axles first (N, N·mm, mm, MPa).

x-z in the body's frame, y to the left.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from jumpcad.dimensions import GAP_MM, GRAVITY_M_S2
from jumpcad.drive.dog import JAWS
from jumpcad.findings import Finding, Remedy, at_most, lower
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.robot.sizing import dog_inside_mm
from jumpcad.strength import axles, loads
from jumpcad.strength.bearings import loaded_forces_n
from jumpcad.strength.stress import VON_MISES, Shell, jaw_stress_mpa, pin_stress_mpa, tube_shear_mpa
from jumpcad.transforms import Array, direction, turned_about_y
from jumpcad.workshop import Workshop

PLAIN_HUB = 1.0 / 3.0
"""Where a hub without bearings bears on its axle, over its width: in the middle of pressures that grow evenly from its
middle to its faces."""
CAM_TURNS, IDLER_TURNS = 1.0, -1.0
"""Senses about +y; see `jumpcad.drive.cam`."""


def axle_beams(layout: Layout, arms_n: tuple[Array, Array], cam_n: Array, front_n: Array) -> dict[str, axles.AxleBeam]:
    """Return the axles and the springs' pin as beams on both plates, by their names.

    Forces are (2,): of both springs' arms on leg and pin, of the cam on the lever, of the front link on its axle.
    """
    lateral, (on_leg, on_pin) = layout.lateral, arms_n
    plates = lateral.plates_mm
    cam, wire = sum(lateral.cam) / 2.0, layout.drive.spring.wire_mm
    inner, outer = lateral.spring_left[0] + wire / 2.0, lateral.spring_left[1] - wire / 2.0
    width, bearing = layout.sections.thickness_mm, layout.hub_bearing
    hub = (width - bearing.width_mm) / 2.0 if bearing else PLAIN_HUB * width
    coils = [(side * end, -force / 2.0) for side in (1.0, -1.0) for end, force in ((inner, on_leg), (outer, on_pin))]
    return {
        "leg_axle": axles.AxleBeam.of(plates, *axles.on_hub(on_leg, hub), *axles.on_hub(cam_n, hub, cam), *coils),
        "front_axle": axles.AxleBeam.of(plates, *axles.on_hub(front_n, PLAIN_HUB * width)),
        "spring_pin": axles.AxleBeam.of(plates, (outer, on_pin / 2.0), (-outer, on_pin / 2.0)),
        **_train_beams(layout, plates, (cam, -cam_n)),
    }


def _train_beams(layout: Layout, plates: tuple[float, float], cam: tuple[float, Array]) -> dict[str, axles.AxleBeam]:
    """Return the axles of cam and idler, which the teeth of their gears push too; `cam` is place and force (2,)."""
    lateral, train = layout.lateral, layout.drive.train
    *_, pair = train.stages
    *_, torque = train.wheel_torques_nm
    driver = layout.motor_mm if layout.idler_mm is None else layout.idler_mm
    on_cam_gear = axles.mesh_force_n(1000.0 * torque, pair, layout.cam_axis_mm, driver, CAM_TURNS)
    gear = sum(lateral.gears[0]) / 2.0
    beams = {"cam_axle": axles.AxleBeam.of(plates, cam, (gear, on_cam_gear))}
    if layout.idler_mm is not None:
        pair, torque, wheel = train.stages[0], train.wheel_torques_nm[0], sum(lateral.gears[1]) / 2.0
        on_wheel = axles.mesh_force_n(1000.0 * torque, pair, layout.idler_mm, layout.motor_mm, IDLER_TURNS)
        beams["idler_axle"] = axles.AxleBeam.of(plates, (gear, -on_cam_gear), (wheel, on_wheel))
    return beams


IN_PLANE = "strength_in_plane_mpa/s (MPa)"
INTERLAYER = "strength_interlayer_mpa/s (MPa)"
"""What stresses of printed parts are compared with."""
LANDING = "F = m·g + U/safety.landing_stop_mm, a fall from the height to which U could lift the robot"
ONE_TOE = (
    "F landing force/(1 + (x/k_y)² + (y/k_x)²) on the nearer tip, x, y from the body's centre of mass in the rest "
    "pose, with its radii of gyration k"
)
"""Loads, for formulas."""
PUSH_OFF = "loads: inverse dynamics of the push-off (Norton, Design of Machinery, ch. 11)"
WEAKER = (*lower("stiffness_nmm_per_deg", "compression_ratio"), "choose a stronger material for the links")


@dataclass(frozen=True)
class LoadCase:
    """A robot under load."""

    robot: Robot

    @property
    def layout(self) -> Layout:
        return self.robot.layout

    @property
    def workshop(self) -> Workshop:
        """What the robot is made with."""
        return self.robot.workshop

    @cached_property
    def torque_nmm(self) -> float:
        """Torque of both loaded springs on the main leg (N·mm)."""
        return 1000.0 * self.robot.spring.peak_torque_nm

    @cached_property
    def shell(self) -> Shell:
        """What of a printed section is solid."""
        return Shell.of(self.workshop.process)

    @cached_property
    def holes(self) -> HoleSizes:
        """Sizes of holes as drawn."""
        return HoleSizes.of(self.workshop, self.layout.hub_bearing)

    @cached_property
    def allowable_mpa(self) -> float:
        """What the links may bear along their layers (MPa)."""
        return self.workshop.material("links").strength_in_plane_mpa / self.workshop.safety.printed_factor

    @cached_property
    def bars(self) -> dict[str, axles.RoundBar]:
        """What axles and pins are, by the names of `steel_stresses_mpa`."""
        axle, pin = axles.axle_bar(self.workshop), axles.pin_bar(self.workshop)
        return dict.fromkeys(self.beams, axle) | {"foot_pin": pin, "leg_pin": pin}

    @cached_property
    def forces(self) -> loads.PushOffForces:
        """Forces of the push-off, with the body's mass and inertia."""
        return loads.push_off(self.robot.linkage, self.robot.bodies[BODY], self.robot.spring)

    @cached_property
    def toes_n(self) -> float:
        """Largest load of both toes' tips together in the push-off (N)."""
        return float(loads.toe_load_n(self.forces, self.layout.design, self.layout.sections.ground_mm).max())

    @cached_property
    def ankle_n(self) -> float:
        """Largest force in the ankle in the push-off (N)."""
        return float(np.linalg.norm(self.forces.ankle_n, axis=1).max())

    @cached_property
    def front_n(self) -> float:
        """Largest force along the front link in the push-off (N)."""
        return float(np.abs(self.forces.front_n).max())

    @cached_property
    def landing_n(self) -> float:
        """Mean force of a landing from as high as the springs' energy could lift the robot, m·g·(drop + stop)/stop."""
        weight = self.robot.mass_kg * GRAVITY_M_S2
        drop_m = self.robot.spring.energy_j / weight
        return 1000.0 * weight * drop_m / self.workshop.safety.landing_stop_mm + weight

    @cached_property
    def toe_blow_n(self) -> float:
        """Force on a toe's tip that lands first (N): less than the landing force, since the body turns."""
        body = self.robot.bodies[BODY]
        about_x, about_y = 1000.0 * np.sqrt(np.diag(body.inertia_kg_m2)[:2] / body.mass_kg)
        rest = self.robot.linkage.pose(np.zeros(1))
        centre = turned_about_y(1000.0 * body.com_m[[0, 2]] - rest.ankle_mm, -rest.foot_rad)
        back, aside = loads.toe_reach_mm(self.robot.design)
        arm = float(centre[0, 0]) + back, aside - 1000.0 * abs(float(body.com_m[1]))  # of the nearer toe
        return self.landing_n * loads.reflected_share(arm, (float(about_x), float(about_y)))

    @cached_property
    def steel_stresses_mpa(self) -> dict[str, float]:
        """Bending stresses of what is on the plates, `beams`, and of the pins of leg and foot."""
        layout, lateral = self.layout, self.layout.lateral
        thickness, lug = layout.sections.thickness_mm, layout.sections.lug_thickness_mm
        lever = lateral.lug_left[0] - thickness / 2.0 + lug / 2.0 + thickness / 4.0
        moments = {name: beam.largest_nmm() for name, beam in self.beams.items()} | {
            "leg_pin": layout.drive.spring.pin_force_n * (GAP_MM + layout.drive.spring.wire_mm / 2.0 + thickness / 4.0),
            "foot_pin": max(self.ankle_n, self.front_n, self.landing_n) / 2.0 * lever,
        }
        stresses = {name: self.bars[name].stress_mpa(moment) for name, moment in moments.items()}
        if layout.retention == "nuts":
            head = self.workshop.catalogue.screws["M3 long"].cylinder_head_height_mm
            lengths = {item.name: float(np.ptp(item.shape.bounds_mm[:, 2])) - head for item in self.robot.hardware}
            for name, beam in self.beams.items():  # screws as axles: their thread, near the right plate
                begins = lateral.left_plate[1] - (lengths[name] - axles.SCREW_THREAD_MM)
                thread_mpa = pin_stress_mpa(beam.largest_nmm(begins), axles.SCREW_CORE_MM)
                stresses[name] = max(stresses[name], thread_mpa)
        return stresses

    @cached_property
    def beams(self) -> dict[str, axles.AxleBeam]:
        """Axles and springs' pin between the plates; the front one bears the front link at release or at landing."""
        front = np.array([0.0, max(self.front_n, self.landing_n)])
        return axle_beams(self.layout, *self.wound_forces_n, front)

    def dog_stress_mpa(self, torque_nm: float) -> float:
        """Return the stress in the cam's dog under a torque: that of a jaw, or of the boss that carries them."""
        layout, dog, torque = self.layout, self.layout.drive.dog, 1000.0 * torque_nm
        inside = dog_inside_mm(self.holes.fits, layout.axle_mm)
        length = layout.lateral.gears[0][1] - layout.lateral.gears[0][0]
        jaw = jaw_stress_mpa(torque, dog.jaw_rad, JAWS, inside, dog.outer_mm, length)
        return max(jaw, VON_MISES * tube_shear_mpa(torque, dog.outer_mm, self.holes.running(layout.axle_mm)))

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


@decided_once
def load_case(robot: Robot) -> LoadCase:
    return LoadCase(robot)


def stress_finding(
    name: str, what: str, stress_mpa: float, allowable_mpa: float, ways: Remedy, grows: str = ""
) -> Finding:
    """Return the finding of a stress against its limit; `grows` is the section that grows where it fails."""
    message = f"{what}: {stress_mpa:.1f} of {allowable_mpa:.1f} MPa"
    return at_most(name, stress_mpa, allowable_mpa, "MPa", message, ways, grows=grows)
