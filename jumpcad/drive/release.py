"""The release of a robot: the energy that is left in the springs, and the torque peak at the gear motor.

The end of the dog's play stops the cam; the gear then takes up the gearhead's backlash and strikes the rotor. `rolling`
has the model, `corner` the roller's path, `dog` the impacts. Checked against a contact simulation of the exported
meshes (`tests/clients`).
"""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.drive.corner import clear_window_rad, roll_over
from jumpcad.drive.dog import PLAY_MORE_RAD
from jumpcad.drive.rolling import ReleaseParts, roll
from jumpcad.drive.synthesis import Drive
from jumpcad.findings import Basis, Finding, at_least, at_most, choose, higher, lower
from jumpcad.mechanism.model import RollerOff, Spring
from jumpcad.mechanism.planar import ReflectedMass
from jumpcad.workshop import Workshop
from jumpcad.workshop.tables import ReleaseTable

SLOW_SHARE = 0.4
"""Of the unloaded cam's speed on a full battery: the slowest motor; judgement, an empty battery and dry gears. The
slower the roller comes over the top, the less the leg swings up on its lever, and the harder is the kick; below half of
the speed it changes by 3 %."""
SLOWEST_RAD_S = 0.05
"""A cam that turns more slowly, once in two minutes, is computed with this speed: the leg no longer swings."""
MODEL = "equations of motion: jumpcad/drive/rolling.py, checked by a contact simulation (tests/clients)"
BASIS = {
    "release_energy": Basis(
        "(springs' energy + I·ω²/2 when the roller has left the cam)/energy stored before ≥ release.energy_ratio_min "
        "(%); least of a sharp and a rounded corner, each with a slow and a quick motor",
        f"{MODEL}; limit: judgement",
    ),
    "release_kick": Basis(
        "(1 + safety.kick_reserve)·T ≤ min(safety.motor_torque_max_nm, torque at which a pinion's teeth reach "
        "strength_in_plane_mpa/s) (mN·m); T largest torque at the gear motor after the cam reaches the "
        "end of the dog's play, same cases as `release_energy`",
        f"impacts with rebound: jumpcad/drive/dog.py; {MODEL}; teeth: Lewis",
    ),
    "cam_corner": Basis(
        "energy as in `release_energy`, but over a worn corner ≥ release.energy_ratio_min (%); its radius ρ is that at "
        "which √(N·E/((1 - ν²)·π·b)·(1/ρ + 1/R)) falls to 4·strength_in_plane_mpa/√3, N largest force on the roller, R "
        "its radius, b its width, E modulus of the gears' material",
        f"Hertz's line contact; shakedown of one that rolls: Johnson, Contact Mechanics, 9.2; {MODEL}",
    ),
    "release_window": Basis(
        "play + ω·t + 3° ≤ window (°); ω unloaded cam with a full battery, t time of the push-off up to past rest, "
        "window: cam angle past the lift up to which the roller's whole path is free",
        "energy of the push-off: jumpcad/mechanism/planar.py; geometry of cam and roller; 3°: judgement",
    ),
}


@dataclass(frozen=True)
class MovingParts:
    """What the finished parts add to a drive: springs, reflected leg, moments of inertia about their own axes (kg·m²).

    `bore_mm` is the cam's; `lever_n_per_m` the bending stiffness of the lever at the roller, `roller_kg` the mass of
    the roller, with its screw and the part of the lever that moves with it.
    """

    spring: Spring
    leg: ReflectedMass
    cam_kg_m2: float
    cam_gear_kg_m2: float
    pinion_kg_m2: float
    bore_mm: float
    lever_n_per_m: float
    roller_kg: float


@dataclass(frozen=True)
class Release:
    """The release of one robot.

    - `off`: Where the jump starts: the roller has left the corner as printed.
    - `energy_ratio`, `rounded_ratio`: Energy left in the springs plus the leg's kinetic energy, over the energy stored
      while the lever was bent: with the corner as printed, and rounded.
    - `bending_ratio`: Energy stored while the lever was bent, over the energy stored with a rigid lever.
    - `blow_nm`, `kick_nm`, `kick_limit_nm`: Largest torque in the dog, at the cam; torque peak on the gear motor's
      output, and its limit.
    - `gear_ratio`, `push_off_s`: Motor turns per cam turn; time from release until the leg is as far past rest as it
      may swing.
    - `worn_rad`: How much earlier the leg begins to fall over a worn corner, as an angle of the cam.
    - `free_play_rad`, `roll_over_rad`, `window_rad`: Play of the dog; cam angle from the end of the lift until the
      roller can fall freely; range in which it can.
    """

    off: RollerOff
    energy_ratio: float
    rounded_ratio: float
    bending_ratio: float
    blow_nm: float
    kick_nm: float
    kick_limit_nm: float
    gear_ratio: float
    push_off_s: float
    worn_rad: float
    free_play_rad: float
    roll_over_rad: float
    window_rad: tuple[float, float]
    parts: tuple[ReleaseParts, ...]
    findings: tuple[Finding, ...]


def release(drive: Drive, moving: MovingParts, workshop: Workshop) -> Release:
    """Return the release of a drive with its finished parts: the worst of four cases.

    They are a sharp and a rounded corner, each with a slow motor, the heaviest rotor and the largest backlash, and with
    a quick one, the lightest and the smallest. Rotor and backlash matter where the dog's play is too small; with
    enough play only the speed does.
    """
    geometry, law, train = drive.cam.geometry, drive.cam.law, drive.train
    table, sharp = workshop.release, roll_over(geometry)
    top = int(sharp.wind_rad.argmax())
    wound, contact = float(sharp.wind_rad[top]), 1000.0 * table.contact_n_per_mm * (sharp.arm_mm[top] / 1000.0) ** 2
    cases = tuple(
        _parts(drive, moving, table, float(contact), *motor)
        for motor in zip(table.rotor_kg_m2, table.backlash_deg, (1.0, SLOW_SHARE), strict=True)
    )
    printed = [roll(sharp, case, wound) for case in cases]
    corner = roll_over(geometry, table.corner_radius_mm)
    rounded = [roll(corner, case, wound) for case in cases]
    worn = roll_over(geometry, drive.cam.worn_mm)
    kept = min(rolled.kept_j / rolled.held_j for rolled in (roll(worn, case, wound) for case in cases))
    first, second = (min(each, key=lambda rolled: rolled.kept_j) for each in (printed, rounded))
    ratios = first.kept_j / first.held_j, second.kept_j / second.held_j
    kick = max(rolled.kick_nm for rolled in printed + rounded) / train.ratio
    push_off = moving.leg.push_off_s(moving.spring, geometry.overshoot_rad)
    allowed, window = _kick_limit_nm(drive, workshop), clear_window_rad(geometry)
    kept_share = first.kept_j / moving.spring.energy_j  # the energy that bends the lever counts as lost
    return Release(
        off=RollerOff(round(-first.wind_rad, 9), round(-first.wind_rad_s, 6), round(kept_share, 9)),
        energy_ratio=ratios[0], rounded_ratio=ratios[1], kick_nm=kick, kick_limit_nm=allowed,
        bending_ratio=first.held_j / moving.spring.stored_j(-law.compression_rad),
        blow_nm=max(rolled.blow_nm for rolled in printed + rounded),
        gear_ratio=train.ratio, push_off_s=push_off, worn_rad=law.lift_rad - float(worn.cam_rad[0]),
        free_play_rad=drive.dog.play_rad, roll_over_rad=drive.cam.roll_over_rad, window_rad=window, parts=cases,
        findings=_findings(drive, workshop, (min(ratios), kept), kick, allowed, window[1], push_off),
    )  # fmt: skip


def _parts(
    drive: Drive, moving: MovingParts, table: ReleaseTable, contact_nm_per_rad: float, rotor_kg_m2: float,
    backlash_deg: float, speed_share: float,
) -> ReleaseParts:  # fmt: skip
    """Return the parts of a release with one motor, reflected to the cam; contact stiffness as at the lift's end."""
    train, lever_m = drive.train, drive.cam.geometry.lever_mm / 1000.0
    return ReleaseParts(
        spring=moving.spring, leg=moving.leg, cam_kg_m2=moving.cam_kg_m2,
        gear_kg_m2=moving.cam_gear_kg_m2 + moving.pinion_kg_m2 * train.ratio**2,
        rotor_kg_m2=rotor_kg_m2 * (train.motor.ratio * train.ratio) ** 2, play_rad=drive.dog.play_rad,
        backlash_rad=math.radians(backlash_deg) / train.ratio,
        cam_rad_s=max(speed_share * train.cam_speed_rad_s, SLOWEST_RAD_S), rebound=table.rebound,
        friction_mm=table.friction * moving.bore_mm / 2.0, train_nm_per_rad=table.train_nm_per_rad,
        lever_nm_per_rad=moving.lever_n_per_m * lever_m**2, contact_nm_per_rad=contact_nm_per_rad,
        roller_kg_m2=moving.roller_kg * lever_m**2,
    )  # fmt: skip


def _kick_limit_nm(drive: Drive, workshop: Workshop) -> float:
    """Return the largest torque on the gear motor's output: what its gearhead and every printed pinion withstand."""
    allowed, geared = workshop.safety.motor_torque_max_nm, 1.0
    teeth_mpa = workshop.material("gears").strength_in_plane_mpa / workshop.safety.printed_factor
    for pair in drive.train.stages:
        allowed = min(allowed, teeth_mpa / pair.pinion.lewis_stress_mpa(geared))
        geared *= pair.ratio
    return allowed


def _told_apart(found: float, allowed: float) -> tuple[str, str]:
    """Return both numbers, with as many decimals as tell them apart, two at most."""
    for decimals in range(3):
        told = f"{found:.{decimals}f}", f"{allowed:.{decimals}f}"
        if told[0] != told[1]:
            break
    return told


def _findings(
    drive: Drive, workshop: Workshop, ratios: tuple[float, float], kick_nm: float, allowed_nm: float, window_rad: float,
    push_off_s: float,
) -> tuple[Finding, ...]:  # fmt: skip
    (ratio, worn), least = ratios, 100.0 * workshop.release.energy_ratio_min
    play, over = math.degrees(drive.dog.play_rad), math.degrees(drive.cam.roll_over_rad)
    turned, reserved = drive.train.cam_speed_rad_s * push_off_s, (1.0 + workshop.safety.kick_reserve) * kick_nm
    needed, window = play + math.degrees(turned + PLAY_MORE_RAD), math.degrees(np.nan_to_num(window_rad))
    more_play = (f'release.play_deg = "auto" or more than {over + 3.0:.0f}', *choose("a smaller", "bought.roller"))
    return (
        at_least(
            "release_energy", 100.0 * ratio, least, "%",
            f"at least {100.0 * ratio:.1f} % of the springs' energy is left after the release; "
            f"{least:g} % are needed (dog's play {play:.0f}°, roll-over {over:.0f}°)",
            more_play,
        ),
        at_least(
            "cam_corner", 100.0 * worn, least, "%",
            f"the cam's corner wears to a radius of {drive.cam.worn_mm:.1f} mm, with which {100.0 * worn:.1f} % of the "
            f"springs' energy is left after the release; {least:g} % are needed",
            (*higher("release.play_deg"), *choose("a wider or larger", "bought.roller"),
             "a stronger material of the gears"), "warning",
        ),
        at_most(
            "release_kick", 1000.0 * reserved, 1000.0 * allowed_nm, "mN·m",
            f"torque peak at the gear motor when the released cam strikes: {1000.0 * kick_nm:.0f} mN·m, "
            f"{1000.0 * reserved:.0f} mN·m with the reserve; {1000.0 * allowed_nm:.0f} mN·m are allowed",
            ("a stiffer lever", *more_play), grows="lever",
        ),
        at_most(
            "release_window", needed, window, "°",
            "the cam may turn {}° past the end of its lift while the leg swings back; the roller's path is "
            "free up to {}°".format(*_told_apart(needed, window)),
            ("a slower or lighter motor", *lower("release.play_deg"), *choose("a smaller", "bought.roller")),
        ),
    )  # fmt: skip
