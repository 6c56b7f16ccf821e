"""Torsion springs: two mirror images, half of the stiffness each, made to order or from stock.

Formulas: EN 13906-3 (cold coiled torsion springs of round wire, 3 turns at least, 4 <= D/d <= 20). Rate
k = E·d⁴/(64·D·n) per radian; n counts the arms, which bend as beams held at the coil, as a third of their length of
wire. Stress q·32·M/(pi·d³) with q = (w + 0.07)/(w - 0.75), w = D/d, at the coil's inner fibre, where fatigue begins;
0.7 of the tensile strength at most. Loading in the closing direction reduces the diameter to D·n/(n + turns loaded).

Arms are seen from the robot's right, angles counter-clockwise from forward, as everywhere in x-z (mm, rad). From its
body arm to its leg arm the wire turns counter-clockwise around the hub. The body arm comes in from the plate's pin and
the leg arm leaves for the leg's pin, each along the coil's tangent; each pin lies beside its arm, away from the hub, so
that half of the pin and half of the wire are between its axis and the arm's. Winding turns the leg's pin
counter-clockwise towards the plate's pin and closes the coil.
"""

import math
from dataclasses import dataclass
from typing import Literal

from jumpcad.catalogue import Wire
from jumpcad.findings import Basis, Finding, Remedy, at_most, lower
from jumpcad.mechanism.model import Spring

FULL_TURN_RAD = 2.0 * math.pi
ARM_BEYOND_MM = 2.0
"""How far an arm reaches beyond the point where it touches its pin; judgement."""


@dataclass(frozen=True)
class Arms:
    """The two equal arms of one spring at rest.

    - `mean_mm`, `wire_mm`, `pin_mm`: Mean diameter of the coil, and diameters of wire and pins.
    - `lever_mm`: From the tangent point to where an arm touches its pin; the arm's force on the pin, square to the arm,
      has this lever about the hub.
    """

    mean_mm: float
    wire_mm: float
    pin_mm: float
    lever_mm: float

    @classmethod
    def to_pins(cls, mean_mm: float, wire_mm: float, pin_mm: float, pin_radius_mm: float) -> "Arms":
        """Return the arms that reach pins at a distance from the hub."""
        lever = math.sqrt(pin_radius_mm**2 - beside_mm(mean_mm, wire_mm, pin_mm) ** 2)
        return cls(mean_mm, wire_mm, pin_mm, lever)

    @property
    def pin_radius_mm(self) -> float:
        """From the hub to the pins' axes (mm)."""
        return math.hypot(beside_mm(self.mean_mm, self.wire_mm, self.pin_mm), self.lever_mm)

    @property
    def turn_rad(self) -> float:
        """Angle at the hub between an arm's tangent point and its pin (rad)."""
        return math.atan2(self.lever_mm, beside_mm(self.mean_mm, self.wire_mm, self.pin_mm))

    @property
    def arm_turns(self) -> float:
        """Turns of the coil that bend as much as both arms: a third of their length (beam theory, force at the end)."""
        return 2.0 * self.lever_mm / (3.0 * math.pi * self.mean_mm)


def beside_mm(mean_mm: float, wire_mm: float, pin_mm: float) -> float:
    """Return how far a pin's axis is from the hub, measured square to the arm that touches it (mm)."""
    return (mean_mm + wire_mm + pin_mm) / 2.0


def between_pins_rad(plate_pin_rad: float, leg_pin_rad: float) -> float:
    """Return the angle from the plate's pin on to the leg's pin, counter-clockwise, in [0, 2·pi)."""
    return (leg_pin_rad - plate_pin_rad) % FULL_TURN_RAD


def free_arm_angle_rad(turns: float) -> float:
    """Return the angle between the relaxed arms of a coil, in [0, 2·pi), as spring makers count it.

    Of whole turns the arms point in opposite directions (180°); a quarter of a turn more closes them to 90°. Loading
    in the closing direction lowers the angle.
    """
    return (math.pi - FULL_TURN_RAD * turns) % FULL_TURN_RAD


BASIS = {
    "spring_stress": Basis(
        "q·32·M/(π·d³) ≤ c·R_m/(1 + safety.stress_reserve) (MPa); M torque of one loaded spring, d wire, "
        "q = (w + 0.07)/(w - 0.75) with w = D/d, c smaller of safety.spring_stress_share and that of `spring_fatigue`",
        "EN 13906-3; R_m: EN 10270-1 SM",
    )
}


@dataclass(frozen=True)
class SpringLimits:
    """Room and strength of the springs (mm, rad). Values that a workshop gives have no default here.

    - `mandrel_min_mm`: The smallest bushing that can carry a coil.
    - `pin_radius_min_mm`: From the axle to the pins that hold the arms, at least: the body's pin crosses the plane of
      the main leg.
    - `stress_share`: Allowable bending stress over tensile strength.
    - `plate_pins_rad`: Directions of the plates' pin that are tried, the preferred one first.
    - `mandrel_clearance_mm`: Gap that a loaded coil leaves around its bushing, on the diameter; judgement: it must not
      bind.
    - `outer_max_mm`, `body_lengths_max_mm`: Largest diameter and lengths of the loaded coil. The lengths are tried in
      this order: a long, thin spring widens the robot, a short one is larger around the leg's axle. Judgement: the room
      beside the cam, and between leg and gears.
    - `arm_reach_mm`: From the outside of the coil to the pins; judgement: the longer the arms, the smaller their
      forces, which bend the leg's axle and press on the plates; with 5 mm the strongest templates weigh 7 to 8 g more,
      with 12 mm the coils of one have to be longer.
    - `lever_max_mm`: Of a stock spring's arms, from the coil to where they touch their pins; judgement: longer ones
      bend more than the coil's rate says, and their pins leave the body.
    """

    mandrel_min_mm: float
    pin_radius_min_mm: float
    pin_mm: float
    stress_share: float
    plate_pins_rad: tuple[float, ...]
    mandrel_clearance_mm: float = 0.3
    outer_max_mm: float = 18.0
    body_lengths_max_mm: tuple[float, ...] = (10.0, 13.0)
    arm_reach_mm: float = 8.0
    lever_max_mm: float = 35.0

    def pin_radius_mm(self, outer_mm: float) -> float:
        """Return the least distance of the pins from the hub beside a coil of an outer diameter."""
        return max(outer_mm / 2 + self.arm_reach_mm, self.pin_radius_min_mm)


@dataclass(frozen=True)
class TorsionSpring:
    """One of the two springs; the other is its mirror image. Lengths in mm, angles counter-clockwise from forward.

    - `arms`: Coil, wire and pins where the arms touch them, at rest.
    - `turns`: Turns of the relaxed body; not a whole number, so that rate and pins are exact.
    - `stiffness_nm_per_rad`: Of this one spring.
    - `preload_rad`, `wound_rad`: Loading angle in the rest pose, and at the end of the lift.
    - `plate_pin_rad`, `leg_pin_rad`: Directions of the pins from the hub, in the rest pose.
    - `body_length_mm`: Length of the close-coiled body when loaded.
    - `mandrel_mm`: Largest bushing that clears the loaded coil.
    - `stress_mpa`, `allowable_mpa`: Bending stress when loaded, at the inner fibre, and its limit.
    - `tensile_mpa`: Tensile strength of the wire, at least.
    - `stock`: Name of the stock spring; empty where it is made to order.
    """

    arms: Arms
    turns: float
    stiffness_nm_per_rad: float
    preload_rad: float
    wound_rad: float
    plate_pin_rad: float
    leg_pin_rad: float
    body_length_mm: float
    mandrel_mm: float
    stress_mpa: float
    allowable_mpa: float
    tensile_mpa: float
    mass_g: float
    findings: tuple[Finding, ...]
    stock: str = ""

    @property
    def wire_mm(self) -> float:
        """Diameter of the wire (mm)."""
        return self.arms.wire_mm

    @property
    def inside_diameter_mm(self) -> float:
        """Of the relaxed coil (mm)."""
        return self.arms.mean_mm - self.arms.wire_mm

    @property
    def outer_diameter_mm(self) -> float:
        """Of the relaxed coil (mm)."""
        return self.arms.mean_mm + self.arms.wire_mm

    @property
    def arm_length_mm(self) -> float:
        """Of each arm, from the coil to its end a little beyond the pin (mm)."""
        return self.arms.lever_mm + ARM_BEYOND_MM

    @property
    def free_arm_angle_rad(self) -> float:
        """Angle between the two relaxed arms (rad)."""
        return free_arm_angle_rad(self.turns)

    @property
    def rate_nmm_per_deg(self) -> float:
        """Of this one spring (N·mm/°)."""
        return 1000.0 * self.stiffness_nm_per_rad * math.pi / 180.0

    @property
    def torque_nmm(self) -> float:
        """Of this one spring when loaded (N·mm)."""
        return 1000.0 * self.stiffness_nm_per_rad * self.wound_rad

    @property
    def pin_force_n(self) -> float:
        """Of one arm on its pin when loaded, square to the arm (N).

        With the lever at rest: that of the loaded, narrower coil is a little longer and the force smaller.
        """
        return self.torque_nmm / self.arms.lever_mm

    @property
    def hands(self) -> tuple[Literal["right"], Literal["left"]]:
        """Hands of the left and the right spring: from plate to leg the left one's wire runs to the right."""
        return ("right", "left")


def torsion_spring(
    arms: Arms, turns: float, on_leg: Spring, tensile_mpa: float, wire: Wire, limits: SpringLimits,
    pins_rad: tuple[float, float], stock: str = "",
) -> TorsionSpring:  # fmt: skip
    """Return one spring with its loaded dimensions and stress; `pins_rad` are the plate's and the leg's."""
    d, wound = arms.wire_mm, on_leg.wind_rad + on_leg.preload_rad
    loaded_turns = turns + wound / FULL_TURN_RAD
    stress = inner_fibre(arms.mean_mm / d) * plain_stress_mpa(500.0 * on_leg.peak_torque_nm, d)
    allowable = limits.stress_share * tensile_mpa
    volume = math.pi / 4 * d**2 * (math.pi * arms.mean_mm * turns + 2 * (arms.lever_mm + ARM_BEYOND_MM))
    message = f"the springs' wire of {d:g} mm, loaded: {stress:.0f} of {allowable:.0f} MPa"
    ways: Remedy = lower("stiffness_nmm_per_deg", "compression_ratio")
    if stock:
        ways = (*lower("compression_ratio"), "choose another bought.spring with thicker wire")
    return TorsionSpring(
        arms=arms, turns=turns, stiffness_nm_per_rad=on_leg.stiffness_nm_per_rad / 2, preload_rad=on_leg.preload_rad,
        wound_rad=wound, plate_pin_rad=pins_rad[0], leg_pin_rad=pins_rad[1], body_length_mm=d * (loaded_turns + 1),
        mandrel_mm=arms.mean_mm * turns / loaded_turns - d - limits.mandrel_clearance_mm, stress_mpa=stress,
        allowable_mpa=allowable, tensile_mpa=tensile_mpa, mass_g=wire.density_g_cm3 * volume / 1000,
        findings=(at_most("spring_stress", stress, allowable, "MPa", message, ways),), stock=stock,
    )  # fmt: skip


def plain_stress_mpa(torque_nmm: float, d: float) -> float:
    """Return the bending stress of a straight wire."""
    return 32 * torque_nmm / (math.pi * d**3)


def inner_fibre(index: float) -> float:
    """Return the stress factor q of a coil's inner fibre at an index D/d (EN 13906-3)."""
    return (index + 0.07) / (index - 0.75)
