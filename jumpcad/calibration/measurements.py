"""What was measured on one built robot, as a TOML file: masses, spring rate, floor, jumps with what they are of.

Every length says what was measured, because ways of measuring differ by more than robots do; `unknown` is allowed and
keeps all possibilities, a missing key is an error. Contradictory values are rejected, with what to add or change.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from jumpcad.arguments import check_arguments
from jumpcad.files import Contradiction, Record, TomlTable, find_template
from jumpcad.files.records import Name, Text

Grams = Annotated[float, Field(gt=0, le=1e5)]
Lengths = Annotated[tuple[Annotated[float, Field(gt=0, le=1e6)], ...], Field(strict=False, max_length=1000)]
Joules = Annotated[tuple[Annotated[float, Field(gt=0, le=1e6)], ...], Field(strict=False, max_length=1000)]
Degrees = Annotated[tuple[Annotated[float, Field(gt=0, lt=90)], ...], Field(strict=False, max_length=1000)]
Forces = Annotated[tuple[Annotated[float, Field(gt=0, le=1e4)], ...], Field(strict=False, max_length=1000)]
DistanceOf = Literal["centre-of-mass", "first-touchdown", "resting-place", "unknown"]
HeightOf = Literal["rise", "absolute", "unknown"]
DISTANCES: tuple[DistanceOf, ...] = ("centre-of-mass", "first-touchdown", "resting-place")
HEIGHTS: tuple[HeightOf, ...] = ("rise", "absolute")


class Weighed(TomlTable):
    """Masses on a scale (g): the whole robot, ready to jump, its error, and single printed parts by their names."""

    robot_g: Grams | None = None
    robot_error_g: Grams | None = None
    parts_g: dict[Name, Grams] = Field(default_factory=dict)


class SpringRate(TomlTable):
    """The measured rate of one spring or of both together. Robots with the same `pair` have the same springs."""

    pair: Name | None = None
    rate_nmm_per_deg: Annotated[float, Field(gt=0, le=1e6)] | None = None
    springs: Literal[1, 2] | None = None
    error_share: Annotated[float, Field(ge=1e-3, le=0.5)] = 0.03

    @property
    def both_nmm_per_deg(self) -> float | None:
        """Rate of both springs together."""
        return None if self.rate_nmm_per_deg is None else self.rate_nmm_per_deg * (2.0 if self.springs == 1 else 1.0)


class FloorTest(TomlTable):
    """Horizontal pulls (N), or slopes (°), at which the standing robot began to slip under its own weight."""

    pull_n: Forces = ()
    slope_deg: Degrees = ()


class Jumps(TomlTable):
    """Jumps from one floor: distances, heights, what was measured, and the battery's energy for each jump.

    `jumps` is their number where the lists hold means; else every value is one jump.
    """

    distance_mm: Lengths = ()
    distance_of: DistanceOf | None = None
    height_mm: Lengths = ()
    height_of: HeightOf | None = None
    battery_j: Joules = ()
    jumps: Annotated[int, Field(ge=1, le=1000)] | None = None


@dataclass(frozen=True)
class Length:
    """A `distance` or a `height` (mm), of what is measured (`DistanceOf`, `HeightOf`), as the mean of `count` jumps."""

    what: str
    of: str
    mean_mm: float
    count: int


class Video(TomlTable):
    """A CSV file with points of one flight, t (s), x and z (m), after take-off and before touchdown; which point.

    `slow_motion` divides t: the camera's frames a second over those at which the video tool takes the film to run.
    """

    points: Text
    point: Literal["centre-of-mass", "body"]
    slow_motion: Annotated[float, Field(ge=1e-3, le=1e4)] = 1.0


class Measurements(Record):
    """Everything measured on one robot; paths are relative to its file.

    `release` is `dog` for a robot as jumpcad builds it, `fixed` where the cam is fixed to its gear or shaft. `unknown`
    names what was not measured, in words.
    """

    design: Text
    workshop: Text = "default"
    source: Text
    release: Literal["dog", "fixed", "unknown"]
    unknown: Annotated[tuple[Text, ...], Field(strict=False)] = ()
    mass: Weighed = Weighed()
    spring: SpringRate = SpringRate()
    floor: FloorTest = FloorTest()
    jumps: Annotated[tuple[Jumps, ...], Field(strict=False)] = ()
    videos: Annotated[tuple[Video, ...], Field(strict=False)] = ()

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield measurements that do not say how they were made, and values without the one that they belong to."""
        if self.spring.rate_nmm_per_deg is not None and self.spring.springs is None:
            reason = "of one spring or of both? say springs = 1 or springs = 2"
            yield ("spring", "rate_nmm_per_deg"), self.spring.rate_nmm_per_deg, reason
        robot_g, error_g = self.mass.robot_g, self.mass.robot_error_g
        if error_g is not None and robot_g is None:
            yield ("mass", "robot_error_g"), error_g, "is the error of nothing: give robot_g too"
        if error_g is not None and robot_g is not None and error_g > robot_g / 2.0:
            reason = f"is the error of robot_g, in grams: must be at most a half of it, {robot_g / 2.0:g}"
            yield ("mass", "robot_error_g"), error_g, reason
        for series in self.jumps:
            yield from _unsaid(series)


def lengths(jumps: Sequence[Jumps]) -> list[Length]:
    """Return the mean of each kind of length over all series: they have the model's error in common.

    Each series of an `unknown` length stays apart, since it may be of another kind.
    """
    found: dict[tuple[str, str, int], list[tuple[float, int]]] = {}
    for number, series in enumerate(jumps):
        for what in ("distance", "height"):
            of, values = getattr(series, f"{what}_of"), getattr(series, f"{what}_mm")
            if values and of is not None:
                kind = what, of, number if of == "unknown" else 0
                mean = sum(map(math.log, values)) / len(values)
                found.setdefault(kind, []).append((mean, series.jumps or len(values)))
    return [
        Length(what, of, math.exp(sum(mean * count for mean, count in alike) / number), number)
        for (what, of, _), alike in found.items()
        if (number := sum(count for _, count in alike))
    ]


def _unsaid(series: Jumps) -> Iterator[Contradiction]:
    """Yield what is wrong with one series of jumps."""
    for what, kinds in (("distance", DISTANCES), ("height", HEIGHTS)):
        values, of = getattr(series, f"{what}_mm"), getattr(series, f"{what}_of")
        if values and of is None:
            names = ", ".join(f'"{kind}"' for kind in kinds)
            reason = f'what was measured? say {what}_of = {names} or "unknown"'
            yield ("jumps", f"{what}_mm"), values[0], reason
        if of is not None and not values:
            yield ("jumps", f"{what}_of"), of, f"is of nothing: give {what}_mm too"
    if not (series.distance_mm or series.height_mm or series.battery_j):
        yield ("jumps",), "nothing", "holds no value: give distance_mm, height_mm or battery_j"
    most = max(map(len, (series.distance_mm, series.height_mm, series.battery_j)))
    if series.jumps is not None and series.jumps < most:
        yield ("jumps", "jumps"), series.jumps, f"must be at least {most}, the values given"


@check_arguments
def load_measurements(name_or_path: str | Path) -> tuple[Measurements, Path]:
    """Return the measurements of a template (`kenan-1.0`, `kenan-2.0`) or of a TOML file, and where they are."""
    path = find_template("measurements", name_or_path)
    return Measurements.from_toml(path), path


LEAST_FRICTION, MOST_FRICTION = 0.1, 2.0
"""Of a floor test: below ice and above any rubber the unit is wrong."""
PULLED = "pull the standing robot by its foot, along the floor, and give newtons (100 gf are 0.98 N)"
TILTED = "give the slope's angle in degrees, at which the robot begins to slip on its feet"
FLOOR_FACTOR = 2.0
"""By which tests of one floor may differ; judgement."""
SERIES_FACTOR = 3.0
"""By which distances of one robot, measured in one way, may differ, where single jumps scatter by 8 %; judgement."""
BACKWARD_SHARE = 0.75
"""Least resting place over first touchdown: a robot goes on after landing, but both scatter; judgement."""
HEIGHTS_M = 0.045
"""By which a rise may be too large for an absolute height: three standard deviations of a height."""


def contradictions(measured: Measurements, standing_m: float, weight_n: float) -> Iterator[str]:
    """Yield what contradicts what, and what to do; `standing_m` is the loaded robot's height of the centre of mass."""
    yield from _of_floor(measured, weight_n)
    yield from _of_distances(measured.jumps)
    yield from _of_heights(measured.jumps, standing_m)


def _of_floor(measured: Measurements, weight_n: float) -> Iterator[str]:
    """Yield floor tests that are of no floor, or of two."""
    tests = [(pull / weight_n, f"floor.pull_n = {pull:g}", PULLED) for pull in measured.floor.pull_n]
    tests += [
        (math.tan(math.radians(slope)), f"floor.slope_deg = {slope:g}", TILTED) for slope in measured.floor.slope_deg
    ]
    for friction, test, how in tests:
        if not LEAST_FRICTION <= friction <= MOST_FRICTION:
            yield f"{test}: is a friction of {friction:.3g}: {how}"
    if len(tests) > 1:
        (low, one, _), (high, other, _) = min(tests), max(tests)
        if high > FLOOR_FACTOR * low:
            yield (
                f"{one} is a friction of {low:.2f}, and {other} one of {high:.2f}: one floor has one friction: test "
                "both again, on the floor of the jumps"
            )


def _of_distances(series: tuple[Jumps, ...]) -> Iterator[str]:
    """Yield distances that one robot cannot have."""
    means: dict[str, float] = {}
    for kind in DISTANCES:
        values = [value for one in series if one.distance_of == kind for value in one.distance_mm]
        if not values:
            continue
        means[kind] = float(np.mean(values))
        if max(values) > SERIES_FACTOR * min(values):
            yield (
                f"jumps.distance_mm = {min(values):g} and {max(values):g}, both {kind}: one robot does not jump "
                f"{max(values) / min(values):.1f} times as far: leave failed jumps out, or give another floor or "
                "robot its own file"
            )
    touchdown, rest = (means.get(kind) for kind in ("first-touchdown", "resting-place"))
    if touchdown is not None and rest is not None and rest < BACKWARD_SHARE * touchdown:
        yield (
            f"jumps.distance_mm: the resting place, {rest:g}, lies before the first touchdown, {touchdown:g}: is one "
            "the other? measure both from the same mark, the centre of mass before the jump"
        )


def _of_heights(series: tuple[Jumps, ...], standing_m: float) -> Iterator[str]:
    """Yield an absolute height below that from which a robot jumps, and a rise that is too large for one."""
    rise, absolute = (
        [value / 1000.0 for one in series if one.height_of == kind for value in one.height_mm]
        for kind in ("rise", "absolute")
    )
    if absolute and np.mean(absolute) <= standing_m:
        yield (
            f"jumps.height_mm: an absolute height of {1000.0 * np.mean(absolute):.4g} is not above the "
            f"{1000.0 * standing_m:.0f} mm of the centre of mass before the jump: is it a rise?"
        )
    elif rise and absolute and np.mean(rise) + standing_m > np.mean(absolute) + HEIGHTS_M:
        yield (
            f"jumps.height_mm: a rise of {1000.0 * np.mean(rise):g} is {1000.0 * (np.mean(rise) + standing_m):.0f} mm "
            f"above the floor, and the absolute height is {1000.0 * np.mean(absolute):g}: is one the other?"
        )
