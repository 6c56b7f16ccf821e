"""Sections of the moving links from their loads (numpy only, mm, N, N·mm).

The largest loads act at release: the springs' torque k·δ bends main leg and lever, and the ground pushes on the toe
tips, which bends toes and rails. Heights follow from the printing material's in-plane strength over the safety factor,
with the formulas of the strength checks of the finished robot. A section that fails one of them then grows.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from jumpcad.design import Design
from jumpcad.dimensions import GAP_MM, STOP_PAD_MM, STOP_SEAT_MM, TOE_TIP_WIDTH_MM
from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.mass import MassProperties
from jumpcad.mechanism.model import Spring
from jumpcad.strength import loads
from jumpcad.strength.growth import Growth, grown_mm, in_hundredths
from jumpcad.strength.stress import (
    STATIONS,
    VON_MISES,
    Beam,
    Shell,
    height_for_mm,
    tapered_energy_nmm,
    tapered_stress_mpa,
    twisted_height_mm,
)
from jumpcad.workshop import Fits, Workshop

TYPICAL_BODY = MassProperties(0.1, np.array([0.0, 0.0, 0.017]), 0.1 * np.diag([0.0, 0.042**2, 0.0]))
"""The body's mass properties before its parts are known, as far as motion in the plane depends on them; the templates
have 90 to 112 g, and 31 to 44 mm of radius of gyration."""
RESERVE = 1.15
"""Factor on every load, since masses and the lever are not known yet; judgement."""
AXIAL_RESERVE = 1.2
"""Factor on the force along the leg beside the springs' torque, which is known: of 120 robots within a search's default
bounds, bodies were up to 1.12 times as heavy as the typical one, and axial forces up to 1.15 times as large."""
THICKNESS_MM, THICK_MM, THICK_FROM_NMM = 6.0, 8.0, 900.0
"""Thickness of the links, and a larger one from a spring torque on; judgement: axial play tilts thin eyes."""
HEIGHT_MIN_MM = 6.0
"""Of legs; judgement: three perimeters of 0.45 mm on either side leave a core."""
ROOT_MORE_MM = 2.0
"""Least difference of the leg's root to `HEIGHT_MIN_MM`; judgement: the pin's hole weakens the leg there."""
EYE_PLAY_MM = 0.3
"""Allowance for a running fit on the radius of an axle, so that an eye keeps two walls; judgement."""
ABOVE_GROUND_MM = 1.0
"""Height of eyes and leg above the ground on a flat foot; judgement: the links flex when the robot lands."""
LUG_MM, TOE_WIDTH_MM = 4.0, 7.0
"""Thickness of the foot's lugs and rails, width of a toe at its root; judgement: as wide as their heights or wider."""
RAIL_MIN_MM, TOE_MIN_MM, TOE_TIP_MIN_MM = 3.2, 3.2, 2.4
"""Least heights; judgement: 16 and 12 layers of 0.2 mm."""
LEG_TAPER, TOE_TAPER, RAIL_TAPER = 0.6, 0.6, 0.5
"""Height at the tip over that at the root. With half or more, moment over section falls from the root on."""
TWIST_FACTOR = 2.0
"""Strength of a rail over its shear beside the ankle; judgement: less than `safety.printed_factor`, since the neck
between boss and web is 1.2 mm long and the ankle's pin takes a part of the torque."""
DOG_MM_PER_NMM = 1.45
"""Diameter of the cam's dog over the cube root of the springs' torque, as shafts are sized (Shigley 7-4); judgement:
with it the jaws of all templates withstand the impact at the end of their play."""
LEVER_MORE = 1.47
"""Height of the lever's root over that which bending needs; judgement: the energy that bends the lever drives the
released cam, and with this height the gear motors of all templates withstand its impact."""
STOP_SHARE, STOP_SPAN_MM = 0.12, 39.0
"""Share of the springs' energy that the rest stop absorbs, and length of its bar; judgement: in strong designs it is
0.08 to 0.125 and at most 39 mm; where it is more, the bar grows."""
STOP_MIN_MM = 6.0
"""Least depth of the rest stop's bar in the direction of the impact; judgement."""
DOG_FACETS_MM = 0.05
"""Thickness that a jaw loses because its two circles are drawn as polygons."""
RAISED_ROUNDS, STIFF_MORE, STRONG_MORE = 12, 1.01, 1.001
"""Most steps in which the leg's height is raised until it flexes little enough and holds, and factors beyond what each
lacks; judgement."""


@dataclass(frozen=True)
class Sections:
    """Outer dimensions of legs and foot (mm).

    `thickness_mm` is across the robot (y); heights are in the plane of motion. `foot_depth_mm` is the distance from
    the line of ankle and front eye down to the printed sole, under which a pad of `pad_mm` is glued (0 without one).
    `lug_thickness_mm` is that of lugs and rails, `dog_mm` the diameter of the dog that turns the cam, `stop_mm` the
    depth of the rest stop's bar in the direction of the impact.
    """

    thickness_mm: float
    leg_root_mm: float
    leg_tip_mm: float
    front_mm: float
    lever_root_mm: float
    eye_radius_mm: float
    lug_thickness_mm: float
    foot_depth_mm: float
    rail_root_mm: float
    rail_tip_mm: float
    toe_width_mm: float
    toe_root_mm: float
    toe_tip_height_mm: float
    dog_mm: float
    stop_mm: float
    pad_mm: float = 0.0

    @property
    def ground_mm(self) -> float:
        """From the line of ankle and front eye down to the ground on a flat foot."""
        return self.foot_depth_mm + self.pad_mm

    def leg(self, shell: Shell) -> Beam:
        """Return the main leg's sections from hub to ankle."""
        return Beam(self.thickness_mm, np.linspace(self.leg_root_mm, self.leg_tip_mm, STATIONS), shell)

    def front(self, shell: Shell) -> Beam:
        """Return the front link's section."""
        return Beam(self.thickness_mm, self.front_mm, shell)

    def toe(self, shell: Shell) -> Beam:
        """Return one toe's sections from root to tip."""
        width = np.linspace(self.toe_width_mm, TOE_TIP_WIDTH_MM, STATIONS)
        return Beam(width, np.linspace(self.toe_root_mm, self.toe_tip_height_mm, STATIONS), shell, upright=True)

    def rail(self, shell: Shell) -> Beam:
        """Return one rail's sections from ankle to front eye."""
        return Beam(
            self.lug_thickness_mm, np.linspace(self.rail_root_mm, self.rail_tip_mm, STATIONS), shell, upright=True
        )


def sections(linkage: Linkage, workshop: Workshop, hub_width_mm: float = 0.0, growth: Growth = Growth()) -> Sections:
    """Size the links of a mechanism in a workshop, with a hub of at least a given width."""
    design = linkage.design
    fits, safety, material = workshop.fits, workshop.safety, workshop.material("links")
    shell = Shell.of(workshop.process)
    allowable = material.strength_in_plane_mpa / safety.printed_factor
    eye = workshop.bought.axle_mm / 2.0 + EYE_PLAY_MM + 2.0 * fits.wall_mm
    lug = grown_mm(LUG_MM, growth.lug)
    springs = springs_on_leg(design, workshop.stock_spring, math.radians(workshop.spring.preload_deg))
    torque = RESERVE * 1000.0 * springs.peak_torque_nm
    around, across = _socket_mm(workshop)
    least = THICKNESS_MM if torque < THICK_FROM_NMM else THICK_MM
    thickness = grown_mm(max(least, hub_width_mm, across), growth.thickness)
    bending = height_for_mm(torque, thickness, allowable, shell)
    root = max(HEIGHT_MIN_MM + ROOT_MORE_MM, bending)
    forces = loads.push_off(linkage, TYPICAL_BODY, springs)
    axial = AXIAL_RESERVE * float(np.abs(forces.leg_axial_n).max())

    def flexes(leg: Beam) -> float:
        return leg_flex_share(design, leg, material.modulus_mpa, springs) / safety.leg_flex_share

    def bears(leg: Beam) -> float:
        return tapered_stress_mpa(leg, torque / RESERVE, axial) / allowable

    stiff = root if workshop.leg_bar is not None else _raised_mm(root, thickness, shell, flexes, 3.0, STIFF_MORE)
    strong = _raised_mm(root, thickness, shell, bears, 2.0, STRONG_MORE)
    leg_root = max(in_hundredths(growth.leg * max(stiff, strong)), around)
    leg_tip = max(_leg_tip_mm(leg_root), around)
    eye = max(eye, around / 2.0)
    depth = max(eye, leg_tip / 2.0) + ABOVE_GROUND_MM
    pad = workshop.foot_pad.thickness_mm if workshop.foot_pad else 0.0
    toes = RESERVE * float(loads.toe_load_n(forces, design, depth + pad).max())
    toe = height_for_mm(loads.toe_moment_nmm(design, toes), TOE_WIDTH_MM, allowable, shell, upright=True)
    rail = height_for_mm(loads.rail_moment_nmm(design, toes), lug, allowable, shell, upright=True)
    twist = VON_MISES * loads.rail_twist_nmm(design, toes, rail_middle_mm(thickness, lug))
    rail = max(rail, twisted_height_mm(twist, lug, material.strength_in_plane_mpa / TWIST_FACTOR))
    toe_root = in_hundredths(growth.toe * max(TOE_MIN_MM, toe))
    jaw = fits.pin_min_mm + DOG_FACETS_MM  # as thick as the thinnest column that can be printed
    least_dog = dog_inside_mm(fits.drawn, workshop.bought.axle_mm) + 2.0 * jaw
    rail_root = in_hundredths(growth.rail * max(RAIL_MIN_MM, rail))
    return Sections(
        thickness_mm=thickness, leg_root_mm=leg_root, leg_tip_mm=leg_tip,
        front_mm=max(grown_mm(HEIGHT_MIN_MM, growth.front), around),
        lever_root_mm=in_hundredths(growth.lever * max(root, LEVER_MORE * bending)), eye_radius_mm=eye,
        lug_thickness_mm=lug, foot_depth_mm=depth, rail_root_mm=rail_root,
        rail_tip_mm=max(RAIL_MIN_MM, RAIL_TAPER * rail_root), toe_width_mm=TOE_WIDTH_MM, toe_root_mm=toe_root,
        toe_tip_height_mm=max(TOE_TIP_MIN_MM, TOE_TAPER * toe_root),
        dog_mm=in_hundredths(growth.dog * max(least_dog, DOG_MM_PER_NMM * torque ** (1.0 / 3.0))),
        stop_mm=in_hundredths(growth.stop * _stop_mm(workshop, springs.energy_j, thickness, shell)), pad_mm=pad,
    )  # fmt: skip


def _socket_mm(workshop: Workshop) -> tuple[float, float]:
    """Return height and thickness that a leg needs around its bar's socket; zeros for legs that are printed whole."""
    bar, fits = workshop.leg_bar, workshop.fits.drawn
    if bar is None:
        return 0.0, 0.0
    gap = 2.0 * fits.lying_mm
    return in_hundredths(bar.height_mm + gap + 2.0 * fits.wall_mm), bar.width_mm + gap + 2.0 * fits.wall_min_mm


def leg_flex_share(design: Design, leg: Beam, modulus_mpa: float, springs: Spring) -> float:
    """Return the energy that bends the leg at release as a share of the springs'.

    The moment is taken to fall evenly from the hub to the ankle: an upper bound, since the springs' arms press on the
    leg a little beyond the hub.
    """
    stiffness = np.asarray(modulus_mpa * leg.second_moment_mm4)
    energy = tapered_energy_nmm(stiffness, 1000.0 * springs.peak_torque_nm, design.l2_mm)
    return energy / (1000.0 * springs.energy_j)


def _raised_mm(
    root_mm: float, thickness_mm: float, shell: Shell, use: Callable[[Beam], float], power: float, more: float
) -> float:
    """Return the height of the leg's root, raised until the leg's use of a limit is 1 at most.

    The use falls with 1/h to about some power: 2 of stresses, 3 of the energy that bends the leg.
    """
    for _ in range(RAISED_ROUNDS):
        used = use(Beam(thickness_mm, np.linspace(root_mm, _leg_tip_mm(root_mm), STATIONS), shell))
        if used <= 1.0:
            break
        root_mm *= more * used ** (1.0 / power)
    return root_mm


def _stop_mm(workshop: Workshop, energy_j: float, width_mm: float, shell: Shell) -> float:
    """Return the depth of the rest stop's bar, a beam on both plates with the pad's force over the leg's width."""
    pad_n_per_mm = workshop.stop_pad.rate_n_per_mm(width_mm, STOP_PAD_MM)
    force = loads.PEAK_SHARE * math.sqrt(2.0 * STOP_SHARE * 1000.0 * energy_j * pad_n_per_mm)
    moment = loads.BLOW_FACTOR * force * max(STOP_SPAN_MM - width_mm / 2.0, 0.0) / 4.0
    strength = workshop.material("links").strength_in_plane_mpa
    return max(STOP_MIN_MM, STOP_SEAT_MM + height_for_mm(moment, STOP_PAD_MM, strength, shell))


def rail_middle_mm(thickness_mm: float, lug_mm: float) -> float:
    """Return how far the middle of a rail is from that of the robot."""
    return beside_leg_mm(thickness_mm) + lug_mm / 2.0


def beside_leg_mm(thickness_mm: float) -> float:
    """Return how far what stands beside the legs begins from the robot's middle: half a leg and a gap."""
    return thickness_mm / 2.0 + GAP_MM


def dog_inside_mm(fits: Fits, axle_mm: float) -> float:
    """Return the inner diameter of the jaws on the cam: the cam gear's hub, a thin wall on its bore, turns inside."""
    return axle_mm + 2.0 * (fits.sliding_mm + fits.wall_min_mm + fits.sliding_mm)


def _leg_tip_mm(root_mm: float) -> float:
    return max(HEIGHT_MIN_MM, LEG_TAPER * root_mm)
