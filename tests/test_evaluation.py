"""From eight numbers to the jump of the robot that is printed from them."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.places import ROOT
from support.workshops import workshop_with

from jumpcad import evaluation
from jumpcad.building import build, built_and_checked
from jumpcad.checks import constraint_findings
from jumpcad.checks.interference import pieces_of
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.exporters.loop_file import write_loop
from jumpcad.exporters.urdf import write_urdf
from jumpcad.files import template_names
from jumpcad.findings import errors
from jumpcad.mechanism.model import body_poses
from jumpcad.scene.visuals import extent_m
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.from_urdf import robot_from_urdf
from jumpcad.transforms import in_metres
from jumpcad.workshop import load_workshop, own_workshop

KENAN = load_design("kenan-2.0")
TEMPLATES = sorted(template_names("robots"), key=lambda name: load_workshop(own_workshop(name)).cage.rod == "")
"""Those with a cage first."""
FEEBLE = Design.from_vector([158.0, 1.16, 0.7, 0.96, 0.25, 60.0, 5.0, 30.0])
"""A large robot with 5 N·mm/° whose springs are hardly loaded."""


@pytest.mark.parametrize("name", TEMPLATES)
def test_the_jump_is_that_of_the_robot_that_is_written(name: str, tmp_path: Path) -> None:
    """Feasibility, build and simulation in one; and the URDF on disk, read back and simulated."""
    design, workshop = load_design(name), load_workshop(own_workshop(name))
    found, robot = evaluate(design, workshop), build(design, workshop, name="")
    assert found.jump == simulate(robot)
    robot = replace(robot, name="robot")
    urdf = tmp_path / "robot.urdf"
    urdf.write_text(write_urdf(robot), encoding="utf-8")
    urdf.with_suffix(".loop.json").write_text(write_loop(robot), encoding="utf-8")
    again = simulate(robot_from_urdf(urdf))
    assert found.verdict == again.verdict == "jump"
    assert found.jump.ballistic_range_m == pytest.approx(again.ballistic_range_m, rel=1e-9)
    assert found.jump.com_rise_m == pytest.approx(again.com_rise_m, rel=1e-9)
    assert found.jump.mass_kg == pytest.approx(again.mass_kg, rel=1e-12)
    assert found.fitness == pytest.approx(1000.0 * again.ballistic_range_m / robot.design.l_max_mm)


def test_its_masses_are_those_of_its_parts() -> None:
    found = evaluate(KENAN)
    pieces = sum(part.mass_kg * part.quantity for part in found.robot.parts)
    pieces += sum(item.mass_kg for item in found.robot.hardware)
    assert found.metrics["mass_kg"] == pytest.approx(pieces) == pytest.approx(found.jump.mass_kg)
    assert sum(v for k, v in found.metrics.items() if k.endswith("_mass_kg")) == pytest.approx(pieces)


def test_its_body_length_is_that_of_the_standing_robot() -> None:
    """A short leg about the same battery has the size of what it carries; long links about it have their own."""
    for name in ("kenan-2.0", "best-printable"):
        found = evaluate(load_design(name))
        robot, bodies = found.robot, body_poses(found.robot)
        boxes = []
        for piece in pieces_of(robot):  # another program's boxes of the solids, placed one by one
            pose = bodies[piece.body] @ in_metres(piece.T_body_part)
            boxes.append(piece.solid.scale([0.001] * 3).transform(pose[:3]).bounding_box())
        corners = np.array(boxes)
        extent = corners[:, 3:].max(axis=0) - corners[:, :3].min(axis=0)
        assert extent_m(robot) == pytest.approx(extent, abs=1e-5)
        assert found.metrics["size_m"] == pytest.approx(max(extent.max(), robot.design.l_max_mm / 1000.0), abs=1e-5)
        assert found.body_lengths == pytest.approx(found.jump.touchdown_distance_m / found.metrics["size_m"])
        assert found.body_lengths <= found.fitness


def test_winding_needs_more_energy_than_the_springs_hold() -> None:
    """And the motor is not switched on for more than a minute."""
    found = evaluate(KENAN)
    assert found.metrics["electrical_energy_j"] > KENAN.spring_energy_j
    assert found.jump.spring_energy_j == pytest.approx(KENAN.spring_energy_j)
    assert 0.5 < found.metrics["winding_time_s"] < 60.0
    assert 0.0 < found.jump.takeoff_energy_ratio < 1.0


def test_the_workshop_decides_what_it_weighs_and_how_far_it_jumps() -> None:
    solid = evaluate(KENAN, workshop_with(mass={"model": "solid"}))
    printed = evaluate(KENAN)
    assert solid.metrics["mass_kg"] > printed.metrics["mass_kg"]
    assert solid.fitness < printed.fitness


def test_the_settings_and_the_engine_are_passed_on() -> None:
    slippery = evaluate(KENAN, settings=Settings(foot_friction=0.3))
    assert slippery != evaluate(KENAN) == evaluate(KENAN)
    assert slippery.fitness < 0.9 * evaluate(KENAN).fitness
    needs.package("mujoco")
    other = evaluate(KENAN, engine="mujoco")
    assert other.jump.engine == "mujoco"
    assert other.fitness == pytest.approx(evaluate(KENAN).fitness, rel=0.01)


@pytest.mark.parametrize(
    ("design", "reason"),
    [
        (KENAN.model_copy(update={"c_coef": 1.5, "d_coef": 0.3}), "loop: "),
        (KENAN.model_copy(update={"c_coef": 1.03, "d_coef": 0.5, "compression_ratio": 0.8}), "below_ground: "),
        (KENAN.model_copy(update={"stiffness_nmm_per_deg": 120.0}), "no wire of "),
        (Design.from_vector([105.3, 1.035, 0.57, 1.21, 0.756, 46.9, 5.2, 14.5]), "main leg and front link overlap by "),
    ],
)
def test_what_cannot_be_built_is_refused_by_name(design: Design, reason: str) -> None:
    with pytest.raises(CannotBuildError, match=rf"^{reason}.*: (lower|raise) \w+"):
        evaluate(design)


def test_what_can_be_built_but_not_jump_has_a_verdict_and_no_fitness() -> None:
    short_toes = KENAN.model_copy(update={"e_coef": 0.3, "ground_link_angle_deg": 85.0})
    for design, verdict in ((FEEBLE, "too_weak"), (short_toes, "tips")):
        found = evaluate(design)
        assert found.verdict == verdict
        assert found.fitness == found.body_lengths == 0.0
        assert found.jump.ballistic_range_m is None
        refused = [finding.name for finding in found.findings if finding.severity == "error" and finding.margin < 0]
        assert verdict in refused


def test_springs_that_cannot_raise_a_body_are_refused_before_anything_is_drawn(monkeypatch):
    """The verdict of the whole robot; the rest is computed when it is asked for."""
    drawn = []

    def counted(*given, name):
        drawn.append(name)
        return built_and_checked(*given, name)

    monkeypatch.setattr(evaluation, "built_and_checked", counted)
    found = evaluate(FEEBLE)
    assert (found.verdict, found.fitness, found.body_lengths, drawn) == ("too_weak", 0.0, 0.0, [])
    assert (found.jump.verdict, found.robot.design, len(drawn)) == ("too_weak", FEEBLE, 1)
    tight = evaluate(Design.from_vector([105.3, 1.035, 0.57, 1.21, 0.756, 46.9, 0.2, 14.5]))
    assert [one.name for one in tight.findings] == ["loop", "below_ground", "too_weak"]
    with pytest.raises(CannotBuildError, match="no motor turns the cam"):
        _ = tight.metrics
    for one, other in ((found, tight), (evaluate(KENAN), found)):  # refused or not, built or not
        again = evaluate(KENAN if other is found else FEEBLE)
        assert (one == again, hash(one) == hash(again), one == other) == (True, True, False)
    for wrong in ({"engine": "bullet"}, {"settings": Settings().model_copy(update={"dt_s": -1.0})}):
        with pytest.raises(JumpcadError):
            evaluate(FEEBLE, **wrong)


@pytest.mark.thorough
def test_the_verdict_is_that_of_the_jump_of_the_robot_as_built() -> None:
    """Of any design, refused early or not: springs that are too weak come before a robot that tips over."""
    generator, both = np.random.default_rng(3), 0
    low, high = np.array([(one.lower, one.upper) for one in SEARCH_BOUNDS.values()]).T
    for _ in range(30):
        design = Design.from_vector(generator.uniform(low, high))
        try:
            found = evaluate(design, engine="planar")
            assert found.verdict == found.jump.verdict, design
        except CannotBuildError:
            continue
        both += {"tips", "too_weak"} <= {one.name for one in errors(found.jump.findings)}
    assert both > 1


def test_every_cheap_check_is_among_its_findings() -> None:
    found = evaluate(KENAN)
    names = [finding.name for finding in found.findings]
    assert {"loop", "below_ground", "tips", "too_weak", "audit_energy", "audit_loop"} <= set(names)
    checked = constraint_findings(found.robot)
    assert [finding for finding in found.findings if finding in checked] == checked
    assert len(names) == len(set(names))


@pytest.mark.thorough
def test_the_same_document_in_another_process() -> None:
    code = "import json, jumpcad; print(json.dumps(jumpcad.evaluate(jumpcad.load_design('best-bo')).to_dict()))"
    there = subprocess.run(
        [sys.executable, "-c", code],
        check=True, capture_output=True, text=True, cwd=ROOT,
        env={**os.environ, "PYTHONHASHSEED": "7"},
    ).stdout  # fmt: skip
    assert json.loads(there) == json.loads(json.dumps(evaluate(load_design("best-bo")).to_dict()))


def test_electricity_is_voltage_times_mean_current_times_time() -> None:
    result = evaluate(load_design("kenan-2.0"))
    train = result.robot.layout.drive.train
    battery_v, boards_a = 3.7, 0.024 + 0.0017
    power = battery_v * (train.mean_current_a + boards_a)
    assert result.metrics["electrical_energy_j"] == pytest.approx(power * result.metrics["winding_time_s"], rel=1e-9)
    parts = result.metrics["motor_energy_j"] + result.metrics["boards_energy_j"]
    assert result.metrics["electrical_energy_j"] == pytest.approx(parts)
