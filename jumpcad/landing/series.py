"""Jumps in a row: the robot winds wherever it lies, waits, is released, flies and lands, and does so again."""

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from jumpcad.arguments import check_arguments
from jumpcad.errors import CannotBuildError
from jumpcad.landing.arena import QUIET_STEP_S, Arena
from jumpcad.landing.landing import GROUNDED, disturb, scattered_floor
from jumpcad.mechanism.model import BODY_NAMES
from jumpcad.robot.electronics.limits import jumps_per_charge
from jumpcad.robot.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation.jump import Trajectory
from jumpcad.transforms import Array

LANDING_S, REST_S = 1.5, 2.0
"""Pauses of the firmware: after a release for flight and landing, and then and when wound until the robot lies still;
judgement: simulated landings of the templates rest 2 to 2.6 s after the release."""
LANDING_EVERY = 4
"""Of a landing every fourth look is recorded: robots tumble slower than they fly."""


@dataclass(frozen=True)
class Hop:
    """One jump of a row: whether it stood on its feet at the release, and what became of it.

    `way_m` is how far its centre of mass moved along the floor until it rested, `height_m` how high it rose,
    `heading_deg` where it faced at the release, against where it faced at first (left positive, from -180 to 180),
    `time_s` winding, waiting, flight and landing.
    """

    stood: bool
    way_m: float
    height_m: float
    heading_deg: float
    time_s: float


@dataclass(frozen=True)
class Row:
    """Some jumps, each from where the last one ended."""

    hops: tuple[Hop, ...]

    @property
    def stood(self) -> int:
        """How many jumps began on the feet."""
        return sum(hop.stood for hop in self.hops)

    @property
    def way_m(self) -> float:
        return sum(hop.way_m for hop in self.hops)


@dataclass(frozen=True)
class Series(Row):
    """Jumps in a row, with the energy of a jump, how many a full battery gives, and the motion if it was recorded.

    `stands_again` and `faces_deg` say whether it stands once it is wound after the last one, and where it then faces.
    Figures of a jump are those of jumps from its feet.
    `phases` (n,) are those of the trajectory's moments, such as `flight 2` of the second jump: see `Recorder`.
    """

    distance_m: float
    weight_n: float
    electrical_j: float
    jumps_per_charge: int
    stands_again: bool
    faces_deg: float
    trajectory: Trajectory | None = None
    phases: tuple[str, ...] = ()

    @property
    def unaided(self) -> int | None:
        """After how many jumps it first lies, so that somebody has to put it on its feet; None if it always stands."""
        stands = [*(hop.stood for hop in self.hops), self.stands_again]
        return None if all(stands) else stands.index(False)

    @property
    def metres_per_charge(self) -> float:
        """The mean way of a jump times the jumps of a full battery (m); of one that comes to lie, its way till then."""
        if self.unaided is None:
            return self.way_m / len(self.hops) * self.jumps_per_charge
        return sum(hop.way_m for hop in self.hops[: self.unaided])

    @property
    def cost_of_transport(self) -> float:
        """Electrical energy over weight and way, of the jumps from its feet."""
        ways = [hop.way_m for hop in self.hops if hop.stood]
        return self.electrical_j * len(ways) / (self.weight_n * sum(ways)) if sum(ways) > 0.0 else math.inf

    @property
    def heading_drift_deg(self) -> float | None:
        """Median turn from one stand to the next, with landing, winding and rolling up; None if it has no next."""
        stands = np.array([*(hop.stood for hop in self.hops), self.stands_again])
        turns = np.diff([*(hop.heading_deg for hop in self.hops), self.faces_deg])[stands[:-1] & stands[1:]]
        return float(np.median(np.abs((turns + 180.0) % 360.0 - 180.0))) if turns.size else None

    @property
    def seconds_per_jump(self) -> float:
        """The mean time of a jump, with winding and waiting."""
        return float(np.mean([hop.time_s for hop in self.hops]))

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        names = ("stood", "way_m", "metres_per_charge", "cost_of_transport", "heading_drift_deg", "seconds_per_jump")
        figures = {name: getattr(self, name) for name in names}
        return {**figures, "distance_m": self.distance_m, "electrical_j": self.electrical_j,
                "stands_again": self.stands_again, "faces_deg": self.faces_deg, "unaided": self.unaided,
                "jumps_per_charge": self.jumps_per_charge, "jumps": [asdict(hop) for hop in self.hops]}  # fmt: skip


@dataclass
class Recorder:
    """Call it with a phase at every moment of an arena that is to be kept, if it is `on`; `phases` (n,) names them.

    The phases of jump number n are `winding n`, where it steers `turning n`, `push-off n`, `flight n` and `landing n`.
    """

    arena: Arena
    on: bool
    number: int = 0
    phases: list[str] = field(default_factory=list)
    _rows: list[Array] = field(default_factory=list)
    _looks: int = 0
    _touched: bool = False

    def watch(self) -> None:
        """Notice a touch of the falling robot, which may end before the next look."""
        self._touched |= self.arena.data.ncon > 0 and bool(self.arena.velocity_m_s[2] < 0.0)

    def begin(self) -> None:
        """Begin another jump, with its winding."""
        self.number += 1
        self("winding")

    def __call__(self, phase: str) -> None:
        """Keep this moment."""
        if not self.on:
            return
        data, bodies = self.arena.data, [self.arena.bodies[name] for name in BODY_NAMES]
        self.phases.append(f"{phase} {self.number}")
        turns = data.xquat[bodies][:, [1, 2, 3, 0]]
        energies = [data.time, *self.arena.energies_j]
        self._rows.append(np.concatenate([energies, data.xpos[bodies].ravel(), turns.ravel()]))

    def look(self) -> None:
        """Keep a moment after a release: pushing off, in flight, and some of those from touchdown on."""
        if not self.on:
            return
        before = self.phases[-1].split()[0]
        touches, self._touched = self.arena.data.ncon > 0 or (before == "flight" and self._touched), False
        phase = ("landing" if before == "flight" else "push-off") if touches else "flight"
        if before == "landing":
            self._looks += 1
            phase = "landing"
            if self._looks % LANDING_EVERY:
                return
        self(phase)

    @property
    def trajectory(self) -> Trajectory:
        """All that was kept."""
        rows, count = np.array(self._rows), len(BODY_NAMES)
        place, turn = rows[:, 4 : 4 + 3 * count], rows[:, 4 + 3 * count :]
        return Trajectory(
            BODY_NAMES, rows[:, 0], place.reshape(-1, count, 3), turn.reshape(-1, count, 4), *rows[:, 1:4].T
        )


@check_arguments
def jumps(
    robot: Robot, count: int = 10, seed: int = 0, settings: Settings | None = None, record: bool = False
) -> Series:
    """Let a robot jump a number of times in a row, from where it has come to rest each time.

    It winds within the time of its own drive and is released by its own cam, standing or not, as its firmware does.

    Parameters
    ----------
    robot
        A printed robot.
    count
        How often, from 1 on.
    seed
        Of the floor, the same for all jumps, and of attitude and spin at each apex.
    settings
        Of which gravity and friction hold; None: the defaults.
    record
        Whether to record the motion.

    Raises
    ------
    CannotBuildError
        If the robot does not leave the floor.
    JumpcadError
        If MuJoCo is not installed.
    """
    arena, train = Arena(robot, settings), robot.layout.drive.train
    rng = np.random.default_rng(seed)
    arena.stand_on(scattered_floor(rng))
    arena.stand("home")
    first = arena.centre_of_mass_m
    recorder = Recorder(arena, record)
    arena.watch = recorder.watch if record else None
    hops = tuple(hop(arena, rng, recorder) for _ in range(count))
    way = float(np.linalg.norm((arena.centre_of_mass_m - first)[:2]))
    arena.wind(train.winding_s)
    arena.step(REST_S, quiet=True)
    weight = robot.mass_kg * arena.gravity_m_s2
    moved = (recorder.trajectory, tuple(recorder.phases)) if record else (None, ())
    charge, faces_deg = jumps_per_charge(robot), math.degrees(arena.heading_rad)
    return Series(hops, way, weight, train.electrical_j, charge, arena.stands, faces_deg, *moved)


def hop(arena: Arena, rng: np.random.Generator, recorder: Recorder, turn: Callable[[], None] | None = None) -> Hop:
    """Wind, rest, `turn`, jump and come to rest; `CannotBuildError` if the first, unturned, stays on the floor."""
    begun = float(arena.data.time)
    recorder.begin()
    arena.wind(arena.robot.layout.drive.train.winding_s, lambda: recorder("winding"))
    arena.step(REST_S, quiet=True)
    recorder("winding")
    if turn is not None:
        turn()
    stood, start, heading = arena.stands, arena.centre_of_mass_m, math.degrees(arena.heading_rad)
    highest = float(start[2])

    def look() -> None:
        nonlocal highest
        highest = max(highest, float(arena.centre_of_mass_m[2]))
        recorder.look()

    arena.release()
    if arena.fall(look):
        disturb(arena, rng)
    elif recorder.number == 1 and turn is None:
        raise CannotBuildError(GROUNDED)
    rested_s = arena.rest(look)
    arena.step(max(LANDING_S + REST_S - rested_s, QUIET_STEP_S), quiet=True)
    way = float(np.linalg.norm((arena.centre_of_mass_m - start)[:2]))
    return Hop(stood, way, highest - float(start[2]), heading, float(arena.data.time) - begun)
