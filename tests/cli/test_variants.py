"""Robots as they may be made: files that MuJoCo and the project itself read, and values within the tolerances."""

import csv
from pathlib import Path

import mujoco
import numpy as np
import pytest
from support.built import built
from support.commands import Run

import jumpcad
from jumpcad.errors import JumpcadError


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
