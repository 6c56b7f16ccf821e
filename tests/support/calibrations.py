"""Calibrations of few jumps and short chains, for tests of what becomes of their numbers."""

from dataclasses import replace
from typing import Any

import pytest

from jumpcad.calibration import posterior, subject, surface
from jumpcad.calibration.measurements import Measurements
from jumpcad.calibration.subject import Subject
from jumpcad.calibration.video import TakeoffSeen
from support.kept import once, robot_key

COARSE = ((0.45, 0.7, 1.0, 1.6, 2.5), (0.0, 0.9), (0.3, 0.5, 0.65, 1.0))
EVEN = (21, 5, 13)
"""Even points that these are refined to: a twelfth of the lines that the program's own have."""
KNOWN: dict[object, Any] = {}
"""Surfaces of robots: of one robot the same, and it takes a second."""


def with_coarse_calibration(patch: pytest.MonkeyPatch) -> None:
    """Let a robot's surface stand on few jumps, and chains be short."""
    patch.setattr(surface.surface_of, "__defaults__", (COARSE,))
    patch.setattr(surface, "FINE", EVEN)
    patch.setattr(subject, "surface_of", once(KNOWN, surface.surface_of, robot_key))
    patch.setattr(posterior.sampled, "__defaults__", (0, 200, 200, 10))


def remeasured(robot: Subject, measured: Measurements, seen: tuple[TakeoffSeen, ...] = ()) -> Subject:
    """Return the same robot with other measurements, which are not checked; its jumps are not simulated again."""
    other = replace(robot, measured=measured, seen=seen)
    vars(other).update({name: getattr(robot, name) for name in ("surface", "standing_m", "beyond_m")})
    return other


def stand_in(kind: type, **said: Any) -> Any:
    """Return an object of a class that has these attributes and was not made by its constructor."""
    return object.__new__(type(kind.__name__, (kind,), said))
