"""A robot's motion from rest to landing, as it is at any moment: the motion of report.html, between its moments too."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from jumpcad.bundle.motion import motion, speed_in_words
from jumpcad.bundle.viewer import turning_parts
from jumpcad.robot.robot import Robot
from jumpcad.simulation import headline
from jumpcad.transforms import Array

CAM = "cam"
"""The part that turns as the cam does; the others follow the cam's gear, which does not run ahead."""

SHORTEST_S = 1e-9
"""Less than the time between two moments."""


@dataclass(frozen=True)
class ShownMoment:
    """What is shown at one time.

    `frames` are position (m) and quaternion xyzw of the bodies by name, `turned_rad` the angles of the turning parts
    from rest; `phase` and `real_s` say where in the motion it is, `slower` how many times slower than real time it is
    shown.
    """

    frames: dict[str, Array]
    turned_rad: dict[str, float]
    phase: str
    real_s: float
    slower: float

    def to_text(self, slower: float = 1.0) -> str:
        """Return phase, time and time scale in words, of a motion that is played `slower` times slower still."""
        time = f"{self.real_s:.{3 if self.real_s < 1.0 else 1}f} s"
        return f"{self.phase}, {time} ({speed_in_words(self.slower * slower)})"


@dataclass(frozen=True)
class Playback:
    """A motion as `jumpcad.bundle.motion` gives it, and the turning parts of `jumpcad.bundle.viewer`."""

    motion: dict[str, Any]
    turning: list[dict[str, Any]]

    @property
    def end_s(self) -> float:
        """The time at which the last moment is shown."""
        return float(self._shown_s[-1])

    @property
    def com_m(self) -> Array:
        """The path of the centre of mass (n, 3), in the plane y = 0 (m)."""
        path = np.array(self.motion["com_m"])
        return np.insert(path, 1, 0.0, axis=1)

    def at(self, shown_s: float) -> ShownMoment:
        """Return the moment that is shown at a time, which is brought into the motion."""
        shown = self._shown_s
        wanted = min(max(shown_s, 0.0), self.end_s)
        low = min(int(np.searchsorted(shown, wanted, side="right")) - 1, len(shown) - 2)
        span = float(shown[low + 1] - shown[low])
        share = (wanted - float(shown[low])) / span
        (cam, _), (gear, _), (real, lasts) = (
            _between(self.motion[key], low, share) for key in ("cam_rad", "gear_rad", "time_s")
        )
        return ShownMoment(
            {name: _posed(poses[low], poses[low + 1], share) for name, poses in self._frames.items()},
            {one["node"]: one["per_cam"] * (cam if one["node"] == CAM else gear) for one in self.turning},
            self.motion["phase"][low + 1 if share == 1.0 else low],
            real,
            span / max(lasts, SHORTEST_S),
        )

    @cached_property
    def _shown_s(self) -> Array:
        return np.array(self.motion["show_s"])

    @cached_property
    def _frames(self) -> dict[str, Array]:
        return {name: np.array(poses) for name, poses in self.motion["frames"].items()}


def _between(values: list[float], low: int, share: float) -> tuple[float, float]:
    """Return the value between an index and the next one, and their difference."""
    step = values[low + 1] - values[low]
    return values[low] + share * step, step


def _posed(first: Array, second: Array, share: float) -> Array:
    """Return the pose between two that are near each other: position (m) and unit quaternion xyzw."""
    near = second if first[3:] @ second[3:] >= 0.0 else np.concatenate([second[:3], -second[3:]])
    mixed: Array = first + share * (near - first)
    mixed[3:] /= np.sqrt((mixed[3:] ** 2).sum())
    return mixed


def playback(robot: Robot) -> Playback:
    """Return the motion of a robot, by the engine of its report."""
    jump = headline(robot, trajectory=True)
    return Playback(motion(robot, jump.trajectory, jump.takeoff_time_s), turning_parts(robot))
