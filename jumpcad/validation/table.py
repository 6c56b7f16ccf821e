"""One table: what was measured on each robot, beside an interval that samples what is unknown of it."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from jumpcad.calibration.likelihood import CalibrationModel, predict
from jumpcad.calibration.subject import load_subject
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.simulation.mechanics import Ballistics, ballistics, drag_per_m
from jumpcad.simulation.published_robots import Figure, RobotFacts, load_facts
from jumpcad.transforms import Array
from jumpcad.validation.family import Member, family, jump_of

TIERS = "mechanism", "flight", "whole robot", "bound", "efficiency", "left out"
"""What is compared; never mixed."""
QUANTILES = (0.05, 0.5, 0.95)
DRAWS, KENAN_DRAWS = 64, 4000
"""Flights of each robot; draws from the priors of a whole robot."""
SPEED_SHARE, ANGLE_DEG = 0.02, 3.0
"""Half widths of what a published speed and a published angle may be off by: judgement."""
DRAG_SHARE = 0.25, 1.2
"""Drag area over the square of a robot's size: legs and gaps to a bluff body."""
UNKNOWN_DRAG_M2 = 0.0, 50e-4
"""Drag areas of a robot of unknown size."""
TOLERANCE = {
    "takeoff_speed_m_s": 0.05, "efficiency": 0.08, "height_m": 0.10, "jump_s": 0.08, "distance_m": 0.05, "flea": 0.30,
    "whole robot": 0.12,
}  # fmt: skip
"""By which a figure may lie outside its interval: what published figures of one robot differ by among themselves."""


Row = dict[str, Any]
"""One figure: measured, and quantiles (5, 50, 95 %) of what is computed; `verdict` says how they compare.

It `agrees` or `differs`, by `tolerance` outside the interval; it lies `below the bound` or above; the robots were
`chosen by` it, so it is no test; it is `not judged` where it, or what the interval is computed from, is only
remembered; it is `measured only` where nothing is computed.
"""
Table = Callable[[RobotFacts, np.random.Generator], Iterable[Row]]


def validate(entered: Mapping[str, float] | None = None, seed: int = 0) -> list[dict[str, Any]]:
    """Return every robot with its tier and figures, as plain data, with a user's figures by `ROBOT.FIGURE`."""
    facts = load_facts(entered)
    epfl = facts.robots["kovac-2008"]
    names = "mass_g", "spring_energy_j", "takeoff_angle_deg", "pushoff_ms"
    figures: dict[str, Any] = {name: epfl.value(name) for name in names}
    members = family(**figures, seed=seed)
    tables: list[tuple[str, str, Table]] = [
        ("kovac-2008", "mechanism", lambda robot, _: _mechanism(robot, members)),
        ("kovac-2008", "flight", _through_air),
        *((key, "flight", _range_from_height) for key in ("msu-2013", "seu-2012")),
        ("flea-2013", "flight", _flea),
        ("strider-2015", "flight", _strider),
        *((key, "whole robot", partial(_whole, key)) for key in ("kenan-1.0", "kenan-2.0")),
        *((key, "bound", lambda robot, _: _bound(robot, epfl, members)) for key in ("kovac-2009", "kovac-2010")),
        *((key, "efficiency", _efficiency) for key in ("flea-2013", "clover-2022")),
        *((key, "left out", lambda *_: ()) for key, robot in facts.robots.items() if robot.reason),
    ]
    found: list[dict[str, Any]] = []
    for key, tier, table in tables:
        robot = facts.robots[key]
        rows = table(robot, np.random.default_rng([seed, len(found)]))
        found.append(
            {"key": key, "name": robot.name, "tier": tier, "leg": robot.leg, "unknown": list(robot.unknown),
             "reason": robot.reason or robot.differs, "figures": list(rows)}
        )  # fmt: skip
    return found


def thrown(speed_m_s: float, angle_deg: float, drag_m2: float, mass_g: float) -> Ballistics:
    """Return the flight of a body that is thrown from the ground; its `deepest_s` is the time in the air."""
    angle = np.radians(angle_deg)
    velocity = speed_m_s * np.array([np.cos(angle), 0.0, np.sin(angle)])
    per_m = drag_per_m(drag_m2, mass_g / 1000.0)
    return ballistics(np.zeros(3), np.zeros(3), velocity, GRAVITY_M_S2, per_m)


def _row(robot: RobotFacts, name: str, values: npt.ArrayLike, how: str, of: tuple[str, ...] = (),
         kind: str = "") -> Row:  # fmt: skip
    """Return the row of a figure, computed (n,) from the figures `of` the robot."""
    row = _compared(name, robot.figures[name], values, TOLERANCE[kind or name], how)
    return row if robot.sure(name, *of) else row | {"verdict": "not judged"}


def _compared(name: str, figure: Figure, values: npt.ArrayLike, tolerance: float | None, how: str) -> Row:
    """Return the row of a figure beside computed values (n,), which may be none where entered figures disagree."""
    row: Row = {"name": name, "measured": figure.value, "confidence": figure.confidence, "source": figure.source}
    row |= dict.fromkeys(("low", "median", "high", "tolerance")) | {"verdict": "measured only", "how": how}
    if not np.size(values):
        return row
    low, median, high = np.quantile(np.asarray(values, dtype=float), QUANTILES).tolist()
    verdict = "chosen by"
    if tolerance is not None:
        within = low * (1.0 - tolerance) <= figure.value <= high * (1.0 + tolerance)
        verdict = "agrees" if within else "differs"
    return row | {"low": low, "median": median, "high": high, "tolerance": tolerance, "verdict": verdict}


def _mechanism(robot: RobotFacts, members: list[Member]) -> Iterator[Row]:
    """Yield what springs and leg do."""
    jumps, how, energy = [one.jump for one in members if one.jump], "family of geometries", ("spring_energy_j",)
    speeds, angles, times = (
        np.array([getattr(jump, name) for jump in jumps], dtype=float)
        for name in ("takeoff_speed_m_s", "takeoff_angle_deg", "takeoff_time_s")
    )
    yield _row(robot, "takeoff_speed_m_s", speeds, how, energy)
    yield _row(robot, "efficiency", [one.efficiency for one in members], how, energy)
    yield _compared("takeoff_angle_deg", robot.figures["takeoff_angle_deg"], angles, None, how)
    yield _compared("pushoff_ms", robot.figures["pushoff_ms"], 1000.0 * times, None, how)


def _through_air(robot: RobotFacts, generator: np.random.Generator) -> Iterator[Row]:
    """Yield height and time in the air, from speed and angle."""
    height, mass_g = robot.value("height_m"), robot.value("mass_g")
    rises, times = [], []
    for speed, angle, drag_m2 in _flights(robot, generator, _outline(robot)):
        rises.append(thrown(speed, angle, drag_m2, mass_g).rise_m)
        if thrown(speed, angle, 0.0, mass_g).rise_m > height:
            area = brentq(lambda area: thrown(speed, angle, area, mass_g).rise_m - height, 0.0, 1.0, xtol=1e-6)  # noqa: B023
            times.append(thrown(speed, angle, area, mass_g).deepest_s)
    of = "takeoff_speed_m_s", "takeoff_angle_deg"
    yield _row(robot, "height_m", rises, "flight from speed and angle, drag area from its size", (*of, "size_mm"))
    yield _row(robot, "jump_s", times, "flight with the drag area that its height gives", (*of, "height_m"))


def _bound(robot: RobotFacts, epfl: RobotFacts, members: list[Member]) -> Iterator[Row]:
    """Yield the height, bounded by that without cage and drag."""
    more_g = robot.value("mass_g") - epfl.value("mass_g")
    jumps = [jump_of(one.values, epfl.value("mass_g"), epfl.value("spring_energy_j"), more_g) for one in members]
    rises = [jump.com_rise_m for jump in jumps if jump and jump.com_rise_m is not None]
    row = _compared("height_m", robot.figures["height_m"], rises, None, "robots of 2008, heavier, no cage, no drag")
    yield _bounded(row) if epfl.sure("spring_energy_j") and row["high"] else row | {"verdict": "not judged"}


def _bounded(row: Row) -> Row:
    return row | {"verdict": "below the bound" if row["measured"] <= (row["high"] or 0.0) else "above the bound"}


def _range_from_height(robot: RobotFacts, generator: np.random.Generator) -> Iterator[Row]:
    """Yield the distance that height and angle give."""
    mass_g, height = robot.figures.get("mass_g"), robot.value("height_m")
    grams, ranges = mass_g.value if mass_g else 25.0, []
    for _, angle, drag_m2 in _flights(robot, generator, UNKNOWN_DRAG_M2):
        speed = brentq(lambda v: thrown(v, angle, drag_m2, grams).rise_m - height, 0.5, 40.0, xtol=1e-4)  # noqa: B023
        ranges.append(thrown(speed, angle, drag_m2, grams).range_m)
    yield _row(robot, "distance_m", ranges, "flight from height and angle", ("height_m", "takeoff_angle_deg"))


def _flea(robot: RobotFacts, generator: np.random.Generator) -> Iterator[Row]:
    """Yield the height that the speed gives in air."""
    rises = [
        thrown(speed, generator.uniform(75.0, 90.0), drag_m2, robot.value("mass_g")).rise_m
        for speed, _, drag_m2 in _flights(robot, generator, _outline(robot))
    ]
    of = "takeoff_speed_m_s", "size_mm", "mass_g"
    yield _row(robot, "height_m", rises, "flight from the speed, drag area from its size", of, "flea")


def _strider(robot: RobotFacts, generator: np.random.Generator) -> Iterator[Row]:
    """Yield the height that the speed gives without air, which bounds it: its drag area is unknown."""
    speeds = robot.value("takeoff_speed_m_s") + generator.uniform(-0.05, 0.05, DRAWS)  # as published, 1.6
    rises = [thrown(speed, generator.uniform(80.0, 90.0), 0.0, 1.0).rise_m for speed in speeds]
    yield _bounded(_compared("height_m", robot.figures["height_m"], rises, None, "flight from the speed, without air"))


def _whole(name: str, _: RobotFacts, generator: np.random.Generator) -> Iterator[Row]:
    """Yield distance and height of a printed robot under every reading, over the priors of a calibration."""
    subject = load_subject(name)
    model = CalibrationModel([subject])
    values = model.values(generator.standard_normal((KENAN_DRAWS, len(model.parameters))))
    predicted = predict(subject, values)
    jumps = np.isfinite(predicted.jump.range_m)
    how = f"printed robot, of unknown mass, springs, floor, release; the {jumps.mean():.0%} of draws that jump"
    for datum in model.data:
        for reading in datum.readings if datum.what != "battery" else ():
            figure = Figure(value=round(datum.value, 9), confidence="read", source="study")
            found = predicted.of(datum.what, reading)[jumps]
            yield _compared(f"{datum.what}_m as {reading}", figure, found, TOLERANCE["whole robot"], how)


def _efficiency(robot: RobotFacts, _: np.random.Generator) -> list[Row]:
    """Return the measured efficiency, beside which nothing is computed."""
    return [_compared("efficiency", robot.figures["efficiency"], (), None, "")]


def _flights(
    robot: RobotFacts, generator: np.random.Generator, drag_m2: tuple[float, float]
) -> Iterator[tuple[float, float, float]]:
    """Yield speeds, angles and drag areas that the published ones may stand for; 0 for one that is not published."""
    speed, angle = (robot.figures.get(name) for name in ("takeoff_speed_m_s", "takeoff_angle_deg"))
    for _ in range(DRAWS):
        shares: Array = generator.uniform(-1.0, 1.0, 2)
        yield (
            speed.value * (1.0 + SPEED_SHARE * shares[0]) if speed else 0.0,
            angle.value + ANGLE_DEG * shares[1] if angle else 0.0,
            generator.uniform(*drag_m2),
        )


def _outline(robot: RobotFacts) -> tuple[float, float]:
    """Return least and largest drag area of a robot, from its size."""
    square_m2 = (robot.value("size_mm") / 1000.0) ** 2
    return DRAG_SHARE[0] * square_m2, DRAG_SHARE[1] * square_m2
