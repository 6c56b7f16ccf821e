"""Fixtures for the tests of several packages, and the option `--all-installed`."""

from typing import Any

import pytest
from support.robots import make_small_robot

from jumpcad.robot import Robot


@pytest.fixture(scope="session")
def small_robot() -> Robot:
    """Kenan 2.0 made of a few parts."""
    return make_small_robot()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Offer a run that fails if a program or package is missing for which a test would be skipped."""
    parser.addoption("--all-installed", action="store_true", help="what is not installed fails the run")


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Fail a run with `--all-installed` in which something was missing."""
    reporter: Any = session.config.pluginmanager.get_plugin("terminalreporter")
    if reporter is None or not session.config.getoption("--all-installed"):
        return
    reasons = [str(report.longrepr) for report in reporter.stats.get("skipped", [])]
    missing = [reason for reason in reasons if "not installed" in reason or "could not import" in reason]
    if missing:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
        reporter.write_line(f"missing: {len(missing)} skipped for what is not installed", red=True)
