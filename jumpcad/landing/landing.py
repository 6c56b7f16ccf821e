"""How a robot lands and whether its next winding puts it on its feet: from its own jumps, and dropped anyhow."""

from collections import Counter
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.arguments import check_arguments
from jumpcad.collision.hulls import share_on_feet
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding
from jumpcad.landing.arena import Arena, Floor
from jumpcad.landing.blows import Blow, Blows, PartForce, landing_strength, part_forces
from jumpcad.robot.cage.limits import fall_findings
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.place import Steering
from jumpcad.settings import Settings
from jumpcad.simulation.prior import FLOOR_SHARE

SCATTER_DEG, SPIN_DEG_S = 5.0, 40.0
"""Standard deviations of roll, pitch and yaw at the apex, and of the spins about the body's axes; judgement: a roller
that drops earlier on one side, and a foot that slips."""
SOFTNESS_S = (0.0005, 0.005)
"""Time constants of contacts, from stone to carpet."""
HOLD_S = 1.0
"""How long the wound robot is held before it is looked at."""
DROP_M, DROP_M_S, DROP_RAD_S = (0.05, 0.35), (0.3, 1.8), 5.0
"""Heights, speeds along the floor and spins of robots that are dropped in any attitude."""

RESTS = 12
"""Landings whose median is where a robot comes to rest; judgement."""
GROUNDED = "the robot does not leave the floor, so that it does not land: jumpcad simulate says why"


@dataclass(frozen=True)
class Landing:
    """One landing: how far from where it stood it rests and touched down, on what, and whether winding rights it.

    Distances (m) are along the floor, of the centre of mass. `rests_on` is `feet`, `nose`, `back`, `left`, `right`,
    `top` or `belly`. `blows` are those of the floor on its parts, the first one first.
    """

    touchdown_m: float
    rest_m: float
    rests_on: str
    rights_itself: bool
    blows: tuple[Blow, ...] = ()


@dataclass(frozen=True)
class Landings:
    """Landings of a robot's own jumps, the forces of their hardest blows, what the part hit hardest bears, and a cage.

    `drops_righted` is the share of as many drops in any attitude after which the winding robot stands on its feet;
    `share_on_feet_static` that by its stable poses, without any motion.
    """

    tries: tuple[Landing, ...]
    drops_righted: float = 0.0
    forces: tuple[PartForce, ...] = ()
    strength: Finding | None = None
    falls: tuple[Finding, ...] = ()
    share_on_feet_static: float = 0.0

    @property
    def share_on_feet(self) -> float:
        """Share that comes to rest on its feet."""
        return float(np.mean([one.rests_on == "feet" for one in self.tries]))

    @property
    def share_righted(self) -> float:
        """Share that stands on its feet once it is wound again."""
        return float(np.mean([one.rights_itself for one in self.tries]))

    @property
    def rests_on(self) -> dict[str, int]:
        """How often it rests on what, most often first."""
        return dict(Counter(one.rests_on for one in self.tries).most_common())

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        tries = [
            {name: value for name, value in vars(one).items() if name != "blows"} | {"hits_first": one.blows[0].part}
            for one in self.tries
        ]
        figures: dict[str, Any] = {
            "drops_righted": self.drops_righted, "share_on_feet": self.share_on_feet,
            "share_righted": self.share_righted, "share_on_feet_static": self.share_on_feet_static,
            "rests_on": self.rests_on,
        }  # fmt: skip
        strength = None if self.strength is None else self.strength.to_dict()
        forces = [asdict(one) for one in self.forces]
        falls = {one.name: one.to_dict() for one in self.falls}
        return figures | {"forces": forces, "landing_strength": strength, **falls, "tries": tries}


@check_arguments
def land(robot: Robot, tries: int = 20, seed: int = 0, settings: Settings | None = None) -> Landings:
    """Let a robot jump and land a number of times, each with another attitude, spin and floor; then drop it as often.

    Parameters
    ----------
    robot
        A printed robot.
    tries
        How often, from 1 on.
    seed
        Of what is scattered.
    settings
        Of which gravity and friction hold; None: the defaults.

    Raises
    ------
    CannotBuildError
        If the robot does not leave the floor.
    JumpcadError
        If MuJoCo is not installed.
    """
    arena, rng = Arena(robot, settings), np.random.default_rng(seed)
    hits_j: dict[tuple[str, str], float] = {("", ""): 0.0}
    found = tuple(_land(arena, rng, hits_j) for _ in range(tries))
    forces = part_forces(robot, (blow for one in found for blow in one.blows))
    righted = share_righted(robot, tries, rng, settings)
    strength, falls = landing_strength(robot, forces), tuple(fall_findings(robot, hits_j))
    return Landings(found, righted, tuple(forces), strength, falls, share_on_feet(robot))


def rest_distance_m(robot: Robot, settings: Settings | None = None) -> float:
    """Return the median way to where a robot comes to rest, of `RESTS` of its own jumps; see `distances_m`."""
    return float(np.median([rest for _, rest in distances_m(robot, RESTS, np.random.default_rng(0), settings)]))


def distances_m(
    robot: Robot, tries: int, rng: np.random.Generator, settings: Settings | None = None
) -> list[tuple[float, float]]:
    """Return how far away the robot touches down and comes to rest, in as many of its own jumps (m)."""
    arena = Arena(robot, settings)
    return [_fly_and_rest(arena, rng) for _ in range(tries)]


def share_righted(robot: Robot, drops: int, rng: np.random.Generator, settings: Settings | None = None) -> float:
    """Return the share of drops in any attitude after which the winding robot stands on its feet."""
    arena, stood = Arena(robot, settings), 0
    for _ in range(drops):
        arena.stand_on(scattered_floor(rng))
        along = rng.uniform(0.0, 2.0 * np.pi)
        velocity = rng.uniform(*DROP_M_S) * np.array([np.cos(along), np.sin(along), 0.0])
        attitude = Rotation.random(rng=rng).as_quat(scalar_first=True)
        arena.put(attitude, rng.uniform(*DROP_M), velocity, rng.uniform(-DROP_RAD_S, DROP_RAD_S, 3))
        arena.rest()
        stood += _righted(arena)
    return stood / drops


def _land(arena: Arena, rng: np.random.Generator, hits_j: dict[tuple[str, str], float]) -> Landing:
    """Jump and come to rest, and raise the hardest falls on a cage so far."""
    blows = Blows(arena)
    touchdown_m, rest_m = _fly_and_rest(arena, rng, blows)
    for fall, hits in blows.falls.items():
        hits_j[fall] = max(hits_j.get(fall, 0.0), *(one.work_j for one in hits))
    return Landing(touchdown_m, rest_m, arena.rests_on, _righted(arena), tuple(blows.all))


def _fly_and_rest(arena: Arena, rng: np.random.Generator, watch: Blows | None = None) -> tuple[float, float]:
    """Jump and come to rest on another floor; return how far away it touches down and rests (m)."""
    arena.stand_on(scattered_floor(rng))
    arena.stand()
    if arena.robot.layout.of(Steering) is not None:
        arena.step(HOLD_S, quiet=True)  # it leans on its wheel and one toe
    start = arena.centre_of_mass_m
    arena.release()
    if not arena.fall():
        raise CannotBuildError(GROUNDED)
    disturb(arena, rng)
    touched: list[float] = []

    def look() -> None:
        if not touched and arena.data.ncon:
            touched.append(_away_m(arena, start))

    arena.watch = watch
    arena.rest(look)
    arena.watch = None
    return touched[0], _away_m(arena, start)


def _righted(arena: Arena) -> bool:
    arena.wind(arena.robot.layout.drive.train.winding_s)  # quicker, it rolls itself over by momentum
    arena.step(HOLD_S, quiet=True)
    return arena.stands


def _away_m(arena: Arena, start_m: np.ndarray) -> float:
    return float(np.linalg.norm((arena.centre_of_mass_m - start_m)[:2]))


def disturb(arena: Arena, rng: np.random.Generator) -> None:
    """Change attitude and spin of a robot in the air, as no two jumps are the same."""
    scatter = Rotation.from_rotvec(rng.normal(0.0, np.radians(SCATTER_DEG), 3)).as_matrix()
    arena.turn(scatter, rng.normal(0.0, np.radians(SPIN_DEG_S), 3))


def scattered_floor(rng: np.random.Generator) -> Floor:
    """Draw a floor: friction as of an untested one, any softness from stone to carpet."""
    low, high = np.log(SOFTNESS_S)
    return Floor(float(np.exp(rng.normal(0.0, FLOOR_SHARE))), float(np.exp(rng.uniform(low, high))))
