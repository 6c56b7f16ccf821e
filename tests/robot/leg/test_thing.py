"""Every strength check fails where it must, and passes where nothing breaks."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from support.each import each
from support.fits import LOADS, with_fits_apart
from support.strengths import changed, helped, margins, strength_findings, with_own

from jumpcad.building import build
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot
from jumpcad.robot.stop.thing import stop_findings
from jumpcad.robot.train.thing import blocked_findings
from jumpcad.workshop.workshop import Role

OF_ROLES = {
    "links": {
        "leg_strength", "hub_strength", "lever_strength", "leg_flex", "front_link_strength", "front_link_buckling",
        "eye_strength", "toe_strength", "toe_landing", "rail_strength", "rail_twist", "foot_lug_strength",
        "leg_sideways", "stop_strength", "stop_leg", "free_release",
    },
    "body": {"plate_seat", "axle_retention", "stop_plates"},
    "gears": {"cam_dog_strength", "cam_dog_blocked", "gear_blocked"},
}  # fmt: skip
"""What breaks in which kind of part: the foot and the rest stop's bar are links, cam and dog gears."""


@pytest.mark.parametrize("role", OF_ROLES)
def test_each_part_is_as_strong_as_what_it_is_printed_in(kenan: Robot, role: Role) -> None:
    """In the default workshop links and gears have one material; with half of it for one, only that one is weaker."""

    def found(robot: Robot) -> dict[str, float]:
        checks = strength_findings(robot), stop_findings(robot), blocked_findings(robot)
        return {finding.name: finding.margin for finding in itertools.chain(*checks)}

    usual, weak = found(kenan), found(replace(kenan, workshop=with_own(kenan.workshop, role, 0.5)))
    assert {name for name in usual if weak[name] < usual[name]} == OF_ROLES[role]
    assert {name for name in usual if weak[name] > usual[name]} == set()


WEAK_LINKS = (
    "leg_strength", "hub_strength", "lever_strength", "front_link_strength", "eye_strength", "toe_strength",
    "toe_landing", "rail_strength", "leg_sideways",
)  # fmt: skip


@each(
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


@pytest.mark.parametrize("root_mm", [1.0, 30.0])
def test_beside_its_bore_the_leg_is_as_high_as_its_hub_or_its_root(kenan: Robot, root_mm: float) -> None:
    """6·M·H/(b·(H³ - d³)), H the hub's diameter or the root's height, whichever is larger."""
    layout = replace(kenan.layout, sections=replace(kenan.layout.sections, leg_root_mm=root_mm))
    robot = replace(kenan, layout=layout)
    case = LoadCase(robot)
    height, bore = max(root_mm, 2.0 * case.holes.hub_radius_mm), case.holes.hub_bore_mm
    stress = 6.0 * case.torque_nmm * height / (layout.sections.thickness_mm * (height**3 - bore**3))
    (found,) = (one for one in strength_findings(robot) if one.name == "hub_strength")
    assert found.value == pytest.approx(stress)


@pytest.mark.parametrize("robot", ["kenan", "strongest"])
def test_the_plates_bear_what_axles_and_the_springs_pin_push(robot: str, request: pytest.FixtureRequest) -> None:
    """The larger reaction of two supports over the projected area of one seat, of the axle or pin that presses most.

    Of Kenan the leg's axle, between cam and springs, in a longer seat; of the strongest the springs' pin, whose forces
    are nearer to the right plate, since cam and gears stand to the left of the leg.
    """
    strong = request.getfixturevalue(robot)
    (seat,) = (finding for finding in strength_findings(strong) if finding.name == "plate_seat")
    case, lateral = LoadCase(strong), strong.layout.lateral
    (_, on_pin), on_lever = case.wound_forces_n
    left, right, roller = (float(np.mean(y)) for y in (lateral.left_plate, lateral.right_plate, lateral.cam))
    left_of_roller, left_of_leg = (roller - right) / (left - right), -right / (left - right)  # shares of the left plate
    plate = lateral.left_plate[1] - lateral.left_plate[0] - 0.8  # closed by four layers
    pressed = {"cam": case.beams["cam_axle"].plate_load_n / plate}
    legs, pins = [], []
    for cams, springs in ((left_of_roller, left_of_leg), (1.0 - left_of_roller, 1.0 - left_of_leg)):
        legs.append(np.hypot(*(cams * on_lever - springs * on_pin)) / (plate + 1.2))  # its seat is longer inside
        pins.append(springs * np.hypot(*on_pin) / plate)
    pressed |= {"leg": max(legs), "pin": max(pins)}
    assert max(pressed, key=pressed.__getitem__) == {"kenan": "leg", "strongest": "pin"}[robot]
    assert seat.value == pytest.approx(max(pressed.values()) / strong.layout.axle_mm)


def test_what_is_advised_to_lower_or_to_raise_helps(strongest: Robot) -> None:
    links = {"leg_strength", "lever_strength", "leg_flex", "front_link_strength", "eye_strength", "foot_lug_strength"}
    assert links <= helped(strongest, strength_findings)


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


@pytest.mark.parametrize("axle_mm", [2.0, 3.0])
@pytest.mark.parametrize("robot", ["kenan", "strongest"])
def test_the_dog_bears_the_cams_torque_and_its_blow(robot: str, axle_mm: float, request: pytest.FixtureRequest) -> None:
    """Two jaws as cantilevers along the axle, as long as the cam gear is wide, and the boss in torsion, as a tube."""
    strong = request.getfixturevalue(robot)
    strong = replace(strong, layout=replace(strong.layout, axle_mm=axle_mm))
    (dog,) = (finding for finding in strength_findings(strong) if finding.name == "cam_dog_strength")
    drive, case = strong.layout.drive, LoadCase(strong)
    torque = 1000.0 * max(drive.cam.law.peak_torque_nm, strong.release.blow_nm)
    fits, outer = case.workshop.fits, drive.dog.outer_mm
    inner = axle_mm + 4.0 * fits.sliding_mm + 2.0 * fits.wall_min_mm
    root, radius = (outer - inner) / 2.0, (outer + inner) / 4.0
    force, along = torque / 2.0 / radius, radius * drive.dog.jaw_rad
    width = drive.train.stages[-1].wheel.face_width_mm
    jaws = math.hypot(6.0 * force * width / 2.0 / (root * along**2), math.sqrt(3.0) * 1.5 * force / (root * along))
    bore = axle_mm + 2.0 * fits.sliding_mm
    boss = math.sqrt(3.0) * 16.0 * torque * outer / (math.pi * (outer**4 - bore**4))
    assert dog.value == pytest.approx(max(jaws, boss))
    gears = case.workshop.material("gears")
    assert dog.limit == pytest.approx(gears.strength_interlayer_mpa / case.workshop.safety.printed_factor)


@pytest.mark.parametrize("robot", ["kenan", "strongest"])
def test_what_is_pulled_along_and_at_its_eyes_by_hand(robot: str, request: pytest.FixtureRequest) -> None:
    """F/A of lever and front link, a shell around a thin core; bearing and tear-out of eyes and lugs, √3·F/((D - d)·t).

    The lever's moment falls to 0 at the roller, where it is as high as its eye; the cam pushes along it with N·sin α.
    """
    usual: Robot = request.getfixturevalue(robot)
    case = LoadCase(replace(usual, workshop=with_fits_apart(usual.workshop)))
    found = {one.name: one for one in strength_findings(case.robot)}
    sections, shell, thick = case.layout.sections, case.shell, case.layout.sections.thickness_mm

    def core(height: np.ndarray, power: int) -> np.ndarray:
        """b·hⁿ less what the infill lacks."""
        hollow = (thick - 2.0 * shell.layers_mm) * np.maximum(height - 2.0 * shell.walls_mm, 0.0) ** power
        return thick * height**power - (1.0 - shell.core_share) * hollow

    cam, share = case.layout.drive.cam, np.linspace(0.0, 1.0, 2001)
    height = sections.lever_root_mm + share * (8.0 - sections.lever_root_mm)
    along = cam.peak_contact_n * math.sin(cam.max_pressure_angle_rad)
    lever = 6.0 * case.torque_nmm * (1.0 - share) * height / core(height, 3) + along / core(height, 1)
    assert found["lever_strength"].value == pytest.approx(lever.max(), rel=2e-3)
    front = case.front_n / core(np.array([sections.front_mm]), 1)[0]
    assert found["front_link_strength"].value == pytest.approx(front)

    def eye(force: float, thickness: float, outside: float, bore: float) -> float:
        return max(force / (bore * thickness), math.sqrt(3.0) * force / ((outside - bore) * thickness))

    force, fits, axle = max(case.ankle_n, case.front_n), case.workshop.fits, case.layout.axle_mm
    largest, bore = max(force, case.landing_n), axle + 2.0 * fits.eye_mm
    assert found["eye_strength"].value == pytest.approx(eye(largest, thick, 2.0 * sections.eye_radius_mm, bore))
    lug = eye(force / 2.0, sections.lug_thickness_mm, 2.0 * sections.foot_depth_mm, axle + 2.0 * fits.lying_mm)
    assert found["foot_lug_strength"].value == pytest.approx(lug)


def test_legs_with_a_bar_are_checked_as_bars(kenan: Robot) -> None:
    """Their printed beam ends in a socket: flex and buckling are those of the bar, each told once."""
    bar = kenan.workshop.catalogue.bars["carbon-tube-4x2"]
    names = [found.name for found in strength_findings(replace(kenan, layout=replace(kenan.layout, leg_bar=bar)))]
    printed = {found.name for found in strength_findings(kenan)}
    assert len(set(names)) == len(names)
    assert printed - set(names) == {"leg_flex", "front_link_buckling"}
    assert {"leg_bar_flex", "front_bar_buckling", "leg_bar_strength", "leg_bar_bond"} <= set(names) - printed


GROWING = {
    "leg": ("leg_root_mm", "leg_tip_mm"), "lever": ("lever_root_mm",), "front": ("front_mm",),
    "thickness": ("thickness_mm",), "lug": ("lug_thickness_mm",), "toe": ("toe_root_mm", "toe_tip_height_mm"),
    "rail": ("rail_root_mm", "rail_tip_mm"),
}  # fmt: skip
"""The sizes that a factor of growth makes larger."""


def test_what_grows_for_a_finding_is_what_helps_it(strongest: Robot) -> None:
    """A tenth more of the section that a finding names takes at least a twentieth of its use."""
    usual = {found.name: found for found in strength_findings(strongest)}
    helped = set()
    for what, sizes in GROWING.items():
        sections = strongest.layout.sections
        larger = replace(sections, **{size: 1.1 * getattr(sections, size) for size in sizes})
        grown = replace(strongest, layout=replace(strongest.layout, sections=larger))
        for found in strength_findings(grown):
            if found.grows == what:
                assert found.use < 0.95 * usual[found.name].use, found.name
                helped.add(found.name)
    assert helped == {name for name, found in usual.items() if found.grows in GROWING}
    assert {"leg_flex", "leg_strength", "lever_strength", "eye_strength", "toe_landing", "leg_sideways"} <= helped
