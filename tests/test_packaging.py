"""The wheel: built, looked into, installed into a fresh environment, used there (about 8 s, most of it pip)."""

import json
import os
import resource
import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest
from support.places import ROOT

ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "VIRTUAL_ENV")}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of this source tree."""
    folder = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    done = subprocess.run(command, capture_output=True, text=True, env=ENVIRONMENT, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A fresh environment with the wheel; its dependencies come from the environment that runs the tests."""
    folder = tmp_path_factory.mktemp("fresh")
    venv.create(folder, with_pip=False)
    python = folder / "bin" / "python"
    command = [sys.executable, "-m", "pip", "--python", str(python), "install", "--quiet", "--no-deps", "--no-index"]
    subprocess.run([*command, str(wheel)], check=True, env=ENVIRONMENT)
    (site,) = folder.glob("lib/python*/site-packages")
    (site / "dependencies.pth").write_text(sysconfig.get_path("purelib") + "\n")
    return folder / "bin"


def run(command: Path, *arguments: str, folder: Path) -> str:
    """Return what a command of the fresh environment prints."""
    done = subprocess.run(
        [command, *arguments], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_wheel_holds_package_templates_and_licence(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    sources = {f"jumpcad/{path.relative_to(ROOT / 'jumpcad')}" for path in (ROOT / "jumpcad").rglob("*.py")}
    templates = {
        f"jumpcad/templates/{path.relative_to(ROOT / 'templates')}"
        for path in (ROOT / "templates").rglob("*")
        if path.is_file()
    }
    assert "jumpcad/templates/robots/kenan-2.0.toml" in templates
    assert sources | templates | {"jumpcad/py.typed"} <= names
    assert any(name.endswith("licenses/LICENSE") for name in names)
    assert not any(name.startswith(("tests/", "templates/", "benchmarks/")) for name in names)


def test_wheel_works_in_a_fresh_environment(installed: Path, tmp_path: Path) -> None:
    where = run(installed / "python", "-c", "import jumpcad; print(jumpcad.__file__)", folder=tmp_path)
    assert Path(where.strip()).is_relative_to(installed.parent)
    run(installed / "jumpcad", "new", "frog.toml", "--from", "best-bo", folder=tmp_path)
    jump = json.loads(run(installed / "jumpcad", "simulate", "frog.toml", "--capsule", "--json", folder=tmp_path))
    assert jump["verdict"] == "jump"


def test_help_is_instant(installed: Path, tmp_path: Path) -> None:
    """Less than 0.4 s of processor time, whatever else the machine does."""
    run(installed / "jumpcad", "--help", folder=tmp_path)  # writes the byte code

    def used() -> float:
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    seconds = []
    for _ in range(3):
        before = used()
        run(installed / "jumpcad", "--help", folder=tmp_path)
        seconds.append(used() - before)
    assert min(seconds) < 0.4
