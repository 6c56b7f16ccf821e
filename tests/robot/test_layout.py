"""Layouts measured with shapely and by the law of cosines: gears mesh, nothing is in the way of what moves."""

import itertools
import math
from contextlib import suppress
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely
from support.built import LONG_TOES, built, geared, in_body
from support.workshops import workshop_with

from jumpcad.building.assembly import layout_of
from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.dimensions import CLEAR_MM, GAP_MM, TRAY_MM
from jumpcad.drive.spring import Arms
from jumpcad.errors import CannotBuildError
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.mechanism.model import FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.robot import layout as layout_module
from jumpcad.robot.electronics.place import Electronics
from jumpcad.robot.layout import Layout, make_layout, moving_obstacles
from jumpcad.robot.space.inside import LEVER_HEAD_MM, legs_apart_mm
from jumpcad.robot.space.room import EVERYWHERE, disc
from jumpcad.robot.train.place import require_gear_room
from jumpcad.workshop import load_workshop

LARGE_CAM = Design.from_vector([99.797, 1.028, 0.8, 0.924, 0.823, 70.182, 27.5, 36.353])
"""A robot with no room above it: its cam has a radius of 45 mm."""
NARROW = Design.from_vector([196.404194, 0.958431, 0.696797, 0.679536, 0.783564, 66.619678, 27.823059, 26.157418])
"""A robot whose spring pin has a place of a few degrees, between main leg and cam gear."""
TIGHT = Design.from_vector([100.0, 1.004409, 0.546395, 1.17039, 0.8, 70.0, 28.779358, 15.343032])
"""A robot with hardly any room for its rest stop."""
NAMES = ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", LONG_TOES]


@cache
def plans() -> dict[str, Layout]:
    """Return the layouts of named designs and of some drawn at random from the search bounds."""
    found = {name: built(name).layout for name in NAMES} | {"geared": geared().layout}
    rng, workshop = np.random.default_rng(8), load_workshop("default")
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
    for number in range(40):
        design = Design.from_vector(rng.uniform(lower, upper).tolist())
        if not errors(geometry_findings(design)):
            with suppress(CannotBuildError):  # one folds its foot so far that nothing has room below the springs
                found[f"random {number}"] = layout_of(design, workshop)
    found["narrow"] = layout_of(NARROW, load_workshop("fine"))
    for name in NAMES:  # so that there is something to step aside for
        carried, drive = found[name].electronics, found[name].drive
        long = carried.battery.model_copy(update={"length_mm": found[name].design.l1_mm + 30.0})
        tall = drive.train.motor.model_copy(update={"width_mm": 30.0, "height_mm": 30.0})
        near = replace(drive.train, motor=tall, stages=(replace(drive.train.stages[0], centre_distance_mm=50.0),))
        found[f"{name} with a long battery and a thick motor"] = plan_again(
            found[name], electronics=replace(carried, battery=long), drive=replace(drive, train=near)
        )
    return found


def plan_again(layout: Layout, **changed: Any) -> Layout:
    """Return a layout made again from its inputs, some of them changed."""
    spring = layout.drive.spring
    assert layout.lateral.cam[1] - layout.lateral.cam[0] == pytest.approx(4.0)  # a 623 bearing
    given = {
        "linkage": layout.linkage, "sections": layout.sections, "drive": layout.drive,
        "electronics": layout.electronics, "hub_bearing": layout.hub_bearing, "toes_apart": layout.toes_apart,
        "workshop": load_workshop("default"), "roller": load_workshop("default").catalogue.bearings["623"],
        "plate_mm": round(float(np.ptp(layout.lateral.left_plate)), 6),
        "leg_pin_hole_mm": layout.pin_hole.diameter_mm,
        "sensor": layout.sensor.needs if layout.sensor else None,
    }  # fmt: skip
    assert spring.arms.pin_radius_mm == layout.leg_pin_mm
    return make_layout(**(given | changed))


def box(centre: np.ndarray, length: float, height: float, angle_rad: float = 0.0) -> shapely.Geometry:
    flat = shapely.box(-length / 2, -height / 2, length / 2, height / 2)
    turned = shapely.affinity.rotate(flat, math.degrees(angle_rad), origin=(0, 0))
    return shapely.affinity.translate(turned, *centre)


def motor(layout: Layout) -> shapely.Geometry:
    """Return the bare motor; its socket is larger."""
    made = layout.drive.train.motor
    return box(layout.motor_mm, made.width_mm, made.height_mm, layout.motor_angle_rad)


def standoffs(layout: Layout) -> dict[str, shapely.Geometry]:
    """Return M3 standoffs 5.5 mm across flats as rounds."""
    return {f"standoff {n}": shapely.Point(*place).buffer(2.75) for n, place in enumerate(layout.standoffs_mm)}


def electronics(layout: Layout) -> shapely.Geometry:
    """Return battery and boards one above the other."""
    carried = layout.electronics
    height = 2 * TRAY_MM + carried.battery.height_mm + max(carried.controller.height_mm, carried.driver.height_mm)
    return box(layout.tray_mm + np.array([0.0, height / 2.0]), carried.battery.length_mm, height)


def test_toes_are_as_wide_as_asked_and_never_narrower_than_their_tips() -> None:
    layout = plans()["kenan-2.0"]
    tips = layout.design.l5_mm * math.sin(math.radians(layout.design.ground_link_angle_deg))
    for asked, wide in ((0.0, tips), (tips - 5.0, tips), (tips + 5.0, tips + 5.0)):
        assert plan_again(
            layout, workshop=workshop_with(body={"toe_half_width_mm": asked})
        ).toe_half_width_mm == pytest.approx(wide)


def test_pivots_pins_and_axles_are_where_the_design_says() -> None:
    for name, layout in plans().items():
        assert math.dist(layout.hub_mm, layout.front_mm) == pytest.approx(layout.design.l1_mm), name
        assert math.dist(layout.spring_pin_mm, layout.hub_mm) == pytest.approx(layout.drive.spring.arms.pin_radius_mm)
        assert layout.spring_pin_mm[1] > layout.hub_mm[1]
        assert set(layout.axles) == {"leg", "front", "cam"} | (
            {"idler"} if len(layout.drive.train.stages) == 2 else set()
        )
        assert layout.tray_mm[1] >= 0  # everything bought sits above the line of the pivots
        assert all(place[1] >= 0 for place in layout.standoffs_mm)


def test_what_stands_in_the_body_stands_clear() -> None:
    """Motor, electronics, standoffs and axles against each other."""
    for name, layout in plans().items():
        things = {"motor": motor(layout), "electronics": electronics(layout)} | standoffs(layout)
        things |= {f"{axle} axle": shapely.Point(*place).buffer(1.5) for axle, place in layout.axles.items()}
        things["spring pin"] = shapely.Point(*layout.spring_pin_mm).buffer(1.5)
        for one, other in itertools.combinations(things, 2):
            assert things[one].distance(things[other]) >= CLEAR_MM, f"{name}: {one} beside {other}"


def test_what_moves_passes_what_stands() -> None:
    """The links' middle lines, as thick as their thinnest place, loaded in forty steps."""
    for plan_name, layout in plans().items():
        design, sections = layout.design, layout.sections
        things = {"motor": motor(layout), "electronics": electronics(layout)} | standoffs(layout)
        toes = design.l5_mm * math.cos(math.radians(design.ground_link_angle_deg))
        bars = {
            MAIN_LEG: ([[0.0, 0.0], [design.l2_mm, 0.0]], sections.leg_tip_mm / 2.0),
            FRONT_LINK: ([[0.0, 0.0], [design.l3_mm, 0.0]], sections.front_mm / 2.0),
            FOOT: ([[-toes, 0.0], [design.l4_mm, 0.0]], sections.rail_tip_mm / 2.0),
        }
        for wind in np.linspace(0.0, design.compression_rad, 40):
            for body, (ends, radius) in bars.items():
                bar = shapely.LineString(in_body(layout, body, wind, np.array(ends)))
                for name, thing in things.items():
                    where = f"{plan_name}: {body} meets {name}, loaded by {math.degrees(wind):.0f}°"
                    assert bar.distance(thing) >= radius, where


def test_the_cam_turns_freely_between_everything_in_its_plane() -> None:
    """In a whole turn it reaches as far as its outer radius all around."""
    for plan_name, layout in plans().items():
        cam = shapely.Point(*layout.cam_axis_mm).buffer(layout.drive.cam.outer_radius_mm)
        for name, place in layout.axles.items():
            room = cam.distance(shapely.Point(*place))
            assert name == "cam" or room >= layout.axle_mm / 2.0 + CLEAR_MM, f"{plan_name}: {name}"
        assert cam.distance(shapely.Point(*layout.spring_pin_mm)) >= layout.axle_mm / 2.0 + CLEAR_MM, plan_name
        assert all(cam.distance(standoff) >= CLEAR_MM for standoff in standoffs(layout).values()), plan_name
        assert cam.distance(electronics(layout)) >= CLEAR_MM, plan_name
        assert layout.lateral.motor[0] < layout.lateral.cam[0] < layout.lateral.cam[1] < layout.lateral.motor_cap[1]
        assert cam.distance(motor(layout)) >= CLEAR_MM, plan_name


def larger(layout: Layout, what: str) -> dict[str, Any]:
    """Return inputs of a layout of which one thing is too large for it."""
    train, carried = layout.drive.train, layout.electronics
    if what == "motor":
        huge = train.motor.model_copy(update={"width_mm": 160.0, "height_mm": 160.0})
        return {"drive": replace(layout.drive, train=replace(train, motor=huge))}
    if what == "spring pin":
        spring = replace(layout.drive.spring, arms=Arms(4.0, 1.0, 3.0, 1.0))  # amid the hub
        return {"drive": replace(layout.drive, spring=spring)}
    if what == "battery":
        huge = carried.battery.model_copy(update={"length_mm": 400.0})
        return {"electronics": Electronics(huge, carried.controller, carried.driver)}
    assert what == "leg"
    return {"sections": replace(layout.sections, leg_root_mm=200.0)}


@pytest.mark.parametrize(
    ("what", "words"),
    [
        ("motor", r"^no room for the motor: \d+\.\d mm too little beside the [\w ]+: raise d_coef or carrying_link_mm"),
        ("spring pin", r"^no room for the spring pin: \d+\.\d mm too little beside the lever: lower stiffness_nmm"),
        ("battery", r"^no room for the battery and electronics: \d+\.\d mm .*: raise d_coef .* or choose a smaller b"),
        ("leg", r"^main leg and front link overlap by [\d.]+ mm; 0\.8 mm between them are needed, .*: lower"),
    ],
)
def test_what_finds_no_room_is_refused_with_what_is_in_its_way(what: str, words: str) -> None:
    layout = layout_of(LARGE_CAM, load_workshop("default")) if what == "battery" else plans()["kenan-2.0"]
    with pytest.raises(CannotBuildError, match=words):
        plan_again(layout, **larger(layout, what))


def test_the_reserve_is_kept_in_the_stops_room_and_between_the_legs() -> None:
    """A robot with little room is refused as soon as the reserve is larger than that, with what misses."""
    shop = load_workshop("default")

    def planned(reserve_mm: float) -> Layout:
        return layout_of(TIGHT, workshop_with(shop, safety={"room_reserve_mm": reserve_mm}))

    free = planned(0.0)
    assert 0.0 < free.stop.room_mm < shop.safety.room_reserve_mm
    apart = legs_apart_mm(free.linkage, free.sections) - GAP_MM
    kept = planned(free.stop.room_mm - 0.01)
    assert kept.stop.room_mm == pytest.approx(0.01)
    for reserve, limit, misses in ((free.stop.room_mm + 0.01, "stop_room", 0.01), (apart + 0.02, "legs_apart", 0.02)):
        layout_module._require_legs_apart(free.linkage, free.sections, GAP_MM + apart - 0.02)
        with pytest.raises(CannotBuildError, match=rf"as near as {GAP_MM + apart:.2g} mm; {GAP_MM + apart + 2.0:g} mm"):
            layout_module._require_legs_apart(free.linkage, free.sections, GAP_MM + apart + 2.0)
        with pytest.raises(CannotBuildError) as refused:
            planned(reserve)
        assert (refused.value.limit, refused.value.margin) == (limit, pytest.approx(-misses))
        assert " 0.1 mm " in str(refused.value)  # never that nothing is missing


def test_a_cam_gear_in_the_legs_axle_is_refused() -> None:
    layout = plans()["kenan-2.0"]
    pair = layout.drive.train.stages[-1]
    room = math.dist(layout.cam_axis_mm, layout.hub_mm)
    teeth = math.ceil(2.0 * room / pair.pinion.module_mm)  # its pitch circle then passes through the axle
    huge = replace(pair, wheel=replace(pair.wheel, teeth=teeth))
    post = [disc("post", np.array([10.0, 0.0]), 2.0, EVERYWHERE)]
    require_gear_room(post, np.zeros(2), 8.0, (0.0, 1.0))
    with pytest.raises(CannotBuildError, match=r"of 8\.0 mm is 0\.1 mm too large beside"):
        require_gear_room(post, np.zeros(2), 8.01, (0.0, 1.0))
    train = replace(layout.drive.train, stages=(*layout.drive.train.stages[:-1], huge))
    with pytest.raises(CannotBuildError, match=r"cam gear's tip radius of \d+\.\d mm is \d+\.\d mm too large beside"):
        plan_again(layout, drive=replace(layout.drive, train=train))


def test_the_lever_has_room_for_the_rollers_screw_on_either_side() -> None:
    """A lock nut of 4.0 mm (DIN 985 M3) behind the lever, a head of 1.65 mm (ISO 7380-1 M3) beside the roller."""
    for layout in plans().values():
        lever = next(one for one in moving_obstacles(layout) if one.name == "lever")
        assert lever.y_mm[0] == layout.lateral.roller_screw[0] <= layout.lateral.leg[0] - 4.0
        assert layout.lateral.right_plate[1] <= layout.lateral.roller_screw[0] - 0.5
    assert 1.65 <= LEVER_HEAD_MM < 2.0
