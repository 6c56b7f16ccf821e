"""Data passed between the planar engine's functions: plain tuples, which compiled code reads as fast as locals."""

from typing import NamedTuple

Complexes = tuple[complex, complex, complex, complex]
Floats = tuple[float, float, float, float]


class Links(NamedTuple):
    """The mechanism at one leg angle, in the foot's frame; primes are derivatives by the leg's angle.

    `place`, `place1`, `place2` are the bodies' centres of mass seen from the ankle and their derivatives, `turn1` and
    `turn2` those of the bodies' angles; `pin1` the rates of the pins leg, front, ankle and eye; `pitch` is exp(i·angle
    of the foot in the body's frame), `pivots` the two pivots of the body.
    """

    closed: bool
    place: Complexes
    place1: Complexes
    place2: Complexes
    turn1: Floats
    turn2: Floats
    pin1: Floats
    pitch: complex
    back_pivot: complex
    front_pivot: complex


class Inertia(NamedTuple):
    """Mass matrix in closed form: total mass, first moments by foot and leg angle, and the rest about the centre."""

    mass: float
    by_foot: complex
    by_leg: complex
    foot: float
    both: float
    leg: float


class PlanarMotion(NamedTuple):
    """Velocities, or their changes: of the ankle, of the foot's angle, of the leg joint."""

    ankle: complex
    foot: float
    leg: float


class Contact(NamedTuple):
    """Impulses of the ground on two spheres of the sole and along it, and in which mode they were found."""

    first: int
    second: int
    mode: int
    first_ns: float
    second_ns: float
    along_ns: float


class Stance(NamedTuple):
    """Where the foot stands in the middle of a step: ankle, exp(-i·angle) of the foot, and half of the time step."""

    ankle_m: complex
    turn: complex
    half_s: float


class Gains(NamedTuple):
    """Changes of velocity by unit impulses at the ankle along x and z, and of torque on foot and leg joint."""

    x: PlanarMotion
    z: PlanarMotion
    foot: PlanarMotion
    leg: PlanarMotion


class Losses(NamedTuple):
    """Energy lost so far (J): by viscous damping, dry friction of joints and pins, slip, normal impact, the stop."""

    damping_j: float
    friction_j: float
    slip_j: float
    impact_j: float
    stop_j: float


class StepState(NamedTuple):
    """The state between two steps, and what the next step needs from the last."""

    ankle_m: complex
    foot_rad: float
    leg_rad: float
    speed: PlanarMotion
    contact: Contact
    dry_nm: float
    losses: Losses
    belly_gap_m: float
    closed: bool


class PushOff(NamedTuple):
    """How a push-off ended: steps up to the take-off, if it flew, and the moment there or at the end."""

    flown: bool
    steps: int
    moment: StepState
    worst_gain_j: float
    belly_gap_m: float
