"""Plans measured with shapely and by the law of cosines: gears mesh, nothing is in the way of what moves."""

import itertools
import math
from dataclasses import fields, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely
from support.built import LONG_TOES, built, geared, in_body

from jumpcad.building.assembly import plan_of
from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import errors
from jumpcad.layout.plan import CLEAR_MM, TRAY_MM, Electronics, Plan, make_plan
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.mechanism.model import FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.workshop import load_workshop

LARGE_CAM = Design.from_vector([99.797, 1.028, 0.8, 0.924, 0.823, 70.182, 28.683, 36.353])
"""A robot that nothing finds room above: its cam reaches up to 87 mm."""
NARROW = Design.from_vector([192.41447, 0.913403, 0.683251, 0.737175, 0.743193, 64.881978, 28.74928, 25.276114])
"""A robot whose spring pin has a place of a few degrees, between main leg and cam gear."""
NAMES = ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", LONG_TOES]


@cache
def plans() -> dict[str, Plan]:
    """Return the plans of named designs and of some drawn at random from the search's box."""
    found = {name: built(name).plan for name in NAMES} | {"geared": geared().plan}
    rng, workshop = np.random.default_rng(8), load_workshop("default")
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
    for number in range(40):
        design = Design.from_vector(rng.uniform(lower, upper).tolist())
        if not errors(geometry_findings(design)):
            found[f"random {number}"] = plan_of(design, workshop)[0]
    found["narrow"] = plan_of(NARROW, load_workshop("fine"))[0]
    for name in NAMES:  # so that there is something to step aside for
        carried, drive = found[name].electronics, found[name].drive
        long = carried.battery.model_copy(update={"length_mm": found[name].design.l1_mm + 30.0})
        tall = drive.train.motor.model_copy(update={"width_mm": 30.0, "height_mm": 30.0})
        near = replace(drive.train, motor=tall, stages=(replace(drive.train.stages[0], centre_distance_mm=50.0),))
        found[f"{name} with a long battery and a thick motor"] = plan_again(
            found[name], electronics=replace(carried, battery=long), drive=replace(drive, train=near)
        )
    return found


def plan_again(plan: Plan, **changed: Any) -> Plan:
    """Return a plan made again from what it was made from, or from something else."""
    spring = plan.drive.spring
    assert plan.lateral.cam[1] - plan.lateral.cam[0] == pytest.approx(4.0)  # a 623 bearing
    given = {
        "design": plan.design, "sections": plan.sections, "drive": plan.drive, "electronics": plan.electronics,
        "plate_mm": load_workshop("default").body.plate_mm, "roller_width_mm": 4.0, "axle_mm": 3.0,
    }  # fmt: skip
    assert spring.pin_radius_mm == plan.leg_pin_mm
    return make_plan(**(given | changed))


def box(centre: np.ndarray, length: float, height: float, angle_rad: float = 0.0) -> shapely.Geometry:
    flat = shapely.box(-length / 2, -height / 2, length / 2, height / 2)
    turned = shapely.affinity.rotate(flat, math.degrees(angle_rad), origin=(0, 0))
    return shapely.affinity.translate(turned, *centre)


def motor(plan: Plan) -> shapely.Geometry:
    """Return the bare motor; its socket is larger."""
    made = plan.drive.train.motor
    return box(plan.motor_mm, made.width_mm, made.height_mm, plan.motor_angle_rad)


def standoffs(plan: Plan) -> dict[str, shapely.Geometry]:
    """Return M3 standoffs 5.5 mm across flats as rounds."""
    return {f"standoff {n}": shapely.Point(*place).buffer(2.75) for n, place in enumerate(plan.standoffs_mm)}


def electronics(plan: Plan) -> shapely.Geometry:
    """Return battery and boards one above the other."""
    carried = plan.electronics
    height = 2 * TRAY_MM + carried.battery.height_mm + max(carried.controller.height_mm, carried.driver.height_mm)
    return box(plan.tray_mm + np.array([0.0, height / 2.0]), carried.battery.length_mm, height)


def test_axes_of_gears_are_at_their_centre_distances() -> None:
    for name, plan in plans().items():
        axes = [plan.motor_mm, *([] if plan.idler_mm is None else [plan.idler_mm]), plan.cam_axis_mm]
        assert len(axes) == len(plan.drive.train.stages) + 1
        for pair, one, other in zip(plan.drive.train.stages, axes, axes[1:], strict=False):
            assert math.dist(one, other) == pytest.approx(pair.centre_distance_mm), name
        assert plan.cam_axis_mm - plan.hub_mm == pytest.approx(plan.drive.cam.cam_axis_mm)


def test_pivots_pins_and_axles_are_where_the_design_says() -> None:
    for name, plan in plans().items():
        assert math.dist(plan.hub_mm, plan.front_mm) == pytest.approx(plan.design.l1_mm), name
        assert math.dist(plan.spring_pin_mm, plan.hub_mm) == pytest.approx(plan.drive.spring.pin_radius_mm)
        assert plan.spring_pin_mm[1] > plan.hub_mm[1]
        assert set(plan.axles) == {"leg", "front", "cam"} | ({"idler"} if name == "geared" else set())
        assert plan.tray_mm[1] >= 0  # everything bought sits above the line of the pivots
        assert all(place[1] >= 0 for place in plan.standoffs_mm)


def test_what_stands_in_the_body_stands_clear() -> None:
    """Motor, electronics, standoffs and axles against each other."""
    for name, plan in plans().items():
        things = {"motor": motor(plan), "electronics": electronics(plan)} | standoffs(plan)
        things |= {f"{axle} axle": shapely.Point(*place).buffer(1.5) for axle, place in plan.axles.items()}
        things["spring pin"] = shapely.Point(*plan.spring_pin_mm).buffer(1.5)
        for one, other in itertools.combinations(things, 2):
            assert things[one].distance(things[other]) >= CLEAR_MM, f"{name}: {one} beside {other}"


def test_what_moves_passes_what_stands() -> None:
    """The links' middle lines, as thick as their thinnest place, wound in forty steps."""
    for plan_name, plan in plans().items():
        design, sections = plan.design, plan.sections
        things = {"motor": motor(plan), "electronics": electronics(plan)} | standoffs(plan)
        toes = design.l5_mm * math.cos(math.radians(design.ground_link_angle_deg))
        bars = {
            MAIN_LEG: ([[0.0, 0.0], [design.l2_mm, 0.0]], sections.leg_tip_mm / 2.0),
            FRONT_LINK: ([[0.0, 0.0], [design.l3_mm, 0.0]], sections.front_mm / 2.0),
            FOOT: ([[-toes, 0.0], [design.l4_mm, 0.0]], sections.rail_tip_mm / 2.0),
        }
        for wind in np.linspace(0.0, design.compression_rad, 40):
            for body, (ends, radius) in bars.items():
                bar = shapely.LineString(in_body(plan, body, wind, np.array(ends)))
                for name, thing in things.items():
                    where = f"{plan_name}: {body} meets {name}, wound by {math.degrees(wind):.0f}°"
                    assert bar.distance(thing) >= radius, where


def test_the_cam_turns_freely_between_everything_in_its_plane() -> None:
    """In a whole turn it reaches as far as its outer radius all around."""
    for plan_name, plan in plans().items():
        cam = shapely.Point(*plan.cam_axis_mm).buffer(plan.drive.cam.outer_radius_mm)
        for name, place in plan.axles.items():
            room = cam.distance(shapely.Point(*place))
            assert name == "cam" or room >= plan.axle_mm / 2.0 + CLEAR_MM, f"{plan_name}: {name}"
        assert cam.distance(shapely.Point(*plan.spring_pin_mm)) >= plan.axle_mm / 2.0 + CLEAR_MM, plan_name
        assert all(cam.distance(standoff) >= CLEAR_MM for standoff in standoffs(plan).values()), plan_name
        assert cam.distance(electronics(plan)) >= CLEAR_MM, plan_name
        assert plan.lateral.motor[0] < plan.lateral.cam[0] < plan.lateral.cam[1] < plan.lateral.motor_cap[1]
        assert cam.distance(motor(plan)) >= CLEAR_MM, plan_name


def test_the_same_plan_twice() -> None:
    for plan in plans().values():
        again = plan_again(plan)
        for field in fields(Plan):
            one, other = getattr(plan, field.name), getattr(again, field.name)
            assert field.name in ("toes_apart", "hub_bearing") or np.array_equal(one, other), field.name


def larger(plan: Plan, what: str) -> dict[str, Any]:
    """Return what to make a plan from so that one thing is too large for it."""
    train, carried = plan.drive.train, plan.electronics
    if what == "motor":
        huge = train.motor.model_copy(update={"width_mm": 160.0, "height_mm": 160.0})
        return {"drive": replace(plan.drive, train=replace(train, motor=huge))}
    if what == "spring pin":
        spring = replace(plan.drive.spring, arm_length_mm=1.0, inside_diameter_mm=3.0)  # amid the leg
        return {"drive": replace(plan.drive, spring=spring)}
    if what == "battery":
        huge = carried.battery.model_copy(update={"length_mm": 400.0})
        return {"electronics": Electronics(huge, carried.controller, carried.driver)}
    assert what == "leg"
    return {"sections": replace(plan.sections, leg_root_mm=200.0)}


@pytest.mark.parametrize(
    ("what", "words"),
    [
        ("motor", r"^no room for the motor: \d+\.\d mm too little beside the [\w ]+: raise d_coef or carrying_link_mm"),
        ("spring pin", r"^no room for the spring pin: \d+\.\d mm too little beside the main leg: lower stiffness_nmm"),
        ("battery", r"^no room for the battery and electronics: \d+\.\d mm .*: raise d_coef .* or choose a smaller b"),
        ("leg", r"^main leg and front link come \d+\.\d mm nearer than the 0\.5 mm that they need between them: lower"),
    ],
)
def test_what_finds_no_room_is_refused_with_what_is_in_its_way(what: str, words: str) -> None:
    plan = plan_of(LARGE_CAM, load_workshop("default"))[0] if what == "battery" else plans()["kenan-2.0"]
    with pytest.raises(CannotBuildError, match=words):
        plan_again(plan, **larger(plan, what))


def test_a_cam_gear_in_the_legs_axle_is_refused() -> None:
    plan = plans()["kenan-2.0"]
    pair = plan.drive.train.stages[-1]
    room = math.dist(plan.cam_axis_mm, plan.hub_mm)
    teeth = math.ceil(2.0 * room / pair.module_mm)  # its pitch circle then passes through the axle
    huge = replace(pair, wheel=replace(pair.wheel, teeth=teeth))
    train = replace(plan.drive.train, stages=(*plan.drive.train.stages[:-1], huge))
    with pytest.raises(CannotBuildError, match=r"cam gear's tip radius of \d+\.\d mm is \d+\.\d mm too large beside"):
        plan_again(plan, drive=replace(plan.drive, train=train))
