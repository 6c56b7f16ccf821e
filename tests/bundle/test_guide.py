"""assembly.md: everything in the bill of materials is in the guide, and the springs ordered are those of the design."""

import re

import pytest
from support.built import built

from jumpcad.bundle.bom import BilledPlate, bill_of_materials
from jumpcad.bundle.guide import with_bill, write_guide
from jumpcad.robot import Robot


@pytest.fixture(scope="module", params=["kenan-2.0", "best-ga"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


def test_the_guide_names_all_that_the_bill_names(robot: Robot) -> None:
    guide = write_guide(robot)
    tables, steps = guide.split("## 1. ")
    for item in bill_of_materials(robot).items:
        assert item.name in tables
        counted = sum(int(n) for n in re.findall(rf"^- (\d+) × {re.escape(item.name)}$", steps, re.MULTILINE))
        assert counted == item.quantity, item.name
    assert "pictures/" not in write_guide(robot, pictures=False)


def test_a_guide_takes_times_in_and_changes_nothing_else(robot: Robot) -> None:
    bill = bill_of_materials(robot)
    guide, sliced = write_guide(robot), bill.sliced({"foot": 5400.0}, [BilledPlate("plate-1-PETG", "PETG", 7260.0)])
    timed = with_bill(guide, sliced)
    assert re.search(r"\| foot \| 1 \| PETG \| [\d.]+ \| 1:30 h \|", timed)
    assert "| plate-1-PETG | PETG | 2:01 h |" in timed
    assert timed.split("## Springs")[1] == guide.split("## Springs")[1]
    assert with_bill(timed, bill) == guide


def test_the_springs_ordered_are_those_of_the_design(robot: Robot) -> None:
    """Two springs side by side have twice the rate of one."""
    rate = re.search(r"- ([\d.]+) N·mm/° each; works from 0° to ([\d.]+)°", write_guide(robot))
    assert rate is not None
    assert 2 * float(rate[1]) == pytest.approx(robot.design.stiffness_nmm_per_deg, abs=0.011)
    assert float(rate[2]) == pytest.approx(robot.design.compression_rad * 57.29578, abs=0.06)
