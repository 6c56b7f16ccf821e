"""What several packages share: robots and bundles made once, and the options `--all-installed` and `--costs`."""

import gc
import hashlib
import os
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache, wraps
from pathlib import Path
from typing import Any

import pytest
import support.threads  # noqa: F401  # before numpy
from filelock import FileLock
from support.alone import compiled_by_one
from support.built import built
from support.costs import Costs
from support.kept import once as once_of
from support.kept import plate_key, robot_key, threemf_key
from support.robots import make_small_robot

from jumpcad import checks
from jumpcad.building import growth
from jumpcad.bundle import export as bundle_export
from jumpcad.bundle import limits
from jumpcad.bundle.export import export
from jumpcad.checks import Check, printability
from jumpcad.design import Design
from jumpcad.exporters import threemf
from jumpcad.findings import Finding
from jumpcad.robot.robot import Robot
from jumpcad.solids import stl as stl_files
from jumpcad.strength.growth import Growth
from jumpcad.workshop import Workshop

THOROUGH = {
    "clients", "hostile", "test_contributing.py", "test_examples.py", "test_notebooks.py", "test_packaging.py",
    "test_in_browser.py", "test_page_in_browser.py", "test_report_in_browser.py",
}  # fmt: skip
"""Folders and files whose tests are all thorough; a quick run does not even import them."""
QUICK = "not thorough"
ENGRAVED = {"engraving_findings", "printability_findings"}
"""Costly checks that look at what a robot's name is engraved on."""

os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # else every program that a test starts compiles the package: 0.2 s
sys.dont_write_bytecode = False


@pytest.fixture(scope="session")
def of_all_workers(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Path:
    """Return a folder that all workers have in common."""
    own = tmp_path_factory.getbasetemp()
    shared = (own if worker_id == "master" else own.parent) / "of-all-workers"
    shared.mkdir(exist_ok=True)
    return shared


@pytest.fixture(scope="session", autouse=True)
def judged_once(of_all_workers: Path) -> Iterator[None]:
    """Judge equal shapes once, simulate and draw equal robots once, and write equal plates once."""
    seen: dict[object, Any] = {}
    faults = once_of(seen, stl_files.faults, lambda stl: hashlib.sha256(stl).digest())
    undersides = once_of(
        seen, printability._undersides, lambda drawing, *shop: (drawing.shape, *(one.model_dump_json() for one in shop))
    )
    with pytest.MonkeyPatch.context() as patch:
        compiled_by_one(patch, of_all_workers)
        for module in (stl_files, printability):
            patch.setattr(module, "faults", faults)
        patch.setattr(printability, "_undersides", undersides)
        patch.setattr(threemf, "thumbnail", once_of(seen, threemf.thumbnail, plate_key))
        patch.setattr(threemf, "write_threemf", once_of(seen, threemf.write_threemf, threemf_key))
        for name in ("uncertainty_of", "renders"):
            patch.setattr(bundle_export, name, once_of(seen, getattr(bundle_export, name), robot_key))
        coupon = once_of(seen, bundle_export.coupon_files, lambda shop, _, *pictures: (shop.to_toml(), pictures))
        patch.setattr(bundle_export, "coupon_files", coupon)
        patch.setattr(
            limits, "check", once_of(seen, limits.check, lambda robot: (robot_key(robot), len(checks.CHECKS)))
        )
        yield


@pytest.fixture(scope="session")
def costly_findings() -> dict[object, list[Finding]]:
    """What `checked_once` has found."""
    return {}


@pytest.fixture
def checked_once(costly_findings: dict[object, list[Finding]], monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the costly checks of a robot be made once for all tests that ask for this: they show what uses findings.

    A robot is known by design and workshop, and by its name where that matters: for robots as `build` makes them.
    """

    def once(one: Check) -> Check:
        @wraps(one.find)
        def find(robot: Robot) -> list[Finding]:
            check = one.find.__name__
            key = check, check in ENGRAVED and robot.name, robot.design.to_toml(), robot.workshop.to_toml()
            if key not in costly_findings:
                costly_findings[key] = list(one.find(robot))
            return costly_findings[key]

        return one if one.cheap else replace(one, find=find)

    monkeypatch.setattr(checks, "CHECKS", tuple(map(once, checks.CHECKS)))


@pytest.fixture(scope="session")
def assembled_robots() -> dict[object, Robot]:
    """What `built_once` has assembled."""
    return {}


@pytest.fixture
def built_once(assembled_robots: dict[object, Robot], monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a robot be assembled once for all tests that ask for this: they show what becomes of robots."""

    def asked(design: Design, workshop: Workshop, name: str, grown: Growth, before: Robot | None = None) -> object:
        """Return what decides on a robot and its limits: what is taken from the one `before` is what would be made."""
        return design.to_toml(), workshop.to_toml(), name, grown, len(checks.CHECKS)

    monkeypatch.setattr(growth, "assembled", once_of(assembled_robots, growth.assembled, asked))


@pytest.fixture(scope="session")
def small_robot() -> Robot:
    """Kenan 2.0 made of a few parts."""
    return make_small_robot()


@pytest.fixture(scope="session")
def kenan() -> Robot:
    """Kenan 2.0 from the default workshop, with nothing wrong."""
    return built("kenan-2.0")


@pytest.fixture(scope="session")
def strongest() -> Robot:
    """The best design of the Bayesian optimisation: the highest loads of the templates."""
    return built("best-bo")


@pytest.fixture(scope="module", params=["kenan-2.0", "best-bo"])
def robot(request: pytest.FixtureRequest) -> Robot:
    """Kenan 2.0, then the strongest, where a module has no robot of its own."""
    return built(request.param)


@pytest.fixture(scope="session")
def bundle_of(tmp_path_factory: pytest.TempPathFactory, of_all_workers: Path) -> Callable[..., Path]:
    """Return a function that gives a template's bundle, made once for all workers; not to be changed.

    It has no pictures unless they are asked for. A worker that needs one while another makes it waits.
    """
    own = tmp_path_factory.mktemp("bundles")

    @cache
    def made(name: str, pictures: bool = False) -> Path:
        folder = f"{name} with pictures" if pictures else name
        bundle = of_all_workers / folder
        with FileLock(of_all_workers / f"{folder}.lock"):
            if not bundle.exists():
                export(built(name), own / folder, pictures=pictures)
                (own / folder).rename(bundle)
        return bundle

    return made


def pytest_addoption(parser: pytest.Parser) -> None:
    """Offer a run that fails if a program or package is missing for which a test would be skipped, and one of costs."""
    parser.addoption("--all-installed", action="store_true", help="what is not installed fails the run")
    parser.addoption("--costs", type=int, metavar="N", help="print the N tests that need most CPU time, and packages")


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Give one of few workers the tests of robots."""
    from support.workers import scheduler

    return scheduler(config, log)


def pytest_configure(config: pytest.Config) -> None:
    """Measure what tests cost, if asked."""
    if config.getoption("--costs") is not None:
        config.pluginmanager.register(Costs(config.getoption("--costs")))


def pytest_report_header(config: pytest.Config) -> str | None:
    """Say what a quick run leaves out."""
    return 'quick tests; all of them: -m ""' if config.option.markexpr == QUICK else None


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Pass over what a quick run has none of."""
    return True if config.option.markexpr == QUICK and collection_path.name in THOROUGH else None


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests of whole folders and files as thorough, before any are left out."""
    for item in items:
        if not THOROUGH.isdisjoint(item.path.relative_to(Path(__file__).parent).parts):
            item.add_marker(pytest.mark.thorough)


def pytest_collection_finish() -> None:
    """Leave the tests and all that they have imported out of garbage collection: else 0.1 s to 0.3 s each time."""
    import hypothesis  # noqa: F401  # it warns of random generators whose owners it does not see

    gc.freeze()


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
