"""The motion of a robot from rest to landing for the 3-D viewer, each phase with its own time scale (SI).

Phases: the cam winds the springs, the roller drops, the legs extend, the robot flies. Up to the release the robot
stands with its foot flat; from then on its poses are those of a simulated jump.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.drive.motor import lift_s
from jumpcad.errors import JumpcadError
from jumpcad.exporters.glb import BodyMotion
from jumpcad.landing.course import Trip
from jumpcad.landing.series import Series
from jumpcad.mechanism.mass import combined
from jumpcad.mechanism.model import BODY, BODY_NAMES, MAIN_LEG, body_poses
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.jump import Trajectory
from jumpcad.transforms import Array, pose_at

WINDING_MOMENTS, DROP_MOMENTS = 49, 7
"""Number of poses of these phases."""
SHOWN_S = {"winding": 3.0, "drop": 0.6, "push-off": 1.6, "flight": 2.4}
"""Duration of each phase in the viewer; judgement: long enough to be seen."""
SERIES_S = {"winding": 1.6, "turning": 1.2, "push-off": 0.9, "flight": 1.6, "landing": 1.3}
"""The same of each of several jumps in a row."""
SERIES_EVERY = {"winding": 8, "flight": 2}
"""Of jumps in a row, every so many recorded moments of a phase are kept."""
FLIGHT_EVERY = 4
"""Every fourth recorded moment of the flight is kept: it is smooth."""
ENGINE = "planar"
"""Available on every platform, so that a bundle has the same bytes on each."""
POSITION_DIGITS, TURN_DIGITS = 5, 5
"""Decimals of positions (m) and quaternions: coarser than the differences between processors."""


@dataclass(frozen=True)
class PhasePose:
    """One pose of the robot: the bodies' frames (4, 4) in the world (m), cam and cam gear from rest, time in phase."""

    phase: str
    time_s: float
    poses: dict[str, Array]
    cam_rad: float
    gear_rad: float


def motion(robot: Robot, trajectory: Trajectory | None, takeoff_s: float | None) -> dict[str, Any]:
    """Return the motion as columns for the viewer; without a trajectory it ends with loaded springs.

    `takeoff_s` is the time of take-off in the trajectory. Of the columns `show_s` (n,) is the time at which each moment
    is shown, `time_s` (n,) the real time since the start of its phase, `phase` (n,) the phase's name, `phases` the time
    scale of each phase in words, `cam_rad` and `gear_rad` (n,) are angles from rest, `com_m` (n, 2) is the centre of
    mass in x and z, `frames` has position and quaternion xyzw (n, 7) by body.
    """
    return _columns(robot, list(_moments(robot, trajectory, takeoff_s)), SHOWN_S)


def _columns(robot: Robot, moments: list[PhasePose], lengths_s: Mapping[str, float]) -> dict[str, Any]:
    """Return moments as columns, each phase shown as long as said."""
    real, shown, shift = _times(moments, lengths_s)
    return {
        "show_s": shown, "time_s": real, "phase": [moment.phase for moment in moments], "phases": shift,
        "cam_rad": [round(moment.cam_rad, TURN_DIGITS) for moment in moments],
        "gear_rad": [round(moment.gear_rad, TURN_DIGITS) for moment in moments],
        "com_m": [(_com(robot, one)[[0, 2]].round(POSITION_DIGITS) + 0.0).tolist() for one in moments],
        "frames": {name: [_seven(moment.poses[name]) for moment in moments] for name in BODY_NAMES},
    }  # fmt: skip


def series_motion(robot: Robot, series: Series | Trip) -> dict[str, Any]:
    """Return the recorded motion of jumps in a row as columns for the viewer, as `motion`; `com_m` (n, 3) has x, z, y.

    Each phase of each jump has its own time scale; its name ends in the jump's number.
    """
    trajectory = series.trajectory
    assert trajectory is not None
    law, ahead = robot.layout.drive.cam.law, robot.layout.drive.cam.geometry.free_rad
    cams = np.linspace(0.0, law.lift_rad, WINDING_MOMENTS)
    shares = law.wind_rad(cams) / law.compression_rad
    moments = []
    for index, name in enumerate(series.phases):
        phase, number = name.split()
        edge = name not in series.phases[index - 1 : index] or name not in series.phases[index + 1 : index + 2]
        if index % SERIES_EVERY.get(phase, 1) and not edge:
            continue
        poses, turned = recorded_poses(trajectory, index), 2.0 * math.pi * (int(number) - 1)
        gear = float(np.interp(_loaded(robot, poses), shares, cams)) if phase == "winding" else law.lift_rad
        cam = gear if phase in ("winding", "turning") else ahead
        moments.append(PhasePose(name, float(trajectory.time_s[index]), poses, turned + cam, turned + gear))
    columns = _columns(robot, moments, {name: SERIES_S[name.split()[0]] for name in series.phases})
    aside = [round(_com(robot, moment)[1], POSITION_DIGITS) + 0.0 for moment in moments]
    return columns | {"com_m": [[*com, y] for com, y in zip(columns["com_m"], aside, strict=True)]}


def _loaded(robot: Robot, poses: dict[str, Array]) -> float:
    """Return how far the springs are loaded in some poses of the bodies, as a share."""
    angles = []
    for one in (body_poses(robot, 0.0), body_poses(robot, 1.0), poses):
        turn = one[BODY][:3, :3].T @ one[MAIN_LEG][:3, :3]
        angles.append(math.atan2(turn[0, 2], turn[0, 0]))
    return (angles[2] - angles[0]) / (angles[1] - angles[0])


def _moments(robot: Robot, trajectory: Trajectory | None, takeoff_s: float | None) -> Iterator[PhasePose]:
    """Yield the moments of all phases; the last pose of a phase is the first of the next."""
    drive = robot.layout.drive
    law, train = drive.cam.law, drive.train
    lift, whole = law.lift_rad, robot.spring.wind_rad
    for angle in np.linspace(0.0, lift, WINDING_MOMENTS).tolist():
        loaded = float(law.wind_rad(angle)) / law.compression_rad
        time_s = lift_s(law, train.driven, train.ratio, train.efficiency, angle)
        yield PhasePose("winding", time_s, body_poses(robot, loaded), angle, angle)
    if trajectory is None or robot.roller_off is None:
        return
    ahead = drive.cam.geometry.free_rad
    for share in np.linspace(0.0, 1.0, DROP_MOMENTS).tolist():
        leg = -whole + share * (robot.roller_off.leg_rad + whole)
        time_s = share * robot.release.roll_over_rad / train.cam_speed_rad_s
        yield PhasePose("drop", time_s, body_poses(robot, -leg / whole), lift + share * (ahead - lift), lift)
    for moment, time_s in enumerate(trajectory.time_s.tolist()):
        flies = takeoff_s is not None and time_s > takeoff_s
        if not flies or moment % FLIGHT_EVERY == 0 or moment == len(trajectory.time_s) - 1:
            yield PhasePose("flight" if flies else "push-off", time_s, recorded_poses(trajectory, moment), ahead, lift)


def _times(moments: list[PhasePose], lengths_s: Mapping[str, float]) -> tuple[list[float], list[float], dict[str, str]]:
    """Return real and shown times of the moments (s), and the time scale of each phase in words."""
    real: list[float] = []
    shown: list[float] = []
    words: dict[str, str] = {}
    start = 0.0
    for phase, length in lengths_s.items():
        times = np.array([moment.time_s for moment in moments if moment.phase == phase])
        if not len(times):
            continue
        span = max(float(times[-1] - times[0]), 1e-9)
        real += np.round(times, 4).tolist()
        shown += np.round(start + length * (times - times[0]) / span, 4).tolist()
        words[phase] = f" ({speed_in_words(length / span)})"
        start += length
    return real, shown, words


def speed_in_words(slower: float) -> str:
    """Return how fast a motion is shown that takes `slower` times as long as in reality, as a player says it."""
    if f"{slower:.1f}" == "1.0":
        return "at real speed"
    return f"slow motion, {slower:.3g} times" if slower > 1.0 else f"sped up, {1.0 / slower:.3g} times"


def recorded_poses(trajectory: Trajectory, moment: int) -> dict[str, Array]:
    """Return the poses (4, 4) of the bodies' frames in the world at an index of a trajectory, by name (m)."""
    turns = Rotation.from_quat(trajectory.quaternion_xyzw[moment]).as_matrix()
    places = trajectory.position_m[moment]
    return {name: pose_at(turn, place) for name, turn, place in zip(trajectory.body_names, turns, places, strict=True)}


def _com(robot: Robot, moment: PhasePose) -> Array:
    return combined(body.placed(moment.poses[name]) for name, body in robot.bodies.items()).com_m


def _seven(pose: Array) -> list[float]:
    """Return position and quaternion (x, y, z, w), w not negative, of a pose."""
    turn = Rotation.from_matrix(pose[:3, :3]).as_quat(canonical=True)
    seven = [*np.round(pose[:3, 3], POSITION_DIGITS), *np.round(turn, TURN_DIGITS)]
    return [float(value) + 0.0 for value in seven]


def jump_motion(robot: Robot) -> BodyMotion | None:
    """Return the motion from release to touchdown; None if the engine finds no jump or cannot simulate the robot."""
    try:
        path = simulate(robot, Settings(flight="simulated", trajectory=True), ENGINE).trajectory
    except JumpcadError:
        return None
    if path is None:
        return None
    places = {name: path.position_m[:, index] for index, name in enumerate(path.body_names)}
    turns = {name: path.quaternion_xyzw[:, index] for index, name in enumerate(path.body_names)}
    return BodyMotion(path.time_s, places, turns)
