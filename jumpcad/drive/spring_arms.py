"""Where a torsion spring's arms, which are tangents of the coil, touch their pins (mm, rad).

Seen from the robot's right, angles counter-clockwise from forward, as everywhere in x-z. From its body arm to its leg
arm the wire turns counter-clockwise around the hub. The body arm comes in from the plate's pin and the leg arm leaves
for the leg's pin, each along the coil's tangent; each pin lies beside its arm, away from the hub, so that half of the
pin and half of the wire are between its axis and the arm's. Winding turns the leg's pin counter-clockwise towards the
plate's pin and closes the coil.
"""

import math
from dataclasses import dataclass

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
