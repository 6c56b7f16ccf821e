"""The cage: arcs by the rule of the chord, free of what moves, in every file alike."""

import math
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from support.built import built

import jumpcad
from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.facts import cage_facts
from jumpcad.bundle.firmware import firmware_files
from jumpcad.bundle.guide.markdown import write_guide
from jumpcad.collision.hulls import least_share_on_feet, quick_corners_mm, share_on_feet
from jumpcad.errors import CannotBuildError
from jumpcad.exporters.mjcf_robot import write_robot
from jumpcad.exporters.sdf import write_sdf
from jumpcad.exporters.urdf import write_urdf
from jumpcad.mechanism.model import BODY, body_poses
from jumpcad.robot.cage.place import SOCKET_MM, Cage
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.solids.stack import Stack
from jumpcad.steps.assembly_steps import assembly_steps
from jumpcad.workshop import load_workshop, varied

FLAT = jumpcad.Design.from_vector([100, 0.9595, 0.7772, 0.8377, 0.8, 70, 30, 16.808])
"""A robot that touches down nearly upright and crouches low."""


def caged(**values: float | str | bool) -> Robot:
    """Return that robot with a cage."""
    table = {f"cage.{key}": value for key, value in {"rod": "glass-1.5", **values}.items()}
    return jumpcad.build(FLAT, varied(load_workshop("default"), table))


@pytest.fixture(scope="module")
def robot() -> Robot:
    """Return the robot with a bow, which has all that a cage can have."""
    return caged(bow=True)


def test_a_hoop_is_an_arc_whose_chord_is_twice_r_sin_of_half_its_angle(robot: Robot) -> None:
    cage = robot.layout.of(Cage)
    assert cage is not None
    for arc in cage.arcs:
        mouths = arc.points_mm[[1, -2]]
        assert np.linalg.norm(mouths[1] - mouths[0]) == pytest.approx(
            2.0 * arc.radius_mm * abs(math.sin(arc.angle_rad / 2.0))
        )
        assert arc.length_mm == pytest.approx(arc.radius_mm * arc.angle_rad + 24.0)
        pieces = np.linalg.norm(np.diff(arc.points_mm, axis=0), axis=1)
        assert pieces[[0, -1]] == pytest.approx([SOCKET_MM, SOCKET_MM])
        assert 0.99 * arc.length_mm < pieces.sum() < arc.length_mm  # chords are shorter than their arcs


def test_rods_weigh_what_their_length_weighs_and_lie_in_the_body(robot: Robot) -> None:
    """Glass of 1.95 g/cm³: a millimetre of 1.5 mm rod weighs 3.446 mg."""
    for item in (item for item in robot.hardware if item.name.startswith(("cage_hoop", "cage_bow"))):
        length = float(item.article.split("cut ")[1].split(" mm")[0])
        assert item.body == BODY
        assert 1e6 * item.mass_kg == pytest.approx(3.446 * length, abs=1.8)
    bare = jumpcad.build(FLAT)
    assert 0.012 < robot.mass_kg - bare.mass_kg < 0.022  # 3 g of it are horns that bear a fall sideways


def test_the_outline_that_lands_first_is_that_of_the_arcs(robot: Robot) -> None:
    """A bow is round: no corner of its bounding box counts."""
    cage = robot.layout.of(Cage)
    assert cage is not None
    seen = robot.outline_m[BODY]
    bow = cage.arcs[-1].points_mm
    assert seen.imag.max() == pytest.approx(bow[:, 2].max() / 1000.0)
    corner = complex(bow[:, 0].max(), bow[:, 2].max()) / 1000.0
    assert np.abs(seen - corner).min() > 0.03


def test_the_loaded_robot_stands_on_its_feet_alone(robot: Robot) -> None:
    cage = robot.layout.of(Cage)
    assert cage is not None
    pose = body_poses(robot, 1.0)[BODY]
    points = np.concatenate([arc.points_mm for arc in cage.arcs]) / 1000.0
    assert (points @ pose[2, :3] + pose[2, 3]).min() > 0.003


def test_two_hoops_make_its_feet_the_pose_in_which_it_lies() -> None:
    assert share_on_feet(jumpcad.build(FLAT)) < 0.2
    hoops = caged()
    assert 0.8 < least_share_on_feet(hoops) <= share_on_feet(hoops)


def test_every_simulation_file_has_the_rods(robot: Robot) -> None:
    """Chords along every rod with its ends in the sockets, and both bars, welded to the body."""
    cage = robot.layout.of(Cage)
    assert cage is not None
    number = len(cage.arcs) * (len(cage.arcs[0].points_mm) - 1) + 2
    mjcf, urdf, sdf = (
        ET.fromstring(text) for text in (write_robot(robot, visuals(robot)), write_urdf(robot), write_sdf(robot))
    )
    body = next(node for node in mjcf.iter("body") if node.get("name") == BODY)
    capsules = [
        node for node in body.findall("geom") if "cage_" in node.get("name", "") and node.get("type") == "capsule"
    ]
    assert len(capsules) == number
    ends = np.array([[float(value) for value in (node.get("fromto") or "").split()] for node in capsules])
    rods = ends[: number - 2]
    assert np.linalg.norm(rods[:, 3:] - rods[:, :3], axis=1).sum() == pytest.approx(
        sum(arc.length_mm for arc in cage.arcs) / 1000.0, rel=0.002
    )
    for root, kind in ((urdf, "cylinder"), (sdf, "capsule")):
        link = next(node for node in root.iter("link") if node.get("name") == BODY)
        assert sum(1 for _ in link.iter(kind)) == number


@pytest.mark.thorough
def test_bill_and_guide_tell_what_to_cut_bend_and_tie(robot: Robot) -> None:
    cage, steps = robot.layout.of(Cage), {step.key: step for step in assembly_steps(robot)}
    assert cage is not None
    guide, names = "".join(write_guide(robot).values()), [line.name for line in bill_of_materials(robot).items]
    for arc in cage.arcs:
        assert f"pultruded glass fibre rod 1.5 mm, cut {arc.length_mm:.0f} mm long" in names
        assert f"{arc.name.removeprefix('cage_').replace('_', ' ')} {arc.length_mm:.0f} mm" in guide
    rods, told = 1.5, re.findall(r"hoop (\d+) wide, (\d+) over its bar's lower edge \(radius (\d+)\)", guide)
    for bar, arc, (width, height, radius) in zip(cage.bars, cage.arcs[:2], np.array(told, dtype=float), strict=True):
        seen = (arc.points_mm - bar.T_body_bar[:3, 3]) @ bar.T_body_bar[:3, :3]  # as a caliper measures it
        assert [width, height] == pytest.approx(
            [np.ptp(seen[:, 0]) + rods, seen[:, 1].max() + (rods + cage.bar_mm) / 2.0], abs=1.0
        )
        assert radius == pytest.approx(arc.radius_mm, abs=0.5)
    assert sum(thing.name.startswith("cage_") for thing in steps["cage"].added) == 2 + len(cage.arcs) + 4
    assert "rest" not in steps
    count, metres = map(int, re.search(r"from (\d) rods of (\d) m", guide).groups())  # type: ignore[union-attr]
    short, middle, _ = lengths = sorted(arc.length_mm for arc in cage.arcs)
    assert metres == 1
    assert count == (1 if sum(lengths) < 996.0 else 2 if short + middle < 998.0 else 3)  # a cut loses 2 mm


def test_a_caged_robot_is_laid_on_a_box_that_lifts_its_hoops_off_the_table(robot: Robot) -> None:
    cage = robot.layout.of(Cage)
    texts = (write_guide(robot)["trouble.md"], dict(firmware_files(robot))["firmware/README.md"])
    assert cage is not None
    rear, front = (bar.place_mm[0] for bar in cage.bars)
    for text in texts:
        assert "on its side" not in text
        length, height = map(float, re.search(r"at most (\d+) mm long, at least (\d+) mm high", text).groups())  # type: ignore[union-attr]
        assert length < front - rear
        assert height > robot.layout.lateral.outside[0] - min(arc.points_mm[:, 1].min() for arc in cage.arcs)


def test_bill_facts_and_steps_of_a_robot_without_a_cage_have_none(robot: Robot) -> None:
    bare = jumpcad.build(FLAT)
    assert "cage" not in {step.key for step in assembly_steps(bare)}
    assert cage_facts(bare) is None
    facts = cage_facts(robot)
    assert facts is not None
    cage = robot.layout.of(Cage)
    assert cage is not None
    assert [rod["length_mm"] for rod in facts["rods"]] == [pytest.approx(arc.length_mm, abs=0.05) for arc in cage.arcs]
    added = robot.mass_kg - bare.mass_kg
    assert 0.6 * added < facts["mass_kg"] < added  # the rest are horns


def test_what_cannot_be_made_is_refused_with_the_number() -> None:
    for values, told in (
        ({"front_radius_mm": 45.0}, "cage.front_radius_mm = 45: cage_bar_front reaches"),
        ({"rear_behind_mm": 100.0, "rear_radius_mm": 41.0, "arc_deg": 300.0}, "cage.rear_radius_mm = 41"),
    ):
        with pytest.raises(CannotBuildError, match=told):
            caged(**values)
    small = varied(load_workshop("best-jumper", "mini"), {"cage.bow": False})
    with pytest.raises(CannotBuildError, match=r"cage.rear_behind_mm .shorter horns., or no cage"):
        jumpcad.build(jumpcad.load_design("kenan-2.0"), small)
    for key, value in {"cage.rear_behind_mm": 20.0, "cage.rod": ""}.items():
        assert jumpcad.build(jumpcad.load_design("kenan-2.0"), varied(small, {key: value})), key
    for key, value in (("arc_deg", 90.0), ("rear_radius_mm", 5.0), ("rod", "bamboo")):
        with pytest.raises(jumpcad.JumpcadError, match=f"cage.{key}"):
            caged(**{key: value})


def test_quick_corners_span_the_hulls_of_the_meshes() -> None:
    """Of all parts of a robot, in every direction; of stacks no more than that, but for what pictures leave out."""
    rays = np.random.default_rng(0).normal(size=(50, 3))
    rays /= np.linalg.norm(rays, axis=1)[:, None]
    for thing in visuals(built("best-bo")):
        quick, exact = quick_corners_mm(thing) @ rays.T, thing.mesh.vertices @ rays.T
        beyond = np.asarray(quick.max(axis=0) - exact.max(axis=0))
        assert beyond.min() > -0.1, thing.name
        assert beyond.max() < 0.1 or not isinstance(thing.shape, Stack), thing.name
