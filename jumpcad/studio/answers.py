"""What the studio shows of a design: its figures, at once the capsule robot's, then the printed one's, and its motion.

The motion is that of report.html from rest to landing, as it is at any moment, between the page's moments too.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from jumpcad.building import build
from jumpcad.bundle.limits import JUST, ordered, used, with_verdict
from jumpcad.bundle.motion import motion, speed_in_words
from jumpcad.bundle.viewer import turning_parts
from jumpcad.checks import quick_findings
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.files import read_toml, templates_folder
from jumpcad.files.templates import fill
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Jump, headline, simulate
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop

CAM = "cam"
"""The part that turns as the cam does; the others follow the cam's gear, which does not run ahead."""
SHORTEST_S = 1e-9
"""Less than the time between two moments."""
SHOWN = 5
"""Number of limits that are shown, and more where more are violated."""


@dataclass(frozen=True)
class Printed:
    """A printed robot with its jump, or the reason why it cannot be built."""

    design: Design
    robot: Robot | None = None
    jump: Jump | None = None
    reason: str = ""

    @cached_property
    def findings(self) -> list[Finding]:
        """Every limit, the violated ones first, then those just kept that have no share, then the tightest ones."""
        if self.robot is None or self.jump is None:
            return []
        every = ordered(with_verdict(quick_findings(self.robot), self.jump))
        kept = [one for one in every if one.severity == "info"]
        just = [one for one in kept if one.use is None and used(one) == JUST]
        return [one for one in every if one.severity != "info"] + just + [one for one in kept if one.use is not None]

    @property
    def wrong_parts(self) -> frozenset[str]:
        """The names of the parts that the violated limits are about."""
        violated = {one.name for one in errors(self.findings)}
        limits_of, _ = read_toml(templates_folder() / "texts" / "parts_of_limits.toml")
        return frozenset(part for parts, names in limits_of.items() if violated & {*names} for part in parts.split())

    def to_markdown(self, before: "Printed | None" = None) -> str:
        """Return figures and limits as tables in Markdown, with the differences of the figures from another robot's."""
        if self.robot is None or self.jump is None:
            return f"**cannot be built**: {self.reason} (pale: the last robot that could be built)"
        old = before.figures() if before else {}
        violated = sum(finding.severity != "info" for finding in self.findings)
        values = {
            "verdict": self.jump.verdict,
            "figures": [(name, value, unit, value - old.get(name, (value, ""))[0])
                        for name, (value, unit) in self.figures().items()],
            "limits": [(finding, used(finding).removesuffix(" used").removeprefix("margin "))
                       for finding in self.findings[: max(SHOWN, violated)]],
        }  # fmt: skip
        return fill("texts/studio.md.j2", values)

    def figures(self) -> dict[str, tuple[float, str]]:
        """Return value and unit of each figure by its name; nothing for a robot that cannot be built."""
        if self.robot is None or self.jump is None:
            return {}
        return {
            "touchdown": (1000.0 * (self.jump.touchdown_distance_m or 0.0), "mm"),
            "rise": (1000.0 * (self.jump.com_rise_m or 0.0), "mm"),
            "mass": (1000.0 * self.robot.mass_kg, "g"),
            "spring energy": (1000.0 * self.robot.spring.energy_j, "mJ"),
            "winding": (self.robot.layout.drive.train.winding_s, "s"),
        }


@lru_cache(maxsize=64)
def capsule_answer(design: Design) -> str:
    """Return touchdown and rise of the capsule robot (the study's masses), by the planar engine, as Markdown."""
    jump = simulate(capsule_robot(design), engine="planar")
    if jump.touchdown_distance_m is None:
        return f"study's masses: **{jump.verdict}**"
    way_mm, rise_mm = 1000.0 * jump.touchdown_distance_m, 1000.0 * (jump.com_rise_m or 0.0)
    return f"study's masses: **{way_mm:.0f} mm**, rise {rise_mm:.0f} mm"


def printed_answer(design: Design, workshop: Workshop, name: str = "robot") -> Printed:
    """Return the printed robot and its jump, by the planar engine."""
    try:
        robot = build(design, workshop, name)
        return Printed(design, robot, simulate(robot, engine="planar"))
    except JumpcadError as error:
        return Printed(design, reason=str(error))


@dataclass(frozen=True)
class ShownMoment:
    """What is shown at one time: `frames` are position (m) and quaternion xyzw of the bodies by name.

    `turned_rad` are the angles of the turning parts from rest; `phase` and `real_s` say where in the motion it is,
    `slower` how many times slower than real time it is shown.
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
        keys = "cam_rad", "gear_rad", "time_s"
        cam, gear, real = (float(np.interp(wanted, shown, self.motion[key])) for key in keys)
        return ShownMoment(
            {name: _posed(poses[low], poses[low + 1], share) for name, poses in self._frames.items()},
            {one["node"]: one["per_cam"] * (cam if one["node"] == CAM else gear) for one in self.turning},
            self.motion["phase"][low + 1 if share == 1.0 else low],
            real,
            span / max(self.motion["time_s"][low + 1] - self.motion["time_s"][low], SHORTEST_S),
        )

    @cached_property
    def _shown_s(self) -> Array:
        return np.array(self.motion["show_s"])

    @cached_property
    def _frames(self) -> dict[str, Array]:
        return {name: np.array(poses) for name, poses in self.motion["frames"].items()}


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
