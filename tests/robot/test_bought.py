"""What is bought: rods as long and as heavy as their articles say, screws of stock lengths, springs of either hand."""

import math

import numpy as np
import pytest
import trimesh
from support.built import LONG_TOES, body_in_plane, built, cut, placed, region
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.building.assembly import assembled
from jumpcad.catalogue import load_catalogue
from jumpcad.design import load_design
from jumpcad.mechanism.model import MAIN_LEG
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot.robot import Robot
from jumpcad.robot.train.thing import _d_shaft
from jumpcad.strength.growth import Growth
from jumpcad.workshop import load_workshop


@pytest.fixture(scope="module", params=["kenan-2.0", LONG_TOES])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


def reach_mm(item: BoughtPart) -> np.ndarray:
    """Return the least and the greatest y of a bought part in the frame of its body."""
    return item.shown_mesh.copy().apply_transform(item.T_body_part).bounds[:, 1]


def test_a_rod_is_steel_of_the_length_in_its_name(robot: Robot) -> None:
    rods = [item for item in robot.hardware if item.article.startswith("spring steel rod 3 x ")]
    assert {"leg_axle", "cam_axle", "front_axle", "spring_pin"} <= {r.name for r in rods}
    for rod in rods:
        length = float(rod.article.split()[-2])
        assert np.ptp(reach_mm(rod)) == pytest.approx(length, abs=0.051), rod.name
        assert rod.mass.mass_kg == pytest.approx(7.85e-6 * math.pi / 4.0 * 3.0**2 * length, rel=0.01), rod.name


def test_the_two_springs_mirror_each_other(robot: Robot) -> None:
    left, right = (next(item for item in robot.hardware if item.name == f"spring_{side}") for side in ("left", "right"))
    assert left.article.replace("right hand", "left hand") == right.article
    assert left.mass.mass_kg == pytest.approx(right.mass.mass_kg)
    assert left.mass.com_m * [1.0, -1.0, 1.0] == pytest.approx(right.mass.com_m, abs=1e-6)


@pytest.fixture(scope="module", params=["kenan-2.0", "best-bo"])
def assembled_robot(request: pytest.FixtureRequest) -> Robot:
    return assembled(load_design(request.param), load_workshop(), request.param, Growth())


def named(assembled_robot: Robot, beginning: str) -> list[BoughtPart]:
    return [thing for thing in assembled_robot.hardware if thing.name.startswith(beginning)]


def grams(things: list[BoughtPart]) -> float:
    return 1000.0 * math.fsum(thing.mass_kg for thing in things)


def test_the_motor_weighs_what_the_catalogue_says_with_its_shaft(assembled_robot: Robot) -> None:
    """A motor is weighed whole: its shaft is drawn apart, since it lies elsewhere, and is ordered with it."""
    motor = assembled_robot.layout.drive.train.motor
    things = [thing for thing in assembled_robot.hardware if motor.name in thing.article]
    assert grams(things) == pytest.approx(motor.mass_g, rel=1e-9)
    assert sum(thing.units for thing in things) == 1
    shaft = next(thing for thing in things if thing.name == "motor_shaft")
    assert grams([shaft]) == pytest.approx(
        7.85e-3 * math.pi / 4.0 * motor.shaft_mm**2 * motor.shaft_length_mm, rel=0.01
    )


def test_electronics_weigh_what_the_catalogue_says(assembled_robot: Robot) -> None:
    electronics = assembled_robot.layout.electronics
    for name in ("battery", "controller", "driver"):
        (thing,) = named(assembled_robot, name)
        assert grams([thing]) == pytest.approx(getattr(electronics, name).mass_g, rel=1e-9)


def test_a_lock_nut_is_a_hexagon_of_din_985(assembled_robot: Robot) -> None:
    """M3: 5.5 mm across the flats, 4.0 mm high; a regular hexagon has an area of s²·√3/2."""
    (nut,) = named(assembled_robot, "roller_nut")
    volume = (5.5**2 * math.sqrt(3.0) / 2.0 - math.pi / 4.0 * 3.0**2) * 4.0
    assert nut.shape.moments[0] == pytest.approx(volume, rel=0.01)
    size = np.ptp(np.asarray(nut.shown_mesh.vertices), axis=0)
    assert sorted(size) == pytest.approx([4.0, 5.5, 5.5 * 2.0 / math.sqrt(3.0)], abs=0.01)


def test_a_springs_arms_take_a_wires_room_beside_the_plate_and_beside_the_leg(assembled_robot: Robot) -> None:
    layout = assembled_robot.layout
    spring, lateral = layout.drive.spring, layout.lateral
    for side, (low, high) in (("left", lateral.spring_left), ("right", lateral.spring_right)):
        for thing, hub, right in zip(
            named(assembled_robot, f"spring_{side}"),
            (layout.hub_mm, np.zeros(2)),
            (side == "right", side == "left"),
            strict=True,
        ):
            corners = trimesh.transform_points(thing.solid.to_mesh64().vert_properties[:, :3], thing.T_body_part)
            out = np.hypot(*(corners[:, ::2] - hub).T) > spring.outer_diameter_mm / 2.0 + 1e-3
            first = low if right else high - spring.wire_mm
            assert [corners[out, 1].min(), corners[out, 1].max()] == pytest.approx(
                [first, first + spring.wire_mm], abs=1e-4
            )


@pytest.mark.parametrize("preload_deg", [0.0, 5.0])
def test_coil_and_leg_arm_are_one_wire_at_rest(preload_deg: float) -> None:
    """The coil ends where the leg's arm leaves it, in place and direction, with springs that are loaded at rest too."""
    robot = build(load_design("kenan-2.0"), workshop_with(spring={"preload_deg": preload_deg}))
    T_body_leg = body_in_plane(robot, MAIN_LEG, 0.0)
    things = {item.name: item for item in robot.hardware}
    for side in ("left", "right"):
        coil, arm = things[f"spring_{side}"].wire.points_mm, things[f"spring_{side}_leg_arm"].wire.points_mm
        ends = [T_body_leg @ [x, z, 1.0] for x, _, z in arm[-2:]]
        assert coil[-1][[0, 2]] == pytest.approx(ends[0][:2], abs=1e-3)
        along, chord = ends[1][:2] - ends[0][:2], (coil[-1] - coil[-2])[[0, 2]]
        cosine = along @ chord / np.linalg.norm(along) / np.linalg.norm(chord)
        assert cosine > math.cos(math.radians(9.0))  # a chord of 15° is turned by half of that


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_shafts_flat_lies_on_the_flat_of_the_pinions_bore(name: str) -> None:
    """All of its section is in the bore but for what five crush ribs take of it, each a tenth of a mm deep or less."""
    robot = built(name)
    lateral, shaft = robot.layout.lateral, next(item for item in robot.hardware if item.name == "motor_shaft")
    y = lateral.gears[-1][0] + 1.0
    pinion = region(cut(placed(robot, "motor_pinion"), y))
    section = region(cut(shaft.shown_mesh.copy().apply_transform(shaft.T_body_part), y))
    assert section.area == pytest.approx(math.pi * 1.5**2, rel=0.15)
    assert section.intersection(pinion).area < 0.02 * section.area


@pytest.mark.parametrize(("diameter", "across"), [(3.0, 2.5), (4.0, 3.5)])
def test_a_d_shaft_is_a_disc_without_a_segment(diameter: float, across: float) -> None:
    """Area of a segment beyond a chord at h from the middle: r²·acos(h/r) - h·√(r² - h²)."""
    r, h = diameter / 2.0, across - diameter / 2.0
    segment = r**2 * math.acos(h / r) - h * math.sqrt(r**2 - h**2)
    assert _d_shaft(diameter, across).area() == pytest.approx(math.pi * r**2 - segment, rel=5e-3)


def test_small_steel_weighs_what_the_catalogue_says(assembled_robot: Robot) -> None:
    catalogue = load_catalogue()
    expected = {"roller_nut": catalogue.nuts["M3 nyloc"].mass_g, "roller_washer": catalogue.washers["M3"].mass_g}
    for name in ("roller", "hub_bearing_1", "hub_bearing_2"):
        (bearing,) = named(assembled_robot, name) if name != "roller" else named(assembled_robot, "roller")[:1]
        assert bearing.name == name
        expected[name] = catalogue.bearings[bearing.article.split()[2]].mass_g
    found = {one.name: 1000.0 * one.mass_kg for one in assembled_robot.hardware if one.name in expected}
    assert found == pytest.approx(expected, rel=1e-9)


def test_screws_weigh_shank_and_head(assembled_robot: Robot) -> None:
    """Steel of 7.85 g/cm³; a button head is rounded: more than half of the cylinder around it, and less than all."""
    catalogue = load_catalogue()
    screws = [item for item in assembled_robot.hardware if item.article.startswith("screw ")]
    assert {"cap_screw_1", "roller_screw", "standoff_1_screw_left", "sensor_screw_1"} <= {one.name for one in screws}
    for item in screws:
        kind, length = item.article.split()[1], float(item.article.split()[3])
        screw = catalogue.screws[kind]
        shank = screw.diameter_mm**2 * length
        head = screw.button_head_mm**2 * screw.button_head_height_mm
        least, most = (7.85e-6 * math.pi / 4.0 * (shank + share * head) for share in (0.5, 1.0))
        assert least < item.mass_kg < most, item.name
        assert item.shape.moments[0] == pytest.approx(math.pi / 4.0 * (shank + head), rel=0.005), item.name
