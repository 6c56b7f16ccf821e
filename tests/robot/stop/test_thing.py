"""Findings of the rest stop, by handbook formulas; what is refused."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
import trimesh
from support.built import built, cut, part, placed, region
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.checks import check, constraint_findings
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.exporters.mjcf_robot import write_robot
from jumpcad.findings import Finding, errors
from jumpcad.robot.robot import Robot
from jumpcad.robot.stop.thing import stop_findings
from jumpcad.scene.visuals import visuals
from jumpcad.workshop import Workshop


def workshop(**body: Any) -> Workshop:
    return workshop_with(body=body)


def found(robot: Robot) -> dict[str, Finding]:
    return {finding.name: finding for finding in stop_findings(robot)}


@cache
def solid_kenan() -> Robot:
    """Return Kenan 2.0 of solid plastic, whose sections are those of a handbook."""
    return build(load_design("kenan-2.0"), workshop_with(process={"infill": 1.0}))


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_peak_is_that_of_a_pad_without_rebound(name: str) -> None:
    """T = 0.82·v·sqrt(k·r²·I); a spring without loss gives v·sqrt(I/(k·r²))."""
    robot = built(name)
    blow, stop = robot.stop_blow, robot.layout.stop
    pad, width = stop.pad, robot.layout.sections.thickness_mm
    shape = 8.0 * width / (2.0 * (8.0 + width) * pad.thickness_mm)
    rate = 1000.0 * pad.modulus_mpa * (1.0 + 1.28 * shape**2) * 8.0 * width / pad.thickness_mm  # N/m
    assert blow.force_n == pytest.approx(0.82 * math.sqrt(2.0 * blow.energy_j * rate), rel=1e-3)
    assert 0.5 * rate * (blow.give_mm / 1000.0) ** 2 == pytest.approx(blow.energy_j, rel=1e-3)
    assert blow.torque_nm == pytest.approx(blow.force_n * stop.radius_mm / 1000.0, rel=1e-3)
    assert robot.stop is not None
    assert robot.stop.stiffness_nm_per_rad == pytest.approx(rate * (stop.radius_mm / 1000.0) ** 2)
    assert robot.joint("leg").upper_rad == pytest.approx(robot.stop.angle_rad + blow.give_rad)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_pad_lies_in_the_seat_of_the_printed_bar(name: str) -> None:
    """Along the leg the bar reaches as far as its pad; the glue's gap is all that is between them, 0.6 mm deep."""
    robot = built(name)
    stop, bar = robot.layout.stop, placed(robot, "stop_bar")
    (pad,) = (item for item in robot.hardware if item.name == "stop_pad")
    corners = trimesh.bounds.corners(pad.shape.bounds_mm) @ pad.T_body_part[:3, :3].T + pad.T_body_part[:3, 3]
    middle = (pad.shape.solid().to_mesh().vert_properties[:, :3] @ pad.T_body_part[:3, :3].T).mean(axis=0)
    middle += pad.T_body_part[:3, 3]
    along, behind = np.array([stop.along[0], 0.0, stop.along[1]]), np.array([stop.behind[0], 0.0, stop.behind[1]])
    reach = bar.vertices @ along
    assert (reach.min() + reach.max()) / 2.0 == pytest.approx(middle @ along, abs=0.05)
    assert np.ptp(reach) == pytest.approx(8.0, abs=0.05)
    assert np.ptp(corners @ [0.0, 1.0, 0.0]) == pytest.approx(robot.layout.sections.thickness_mm)
    bottom = middle + (stop.pad.thickness_mm / 2.0 - 0.1) * behind
    to_bar, _, _ = trimesh.proximity.closest_point(bar, [bottom])
    assert (to_bar[0] - bottom) @ behind == pytest.approx(0.1, abs=0.05)


def test_ears_are_bent_like_a_cantilever() -> None:
    """The plate that is nearer to the leg carries more: as much as the other one is farther."""
    robot = built("best-bo")
    lateral = robot.layout.lateral
    left, right = (abs(sum(plate)) / 2.0 for plate in (lateral.left_plate, lateral.right_plate))
    share = max(left, right) / (left + right)
    assert 0.5 < share < 0.6
    moment = 2.0 * robot.stop_blow.force_n * share * robot.layout.stop.radius_mm
    assert found(robot)["stop_plates"].value == pytest.approx(6.0 * moment / (2.4 * 16.0**2))


def test_ears_with_a_hole_near_the_hub_are_weakest_beside_it() -> None:
    """Second moment of the 2 mm above and below the hole, t·(w³ - d³)/12; the arm ends at the hole's nearer end."""
    robot = built("best-bo")
    layout = robot.layout
    nearer = replace(robot, layout=replace(layout, leg_pin_mm=layout.leg_pin_mm - 6.0))
    hole = layout.pin_hole.diameter_mm
    width = hole + 2.0 * 2.0
    (outer, inner), pad = (width / 2.0, hole / 2.0), layout.stop.radius_mm
    second_moment = 2.4 * 2.0 * (outer**3 - inner**3) / 3.0
    left, right = (abs(sum(plate)) / 2.0 for plate in (layout.lateral.left_plate, layout.lateral.right_plate))
    force = 2.0 * robot.stop_blow.force_n * right / (left + right)  # on the left ear, which has the hole
    moment = force * (pad - (layout.leg_pin_mm - 6.0 - inner))
    assert found(nearer)["stop_plates"].value == pytest.approx(moment * outer / second_moment)


def test_the_leg_is_a_beam_on_hub_and_pad() -> None:
    """A load F at the pad, held at the hub and, by inertia, at the ankle: M = F·r·(1 - r/l) (any handbook)."""
    robot = solid_kenan()
    radius, length, sections = robot.layout.stop.radius_mm, robot.design.l2_mm, robot.layout.sections
    moment = 2.0 * robot.stop_blow.force_n * radius * (1.0 - radius / length)
    height = sections.leg_root_mm + radius / length * (sections.leg_tip_mm - sections.leg_root_mm)
    assert found(robot)["stop_leg"].value == pytest.approx(6.0 * moment / (6.0 * height**2), rel=1e-3)


def test_the_bar_of_solid_plastic_is_a_beam_on_two_supports() -> None:
    robot = solid_kenan()
    low, high = robot.layout.lateral.inside
    moment = 2.0 * robot.stop_blow.force_n * (high - low - 6.0 / 2.0) / 4.0
    assert found(robot)["stop_strength"].value == pytest.approx(6.0 * moment / (8.0 * (6.0 - 0.6) ** 2))


def test_the_preload_that_is_left_on_the_stop_bends_the_bar_for_good() -> None:
    """K·(p - 3°) at the pad's radius on a bar of solid plastic, whose middle bears it; none up to the stop's 3°."""
    solid = solid_kenan().workshop
    for preload_deg in (0.0, 3.0, 20.0):
        robot = build(load_design("kenan-2.0"), workshop_with(solid, spring={"preload_deg": preload_deg}))
        held = 9.2 * (preload_deg - 3.0) / robot.layout.stop.radius_mm
        low, high = robot.layout.lateral.inside
        span = high - low - robot.layout.sections.thickness_mm / 2.0
        bar = 6.0 * held * span / 4.0 / (8.0 * (6.0 - 0.6) ** 2)
        limits = found(robot)
        assert ("stop_creep" in limits) == (preload_deg > 3.0), preload_deg
    still = found(quicker(robot, 0.0))["stop_creep"]  # it never reaches its stop
    assert still.value == pytest.approx(limits["stop_creep"].value)
    largest = max(("stop_strength", "stop_plates", "stop_leg"), key=lambda name: limits[name].value or 0.0)
    assert limits["stop_creep"].value == pytest.approx(
        bar * (limits[largest].value or 0.0) / (limits["stop_strength"].value or 1.0), rel=1e-3
    )
    assert limits["stop_creep"].limit == 10.0


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_pad_may_be_pressed_by_half_and_the_leg_turn_3_degrees_and_the_cams_clearance(name: str) -> None:
    """The clearance between cam and roller, at the lever's end, is an angle of the leg."""
    robot = built(name)
    cam, findings = robot.layout.drive.cam, found(robot)
    assert findings["stop_pad"].limit == pytest.approx(robot.layout.stop.pad.thickness_mm / 2.0)
    room = 3.0 + math.degrees(cam.geometry.clearance_mm / cam.geometry.lever_mm)
    assert cam.geometry.clearance_mm > 0.4
    assert findings["stop_clearance"].limit == pytest.approx(room)
    assert findings["stop_clearance"].value == pytest.approx(math.degrees(robot.stop_blow.give_rad))


def quicker(robot: Robot, times: float) -> Robot:
    """Return a robot whose leg meets its stop quicker: force, torque and give grow alike."""
    blow = robot.stop_blow
    figures = {name: times * getattr(blow, name) for name in ("torque_nm", "force_n", "give_rad", "give_mm")}
    return replace(robot, stop_blow=replace(blow, energy_j=times**2 * blow.energy_j, **figures))


@pytest.mark.parametrize("name", ["stop_strength", "stop_plates", "stop_leg", "stop_pad", "stop_clearance"])
def test_a_leg_that_is_quick_enough_breaks_every_limit(name: str) -> None:
    """Stresses and give are proportional to the leg's speed."""
    robot = built("best-bo")
    usual = found(robot)[name]
    assert usual.severity == "info"
    assert usual.value is not None
    assert usual.limit is not None
    just, beyond = (found(quicker(robot, share * usual.limit / usual.value))[name] for share in (0.99, 1.01))
    assert (just.severity, beyond.severity) == ("info", "error")
    assert beyond.remedy


def test_a_harder_pad_hits_harder_and_gives_less() -> None:
    soft = built("best-bo")
    hard = build(load_design("best-bo"), workshop(stop_pad="sj5616"))
    assert hard.stop_blow.force_n > soft.stop_blow.force_n
    assert hard.stop_blow.give_mm < soft.stop_blow.give_mm
    assert hard.layout.stop.depth_mm > soft.layout.stop.depth_mm


def test_a_pad_that_is_too_thin_is_refused_with_what_misses() -> None:
    with pytest.raises(CannotBuildError, match=r"body.stop_pad = sj5632 is 0.8 mm thick; .* at least 1.5 mm: choose"):
        build(load_design("kenan-2.0"), workshop(stop_pad="sj5632"))
    with pytest.raises(JumpcadError, match=r"body.stop_pad.*a pad of at least 1.5 mm: name one of"):
        build(load_design("kenan-2.0"), workshop(stop_pad=""))


@pytest.mark.parametrize(("angle", "findings"), [(4.0, constraint_findings), (6.0, check)])
def test_the_stop_is_where_the_workshop_wants_it(angle: float, findings: Callable[[Robot], list[Finding]]) -> None:
    robot = build(load_design("kenan-2.0"), workshop(stop_deg=angle))
    assert robot.stop is not None
    assert math.degrees(robot.stop.angle_rad) == pytest.approx(angle)
    assert errors(findings(robot)) == []


def test_bare_feet_are_allowed_and_stand_on_plastic() -> None:
    shop = workshop_with(ground={"pad": ""})
    bare = build(load_design("kenan-2.0"), shop)
    assert bare.foot_depth_m == pytest.approx(bare.layout.sections.foot_depth_mm / 1000.0)
    assert not [item for item in bare.hardware if item.name.startswith(("nose_pad", "toe_"))]
    assert shop.ground.foot_friction == shop.ground.bare_friction


@pytest.mark.thorough
def test_without_ground_all_of_the_springs_energy_meets_the_stop() -> None:
    """MuJoCo's own: released in the air, without gravity, the robot has that energy when the leg comes to its stop."""
    mujoco = pytest.importorskip("mujoco")
    robot = built("best-bo")
    model = mujoco.MjModel.from_xml_string(write_robot(robot, visuals(robot), looks=False))
    data, leg = mujoco.MjData(model), model.joint("leg")
    mujoco.mj_resetDataKeyframe(model, data, model.key("wound").id)
    data.ctrl[:], model.opt.gravity[:], model.opt.timestep = 0.0, 0.0, 2e-5
    while data.qpos[leg.qposadr[0]] < leg.range[1]:
        mujoco.mj_step(model, data)
    mujoco.mj_energyVel(model, data)
    told = found(robot)["free_release"]
    assert told.value == pytest.approx(data.energy[1], rel=0.05)  # joints rub
    assert told.is_note
    assert told.margin < 0.0
    once = robot.stop_blow
    assert told.value + told.margin <= once.energy_j * (0.5 * robot.layout.stop.pad.thickness_mm / once.give_mm) ** 2


def test_tabs_stand_in_the_plates_slots(robot: Robot) -> None:
    """Pressed in: 0.1 mm on every side of the section."""
    for side, plate in (("left", robot.layout.lateral.left_plate), ("right", robot.layout.lateral.right_plate)):
        y = sum(plate) / 2.0
        tab, around = (region(cut(placed(robot, name), y)) for name in ("stop_bar", f"body_plate_{side}"))
        assert tab.intersection(around).area < 1e-3
        assert tab.buffer(robot.workshop.fits.press_mm + 0.01, join_style="mitre").intersection(around).length > 17.9


def test_the_pad_lies_in_its_seat_before_the_bar(robot: Robot) -> None:
    """Glued to the seat's floor, 0.02 mm before it, it stands out towards the leg by its thickness less 0.6 mm."""
    bar = part(robot, "stop_bar")
    item = next(one for one in robot.hardware if one.name == "stop_pad")
    pad = item.shown_mesh.copy().apply_transform(np.linalg.inv(bar.placements[0].T_body_part) @ item.T_body_part)
    thick = robot.layout.stop.pad.thickness_mm
    assert pad.bounds[:, 1] == pytest.approx([-0.6, thick - 0.6], abs=2e-3)
    assert pad.bounds[:, 2] == pytest.approx([0.0, 8.0], abs=2e-3)
    assert (pad.bounds[0, 0] + pad.bounds[1, 0]) / 2.0 == pytest.approx(0.0, abs=1e-3)
