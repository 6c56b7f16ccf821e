"""Functions that are called once for each of their cases: for tests of what becomes of the results."""

from collections.abc import Callable, Iterator
from typing import Any

from jumpcad.robot import Robot


def once(known: dict[object, Any], make: Callable[..., Any], key: Callable[..., object]) -> Callable[..., Any]:
    """Return a function that keeps its results in `known`, by its name and the key of its arguments."""

    def kept(*arguments: Any) -> Any:
        case = (make.__name__, key(*arguments))
        if case not in known:
            done = make(*arguments)
            known[case] = tuple(done) if isinstance(done, Iterator) else done
        return known[case]

    return kept


def robot_key(robot: Robot, *more: Any) -> object:
    """Return what tells robots apart: design, workshop, name, and the names of their parts."""
    parts = tuple(part.name for part in robot.parts)
    return robot.design.to_toml(), robot.workshop and robot.workshop.to_toml(), robot.name, parts, str(more)
