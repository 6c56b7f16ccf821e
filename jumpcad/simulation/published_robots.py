"""What is published of other jumping robots, each figure with its source and how surely it is known."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Literal

from pydantic import Field

from jumpcad.errors import JumpcadError
from jumpcad.files import Contradiction, Record, TomlTable, did_you_mean, read_toml, templates_folder

Confidence = Literal["read", "secondary", "derived", "remembered", "entered"]
MOST_FACTOR = 5.0
"""By which an entered figure may differ from that in the file: beyond, it is in another unit."""


class Figure(TomlTable):
    """One published figure, in the unit of its name's end."""

    value: Annotated[float, Field(gt=0)]
    confidence: Confidence
    source: str
    note: str = ""


class RobotFacts(TomlTable):
    """What is known of one robot; `differs` says why a figure differs, `reason` why the robot is left out."""

    name: str
    leg: str
    unknown: Annotated[tuple[str, ...], Field(strict=False)] = ()
    reason: str = ""
    differs: str = ""
    figures: dict[str, Figure] = Field(default_factory=dict)

    def sure(self, *names: str) -> bool:
        """Return whether none of the figures is only remembered, or derived from one that is."""
        return all(self.figures[name].confidence in ("read", "secondary", "entered") for name in names)

    def value(self, name: str) -> float:
        """Return a figure's value."""
        return self.figures[name].value


class Facts(Record):
    """All robots and sources."""

    sources: dict[str, str]
    robots: dict[str, RobotFacts]

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield figures of no source, and jumps with more energy than their springs hold."""
        for key, robot in self.robots.items():
            for name, figure in robot.figures.items():
                if figure.source not in self.sources:
                    yield ("robots", key, "figures", name, "source"), figure.source, "is not among [sources]"
            try:
                mass_g, speed, spring_j = map(robot.value, ("mass_g", "takeoff_speed_m_s", "spring_energy_j"))
            except KeyError:
                continue
            if (share := 0.5 * mass_g / 1000.0 * speed**2 / spring_j) > 1.0:
                reason = f"would be an efficiency of {share:.2f}, above 1: check mass, speed and spring energy"
                yield ("robots", key, "figures", "spring_energy_j"), spring_j, reason


def load_facts(entered: Mapping[str, float] | None = None) -> Facts:
    """Return the shipped facts, with values by `ROBOT.FIGURE` that a user read in the papers in place of theirs."""
    path = templates_folder() / "validation.toml"
    data, text = read_toml(path)
    for key, value in (entered or {}).items():
        robot, _, name = key.rpartition(".")
        figures = data["robots"].get(robot, {}).get("figures", {})
        if name not in figures:
            known = [f"{one}.{figure}" for one, of in data["robots"].items() for figure in of.get("figures", {})]
            raise JumpcadError(f"--figure {key}: no robot has this figure{did_you_mean(key, known)}")
        published = figures[name]["value"]
        if not 1.0 / MOST_FACTOR <= value / published <= MOST_FACTOR or (name.endswith("_deg") and value >= 90.0):
            raise JumpcadError(f"--figure {key}={value:g}: the file has {published:g}: give it in the unit of its name")
        figures[name] = figures[name] | {"value": float(value), "confidence": "entered"}
        if name == "spring_energy_j" and "efficiency" in figures:
            speed, mass_g = (figures[one]["value"] for one in ("takeoff_speed_m_s", "mass_g"))
            efficiency = 0.5 * mass_g / 1000.0 * speed**2 / value
            figures["efficiency"] = figures["efficiency"] | {"value": efficiency, "confidence": "entered"}
    try:
        return Facts.from_data(data, str(path), text)
    except JumpcadError as error:
        if entered:
            raise JumpcadError(str(error).partition(": ")[2]) from None
        raise


def efficiency_band() -> list[tuple[str, float, bool]]:
    """Return what robots that others measured reached of `Jump.kinetic_ratio`: name, value, whether it is sure."""
    robots = [robot for robot in load_facts().robots.values() if "efficiency" in robot.figures]
    band = [(one.name, one.value("efficiency"), one.sure("efficiency")) for one in robots]
    return sorted(band, key=lambda one: one[1])
