"""`--to X,Y` and `--course FILE`: where a robot that steers is sent, and what becomes of it."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import jumpcad
from jumpcad.cli.output import answer, print_text, status
from jumpcad.cli.subjects import File, Text, option
from jumpcad.errors import JumpcadError

if TYPE_CHECKING:
    from jumpcad.landing.course import Course, Trip
    from jumpcad.landing.series import Series

TO = "Steer to a point, x ahead and y to the left (m); one number: so far, in any direction (MuJoCo)."
COURSE = "Steer along the points of a TOML file, over bars and steps (MuJoCo)."
ToOption = Annotated[Text, option(TO, "X,Y", "--to")]
CourseOption = Annotated[File, option(COURSE, None, "--course")]


def target_of(to: str | None, course: Path | None) -> "float | tuple[float, ...] | Course | None":
    """Return where to go, by either option; None without one."""
    from jumpcad.landing.course import FARTHEST_M, Course

    if course is not None:
        if to is not None:
            raise JumpcadError(f"--to {to} and --course {course} exclude each other: leave one out")
        return Course.from_toml(course)
    if to is None:
        return None
    try:
        found = tuple(float(one) for one in to.split(","))
    except ValueError:
        found = ()
    far_m = math.hypot(*found)
    if len(found) > 2 or found == (-far_m,) or not 0.0 < far_m <= FARTHEST_M:
        raise JumpcadError(
            f"--to {to}: must be x and y in metres, as 3,0, or a distance above 0, as 3; at most {FARTHEST_M:g}"
        )
    return found if len(found) == 2 else found[0]


def recorded(robot: "jumpcad.Robot", row: int | None, to: str | None, course: Path | None) -> "Series | Trip | None":
    """Return so many jumps in a row, or one try of a course, with their motion; None if neither is asked for."""
    target = target_of(to, course)
    if target is None:
        return jumpcad.jumps(robot, row, record=True) if row else None
    if row:
        raise JumpcadError(f"--jumps {row} excludes --to and --course: leave one out")
    return jumpcad.go(robot, target, 1, record=True).trips[0]


def tries_of(
    robot: "jumpcad.Robot", to: "float | tuple[float, ...] | Course", tries: int, seed: int,
    settings: "jumpcad.Settings", noise_deg: float, record: bool,
) -> "tuple[list[Trip], bool]":  # fmt: skip
    """Return the tries, and whether all were made: an interrupt ends them."""
    from jumpcad.landing.course import trips

    found = list[Any]()
    with status(f"{robot.name}: trying {tries} times …") as tell:
        try:
            for one in trips(robot, to, tries, seed, settings, noise_deg, record):
                found.append(one)
                tell(f"{robot.name}: tried {len(found)} of {tries} times, "
                     f"{sum(trip.arrived for trip in found)} arrived …")  # fmt: skip
        except KeyboardInterrupt:
            return found, False
    return found, True


def print_going(
    to: "float | tuple[float, ...] | Course", found: "list[Trip]", heading: Mapping[str, Any], noise_deg: float,
    as_json: bool,
) -> None:  # fmt: skip
    """Print the rows of the first try, and what became of all."""
    from jumpcad.landing.course import Going, course_of

    going = Going(course_of(to), tuple(found))
    words = {"going": going, "first": found[0], "noise": noise_deg, "anywhere": isinstance(to, float)}
    answer(as_json, {**heading, "going": going.to_dict()}, print_text, "going", design=heading["design"], **words)
