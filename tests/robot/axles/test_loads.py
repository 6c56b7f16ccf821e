"""Which forces load the axles between the plates: of springs, cam, front link and gears."""

import numpy as np
import pytest
from support.built import built, geared
from support.strengths import strength_findings

from jumpcad.robot.axles.loads import axle_beams
from jumpcad.robot.load_case import LoadCase
from jumpcad.transforms import Array


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_plates_carry_what_the_mechanism_pushes(name: str) -> None:
    """Leg, springs' pin and cam: action and reaction, so that of the springs' and cam's forces nothing is left over."""
    case = LoadCase(built(name))
    (_, on_pin), on_lever = case.wound_forces_n
    pushed = {axle: beam.on_plates_n().sum(axis=0) for axle, beam in case.beams.items()}
    assert pushed["leg_axle"] == pytest.approx(on_lever - on_pin)
    assert pushed["spring_pin"] == pytest.approx(on_pin)
    assert np.hypot(*pushed["front_axle"]) == pytest.approx(max(case.front_n, case.landing_n))
    # springs and leg stand in the middle, the roller beside it: what tilts the leg's axle is the cam's push alone
    beam = case.beams["leg_axle"]
    assert beam.places_mm @ beam.forces_n == pytest.approx(sum(case.layout.lateral.cam) / 2.0 * on_lever)


def test_arms_in_line_bend_the_axle_between_hub_and_coils() -> None:
    """Each coil passes on its arms' forces where they leave it, half a wire within its ends; no cam pushes.

    In the middle M is the reaction's moment less those of outer end, inner end and bearing, of F/2 each.
    """
    layout, force, none = built("best-bo").layout, np.array([0.0, 80.0]), np.zeros(2)
    beam = axle_beams(layout, (force, -force), none, none)["leg_axle"]
    left, right = (abs(float(np.mean(plate))) for plate in (layout.lateral.left_plate, layout.lateral.right_plate))
    wire, (inner, outer) = layout.drive.spring.wire_mm, layout.lateral.spring_left
    bearing = (8.0 - 3.0) / 2.0  # 683: 3 mm wide, in a hub of 8 mm
    arms = (outer - wire / 2.0) - (inner + wire / 2.0) + bearing
    by_hand = 80.0 * left / (left + right) * right - 40.0 * arms
    assert beam.moments_nmm(np.zeros(1)) == pytest.approx([by_hand])


@pytest.mark.parametrize("pairs", [1, 2])
def test_teeth_and_cam_hold_the_shaft_in_balance(pairs: int) -> None:
    """The cam gear is turned with the cam's torque over its efficiency; the idler's two gears hold each other."""
    robot = built("best-bo") if pairs == 1 else geared()
    case, layout, kept = LoadCase(robot), robot.layout, robot.workshop.safety.gear_efficiency
    train, beam = layout.drive.train, case.beams["cam_axle"]
    ratio = np.prod([pair.ratio for pair in train.stages])
    torque = 1000.0 * train.motor_torque_nm * ratio * kept**pairs
    radius = train.stages[-1].wheel.pitch_radius_mm
    least = torque / train.stages[-1].wheel.tip_radius_mm
    on_gear = beam.forces_n[1]
    assert least < np.linalg.norm(on_gear) < 1.2 * torque / radius  # 1/cos 20° and the shifts
    assert beam.forces_n[0] == pytest.approx(-case.wound_forces_n[1])
    assert list(beam.places_mm) == pytest.approx([np.mean(layout.lateral.cam), np.mean(layout.lateral.gears[0])])
    assert ("idler_axle" in case.beams) == (pairs == 2)
    if layout.idler_mm is None:
        return
    idler = case.beams["idler_axle"]
    assert idler.forces_n[0] == pytest.approx(-on_gear)
    assert list(idler.places_mm) == pytest.approx([np.mean(one) for one in layout.lateral.gears])
    pitch = train.stages[-1].pinion.teeth / (train.stages[-1].pinion.teeth + train.stages[-1].wheel.teeth)
    inner = layout.idler_mm + pitch * (layout.cam_axis_mm - layout.idler_mm)
    pitch = train.stages[0].wheel.teeth / (train.stages[0].pinion.teeth + train.stages[0].wheel.teeth)
    outer = layout.idler_mm + pitch * (layout.motor_mm - layout.idler_mm)
    held = _about_y(inner - layout.idler_mm, idler.forces_n[0])
    driven = _about_y(outer - layout.idler_mm, idler.forces_n[1])
    assert driven * kept == pytest.approx(-held)  # what friction takes comes from the motor
    names = {finding.name for finding in strength_findings(robot)}
    assert {"front_axle_strength", "idler_axle_strength"} <= names


def _about_y(arm: Array, force: Array) -> float:
    """Moment about +y of a force at an arm, both x-z."""
    return float(arm[1] * force[0] - arm[0] * force[1])


def test_the_front_link_bears_on_its_axle_at_thirds_of_its_half_width() -> None:
    """Pressures that grow evenly from the middle: M = F/2·(S - w/3) between plates at ± S, of 80 N."""
    layout, none = built("best-bo").layout, np.zeros(2)
    beam = axle_beams(layout, (none, none), none, np.array([0.0, 80.0]))["front_axle"]
    left, right = (abs(float(np.mean(plate))) for plate in (layout.lateral.left_plate, layout.lateral.right_plate))
    by_hand = 80.0 * left * right / (left + right) - 40.0 * layout.sections.thickness_mm / 3.0
    assert beam.moments_nmm(np.zeros(1)) == pytest.approx([by_hand])
