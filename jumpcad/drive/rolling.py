"""The release: the roller rolls over the cam's corner, the cam runs ahead through the dog's play to its end (SI).

It begins at the end of the lift, with the leg still rising: the leg swings on its lever while the motor carries the
roller over the top, and what the lever is bent by then is what throws the cam.

The model has a cam (inertia J, angle phi), a leg (inertia I reflected to its joint, wind angle theta), and between
them the lever, an elastic link with the roller's mass at its end. During contact the corner sets the roller's wind
angle w(phi); the lever's torque Q = k·(w - theta) accelerates cam and roller, less friction, and holds the leg against
springs and weight. Contact ends where its force would be tension. The energy that bends the lever goes to the cam, the
lightest of the three. The compliance of the contact itself is in series with the lever.

The gear joins the cam at the end of the dog's play, the motor's rotor at the end of the gearhead's backlash. If the
corner is then still below the falling roller, the roller lands on it again. `dog` has the torque peaks of these
impacts, with rebound. Friction in gears and gearhead is not modelled.
"""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.drive.corner import Corner
from jumpcad.drive.dog import largest_torques_nm
from jumpcad.mechanism.model import Spring
from jumpcad.mechanism.planar import ReflectedMass

LONGEST_S = 1e-4
"""Longest time step, used while the motor turns the cam slowly: a hundredth of an oscillation of leg and lever."""


@dataclass(frozen=True)
class ReleaseParts:
    """The parts of a release; inertias, angles and torques of the drive are reflected to the cam.

    - `spring`, `leg`: Springs, and the robot's mass and weight reflected to its leg joint.
    - `cam_kg_m2`, `gear_kg_m2`, `rotor_kg_m2`: Cam, cam gear with what turns with it, and the motor's rotor times the
      square of the whole ratio.
    - `play_rad`, `backlash_rad`: The dog's play, and the backlash of gearhead and teeth.
    - `cam_rad_s`: Speed at which the gear pushes the cam over the end of the lift.
    - `rebound`: Coefficient of restitution between cam and gear.
    - `friction_mm`: Coefficient of friction times the radius of the cam's bore.
    - `train_nm_per_rad`: Stiffness of dog, teeth and gearhead, which stops the cam.
    - `lever_nm_per_rad`, `contact_nm_per_rad`, `roller_kg_m2`: Stiffness of the lever in bending and of roller on cam,
      and moment of inertia of roller and lever's end, at the leg's joint.
    """

    spring: Spring
    leg: ReflectedMass
    cam_kg_m2: float
    gear_kg_m2: float
    rotor_kg_m2: float
    play_rad: float
    backlash_rad: float
    cam_rad_s: float
    rebound: float
    friction_mm: float
    train_nm_per_rad: float
    lever_nm_per_rad: float
    contact_nm_per_rad: float
    roller_kg_m2: float

    @property
    def held_nm_per_rad(self) -> float:
        """Stiffness between leg and cam: lever and contact in series."""
        return 1.0 / (1.0 / self.lever_nm_per_rad + 1.0 / self.contact_nm_per_rad)

    def held_rad(self, roller_rad: float) -> float:
        """Return the leg's wind angle in equilibrium, the lever bent and the roller at a wind angle."""
        weight = float(self.leg.at(np.array(roller_rad))[2])
        spring, lever = self.spring, self.held_nm_per_rad
        wind = lever * roller_rad - spring.stiffness_nm_per_rad * spring.preload_rad - weight
        return wind / (lever + spring.stiffness_nm_per_rad)


@dataclass(frozen=True)
class Rolled:
    """One release over one corner.

    - `wind_rad`, `wind_rad_s`: Angle and rate of the leg when the roller has left the cam for the last time.
    - `kept_j`, `held_j`: Energy left in the springs then, plus the leg's kinetic energy; and the energy stored before,
      the lever bent.
    - `blow_nm`, `kick_nm`: Largest torque in the dog, and in the gear train behind its backlash, both at the cam.
    """

    wind_rad: float
    wind_rad_s: float
    kept_j: float
    held_j: float
    blow_nm: float
    kick_nm: float


def roll(corner: Corner, parts: ReleaseParts, wound_rad: float) -> Rolled:
    """Return the release over a corner, the roller at first at a wind angle."""
    release = _Release(corner, parts)
    release.run()
    spring, inertia = parts.spring, float(parts.leg.at(np.array(release.wind))[0])
    return Rolled(
        release.wind, release.rate, spring.stored_j(-release.wind) + 0.5 * inertia * release.rate**2,
        spring.stored_j(-parts.held_rad(wound_rad)), release.blow_nm, release.kick_nm,
    )  # fmt: skip


class _Release:
    """The state of one release: position on the corner (index), cam's speed and inertia, leg's wind angle and rate."""

    def __init__(self, corner: Corner, parts: ReleaseParts) -> None:
        self.corner, self.parts = corner, parts
        self.step = float(corner.cam_rad[1] - corner.cam_rad[0])
        self.leg_inertia, _, self.weight = parts.leg.at(corner.wind_rad)
        # friction tilts the contact force: the cam is driven as by a corner of smaller slope
        self.drive = -(corner.slope + parts.friction_mm / corner.arm_mm)
        self.last = len(self.drive) - 1
        self.first = int(np.argmax(self.drive > 0.0)) if (self.drive > 0.0).any() else self.last
        self.at = 0
        self.speed, self.inertia = parts.cam_rad_s, parts.cam_kg_m2
        # the leg still rises with the lift, and swings on its lever when the roller turns down
        self.wind, self.rate = parts.held_rad(float(corner.wind_rad[0])), float(corner.slope[0]) * parts.cam_rad_s
        self.touches = True
        self.blow_nm = self.kick_nm = 0.0

    def run(self) -> None:
        """Compute the release: the cam alone, then with the gear, then with the motor too."""
        parts = self.parts
        if parts.play_rad > 0.0:
            self._push_to(self._index(parts.play_rad))
            masses = (parts.cam_kg_m2, parts.gear_kg_m2, parts.rotor_kg_m2)
            self.blow_nm, self.kick_nm = largest_torques_nm(
                masses, self.speed, parts.cam_rad_s, parts.backlash_rad, parts.train_nm_per_rad, parts.rebound
            )
            self._join(parts.gear_kg_m2)
        else:
            self.inertia += parts.gear_kg_m2
        end = self._index(parts.play_rad + parts.backlash_rad)
        self._push_to(end)
        met_nm = self._join(parts.rotor_kg_m2)
        if parts.play_rad == 0.0 or end < self.last:  # the corner is still below the roller
            self.kick_nm = max(self.kick_nm, met_nm)
            self._push_off(end)

    def _push_off(self, end: int) -> None:
        """Follow the rest of the corner, the leg driving cam and motor; the leg's energy in a rebound is lost."""
        self.at = max(self.at, end) if not self.touches else self.at
        while self.at < self.last:
            begin = self.at
            if not self.touches:
                self._fall_to(self.at)
            self._push_to(self.last)
            if not self.touches:
                self.rate = min(self.rate, 0.0)
                self.at = max(self.at, begin + 1)

    def _index(self, angle_rad: float) -> int:
        """Return the index at which the cam has run ahead by an angle; the last one if that is beyond the corner."""
        return min(self.first + math.ceil(angle_rad / self.step), self.last)

    def _join(self, inertia: float) -> float:
        """Join another mass at rest without rebound; return the torque peak, speed·√(k·J1·J2/(J1 + J2))."""
        together = self.inertia + inertia
        blow = self.speed * math.sqrt(self.parts.train_nm_per_rad * self.inertia * inertia / together)
        self.speed *= self.inertia / together
        self.inertia = together
        return blow

    def _fall_to(self, at: int) -> None:
        """Move the leg towards rest until the roller touches the corner, at the cam's present angle."""
        here, spring = float(self.corner.wind_rad[at]), self.parts.spring
        lost = spring.stored_j(-self.wind) - spring.stored_j(-here)
        self.rate = -math.sqrt(max(self.rate**2 + 2.0 * lost / float(self.leg_inertia[at]), 0.0))
        self.wind, self.at, self.touches = min(self.wind, here), at, True

    def _push_to(self, stop: int) -> None:
        """Integrate the contact until the roller leaves the cam or the cam reaches an index (semi-implicit Euler)."""
        if not self.touches or stop <= self.at:
            return
        parts, part, step = self.parts, slice(self.at, stop + 1), self.step
        spring, lever = parts.spring, parts.held_nm_per_rad
        with_motor = self.inertia > parts.cam_kg_m2 + parts.gear_kg_m2
        tip = 0.0 if with_motor else parts.roller_kg_m2
        roller, slope = self.corner.wind_rad[part].tolist(), self.corner.slope[part].tolist()
        drive, bend = self.drive[part].tolist(), self.corner.bend[part].tolist()
        moving = (self.inertia + tip * self.corner.slope[part] ** 2).tolist()
        weight = (self.weight[part] + spring.stiffness_nm_per_rad * spring.preload_rad).tolist()
        mobility = (1.0 / self.leg_inertia[part]).tolist()
        least, square, wind, rate = parts.cam_rad_s**2, self.speed**2, self.wind, self.rate
        for number in range(stop - self.at):
            torque = lever * (roller[number] - wind)
            grown = (moving[number] * square + 2.0 * step * drive[number] * torque) / moving[number + 1]
            grown = max(grown, least)  # the motor keeps turning the cam
            gain = (grown - square) / (2.0 * step)
            if torque + tip * (bend[number] * square + slope[number] * gain) < 0.0:
                self.touches = False
                break
            if with_motor:
                self.kick_nm = max(self.kick_nm, parts.rotor_kg_m2 * gain)
            square = grown
            parts_of_it = math.ceil(step / math.sqrt(square) / LONGEST_S)
            time = step / math.sqrt(square) / parts_of_it
            for _ in range(parts_of_it):
                torque = lever * (roller[number] - wind)
                rate += time * mobility[number] * (torque - spring.stiffness_nm_per_rad * wind - weight[number])
                wind += time * rate
        else:
            number = stop - self.at
        self.at, self.speed, self.wind, self.rate = self.at + number, math.sqrt(square), wind, rate
