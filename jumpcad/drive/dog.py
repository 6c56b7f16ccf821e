"""The dog clutch between cam gear and cam: two jaws that transmit torque one way and have play the other way.

While the motor winds, the gear's jaws push the cam's. At release the springs throw the cam forward faster than the
gear turns; with free play ahead of it, the cam swings clear of the roller without turning gears and motor.

Frame as in `cam`: the cam turns clockwise, so angles counter-clockwise from x fall while it winds.

Impacts after a release (SI): cam, gear and the gear motor's rotor are three rotating masses, their moments of inertia
reflected to the cam. Between them are gaps: the dog's play and the gearhead's backlash. A pair whose gap is closed is
in contact: a spring with a parallel damper that can only push. The torque peaks depend on the order of the impacts, so
the motion is integrated in time: in closed form while nothing touches, in steps during contact. The other end of the
dog's play is not modelled: a cam that rebounds that far has lost most of its energy. A blow is the torque peak in the
dog, a kick the one at the gear motor.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from jumpcad.dimensions import DOG_PLAY_MIN_DEG
from jumpcad.transforms import Array

PLAY_MORE_RAD = math.radians(3.0)
"""Play beyond the roll-over, and window beyond what the play needs: for printing tolerances and wear; judgement."""
JAWS = 2
ASIDE_MORE_RAD = math.radians(3.0)
"""By how much more than half of the play a jaw stands aside; judgement: turned by half a turn, the jaws then overlap
the pockets' ends by twice that, 0.6 mm on the smallest dog."""


def free_play_rad(roll_over_rad: npt.ArrayLike, fixed_rad: float | None = None) -> Array:
    """Return the dog's free play (n,): the roll-over and a margin, or what a workshop fixes (0 is a rigid key)."""
    roll_over = np.asarray(roll_over_rad, dtype=float)
    if fixed_rad is not None:
        return np.full_like(roll_over, fixed_rad)
    return np.maximum(math.radians(DOG_PLAY_MIN_DEG), roll_over + PLAY_MORE_RAD)


@dataclass(frozen=True)
class Dog:
    """Jaws of cam and gear, which share a ring around the cam's axle.

    The cam's two jaws are equal but not opposite to each other, and so are the gear's pockets: the gear fits in one
    position only. Of the gear's own jaws, which hub and web hold on either side, one is narrower for it.

    - `play_rad`: How far the cam can run ahead of the gear.
    - `outer_mm`: Diameter of the cam's boss and jaws.
    """

    play_rad: float
    outer_mm: float

    @property
    def jaw_rad(self) -> float:
        """Width of a jaw of the cam; those of the gear are as wide on average."""
        return (2.0 * math.pi / JAWS - self.play_rad) / 2.0

    @property
    def cam_jaws_rad(self) -> list[tuple[float, float]]:
        """Where the cam's jaws begin and end, counter-clockwise from x, at cam angle 0."""
        middles = (0.0, math.pi + (self.play_rad / 2.0 + ASIDE_MORE_RAD))  # aside by more than half of the play
        return [(middle - self.jaw_rad / 2.0, middle + self.jaw_rad / 2.0) for middle in middles]

    @property
    def pockets_rad(self) -> list[tuple[float, float]]:
        """Where the gear's pockets begin and end while it pushes the cam, as it stands at cam angle 0.

        The cam turns clockwise: the gear pushes at the counter-clockwise end of a jaw, and the play lies beyond the
        other one.
        """
        return [(begin - self.play_rad, end) for begin, end in self.cam_jaws_rad]


STEP_SHARE = 0.01
"""Time step, in radians of the fastest oscillation; with a quarter of it the torques change by 0.5 %."""
STEPS_MAX = 50_000
"""Limit of the number of time steps."""
DAMPING_MAX = 0.5
"""Largest damping ratio. With more, the damper's force at first contact is the largest, unlike that of real jaws. It
corresponds to a coefficient of restitution of 0.3; smaller ones are treated as 0.3."""
HALVINGS = 40
"""Bisection steps."""


@lru_cache(maxsize=8)
def damping_share(rebound: float) -> float:
    """Return the damping ratio z with which a contact has a coefficient of restitution `rebound`.

    e = exp(-2·z·acos(z)/√(1 - z²)): a free oscillation until the force is zero, after which it would be tension.
    """
    low, high = 0.0, DAMPING_MAX
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        restitution = math.exp(-2.0 * middle * math.acos(middle) / math.sqrt(1.0 - middle**2))
        low, high = (middle, high) if restitution > rebound else (low, middle)
    return low


def largest_torques_nm(
    masses_kg_m2: tuple[float, float, float], speed_rad_s: float, motor_rad_s: float, backlash_rad: float,
    stiffness_nm_per_rad: float, rebound: float,
) -> tuple[float, float]:  # fmt: skip
    """Return the largest torque between cam and gear, and between gear and rotor (N·m, at the cam).

    Masses are moments of inertia of cam, gear and rotor. The cam has its speed when it reaches the gear, which the
    motor turns on; the gear can run ahead of the rotor by the backlash. Stiffness and restitution are of each pair.
    """
    cam_kg_m2, gear_kg_m2, rotor_kg_m2 = masses_kg_m2
    k, share = stiffness_nm_per_rad, 2.0 * damping_share(rebound)
    dog_damping = share * math.sqrt(k * cam_kg_m2 * gear_kg_m2 / (cam_kg_m2 + gear_kg_m2))
    head_damping = share * math.sqrt(k * gear_kg_m2 * rotor_kg_m2 / (gear_kg_m2 + rotor_kg_m2))
    shortest = STEP_SHARE * math.sqrt(min(masses_kg_m2) / k)
    cam, gear, rotor = speed_rad_s, motor_rad_s, motor_rad_s
    dog = 0.0  # compression of the contact of cam and gear (rad); below 0 the gap
    head = -backlash_rad  # the same for gear and rotor
    blow = kick = 0.0
    for _ in range(STEPS_MAX):
        step = shortest
        if dog <= 0.0 and head <= 0.0:
            moving_j = 0.5 * (cam_kg_m2 * (cam - motor_rad_s) ** 2 + gear_kg_m2 * (gear - motor_rad_s) ** 2)
            swing = abs(gear - rotor)
            if cam < rotor - swing:  # the rotor is never slowed: the gear does not fall back on this cam again
                moving_j = min(moving_j, 0.5 * gear_kg_m2 * swing**2)
            step += _flight_s(dog, cam - gear, head, gear - rotor, backlash_rad)
            if math.isinf(step) or moving_j < 0.5 * kick**2 / k:  # no later impact can be stronger
                break
        # comparisons instead of `max`, whose calls took half of the time
        at_dog = k * dog + dog_damping * (cam - gear) if dog > 0.0 else 0.0
        at_head = k * head + head_damping * (gear - rotor) if head > 0.0 else 0.0
        at_dog = at_dog if at_dog > 0.0 else 0.0
        at_head = at_head if at_head > 0.0 else 0.0
        blow = at_dog if at_dog > blow else blow
        kick = at_head if at_head > kick else kick
        cam -= step * at_dog / cam_kg_m2
        gear += step * (at_dog - at_head) / gear_kg_m2
        rotor += step * at_head / rotor_kg_m2
        dog, head = dog + step * (cam - gear), head + step * (gear - rotor)
        if head < -backlash_rad:  # the other end of the backlash, where the gear rebounds
            head, gear = -backlash_rad, rotor + rebound * abs(gear - rotor)
    return blow, kick


def _flight_s(dog: float, closing: float, head: float, ahead: float, backlash_rad: float) -> float:
    """Return the time until the next contact: cam and gear, or gear and rotor on either flank; infinite if none."""
    times = [-dog / closing] if closing > 0.0 else []
    if ahead:
        times.append(-head / ahead if ahead > 0.0 else -(head + backlash_rad) / ahead)
    return min(times, default=math.inf)
