"""The lightest cage that rights a robot: its sizes are searched by stable poses, then it is dropped and lands."""

import math
from collections.abc import Callable

from jumpcad.building import built_and_checked
from jumpcad.checks.springs_loaded import RIGHTED
from jumpcad.collision.hulls import least_share_on_feet, share_on_feet
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.findings import choose, errors, higher
from jumpcad.landing.landing import Landings, land
from jumpcad.robot.cage.place import Cage, plate_ends_mm
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop, varied

ROD = "glass-1.5"
"""Where the workshop names none."""
SHARE = 0.95
"""Least share of stable poses on the feet; judgement: hoops reach 0.97, and what counts is simulated."""
STEPS = {"lean_deg": 6.0, "arc_deg": 12.0, "rear_behind_mm": 10.0, "front_ahead_mm": 10.0, "rear_radius_mm": 16.0,
         "front_radius_mm": 16.0}  # fmt: skip
"""First steps of the sizes; they are halved `HALVINGS` times."""
HALVINGS, MOST = 2, 80
"""And at most so many robots are built, with and without a bow each."""
TRIES, DROPS, LANDINGS = 50, 0.98, 0.95
"""Simulated drops and own landings, and the shares of them after which it must stand."""
SURER = 0.01
"""By how much the share of stable poses must be larger where a lighter cage has fallen over in simulation."""

Cost = tuple[float, float]
"""What a cage lacks of what is asked, 0 if nothing, and the robot's mass (kg)."""


def lightest_cage(design: Design, workshop: Workshop, tries: int = TRIES) -> tuple[Robot, Landings]:
    """Return a robot with the lightest cage of the workshop's rod that rights it, and its simulated landings and drops.

    Two hoops with or without a bow: a pattern search from the sizes that the layout finds. Landings and drops have the
    last word, in the order of mass. The robot's workshop gives all sizes.
    """
    found: list[tuple[Cost, Workshop]] = []
    for bow in (False, True):
        start = varied(workshop, {"cage.rod": workshop.cage.rod or ROD, "cage.bow": bow})
        robot, _ = built_and_checked(design, start, "")
        found += searched(_sizes(robot), lambda sizes, start=start: _judged(design, start, sizes))  # type: ignore[misc]
    found.sort(key=lambda one: one[0])
    (lacking, _), best = found[0]
    robot, findings = built_and_checked(design, best, "")
    failing = [f", and it fails {one.name}" for one in errors(findings) if one.name.startswith("cage")]
    why = f"feet in {100.0 * share_on_feet(robot):.0f} % of its stable poses, {100.0 * SHARE:.0f} % are needed"
    surest = 0.0
    for _, shop in (one for one in found if not one[0][0]):
        robot, _ = built_and_checked(design, shop, "")
        if (least := least_share_on_feet(robot)) < surest:
            continue  # one that is as sure has fallen over
        landed, surest = land(robot, tries), least + SURER
        if landed.drops_righted >= DROPS and landed.share_righted >= LANDINGS:
            return robot, landed
        why = f"feet after {100.0 * landed.drops_righted:.0f} % of drops, {100.0 * DROPS:.0f} % are needed"
    raise CannotBuildError(
        f"of {len(found)} cages of {best.cage.rod} none rights it: with the best it comes onto its {why}"
        f"{''.join(failing)}",
        "cage_rights", -lacking,
        ways=higher("compression_ratio", note="it crouches lower") + choose("another", "cage.rod"),
    )  # fmt: skip


def searched(
    at: dict[str, float], judged: Callable[[dict[str, float]], tuple[Cost, Workshop]]
) -> list[tuple[Cost, Workshop]]:
    """Return all that a pattern search judged: it moves one value after the other, either way, then by half steps."""
    found = {tuple(at.values()): judged(at)}
    best, scale = found[tuple(at.values())][0], 1.0
    while scale >= 0.5**HALVINGS:
        before = best
        for key, step in STEPS.items():
            for sign in (-1.0, 1.0):
                there = at | {key: round(at[key] + sign * scale * step, 1)}
                if (values := tuple(there.values())) not in found:
                    if len(found) >= MOST:
                        return list(found.values())
                    found[values] = judged(there)
                if found[values][0] < best:
                    at, best = there, found[values][0]
                    break
        scale = scale if best < before else scale / 2.0
    return list(found.values())


def _judged(design: Design, workshop: Workshop, sizes: dict[str, float]) -> tuple[Cost, Workshop]:
    """Return what a cage of some sizes lacks, the robot's mass with it, and its workshop."""
    try:
        shop = varied(workshop, {f"cage.{key}": value for key, value in sizes.items()})
        robot, findings = built_and_checked(design, shop, "")
    except JumpcadError:
        return (math.inf, math.inf), workshop
    failing = sum((one.use or 2.0) - 1.0 for one in errors(findings) if one.name.startswith("cage"))
    poses = max(0.0, SHARE - share_on_feet(robot)) + max(0.0, RIGHTED / 100.0 - least_share_on_feet(robot))
    return (round(failing + poses, 4), robot.mass_kg), shop


def _sizes(robot: Robot) -> dict[str, float]:
    """Return the sizes of a robot's cage by the workshop's keys."""
    cage = robot.layout.of(Cage)
    assert cage is not None
    (rear, front), ends = cage.bars, plate_ends_mm(robot.layout)
    return {
        "lean_deg": round(math.degrees(math.atan2(front.up[0], front.up[1])), 1),
        "arc_deg": round(math.degrees(cage.arcs[0].angle_rad), 1),
        "rear_behind_mm": round(ends[0] - float(rear.place_mm[0]), 1),
        "front_ahead_mm": round(float(front.place_mm[0]) - ends[1], 1),
        "rear_radius_mm": cage.arcs[0].radius_mm,
        "front_radius_mm": cage.arcs[1].radius_mm,
    }
