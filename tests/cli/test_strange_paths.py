"""Commands, and readers of a bundle's files, on a path of 200 characters with spaces, signs and letters of Chinese."""

import contextlib
import importlib
import re
import shutil
import urllib.parse
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from support.calibrations import with_coarse_calibration
from support.commands import Run
from support.pictures import with_few_pictures
from support.places import ROOT
from support.slicers import three_parts

from jumpcad.bundle.export import export
from jumpcad.cli.commands import app
from jumpcad.design import load_design
from jumpcad.robot.robot import Robot
from jumpcad.validation import table
from jumpcad.validation.family import family
from jumpcad.workshop import load_workshop

STRANGE = f"mein Käfer & Söhne (neu?) 机器人 'x' #1 50%25/{'ü' * 60}/{'long name ' * 9}end"
WITHOUT_FILES = {"cage", "list", "reproduce", "studio"}
"""Commands that read and write no path, one that takes minutes, and one that waits for a browser."""
MEASURED = """
design = "mein Käfer.toml"
workshop = "werkstatt ä.toml"
source = "kitchen"
release = "dog"
[[videos]]
points = "points ä.csv"
point = "centre-of-mass"
"""
ROWS = "t,x,z\n" + "".join(f"{t / 50},{t / 75},{t / 50 - 4.905 * (t / 50) ** 2:.5f}\n" for t in range(9))


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A folder on such a path, with a design and a workshop on a base."""
    folder = tmp_path / STRANGE
    folder.mkdir(parents=True)
    assert len(str(folder)) > 200
    (folder / "mein Käfer.toml").write_text(load_design("kenan-2.0").to_toml())
    (folder / "basis 机.toml").write_text("[body]\nplate_mm = 2.4\n")
    (folder / "werkstatt ä.toml").write_text('base = "basis 机.toml"\n', encoding="utf-8")
    return folder


READERS: dict[str, tuple[str, Callable[[Any, Path], object]]] = {
    "yourdfpy": ("urdf/*.urdf", lambda reader, file: reader.URDF.load(str(file)).scene.geometry),
    "pybullet": ("urdf/*.urdf", lambda reader, file: links_of(reader, file)),
    "pinocchio": ("urdf/*.urdf", lambda reader, file: reader.buildModelFromUrdf(str(file)).njoints),
    "mujoco": ("mjcf/*.xml", lambda reader, file: reader.MjModel.from_xml_path(str(file)).nmesh),
    "pydrake.multibody.parsing": ("sdf/*.sdf", lambda reader, file: models_of(reader, file)),
    "trimesh": ("**/*.[sg3][tlm][lbf]", lambda reader, file: reader.load(file).bounds.size),
    "xacro": ("ros2/*/urdf/*.urdf.xacro", lambda reader, file: reader.process_file(str(file)).documentElement),
}
"""Programs, the files that they read, and something that is true if they found it all."""


def links_of(pybullet: Any, file: Path) -> int:
    client = pybullet.connect(pybullet.DIRECT)
    try:
        return len(pybullet.getVisualShapeData(pybullet.loadURDF(str(file), physicsClientId=client), 0, client))
    finally:
        pybullet.disconnect(client)


def models_of(parsing: Any, file: Path) -> int:
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(0.001)
    return len(parsing.Parser(plant).AddModels(str(file)))


def read(bundle: Path, names: Iterable[str]) -> None:
    """Let those readers that are installed find all of their files' contents."""
    for name in names:
        pattern, found = READERS[name]
        with contextlib.suppress(ImportError):
            reader = importlib.import_module(name)
            files = list(bundle.glob(pattern))
            assert files, pattern
            for file in files:
                assert found(reader, file), f"{name} {file}"


def test_a_workshops_base_and_a_robots_meshes_are_found(place: Path, run: Run) -> None:
    assert load_workshop(place / "werkstatt ä.toml").body.plate_mm == 2.4
    for folder in ("urdf", "mjcf"):
        shutil.copytree(ROOT / "exports" / "kenan-2.0" / folder, place / "bündel" / folder)
    read(place / "bündel", ("yourdfpy", "pybullet", "mujoco"))
    assert run("simulate", place / "mein Käfer.toml", "--capsule", "--trajectory", place / "bahn ä.csv")[0] == 0
    assert run("simulate", place / "bündel" / "urdf" / "kenan-2.0.urdf")[0] == 0


@pytest.mark.thorough
def test_every_command_and_every_reader_is_at_home_there(
    place: Path, run: Run, small_robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_coarse_calibration(monkeypatch)
    with_few_pictures(monkeypatch)
    monkeypatch.setattr(table, "family", partial(family, members=4, generations=1, draws=60))
    monkeypatch.setattr(table, "DRAWS", 4)
    design, shop, bundle = place / "mein Käfer.toml", place / "werkstatt ä.toml", place / "bündel 1" / "mein Käfer"
    (place / "messung ä.toml").write_text(MEASURED, encoding="utf-8")
    (place / "points ä.csv").write_text(ROWS)
    (place / "r ä.toml").write_text("[gauge.PLA]\naxle_sliding_mm = 0.25")
    (place / "ziel ä.py").write_text("def zweck(figures):\n    return figures['ballistic_range_m']\n")
    goal, study = f"{place / 'ziel ä.py'}:zweck", place / "studie ä.db"
    small, near = ("--model", "capsule", "--workers", "0"), ("--around", design, "--within", "5")
    commands: list[tuple[object, ...]] = [
        ("new", place / "neu ä.toml", "--from", design),
        ("new", place / "neue werkstatt ä.toml", "--workshop", shop),
        ("build", design, "--workshop", shop, "-o", bundle, "--ros2"),
        ("verify", bundle),
        ("check", design, "--workshop", shop),
        ("compare", bundle, design, "-o", place / "vergleich ä.html"),
        ("variants", design, "--count", "1", "-o", place / "gemachte ä"),
        ("simulate", bundle, "--engine", "both"),
        ("simulate", bundle / "urdf" / "mein Käfer.urdf"),
        ("render", bundle),
        ("report", bundle),
        ("report", design, "--workshop", shop, "-o", place / "seite ä.html"),
        ("coupon", "-o", place / "lehre ä"),
        ("coupon", "--measured", place / "r ä.toml", "--workshop", shop, "-o", place / "gemessen ä.toml"),
        ("calibrate", place / "messung ä.toml", "-o", place / "settings ä.toml"),
        ("simulate", design, "--settings", place / "settings ä.toml", "--engine", "planar"),
        ("explore", "sweep", *small, "--points", "2", "--around", design, "--plots", place / "bilder ä"),
        ("optimize", "ga", *small, "--evaluations", "12", "--objective", goal, "--study", study, *near),
        ("study", study, "--export", place / "alle ä.csv"),
        ("report", study, "-o", place / "studie ä.html"),
        ("validate", "--plots", place / "bilder ä"),
        ("build", bundle, "--no-pictures"),
    ]  # fmt: skip
    if shutil.which("prusa-slicer"):
        commands.append(("slice", export(three_parts(small_robot), place / "drei ä", pictures=False).folder))
    for command in commands:
        code, _, err = run(*command)
        assert code == 0, f"{command}: {err}"
    known = {one.name or one.callback.__name__ for one in app.registered_commands if one.callback}
    known |= {str(one.name) for one in app.registered_groups}
    assert known - WITHOUT_FILES - {"slice"} == {str(command[0]) for command in commands} - {"slice"}
    read(bundle, READERS)
    for page in bundle.rglob("*.html"):
        links = re.findall(r'<(?:a|img)[^>]* (?:href|src)="(?!data:|https?:|#)([^"#]+)', page.read_text())
        assert all((page.parent / urllib.parse.unquote(link)).exists() for link in links), page
