"""Which worker of pytest runs what."""

from typing import Any

import pytest
from xdist.scheduler import LoadScopeScheduling

FEW = 3
"""Workers at most, of which one has the tests of robots for itself: with more of them it would end last."""
OF_ROBOTS = {"building", "bundle", "checks", "clients", "exporters", "layout", "parts", "test_own_parts.py"}
"""Folders and files of the tests that mostly draw parts."""


class ByRobots(LoadScopeScheduling):
    """One worker has all tests of robots, and draws each part once; those of other files go together to any worker.

    By turns, as usual, all workers draw nearly all parts, and set up nearly every file.
    """

    def _split_scope(self, nodeid: str) -> str:
        file = nodeid.split("::")[0]
        return file if OF_ROBOTS.isdisjoint(file.split("/")) else "robots"


def scheduler(config: pytest.Config, log: Any) -> ByRobots | None:
    """Return what gives out the tests where no other way is asked for and workers are few; None: as usual."""
    few = len(config.getoption("tx")) <= FEW
    return ByRobots(config, log) if few and config.getoption("dist") == "load" else None
