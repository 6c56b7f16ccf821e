"""A user's own parts: read, refused, kept in a bundle, and built into robots that pass every check."""

import filecmp
import json
import math
import re
from collections.abc import Callable
from itertools import chain
from pathlib import Path
from typing import Any

import pytest
from support.commands import exit_code_of
from support.each import each

from jumpcad.building import build
from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.export import export
from jumpcad.checks import check
from jumpcad.cli.commented import commented_workshop
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.findings import errors
from jumpcad.simulation import simulate
from jumpcad.workshop import load_workshop

Tables = dict[str, dict[str, Any]]
"""Tables of a workshop by their headings."""
Write = Callable[[str | Tables], Path]
KENAN = load_design("kenan-2.0")
CHAPTER = (Path(__file__).parents[1] / "docs" / "workshop.md").read_text(encoding="utf-8")
(EXAMPLE,) = re.findall(r"```toml\n(\[bought\].*?)```", CHAPTER, re.S)

(DRAWER,) = re.findall(r"```toml\n(# drawer\.toml.*?)```", CHAPTER, re.S)
OTHERS = """
bought = { motors = ["mine"], spring = "mine", switch = "" }
motors.mine = { like = "n20-298", width_mm = 16, height_mm = 16, body_length_mm = 40, shaft_mm = 4,\
 shaft_flat_mm = 3.5, shaft_length_mm = 11, boss_mm = 7, mass_g = 32,\
 no_load_rpm = 45, stall_current_a = 0.9, source = "bench" }
springs.mine = { wire_mm = 2, outer_diameter_mm = 16, turns = 4.25, arm_angle_deg = 90, arm_length_mm = 40,\
 rate_nmm_per_deg = 14.5, source = "scale" }
prices_eur = { "torsion spring" = 0, "gear motor" = 0, "screw" = 0, "LiPo" = 0 }
"""
"""A drawer of other parts: a large motor, and springs that were measured."""

SPRING = """
[springs.stock]
wire_mm = 1.0
inside_diameter_mm = 8.0
turns = 4.25
arm_angle_deg = 90.0
arm_length_mm = 25.0
rate_nmm_per_deg = 4.2
source = "a shop"
"""


@pytest.fixture
def written(tmp_path: Path) -> Write:
    """Return a function that writes `my.toml`."""

    def write(content: str | Tables) -> Path:
        path = tmp_path / "my.toml"
        path.write_text(content if isinstance(content, str) else in_toml(content), encoding="utf-8")
        return path

    return write


WIDE_TOES: Tables = {"body": {"toe_half_width_mm": 85.0}}
"""What is heavy at one side needs a wider stance."""


def motor(**figures: float) -> Tables:
    """Return a workshop with one allowed motor: the N20 with other figures."""
    return {"bought": {"motors": ["own"]}, "motors.own": {"like": "n20-298", "source": "test", **figures}}


def large(**figures: float) -> Tables:
    """Return a workshop with one allowed motor: a gear motor of 25 mm with a D-shaft of 4 mm, with other figures.

    It makes the robot heavy and its plates wide apart: the leg takes longer to get out of the cam's way, which a slow
    motor and a small roller allow, and the toes reach further aside.
    """
    large_motor = {
        "mass_g": 65.0, "no_load_rpm": 33.0, "width_mm": 25.0, "height_mm": 25.0, "body_length_mm": 50.0,
        "shaft_mm": 4.0, "shaft_flat_mm": 3.5, "shaft_length_mm": 12.0, "boss_mm": 7.0, "boss_length_mm": 2.5,
    }  # fmt: skip
    return joined(motor(**large_motor | figures), {"bought": {"roller": "683"}})


def battery(length: float, width: float, height: float) -> Tables:
    """Return a workshop with a battery of a size."""
    size = {"length_mm": length, "width_mm": width, "height_mm": height}
    return {"bought": {"battery": "pack"}, "batteries.pack": {"like": "lipo-1s-300", "source": "test", **size}}


def boards(length: float, width: float) -> Tables:
    """Return a workshop with two boards of a size."""
    size = {"length_mm": length, "width_mm": width, "source": "test"}
    return {
        "bought": {"controller": "small", "driver": "small-driver"},
        "boards.small": {"like": "xiao-esp32c3", **size},
        "boards.small-driver": {"like": "drv8833", **size},
    }


def bearing(place: str, bore: float, outer: float, width: float) -> Tables:
    """Return a workshop with a bearing of a size in the hub (`leg_bearing`) or for the roller (`roller`)."""
    grams = 0.6 * 7.85e-3 * math.pi / 4.0 * abs(outer**2 - bore**2) * width  # of a ring of steel, six tenths
    size = {"bore_mm": bore, "outer_mm": outer, "width_mm": width, "mass_g": round(grams, 2)}
    return {"bought": {place: "own"}, "bearings.own": {"like": "623", "source": "test", **size}}


def joined(*workshops: Tables) -> Tables:
    """Return the workshop that has the tables of all; of a value given twice, the last."""
    return {heading: dict(chain(*(one.get(heading, {}).items() for one in workshops))) for heading in chain(*workshops)}


def in_toml(tables: Tables) -> str:
    """Return tables as TOML, one value a line."""
    return "".join(
        f"[{heading}]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in values.items())
        for heading, values in tables.items()
    )


FITS = {
    "gear motor of 25 mm, shaft of 8 mm": large(
        shaft_mm=8.0, shaft_flat_mm=7.0, boss_mm=10.0, shaft_length_mm=14.0
    ),
    "body wider than high": motor(width_mm=12.0, height_mm=8.0),
    "square body of 5 mm": motor(width_mm=5.0, height_mm=5.0, body_length_mm=10.0),
    "body of 60 mm": motor(body_length_mm=60.0),
    "shaft of 6 mm": motor(shaft_mm=6.0, shaft_flat_mm=5.5, boss_mm=9.0),
    "shaft of 40 mm": motor(shaft_length_mm=40.0),
    "boss higher than the cap": motor(boss_length_mm=6.0, shaft_length_mm=14.0),
    "boss as wide as the body": motor(boss_mm=10.0),
    "battery of 100 mm": battery(100.0, 36.0, 30.0),
    "battery as wide as the plates are apart": battery(35.0, 37.0, 8.0),
    "battery of 1 mm": battery(1.0, 1.0, 1.0),
    "boards of 5 mm": boards(5.0, 4.0),
    "bearing 693 in the hub": bearing("leg_bearing", 3.0, 8.0, 4.0),
    "bearing hardly wider than the axle": bearing("leg_bearing", 3.0, 5.0, 2.0),
    "bearing 693 for the roller": bearing("roller", 3.0, 8.0, 4.0),
}  # fmt: skip
ROBOTS = {
    "heavy": ["gear motor of 25 mm, shaft of 8 mm", "bearing 693 in the hub"],
    "long": [
        "body of 60 mm", "shaft of 6 mm", "boss higher than the cap", "boss as wide as the body", "battery of 1 mm",
        "boards of 5 mm",
    ],
    "flat": [
        "body wider than high", "shaft of 40 mm", "battery as wide as the plates are apart",
        "bearing 693 for the roller",
    ],
    "small": ["square body of 5 mm", "battery of 100 mm", "bearing hardly wider than the axle"],
}  # fmt: skip
"""Robots with several own parts each: a check of everything costs seconds."""
REFUSED = {
    "short shaft": (
        motor(shaft_length_mm=5.0),
        r"^the shaft of motor own is 5 mm long; it needs 5\.9 mm to pass its cap and reach 3 mm into "
        r"its pinion: allow a motor "
        "with a longer shaft$",
    ),
    "gear motor of 60 mm": (
        large(width_mm=60.0, height_mm=60.0),
        r"^no room for the [\w ]*motor.* or allow a smaller motor than own \(60 x 60 mm\)$",
    ),
    "battery of 300 mm": (
        battery(300.0, 20.0, 10.0),
        r"^part body_plate_left of 3\d\d\.\d×\d+\.\d×\d\.\d mm does not fit the bed of "
        r"250\.0×210\.0×220\.0 mm at any angle.*: choose .* smaller battery or boards",
    ),
    "bearing 625 for the roller": (
        bearing("roller", 5.0, 16.0, 5.0),
        r'^bought\.roller = "own": its bore of 5 mm does not fit the M3 screw that holds it: choose a '
        "bearing with a bore of 3 mm$",
    ),
    "large bearing in the hub": (
        bearing("leg_bearing", 3.0, 30.0, 8.0),
        r"^the leg's bearing own has 30 mm diameter; 1\d\.\d mm fit beside the roller's screw and the cam's axle: "
        r"choose a smaller bought\.leg_bearing$",
    ),
    "wide bearing in the hub": (
        bearing("leg_bearing", 3.0, 8.0, 15.0),
        r"^no M3 screw of \d+\.\d mm; the longest in stock is 30 mm: choose a narrower bought\.leg_bearing or",
    ),
    "two cells where one is borne": (
        {"bought": {"battery": "lipo-2s-180"}},
        r"^xiao-esp32c3 at BAT\+ gets 6\.\d\d to 8\.40 V and bears 3\.20 to 4\.20 V: choose a bought\.kit, ",
    ),
    "a mount without a base": (
        {"body": {"plate_mm": 9.5}},
        r"^no room for the sensor's mount: the base of its switch is -0\.\d\d mm outside the left plate, which is "
        r"9\.5 mm thick, 0\.35 mm are needed: lower body\.plate_mm",
    ),
}  # fmt: skip


def faults(write: Write, *cases: str) -> list[str]:
    """Return what is wrong with Kenan 2.0 made with own parts; what is heavy at one side needs a wider stance."""
    workshop = load_workshop(write(joined(*(FITS[case] for case in cases), WIDE_TOES)))
    try:
        return [f"{finding.name}: {finding.message}" for finding in errors(check(build(KENAN, workshop)))]
    except CannotBuildError as error:
        return [str(error)]


@pytest.mark.thorough
@each("drawer", [DRAWER, OTHERS])
def test_a_robot_from_a_drawer_keeps_all_limits_and_costs_less_than_60_euros(drawer: str, written: Write) -> None:
    """Springs and motor as callipers and multimeter tell; what a bundle keeps of the workshop is read as the same."""
    shop = load_workshop(written(drawer))
    robot = build(KENAN, shop)
    assert {finding.severity for finding in check(robot)} == {"info"}
    assert simulate(robot).verdict == "jump"
    cost = bill_of_materials(robot).cost_eur
    assert cost is not None
    assert 20.0 < cost < 60.0
    assert load_workshop(written(shop.to_toml())) == shop
    assert load_workshop(written(commented_workshop(shop, "drawer"))) == shop


@pytest.mark.thorough
@pytest.mark.parametrize("robot", ROBOTS)
def test_what_fits_passes_every_check(robot: str, written: Write) -> None:
    """Where it does not, each own part alone shows which one."""
    if found := faults(written, *ROBOTS[robot]):
        pytest.fail(f"{found}; alone: { {case: faults(written, case) for case in ROBOTS[robot]} }")


@pytest.mark.parametrize("case", REFUSED)
def test_what_does_not_fit_is_refused_by_its_name(case: str, written: Write, tmp_path: Path) -> None:
    """In one line, and nothing is written."""
    tables, words = REFUSED[case]
    with pytest.raises(JumpcadError, match=words) as caught:
        export(build(KENAN, load_workshop(written(tables))), tmp_path / "out", pictures=False)
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_the_pinion_of_a_thick_shaft_keeps_a_wall_around_it(written: Write) -> None:
    workshop = load_workshop(written(FITS["gear motor of 25 mm, shaft of 8 mm"]))
    pinion = build(KENAN, workshop).layout.drive.train.stages[0].pinion
    assert pinion.root_radius_mm >= 4.0 + workshop.fits.press_mm + workshop.fits.wall_mm


def test_a_wide_socket_stays_clear_of_the_cam(written: Write) -> None:
    robot = build(KENAN, load_workshop(written(large())))
    layout = robot.layout
    apart = float(((layout.motor_mm - layout.cam_axis_mm) ** 2).sum() ** 0.5)
    assert apart >= layout.drive.cam.outer_radius_mm + 25.0 / 2.0


def test_a_heavy_motor_is_not_taken_where_a_light_one_turns_the_cam(written: Write) -> None:
    heavy = joined(large(), {"bought": {"motors": []}})
    assert build(KENAN, load_workshop(written(heavy))).layout.drive.train.motor.name != "own"


@pytest.mark.thorough
@pytest.mark.usefixtures("built_once", "checked_once")
def test_the_example_of_the_documentation_passes_every_check_and_its_parts_are_listed(written: Write) -> None:
    """With a spring that is not used: it is the robot of the bundle below."""
    example = build(KENAN, load_workshop(written(EXAMPLE + SPRING)), "kenan-2.0")
    assert not errors(check(example))
    lines = {line.name: line for line in bill_of_materials(example).items}
    assert lines["gear motor square-16"].mass_kg == pytest.approx(0.032)
    assert next(line for name, line in lines.items() if name.startswith("ball bearing 693 ZZ, 3 x ")).quantity == 2
    assert lines["my LiPo 2S 180 mAh"].mass_kg == pytest.approx(0.0134)


@pytest.mark.thorough
@pytest.mark.usefixtures("built_once", "checked_once")
def test_a_bundle_with_own_parts_builds_again_from_itself(written: Write, tmp_path: Path) -> None:
    """What it read back otherwise would be another workshop, whose robot is built and checked anew."""
    first, second = tmp_path / "first", tmp_path / "second"
    quick = ("kenan-2.0", "--no-pictures", "--json")
    assert exit_code_of("build", *quick, "--workshop", str(written(EXAMPLE + SPRING)), "-o", str(first)) == 0
    assert exit_code_of("build", *quick, "--workshop", str(first / "workshop.toml"), "-o", str(second)) == 0
    listed = json.loads((first / "manifest.json").read_text())["files"]
    assert filecmp.cmpfiles(first, second, [*listed, "manifest.json"], shallow=False)[1:] == ([], [])
    assert "gear motor square-16" in (first / "bom.csv").read_text()
