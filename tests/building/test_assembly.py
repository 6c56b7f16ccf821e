"""Whole robots: the loop closed by the joints' frames, refusals, the same bytes."""

import hashlib
import math
import re
import subprocess
import sys
from collections import Counter

import numpy as np
import pytest
from support.built import LONG_TOES, body_in_plane, built, design, geared
from support.elsewhere import environment
from support.places import ROOT
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.building.assembly import layout_of
from jumpcad.design import Design, load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.solids.stl import write_stl
from jumpcad.workshop import Workshop, load_workshop


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo", LONG_TOES])
def test_frames_of_the_joints_close_the_loop(name: str) -> None:
    """Down the tree of joints, the front link's eye and the foot's meet at every winding angle."""
    robot = built(name)
    for wind in np.linspace(0.0, robot.spring.wind_rad, 7):
        pose = Linkage(robot.design).pose([-wind])
        turns = {"leg": pose.leg_rad[0], "front": pose.front_rad[0], "ankle": pose.ankle_rad[0]}
        frames = {BODY: np.eye(4)}
        for joint in robot.joints:
            angle = joint.rest_angle_rad + turns[joint.name]
            local = np.eye(4)
            local[0, 0] = local[2, 2] = math.cos(angle)
            local[0, 2], local[2, 0] = math.sin(angle), -math.sin(angle)
            local[:3, 3] = joint.origin_m
            frames[joint.child] = frames[joint.parent] @ local
        a = frames[robot.loop.body_a] @ [*robot.loop.point_a_m, 1.0]
        b = frames[robot.loop.body_b] @ [*robot.loop.point_b_m, 1.0]
        np.testing.assert_allclose(a, b, atol=1e-12)
        for body in (MAIN_LEG, FRONT_LINK, FOOT):
            by_cosines = body_in_plane(robot, body, wind)
            np.testing.assert_allclose(1000.0 * frames[body][[0, 2], 3], by_cosines[:2, 2], atol=1e-9)
            np.testing.assert_allclose(frames[body][[0, 2], 0], by_cosines[:2, 0], atol=1e-12)


def test_the_foot_lies_flat_when_the_body_is_tilted_by_beta() -> None:
    robot = built(LONG_TOES)
    along_foot = body_in_plane(robot, FOOT, 0.0)[:2, 0]
    assert math.atan2(-along_foot[1], along_foot[0]) == pytest.approx(robot.design.beta_rad, abs=1e-12)


def test_the_energy_of_the_springs_is_the_designs() -> None:
    robot = built("kenan-2.0")
    spring = robot.layout.drive.spring
    assert 2 * spring.stiffness_nm_per_rad == pytest.approx(robot.design.stiffness_nm_per_rad)
    assert robot.spring.energy_j == pytest.approx(0.133, abs=0.001)  # the study's table for Kenan 2.0


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo", LONG_TOES])
def test_everything_bought_is_between_or_beside_the_plates(name: str) -> None:
    robot = built(name)
    low, high = robot.layout.lateral.outside
    for item in robot.hardware:
        if item.body == BODY:
            y = (item.shown_mesh.vertices @ item.T_body_part[:3, :3].T + item.T_body_part[:3, 3])[:, 1]
            assert low - 4.0 < y.min(), item.name
            assert y.max() < high + (8.0 if item.name == "sensor" else 4.0), item.name


@pytest.mark.thorough
def test_the_same_inputs_give_the_same_files_on_another_machine() -> None:
    code = (
        "import hashlib, jumpcad; from jumpcad.solids.stl import write_stl;"
        "robot = jumpcad.build(jumpcad.load_design('best-bo'), jumpcad.load_workshop(), 'best-bo');"
        "[print(part.name, hashlib.sha256(write_stl(part.mesh)).hexdigest(), part.mass_kg) for part in robot.parts]"
    )
    there = subprocess.run(
        [sys.executable, "-c", code],
        check=True, capture_output=True, text=True, cwd=ROOT,
        env=environment(),
    ).stdout.splitlines()  # fmt: skip
    here = [
        f"{part.name} {hashlib.sha256(write_stl(part.mesh)).hexdigest()} {part.mass_kg}"
        for part in built("best-bo").parts
    ]
    assert here == there


KENAN = design("kenan-2.0")
CASES: dict[str, tuple[Design, Workshop, str]] = {
    "loop": (
        KENAN.model_copy(update={"c_coef": 1.5, "d_coef": 0.3}), workshop_with(),
        r"^loop: the loop is \d+\.\d+ mm short of closing.*: lower compression_ratio, or bring c_coef nearer to 1",
    ),
    "below ground": (
        KENAN.model_copy(update={"c_coef": 1.03, "d_coef": 0.5, "compression_ratio": 0.8}), workshop_with(),
        r"^below_ground: lowest body pivot.* is -\d+\.\d mm above the line.*: lower compression_ratio",
    ),
    "legs meet": (
        Design.from_vector([105.3, 1.035, 0.57, 1.21, 0.756, 46.9, 5.2, 14.5]), workshop_with(),
        r"main leg and front link overlap by [\d.]+ mm; 0\.8 mm .*: lower compression_ratio, or raise d_coef",
    ),
    "no spring": (
        KENAN.model_copy(update={"stiffness_nmm_per_deg": 120.0}), workshop_with(),
        r"^no wire of .* makes a torsion spring for \d+ N·mm .*: lower stiffness_nmm_per_deg or compression_ratio",
    ),
    "hardly wound": (
        KENAN.model_copy(update={"compression_ratio": 0.01, "rest_angle_deg": 40.0}), workshop_with(),
        r"loaded by 0\.40°, less than 0\.5°: raise compression_ratio",
    ),
    "weak motor": (
        load_design("best-bo"), workshop_with(bought={"motors": ("n20-30",)}, safety={"motor_stall_share": 0.03}),
        r"^no motor turns the cam: it needs \d+ mN·m, the strongest allowed motor may give 1 mN·m.*: lower stiffness",
    ),
    "small bed": (
        KENAN, workshop_with(printer={"bed_mm": (70.0, 70.0, 70.0)}),
        r"^part \w+ of \d+\.\d×\d+\.\d×\d+\.\d mm does not fit .* 70\.0×70\.0×70\.0 mm at any angle, by [\d.]+ mm",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_what_cannot_be_built_is_refused_with_value_and_remedy(case: str) -> None:
    refused, workshop, words = CASES[case]
    with pytest.raises(CannotBuildError, match=words) as caught:
        build(refused, workshop)
    assert "\n" not in str(caught.value)
    assert caught.value.exit_code == 1


def test_screws_as_axles_have_one_size_and_a_thinner_one_is_no_way_out() -> None:
    """M3, before anything is said of the spacers around a thicker axle."""
    with pytest.raises(JumpcadError, match=r'^bought.axle_mm = 6: bought.retention = "nuts" .*: make it 3, or choose'):
        layout_of(KENAN, workshop_with(bought={"axle_mm": 6.0, "leg_bearing": "", "retention": "nuts"}))


def test_an_axle_that_leaves_spacers_no_wall_is_a_wrong_request() -> None:
    """Spacers of 6.4 mm with 0.2 mm of play and walls of 0.8 mm hold axles of 4.4 mm."""
    with pytest.raises(JumpcadError, match=r"^bought.axle_mm = 4.5 is more than 4.2, .*: use a thinner axle") as caught:
        layout_of(KENAN, workshop_with(bought={"axle_mm": 4.5, "leg_bearing": ""}))
    assert caught.value.exit_code == 2


def test_nothing_that_is_printed_is_left_out() -> None:
    """A body of plates, trays and stop, four links with a foot, the train, and what keeps things apart on axles."""
    usual = {
        "body_plate_left", "body_plate_right", "electronics_tray_lower", "electronics_tray_upper", "stop_bar",
        "main_leg", "front_link", "foot", "cam", "cam_gear", "motor_pinion", "motor_cap", "sensor_mount",
        "spring_bushing_left", "spring_bushing_right", "front_spacer_left", "front_spacer_right", "cam_spacer_right",
    }  # fmt: skip
    geared_down = {"idler", "idler_spacer_right", "cam_spacer_left"}
    for robot, more in (
        (built("kenan-2.0"), set()),
        (built(LONG_TOES), {"toe_left", "toe_right"}),
        (geared(), geared_down),
    ):
        assert {part.name for part in robot.parts} == usual | more
        assert all(part.placements for part in robot.parts)


def test_nothing_that_is_bought_is_left_out() -> None:
    """Of Kenan 2.0 as the default workshop makes it; wires, ties and pads besides."""
    bought = Counter(re.sub(r"(_\d+)?(_(left|right))?$", "", item.name) for item in built("kenan-2.0").hardware)
    needed = {
        "leg_axle": 1, "front_axle": 1, "cam_axle": 1, "spring_pin": 1, "hub_bearing": 2, "roller": 1,
        "roller_washer": 1, "roller_screw": 1, "roller_nut": 1, "ankle_pin": 1, "front_eye_pin": 1, "leg_spring_pin": 1,
        "ankle_pin_split_pin": 1, "front_eye_pin_split_pin": 1, "leg_spring_pin_split_pin": 1, "spring": 2, "motor": 1,
        "cap_screw": 2, "sensor": 1, "sensor_screw": 2, "battery": 1, "strap_battery": 1, "controller": 1, "driver": 1,
        "capacitor": 1, "plug": 1, "switch": 1, "switch_screw": 2, "switch_nut": 2, "stop_pad": 1, "nose_pad": 2,
    }  # fmt: skip
    assert {name: bought[name] for name in needed} == needed
    names = [item.name for item in built("kenan-2.0").hardware]
    assert len(set(names)) == len(names)
    soles = {item.article for item in built("kenan-2.0").hardware if re.match("nose_pad|toe_pad", item.name)}
    assert soles
    assert all(article.startswith(load_workshop().foot_pad.description) for article in soles)
    standoffs = len(built("kenan-2.0").layout.standoffs_mm)
    assert bought["standoff"] == standoffs >= 2
    for number in range(1, standoffs + 1):
        assert {f"standoff_{number}_screw_{side}" for side in ("left", "right")} < set(names)
