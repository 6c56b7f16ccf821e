"""Measurements of one robot that contradict each other, whatever the model says."""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.calibration.measurements import DISTANCES, Jumps, Measurements

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
    """Yield what contradicts what, and what to do.

    Parameters
    ----------
    measured
        The measurements of one robot.
    standing_m
        Height of its centre of mass above the floor, standing with loaded springs.
    weight_n
        Its weight, on the scale or by the model.
    """
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
