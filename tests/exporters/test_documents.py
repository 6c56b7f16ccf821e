"""Bill of materials, order of assembly, guide: every thing on the robot, once."""

import csv
import io
import re
from collections import Counter
from dataclasses import replace

import pytest

from jumpcad.assembly import build
from jumpcad.design import load_design
from jumpcad.exporters.bom import write_bom
from jumpcad.exporters.guide import write_guide
from jumpcad.exporters.shapes import shapes
from jumpcad.exporters.steps import REST, assembly_steps
from jumpcad.robot import Robot


@pytest.fixture(scope="module", params=["kenan-2.0", "best-ga"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return build(load_design(request.param), name=request.param)


def rows(robot: Robot) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(write_bom(robot))))


def test_the_bill_weighs_what_the_robot_weighs(robot: Robot) -> None:
    grams = sum(float(row["grams"]) for row in rows(robot))
    assert grams == pytest.approx(1000.0 * robot.mass_kg, abs=0.0005 * len(rows(robot)))


def test_the_bill_counts_every_piece(robot: Robot) -> None:
    """A roller needs one nut and one washer, two plates two screws a standoff, two springs one of each hand."""
    quantity = {row["item"]: int(row["quantity"]) for row in rows(robot)}
    assert quantity["nut M3 ISO 4032"] == 1
    standoffs = sum(count for item, count in quantity.items() if item.startswith("standoff"))
    assert quantity["screw M3 x 10 ISO 7380-1"] == 2 * standoffs
    assert sum(count for item, count in quantity.items() if item.startswith("torsion spring")) == 2
    assert sum(count for item, count in quantity.items() if item.startswith("gear motor")) == 1
    axles = 3 if robot.plan is None or robot.plan.idler_mm is None else 4
    assert quantity["collar"] == 2 * axles


def test_every_thing_is_put_on_once_and_none_is_left_over(robot: Robot) -> None:
    steps = assembly_steps(robot)
    assert Counter(thing.name for step in steps for thing in step.added) == Counter(
        thing.name for thing in shapes(robot)
    )
    assert all(step.title != REST[0] for step in steps)


def test_what_no_step_knows_is_not_forgotten(small_robot: Robot) -> None:
    strange = replace(small_robot.hardware[0], name="antenna")
    last = assembly_steps(replace(small_robot, hardware=(*small_robot.hardware, strange)))[-1]
    assert last.title == REST[0]
    assert "antenna" in {thing.name for thing in last.added}


def test_the_guide_names_all_that_the_bill_names(robot: Robot) -> None:
    guide = write_guide(robot)
    tables, steps = guide.split("## 1. ")
    for row in rows(robot):
        assert row["item"] in tables
        counted = sum(int(n) for n in re.findall(rf"^- (\d+) × {re.escape(row['item'])}$", steps, re.MULTILINE))
        assert counted == int(row["quantity"]), row["item"]
    assert "pictures/" not in write_guide(robot, pictures=False)


def test_the_springs_ordered_are_those_of_the_design(robot: Robot) -> None:
    """Two springs side by side have twice the rate of one."""
    rate = re.search(r"- ([\d.]+) N·mm/° each; works from 0° to ([\d.]+)°", write_guide(robot))
    assert rate is not None
    assert 2 * float(rate[1]) == pytest.approx(robot.design.stiffness_nmm_per_deg, abs=0.011)
    assert float(rate[2]) == pytest.approx(robot.design.compression_rad * 57.29578, abs=0.06)
