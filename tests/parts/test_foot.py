"""The foot with its toes, measured on meshes: where pins and toe tips are, flat on the ground."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
import trimesh
from manifold3d import Manifold, Mesh
from support.built import LONG_TOES, body_in_plane, built, cut, hole_centres, placed, region
from support.fits import with_fits_apart
from support.robots import FOLDED

from jumpcad.building import build, layout_of
from jumpcad.design import Design, load_design
from jumpcad.mechanism.model import FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.mechanism.poses import body_poses
from jumpcad.parts import foot as foot_part
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot import Robot
from jumpcad.workshop import load_workshop

ONE_PIECE = ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"]
TIP_RADIUS_MM = 2.5


def toes_of(robot: Robot, sign: float) -> trimesh.Trimesh:
    if robot.layout.toes_apart:
        return placed(robot, "toe_left" if sign > 0 else "toe_right")
    return placed(robot, "foot").slice_plane([0, sign * 0.5, 0], [0, sign, 0])


@pytest.mark.parametrize("name", [*ONE_PIECE, LONG_TOES])
def test_pins_are_one_link_apart(name: str) -> None:
    robot = built(name)
    y = robot.layout.lateral.lug_left[0] + 1.0
    holes = hole_centres(cut(placed(robot, "foot"), y))
    # the roof above a lying hole makes its box higher than wide, but leaves its middle where it is along x
    assert sorted(x for x, _ in holes)[0] == pytest.approx(0.0, abs=2e-3)
    assert sorted(x for x, _ in holes)[-1] == pytest.approx(robot.design.l4_mm, abs=2e-3)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-printable"])
def test_the_size_that_is_laid_on_the_bed_beforehand_is_the_finished_foots(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    robot, laid = built(name), []
    fit = foot_part.fit_to_bed
    monkeypatch.setattr(foot_part, "fit_to_bed", lambda *given: laid.append(given[0]) or fit(*given))
    assert foot_part.in_one_piece(robot.design, robot.layout.sections, robot.workshop.printer.bed_mm)
    bounds = placed(robot, "foot").bounds - [0.0, 0.0, -robot.layout.sections.foot_depth_mm]
    np.testing.assert_allclose(laid[0], bounds, atol=0.02)
    # lugs that reach farther aside than the toes
    wide = replace(robot.layout.sections, lug_thickness_mm=200.0)
    foot_part.in_one_piece(robot.design, wide, robot.workshop.printer.bed_mm)
    aside = wide.thickness_mm / 2.0 + 0.5 + 200.0
    np.testing.assert_allclose(laid[1][:, 1], [-aside, aside], atol=0.02)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("name", [*ONE_PIECE, LONG_TOES])
def test_toe_tips_are_where_the_design_says(name: str, sign: float) -> None:
    """A tip's disc is the farthest that the foot reaches in several directions; together they give its middle."""
    robot = built(name)
    angle = math.radians(robot.design.ground_link_angle_deg)
    tip = robot.design.l5_mm * np.array([-math.cos(angle), sign * math.sin(angle)])
    flat = toes_of(robot, sign).vertices[:, :2]
    directions = np.array([[math.cos(a), math.sin(a)] for a in math.atan2(tip[1], tip[0]) + np.radians([-25, 0, 25])])
    reach = (flat @ directions.T).max(axis=0) - TIP_RADIUS_MM
    middle, *_ = np.linalg.lstsq(directions, reach, rcond=None)
    np.testing.assert_allclose(middle, tip, atol=0.02)


@pytest.mark.parametrize("name", [*ONE_PIECE, LONG_TOES])
def test_soles_and_pads_are_flat_on_the_ground_from_nose_to_tips(name: str) -> None:
    robot = built(name)
    ground = -robot.layout.sections.foot_depth_mm
    names = [part.name for part in robot.parts if part.placements[0].body == FOOT]
    lying = np.concatenate([
        mesh.triangles[(np.abs(mesh.triangles[:, :, 2] - ground) < 1e-6).all(axis=1)].reshape(-1, 3)
        for mesh in (placed(robot, name) for name in names)
    ])  # fmt: skip
    assert min(placed(robot, name).bounds[0, 2] for name in names) == pytest.approx(ground, abs=1e-6)
    assert lying[:, 0].max() > robot.design.l4_mm
    tip_x = -robot.design.l5_mm * math.cos(math.radians(robot.design.ground_link_angle_deg))
    assert lying[:, 0].min() == pytest.approx(tip_x - TIP_RADIUS_MM, abs=2 * TIP_RADIUS_MM)
    pad = robot.workshop.foot_pad
    assert pad is not None
    assert robot.foot_depth_m == pytest.approx((pad.thickness_mm - ground) / 1000.0)
    pads = [item for item in robot.hardware if item.name.startswith(("toe", "nose")) and item.name.count("_pad")]
    lowest = [(item.solid.transform(item.T_body_part[:3]).bounding_box())[2] for item in pads]
    assert len(pads) == 4
    assert lowest == pytest.approx([-1000.0 * robot.foot_depth_m] * 4, abs=1e-3)


@pytest.mark.parametrize("name", ["kenan-2.0", LONG_TOES])
def test_contact_spheres_touch_the_ground_inside_the_parts(name: str) -> None:
    robot = built(name)
    meshes = {sign: toes_of(robot, sign) for sign in (1.0, -1.0)}
    for sphere in robot.bodies[FOOT].contacts:
        x, y, z = 1000.0 * sphere.centre_m
        assert z - 1000.0 * sphere.radius_m == pytest.approx(-1000.0 * robot.foot_depth_m, abs=1e-9)
        if "toe" in sphere.name:
            mesh = meshes[float(np.sign(y))]
            assert np.abs(mesh.vertices[:, :2] - [x, y]).sum(axis=1).min() < 2.0 * TIP_RADIUS_MM


@pytest.mark.parametrize("workshop", ["default", "fine"])
def test_the_folded_front_link_clears_the_webs_between_the_rails(workshop: str) -> None:
    """With loaded springs, measured between the meshes."""
    robot = build(FOLDED, load_workshop(workshop))
    poses = body_poses(robot, loaded=1.0)
    foot, link = (solid_of(placed(robot, name), poses[name]) for name in ("foot", "front_link"))
    middle = foot.trim_by_plane([0.0, 1.0, 0.0], -2.0)
    middle = middle.trim_by_plane([0.0, -1.0, 0.0], -2.0)
    assert middle.min_gap(link, 3.0) > 0.9


def solid_of(mesh: trimesh.Trimesh, pose: np.ndarray) -> Manifold:
    """Return a mesh of a body's frame (mm) as a solid in the world (mm)."""
    made = Manifold(Mesh(np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32)))
    assert made.volume() > 0.0
    matrix = pose.copy()
    matrix[:3, 3] *= 1000.0
    return made.transform(matrix[:3])


@pytest.mark.parametrize("name", ["kenan-2.0", LONG_TOES])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_ankles_pin_fits_its_lugs_and_its_ends_have_room_outside(name: str, side: float) -> None:
    """In the lugs a hole as wide as a lying pin needs; beyond the faces that keep the pin, room for head and clip."""
    robot = built(name)
    fits, (inner, _) = robot.workshop.fits, robot.layout.lateral.lug_left
    mesh = placed(robot, "foot")
    in_lug = hole_centres(cut(mesh, side * (inner + 1.0)))
    widths = [width for (x, _), width in in_lug.items() if abs(x) < 0.01]
    assert widths == [pytest.approx(robot.layout.axle_mm + 2.0 * fits.lying_mm, abs=0.05)]
    face = robot.layout.ankle_face_mm
    assert not mesh.contains([[2.2, side * (face + 0.3), 0.0]])[0]
    assert mesh.contains([[2.2, side * (face - 0.3), 0.0]])[0]


@pytest.mark.parametrize("angle_deg", [55.0, 80.0])
def test_the_ankles_pin_goes_in_past_the_toes(angle_deg: float) -> None:
    """Its head, or its clip, has 7 mm of room about the pin's axis from the boss's face outwards, past both toes."""
    design = load_design("best-bo").model_copy(update={"ground_link_angle_deg": angle_deg})
    layout = layout_of(design, load_workshop())
    mesh, depth, face = (
        foot_part.foot(layout, load_workshop()).mesh,
        layout.sections.foot_depth_mm,
        layout.ankle_face_mm,
    )
    turns = np.radians(np.arange(0.0, 360.0, 30.0))
    rim = [[3.4 * np.cos(turn), 3.4 * np.sin(turn)] for turn in turns]
    for y in np.arange(face + 0.1, face + 12.0, 0.2):
        assert not mesh.contains([[x, side * y, depth + z] for side in (-1.0, 1.0) for x, z in [(0, 0), *rim]]).any(), y


@pytest.mark.parametrize("axle_mm", [2.0, 3.0, 5.0])
def test_the_ankles_boss_has_two_walls_around_its_pin_and_more_than_its_ends_have_room(axle_mm: float) -> None:
    """Round about the ankle, and as wide down to the sole; the ends of a pin have 7 mm of room outside it."""
    robot = built("kenan-2.0")
    layout = replace(robot.layout, axle_mm=axle_mm)
    holes = replace(HoleSizes.of(with_fits_apart(robot.workshop), layout.hub_bearing), axle_mm=axle_mm)
    fits = holes.fits
    low_x, low_z, high_x, high_z = foot_part._ankle_boss(layout, holes).bounds()
    outer = max(8.0, axle_mm + 2.0 * fits.lying_mm + 4.0 * fits.wall_mm)
    assert (-low_x, high_x, high_z) == pytest.approx([outer / 2.0] * 3, abs=1e-6)
    assert low_z == pytest.approx(-layout.sections.foot_depth_mm)


@pytest.mark.parametrize("higher_mm", [0.0, 60.0])
@pytest.mark.parametrize("name", [*ONE_PIECE, LONG_TOES])
def test_webs_are_as_high_as_rails_and_folded_link_let_them(name: str, higher_mm: float) -> None:
    """Seen in the foot by the law of cosines: 1 mm below the loaded link's eyes and no higher than the rails.

    10 mm long at the ankle, ahead of the leg, 2 mm high at least; 6 mm long from the middle, 0.2 mm lower than the
    rails at 0.6 of their length, if that leaves 2 mm.
    """
    robot = built(name)
    rails = {key: higher_mm + getattr(robot.layout.sections, key) for key in ("rail_root_mm", "rail_tip_mm")}
    layout, length = replace(robot.layout, sections=replace(robot.layout.sections, **rails)), robot.design.l4_mm
    sections = layout.sections
    foot, link = (body_in_plane(robot, body, robot.spring.wind_rad) for body in (FOOT, FRONT_LINK))
    pivot = np.linalg.inv(foot) @ link[:, 2]
    along = np.array([length, 0.0]) - pivot[:2]
    slope, reach = along[1] / along[0], math.hypot(*along) / abs(along[0])

    def free(x_mm: float) -> float:
        return sections.foot_depth_mm + slope * (x_mm - length) - sections.eye_radius_mm * reach - 1.0

    found = foot_part._webs(layout, sections.rail_root_mm, 2.0)
    start, middle = found[0][0] if higher_mm else sections.foot_depth_mm, length / 2.0
    rail = 0.4 * sections.rail_root_mm + 0.6 * sections.rail_tip_mm - 0.2
    expected = [(start, start + 10.0, max(2.0, min(sections.rail_root_mm, free(start + 10.0))))]
    if (low := min(rail, free(middle + 6.0))) >= 2.0:
        expected.append((middle, middle + 6.0, low))
    assert len(found) == len(expected)
    for one, other in zip(found, expected, strict=True):
        assert one == pytest.approx(other, abs=1e-6)


def test_a_link_that_folds_low_lowers_the_webs() -> None:
    """A robot whose loaded link lies nearly flat in the foot has a first web of 2 mm, and a second one only if free."""
    robot = build(FOLDED, load_workshop())
    sections, layout = robot.layout.sections, robot.layout
    (start, end, height), *others = foot_part._webs(layout, sections.rail_root_mm, 2.0)
    assert (start, end) == pytest.approx((sections.foot_depth_mm, sections.foot_depth_mm + 10.0))
    assert 2.0 <= height < sections.rail_root_mm
    for _, _, low in others:
        assert 2.0 <= low < sections.rail_root_mm


LEANING = {
    "one web": [75.5741, 0.7108, 0.7295, 1.0613, 0.7519, 84.8226, 24.4946, 35.5644],
    "high web": [120.8377, 0.9061, 0.4617, 1.3671, 0.7494, 82.61, 22.6694, 15.9373],
}
"""Robots whose legs lean far over the foot on their stop."""


@pytest.mark.parametrize("numbers", LEANING.values(), ids=LEANING)
def test_the_web_at_the_ankle_begins_half_a_millimetre_ahead_of_the_leg_on_its_stop(numbers: list[float]) -> None:
    """Seen in the foot, with the pad pressed: the straight bar as wide as the ankle's eye, on the line to the hub."""
    robot = build(Design.from_vector(numbers), load_workshop("fine"))
    past = robot.layout.stop.reach_rad
    foot, leg = (body_in_plane(robot, body, -past) for body in (FOOT, MAIN_LEG))
    hub, ankle = ((np.linalg.inv(foot) @ leg @ [x, 0.0, 1.0])[:2] for x in (0.0, robot.design.l2_mm))
    assert ankle == pytest.approx([0.0, 0.0], abs=1e-6)
    for thicker_mm in (0.0, 3.0):  # or as thick as the leg, where that is more
        sections = replace(robot.layout.sections, leg_tip_mm=robot.layout.sections.leg_tip_mm + thicker_mm)
        layout = replace(robot.layout, sections=sections)
        (start, end, height), *_ = foot_part._webs(layout, sections.rail_root_mm, 2.0)
        web = shapely.box(start, -sections.foot_depth_mm, end, height - sections.foot_depth_mm)
        bar = shapely.LineString([ankle, hub]).buffer(max(sections.leg_tip_mm / 2.0, sections.eye_radius_mm))
        assert start > sections.foot_depth_mm
        assert web.distance(bar) == pytest.approx(0.5, abs=1e-3)


def test_a_leg_that_leans_back_on_its_stop_leaves_the_web_at_the_ankle() -> None:
    """156° from the foot's nose up to the hub, and a web that stays below the ankle."""
    back = Design.from_vector([179.694, 1.192, 0.648, 1.02, 0.214, 25.416, 23.003, 14.22])
    layout = layout_of(back, load_workshop())
    (start, end, height), *_ = foot_part._webs(layout, layout.sections.rail_root_mm, 2.0)
    assert height < layout.sections.foot_depth_mm
    assert (start, end) == (layout.sections.foot_depth_mm, layout.sections.foot_depth_mm + 10.0)


def test_the_webs_of_a_short_foot_join_unless_a_printable_opening_is_between_them() -> None:
    """Of 32.24 mm, 5.2 mm deep: the first ends at 15.2, the second begins at 16.12 mm."""
    short = Design.from_vector([80.9, 0.9038, 0.3985, 1.1426, 0.704, 61.75, 26.825, 13.1])
    layout, length = layout_of(short, load_workshop()), short.l4_mm
    root, ends = layout.sections.rail_root_mm, layout.sections.foot_depth_mm + 10.0
    assert 0.5 < length / 2.0 - ends < 1.2
    for opening, start in ((2.0, ends), (0.5, length / 2.0)):
        first, second = foot_part._webs(layout, root, opening)
        assert first[1] == pytest.approx(ends)
        assert second[:2] == pytest.approx((start, length / 2.0 + 6.0))


def test_a_foots_webs_leave_openings_as_large_as_the_workshops_holes(monkeypatch: pytest.MonkeyPatch) -> None:
    """And are no higher than its rails at the ankle."""
    robot, asked, webs = built("kenan-2.0"), [], foot_part._webs
    fits = robot.workshop.fits.model_copy(update={"hole_min_mm": 2.345})
    monkeypatch.setattr(foot_part, "_webs", lambda *given: asked.append(given[1:]) or webs(*given))
    foot_part.foot(robot.layout, robot.workshop.model_copy(update={"fits": fits}))
    assert asked == [(robot.layout.sections.rail_root_mm, 2.345)]


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_a_foot_fits_the_bed_with_its_nose_tips_and_toes(name: str) -> None:
    """By the sizes of its outline: exactly so large a bed is enough, and one that is 0.1 mm smaller is not."""
    robot = built(name)
    size = np.ptp(placed(robot, "foot").bounds, axis=0)
    given = (robot.design, robot.layout.sections)
    high = 2.0 * robot.layout.sections.foot_depth_mm
    top = max(high, robot.layout.sections.toe_root_mm, robot.layout.sections.rail_root_mm)
    assert foot_part.in_one_piece(*given, (500.0, 500.0, top))
    assert not foot_part.in_one_piece(*given, (500.0, 500.0, top - 0.1))
    assert foot_part.in_one_piece(*given, (size[0] + 0.05, size[1] + 0.05, 100.0))
    assert not foot_part.in_one_piece(*given, (size[0] - 0.1, min(size[0], size[1]) * 0.5, 100.0))
    for name in ("foot_depth_mm", "toe_root_mm", "rail_root_mm"):
        high = replace(given[1], **{name: 60.0})
        top = 120.0 if name == "foot_depth_mm" else 60.0
        assert foot_part.in_one_piece(robot.design, high, (500.0, 500.0, top)), name
        assert not foot_part.in_one_piece(robot.design, high, (500.0, 500.0, top - 0.1)), name
    wide = 1.0 + max(size)
    assert not foot_part.in_one_piece(*given, (wide, wide, 100.0), toe_half_width_mm=wide)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_lugs_stand_on_soles_of_1_mm_behind_and_ahead_of_both_eyes(name: str) -> None:
    """Round as deep as the foot; soles reach 1.6 depths behind, as far before the ankle, 0.42 before the eye."""
    robot = built(name)
    depth, length = robot.layout.sections.foot_depth_mm, robot.design.l4_mm
    section = region(cut(placed(robot, "foot"), sum(robot.layout.lateral.lug_left) / 2.0))
    filled = shapely.union_all([shapely.Polygon(one.exterior) for one in shapely.get_parts(section)])
    for x, ahead in ((0.0, 1.6), (length, 0.42)):
        sole = shapely.box(x - 1.6 * depth, -depth, x + ahead * depth, 1.0 - depth)
        lug = shapely.union_all([shapely.Point(x, 0.0).buffer(depth - 0.02, 64), sole]).convex_hull
        assert lug.difference(filled).area < 0.1
        outline = shapely.union_all([shapely.Point(x, 0.0).buffer(depth, 64), sole]).convex_hull
        (found,) = map(shapely.Polygon, foot_part._lug(depth, x, ahead * depth).to_polygons())
        assert found.symmetric_difference(outline).area < 0.1
    high_x = filled.bounds[2]
    assert high_x == pytest.approx(length + depth, abs=0.02)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_rails_get_lower_from_the_ankle_to_the_front_eye(name: str) -> None:
    """Straight, on the sole, between where the lugs' soles end; near a rail's outer side, where no web reaches."""
    robot = built(name)
    sections, length = robot.layout.sections, robot.design.l4_mm
    inner = sections.thickness_mm / 2.0 + 0.5
    rail = region(cut(placed(robot, "foot"), inner + 0.9 * sections.lug_thickness_mm))
    for share in (0.4, 0.55, 0.7):
        upright = shapely.LineString([(share * length, -50.0), (share * length, 50.0)]).intersection(rail)
        height = (1.0 - share) * sections.rail_root_mm + share * sections.rail_tip_mm
        assert upright.bounds[1::2] == pytest.approx(
            (-sections.foot_depth_mm, height - sections.foot_depth_mm), abs=0.03
        )


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_rails_and_lugs_are_as_thick_as_their_section(name: str) -> None:
    """From half a millimetre beside the leg on, on both sides; in the middle of a rail, and at the front eye's lug."""
    robot = built(name)
    sections, length = robot.layout.sections, robot.design.l4_mm
    mesh, low = placed(robot, "foot"), 0.5 - sections.foot_depth_mm
    inner = sections.thickness_mm / 2.0 + 0.5
    outer = inner + sections.lug_thickness_mm
    for x in (0.6 * length, length - 0.5 * sections.foot_depth_mm):
        for y, filled in ((inner + 0.02, True), (outer - 0.02, True), (outer + 0.02, False)):
            assert mesh.contains([[x, y, low], [x, -y, low]]).tolist() == [filled, filled], (x, y)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_webs_join_the_left_rail_and_the_right_one(name: str) -> None:
    """From side to side through all that is between the rails, and into them."""
    robot = built(name)
    layout, mesh = robot.layout, placed(robot, "foot")
    inner = layout.sections.thickness_mm / 2.0 + 0.5
    for start, end, height in foot_part._webs(layout, layout.sections.rail_root_mm, 2.0):
        x, z = (start + end) / 2.0, height / 2.0 - layout.sections.foot_depth_mm
        across = np.arange(-inner - 1.0, inner + 1.01, 0.25)
        assert mesh.contains([[x, y, z] for y in across]).all()
