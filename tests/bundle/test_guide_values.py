"""Figures of motor, battery, springs, sizes and jump, computed by hand from data sheets and the design."""

import itertools
import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import trimesh
from support.built import built, geared, of_kit, part, placed
from support.workshops import rewired, workshop_with

from jumpcad.building import build
from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.drawings.wiring import wires
from jumpcad.bundle.facts import jumps_per_charge
from jumpcad.bundle.firmware_numbers import numbers
from jumpcad.bundle.guide import guide_values as module
from jumpcad.bundle.guide.guide_values import _jump, _prong_mm, guide_values, loaded_grams, scale_range_kg
from jumpcad.bundle.guide.operation_values import operation_values, pin_share, state_off_v
from jumpcad.design import load_design
from jumpcad.dimensions import AXLE_FLOOR_MM
from jumpcad.electronics.nets import Wiring
from jumpcad.electronics.supply import chosen_parts
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.model import BODY, body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.transforms import chained


def values(robot: Robot) -> dict[str, Any]:
    return dict(guide_values(robot, [], bill_of_materials(robot)))


def preloaded(preload_deg: float, name: str = "kenan-2.0") -> Robot:
    return build(load_design(name), workshop_with(spring={"preload_deg": preload_deg}))


def test_the_motor_is_a_line_from_no_load_to_stall_in_series_with_battery_and_driver() -> None:
    """Pololu 2371: 6 V, 73 rpm with 70 mA, 0.67 A stalled; one cell of 3.7 to 4.2 V has no need of PWM."""
    robot = built("kenan-2.0")
    found, train, chosen = operation_values(robot), robot.layout.drive.train, chosen_parts(robot.workshop)
    series = chosen.battery.ohm + chosen.driver.resistance_ohm
    winding = 6.0 / 0.67
    rpm = 73.0 * (3.7 - 0.07 * (winding + series)) / (6.0 - 0.07 * winding)
    assert found["free_rpm"] == pytest.approx(rpm, abs=0.05)
    (stage,) = train.stages
    assert found["dry_s"] == pytest.approx(60.0 / rpm * stage.wheel.teeth / stage.pinion.teeth, abs=0.005)
    boards_a = 0.024 + 0.0017  # of the controller and of the driver
    assert found["boards_a"] == pytest.approx(boards_a, abs=5e-4)
    assert found["free_a"] == pytest.approx(0.070 + boards_a, abs=5e-4)
    assert (found["nominal_v"], found["full_v"]) == (3.7, 4.2)
    assert (found["wind_j"], found["wind_s"]) == (train.electrical_j, train.winding_s)
    assert values(robot)["jumps"] == pytest.approx(jumps_per_charge(robot), rel=0.05)


def test_under_pwm_the_battery_gives_the_motors_current_for_a_share_of_the_time() -> None:
    """A motor of 6 V on two cells, 6/8.4 of the time, and beside it the boards, always."""
    robot = of_kit("strong-2s", "kenan-2.0", motors=("n20-298",))
    found, motor = operation_values(robot), robot.layout.drive.train.motor
    boards = (0.024 * 5.0 / 0.9 + 7.4 * (0.0017 + 0.001)) / 7.4
    assert motor.name == "n20-298"
    assert found["boards_a"] == pytest.approx(boards, abs=5e-4)
    assert found["free_a"] == pytest.approx(6.0 / 8.4 * motor.no_load_current_a + boards, abs=5e-4)


def test_batteries_are_charged_and_stored_by_their_cells() -> None:
    """300 mAh at 370 mA, and half as long again; 3.8 V a cell for storage, 3.0 V is the end of a cell."""
    for robot, cells in ((built("kenan-2.0"), 1), (of_kit("strong-2s"), 2)):
        found = operation_values(robot)
        assert found["charged_by_usb"] is (cells == 1)
        assert (found["stored_v"], found["dead_v"]) == pytest.approx((3.8 * cells, 3.0 * cells))
        battery = chosen_parts(robot.workshop).battery
        assert found["outside_ma"] == min(battery.capacity_mah, battery.bears_ma)
        if cells == 1:
            assert found["charge_rate"] == pytest.approx(370.0 / 300.0)
            assert found["charge_h"] == pytest.approx(1.5 * 300.0 / 370.0)


LOWER, CORNERS = 200e3, tuple(itertools.product((0.99, 1.0, 1.01), repeat=2))
"""The lower resistor (ohm); both resistors are of 1 %."""


def test_a_multimeter_reads_the_divider_with_itself_beside_the_lower_resistor() -> None:
    """10 MΩ in parallel, by Ohm's law, and 1 % of the reading."""
    for upper in (200_000, 470_000, 680_000, 1_000_000):
        read = []
        for one, other in CORNERS:
            lower = 1.0 / (1.0 / (LOWER * one) + 1.0 / 10e6)
            read += [lower / (lower + upper * other) * meter for meter in (0.99, 1.01)]
        assert pin_share(Wiring((), {}, upper)) == pytest.approx((min(read), max(read)), rel=5e-4), upper


def test_state_is_off_by_resistors_and_converter() -> None:
    """The pin's voltage, 35 mV off, times the divider that the firmware believes."""
    for upper, volts in ((200_000, 3.7), (680_000, 7.4)):
        believed = (upper + LOWER) / LOWER
        off = [
            abs(believed * (volts * LOWER * one / (LOWER * one + upper * other) + converter) - volts)
            for one, other in CORNERS
            for converter in (-0.035, 0.035)
        ]
        assert state_off_v(Wiring((), {}, upper), volts) == pytest.approx(max(off), rel=0.02), upper


@pytest.mark.thorough
def test_one_pair_of_gears_turns_the_cam_against_the_motor_and_two_with_it() -> None:
    one, two = values(built("kenan-2.0")), values(geared())
    assert one["cam_turn"] == two["cam_turn"] == two["motor_turn"] == "counter-clockwise"
    assert one["motor_turn"] == "clockwise"


@pytest.mark.thorough
def test_what_hands_feel_of_the_springs_follows_from_hookes_law() -> None:
    """A spring of k N·mm/° pushes with k times its angle over the lever; both on the leg's pin at the hub.

    With the leg on its stop, 3° past rest, a spring is loaded by 3° less.
    """
    for preload_deg in (0.0, 4.0):
        robot = preloaded(preload_deg)
        found, spring, design = values(robot), robot.layout.drive.spring, robot.design
        rate = design.stiffness_nmm_per_deg / 2.0
        compression_deg = math.degrees(design.compression_rad)
        wound_deg = compression_deg if not preload_deg else math.degrees(spring.wound_rad)
        wider, at_stop = math.floor(0.1 * wound_deg), preload_deg - 3.0
        assert found["stroke_deg"] == pytest.approx(compression_deg)
        assert found["lift_deg"] == pytest.approx(310.0)
        slack = (3, 13) if not preload_deg else (0, 9)
        assert (found["slack_deg"], found["most_slack_deg"]) == slack
        assert found["wider_deg"] == wider
        assert found["stop_deg"] == pytest.approx(max(0.0, at_stop))
        assert found["stop_n"] == pytest.approx(max(0.0, at_stop) * rate / spring.arms.lever_mm)
        assert found["arm_n"] == pytest.approx(max(1.0, (at_stop + wider) * rate / spring.arms.lever_mm))
        assert found["pull_n"] == pytest.approx(2.0 * rate * wound_deg / design.carrying_link_mm)
        joules = rate * math.radians(1.0) * (wound_deg**2 - preload_deg**2) / 1000.0
        assert found["energy_j"] == pytest.approx(joules, rel=1e-6)


def test_a_scale_bears_a_spring_that_is_stiff_by_its_tolerance() -> None:
    """10 % more than computed, in whole kilograms; grams are of force, 9.80665 N a kilogram."""
    robot = built("kenan-2.0")
    drive = robot.layout.drive
    assert robot.workshop.safety.spring_rate_scatter == 0.1
    for grams, kilograms in ((400.0, 1), (905.0, 1), (920.0, 2), (1800.0, 2), (1850.0, 3)):
        lever = drive.spring.torque_nmm / (9.80665e-3 * grams)
        spring = replace(drive.spring, arms=replace(drive.spring.arms, lever_mm=lever))
        assert loaded_grams(spring) == pytest.approx(grams, rel=1e-3)
        own = replace(robot, layout=replace(robot.layout, drive=replace(drive, spring=spring)))
        assert scale_range_kg(own) == kilograms, grams


def test_the_block_stops_half_a_millimetre_before_what_stands_beside_the_window() -> None:
    """An N20's window is 8 x 10 mm; the block is 9 mm long, with 3 to 6 mm on either side, in halves of a millimetre.

    The thing is 2 mm wide and long, `across` and `along` from the window's middle, outside of the plate.
    """
    robot = built("kenan-2.0")
    layout, item = robot.layout, next(one for one in robot.hardware if one.body == "body")
    for across, along, out, prong in (
        (20.0, 0.0, 1.0, 6.0), (8.1, 0.0, 1.0, 3.5), (8.4, 4.9, 1.0, 3.5), (8.1, 5.1, 1.0, 6.0), (5.0, 0.0, 1.0, 3.0),
        (8.1, 0.0, -3.0, 6.0),
    ):  # fmt: skip
        for sign in (1.0, -1.0):
            sides = (across, across + 2.0)
            corners = np.array([[x, y, z] for x in sides for y in (0.0, out) for z in (along, along + 2.0)])
            turn = layout.motor_angle_rad
            cos, sin = sign * math.cos(turn), sign * math.sin(turn)
            points = np.column_stack([
                layout.motor_mm[0] + cos * corners[:, 0] - sin * corners[:, 2],
                layout.lateral.right_plate[0] - corners[:, 1],
                layout.motor_mm[1] + sin * corners[:, 0] + cos * corners[:, 2],
            ])  # fmt: skip
            thing = replace(item, T_body_part=np.eye(4))
            vars(thing)["shown_mesh"] = SimpleNamespace(vertices=points)  # the mesh that is seen
            assert _prong_mm(replace(robot, hardware=(thing,))) == prong, (across, along, out, sign)


@pytest.mark.thorough
def test_sizes_are_those_of_the_parts() -> None:
    """A rod of 3 mm in a bore reamed 0.1 mm wider; a rod may be 0.3 mm short, and then has as much more play."""
    robot = built("kenan-2.0")
    found = values(robot)
    assert found["reamed_mm"] == pytest.approx(3.1)
    least, most = found["end_play_mm"]
    assert most - least == pytest.approx(0.3)
    rod = next(item for item in robot.hardware if item.name == "leg_axle")
    between = float(np.diff(robot.layout.lateral.outside)[0]) - 2.0 * AXLE_FLOOR_MM  # of the plates' closed bores
    assert least == pytest.approx(between - float(np.ptp(rod.shown_mesh.vertices[:, 2])), abs=0.051)
    assert found["motor_wire_mm"] == max(mm for *_, end, _, mm in wires(robot) if end.part == "motor")
    for name in ("front_spacer_right", "front_spacer_left", "spring_bushing_left", "cam_spacer_right"):
        assert found["tube_mm"][name] == pytest.approx(float(part(robot, name).mesh.extents[2]), abs=0.001)
    two = geared()
    for name in ("cam_spacer_left", "idler_spacer_right"):
        assert values(two)["tube_mm"][name] == pytest.approx(float(part(two, name).mesh.extents[2]), abs=0.001)
    socket, cap = (placed(robot, name).bounds[:, 1] for name in ("body_plate_right", "motor_cap"))
    assert found["clamp_mm"] == pytest.approx(cap[0] - socket[1], abs=1e-3)  # the cap lies on the motor
    plates = [placed(robot, f"body_plate_{side}").bounds[:, 1] for side in ("left", "right")]
    assert found["axle_length_mm"] == pytest.approx(float(np.ptp(plates)), abs=1e-3)
    window, block = found["window_mm"], found["block_mm"]
    assert block == pytest.approx((window[0] + 12.0, window[1] - 1.0))
    assert found["program"] == numbers(robot)


def test_the_free_floor_is_twice_the_jump_and_a_metre_at_least(monkeypatch: pytest.MonkeyPatch) -> None:
    """In steps of half a metre upwards; 3 m by 2 m where nothing is known of the jump."""
    robot = built("kenan-2.0")

    def told(**jump: object) -> tuple[object, ...]:
        monkeypatch.setattr(module, "headline", lambda *_: SimpleNamespace(**jump))
        return tuple(_jump(robot)[name] for name in ("range_mm", "rise_mm", "far_m", "high_m"))

    assert told(verdict="jump", touchdown_distance_m=0.883, com_rise_m=0.634) == (880, 630, 2.0, 1.5)
    assert told(verdict="jump", touchdown_distance_m=0.31, com_rise_m=0.12) == (310, 120, 1.0, 1.0)
    for verdict, reach, rise in (("no jump", 0.9, 0.6), ("jump", None, 0.6), ("jump", 0.9, None)):
        assert told(verdict=verdict, touchdown_distance_m=reach, com_rise_m=rise) == (None, None, 3.0, 2.0)

    def refused(*_: object) -> None:
        raise CannotBuildError("no engine")

    monkeypatch.setattr(module, "headline", refused)
    assert _jump(robot) == {"range_mm": None, "rise_mm": None, "far_m": 3.0, "high_m": 2.0}


def test_screws_are_tightened_by_their_size_and_less_in_plastic() -> None:
    """Usual tables give 1.3 N·m for M3 and 0.37 N·m for M2 of strength 8.8; M3 strips its thread in plastic sooner."""
    m3, m2, plastic = module.TORQUE_M3_NM, module.TORQUE_M2_NM, module.TORQUE_PLASTIC_NM
    assert 1.3 / 4.0 < m3 < 1.3 / 2.0
    assert 0.37 / 4.0 < m2 < 0.37 / 2.0
    assert m2 < plastic < m3


def test_the_capacitors_wires_start_at_named_pins_of_the_driver() -> None:
    """Both poles; without a capacitor the pins have no name here."""
    robot = built("kenan-2.0")
    driver = chosen_parts(robot.workshop).driver
    supply, ground = (one.removeprefix("driver ") for one in operation_values(robot)["driver_supply"])
    assert supply in driver.supply_v
    assert ground in driver.with_function("ground")
    bare = workshop_with(robot.workshop, bought={"capacitor": ""})
    assert operation_values(rewired(robot, bare))["driver_supply"] == []


TIP_MM, SHANK_MM, TIP_LENGTH_MM = 2.0, 5.0, 8.0
"""A pencil iron: diameter of tip and of what follows it, length of the tip."""


ROBOTS = {
    "kenan-2.0": lambda: built("kenan-2.0"),
    "strong-2s": lambda: of_kit("strong-2s", "best-bo"),
    "two pairs of gears": geared,
}


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request: pytest.FixtureRequest) -> Robot:
    return ROBOTS[request.param]()


def loaded(robot: Robot) -> dict[str, trimesh.Trimesh]:
    """Return all that is seen of a robot with loaded springs, by name, in the body's frame (mm)."""
    poses = body_poses(robot, 1.0)
    T_body_world = np.linalg.inv(poses[BODY])
    T_mm = np.diag([1000.0, 1000.0, 1000.0, 1.0])
    shown = {}
    for thing in visuals(robot):
        pose = T_mm @ T_body_world @ chained(poses[thing.body], thing.T_body_mesh) @ np.linalg.inv(T_mm)
        shown[thing.name] = thing.mesh.copy().apply_transform(pose)
    return shown


def rod(start: np.ndarray, end: np.ndarray, diameter_mm: float) -> trimesh.Trimesh:
    """Return a cylinder between two points."""
    return trimesh.creation.cylinder(diameter_mm / 2.0, segment=np.stack([start, end]), sections=24)


@pytest.mark.thorough
def test_an_iron_reaches_the_end_of_the_motors_shaft_through_the_left_plate(robot: Robot) -> None:
    things, (x, z) = loaded(robot), robot.layout.motor_mm
    shaft = things["motor_shaft"].bounds[1][1]
    outside = robot.layout.lateral.left_plate[1]
    iron = [
        rod(np.array([x, shaft + 0.05, z]), np.array([x, outside + TIP_LENGTH_MM, z]), TIP_MM),
        rod(np.array([x, outside + TIP_LENGTH_MM, z]), np.array([x, outside + 60.0, z]), SHANK_MM),
    ]
    for name, mesh in things.items():
        if name.startswith(("wiring", "tie", "tape")):
            continue  # laid where there is room
        for piece in iron:
            if (mesh.bounds[0] < piece.bounds[1]).all() and (piece.bounds[0] < mesh.bounds[1]).all():
                both = trimesh.boolean.intersection([mesh, piece], engine="manifold")
                assert both.is_empty or both.volume < 0.01, name
    assert shaft > robot.layout.lateral.left_plate[0] - 2.0  # it ends in the hole or just before it


def test_a_stick_reaches_a_quarter_of_the_cam_gears_rim(robot: Robot) -> None:
    """Of its rim, at the tips of the teeth, that much is outside both plates' convex outlines, seen from the side."""
    import shapely

    outlines = [
        shapely.convex_hull(shapely.multipoints(placed(robot, f"body_plate_{side}").vertices[:, [0, 2]]))
        for side in ("left", "right")
    ]
    radius = robot.layout.drive.train.stages[-1].wheel.tip_radius_mm
    angles = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
    rim = robot.layout.cam_axis_mm + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    open_to = ~np.any([shapely.contains_xy(outline, *rim.T) for outline in outlines], axis=0)
    assert open_to.mean() > 0.25


@pytest.mark.thorough
def test_no_cutter_reaches_the_teeth_in_mesh(robot: Robot) -> None:
    """Jaws of 3 mm come to the pinion from no side within 30 degrees of them, along the gears or 30 degrees aside."""
    things, layout = loaded(robot), robot.layout
    wheel = layout.cam_axis_mm if layout.idler_mm is None else layout.idler_mm
    to_mesh = np.arctan2(*(wheel - layout.motor_mm)[::-1])
    middle = np.array([layout.motor_mm[0], sum(layout.lateral.gears[-1]) / 2.0, layout.motor_mm[1]])
    radius = layout.drive.train.stages[0].pinion.tip_radius_mm
    others = [mesh for name, mesh in things.items() if name not in ("motor_pinion", "motor_shaft")]
    for aside in np.radians([-30.0, -15.0, 0.0, 15.0, 30.0]):
        outwards = np.array([np.cos(to_mesh + aside), 0.0, np.sin(to_mesh + aside)])
        for tilt in np.radians([-30.0, 0.0, 30.0]):
            along = np.cos(tilt) * outwards + np.sin(tilt) * np.array([0.0, 1.0, 0.0])
            jaws = rod(middle + (radius - 1.0) * outwards, middle + (radius - 1.0) * outwards + 60.0 * along, 3.0)
            near = [m for m in others if (m.bounds[0] < jaws.bounds[1]).all() and (jaws.bounds[0] < m.bounds[1]).all()]
            cut = (trimesh.boolean.intersection([mesh, jaws], engine="manifold") for mesh in near)
            assert any(not both.is_empty and both.volume > 0.3 for both in cut), np.degrees([aside, tilt])
