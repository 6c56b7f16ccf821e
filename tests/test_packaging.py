"""The wheel: built, inspected, installed into a fresh environment, used there (about 8 s, most of it pip)."""

import json
import os
import re
import subprocess
import sys
import sysconfig
import tomllib
import venv
import zipfile
from pathlib import Path

import pytest
from support import needs
from support.built import built
from support.places import ROOT

from jumpcad import export
from jumpcad.search.study import code_hash

ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "VIRTUAL_ENV")}
PARSING = {"typer", "rich"}
"""Dependencies that the command line itself needs."""


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
        if path.is_file() and path.parent.name != "__pycache__"
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


def test_the_wheel_writes_what_the_source_tree_writes(installed: Path, tmp_path: Path) -> None:
    """Every file, though pip compiled all that is Python in the package, templates too."""
    assert list(installed.parent.rglob("templates/**/*.pyc"))
    run(installed / "jumpcad", "build", "kenan-2.0", "--ros2", "--no-pictures", "-o", "wheel", folder=tmp_path)
    export(built("kenan-2.0"), tmp_path / "tree", pictures=False, ros2=True)
    wrote = [
        {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
        for folder in (tmp_path / "wheel", tmp_path / "tree")
    ]
    assert wrote[0] == wrote[1]
    said = run(
        installed / "python", "-c", f"import {code_hash.__name__} as code; print(code.code_digest())", folder=tmp_path
    )
    assert said.strip() == code_hash.code_digest()  # a study goes on with either


@needs.without("ruff")
def test_a_bundle_is_committed_as_it_was_written() -> None:
    """`pre-commit` names the files that it checks; those of a bundle keep their bytes."""
    program = str(ROOT / "exports" / "kenan-2.0" / "firmware" / "robot.py")
    for command in (["ruff", "check"], ["ruff", "format", "--check"]):
        done = subprocess.run([*command, program], capture_output=True, text=True, cwd=ROOT, check=False)
        assert done.returncode == 0, done.stdout


def test_help_imports_only_what_parses_and_prints() -> None:
    """Anything else is imported by the command that needs it; what help costs is in `benchmarks/readme.py`."""
    code = "import sys, jumpcad.cli, atexit; atexit.register(lambda: print(*sys.modules)); jumpcad.cli.main()"
    done = subprocess.run([sys.executable, "-c", code, "--help"], capture_output=True, text=True, cwd=ROOT, check=True)
    assert "Usage: jumpcad" in done.stdout
    loaded = set(done.stdout.splitlines()[-1].split())
    assert {"jumpcad.cli", *PARSING} <= loaded
    assert loaded & (imported_names() - PARSING) == set()


def imported_names() -> set[str]:
    """Return under which names the package's dependencies are imported."""
    with (ROOT / "pyproject.toml").open("rb") as stream:
        dependencies = tomllib.load(stream)["project"]["dependencies"]
    names = [re.match(r"[\w-]+", dependency)[0] for dependency in dependencies]
    return {{"pillow": "PIL", "scikit-learn": "sklearn"}.get(name, name.replace("-", "_")) for name in names}
