"""To points on the floor: the robot winds, turns by its steering wheel, jumps, and does so again until it is there."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from jumpcad.arguments import check_arguments
from jumpcad.errors import JumpcadError
from jumpcad.files import Record
from jumpcad.landing.arena import Arena
from jumpcad.landing.landing import scattered_floor
from jumpcad.landing.obstacles import Obstacle, Place
from jumpcad.landing.series import Hop, Recorder, Row, hop
from jumpcad.robot.electronics.limits import jumps_per_charge
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.limits import TURN_DEG, steers
from jumpcad.robot.steering.place import Steering
from jumpcad.settings import Settings
from jumpcad.simulation.jump import Trajectory
from jumpcad.transforms import Array, pose_about_z

FARTHEST_M = 1000.0
"""Of a point."""
WITHIN_M = 0.35
"""A robot is at a point from this distance on: half a jump, which has but one length."""
HEADING_NOISE_DEG = 3.0
"""Standard deviation with which its heading is known before each turn; judgement: a camera above it."""
STRAIGHT_DEG = 2.0
"""A turn smaller than this is not made."""
PATIENCE, LEAST_TRIES = 3, 6
"""A try is given up after so many times the jumps of the straight way, and so many more."""


class Course(Record):
    """Points to go to one after another, from the origin, where the robot stands and looks along x; what is between.

    `points_m` are x and y (m), left positive; a point is reached `within_m`.
    """

    points_m: Annotated[tuple[Place, ...], Field(strict=False, min_length=1, max_length=1000)]
    within_m: Annotated[float, Field(ge=0.05, le=10)] = WITHIN_M
    obstacles: Annotated[tuple[Obstacle, ...], Field(strict=False, max_length=100)] = ()

    @property
    def way_m(self) -> float:
        """Length of the way from point to point."""
        return float(np.linalg.norm(np.diff([(0.0, 0.0), *self.points_m], axis=0), axis=1).sum())


@dataclass(frozen=True)
class Move(Hop):
    """One turn and jump towards a point of the course, which is counted from 1.

    `turn_deg` is by how far the wheel turned it (left positive), `place_m` where its centre of mass came to rest,
    `left_m` the distance to the point from there, `energy_j` that of motors and boards, `struck` the obstacles that it
    touched, counted from 1.
    """

    point: int
    turn_deg: float
    place_m: tuple[float, float]
    left_m: float
    energy_j: float
    struck: tuple[int, ...]


@dataclass(frozen=True)
class Trip(Row):
    """One try: its moves, how many points it reached, whether these are all; its motion if it was recorded."""

    hops: tuple[Move, ...]
    reached: int
    arrived: bool
    trajectory: Trajectory | None = None
    phases: tuple[str, ...] = ()

    @property
    def time_s(self) -> float:
        return sum(one.time_s for one in self.hops)

    @property
    def energy_j(self) -> float:
        """Electrical energy of all moves."""
        return sum(one.energy_j for one in self.hops)


@dataclass(frozen=True)
class Going:
    """Tries of a course. Medians are of the tries that arrived, None if none did."""

    course: Course
    trips: tuple[Trip, ...]

    @property
    def arrived(self) -> int:
        return sum(one.arrived for one in self.trips)

    @property
    def share_arrived(self) -> float:
        return self.arrived / len(self.trips)

    def quantiles(self, name: str) -> tuple[float, float, float] | None:
        """Return least, median and largest `jumps`, `time_s` or `energy_j` of the tries that arrived."""
        found = [len(one.hops) if name == "jumps" else getattr(one, name) for one in self.trips if one.arrived]
        least, middle, most = np.quantile(found, [0.0, 0.5, 1.0]).tolist() if found else (0.0, 0.0, 0.0)
        return (least, middle, most) if found else None

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        figures = {name: self.quantiles(name) for name in ("jumps", "time_s", "energy_j")}
        medians = {f"median_{name}": found and found[1] for name, found in figures.items()}
        tries = [
            {"arrived": one.arrived, "reached": one.reached, "time_s": one.time_s, "energy_j": one.energy_j,
             "jumps": [asdict(move) for move in one.hops]}
            for one in self.trips
        ]  # fmt: skip
        return {"share_arrived": self.share_arrived, **medians, **self.course.model_dump(), "tries": tries}


@check_arguments
def go(
    robot: Robot, to: float | Sequence[float] | Course = (3.0, 0.0), tries: int = 20, seed: int = 0,
    settings: Settings | None = None, heading_noise_deg: float = HEADING_NOISE_DEG, record: bool = False,
) -> Going:  # fmt: skip
    """Let a robot that steers go to a point or along a course a number of times, each on another floor.

    Parameters
    ----------
    robot
        A printed robot with steering.
    to
        The point (x ahead of it, y to its left, m); or a distance, in another direction each time; or a course.
    tries
        How often, from 1 on.
    seed
        Of floors, scatter and directions. A try does not depend on how many there are.
    settings
        Of which gravity and friction hold; None: the defaults.
    heading_noise_deg
        Standard deviation with which its heading is known.
    record
        Whether to record the motion of the first try.

    Raises
    ------
    CannotBuildError
        If the robot does not leave the floor.
    JumpcadError
        If it has no steering, if the battery does not take it there, if an obstacle stands where it does, or if MuJoCo
        is not installed.
    """
    return Going(course_of(to), tuple(trips(robot, to, tries, seed, settings, heading_noise_deg, record)))


def course_of(to: float | Sequence[float] | Course) -> Course:
    """Return the course to a point, or straight ahead by a distance."""
    if isinstance(to, Course):
        return to
    return Course(points_m=(tuple(to) if isinstance(to, Sequence) else (to, 0.0),))


def trips(
    robot: Robot, to: float | Sequence[float] | Course, tries: int, seed: int = 0, settings: Settings | None = None,
    heading_noise_deg: float = HEADING_NOISE_DEG, record: bool = False,
) -> Iterator[Trip]:  # fmt: skip
    """Yield the tries of `go` one by one."""
    course = course_of(to)
    if not 0.0 <= heading_noise_deg <= 180.0:
        raise JumpcadError(f"heading_noise_deg = {heading_noise_deg:g}: must be at least 0 and at most 180")
    if robot.layout.of(Steering) is None:
        raise JumpcadError(f'{robot.name} has no steering: set [steering] wheel = "o-ring" in its workshop')
    if steers(robot).figures["steering_rate_deg_s"] == 0.0:
        raise JumpcadError(f"{robot.name} does not turn: the floor stalls its wheel; choose a stronger steering.motor")
    arena = Arena(robot, settings, course.obstacles)
    arena.stand("home")
    if struck := arena.struck:
        raise JumpcadError(f"obstacle {min(struck) + 1} stands where the robot does, at 0, 0: move its at_m")
    free = Arena(robot, settings) if course.obstacles else arena
    free.stand("home")
    step_m = hop(free, np.random.default_rng(seed), Recorder(free, False, 0)).way_m
    charge, least = jumps_per_charge(robot), math.ceil((course.way_m - course.within_m) / step_m)
    if least > charge:
        raise JumpcadError(
            f"{course.way_m:g} m are {least} jumps of {step_m:.2f} m, and a full battery gives {charge}: "
            f"go at most {charge * step_m:.0f} m"
        )
    for number in range(tries):
        rng = np.random.default_rng([seed, number])
        turned = 0.0 if isinstance(to, Sequence | Course) else rng.uniform(-math.pi, math.pi)
        points = [pose_about_z(turned)[:2, :2] @ point for point in course.points_m]
        arena.stand_on(scattered_floor(rng))
        recorder = Recorder(arena, record and number == 0)
        yield _trip(arena, points, course, rng, recorder, heading_noise_deg, step_m)


def _trip(
    arena: Arena, points: Sequence[Array], course: Course, rng: np.random.Generator, recorder: Recorder,
    noise_deg: float, step_m: float,
) -> Trip:  # fmt: skip
    """Go once, in jumps that are first taken to be straight and `step_m` long, then as they were on the way."""
    turn_j, train = steers(arena.robot).figures["turn_energy_j"] / TURN_DEG, arena.robot.layout.drive.train
    struck: set[int] = set()

    def watch() -> None:
        recorder.watch()
        struck.update(arena.struck)

    arena.stand("home")
    origin = arena.centre_of_mass_m[:2]
    arena.watch = watch if course.obstacles or recorder.on else None
    moves, ways, veers_deg, faced_rad = list[Move](), [step_m], [0.0], 0.0
    most = PATIENCE * math.ceil(course.way_m / step_m) + LEAST_TRIES

    def left_m(number: int) -> float:
        return float(np.linalg.norm(points[number] + origin - arena.centre_of_mass_m[:2]))

    def reached_from(number: int) -> int:
        """Return how many points are reached, of which so many were before."""
        while number < len(points) and left_m(number) <= course.within_m:
            number += 1
        return number

    reached = reached_from(0)
    while reached < len(points) and len(moves) < most:
        point, turn_deg = points[reached] + origin, 0.0

        def turn(point: Array = point) -> None:
            nonlocal turn_deg, faced_rad
            faced_rad = arena.heading_rad
            if not arena.stands:
                return
            before, length = arena.heading_rad, float(np.mean(ways))
            seen = before + math.radians(rng.normal(0.0, noise_deg))
            way = point - arena.centre_of_mass_m[:2]
            wanted = math.degrees(math.atan2(way[1], way[0]) - seen) - float(np.median(veers_deg))
            wanted = _within_half_turn(wanted + _aside_deg(float(np.linalg.norm(way)), length, course.within_m))
            if abs(wanted) > STRAIGHT_DEG:
                arena.steer(wanted, lambda: recorder("turning"))
                faced_rad = arena.heading_rad
                turn_deg = _within_half_turn(math.degrees(faced_rad - before))

        struck.clear()
        begun_m = arena.centre_of_mass_m[:2]
        done = hop(arena, rng, recorder, turn)
        way_x, way_y = arena.centre_of_mass_m[:2] - begun_m
        veers_deg.append(_within_half_turn(math.degrees(math.atan2(way_y, way_x) - faced_rad)))
        ways.append(done.way_m)
        x, y = (arena.centre_of_mass_m[:2] - origin).tolist()
        hit = tuple(sorted(one + 1 for one in struck))
        moves.append(Move(**vars(done), point=reached + 1, turn_deg=turn_deg, place_m=(x, y), left_m=left_m(reached),
                          energy_j=train.electrical_j + abs(turn_deg) * turn_j, struck=hit))  # fmt: skip
        reached = reached_from(reached)
    arena.watch = None
    moved = (recorder.trajectory, tuple(recorder.phases)) if recorder.on else (None, ())
    return Trip(tuple(moves), reached, reached == len(points), *moved)


def _aside_deg(left_m: float, step_m: float, within_m: float) -> float:
    """Return how far beside the point to aim (°): where one jump is too long and two are too many, two lead there.

    The sides of a triangle are the distance that is left and two jumps of one length. From farther away it aims at the
    point: jumps scatter too much to be counted.
    """
    if abs(left_m - step_m) <= within_m or left_m >= 2.0 * step_m:
        return 0.0
    return math.degrees(math.acos(left_m / (2.0 * step_m)))


def _within_half_turn(angle_deg: float) -> float:
    return (angle_deg + 180.0) % 360.0 - 180.0
