"""`jumpcad new`: a copy of a template with comments, and nothing replaced unasked."""

import csv
import re
from pathlib import Path
from unittest.mock import ANY

import mujoco
import numpy as np
import pytest
from support.built import built
from support.commands import Run

import jumpcad
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.workshop import load_workshop


def test_new_writes_a_copy_that_can_be_loaded(run: Run, tmp_path: Path) -> None:
    code, out, err = run("new", "frog.toml", "--from", "best-bo")
    assert (code, err) == (0, "")
    assert out.startswith("frog.toml: a copy of best-bo")
    assert load_design(tmp_path / "frog.toml") == load_design("best-bo")


def test_new_keeps_what_is_there(run: Run, tmp_path: Path) -> None:
    (tmp_path / "frog.toml").write_text("mine")
    code, _, err = run("new", "frog.toml")
    assert code == 2
    assert "exists already" in err
    assert (tmp_path / "frog.toml").read_text() == "mine"


@pytest.mark.parametrize("name", template_names("workshops"))
def test_a_new_workshop_is_the_one_that_it_was_copied_from_with_comments(run: Run, tmp_path: Path, name: str) -> None:
    assert run("new", "w.toml", "--workshop", name)[0] == 0
    assert load_workshop(tmp_path / "w.toml") == load_workshop(name)
    text = (tmp_path / "w.toml").read_text()
    assert text.count("#") > 50
    assert max(map(len, text.splitlines())) < 160


OWN = """
printer = "ender-3"
[process]
perimeters = 4
[roles]
links = "PETG"
body = "mine"
gears = "PETG"
[materials.mine]
density_g_cm3 = 1.1
strength_in_plane_mpa = 40.0
strength_interlayer_mpa = 20.0
modulus_mpa = 1500.0
price_eur_per_kg = 20.0
[materials.PETG]
density_g_cm3 = 1.3
[bought]
kit = "strong-2s"
battery = "pack"
pins = { motor = "D2" }
[batteries.pack]
like = "lipo-2s-180"
source = "my scale"
mass_g = 14.0
[mass.weighed_g]
cam = 1.5
[prices_eur]
"screw M3" = 0.05
"""


def test_a_workshop_of_ones_own_is_copied_with_all_that_it_says(run: Run, tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(OWN)
    assert run("new", "again.toml", "--workshop", "own.toml") == (0, ANY, "")
    assert load_workshop(tmp_path / "again.toml") == load_workshop(tmp_path / "own.toml")
    text = (tmp_path / "again.toml").read_text()
    assert 'printer = "ender-3"' in text
    assert re.search(r"perimeters = 4 +# judgement", text)


def test_a_printer_and_a_material_go_into_a_new_workshop(run: Run, tmp_path: Path) -> None:
    assert run("new", "w.toml", "--printer", "ender-3", "--material", "pla")[0] == 0
    workshop = load_workshop(tmp_path / "w.toml")
    assert workshop.printer.name == "Creality Ender-3"
    assert set(workshop.materials) == {"PLA"}
    assert workshop == load_workshop("default", "ender-3", "PLA")


def test_a_printer_of_ones_own_is_written_as_a_table(run: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('name = "mine"\nbed_mm = [300, 300, 300]\nnozzle_mm = 0.4\n')
    assert run("new", "w.toml", "--printer", "./mine.toml")[0] == 0
    assert load_workshop(tmp_path / "w.toml").printer.bed_mm == (300.0, 300.0, 300.0)


def rows(folder: Path) -> list[dict[str, str]]:
    return list(csv.DictReader((folder / "variants.csv").read_text(encoding="utf-8").splitlines()))


def test_mujoco_reads_every_robot_with_the_figures_of_the_table(run: Run, tmp_path: Path) -> None:
    code, out, err = run("variants", "kenan-2.0", "--count", "3", "--seed", "4", "-o", tmp_path / "v")
    assert (code, err) == (0, "")
    assert "kenan-2.0-001 to kenan-2.0-003" in out
    table = rows(tmp_path / "v")
    assert [row["name"] for row in table] == [f"kenan-2.0-00{number}" for number in (1, 2, 3)]
    for row in table:
        model = mujoco.MjModel.from_xml_path(str(tmp_path / "v" / "mjcf" / f"{row['name']}.xml"))
        assert 1000.0 * model.body_mass.sum() == pytest.approx(float(row["mass_g"]), rel=1e-5)
        assert 1000.0 * model.body("foot").pos[0] == pytest.approx(float(row["l2_mm"]), rel=1e-5)
        stiffness = float(np.ravel(model.tendon_stiffness)[0]) * 1000.0 * np.pi / 180.0
        assert stiffness == pytest.approx(float(row["stiffness_nmm_per_deg"]), rel=1e-5)
        foot = model.geom("foot_left_toe_collision").id
        assert model.geom_friction[foot, 0] == pytest.approx(float(row["foot_friction"]), rel=1e-5)


@pytest.mark.thorough
def test_variants_and_page_of_a_robot_that_does_not_jump_say_so(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "still.toml"
    path.write_text(built("kenan-2.0").design.model_copy(update={"compression_ratio": 0.05}).to_toml(), "utf-8")
    for command, more in (
        ("variants", ["--count", "1", "-o", tmp_path / "v"]),
        ("report", ["-o", tmp_path / "r.html"]),
    ):
        code, _, err = run(command, path, *more)
        assert code == 0
        assert err.startswith("jumpcad: still does not jump ("), command


def test_a_urdf_jumps_as_its_robot_does(run: Run, tmp_path: Path) -> None:
    assert run("variants", "kenan-2.0", "--count", "2", "--format", "urdf", "-o", tmp_path / "v")[0] == 0
    first = jumpcad.variants(built("kenan-2.0"), 1)[0]
    code, out, _ = run("simulate", tmp_path / "v" / "urdf" / "kenan-2.0-001.urdf", "--engine", "planar")
    assert code == 0
    assert f"{jumpcad.simulate(first, engine='planar').ballistic_range_m:.4f} m" in out
    code, _, err = run("variants", "kenan-2.0", "--format", "obj", "-o", tmp_path / "w")
    assert (code, err) == (2, "jumpcad: --format obj: must be mjcf or urdf\n")
    assert not (tmp_path / "w").exists()


def test_what_differs_has_the_spread_of_the_workshops_tolerances() -> None:
    """400 robots: links within the tolerance and evenly spread (σ = t/√3), rates and masses by their deviations."""
    robot = built("kenan-2.0")
    made = jumpcad.variants(robot, 400, seed=1)
    assert jumpcad.variants(robot, 2, seed=1)[1] == made[1]
    tolerance = robot.workshop.fits.link_tolerance_mm
    errors = np.array([one.design.l2_mm - robot.design.l2_mm for one in made])
    assert np.abs(errors).max() <= tolerance
    for values, deviation in (
        (errors, tolerance / np.sqrt(3.0)),
        ([one.spring.stiffness_nm_per_rad / robot.spring.stiffness_nm_per_rad for one in made],
         robot.workshop.safety.spring_rate_scatter / 2.0),
        ([one.mass_kg / robot.mass_kg for one in made], 0.04),
        ([np.log(one.friction.foot) for one in made if one.friction], 0.15),
        ([np.log(one.friction.pin) for one in made if one.friction], 0.4),
    ):  # fmt: skip
        assert np.std(values) == pytest.approx(deviation, rel=0.15)  # four standard errors of a standard deviation
    with pytest.raises(JumpcadError, match="count = 0: must be at least 1"):
        jumpcad.variants(robot, 0)
