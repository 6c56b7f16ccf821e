"""What is ordered and cut, settings and masses: figures of shops, data sheets and the workshop."""

import re
from collections import Counter
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from jumpcad.bundle.ordering import _stock, order_lines, print_lines, weigh_lines
from jumpcad.bundle.tools import tool_lines
from support.built import built

from jumpcad.building import build
from jumpcad.bundle.bom import bill_of_materials
from jumpcad.bundle.drawings.wiring import wires
from jumpcad.design import load_design
from jumpcad.exporters.threemf import plate_files
from jumpcad.layout.leg_bars import END_PLAY_MM
from jumpcad.parts.part import Part
from jumpcad.robot import Robot
from jumpcad.workshop import load_workshop


@cache
def order() -> str:
    return "\n".join(order_lines(built("kenan-2.0")))


def with_article(robot: Robot, pattern: str, replacement: str) -> Robot:
    hardware = tuple(replace(item, article=re.sub(pattern, replacement, item.article)) for item in robot.hardware)
    return replace(robot, hardware=hardware)


@pytest.mark.parametrize(
    ("length", "stock"),
    [("20.0", "20"), ("20.1", "25"), ("32.9", "35"), ("45.5", "50"), ("51.0", "60"), ("60.0", "60"), ("71.2", "72")],
)
def test_a_standoff_is_cut_from_the_next_longer_one(length: str, stock: str) -> None:
    """Shops have 20 to 50 mm in steps of 5 mm, and 60 mm; a longer one is made."""
    robot = with_article(built("kenan-2.0"), r"(standoff \S+ x )[\d.]+( mm)", rf"\g<1>{length}\2")
    (line,) = (line for line in order_lines(robot) if line.startswith("- standoffs"))
    assert f": 2 of {stock} mm, cut to {length} mm, +0 / -0.1 mm" in line
    assert "less than 6 mm of thread" in line


@pytest.mark.parametrize(
    ("length", "stock"),
    [
        ("80.5", "0.33"),
        ("80.6", "0.5"),
        ("123.0", "0.5"),
        ("123.1", "1"),
        ("248.0", "1"),
        ("248.1", "2"),
        ("600.0", "3"),
    ],
)
def test_a_rod_is_cut_into_its_pieces_with_a_cut_after_each(length: str, stock: str) -> None:
    """Four pieces, 2 mm lost at each; shops have rods of 0.33, 0.5 and 1 m, longer needs are whole metres."""
    robot = with_article(built("kenan-2.0"), r"(spring steel rod \S+ x )[\d.]+( mm)", rf"\g<1>{length}\2")
    (line,) = (line for line in order_lines(robot) if line.startswith("- spring steel rod"))
    assert f"rod 3 mm: 4 pieces of {length} mm, +0 / -0.3 mm" in line
    assert f"cut from a rod of {stock} m, ground" in line


@pytest.mark.parametrize(
    ("axle", "sold"),
    [
        ("spring-steel", r"a rod of 0\.33 m, ground, h6 to h9\. Cut steel .* sparks"),
        ("aluminium-7075", r"a rod of 0\.33 m, drawn or ground, h6 to h9\. Saw it"),
        ("steel-tube", r"a tube of 0\.33 m, its outside no thicker than said: .*\. Cut steel .* sparks"),
    ],
)
def test_tubes_are_not_ground_and_aluminium_gives_no_sparks(axle: str, sold: str) -> None:
    shop = load_workshop()
    bought = shop.bought.model_copy(update={"axle": axle})
    robot = build(load_design("kenan-2.0"), shop.model_copy(update={"bought": bought}))
    kind = shop.catalogue.rods[axle].description
    lines = [line for line in order_lines(robot) if line.startswith(f"- {kind}")]
    assert lines
    for line in lines:
        assert re.search(rf"cut from {sold}", line)
    assert any("sparks" in line for line in order_lines(robot)) is (axle != "aluminium-7075")


@pytest.mark.parametrize("bore_share", [0.0, 0.2, 0.8])
def test_a_rod_with_a_bore_is_a_tube_however_thick_its_wall_is(bore_share: float) -> None:
    rod = load_workshop().catalogue.rods["steel-tube"].model_copy(update={"bore_share": bore_share})
    assert _stock(rod, "0.5").startswith("a tube of 0.5 m" if bore_share else "a rod of 0.5 m")


def test_a_strip_is_as_long_as_its_pieces_with_a_cut_after_each() -> None:
    """Toes' pads: 2 x (10.4 + 2) + 2 x (9.5 + 2) = 47.8 mm; the stop's: 8 + 2 = 10 mm."""
    robot = built("kenan-2.0")
    robot = with_article(robot, r"(polyurethane.*, cut )4\.0 x 10\.\d( mm)", r"\g<1>4.0 x 10.4\2")
    lines = [line for line in order_lines(robot) if line.endswith(" mm wide or wider")]
    assert any("1 of 6.0 x 8.0 mm; order 10 mm of it, 6.0 mm wide" in line for line in lines)
    (toes,) = (line for line in lines if "SJ5616" in line)
    assert "2 of 4.0 x 10.4 mm, 2 of 5.0 x 9.5 mm; order 50 mm of it, 5.0 mm wide" in toes


def test_wire_is_ordered_by_colour() -> None:
    robot = built("kenan-2.0")
    named = dict(re.findall(r"(\w+) ([\d.]+) m(?:,|\b)", order().split("AWG 28, silicone: ")[1].split(", ends")[0]))
    for colour, metres in named.items():
        total = sum(mm for *_, one, mm in wires(robot) if one == colour)
        assert 1000.0 * float(metres) == pytest.approx(total, abs=5.1)
    assert sorted(named) == sorted({one for *_, one, mm in wires(robot) if mm})


def test_what_is_printed_is_said_with_the_workshops_settings() -> None:
    robot, shop = built("kenan-2.0"), load_workshop()
    process = shop.process.model_copy(
        update={
            "layer_height_mm": 0.15, "first_layer_mm": 0.25, "line_width_mm": 0.47, "perimeters": 4,
            "top_layers": 6, "bottom_layers": 5, "infill": 0.35,
        }
    )  # fmt: skip
    printer = shop.printer.model_copy(update={"bed_mm": (222.0, 231.0, 200.0), "nozzle_mm": 0.5})
    own = shop.model_copy(update={"process": process, "printer": printer})
    text = "\n".join(print_lines(replace(robot, workshop=own)))
    assert "nozzle 0.5 mm, layers 0.15 mm (first 0.25 mm), lines 0.47 mm wide, 4 perimeters, 6 top and 5 bottom" in text
    assert "35 % infill" in text
    assert "a bed of 222 x 231 mm" in text
    rows = re.findall(r"\| print/(\S+)\.3mf \| (\S+) \| (.*) \|", text)
    assert all(name.endswith(f"-{material}") for name, material, _ in rows)
    listed = [word.split(" × ")[-1] for *_, parts in rows for word in parts.split(", ")]
    assert sorted(listed) == sorted(part.name for part in robot.parts)


@pytest.mark.parametrize("spacing_mm", [2.0, 40.0])
def test_the_rows_of_plates_are_the_files_of_plates(spacing_mm: float) -> None:
    """Parts that are kept further apart need more of them."""
    robot = built("kenan-2.0")
    process = robot.workshop.process.model_copy(update={"part_spacing_mm": spacing_mm})
    robot = replace(robot, workshop=robot.workshop.model_copy(update={"process": process}))
    rows = re.findall(r"\| (print/plate\S+\.3mf) \|", "\n".join(print_lines(robot)))
    assert rows == [path for path, _ in plate_files(robot.parts, robot.workshop) if path.endswith(".3mf")]
    assert (len(rows) > 2) == (spacing_mm > 2.0)


def test_copies_of_a_part_are_counted_in_their_row() -> None:
    robot = built("kenan-2.0")

    def twice(one: Part) -> Part:
        return replace(one, drawing=replace(one.drawing, placements=2 * one.drawing.placements))

    parts = tuple(twice(one) if one.name == "cam" else one for one in robot.parts)
    row = next(line for line in print_lines(replace(robot, parts=parts)) if "2 × " in line)
    assert "2 × cam," in row
    assert "1 × " not in row


def test_the_table_to_weigh_into_has_the_grams_of_one_piece() -> None:
    robot = built("kenan-2.0")
    text = "\n".join(weigh_lines(robot))
    grams = {name: float(mass) for name, mass in re.findall(r"^(\w+) = ([\d.]+)$", text, re.MULTILINE)}
    assert sorted(grams) == sorted(part.name for part in robot.parts)
    printed = sum(grams[part.name] * len(part.placements) for part in robot.parts)
    bought = sum(1000.0 * item.total_kg for item in bill_of_materials(robot).items if item.name not in grams)
    total = re.search(r"([\d.]+) g for the whole robot", text)
    assert total is not None
    assert float(total[1]) == pytest.approx(1000.0 * sum(body.mass_kg for body in robot.bodies.values()), abs=0.051)
    assert printed + bought == pytest.approx(float(total[1]), abs=0.15)  # each rounded to 0.01 g


@cache
def clipped() -> Robot:
    shop = load_workshop()
    bought = shop.bought.model_copy(update={"retention": "clips", "axle": "silver-steel"})
    return build(load_design("kenan-2.0"), shop.model_copy(update={"bought": bought}), "kenan-2.0")


def test_rods_of_one_kind_are_cut_from_one_rod() -> None:
    """Seven pieces of four lengths, 2 mm lost at each, are less than half a metre together."""
    (line,) = (one for one in order_lines(clipped()) if one.startswith("- silver steel rod"))
    pieces = [(int(count), float(length)) for count, length in re.findall(r"(\d+) pieces? of ([\d.]+) mm", line)]
    assert sum(count for count, _ in pieces) == 7
    needed = sum(count * (length + 2.0) for count, length in pieces)
    stock = re.search(r"cut from a rod of ([\d.]+) m", line)
    assert stock is not None
    assert needed <= 1000.0 * float(stock[1]) == min(one for one in (330.0, 500.0, 1000.0) if one >= needed)


def test_the_grooves_of_clips_are_ordered_where_the_rods_have_them() -> None:
    """Two for every clip pair of the bill; between the inner edges as on the rods' meshes."""
    robot = clipped()
    (line,) = (one for one in order_lines(robot) if one.startswith("- the grooves"))
    clips = [item for item in robot.hardware if item.article.startswith("E-clip")]
    assert f"two a rod, {len(clips)} in all, 2.3 mm in diameter and 0.64 mm wide (DIN 6799)" in line
    assert "±0.2 mm between the inner edges" in line  # half of the play of 0.2 mm that each clip has along the rod
    said = {float(mm): int(count) for mm, count in re.findall(r"([\d.]+) mm \((\d+) ×\)", line)}
    found = Counter[float]()
    for rod in (item for item in robot.hardware if ", grooves " in item.article):
        points = rod.look.vertices
        bottom = points[np.abs(np.hypot(points[:, 0], points[:, 1]) - 1.15) < 0.02, 2]
        middle = (points[:, 2].min() + points[:, 2].max()) / 2.0
        found[round(float(bottom[bottom > middle].min() - bottom[bottom < middle].max()), 1)] += 1
    assert said == pytest.approx(found)
    assert "clips' grooves" in "\n".join(tool_lines(robot, []))
    assert "groove" not in order()


def test_a_charger_is_a_tool_where_the_robot_has_none() -> None:
    """A pack of one cell has no balance lead."""
    robot = built("kenan-2.0")
    bought = robot.workshop.bought.model_copy(update={"regulator": "s7v7f5", "diode": "schottky-1n5817"})
    outside = replace(robot, workshop=robot.workshop.model_copy(update={"bought": bought}))
    assert "LiPo charger for one cell" in "\n".join(tool_lines(outside, []))
    assert "LiPo charger" not in "\n".join(tool_lines(robot, []))
    assert "kit of two cells" not in "\n".join(order_lines(outside))


def test_bars_of_legs_are_ordered_with_glue_and_glued_to_the_designs_lengths() -> None:
    robot = built("kenan-2.0", leg="carbon-strip-3x6")
    text = "\n".join(order_lines(robot))
    (line,) = (one for one in text.splitlines() if one.startswith("- pultruded carbon strip 3 x 6 mm"))
    bars = [item for item in robot.hardware if item.name.endswith("_bar")]
    said = {float(mm) for mm in re.findall(r"1 of ([\d.]+) mm", line)}
    assert said == {round(float(np.ptp(item.look.vertices, axis=0).max()), 1) for item in bars}
    enough = re.search(r"order (\d+) mm", line)
    assert enough is not None
    assert 0.0 <= float(enough[1]) - sum(said) - 2 * 2.0 < 10.0
    longer = re.search(r"mm, \+([\d.]+) / -([\d.]+) mm; order", line)
    assert longer is not None
    assert float(longer[1]) <= END_PLAY_MM < float(longer[2])  # a longer one fills the play at an end, and fits
    assert "epoxy" in text
    eyes = re.search(r"hub to ankle, ([\d.]+) mm; front link ([\d.]+) mm", text)
    assert eyes is not None
    assert float(eyes[1]) == robot.design.carrying_link_mm
    assert float(eyes[2]) == pytest.approx(robot.design.carrying_link_mm * robot.design.c_coef, abs=0.051)
    assert "epoxy" in "\n".join(tool_lines(robot, []))
    assert "epoxy" not in order()


@pytest.mark.parametrize(("length", "enough"), [("97.9", 200), ("98.0", 200), ("98.1", 210)])
def test_bars_are_ordered_with_two_millimetres_for_every_cut(length: str, enough: int) -> None:
    """Two pieces of 98 mm and two cuts of 2 mm are 200 mm."""
    robot = with_article(built("kenan-2.0", leg="carbon-strip-3x6"), r"(, cut )[\d.]+( mm long)", rf"\g<1>{length}\2")
    (line,) = (line for line in order_lines(robot) if line.startswith("- pultruded carbon strip"))
    assert f"2 of {length} mm" in line
    assert f"order {enough} mm of it" in line
