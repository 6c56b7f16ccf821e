"""The guide: nothing in the bill is missing, figures are those of springs, motor and battery, each step is ticked."""

import base64
import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from xml.etree import ElementTree as ET

import jinja2.meta
import numpy as np
import pytest
from support.built import LONG_TOES, built, design, geared, of_kit
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.building.bom import Bill, SlicedPlate, bill_of_materials, write_bom
from jumpcad.bundle.drawings.spring_sheet import spring_sheets
from jumpcad.bundle.firmware import firmware_files
from jumpcad.bundle.firmware_numbers import numbers
from jumpcad.bundle.guide import guide_values as module
from jumpcad.bundle.guide import operation_values
from jumpcad.bundle.guide.guide_values import guide_values
from jumpcad.bundle.guide.markdown import bill_text, duration, put_on, with_bill, write_guide, write_page
from jumpcad.bundle.limits import limits_of
from jumpcad.bundle.renders import named_views
from jumpcad.checks import quick_findings
from jumpcad.design import Design
from jumpcad.files import template_names, templates_folder
from jumpcad.files.templates import environment, render
from jumpcad.findings import errors, limit
from jumpcad.mechanism.model import BODY
from jumpcad.robot.robot import Robot
from jumpcad.simulation import simulate
from jumpcad.steps.assembly_steps import ORDER, assembly_steps
from jumpcad.workshop import load_workshop, own_workshop
from jumpcad.workshop.varied import varied

TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable")


@pytest.fixture(scope="module", autouse=True)
def quick_limits() -> Iterator[None]:
    """Let a guide warn of what the quick checks find alone: all that it says of the others is their names."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "limits_of", quick_findings)
        yield


@cache
def guide(name: str = "kenan-2.0") -> str:
    return whole(built(name))


def whole(robot: Robot, pictures: Sequence[str] = ()) -> str:
    """Return all documents of a guide, one after the other."""
    return "\n".join(write_guide(robot, pictures).values())


def numbers_in(pattern: str, text: str) -> list[float]:
    found = re.search(pattern, text)
    assert found is not None, pattern
    return [float(one) for one in found.groups()]


def require_whole(robot: Robot) -> None:
    """Require of a guide and a firmware's README that no instruction is cut off, and of every step a box to tick."""
    guide = whole(robot)
    for text in (guide, dict(firmware_files(robot))["firmware/README.md"]):
        assert not re.search(r"\{[{%]|\bNone\b(?! fits)|\bnan\b|  \n", text), robot.name
    steps = re.split(r"(?m)^## ", guide)
    bill, wiring = steps[2], next(step for step in steps if step.startswith("Every wire"))
    assert set(re.findall(r"(?m)\|(\w+)(?: \d+)?\|$", wiring)) <= set(re.findall(r"AWG \d+, (\w+)", bill)), robot.name
    numbered = [step for step in steps if re.match(r"\d+\. ", step)]
    assert len(numbered) == len(assembly_steps(robot))
    assert [step.splitlines()[0] for step in numbered if "\n- ☐ " not in step] == []


def test_a_guide_has_every_article_and_a_box_and_a_picture_for_each_step_in_5000_words() -> None:
    robot = built("kenan-2.0")
    require_whole(robot)
    pictures = [name for name, _ in named_views(robot)]
    text = whole(robot, pictures)
    assert len(text.split()) <= 5000
    assert re.findall(r"!\[.*\]\(pictures/(step-.*)\.png\)", text) == pictures
    assert "--no-pictures" in guide()
    assert "--no-pictures" not in text
    bill = bill_of_materials(robot)
    assert [item.name for item in bill.items if item.name not in text.split("## Print settings")[0]] == []
    for step in assembly_steps(robot):
        added = sum(getattr(thing.source, "units", 1) for thing in step.added)
        brought = {placed.move.brings for placed in step.placed if placed.move.brings and not placed.move.trial}
        assert put_on(step).total() == added + len(brought), step.key


@pytest.mark.thorough
def test_every_workshop_and_every_part_that_can_be_chosen_has_a_guide() -> None:
    shop = load_workshop()
    for name in template_names("workshops"):
        require_whole(built("kenan-2.0", name))
    for kit in shop.catalogue.kits:
        require_whole(of_kit(kit))
    for name in ("best-compact", "best-jumper", "best-steered"):
        require_whole(build(design(name), load_workshop(own_workshop(name)), name))
    for robot in (geared(), built("best-bo"), built(LONG_TOES), built("kenan-2.0", leg="carbon-strip-3x6")):
        require_whole(robot)
    for changed in (
        {"retention": "clips", "axle": "silver-steel", "switch": ""}, {"retention": "nuts", "capacitor": ""},
        {"axle": "steel-tube", "sensor": ""}, {"spring": "9271K589"},
    ):  # fmt: skip
        require_whole(built("kenan-2.0", **changed))
    for values in ({"ground.pad": "tpu-2", "spring.preload_deg": 4.0}, {"body.stop_pad": "tpu-2"}):
        require_whole(build(design("kenan-2.0"), varied(shop, values), "own"))


def test_templates_and_figures_name_the_same_values() -> None:
    """A value that no template says is not computed; one that is not computed fails when it is said."""
    robot = built("kenan-2.0")
    given = set(guide_values(robot, assembly_steps(robot), bill_of_materials(robot)))
    said = set[str]()
    for path in templates_folder().glob("*/**/*.j2"):
        said |= jinja2.meta.find_undeclared_variables(environment().parse(path.read_text(encoding="utf-8")))
    assert given <= said
    steps = {path.name for path in (templates_folder() / "guides" / "steps").iterdir()}
    assert steps == {f"{plan.key}.md.j2" for plan in ORDER} | {"rest.md.j2"}
    missing = {key: value for key, value in operation_values.operation_values(robot).items() if key != "wind_s"}
    with pytest.raises(jinja2.UndefinedError, match="wind_s"):
        render("firmware/README.md.j2", missing)


USED = ("glue", "solder", "alcohol", "grease", "oil", "tape", "emery", "sandpaper", "gloves", "mask", "epoxy",
        "baking paper", "cord", "stick", "knife", "vice", "tweezers", "card", "nail", "wedge", "caliper", "multimeter",
        "crocodile", "marker", "glasses", "drill", "reamer", "saw", "wood", "pliers", "small screwdriver", "AA cells",
        "scale")  # fmt: skip


@pytest.mark.thorough
def test_the_order_names_every_tool_and_what_is_used_up() -> None:
    """What another document tells the builder to take stands in order.md too; the bill's rows are those of the list."""
    caged = build(design("best-jumper"), load_workshop("best-jumper"), "caged")
    for robot in (built("kenan-2.0"), caged, built("kenan-2.0", leg="carbon-strip-3x6")):
        order, *others = write_guide(robot).values()
        told = " ".join(others)
        assert [
            word for word in USED if re.search(rf"\b{word}", told, re.I) and not re.search(rf"\b{word}", order, re.I)
        ] == []
        used = [line.split(",")[1] for line in write_bom(bill_of_materials(robot)).splitlines() if "used up" in line]
        assert len(used) > 8
        assert [name.strip('"') for name in used if name.strip('"') not in order] == []


def test_steps_that_others_refer_to_are_those_in_which_it_is_done() -> None:
    """The springs' pin, the battery, the sensor's ends and the wood of the press."""
    steps = {title: int(number) for number, title in re.findall(r"(?m)^## (\d+)\. (.*)$", guide())}
    for pattern, title in (
        (r"pushes it in; it stays out until step (\d+)", "The leg pin"),
        (r"Lay all aside until step (\d+)", "Trays into the right plate"),
        (r"Strap it in as in step (\d+)", "Lower tray with the battery"),
        (r"sensor's ends stay free until step (\d+)", "Left plate with the sensor"),
        (r"the sensor's check of step (\d+)", "Left plate with the sensor"),
        (r"none under its screw in step (\d+)", "Pinion; left plate for good"),
        (r"beech .* long, for step (\d+)", "Pinion; left plate for good"),
    ):
        assert numbers_in(pattern, guide()) == [steps[title]], pattern


def test_both_plates_hold_the_springs_pin_before_an_arm_is_pushed() -> None:
    titles = ("plate for good", "without springs\n", "The leg pin\n")
    places = [guide().index(title) for title in titles]
    assert places == sorted(places)


def test_a_guide_takes_times_in_and_changes_nothing_else() -> None:
    bill = bill_of_materials(built("kenan-2.0"))
    order = write_guide(built("kenan-2.0"))["order.md"]
    timed = with_bill(order, bill.sliced({"foot": 5400.0}, [SlicedPlate("plate-1-PETG", "PETG", 9.0, 7260.0)]))
    assert "| plate-1-PETG | 2:01 h |" in timed
    assert timed.split("## Print settings")[1] == order.split("## Print settings")[1]
    assert with_bill(timed, bill) == order
    for seconds, written in ((29.0, "0:00 h"), (31.0, "0:01 h"), (3599.0, "1:00 h"), (9089.0, "2:31 h")):
        assert duration(seconds) == written


def test_what_is_known_of_prices_is_said_for_all_pieces() -> None:
    """Estimates stand in bom.csv alone; their share of the sum is said."""
    bill = bill_of_materials(built("kenan-2.0"))
    screws = (one for one in bill.items if one.name.startswith("screw M3 x 8"))
    dear = Bill(tuple(replace(one, price_eur=0.25, price_from="workshop") for one in screws))
    assert "|4|screw M3 x 8 ISO 7380-1|1.00 €|\n" in bill_text(dear)
    said = re.findall(r"\|([\d.]+) € (?:for \d+ )?\((.*)\)\|\n", bill_text(bill))
    assert said == [(f"{one.total_eur:.2f}", one.price_from) for one in bill.items if one.price_from != "estimate"]
    assert ("21.55", "Pololu 2371, 2026-10-10") in said


def require_accepted_springs(name: str) -> None:
    """Require one reading: force at the lever. Stress goes with torque; a spring both stiff and wide is refused.

    The least is what is 10 % too soft and 10 degrees too narrow, the drawing asks for the same torque.
    """
    robot, text = built(name), guide(name)
    spring = robot.layout.drive.spring
    grams = numbers_in(r"\|(\d+) to (\d+) g\|accept \((\d+) g computed\)", text)
    low, high, middle = (one / 1000.0 * 9.80665 * spring.arms.lever_mm for one in grams)
    rate, wound = 500.0 * robot.spring.stiffness_nm_per_rad * math.pi / 180.0, math.degrees(spring.wound_rad)
    assert middle == pytest.approx(rate * wound, rel=1e-3), name
    assert low == pytest.approx(0.9 * rate * (wound - 10.0), rel=0.02), name
    assert 1.05 * 0.999 <= high / middle <= 1.1 * 1.001, name
    assert high / middle * spring.stress_mpa <= 1.05 * spring.allowable_mpa * 1.001, name  # the reserve of loads
    assert 1.1 * rate * (wound + 4.0) > high, name
    levers = re.findall(r"([\d.]+) mm (?:from the circle|beside the drill)", text)
    assert levers == [f"{spring.arms.lever_mm:.1f}"] * 2, name
    assert 1000.0 * numbers_in(r"1 g up to (\d+) kg", text)[0] > grams[1], name
    percent = f"N·mm, +{100.0 * (high / middle - 1.0):.0f} % / -{100.0 * (1.0 - low / middle):.0f} %"
    assert percent in text, name
    assert all(percent in sheet for _, sheet in spring_sheets(robot)), name
    free = math.degrees(spring.free_arm_angle_rad)
    assert f"the arms are {free - 10.0:.0f} to {free + math.floor(0.1 * wound):.0f}° apart" in text, name
    assert f"0.0° to {wound:.1f}°" in text, name


def test_springs_are_accepted_by_their_torque_where_the_robot_loads_them() -> None:
    require_accepted_springs("kenan-2.0")


@pytest.mark.thorough
def test_springs_of_every_template_are_accepted_so() -> None:
    for name in TEMPLATES:
        require_accepted_springs(name)


def test_springs_go_on_the_side_for_which_they_are_wound() -> None:
    """The right plate lies below: what goes on first is the robot's right spring, which is left-hand wound."""
    article = {item.name: item.article for item in built("kenan-2.0").hardware}
    assert "left hand" in article["spring_right"]
    assert "right hand" in article["spring_left"]
    assert re.findall("(LEFT|RIGHT)-HAND", guide()) == ["LEFT", "RIGHT"]


def test_what_is_measured_at_the_divider_follows_from_ohms_law() -> None:
    """200 over 200 kOhm: a half, with resistors of 1 % and a multimeter's 10 MOhm and 1 %."""
    low, high, *volts = numbers_in(r"ground to D1: ([\d.]+) to ([\d.]+) of that \(([\d.]+) to ([\d.]+) V", guide())
    assert 0.94 * 0.5 < low < 0.5 < high < 1.03 * 0.5
    assert volts == pytest.approx([3.7 * low, 3.7 * high], abs=0.007)
    let_go = numbers_in(r"let go within (\d+) ms", guide())[0]
    assert let_go <= (numbers(built("kenan-2.0"))["RELEASE_MAX_MS"] or 0)


def test_times_of_charging_and_of_boards_left_on_follow_from_the_capacity() -> None:
    """300 mAh at 370 mA, and half as long again; 24 mA and 1.7 mA of the boards from 3.7 V."""
    assert numbers_in(r"(\d+) mA \(([\d.]+) C\), full after about ([\d.]+) h", guide()) == [370.0, 1.23, 1.2]
    assert numbers_in(r"boards empty it in (\d+) h", guide())[0] == pytest.approx(300.0 / (24.0 + 1.7), abs=0.51)


@pytest.mark.thorough
def test_two_cells_are_never_charged_inside_the_robot() -> None:
    robot = of_kit("strong-2s")
    capacity = robot.workshop.catalogue.batteries[robot.workshop.bought.battery].capacity_mah
    for text in (whole(robot), dict(firmware_files(robot))["firmware/README.md"]):
        assert "USB socket, switch on" not in text
        assert f"Charge with {capacity:.0f} mA at most (1 C)" in text
        assert "by a charger with a balance lead, set to LiPo 2S, outside the robot" in text
        assert "tie leg and body together with cord" in text
        assert "ull the USB cable and switch off" not in text  # a diode keeps USB from the driver
    assert "balance" not in guide()


@pytest.mark.thorough
def test_a_board_without_a_button_is_told_by_typing_and_reads_no_current_of_usb(tmp_path: Path) -> None:
    """Commands come over USB, which feeds the controller; on one cell its charger feeds the driver as well."""
    for kit, readable in (("light-1s", False), ("strong-2s", True)):
        board = '[boards.typed]\nlike = "xiao-esp32c3"\nbutton = ""\nsource = "a board of my own"'
        (tmp_path / "own.toml").write_text(f'[bought]\nkit = "{kit}"\ncontroller = "typed"\n{board}\n')
        text = whole(build(design("kenan-2.0"), load_workshop(tmp_path / "own.toml"), "own"))
        assert "the button" not in text, kit
        assert "Type `wind`." in text, kit
        assert ("10 A range to both its terminals" in text) == ("mA standing" in text) == readable, kit


@pytest.mark.thorough
def test_the_switch_bears_the_blocked_motor_and_its_slider_reaches_through_the_plate() -> None:
    """Half an ampere, which sellers state, is enough; 1.5 mm of slider are left for a finger."""
    for robot in (built("kenan-2.0"), of_kit("strong-2s")):
        text, cells = whole(robot), 2 if robot.workshop.bought.kit == "strong-2s" else 1
        pattern = r"switch\*\*: of ([\d.]+) A.* motor draws ([\d.]+) A\. Another one: ([\d.]+) V"
        rated, amperes, volts = numbers_in(pattern, text)
        assert volts == pytest.approx(4.2 * cells)
        assert amperes <= rated == 0.5
        assert ("is not built without a switch" in text) == (cells == 2)
        out = numbers_in(r"slider ([\d.]+) mm or more", text)[0]
        assert out == pytest.approx(robot.workshop.body.plate_mm + 1.5, abs=0.05)


NEAR_SCREW = [100.0, 0.96812, 0.5, 1.07992, 0.8, 70.0, 30.0, 15.404]
"""A design with a standoff's screw beside the motor's window: a block of 20 mm would stand on its head."""


@pytest.mark.thorough
def test_the_block_under_the_motor_meets_the_plate_alone() -> None:
    """No screw's head, tie or bent end outside of the right plate stands where the guide puts the wooden block."""
    for robot in (*map(built, TEMPLATES), build(Design.from_vector(NEAR_SCREW))):
        text = whole(robot)
        (groove,) = numbers_in(r"groove (\d+) mm wide, ", text)
        size = np.array(numbers_in(r"beech ([\d.]+) x (\d+) mm", text))
        assert 6.0 <= size[0] - groove <= 12.0  # 3 to 6 mm on either side
        layout = robot.layout
        turn = layout.motor_angle_rad
        axes = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
        for item in (one for one in robot.hardware if one.body == BODY):
            points = item.shown_mesh.copy().apply_transform(item.T_body_part).vertices
            outside = points[points[:, 1] < layout.lateral.right_plate[0] - 1e-3][:, ::2] - layout.motor_mm
            along = np.einsum("ij,nj->ni", axes, outside)
            if len(along):
                low, high = along.min(axis=0), along.max(axis=0)
                assert np.any((low > size / 2.0 + 0.5) | (high < -size / 2.0 - 0.5)), item.name  # sawn by hand


@pytest.mark.thorough
def test_tools_go_through_what_they_are_for() -> None:
    """A drill into the loaded coil, a rod through the hole for the pin, a plug through its window: each is thinner."""
    for name in ("kenan-2.0", "best-bo"):
        robot, text = built(name), guide(name)
        spring, window = robot.layout.drive.spring, robot.layout.fittings.usb_size_mm
        loaded = spring.arms.mean_mm * spring.turns / (spring.turns + math.degrees(spring.wound_rad) / 360.0)
        shank = numbers_in(r"a drill's shank, ([\d.]+) mm or a little less", text)[0]
        assert loaded - spring.wire_mm - 1.0 < shank < loaded - spring.wire_mm, name
        assert f"a circle of {spring.inside_diameter_mm + spring.wire_mm:.1f} mm around the drill" in text, name
        rod = numbers_in(r"rod of at most ([\d.]+) mm, 60 mm long", text)[0]
        assert robot.layout.pin_hole.diameter_mm - 1.1 < rod < robot.layout.pin_hole.diameter_mm, name
        body = numbers_in(r"plug body at most ([\d.]+) x ([\d.]+) mm", text)
        assert all(side - 1.0 < one < side for side, one in zip(window, body, strict=True)), name


@pytest.mark.thorough
def test_clips_and_screws_of_axles_are_put_on_where_the_robot_has_them() -> None:
    """And tape closes the lower plate's open bores before anything stands in them."""
    clips, nuts = (
        whole(built("kenan-2.0", retention="clips", axle="silver-steel")),
        whole(built("kenan-2.0", retention="nuts")),
    )
    for words, told in (
        ("turn the lock nuts on", (False, False, True)), ("press a clip into every groove", (False, True, False)),
        ("its closed bores hold the axles", (True, False, False)), ("The bores are open", (False, True, True)),
        ("Cross hole forwards, split pin", (True, False, True)), ("Both clips are in", (False, True, False)),
    ):  # fmt: skip
        assert tuple(text.count(words) == 1 for text in (guide(), clips, nuts)) == told, words
    lean = built("kenan-2.0")
    lean = replace(lean, layout=replace(lean.layout, spring_boss_mm=0.0))
    assert whole(lean).count("strip of") == 2  # of tape, in place of the boss, and off again
    assert "its boss holds it" in guide()
    assert nuts.index("The bores are open") < nuts.index("Stand axles and plate pin")


@pytest.mark.thorough
def test_preloaded_and_stock_springs_are_handled_as_such() -> None:
    shop = workshop_with(spring={"preload_deg": 5.0}, bought={"spring": "9271K589"})
    text = whole(build(design("kenan-1.0"), shop, "own"))
    assert "Two torsion springs 9271K589, one of each hand, from stock" in text
    assert "right-hand wound for outside diameter 0.848 in, wire 0.105 in, legs 3.5 in" in text  # of the left-hand one
    assert "asks for 4.60 N·mm/°; the robot is computed with 26.36 N·mm/°" in text
    assert "by the preload|132 N·mm|" in text  # 26.36 · 5
    assert text.count("On the stop, too, the springs are loaded by 2.0°") == 1  # which is 3° past rest
    assert "the leg pin first" in text
    assert "On the stop, too" not in guide()


def test_a_forbidden_robot_is_told_with_its_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    for names, words in (
        (("walls",), "the limit walls is violated"), (("walls", "pins"), "the limits walls, pins are violated")
    ):  # fmt: skip
        broken = [limit(name, -1.0, "mm", "found", "remedy") for name in names]
        found = [*broken, limit("holes", 1.0, "mm", "found", "remedy")]
        monkeypatch.setattr(module, "limits_of", lambda _, found=found: found)
        assert words in whole(built("kenan-2.0"))


@pytest.mark.thorough
def test_glued_bars_and_printed_pads_have_their_own_steps() -> None:
    bars = whole(built("kenan-2.0", leg="carbon-strip-3x6"))
    assert bars.count("Glue it with epoxy into both ends") == 1
    assert "## 7. Front link from its bar" in bars
    pads = whole(build(design("kenan-2.0"), varied(load_workshop(), {"ground.pad": "tpu-2"}), "own"))
    assert "Glue them on with a thin coat of super glue" in pads
    assert Counter(re.findall(r"epoxy|TPU 95A|Press pads on", guide())) == {"Press pads on": 1}


@pytest.mark.thorough
def test_a_first_robot_has_springs_from_stock_and_no_switch() -> None:
    """One spool of PLA, no limit violated, 0.9 m far; its guide names no switch but the sensor's."""
    robot = build(design("first-robot"), load_workshop("first-robot"), "first-robot")
    assert {part.material for part in robot.parts} == {"PLA"}
    assert errors(limits_of(robot)) == []
    assert (simulate(robot).ballistic_range_m or 0.0) > 0.9
    text = whole(robot)
    assert "it is the switch" in text
    assert re.findall(r"[^.]*\bswitch (?:on|off)\b[^.]*", text, re.IGNORECASE) == []
    assert text.count("McMaster-Carr 9271K589") >= 2


def test_trouble_names_every_message_that_asks_for_help() -> None:
    """Faults, refusals and springs that may be loaded, as the firmware's sources say them."""
    sources = (templates_folder() / "firmware" / name for name in ("winder.py", "main.py"))
    texts = [text for path in sources for text in re.findall(r'"([a-z][^"]*)"', path.read_text(encoding="utf-8"))]
    said = [re.split("[:;,]", text)[0] for text in texts if re.search("loaded|charge it|motor off|not known", text)]
    assert len(set(said)) == 9
    trouble = write_guide(built("kenan-2.0"))["trouble.md"]
    assert [words for words in said if words not in trouble] == []


PNG = b"\x89PNG\r\n\x1a\n"


def page_of(text: str, name: str = "A", **others: str) -> ET.Element:
    """Return the page of a guide whose assembly.md, and perhaps other documents, are given."""
    pictures = {"pictures/step-1.png": PNG}
    guide = {f"{part}.md": words for part, words in others.items()} | {"assembly.md": text}
    return ET.fromstring(write_page(guide, name, pictures).replace("<!DOCTYPE html>", "", 1))


def test_the_page_is_well_formed_and_needs_no_other_file() -> None:
    guide = write_guide(built("kenan-2.0"), ["rest", "step-1", "step-13-springs"])
    files = {f"pictures/{name}.png": PNG for name in ("rest", "step-1", "step-13-springs")}
    files |= {f"{name}.svg": b"<svg/>" for name in ("wiring", "soldering", "leads", "order/spring-right-hand")}
    page = write_page(guide, "kenan-2.0", files)
    root = ET.fromstring(page.replace("<!DOCTYPE html>", "", 1))
    images = [image.get("src") or "" for image in root.iter("img")]
    assert len(images) == 7
    kinds = [source.partition(";")[0].removeprefix("data:image/") for source in images]
    assert sorted(kinds) == ["png"] * 3 + ["svg+xml"] * 4
    read = {kind: base64.b64decode(source.partition(",")[2]) for kind, source in zip(kinds, images, strict=True)}
    assert read == {"png": PNG, "svg+xml": b"<svg/>"}
    assert not re.search(r"(src|href)=\"(?!data:|#)", page)


def test_the_page_says_what_the_guide_says() -> None:
    root = page_of("# A <b>\n\nUse **care** & `wind`.\n\n| a | b |\n|---|--:|\n| 1 | 2 |\n\n> Hot.\n")
    assert root.findtext("body/section/h1") == "A <b>"
    (care,) = root.findall("body/section/p")
    assert ("".join(care.itertext()), care.findtext("strong"), care.findtext("code")) == (
        "Use care & wind.", "care", "wind",
    )  # fmt: skip
    assert [cell.text for cell in root.iter("td")] == ["1", "2"]
    assert root.findtext("body/section/blockquote/p") == "Hot."


def test_a_name_is_text_in_the_page_whatever_it_holds() -> None:
    name = "<b>frog</b> & <script>"
    root = page_of("# A\n", name)
    assert root.findtext("head/title") == f"{name}: assembly"


def test_each_hand_has_its_drawing_with_the_rate() -> None:
    from jumpcad.bundle.drawings.spring_sheet import spring_sheets

    sheets = dict(spring_sheets(built("kenan-2.0")))
    assert list(sheets) == ["order/spring-right-hand.svg", "order/spring-left-hand.svg"]
    for hand, sheet in zip(("right", "left"), sheets.values(), strict=True):
        ET.fromstring(sheet)
        assert "4.60 N·mm/° ±10 %" in sheet
        assert "order 2 and choose" in sheet
        assert "agree within 5 %" in sheet
        assert re.search(r"° \+4° / -10°; 180° is opposite directions", sheet)
        assert f"rises to the {hand}" in sheet


def test_lines_to_tick_have_a_box_and_a_step_has_its_pictures_beside_its_words() -> None:
    step = "## 1. Leg\n\n![step-1](pictures/step-1.png)\n\nDo it.\n\n- ☐ It *turns*.\n- free\n"
    guide = f"# A\n\n{step}\n## Tools\n\n- ☐ all\n"
    root = page_of(guide)
    items = ["".join(item.itertext()) for item in root.iter("li") if item.find("input") is not None]
    assert items == ["It turns.", "all"]
    *_, step, tools = root.iter("section")
    shown, told = step.findall("div")
    assert [len(list(one.iter("img"))) for one in (shown, told, tools)] == [1, 0, 0]
    assert "".join(told.itertext()).split() == ["Do", "it.", "It", "turns.", "free"]
    assert (step.findtext("h3"), tools.find("div")) == ("1. Leg", None)


def test_the_menu_leads_to_the_documents_and_each_document_to_its_sections() -> None:
    """By anchors that are there; a link from one document to another stays on the page."""
    text = "# A\n\n[first](order.md)\n\n## 1. Feet & eyes\n\n### not me\n\n## After *use*\n\ntext\n"
    root = page_of(text, order="# 1. Order\n\n## Buy\n")
    links = [(link.get("href"), "".join(link.itertext())) for link in root.iter("a")]
    assert [href for href, _ in links] == ["#order", "#assembly", "#order", "#buy", "#1-feet-eyes", "#after-use"]
    assert links[4][1] == "1. Feet & eyes"
    anchors = {element.get("id") for element in root.iter() if element.get("id")}
    assert anchors == {str(href)[1:] for href, _ in links}
    (lower,) = root.iter("h4")
    assert lower.text == "not me"
