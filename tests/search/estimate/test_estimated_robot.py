"""An estimated robot has the figures that it is made of, each where it belongs."""

import re
from dataclasses import replace

import numpy as np
import pytest
from support.built import built
from support.quick import FIGURES, LIKE
from support.robots import FOLDED

from jumpcad import evaluation
from jumpcad.building import build
from jumpcad.building.growth import statics_refusal
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.search.estimate.estimated_robot import EXTENTS, LAID, estimated_robot, robot_figures, room_findings
from jumpcad.search.models import robot_model
from jumpcad.simulation import Settings, simulate
from jumpcad.workshop import load_workshop, varied

MADE_UP = {
    name: 0.001 * number
    for number, name in enumerate(
        (f"{body}_{figure}" for body in BODY_NAMES for figure in ("com_x_m", "com_z_m", "inertia_kg_m2", "mass_kg")), 1
    )
} | {
    "foot_depth_m": 0.0175, "toe_radius_m": 0.0045, "stop_rad": 0.0625, "stop_nm_per_rad": 7.0,
    "release_turn_rad": 0.03, "release_rad_s": 4.0, "release_ratio": 0.875,
    **{f"{body}_{side}_m": at for body in BODY_NAMES
       for side, at in (("left", -0.01), ("right", 0.05), ("bottom", -0.02), ("top", 0.03))},
}  # fmt: skip


def test_figures_are_those_of_the_robot_to_six_digits() -> None:
    found = robot_figures(LIKE)
    named = {f"{name}_{figure}" for name in BODY_NAMES for figure in ("com_x_m", "com_z_m", "inertia_kg_m2")}
    sides = {f"{name}_{side}_m" for name in BODY_NAMES for side in ("left", "right", "bottom", "top")}
    others = sides | {"foot_depth_m", "toe_radius_m", "stop_rad", "stop_nm_per_rad"}
    release = {"release_turn_rad", "release_rad_s", "release_ratio"}
    assert set(found) == named | others | release | set(LAID) | set(EXTENTS)
    for name, body in LIKE.bodies.items():
        for figure, value in (
            ("com_x_m", body.com_m[0]), ("com_z_m", body.com_m[2]), ("inertia_kg_m2", body.inertia_kg_m2[1, 1]),
        ):  # fmt: skip
            assert found[f"{name}_{figure}"] == pytest.approx(value, rel=6e-6)
    assert LIKE.stop is not None
    assert LIKE.roller_off is not None
    toe = next(one for one in LIKE.bodies[FOOT].contacts if "toe" in one.name)
    for name, value in (
        ("foot_depth_m", LIKE.foot_depth_m), ("toe_radius_m", toe.radius_m), ("stop_rad", LIKE.stop.angle_rad),
        ("stop_nm_per_rad", LIKE.stop.stiffness_nm_per_rad), ("release_rad_s", LIKE.roller_off.leg_rad_s),
        ("release_ratio", LIKE.roller_off.energy_ratio),
        ("release_turn_rad", LIKE.design.compression_rad + LIKE.roller_off.leg_rad),
    ):  # fmt: skip
        assert found[name] == pytest.approx(value, rel=6e-6)


def test_figures_of_a_layout_say_where_cam_motor_and_trays_are_and_how_large_a_spring_is() -> None:
    layout, found = LIKE.layout, robot_figures(LIKE)
    places = {"cam": layout.cam_axis_mm, "motor": layout.motor_mm}
    for part, (x, z) in places.items():
        assert (found[f"laid_{part}_x_mm"], found[f"laid_{part}_z_mm"]) == pytest.approx((x, z), rel=6e-6), part
    assert found["laid_tray_x_mm"] == pytest.approx(layout.tray_mm[0], rel=6e-6)
    assert found["laid_spring_g"] == pytest.approx(layout.drive.spring.mass_g, rel=6e-6)
    assert found["laid_coil_mm"] == pytest.approx(layout.drive.spring.arms.mean_mm, rel=6e-6)


def test_each_figure_is_found_again_in_the_robot() -> None:
    """Bodies turn about y; the toes' spheres stand on the same ground as the foot's others."""
    plain, made = capsule_robot(LIKE.design), estimated_robot(LIKE.design, MADE_UP, LIKE)
    for name in BODY_NAMES:
        body = made.bodies[name]
        com = [MADE_UP[f"{name}_com_x_m"], 0.0, MADE_UP[f"{name}_com_z_m"]]
        assert (body.name, body.mass_kg, body.com_m.tolist()) == (name, MADE_UP[f"{name}_mass_kg"], com)
        assert body.inertia_kg_m2[1, 1] == MADE_UP[f"{name}_inertia_kg_m2"]
        assert (np.linalg.eigvalsh(body.inertia_kg_m2) > 0.0).all()
        assert [one.name for one in body.contacts] == [one.name for one in plain.bodies[name].contacts]
    for one, old in zip(made.bodies[FOOT].contacts, plain.bodies[FOOT].contacts, strict=True):
        toe = "toe" in one.name
        assert one.radius_m == (0.0045 if toe else 0.0175)
        assert one.centre_m[:2].tolist() == old.centre_m[:2].tolist()
        lowest = one.centre_m[2] - one.radius_m
        assert lowest == pytest.approx(old.centre_m[2] - 0.0175)
    for corners in made.outline_m.values():
        assert (corners.real.min(), corners.real.max()) == pytest.approx((-0.01, 0.05))
        assert (corners.imag.min(), corners.imag.max()) == pytest.approx((-0.02, 0.03))
    assert {one.radius_m for one in made.bodies[BODY].contacts} == {LIKE.bodies[BODY].contacts[0].radius_m}
    assert made.stop is not None
    assert (made.stop.joint, made.stop.angle_rad, made.stop.stiffness_nm_per_rad) == ("leg", 0.0625, 7.0)
    assert made.roller_off is not None
    assert (made.roller_off.leg_rad_s, made.roller_off.energy_ratio) == (4.0, 0.875)
    assert (made.foot_depth_m, made.friction) == (0.0175, LIKE.friction)
    assert FIGURES["body_mass_kg"] != MADE_UP["body_mass_kg"]


SHOP = load_workshop("default")
WEAK = load_design("best-printable").model_copy(update={"stiffness_nmm_per_deg": 5.0, "compression_ratio": 0.2})


def test_an_absurdly_weak_robot_is_refused_before_anything_is_built(monkeypatch):
    exact = replace(robot_model(), stand_in=True)(WEAK)
    assert exact.reasons[0] == "too_weak"
    assert exact.metrics["mass_kg"] > 0.0  # others learn from it: it was built
    monkeypatch.setattr(evaluation, "evaluate_made", None)
    found = robot_model()(WEAK)
    assert (found.verdict, found.reasons, dict(found.metrics)) == ("too_weak", ("too_weak",), {})
    assert [one.name for one in found.findings] == ["loop", "below_ground", "too_weak"]
    bound, true = found.findings[-1], next(one for one in exact.findings if one.name == "too_weak")
    assert bound.value == pytest.approx(true.value, rel=1e-12)  # the springs are known
    assert bound.limit < true.limit


@pytest.mark.thorough
def test_a_robot_that_stands_is_not_refused():
    """The lightest robots with springs that are hardly strong enough."""
    light = varied(load_workshop("light"), {"body.plate_mm": 1.2, "bought.axle": "steel-tube", "process.infill": 0.0})
    generator, stood = np.random.default_rng(5), 0
    while stood < 6:
        design = Design(**{name: generator.uniform(one.lower, one.upper) for name, one in SEARCH_BOUNDS.items()})
        try:
            weak = statics_findings(build(design, light))[1]
            stiffness = 1.02 * design.stiffness_nmm_per_deg * weak.limit / weak.value
            weakened = design.model_copy(update={"stiffness_nmm_per_deg": stiffness})
            stands = not errors([*geometry_findings(design), statics_findings(build(weakened, light))[1]])
        except CannotBuildError:
            continue
        assert not (stands and statics_refusal(weakened, light, Settings())), weakened
        stood += stands


def test_efficiency_and_gravity_are_those_of_the_simulation_and_springs_those_of_the_workshop():
    """On the Moon, springs of the same energy suffice for a sixth of the weight; bought ones have their own rate."""
    (earth,) = statics_refusal(WEAK, SHOP, Settings())
    assert statics_refusal(WEAK, SHOP, Settings(gravity_m_s2=9.81 / 6.0)) == ()
    (half,) = statics_refusal(WEAK, SHOP, Settings(spring_efficiency=0.5))
    assert half.value == pytest.approx(0.5 * earth.value)
    assert statics_refusal(WEAK, varied(SHOP, {"bought.spring": "9271K619"}), Settings()) == ()


@pytest.mark.thorough
def test_the_margin_is_the_message_s_millimetres_and_changes_its_sign_where_a_robot_is_built():
    """Compressed further, the legs come nearer to each other, until they touch."""
    model, margins = robot_model(), []
    for ratio in (0.6, 0.7, 0.8, 0.82, 0.85):
        found = model(FOLDED.model_copy(update={"compression_ratio": ratio}))
        rooms = {one.name: one.margin for one in found.findings if one.name in ("stop_room", "legs_apart", "pin_way")}
        assert (found.verdict == "cannot_build") == (min(rooms.values()) < 0.0)
        if found.verdict == "cannot_build":
            assert f"{-min(rooms.values()):.1f} mm" in found.detail
            assert found.reasons == (min(rooms, key=lambda name: rooms[name]),)
        margins.append(min(rooms.values()))
    assert margins[0] > 0.0 > margins[-1]
    assert margins[1:] == sorted(margins[1:], reverse=True)  # before that, the stop's room is as large as is looked


def test_a_reserve_is_taken_from_the_room_between_the_legs():
    layout = built("kenan-2.0").layout
    rooms = [{one.name: one.margin for one in room_findings(layout, reserve)} for reserve in (0.0, 1.5)]
    assert rooms[0]["legs_apart"] - rooms[1]["legs_apart"] == pytest.approx(1.5)
    assert rooms[0]["stop_room"] == rooms[1]["stop_room"]  # has its reserve already
    apart, *_ = room_findings(layout, 1.5)
    gap, needed = re.findall(r"([\d.]+) mm", apart.message)
    assert float(gap) - float(needed) == pytest.approx(apart.margin, abs=0.0051)


def test_a_robot_that_stays_on_the_ground_says_how_much_speed_is_missing():
    lower = {name: bound.lower for name, bound in SEARCH_BOUNDS.items()}
    heavy = Design(**{**lower, "compression_ratio": 0.35, "rest_angle_deg": 60.0, "stiffness_nmm_per_deg": 7.0})
    found = simulate(capsule_robot(heavy), Settings(max_time_s=0.01))
    assert found.verdict == "no_takeoff"
    (missing,) = [one for one in found.findings if one.name == "no_takeoff"]
    assert missing.severity == "error"
    assert missing.margin == pytest.approx(missing.value - missing.limit)
    assert missing.margin < 0.0
