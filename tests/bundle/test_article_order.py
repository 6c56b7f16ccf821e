"""Which article is meant: figures of data sheets and norms."""

import re
from dataclasses import replace
from types import SimpleNamespace

import pytest
from support.built import built

from jumpcad.building import build
from jumpcad.bundle.article_order import _smooth_under_the_leg
from jumpcad.bundle.ordering import order_lines
from jumpcad.design import load_design
from jumpcad.workshop import load_workshop


def test_the_motor_is_compared_with_its_data_sheet() -> None:
    """Pololu 2371 (MP 6V, 298:1): 73 rpm, 70 mA, 0.67 A stalled, 2.4 kg·cm."""
    (line,) = (line for line in order_lines(built("kenan-2.0")) if line.startswith("- gear motor"))
    assert "298:1, 6 V, 73 rpm, 70 mA without load" in line
    stalled = re.search(r"([\d.]+) N·m and 0.67 A stalled, shaft 3 mm with a flat, 9 mm long \(as its source", line)
    assert stalled is not None
    assert float(stalled[1]) == pytest.approx(2.4 * 0.0980665, abs=0.0006)


@pytest.mark.parametrize(("confidence", "words"), [("derived", "(derived: "), ("memory", "(from memory: ")])
def test_a_motor_known_less_surely_says_so(confidence: str, words: str) -> None:
    robot = built("kenan-2.0")
    layout, train = robot.layout, robot.layout.drive.train
    motor = train.motor.model_copy(update={"confidence": confidence, "article": "Maker 12, a motor"})
    drive = replace(layout.drive, train=replace(train, motor=motor))
    (line,) = (
        line for line in order_lines(replace(robot, layout=replace(layout, drive=drive))) if "gear motor" in line
    )
    assert words in line
    assert line.startswith("- gear motor: Maker 12, a motor. Compare before you order")
    (named,) = (line for line in order_lines(robot) if "gear motor" in line)
    assert named.startswith(f"- gear motor: {train.motor.article or train.motor.name}. Compare")


def test_bearings_and_tape_have_their_data_sheets_sizes() -> None:
    """ISO 15: 623 is 3 x 10 x 4 mm, MR63 3 x 6 x 2.5 mm; XIAO 21 x 17.8 mm."""
    text = "\n".join(order_lines(built("kenan-2.0")))
    assert "623, 3 x 10 x 4 mm; MR63, 3 x 6 x 2.5 mm" in text
    assert "625" not in text  # not ordered
    assert "21 x 17.8 mm (controller), 20.3 x 12.7 mm (driver)" in text
    unknown = built("kenan-2.0")
    hardware = tuple(replace(one, article=one.article.replace("ball bearing", "bushing")) for one in unknown.hardware)
    unknown = replace(unknown, hardware=hardware)
    assert "metal shields" not in "\n".join(order_lines(unknown))


@pytest.mark.parametrize(("motor", "longer"), [("", 0.0), ("n20-75", 50.0)])
def test_leg_and_front_link_turn_on_the_smooth_part_of_their_screws(motor: str, longer: float) -> None:
    """ISO 4762 M3 x 45: 18 mm of thread and 2.5 mm of run-out leave 24.5 mm; of 50 mm cut to 45 mm they leave 29.5 mm.

    Two pairs of gears need more room between the head and the leg.
    """
    shop = load_workshop("default")
    changed = {"retention": "nuts"} | ({"motors": (motor,)} if motor else {})
    shop = shop.model_copy(update={"bought": shop.bought.model_copy(update=changed)})
    robot = build(load_design("kenan-1.0"), shop)
    left, leg = robot.layout.lateral.left_plate[1], robot.layout.lateral.leg[0]
    assert (left - leg > 45.0 - 20.5) == (longer > 0.0)
    cut = re.findall(r"buy M3 x (\d+) and cut them to 45 mm", "\n".join(order_lines(robot)))
    stand_ins = re.search(r"- (\d+) rods of 3 mm, (\d+) mm long", "\n".join(order_lines(robot)))
    assert stand_ins is not None
    screws = [item for item in robot.hardware if item.article.endswith("ISO 4762 - 12.9")]
    low, high = robot.layout.lateral.outside
    assert (int(stand_ins[1]), int(stand_ins[2])) == (len(screws), round(high - low)), "one for each screw"
    assert [float(one) for one in cut] == ([longer] if longer else [])
    stock = shop.catalogue.screws["M3 long"].model_copy(update={"lengths_mm": [35.0, 40.0, 45.0, 70.0]})
    apart = replace(robot, workshop=SimpleNamespace(catalogue=SimpleNamespace(screws={"M3 long": stock})))
    assert list(_smooth_under_the_leg(apart)) == []  # the nut of an M3 x 70 would stand on smooth shank
    if longer:
        assert longer - 20.5 >= left - leg
        assert longer - 18.0 <= left - robot.layout.lateral.right_plate[0]  # the nut is on thread
