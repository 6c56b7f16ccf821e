"""What one worker of pytest does while the others that need it too wait for it."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from filelock import FileLock


def compiled_by_one(patch: pytest.MonkeyPatch, folder: Path) -> None:
    """Let one worker compile the planar engine, which stays on disk: it takes as long as some thousand tests.

    For runs that have imported it by now, as that of all tests.
    """
    planar = sys.modules.get("jumpcad.simulation.planar")
    if planar is None:
        return

    def first_alone(function: Callable[..., Any]) -> Callable[..., Any]:
        done = False

        def call(*arguments: Any, **named: Any) -> Any:
            nonlocal done
            if done:
                return function(*arguments, **named)
            with FileLock(folder / f"{function.__name__}.lock"):
                done = True
                return function(*arguments, **named)

        return call

    for name in ("__init__", "push_off"):
        patch.setattr(planar.PlanarWorld, name, first_alone(vars(planar.PlanarWorld)[name]))
