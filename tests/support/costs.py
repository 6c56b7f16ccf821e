"""What each test costs in CPU time, its children's included, and what package it belongs to.

A test pays for the fixtures that it is the first to need. Processes that outlive a test, as a pool's workers do, are
counted where they end.
"""

import os
from collections import Counter
from collections.abc import Iterator
from typing import Any

import pytest

CPU = "cpu_s"


def spent_s() -> float:
    """Return the CPU time of this process and of its ended children (s)."""
    return sum(os.times()[:4])


class Costs:
    """Adds to each report what its phase cost, and prints the tests and packages that cost most."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._before_s = spent_s()
        self._tests: Counter[str] = Counter()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self) -> Iterator[None]:
        """Add the CPU time since the report before."""
        report: Any = yield
        now_s = spent_s()
        report.user_properties = [*report.user_properties, (CPU, now_s - self._before_s)]
        self._before_s = now_s
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Sum the phases of each test."""
        self._tests[report.nodeid] += dict(report.user_properties).get(CPU, 0.0)

    def pytest_terminal_summary(self, terminalreporter: Any) -> None:
        """Print the dearest tests, and the packages."""
        packages: Counter[str] = Counter()
        for name, cost_s in self._tests.items():
            packages["/".join(name.split("::")[0].split("/")[:2])] += cost_s
        terminalreporter.section("CPU time (s)")
        for name, cost_s in [*self._tests.most_common(self._count), *packages.most_common()]:
            terminalreporter.write_line(f"{cost_s:7.1f} {name}")
        terminalreporter.write_line(f"{self._tests.total():7.1f} all {len(self._tests)} tests")
