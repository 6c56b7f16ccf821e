"""What a robot in an arena does, recorded moment by moment: poses, energies, and in which phase it is."""

from dataclasses import dataclass, field

import numpy as np

from jumpcad.landing.arena import Arena
from jumpcad.mechanism.model import BODY_NAMES
from jumpcad.simulation.jump import Trajectory
from jumpcad.transforms import Array

LANDING_EVERY = 4
"""Of a landing every fourth look is kept: robots tumble slower than they fly."""


@dataclass
class Recorder:
    """Call it with a phase at every moment that is to be kept, if it is `on`; `phases` (n,) names that of each.

    The phases of jump number n are `winding n`, `push-off n`, `flight n` and `landing n`.
    """

    arena: Arena
    on: bool
    number: int = 0
    phases: list[str] = field(default_factory=list)
    _rows: list[Array] = field(default_factory=list)
    _looks: int = 0

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
        touches, before = self.arena.data.ncon > 0, self.phases[-1].split()[0]
        phase = {"winding": "push-off", "flight": "landing"}.get(before, before) if touches else "flight"
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
