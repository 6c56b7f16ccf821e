"""Whole robots: the loop closed by the joints' frames, refusals, the same bytes."""

import hashlib
import math
import re
import subprocess
import sys
from collections import Counter

import numpy as np
import pytest
from support.built import LONG_TOES, body_in_plane, built, design, geared, placed
from support.elsewhere import environment
from support.places import ROOT
from support.workshops import changed

from jumpcad.building import assembly, build
from jumpcad.building.assembly import _sensor_needs, assembled, layout_of
from jumpcad.catalogue import load_catalogue
from jumpcad.design import Design, load_design
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.layout.drive_places import PLATE_PINS_RAD, NoPinRoomError
from jumpcad.mechanism.flight import leg_blow
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.solids.stl import write_stl
from jumpcad.strength.axles import pin_head_mm
from jumpcad.strength.growth import Growth
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


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_leg_goes_from_loaded_springs_into_its_stop_as_far_as_it_gives(name: str) -> None:
    robot = built(name)
    leg = robot.joint(robot.spring.joint)
    assert leg.lower_rad == -robot.design.compression_rad
    assert robot.stop is not None
    assert robot.stop_blow is not None
    assert robot.stop_blow.give_rad > 0.0
    assert leg.upper_rad == pytest.approx(robot.stop.angle_rad + robot.stop_blow.give_rad)


def test_springs_stop_and_roller_of_a_robot_are_those_of_its_drive_and_layout() -> None:
    """Springs wound by 4° at rest: at release k·(wind + 4°), the most that the leg's joint is turned with.

    The pad's stiffness about the leg's joint is that along the impact times its distance from it squared.
    """
    shop = changed(spring={"preload_deg": 4.0})
    robot = assembled(KENAN, shop, "", Growth())
    layout, wound = robot.layout, robot.design.compression_rad + math.radians(4.0)
    assert layout.drive.spring.preload_rad == robot.spring.preload_rad == math.radians(4.0)
    assert robot.joint("leg").effort_nm == pytest.approx(robot.design.stiffness_nm_per_rad * wound)
    assert robot.roller_off is not None
    assert robot.roller_off is robot.release.off
    assert robot.stop is robot.stop_blow.stop
    assert robot.stop.angle_rad == layout.stop.angle_rad
    pad = 1000.0 * layout.stop.pad_n_per_mm(layout.sections.thickness_mm)
    assert robot.stop.stiffness_nm_per_rad == pytest.approx(pad * (layout.stop.radius_mm / 1000.0) ** 2)
    blow = leg_blow(robot.bodies, robot.linkage, robot.spring, layout.stop.angle_rad)
    assert robot.stop_blow.energy_j == pytest.approx(blow.energy_j, rel=1e-4)
    # what the pad absorbs, by its stiffness: a spring's energy at the greatest deflection
    give = robot.stop_blow.give_rad
    assert robot.stop.stiffness_nm_per_rad * give**2 / 2.0 == pytest.approx(robot.stop_blow.energy_j, rel=1e-3)
    assert robot.stop_blow.give_mm == pytest.approx(give * layout.stop.radius_mm, rel=1e-3)


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
            y = (item.look.vertices @ item.T_body_part[:3, :3].T + item.T_body_part[:3, 3])[:, 1]
            assert low - 4.0 < y.min(), item.name
            assert y.max() < high + (8.0 if item.name == "sensor" else 4.0), item.name


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
        KENAN.model_copy(update={"c_coef": 1.5, "d_coef": 0.3}), changed(),
        r"^loop: the loop is \d+\.\d+ mm short of closing.*: lower compression_ratio, or bring c_coef nearer to 1",
    ),
    "below ground": (
        KENAN.model_copy(update={"c_coef": 1.03, "d_coef": 0.5, "compression_ratio": 0.8}), changed(),
        r"^below_ground: lowest body pivot.* is -\d+\.\d mm above the line.*: lower compression_ratio",
    ),
    "legs meet": (
        Design.from_vector([105.3, 1.035, 0.57, 1.21, 0.756, 46.9, 5.2, 14.5]), changed(),
        r"main leg and front link come \d\.\d mm nearer than the 0\.8 mm .*: lower compression_ratio, or raise d_coef",
    ),
    "no spring": (
        KENAN.model_copy(update={"stiffness_nmm_per_deg": 120.0}), changed(),
        r"^no wire of .* makes a torsion spring for \d+ N·mm .*: lower stiffness_nmm_per_deg or compression_ratio",
    ),
    "hardly wound": (
        KENAN.model_copy(update={"compression_ratio": 0.01, "rest_angle_deg": 40.0}), changed(),
        r"loaded by 0\.40°, less than 0\.5°: raise compression_ratio",
    ),
    "weak motor": (
        load_design("best-bo"), changed(bought={"motors": ("n20-30",)}, safety={"motor_stall_share": 0.03}),
        r"^no motor turns the cam: it needs \d+ mN·m, the strongest allowed motor may give 1 mN·m.*: lower stiffness",
    ),
    "small bed": (
        KENAN, changed(printer={"bed_mm": (70.0, 70.0, 70.0)}),
        r"^part \w+ of \d+\.\d×\d+\.\d×\d+\.\d mm does not fit the bed of 70\.0×70\.0×70\.0 mm at any angle: choose a",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_what_cannot_be_built_is_refused_with_value_and_remedy(case: str) -> None:
    refused, workshop, words = CASES[case]
    with pytest.raises(CannotBuildError, match=words) as caught:
        build(refused, workshop)
    assert "\n" not in str(caught.value)
    assert caught.value.exit_code == 1


def test_an_unknown_motor_is_a_wrong_request() -> None:
    with pytest.raises(JumpcadError, match=r"'n20-99': is no motor in the catalogue.*did you mean") as caught:
        build(KENAN, changed(bought={"motors": ("n20-99",)}))
    assert caught.value.exit_code == 2


def test_screws_as_axles_have_one_size_and_a_thinner_one_is_no_way_out() -> None:
    """M3, before anything is said of the spacers around a thicker axle."""
    with pytest.raises(JumpcadError, match=r'^bought.axle_mm = 6: bought.retention = "nuts" .*: make it 3, or choose'):
        layout_of(KENAN, changed(bought={"axle_mm": 6.0, "leg_bearing": "", "retention": "nuts"}))


def test_springs_for_a_free_direction_of_their_pin_are_tried_as_long_as_there_is_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[tuple[float, ...]] = []
    free = [(0.9, 1.2), (1.2,), ()]

    def laid_out(_design: Design, _workshop: Workshop, _growth: Growth, directions: tuple[float, ...]) -> None:
        asked.append(directions)
        raise NoPinRoomError("no room for the spring pin: lower stiffness_nmm_per_deg", free[len(asked) - 1])

    monkeypatch.setattr(assembly, "_laid_out", laid_out)
    with pytest.raises(NoPinRoomError, match="lower stiffness_nmm_per_deg"):
        layout_of(KENAN, changed())
    assert asked == [PLATE_PINS_RAD, (0.9, 1.2), (1.2,)]
    asked.clear()
    with pytest.raises(NoPinRoomError, match=r"bought\.spring"):  # springs from stock are of one stiffness
        layout_of(KENAN, changed(bought={"spring": "any"}))


def test_springs_that_are_bought_are_as_stiff_as_their_maker_says() -> None:
    """Two of them, whatever stiffness the design has."""
    stock = load_catalogue().springs["9271K589"]
    robot = build(load_design("kenan-1.0"), changed(bought={"spring": stock.name}))
    assert math.radians(robot.spring.stiffness_nm_per_rad * 1000.0) == pytest.approx(2.0 * stock.rate_nmm_per_deg)
    assert robot.design.stiffness_nmm_per_deg != pytest.approx(2.0 * stock.rate_nmm_per_deg, rel=0.01)


def test_plates_grow_by_their_own_factor_and_boards_keep_their_places() -> None:
    usual, shop = built("kenan-2.0").layout, load_workshop()
    grown = layout_of(KENAN, shop, Growth(plate=1.25))
    assert np.ptp(grown.lateral.left_plate) == pytest.approx(1.25 * np.ptp(usual.lateral.left_plate), abs=0.01)
    for role, board in grown.electronics.boards.items():
        assert board.name == getattr(shop.bought, role)


def test_an_axle_that_leaves_spacers_no_wall_is_a_wrong_request() -> None:
    """Spacers of 6.4 mm with 0.2 mm of play and walls of 0.8 mm hold axles of 4.4 mm."""
    with pytest.raises(JumpcadError, match=r"^bought.axle_mm = 4.5 is more than 4.4, .*: use a thinner axle") as caught:
        layout_of(KENAN, changed(bought={"axle_mm": 4.5, "leg_bearing": ""}))
    assert caught.value.exit_code == 2


def test_stop_plates_and_toes_are_those_of_the_workshops_body() -> None:
    """A degree farther and 0.4 mm thicker than in the default workshop, and toes with bars across them."""
    usual = load_workshop().body
    wanted = {"stop_deg": usual.stop_deg + 1.0, "plate_mm": usual.plate_mm + 0.4, "toe_half_width_mm": 65.0}
    layout = layout_of(KENAN, changed(body=wanted, bought={"axle_mm": 2.0, "leg_bearing": ""}))
    assert layout.axle_mm == 2.0
    assert math.degrees(layout.stop.angle_rad) == pytest.approx(wanted["stop_deg"])
    for low, high in (layout.lateral.left_plate, layout.lateral.right_plate):
        assert high - low == pytest.approx(wanted["plate_mm"])
    assert layout.toe_half_width_mm == 65.0
    assert not layout.toes_apart
    wide = layout_of(KENAN, changed(body={"toe_half_width_mm": 170.0}, bought={"retention": "nuts"}))
    assert wide.toes_apart  # 340 mm from side to side
    assert wide.retention == "nuts"
    # its pin's head passes the left plate with a loose fit, 0.3 mm all around; ears beside a counterbore of 4 mm
    shop = load_workshop()
    assert wide.pin_hole.diameter_mm == pytest.approx(pin_head_mm(shop.catalogue, shop.bought) + 2.0 * 0.3)
    assert wide.cap_ear_mm == pytest.approx(4.0 + 2.0 * shop.fits.wall_min_mm)


def test_a_robot_with_two_pairs_of_gears_has_their_axle() -> None:
    robot = geared()
    names = {item.name for item in robot.hardware}
    assert "idler_axle" in names
    assert "idler_axle" not in {item.name for item in built("kenan-2.0").hardware}


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_sensors_place_knows_the_workshops_errors_and_how_far_the_cam_runs_on(name: str) -> None:
    """From contact to standstill the cam turns as fast as with a full battery; errors and reserve as they are named."""
    robot = built(name)
    seats, needs = robot.workshop.seats, robot.layout.sensor.needs
    assert needs.stop_rad == pytest.approx(robot.layout.drive.train.cam_speed_rad_s * seats.sensor_stop_s, rel=1e-4)
    assert (needs.axial_mm, needs.along_mm) == (seats.sensor_axial_mm, seats.sensor_along_mm)
    assert needs.reserve_rad == pytest.approx(math.radians(seats.sensor_reserve_deg))
    assert needs.layer_mm == robot.workshop.process.layer_height_mm
    assert needs.part.name == robot.workshop.bought.sensor
    late = changed(seats={"sensor_stop_s": 0.08})
    slower = _sensor_needs(late, chosen_parts(late), robot.layout.drive)
    assert slower.stop_rad == pytest.approx(0.08 / seats.sensor_stop_s * needs.stop_rad, rel=1e-4)
    thick = changed(process={"first_layer_mm": 0.3, "layer_height_mm": 0.15})
    assert _sensor_needs(thick, chosen_parts(thick), robot.layout.drive).layer_mm == 0.15


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_spacers_keep_the_front_link_and_the_cam_where_they_are(name: str) -> None:
    """A quarter of a millimetre at either end of what moves along its axle; the cam's spacer stands on the plate."""
    robot = built(name)
    low, high = robot.layout.lateral.inside
    right, link, left, cam, spacer = (
        placed(robot, one).bounds[:, 1]
        for one in ("front_spacer_right", "front_link", "front_spacer_left", "cam", "cam_spacer_right")
    )
    gaps = [right[0] - low, link[0] - right[1], left[0] - link[1], high - left[1], cam[0] - spacer[1]]
    assert gaps == pytest.approx(5 * [0.25], abs=1e-3)
    assert spacer[0] == pytest.approx(low, abs=1e-3)


@pytest.mark.parametrize("which", ["one pair", "two pairs"])
def test_spacers_are_on_their_axles(which: str) -> None:
    robot = built("kenan-2.0") if which == "one pair" else geared()
    spacers = [part.name for part in robot.parts if "_spacer_" in part.name]
    assert len(spacers) == (3 if which == "one pair" else 5)
    for name in spacers:
        middle = placed(robot, name).bounds.mean(axis=0)[[0, 2]]
        assert middle == pytest.approx(robot.layout.axles[name.split("_")[0]], abs=1e-3), name


def test_spacers_of_the_idler_have_as_much_play_to_either_side() -> None:
    """Between the right plate and the wheel; that of the cam touches the left plate and leaves the gear its play."""
    robot = geared()
    lateral = robot.layout.lateral
    low, high = placed(robot, "idler_spacer_right").bounds[:, 1]
    assert low - lateral.inside[0] == pytest.approx(lateral.gears[0][0] - high, abs=1e-3)
    assert 0.1 < low - lateral.inside[0] < 0.5
    start, end = placed(robot, "cam_spacer_left").bounds[:, 1]
    assert end == pytest.approx(lateral.inside[1], abs=1e-3)
    assert 0.0 < start - lateral.gears[0][1] < 0.5


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
        "capacitor": 1, "plug": 1, "switch": 1, "switch_screw": 2, "stop_pad": 1, "nose_pad": 2,
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


def test_trays_have_the_walls_and_the_play_of_the_workshop() -> None:
    shop = load_workshop()
    fits = shop.fits.model_copy(update={"wall_min_mm": 0.95, "sliding_mm": 0.23})
    electronics = layout_of(load_design("kenan-2.0"), shop.model_copy(update={"fits": fits})).electronics
    assert (electronics.wall_mm, electronics.play_mm) == (0.95, 0.23)
