"""Models whose answers are known in closed form, and models that fail on purpose; importable in worker processes."""

import math
import os
import signal
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, Design
from jumpcad.evaluation import FIGURES
from jumpcad.findings import Finding
from jumpcad.search.models import RobotModel
from jumpcad.search.study.objective import Evaluation

TOP = {"rest_angle_deg": 55.0, "compression_ratio": 0.6, "stiffness_nmm_per_deg": 20.0}
FIXED = [f"{name}={limits.lower}" for name, limits in SEARCH_BOUNDS.items() if name not in TOP]


def __getattr__(name: str) -> Any:
    """Return `SMALL`, the space of the hill's three parameters: workers load hills without it, in half the time."""
    if name != "SMALL":
        raise AttributeError(name)
    from jumpcad.search.space import Space

    return globals().setdefault("SMALL", Space.parse(fix=FIXED))


@dataclass(frozen=True)
class Hill(RobotModel):
    """One smooth hill of height 10 at `TOP`, rejected (`loop`) where the compression ratio is above 0.7.

    Every evaluation is one line in `log`, if given.
    """

    log: Path | None = None
    pause_s: float = 0.0
    name: str = "hill"
    figure_names = tuple(FIGURES)
    quick_score = None

    def __call__(self, design: Design) -> Evaluation:
        if self.log is not None:
            with self.log.open("a") as stream:
                stream.write(f"{design.to_vector()}\n")
        time.sleep(self.pause_s)
        margin = 0.7 - design.compression_ratio
        finding = Finding("loop", "error" if margin < 0 else "info", margin, "", "ratio", "lower it")
        if margin < 0:
            return Evaluation("loop", findings=(finding,))
        return Evaluation(
            "jump", {"fitness": 10.0 * math.exp(-2.0 * self.distance(design)), "mass_kg": 0.1}, (finding,)
        )

    def distance(self, design: Design) -> float:
        """Squared distance to the top, in ranges."""
        vector = dict(zip(PARAMETERS, design.to_vector(), strict=True))
        return sum(
            ((vector[name] - top) / (SEARCH_BOUNDS[name].upper - SEARCH_BOUNDS[name].lower)) ** 2
            for name, top in TOP.items()
        )

    def admits(self, design: Design) -> bool:
        return True

    def describe(self) -> dict[str, Any]:
        return {"name": self.name}

    def versions(self) -> dict[str, str]:
        return {"hill": "1"}

    @property
    def digest(self) -> str:
        return "hill"


def _flat(_design: Design) -> float | None:
    return 5.0


@dataclass(frozen=True)
class Shaped(Hill):
    """A hill of another shape: by design the fitness, None where it is rejected (`loop`)."""

    height: Callable[[Design], float | None] = _flat

    def __call__(self, design: Design) -> Evaluation:
        fitness = self.height(design)
        return Evaluation("loop") if fitness is None else Evaluation("jump", {"fitness": fitness})


@dataclass(frozen=True)
class Trap(Hill):
    """A hill that fails where the rest angle is above 60°, in one of several ways.

    With `once`, a file, it fails only until that file is there.
    """

    way: str = "kill"
    once: Path | None = None

    def __call__(self, design: Design) -> Evaluation:
        if design.rest_angle_deg > 60.0 and not (self.once and self.once.exists()):
            if self.once:
                self.once.touch()
            if self.way == "kill":
                os.kill(os.getpid(), signal.SIGKILL)
            elif self.way == "hang":
                time.sleep(600.0)
            elif self.way == "memory":
                raise MemoryError("no room for a mesh")
            else:
                raise ZeroDivisionError("a bug")
        return super().__call__(design)
