"""Bill of materials: every thing on the robot, once; prices; what a manifest keeps of it."""

import csv
import io
import re
from dataclasses import replace
from pathlib import Path

import pytest
from support.built import built

from jumpcad.building import build
from jumpcad.building.bom import SlicedPlate, bill_of_facts, bill_of_materials, write_bom
from jumpcad.bundle.guide.markdown import bill_text
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.files.reading import BOM
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop


def rows(robot: Robot) -> list[dict[str, str]]:
    lines = table(write_bom(bill_of_materials(robot)))
    assert lines[-1]["kind"] == "total"
    return [line for line in lines[:-1] if line["kind"] != "used up"]


def table(bom: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(bom.removeprefix(BOM))))


def test_the_bill_weighs_what_the_robot_weighs(robot: Robot) -> None:
    grams = sum(float(row["grams"]) for row in rows(robot))
    assert grams == pytest.approx(1000.0 * robot.mass_kg, abs=0.0005 * len(rows(robot)))
    total = table(write_bom(bill_of_materials(robot)))[-1]
    assert float(total["grams"]) == pytest.approx(1000.0 * robot.mass_kg, abs=0.001)


def test_the_bill_counts_every_piece(robot: Robot) -> None:
    """A roller needs one nut and one washer, two plates two screws per standoff, two springs one of each hand."""
    quantity = {row["item"]: int(row["quantity"]) for row in rows(robot)}
    assert quantity["lock nut M3 DIN 985"] == 1
    standoffs = sum(count for item, count in quantity.items() if item.startswith("standoff"))
    assert quantity["screw M3 x 8 ISO 7380-1"] == 2 * standoffs
    assert sum(count for item, count in quantity.items() if item.startswith("torsion spring")) == 2
    assert sum(count for item, count in quantity.items() if item.startswith("gear motor")) == 1
    axles = 3 if robot.layout.idler_mm is None else 4
    assert sum(count for item, count in quantity.items() if item.startswith("spring steel rod")) == axles + 1
    assert quantity["split pin 0.8 x 10 ISO 1234"] == 3  # ankle, front eye, springs' pin in the leg


def test_prices_of_a_users_file_are_multiplied_out(tmp_path: Path) -> None:
    """1 kg of filament at 25 €; a screw of 8 mm costs more than the others; two bearings."""
    file = tmp_path / "mine.toml"
    file.write_text("""
        [materials.PETG]
        price_eur_per_kg = 25.0
        [prices_eur]
        "screw M3" = 0.05
        "screw M3 x 8" = 0.08
        "ball bearing MR63" = 1.5
    """)
    robot = build(load_design("kenan-2.0"), load_workshop(file))
    lines = table(write_bom(bill_of_materials(robot)))
    line = {line["item"]: line for line in lines}
    assert float(line["main_leg"]["eur"]) == pytest.approx(0.025 * float(line["main_leg"]["grams"]), abs=0.006)
    assert (line["main_leg"]["price_from"], line["body_plate_left"]["price_from"]) == ("workshop", "estimate")
    motor = next(line for line in lines if line["item"].startswith("gear motor n20-298-mp"))
    assert motor["price_from"] == "Pololu 2371, 2026-10-10"
    assert float(motor["eur"]) == pytest.approx(0.9 * 23.95, abs=0.01)  # the page's dollars
    assert line["screw M3 x 16 ISO 7380-1"]["eur_each"] == "0.050"
    screws = line["screw M3 x 8 ISO 7380-1"]
    assert float(screws["eur"]) == pytest.approx(0.08 * int(screws["quantity"]))
    assert line["ball bearing MR63 ZZ, 3 x 6 x 2.5 mm"]["eur"] == "3.00"
    priced, total = [line for line in lines[:-1] if line["eur"]], float(lines[-1]["eur"])
    assert total == pytest.approx(sum(float(line["eur"]) for line in priced), abs=0.005 * len(priced))
    known = sum(float(line["eur"]) for line in priced if line["price_from"] != "estimate")
    share = float(re.match(r"(\d+) % of it by known prices", lines[-1]["item"])[1])  # type: ignore[index]
    assert share == pytest.approx(100.0 * known / total, abs=0.6)
    assert f"{lines[-1]['eur']} € together" in bill_text(bill_of_materials(robot))


def test_a_price_of_nothing_is_refused_with_the_nearest_name() -> None:
    robot = built("kenan-2.0")
    for key, words in (("scerw M3", "did you mean screw M3"), ("n20-298-mp", "did you mean 'gear motor n20-298-mp"),
                       ("xyz", "no article's name begins so;")):  # fmt: skip
        shop = robot.workshop.model_copy(update={"prices_eur": {key: 1.0}})
        with pytest.raises(JumpcadError, match=words):
            bill_of_materials(replace(robot, workshop=shop))
    elsewhere = robot.workshop.model_copy(update={"prices_eur": {"Schottky": 1.0, "ball bearing": 2.0}})
    assert bill_of_materials(replace(robot, workshop=elsewhere)).cost_eur  # the other kit has a diode


def test_springs_cost_what_is_ordered_of_them(robot: Robot) -> None:
    """Two of each hand at 10 €, of which the robot has one: 40 €, in the bill, its total and the guide alike."""
    shop = robot.workshop.model_copy(update={"prices_eur": {"torsion spring": 10.0}})
    dear = replace(robot, workshop=shop)
    lines, total = rows(dear), table(write_bom(bill_of_materials(dear)))[-1]
    springs = [line for line in lines if line["item"].startswith("torsion spring")]
    assert [(line["quantity"], line["ordered"], line["eur_each"], line["eur"]) for line in springs] == [
        ("1", "2", "10.000", "20.00")
    ] * 2
    assert all("2 in all" in line["item"] for line in springs)
    alone = [line for line in lines if line not in springs and not line["item"].startswith("ball bearing 623")]
    assert all(line["ordered"] == line["quantity"] for line in alone)
    assert float(total["eur"]) == pytest.approx(sum(float(line["eur"]) for line in lines), abs=0.3)
    guide = bill_text(bill_of_materials(dear))
    assert guide.count("|20.00 €|\n") == 2


def test_what_is_there_already_costs_nothing_and_is_not_ordered(robot: Robot) -> None:
    """A price of 0 leaves an article out of cost and order; the robot has it as before."""
    before = bill_of_materials(robot)
    shop = robot.workshop.model_copy(update={"prices_eur": {"torsion spring": 0.0, "gear motor": 0.0}})
    bill = bill_of_materials(replace(robot, workshop=shop))
    there = [item for item in bill.items if item.name.startswith(("torsion spring", "gear motor"))]
    assert {item.ordered for item in there} == {0}
    dear = sum(item.total_eur or 0.0 for item in before.items if item.name.startswith(("torsion spring", "gear motor")))
    assert before.cost_eur is not None
    assert bill.cost_eur == pytest.approx(before.cost_eur - dear)
    assert bill.mass_kg == before.mass_kg
    text = bill_text(bill)
    assert not any(line.startswith("|") and "torsion spring" in line for line in text.splitlines())
    assert "There already, not ordered: " in text


def test_what_is_sold_in_packs_is_ordered_in_packs() -> None:
    """Three bearings of a pack of 20 at 9.99 dollars cost the pack; a price of one's own is of a piece."""
    facts = {"kind": "bought", "name": "ball bearing 623", "quantity": 3, "material": "", "mass_kg": 0.0, "source": ""}
    shop = load_workshop()
    pack = bill_of_facts([facts], shop)
    assert (pack.items[0].ordered, pack.cost_eur, pack.known_share) == (20, pytest.approx(0.9 * 9.99), 1.0)
    assert "|3|ball bearing 623|8.99 € for 20 (" in bill_text(pack)
    own = bill_of_facts([facts], shop.model_copy(update={"prices_eur": {"ball bearing": 2.0}}))
    assert (own.items[0].ordered, own.cost_eur) == (3, 6.0)


def test_filament_is_paid_by_the_mass_of_all_pieces() -> None:
    """Two pieces of 10 g at 20 EUR/kg are 0.20 EUR each."""
    shop = load_workshop()
    material = shop.material_name("links")
    priced = shop.materials[material].model_copy(update={"price_eur_per_kg": 20.0})
    facts = {"kind": "printed", "name": "toe", "quantity": 2, "material": material, "mass_kg": 0.01, "source": "layers"}
    bill = bill_of_facts([facts], shop.model_copy(update={"materials": {**shop.materials, material: priced}}))
    assert (bill.items[0].price_eur, bill.cost_eur) == pytest.approx((0.2, 0.4))


def test_printing_times_are_of_one_copy_and_add_up_by_plates(robot: Robot) -> None:
    """In whole seconds: of what is printed and was sliced; those of the plates make the total."""
    bill = bill_of_materials(robot)
    plates = [SlicedPlate("plate-1-PETG", "PETG", 9.0, 7260.4), SlicedPlate("plate-1-PLA", "PLA", 1.0, 900.2)]
    *lines, total = table(write_bom(bill.sliced({"foot": 5400.4, "lock nut M3 DIN 985": 9.0}, plates)))
    assert [(line["item"], line["print_time_s"]) for line in lines if line["print_time_s"]] == [
        ("foot", "5400"), ("plate-1-PETG", "7260"), ("plate-1-PLA", "900"),
    ]  # fmt: skip
    for line, plate in zip(lines[-2:], plates, strict=True):
        assert {key: value for key, value in line.items() if value} == {
            "kind": "plate", "item": plate.name, "quantity": "1", "material": plate.material,
            "print_time_s": f"{plate.time_s:.0f}",
        }  # fmt: skip
    assert total["print_time_s"] == "8161"
    assert float(total["grams"]) == pytest.approx(1000.0 * robot.mass_kg, abs=0.001)
