"""What hostile inputs meet: a sandbox, good files to spoil, and a count of tries and failures at the end of a run."""

import gc
import importlib.util
import json
import os
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.font_manager  # writes its list of fonts, if there is none
import pytest
from support.commands import exit_code_of
from support.costs import spent_s
from support.kept import once, robot_key
from support.pictures import with_few_pictures, with_plain_figures
from support.robots import make_small_robot
from support.sandbox import Sandbox
from support.slicers import OBEDIENT

from jumpcad.bundle import export, renders
from jumpcad.bundle import export as bundle_export
from jumpcad.coupon import contents as coupon_contents
from jumpcad.simulation.engines import engine_named

ENGINES = tuple(name for name in ("pybullet", "mujoco") if importlib.util.find_spec(name))
MEMORY = "/dev/shm"
"""A file system in memory, as Linux has it."""
FONTS = matplotlib.get_cachedir()
"""Where matplotlib finds its list of fonts, which takes it seconds to make, whatever `HOME` is."""
TRIES: Counter[str] = Counter()
FAILURES: Counter[str] = Counter()
TRIED: Counter[str] = Counter()
SPENT_S: defaultdict[str, float] = defaultdict(float)
STILL_EVERY = 4
"""Cases after which an engine is tried again: one that a case spoils stays so."""


@dataclass(frozen=True)
class Originals:
    """Good files, made once: a bundle of a robot of few parts, Kenan 2.0's, a coupon, a study of a few evaluations."""

    bundle: Path
    whole: Path
    coupon: Path
    study: Path

    @property
    def urdf(self) -> bytes:
        return (self.whole / "urdf" / "kenan-2.0.urdf").read_bytes()

    @property
    def loop(self) -> dict[str, Any]:
        return json.loads((self.whole / "urdf" / "kenan-2.0.loop.json").read_text())

    def lay_urdf(self, sandbox: Sandbox, urdf: bytes, loop: bytes | None = None) -> None:
        """Lay a URDF file with the good loop beside it, or another one."""
        sandbox.write("robot.urdf", urdf)
        good = (self.whole / "urdf" / "kenan-2.0.loop.json").read_bytes()
        sandbox.write("robot.loop.json", good if loop is None else loop)

    @property
    def manifest(self) -> dict[str, Any]:
        return json.loads((self.bundle / "manifest.json").read_text())


@pytest.fixture(scope="package", autouse=True)
def remembered() -> Iterator[dict[object, Any]]:
    """Let the contents of a bundle, a coupon or pictures be made once: what is tried here is what becomes of them.

    Yield what is remembered, for a test to clear; whatever differs in design, workshop or name is made anew.
    """
    made: dict[object, Any] = {}

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bundle_export, "contents", once(made, bundle_export.contents, robot_key))
        files = once(made, coupon_contents.coupon_files, lambda shop, _, *pictures: (shop.to_toml(), pictures))
        patch.setattr(export, "coupon_files", files)
        masses = once(made, coupon_contents.coupon_masses, lambda _, shop: shop.to_toml())
        patch.setattr(export, "coupon_masses", masses)
        patch.setattr(renders, "renders", once(made, renders.renders, robot_key))
        patch.setattr(renders, "jump_gif", once(made, renders.jump_gif, lambda robot, *_: robot_key(robot)))
        yield made
    made.clear()


@pytest.fixture(scope="package")
def originals(remembered: object, tmp_path_factory: pytest.TempPathFactory) -> Originals:
    """Make the good files, with the command line itself where it can."""
    folder = tmp_path_factory.mktemp("originals")
    made = Originals(folder / "bundle", folder / "whole", folder / "coupon", folder / "study.db")
    bundle_export.export(make_small_robot(), made.bundle, pictures=False)
    assert exit_code_of("build", "kenan-2.0", "-o", str(made.whole), "--no-pictures", "--json") == 0
    assert exit_code_of("coupon", "-o", str(made.coupon), "--json") == 0
    search = ("--model", "capsule", "--evaluations", "6", "--workers", "0", "--study", str(made.study), "--json")
    assert exit_code_of("optimize", "nsga2", *search) == 0
    gc.freeze()  # collecting looks only at what comes after this
    return made


@pytest.fixture
def tmp_path() -> Iterator[Path]:
    """Yield a folder in memory, if there is one: a hundred thousand small files are copied, read and removed."""
    with tempfile.TemporaryDirectory(dir=MEMORY if os.access(MEMORY, os.W_OK) else None) as folder:
        yield Path(folder).resolve()


@pytest.fixture
def sandbox(
    originals: Originals,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
    request: pytest.FixtureRequest,
) -> Iterator[Sandbox]:
    """Yield the folders in which a command is tried; every try in them is counted."""
    monkeypatch.setenv("MPLCONFIGDIR", FONTS)
    place = Sandbox(tmp_path / "sandbox", monkeypatch, capfd)
    yield place
    request.node.user_properties.append(("tries", place.tries))


@pytest.fixture(scope="package", autouse=True)
def slicer(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Put a program that slices nothing in the slicer's place, where programs may run."""
    program = tmp_path_factory.mktemp("programs") / "prusa-slicer"
    program.write_text(f"#!{sys.executable} -IS\n{OBEDIENT.replace('TAMPER', '')}")
    program.chmod(0o755)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", f"{program.parent}{os.pathsep}{os.environ['PATH']}")
        yield


@pytest.fixture(autouse=True)
def findings(built_once: None, checked_once: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Build a robot once, check it once, draw a jump in few pictures: what is tried here is what becomes of them."""
    with_few_pictures(monkeypatch)
    with_plain_figures(monkeypatch)


@pytest.fixture
def bundle(sandbox: Sandbox, originals: Originals) -> Path:
    """Return the folder of a bundle of few parts in the sandbox, `robot`."""
    return sandbox.put(originals.bundle, "robot")


@pytest.fixture
def study(sandbox: Sandbox, originals: Originals) -> Path:
    """Return a study in the sandbox, `study.db`."""
    return sandbox.put(originals.study, "study.db")


@pytest.fixture(scope="package")
def good_jump() -> dict[str, str]:
    """Return what each engine prints of a good robot; filled in before anything hostile is tried."""
    return {}


@pytest.fixture
def still_works(sandbox: Sandbox, good_jump: dict[str, str]) -> Callable[[str], None]:
    """Return what asserts that an engine gives the result that it always gives, whatever came before.

    It looks after every fourth case: the one that spoiled an engine is that or one of the three before.
    """
    for engine in ENGINES if not good_jump else ():
        good_jump[engine] = sandbox.call("simulate", "kenan-2.0", "--capsule", "--json", "--engine", engine).out

    def check(engine: str) -> None:
        TRIED[engine] += 1
        if TRIED[engine] % STILL_EVERY:
            return
        done = sandbox.call("simulate", "kenan-2.0", "--capsule", "--json", "--engine", engine)
        if done.out != good_jump[engine]:
            engine_named.cache_clear()  # a fresh one for the cases to come
            pytest.fail(f"{engine} no longer simulates a good robot as before: {done.out[:120]}")

    return check


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Count the tries, failures and CPU time of a class of inputs: the module `test_CLASS`."""
    name = Path(report.nodeid.split("::")[0]).stem.removeprefix("test_")
    FAILURES[name] += report.failed
    SPENT_S[name] += spent_s() - sum(SPENT_S.values())
    if report.when == "teardown":
        TRIES[name] += dict(report.user_properties).get("tries", 0)


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Print the counts."""
    terminalreporter.section("hostile inputs")
    terminalreporter.write_line(f"{'class':12}{'tries':>8}{'failures':>10}{'CPU s':>8}")
    for name in sorted(TRIES):
        line = f"{name:12}{TRIES[name]:8}{FAILURES[name]:10}{SPENT_S[name]:8.0f}"
        terminalreporter.write_line(line)
    line = f"{'all':12}{TRIES.total():8}{FAILURES.total():10}{sum(SPENT_S.values()):8.0f}"
    terminalreporter.write_line(line)
