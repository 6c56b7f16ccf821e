"""The figures that the studio shows of a design: at once those of the capsule robot, then those of the printed one."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

from jumpcad.building import build
from jumpcad.bundle.limits import JUST, ordered, used, with_verdict
from jumpcad.checks import quick_findings
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.files import read_toml, templates_folder
from jumpcad.files.rendering import fill
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Jump, simulate
from jumpcad.workshop import Workshop

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
