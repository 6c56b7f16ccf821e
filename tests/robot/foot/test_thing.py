"""Tipping sideways: play of a pin in an eye, the roll to the edge of the stance, and toes that reach further."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
import shapely.affinity
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.checks.interference import Position, pieces_of, pose_of
from jumpcad.design import load_design
from jumpcad.mechanism.model import FOOT
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.foot.thing import play_rad, rolls, sideways_findings, stance_deg
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop

NARROW = load_design("best-bo").model_copy(update={"ground_link_angle_deg": 6.0})
"""Its toes end 10 mm from the middle, where nothing makes them wider."""


def workshop(**body: float) -> Workshop:
    return workshop_with(body=body)


def tilt_rad(pin_mm: float, bore_mm: float, length_mm: float) -> float:
    """Return how far a long pin can be turned in a bore, by trying."""
    bore = shapely.box(-length_mm / 2.0, -bore_mm / 2.0, length_mm / 2.0, bore_mm / 2.0)
    pin = shapely.box(-3.0 * length_mm, -pin_mm / 2.0, 3.0 * length_mm, pin_mm / 2.0)
    slab = shapely.box(-length_mm / 2.0, -50.0, length_mm / 2.0, 50.0)
    low, high = 0.0, 0.5
    for _ in range(40):
        middle = (low + high) / 2.0
        inside = shapely.affinity.rotate(pin, math.degrees(middle)).intersection(slab)
        low, high = (middle, high) if inside.difference(bore).area < 1e-9 else (low, middle)
    return low


def test_play_adds_up_along_the_leg(kenan: Robot) -> None:
    """Ankle's eye of 3.2 mm, 6 mm long; its pin in lugs 21 mm apart; the axle of 3 mm in bores of 3.4 mm."""
    lateral = kenan.layout.lateral
    bores_apart = lateral.outside[1] - lateral.outside[0] - 1.6  # two floors of 0.8 mm
    by_hand = tilt_rad(3.0, 3.2, 6.0) + tilt_rad(3.0, 3.2, 21.0) + tilt_rad(3.0, 3.4, bores_apart)
    holes = HoleSizes.of(kenan.workshop, kenan.layout.hub_bearing)
    assert play_rad(kenan.layout, holes) == pytest.approx(by_hand, rel=0.02)
    fine = replace(holes, fits=holes.fits.model_copy(update={"eye_mm": 0.05}))
    assert play_rad(kenan.layout, fine) < play_rad(kenan.layout, holes)


@pytest.mark.parametrize(
    ("fit", "bearing", "eye_mm", "lengths_mm"),
    [
        ("eye_mm", True, 0.1, [6.0]),  # the ankle's eye; both eyes of the front link have more play
        ("lying_mm", True, 0.1, [21.0]),  # the ankle's pin in the foot
        ("sliding_mm", True, 0.1, [36.2]),  # the axle in both plates
        ("sliding_mm", False, 0.3, [6.0, 36.2]),  # the hub without a bearing too
        ("eye_mm", False, 0.0, [6.0, 6.0]),  # with tight eyes the front link counts: its two eyes
        ("lying_mm", False, 0.0, [15.0]),  # its pin in the nose's lugs
        ("sliding_mm", False, 0.0, [36.2]),
    ],
)
def test_each_joint_tilts_by_its_clearance_over_its_length(
    kenan: Robot, fit: str, bearing: bool, eye_mm: float, lengths_mm: list[float]
) -> None:
    """A hole that is wider by c lets a pin tilt by c/l more; the bores of the plates are 37.8 - 2·0.8 mm apart."""
    layout = kenan.layout if bearing else replace(kenan.layout, hub_bearing=None)
    holes = HoleSizes.of(kenan.workshop, layout.hub_bearing)
    fits = holes.fits.model_copy(update={"eye_mm": eye_mm})
    wider = fits.model_copy(update={fit: getattr(fits, fit) + 0.01})
    before, after = (play_rad(layout, replace(holes, fits=one)) for one in (fits, wider))
    assert after - before == pytest.approx(sum(0.02 / length for length in lengths_mm), rel=1e-3)


@pytest.mark.parametrize(("state", "share"), [("at rest", 0.0), ("springs loaded", 1.0)])
def test_rolling_by_the_stance_brings_the_centre_of_mass_over_the_edge(
    strongest: Robot, state: str, share: float
) -> None:
    """The centre of mass comes from the pieces' own masses, the edge from the contacts and the nose's lug."""
    leg = -share * strongest.design.compression_rad
    pose = strongest.linkage.pose([leg])
    tilt, ankle = float(pose.foot_rad[0]), pose.ankle_mm[0]
    poses = {
        piece.body: pose_of(
            replace(piece, T_body_part=np.eye(4)), strongest.layout, strongest.linkage, Position("", leg, 0)
        )
        for piece in pieces_of(strongest)
        if piece.name not in ("cam", "cam_gear", "idler", "motor_pinion", "motor_shaft")
    }
    moment = sum(
        body.mass_kg * (poses[name] @ np.append(1000.0 * body.com_m, 1.0))[:3]
        for name, body in strongest.bodies.items()
    )
    com = moment / strongest.mass_kg
    x, z = com[[0, 2]] - ankle
    height = x * math.sin(tilt) + z * math.cos(tilt) + 1000.0 * strongest.foot_depth_m
    com = np.array([x * math.cos(tilt) - z * math.sin(tilt), com[1], height])
    contacts = {contact.name: 1000.0 * contact.centre_m for contact in strongest.bodies[FOOT].contacts}
    side = 1.0 if com[1] > 0.0 else -1.0
    toe = contacts["left_toe"] if side > 0 else contacts["right_toe"]
    nose = np.array([strongest.design.l4_mm, side * strongest.layout.lateral.lug_left[1], 0.0])
    edge = nose - [toe[0], toe[1], 0.0]
    edge /= np.linalg.norm(edge)
    found = next(roll for roll in rolls(strongest) if roll.state == state)
    turn = -side * math.radians(found.stance_deg) if edge[0] > 0 else side * math.radians(found.stance_deg)
    arm = com - nose
    turned = arm * math.cos(turn) + np.cross(edge, arm) * math.sin(turn) + edge * (edge @ arm) * (1.0 - math.cos(turn))
    outwards = np.cross(edge, [0.0, 0.0, 1.0])
    assert turned @ outwards == pytest.approx(0.0, abs=0.05)


def test_an_eye_that_is_drawn_wider_than_the_drill_shrinks_and_has_its_play(kenan: Robot) -> None:
    """Alone, as the coupon says it, and with a finer one there is less."""
    plays = [
        rolls(replace(kenan, workshop=workshop_with(fits={"eye_mm": eye})))[0].play_deg for eye in (0.05, 0.1, 0.2)
    ]
    assert plays[0] < plays[1] == plays[2]


def test_a_centre_of_mass_to_the_right_tips_as_one_to_the_left(kenan: Robot) -> None:
    """The foot is its own mirror image; whatever is heavier on one side, the nearer edge counts."""
    com = np.array([[10.0, 40.0], [20.0, 60.0]])
    left, middle, right = (stance_deg(kenan.layout, com, aside) for aside in (4.0, 0.0, -4.0))
    assert right == pytest.approx(left)
    assert (left < middle - 2.0).all()


def test_narrow_toes_tip_and_bars_across_them_help() -> None:
    narrow = build(NARROW, workshop(toe_half_width_mm=0.0))
    (finding,) = sideways_findings(narrow)
    assert (finding.name, finding.severity) == ("sideways_tipping", "error")
    advised = float(finding.remedy.partition("raise body.toe_half_width_mm to ")[2].partition(",")[0])
    (held,) = sideways_findings(build(NARROW, workshop(toe_half_width_mm=advised)))
    assert held.severity == "info", "the width that is advised holds"
    assert advised < 45.0
    spared = replace(narrow.layout, toe_half_width_mm=advised - 1.0)  # wider bars are heavier
    assert min(roll.margin_deg for roll in rolls(narrow, spared)) >= finding.limit
    wide = build(NARROW, workshop(toe_half_width_mm=30.0))
    (finding,) = sideways_findings(wide)
    assert finding.severity == "info"
    tips = [c.centre_m[1] for c in wide.bodies[FOOT].contacts if c.name.endswith("toe")]
    assert sorted(tips) == pytest.approx([-0.030, 0.030])
    foot = next(part for part in wide.parts if part.name == "foot")
    assert np.abs(foot.mesh.bounds[:, 1]) == pytest.approx([32.5, 32.5], abs=0.1)  # a tip is 5 mm wide


def test_landing_is_in_the_worst_pose_from_one_end_of_the_play_to_the_other(strongest: Robot) -> None:
    """Twice the play of one that stands still, in a pose in which it tips no later than at either end."""
    rest, loaded, landing = rolls(strongest)
    assert [roll.state for roll in (rest, loaded, landing)] == ["at rest", "springs loaded", "landing"]
    assert rest.play_deg == loaded.play_deg > 0.0
    assert landing.play_deg == pytest.approx(2.0 * rest.play_deg)
    assert landing.stance_deg <= min(rest.stance_deg, loaded.stance_deg)
    assert landing.margin_deg == pytest.approx(landing.stance_deg - landing.play_deg)


@pytest.mark.parametrize("reserve_deg", [0.5, 2.0, 60.0])
def test_the_workshops_reserve_is_what_must_be_left(kenan: Robot, reserve_deg: float) -> None:
    """More than the robot has is too much, whatever the default asks for."""
    (found,) = sideways_findings(
        replace(kenan, workshop=workshop_with(kenan.workshop, safety={"roll_reserve_deg": reserve_deg}))
    )
    left = min(roll.margin_deg for roll in rolls(kenan))
    assert (found.limit, found.margin) == (reserve_deg, pytest.approx(left - reserve_deg))
    assert (found.severity == "info") == (left >= reserve_deg)
