"""Every strength check fails where it must, and passes where nothing breaks."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.fits import LOADS
from support.strengths import changed, margins

from jumpcad.building import build
from jumpcad.checks.load_case import LoadCase
from jumpcad.checks.strength import strength_findings
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.mechanism.linkage import Linkage
from jumpcad.robot import Robot


def test_silent_on_what_was_sized_for_it(kenan: Robot, strongest: Robot) -> None:
    assert not errors(strength_findings(kenan))
    assert not errors(strength_findings(strongest))
    assert all(finding.severity == "info" for finding in strength_findings(kenan))


WEAK_LINKS = (
    "leg_strength", "hub_strength", "lever_strength", "front_link_strength", "eye_strength", "toe_strength",
    "toe_landing", "rail_strength", "leg_sideways",
)  # fmt: skip


@pytest.mark.parametrize(
    ("role", "figures", "names"),
    [
        ("links", {"strength_in_plane_mpa": 0.3}, WEAK_LINKS),
        ("links", {"strength_interlayer_mpa": 0.3}, ("foot_lug_strength",)),
        ("links", {"modulus_mpa": 100.0}, ("leg_flex", "front_link_buckling")),
        ("body", {"strength_in_plane_mpa": 5.0}, ("plate_seat",)),
        ("gears", {"strength_interlayer_mpa": 0.5}, ("cam_dog_strength",)),
        ("safety", {"steel_yield_mpa": 5.0},
         ("leg_axle_strength", "cam_axle_strength", "spring_pin_strength", "foot_pin_strength")),
        ("safety", {"steel_factor": 20.0}, ("roller_screw_strength",)),
        ("safety", {"landing_stop_mm": 0.3}, ("front_link_buckling", "toe_landing")),
    ],
)  # fmt: skip
def test_each_fires_in_a_workshop_that_cannot_bear_it(
    kenan: Robot, role: str, figures: dict[str, float], names: tuple[str, ...]
) -> None:
    broken = {finding.name for finding in errors(strength_findings(changed(kenan, role, **figures)))}
    assert set(names) <= broken
    if "strength_interlayer_mpa" not in figures or role == "gears":
        assert len(broken) < len(margins(kenan))


def test_the_hub_gets_the_lightest_bearings_that_bear_it(kenan: Robot, strongest: Robot) -> None:
    names = [robot.layout.hub_bearing.name for robot in (kenan, strongest) if robot.layout and robot.layout.hub_bearing]
    assert names == ["MR63", "683"]
    for robot in (kenan, strongest):
        assert sum(item.name.startswith("hub_bearing") for item in robot.hardware) == 2
        assert margins(robot)["hub_bearing_load"] > 0.0


def test_a_careful_workshop_gets_stronger_bearings_and_a_hub_as_wide(kenan: Robot) -> None:
    careful = changed(kenan, "safety", bearing_factor=2.0)
    robot = build(careful.design, careful.workshop)
    assert robot.layout is not None
    assert robot.layout.hub_bearing is not None
    assert robot.layout.hub_bearing.name == "623"
    assert robot.layout.sections.thickness_mm == pytest.approx(2 * 4.0 + 0.8)
    assert margins(robot)["hub_bearing_load"] > 0.0
    bare = changed(kenan, "bought", leg_bearing="")
    assert "hub_bearing_load" not in margins(build(bare.design, bare.workshop))


def test_bearings_that_do_not_go_on_the_axle_are_refused(kenan: Robot) -> None:
    thick = changed(kenan, "bought", axle_mm=4.0)
    with pytest.raises(JumpcadError, match=r"no such bearing has the bore of bought.axle_mm = 4: change one"):
        build(thick.design, thick.workshop)


def test_sideways_stress_by_hand(kenan: Robot) -> None:
    """A solid leg that stands upright is a plain cantilever on its thin side, 6·M/(h·b²); worst where it is lowest."""
    assert kenan.layout is not None
    upright = kenan.design.model_copy(update={"rest_angle_deg": 90.0})
    solid = changed(replace(kenan, design=upright), "process", infill=1.0)
    case = LoadCase(solid)
    aside = upright.l5_mm * math.sin(math.radians(upright.ground_link_angle_deg))
    by_hand = 6.0 * case.toe_blow_n * aside / (kenan.layout.sections.leg_tip_mm * 6.0**2)
    assert 15.0 / LOADS - margins(solid)["leg_sideways"] == pytest.approx(by_hand)


def test_leg_stress_by_hand(kenan: Robot) -> None:
    # at the hub: M·c/I of 8 x 6 mm with 1.35 mm walls, 0.9 mm layers and a fifth of the core, plus force over area
    assert kenan.layout is not None
    assert (kenan.layout.sections.leg_root_mm, kenan.layout.sections.thickness_mm) == (8.0, 6.0)
    core_width, core_height = 6.0 - 1.8, 8.0 - 2.7
    second = (6.0 * 8.0**3 - 0.8 * core_width * core_height**3) / 12.0
    bending = 1000.0 * kenan.design.peak_spring_torque_nm * 4.0 / second
    stress = 15.0 / LOADS - margins(kenan)["leg_strength"]
    assert bending < stress < bending + 0.3


def test_twice_the_spring_torque_bends_twice_as_much(kenan: Robot) -> None:
    doubled = kenan.design.model_copy(update={"stiffness_nmm_per_deg": 2.0 * kenan.design.stiffness_nmm_per_deg})
    assert kenan.layout is not None
    springs = replace(kenan.spring, stiffness_nm_per_rad=2.0 * kenan.spring.stiffness_nm_per_rad)
    robot = replace(kenan, design=doubled, spring=springs, layout=replace(kenan.layout, linkage=Linkage(doubled)))
    before, after = (15.0 / LOADS - margins(which)["hub_strength"] for which in (kenan, robot))
    assert after == pytest.approx(2.0 * before)
    assert math.isfinite(after)


@pytest.mark.parametrize("robot", ["kenan", "strongest"])
def test_the_plates_bear_what_axles_and_the_springs_pin_push(robot: str, request: pytest.FixtureRequest) -> None:
    """The force over the projected area of two seats, of the axle or pin that presses most.

    Of Kenan the leg's axle, between cam and springs, in a longer seat; of the strongest the springs' pin.
    """
    strong = request.getfixturevalue(robot)
    (seat,) = (finding for finding in strength_findings(strong) if finding.name == "plate_seat")
    (_, on_pin), on_lever = LoadCase(strong).wound_forces_n
    plate = strong.layout.lateral.left_plate[1] - strong.layout.lateral.left_plate[0]
    seats = {"cam": plate - 0.8, "pin": plate - 0.8, "leg": plate - 0.8 + 1.2}
    forces = {"cam": on_lever, "pin": on_pin, "leg": on_lever - on_pin}
    pressed = {name: float(np.hypot(*force)) / seats[name] for name, force in forces.items()}
    assert max(pressed, key=pressed.__getitem__) == {"kenan": "leg", "strongest": "pin"}[robot]
    assert seat.value == pytest.approx(max(pressed.values()) / (2.0 * strong.layout.axle_mm))


def test_the_plates_bear_the_push_of_the_cam_between_them(strongest: Robot) -> None:
    """Bearing stress is force over the projected area, diameter times thickness (Shigley, 8-12), of two seats."""
    layout = strongest.layout
    (seat,) = (finding for finding in strength_findings(strongest) if finding.name == "plate_seat")
    plate = layout.lateral.left_plate[1] - layout.lateral.left_plate[0]
    seats = plate - 0.8, plate - 0.8 + 1.2  # closed by four layers; the leg axle's is longer inside
    borne = [seat.value * 2.0 * layout.axle_mm * depth for depth in seats]
    arm = 1000.0 * strongest.design.peak_spring_torque_nm / layout.drive.spring.arms.lever_mm
    push = layout.drive.cam.peak_contact_n
    assert max(push, arm) <= borne[1] + 1e-9
    assert borne[0] <= push + arm + 1e-9


def test_pins_for_a_few_jumps_may_bear_their_yield_and_no_more(kenan: Robot) -> None:
    """Up to 1e3 cycles the limit is the yield point (Shigley, 6-8)."""
    few = changed(kenan, "safety", jumps=1000.0, steel_yield_mpa=900.0)
    (axle,) = (finding for finding in strength_findings(few) if finding.name == "axle_fatigue")
    # and the reserves
    assert axle.limit == pytest.approx(
        400.0 / LOADS if "foot" in axle.message or "leg pin" in axle.message else 900.0 / LOADS
    )


def test_a_body_struck_beside_its_middle_turns_about_both_axes(kenan: Robot) -> None:
    """Speed at the struck point per impulse: 1/m + x²/I_y + y²/I_x (a free rigid body); 1/m if struck in the middle."""
    case = LoadCase(kenan)
    body, design = kenan.bodies["body"], kenan.design
    angle = math.radians(design.ground_link_angle_deg)
    x, y = (design.l5_mm / 1000.0 * part for part in (math.cos(angle), math.sin(angle)))
    per_impulse = 1.0 / body.mass_kg + x**2 / body.inertia_kg_m2[1, 1] + y**2 / body.inertia_kg_m2[0, 0]
    assert case.toe_blow_n / case.landing_n == pytest.approx(1.0 / body.mass_kg / per_impulse)


def test_the_springs_pin_is_a_beam_with_two_loads(kenan: Robot) -> None:
    """Two equal forces at a distance a from either support bend a beam by F·a between them (Shigley, table A-9).

    A force square to a tangent of the coil turns the hub with the tangent's length for a lever.
    """
    layout, lateral = kenan.layout, kenan.layout.lateral
    spring = layout.drive.spring
    beside = (spring.inside_diameter_mm + 2.0 * spring.wire_mm + layout.axle_mm) / 2.0
    lever = math.sqrt(((layout.spring_pin_mm - layout.hub_mm) ** 2).sum() - beside**2)
    force = 1000.0 * kenan.design.peak_spring_torque_nm / 2.0 / lever
    support = sum(lateral.left_plate) / 2.0 - sum(lateral.right_plate) / 2.0
    stress = 32.0 * force * (support / 2.0 - lateral.spring_left[1]) / (math.pi * layout.axle_mm**3)
    assert LoadCase(kenan).steel_stresses_mpa["spring_pin"] == pytest.approx(stress, rel=1e-6)


@pytest.mark.parametrize("robot", ["kenan", "strongest"])
def test_a_margin_is_what_is_left_to_the_limit(robot: str, request: pytest.FixtureRequest) -> None:
    """In the finding's own unit: of a stress, a force or a share of energy."""
    findings = [one for one in strength_findings(request.getfixturevalue(robot)) if one.value is not None]
    assert {"leg_strength", "leg_flex"} <= {one.name for one in findings}
    for one in findings:
        assert abs(one.margin) == pytest.approx(abs(one.limit - one.value), rel=1e-9, abs=1e-9), one.name


def test_the_leg_takes_its_share_of_the_springs_energy(kenan: Robot) -> None:
    """A cantilever of the leg's heights, M²/(2·E·I) along it, in per cent of the springs' energy."""
    case, sections = LoadCase(kenan), kenan.layout.sections
    (flex,) = (one for one in strength_findings(kenan) if one.name == "leg_flex")
    x = np.linspace(0.0, kenan.design.l2_mm, 20001)
    height = sections.leg_root_mm + x / x[-1] * (sections.leg_tip_mm - sections.leg_root_mm)
    shell, width = case.shell, sections.thickness_mm
    hollow = (width - 2.0 * shell.layers_mm) * (height - 2.0 * shell.walls_mm) ** 3
    second = (width * height**3 - (1.0 - shell.core_share) * hollow) / 12.0
    moment = case.torque_nmm * (1.0 - x / x[-1])
    bent = np.trapezoid(moment**2 / (2.0 * case.workshop.material("links").modulus_mpa * second), x)
    assert flex.value == pytest.approx(100.0 * bent / (1000.0 * kenan.spring.energy_j), rel=2e-3)
    assert flex.limit == pytest.approx(100.0 * kenan.workshop.safety.leg_flex_share)


@pytest.mark.parametrize("robot", ["kenan", "strongest"])
def test_the_dog_bears_the_cams_torque_and_its_blow(robot: str, request: pytest.FixtureRequest) -> None:
    """Two jaws as cantilevers along the axle, as long as the cam gear is wide, and the boss in torsion, as a tube."""
    strong = request.getfixturevalue(robot)
    (dog,) = (finding for finding in strength_findings(strong) if finding.name == "cam_dog_strength")
    drive, case = strong.layout.drive, LoadCase(strong)
    torque = 1000.0 * max(drive.cam.peak_torque_nm, strong.release.blow_nm)
    fits, outer = case.workshop.fits, drive.dog.outer_mm
    inner = 3.0 + 4.0 * fits.sliding_mm + 2.0 * fits.wall_min_mm
    root, radius = (outer - inner) / 2.0, (outer + inner) / 4.0
    force, along = torque / 2.0 / radius, radius * drive.dog.jaw_rad
    width = drive.train.stages[-1].wheel.face_width_mm
    jaws = math.hypot(6.0 * force * width / 2.0 / (root * along**2), math.sqrt(3.0) * 1.5 * force / (root * along))
    bore = 3.0 + 2.0 * fits.sliding_mm
    boss = math.sqrt(3.0) * 16.0 * torque * outer / (math.pi * (outer**4 - bore**4))
    assert dog.value == pytest.approx(max(jaws, boss))
