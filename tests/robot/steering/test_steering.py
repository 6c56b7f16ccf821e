"""The steering wheel: deep enough, in every file alike, and turning the robot as geometry says."""

import math
import re
import xml.etree.ElementTree as ET
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.each import each

import jumpcad
from jumpcad.building.bom import bill_of_materials
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.exporters.mjcf_robot import write_robot
from jumpcad.exporters.ros2 import ros2_files
from jumpcad.exporters.urdf import urdf_files
from jumpcad.landing.arena import Arena, Floor
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.limits import steering_findings, steers
from jumpcad.robot.steering.place import Steering
from jumpcad.scene.visuals import visuals
from jumpcad.search.space import Space
from jumpcad.simulation.from_urdf import robot_from_urdf
from jumpcad.steps.assembly_steps import assembly_steps
from jumpcad.workshop import load_workshop, varied

FLOORS = ((0.8, 0.0005), (0.5, 0.004), (0.65, 0.008), (1.1, 0.0005))
"""Friction, and time constant of the contact (s)."""


@lru_cache(maxsize=8)
def steered(name: str = "best-jumper", wheel: str = "o-ring", **table: float | str) -> Robot:
    """Return a template with a wheel."""
    design = jumpcad.load_design(name)
    values = {f"steering.{key}": value for key, value in {"wheel": wheel, **table}.items()}
    return jumpcad.build(design, varied(load_workshop(design.workshop_name or "default"), values))


def place_of(robot: Robot) -> Steering:
    """Return where its wheel is."""
    place = robot.layout.of(Steering)
    assert place is not None
    return place


@pytest.mark.thorough
@each("name", ["best-jumper", "kenan-2.0", "best-printable", "first-robot", "best-upright"])
def test_a_wheel_dips_as_far_as_said_with_loaded_springs_and_is_high_at_rest(name: str) -> None:
    """Of the exported file alone: the wheel's centre seen from the foot, whose sole lies as deep as its contacts."""
    mujoco = needs.package("mujoco")
    robot = steered(name)
    model = mujoco.MjModel.from_xml_string(write_robot(robot, visuals(robot), looks=False, floor=True))
    data, bottoms = mujoco.MjData(model), {}
    for key in ("home", "wound"):
        mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
        mujoco.mj_forward(model, data)
        foot, wheel, eye = data.body("foot"), data.geom("wheel_rim_collision"), model.geom("foot_front_eye_collision")
        seen = foot.xmat.reshape(3, 3).T @ (wheel.xpos - foot.xpos)
        bottoms[key] = 1000.0 * (seen[2] + eye.size[0] - model.geom("wheel_rim_collision").size[1])
    place = place_of(robot)
    assert bottoms["wound"] == pytest.approx(-place.dip_mm, abs=0.01)
    assert bottoms["home"] > 10.0
    sole = data.geom("wheel_rim_collision").xpos[2] - model.geom("wheel_rim_collision").size[1]
    assert 1000.0 * sole == pytest.approx(0.0, abs=0.02)  # of the key `wound`, which stands on wheel and front eye
    least = next(one for one in steering_findings(robot) if one.name == "steering_touch")
    assert least.value == pytest.approx(place.dip_mm - place.miss_mm)
    assert least.severity == "info"


@pytest.mark.thorough
@each(("name", "right"), [("kenan-2.0", 0.03), ("best-upright", 0.03), ("best-jumper", 0.2)])
def test_the_wheel_turns_the_robot_on_four_floors_as_geometry_says(name: str, right: float) -> None:
    """To the left within 5 %; to the right too, but of a robot that leans by 5° and rocks between its toes there."""
    mujoco = needs.package("mujoco")
    robot = steered(name)
    text = write_robot(robot, visuals(robot), looks=False, floor=True)
    for friction, softness_s in FLOORS:
        for way in (1.0, -1.0):
            model = mujoco.MjModel.from_xml_string(text)
            model.geom_friction[:, 0] *= friction / robot.workshop.ground.friction
            model.geom_solref[:] = softness_s, 1.0
            data = mujoco.MjData(model)
            mujoco.mj_resetDataKeyframe(model, data, model.key("wound").id)
            data.eq_active[model.equality("latch").id] = 1
            mujoco.mj_step(model, data, nstep=2000)
            wheel, front = data.body("wheel").xpos.copy(), data.geom("foot_front_eye_collision").xpos.copy()
            lever, radius = math.dist(wheel[:2], front[:2]), model.geom("wheel_rim_collision").size[1]
            begin = data.joint("steer").qpos[0], math.atan2(*data.body("body").xmat[[3, 0]])
            data.actuator("steer").ctrl = 4.0 * way
            mujoco.mj_step(model, data, nstep=8000)
            revolutions = (data.joint("steer").qpos[0] - begin[0]) / (2.0 * math.pi)
            turned = math.degrees(math.atan2(*data.body("body").xmat[[3, 0]]) - begin[1]) / revolutions
            assert turned / (360.0 * radius / lever) == pytest.approx(1.0, abs=0.05 if way > 0.0 else right)
            assert data.body("foot").xmat[8] > math.cos(math.radians(10.0))
    assert place_of(robot).turn_per_rev_deg == pytest.approx(360.0 * radius / lever, rel=0.01)


@pytest.mark.thorough
def test_supports_bear_what_simulated_contacts_bear() -> None:
    """The wheel in the middle, and aside, where the toe bears more."""
    needs.package("mujoco")
    toes = []
    for aside_mm in (0.0, 5.0):
        robot = steered(aside_mm=aside_mm)
        arena = Arena(robot)
        arena.stand_on(Floor())
        arena.stand()
        arena.step(5.0)
        found = dict.fromkeys(("eye", "rim", "toe"), 0.0)
        for _ in range(2000):
            arena.step(0.0)
            for number, contact in enumerate(arena.data.contact[: arena.data.ncon]):
                force, name = np.zeros(6), arena.model.geom(int(contact.geom.max())).name
                arena._mujoco.mj_contactForce(arena.model, arena.data, number, force)
                found[next((part for part in ("rim", "toe") if part in name), "eye")] += float(force[0]) / 2000.0
        loads = steers(robot).loads_n
        assert loads.sum() == pytest.approx(robot.mass_kg * GRAVITY_M_S2)
        assert list(found.values()) == pytest.approx(loads.tolist(), abs=0.05 * loads.sum())
        toes.append(found["toe"])
    assert toes[1] - toes[0] > 0.1


@pytest.mark.thorough
def test_files_carry_the_wheel_and_weigh_what_the_robot_weighs(tmp_path: Path) -> None:
    robot = steered()
    text = write_robot(robot, visuals(robot), looks=False)
    root = ET.fromstring(text)
    masses = [float(one.get("mass", "")) for one in root.iter("inertial")]
    assert (len(masses), sum(masses)) == (5, pytest.approx(robot.mass_kg, rel=1e-9))
    assert [one.get("name") for one in root.iter("velocity")] == ["steer"]
    for path, content in urdf_files(robot):
        file = tmp_path / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
    (urdf,) = tmp_path.rglob("*.urdf")
    read = robot_from_urdf(urdf).bodies["body"]  # the wheel is welded to it again
    assert read.mass_kg == pytest.approx(robot.bodies["body"].mass_kg, rel=1e-12)
    assert read.com_m == pytest.approx(robot.bodies["body"].com_m, abs=1e-12)
    assert read.inertia_kg_m2 == pytest.approx(robot.bodies["body"].inertia_kg_m2, rel=1e-9)
    yaml = next(str(text) for path, text in ros2_files(robot) if path.endswith("controllers.yaml"))
    assert re.findall(r"interface_name: (\w+)", yaml) == ["effort", "velocity"]
    assert not [step for step in assembly_steps(robot) if step.key == "rest"]
    bought = [item.name for item in bill_of_materials(robot).items]
    assert any(name.startswith("O-ring 14 x 2.65") for name in bought)
    pins = robot.wiring.pins
    assert len(set(pins.values())) == len(pins) == 6
    ends = {str(end) for net in robot.wiring.nets for end in net.terminals}
    assert {"driver BIN1", "driver BIN2", "steering motor +", "steering motor -"} <= ends


def test_without_a_wheel_its_sizes_change_nothing() -> None:
    plain, sized = (steered("kenan-2.0", "none", **table) for table in ({}, {"dip_mm": 2.0, "base_mm": 5.0}))
    assert write_robot(plain, visuals(plain)) == write_robot(sized, visuals(sized))
    assert [part.name for part in plain.parts] == [part.name for part in sized.parts]
    assert not [part for part in (*plain.parts, *plain.hardware) if part.name.startswith("steering")]


def test_a_wheel_without_room_ring_or_sensor_is_refused_with_a_reason() -> None:
    for table, words in (({"behind_mm": 20.0}, "no room behind the toes"), ({"radius_mm": 5.0}, "the smallest ring")):
        with pytest.raises(CannotBuildError, match=words):
            steered("kenan-2.0", **table)
    workshop = varied(load_workshop("default"), {"steering.wheel": "o-ring", "bought.sensor": ""})
    with pytest.raises(CannotBuildError, match=r"name one in bought\.sensor"):
        jumpcad.build(jumpcad.load_design("kenan-2.0"), workshop)
    with pytest.raises(JumpcadError, match=r"fix steering\.wheel too"):
        Space.make(workshop=load_workshop("default"), bounds={"steering.dip_mm": (0.5, 2.0)})


def test_a_wheel_that_cannot_reach_the_floor_is_an_error() -> None:
    """Each tenth of a millimetre of dip is one of margin, and no figure hides that one is lacking."""
    deep, flat = steered("kenan-2.0"), steered("kenan-2.0", dip_mm=1.0)
    margins = [steers(robot).figures["steering_margin_mm"] for robot in (deep, flat)]
    assert margins[0] - margins[1] == pytest.approx(place_of(deep).dip_mm - 1.0, abs=0.02)
    assert "steering_touch" in {one.name for one in steering_findings(flat) if one.severity == "error"}
