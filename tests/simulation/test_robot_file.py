"""TOML files of robots with bodies of their own: read as written, or rejected in one line."""

from pathlib import Path

import numpy as np
import pytest
from support.places import ROOT

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import Multibody
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.robot_file import load_robot

EXAMPLES = {name: (ROOT / "examples" / f"{name}.toml").read_text() for name in ("light_jumper", "chain_jumper")}


def read(folder: Path, text: str) -> Multibody:
    path = folder / "robot.toml"
    path.write_text(text)
    return load_robot(path)


def test_rods_are_capsules_of_their_density(tmp_path: Path) -> None:
    """The volume of a capsule is pi·r²·(l + 4r/3); a thin rod has the inertia m·l²/12 about its centre."""
    light = read(tmp_path, EXAMPLES["light_jumper"])
    leg = light.bodies["main_leg"]
    radius, length = 1.39e-3, 49.648e-3
    assert leg.mass_kg == pytest.approx(1480.0 * np.pi * radius**2 * (length + 4.0 * radius / 3.0))
    assert leg.com_m == pytest.approx([length / 2.0, 0.0, 0.0])
    assert leg.inertia_kg_m2[1, 1] == pytest.approx(leg.mass_kg * (length + 2.0 * radius) ** 2 / 12.0, rel=0.05)


def test_the_studys_capsule_robot_as_a_file_jumps_like_it(tmp_path: Path) -> None:
    """Masses and moments about y written down; every engine sees the same plane motion."""
    design = load_design("kenan-2.0")
    capsule = capsule_robot(design)
    bodies = "\n".join(
        f"[bodies.{name}]\nmass_g = {1e3 * one.mass_kg}\ncentre_mm = [{1e3 * one.com_m[0]}, {1e3 * one.com_m[2]}]\n"
        f"inertia_gmm2 = {1e9 * one.inertia_kg_m2[1, 1]}"
        for name, one in capsule.bodies.items()
    )
    foot = f"[foot]\nradius_mm = {1e3 * capsule.foot_depth_m}\nfriction = 1.5\nbody_friction = 0.75"
    robot = read(tmp_path, f'name = "k"\n{foot}\n{bodies}\n[design]\n{design.to_toml()}')
    alike = Settings(joint_damping_nms_per_rad=0.0, takeoff_clearance_m=0.0)
    one, other = (simulate(which, alike, "planar") for which in (robot, capsule))
    assert robot.mass_kg == pytest.approx(capsule.mass_kg)
    assert one.ballistic_range_m == pytest.approx(other.ballistic_range_m, rel=1e-6)
    assert one.com_rise_m == pytest.approx(other.com_rise_m, rel=1e-6)


WRONG = [
    ("light_jumper", "mass_g = 7.0", "mass_g = 9.0", "mass_g = 9: the bodies have 6.999 g together"),
    (
        "light_jumper",
        "energy_j = 0.154",
        "energy_j = 0.5",
        "spring.energy_j = 0.5: rate, loaded angle and preload hold",
    ),
    ("light_jumper", "inertia_gmm2 = 700.0", "inertia_gmm2 = 7e6", "bodies.foot: inertia and mass have a radius of"),
    ("light_jumper", "mass_g = 1.092\n", "", "bodies.foot = None: give mass_g and inertia_gmm2 together"),
    ("light_jumper", "stiffness_nmm_per_deg = 3.30155", "stiffness_nmm_per_deg = 200", "spring.energy_j = 0.154: rate"),
    ("light_jumper", "[bodies.foot] ", "[bodies.paw] ", "bodies = 'body, main_leg, front_link, paw': a five-bar's are"),
    ("chain_jumper", "stiffness_nmm_per_deg = 0.5", "stiffness_nmm_per_deg = 500", "would lift the robot by 530 m"),
    (
        "chain_jumper",
        'joint = "right_knee"',
        'joint = "knee"',
        "springs.joint = 'knee': is no joint; there are left_an",
    ),
    (
        "chain_jumper",
        "point_a_mm = [40, 0]",
        "point_a_mm = [80, 0]",
        "the loaded pose does not close: loops, foot and",
    ),
    (
        "chain_jumper",
        'parent = "foot"',
        'parent = "left_thigh"',
        "joints.child = 'left_thigh': must hang a new body on one",
    ),
    ("chain_jumper", 'body = "foot" ', 'body = "hand" ', "foot = 'hand': is no body; there are foot, left_shank"),
    ("chain_jumper", "mass_g = 24.0", "mass_kg = 24.0", "mass_kg: unknown key"),
    ("chain_jumper", "[-20, 140]", "[140, -20]", "must be the least and the largest angle of left_knee"),
    ("chain_jumper", "[-20, 140]", "[0, 50]", "loaded_deg between both"),
    ("chain_jumper", 'joint = "right_knee"', 'joint = "left_knee"', "at most one on a joint"),
    ("chain_jumper", "left_hip", "root pitch", "name = 'root pitch': is taken by the simulation"),
    ("chain_jumper", "left_shank", "world", "name = 'world': is taken by the simulation"),
]


def test_what_no_robot_has_is_rejected_in_one_line(tmp_path: Path) -> None:
    for example, good, bad, reason in WRONG:
        assert good in EXAMPLES[example], good
        with pytest.raises(JumpcadError) as found:
            read(tmp_path, EXAMPLES[example].replace(good, bad))
        said = str(found.value)
        assert reason in said, f"{bad}: {said}"
        assert said.startswith(str(tmp_path / "robot.toml")), said
        assert "\n" not in said
