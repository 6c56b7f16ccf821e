"""Bill of materials, order of assembly, guide: every thing on the robot, once."""

import csv
import io
import json
import re
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from jumpcad.building import build
from jumpcad.bundle.bom import BilledPlate, bill_of_facts, bill_of_materials, mass_facts, write_bom
from jumpcad.bundle.guide import with_bill, write_guide
from jumpcad.design import load_design
from jumpcad.robot import Robot
from jumpcad.scene.assembly_steps import REST, assembly_steps
from jumpcad.scene.visuals import visuals
from jumpcad.workshop import load_workshop


@pytest.fixture(scope="module", params=["kenan-2.0", "best-ga"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return build(load_design(request.param), name=request.param)


def rows(robot: Robot) -> list[dict[str, str]]:
    lines = table(write_bom(bill_of_materials(robot)))
    assert lines[-1]["kind"] == "total"
    return lines[:-1]


def table(bom: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(bom)))


def test_the_bill_weighs_what_the_robot_weighs(robot: Robot) -> None:
    grams = sum(float(row["grams"]) for row in rows(robot))
    assert grams == pytest.approx(1000.0 * robot.mass_kg, abs=0.0005 * len(rows(robot)))
    total = table(write_bom(bill_of_materials(robot)))[-1]
    assert float(total["grams"]) == pytest.approx(1000.0 * robot.mass_kg, abs=0.001)


def test_the_bill_counts_every_piece(robot: Robot) -> None:
    """A roller needs one nut and one washer, two plates two screws a standoff, two springs one of each hand."""
    quantity = {row["item"]: int(row["quantity"]) for row in rows(robot)}
    assert quantity["nut M3 ISO 4032"] == 1
    standoffs = sum(count for item, count in quantity.items() if item.startswith("standoff"))
    assert quantity["screw M3 x 10 ISO 7380-1"] == 2 * standoffs
    assert sum(count for item, count in quantity.items() if item.startswith("torsion spring")) == 2
    assert sum(count for item, count in quantity.items() if item.startswith("gear motor")) == 1
    axles = 3 if robot.layout is None or robot.layout.idler_mm is None else 4
    assert quantity["collar"] == 2 * axles


def test_every_thing_is_put_on_once_and_none_is_left_over(robot: Robot) -> None:
    steps = assembly_steps(robot)
    assert Counter(thing.name for step in steps for thing in step.added) == Counter(
        thing.name for thing in visuals(robot)
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


def test_nothing_costs_anything_unless_the_workshop_says_so(robot: Robot) -> None:
    lines = table(write_bom(bill_of_materials(robot)))
    assert {line["eur_each"] + line["eur"] + line["print_time_s"] for line in lines} == {""}
    assert lines[-1]["item"] == f"prices known of 0 of {len(lines) - 1} lines"
    assert "€" not in write_guide(robot)


def test_prices_of_a_users_file_are_multiplied_out(tmp_path: Path) -> None:
    """1 kg of filament at 25 €; a screw of 10 mm is dearer than the others; two bearings."""
    file = tmp_path / "mine.toml"
    file.write_text("""
        [materials.PETG]
        price_eur_per_kg = 25.0
        [prices_eur]
        "screw M3" = 0.05
        "screw M3 x 10" = 0.08
        "ball bearing MR63" = 1.5
    """)
    robot = build(load_design("kenan-2.0"), load_workshop(file))
    lines = table(write_bom(bill_of_materials(robot)))
    line = {line["item"]: line for line in lines}
    assert float(line["main_leg"]["eur"]) == pytest.approx(0.025 * float(line["main_leg"]["grams"]), abs=0.006)
    assert line["body_plate_left"]["eur"] == ""  # PLA
    assert line["screw M3 x 16 ISO 7380-1"]["eur_each"] == "0.050"
    screws = line["screw M3 x 10 ISO 7380-1"]
    assert float(screws["eur"]) == pytest.approx(0.08 * int(screws["quantity"]))
    assert line["ball bearing MR63"]["eur"] == "3.00"
    known = [line for line in lines[:-1] if line["eur"]]
    assert lines[-1]["item"] == f"prices known of {len(known)} of {len(lines) - 1} lines"
    assert float(lines[-1]["eur"]) == pytest.approx(sum(float(line["eur"]) for line in known), abs=0.005 * len(known))
    assert f"{lines[-1]['eur']} € together" in write_guide(robot)


def test_a_guide_takes_times_in_and_changes_nothing_else(robot: Robot) -> None:
    bill = bill_of_materials(robot)
    guide, sliced = write_guide(robot), bill.sliced({"foot": 5400.0}, [BilledPlate("plate-1-PETG", "PETG", 7260.0)])
    timed = with_bill(guide, sliced)
    assert re.search(r"\| foot \| 1 \| PETG \| [\d.]+ \| 1:30 h \|", timed)
    assert "| plate-1-PETG | PETG | 2:01 h |" in timed
    assert timed.split("## Springs")[1] == guide.split("## Springs")[1]
    assert with_bill(timed, bill) == guide


def test_a_manifest_keeps_the_whole_bill(robot: Robot) -> None:
    bill = bill_of_materials(robot)
    assert robot.workshop is not None
    assert bill_of_facts(json.loads(json.dumps(mass_facts(bill))), robot.workshop) == bill


def test_the_springs_ordered_are_those_of_the_design(robot: Robot) -> None:
    """Two springs side by side have twice the rate of one."""
    rate = re.search(r"- ([\d.]+) N·mm/° each; works from 0° to ([\d.]+)°", write_guide(robot))
    assert rate is not None
    assert 2 * float(rate[1]) == pytest.approx(robot.design.stiffness_nmm_per_deg, abs=0.011)
    assert float(rate[2]) == pytest.approx(robot.design.compression_rad * 57.29578, abs=0.06)
