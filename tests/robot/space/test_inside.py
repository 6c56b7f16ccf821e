"""What the links sweep, against the law of cosines and shapely's distances."""

import numpy as np
import pytest
import shapely
from support.built import LONG_TOES, body_in_plane, built, in_body
from support.each import each

from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.robot.robot import Robot
from jumpcad.robot.space.inside import LEVER_HEAD_MM, legs_apart_mm, swept_obstacles
from jumpcad.robot.space.room import EVERYWHERE, Obstacle

NAMES = ["kenan-2.0", "best-bo", LONG_TOES]
POSITIONS = 60
PAST_RAD = np.radians(6.0)
"""How far past rest the links sweep."""
BETWEEN_MM = {"main leg": 0.5, "lever": 0.5, "front link": 0.8, "foot": 1.7}
"""How deep the outline of a bar drawn at thirteen positions is notched between two of them."""
SCREW_HEAD_MM = 1.65
"""Height of the head of an M3 screw (ISO 7380-1)."""


def swept(robot: Robot, gap_mm: float = 0.0) -> dict[str, Obstacle]:
    layout = robot.layout
    assert layout is not None
    obstacles = swept_obstacles(Linkage(robot.design), layout.sections, layout.drive, layout.lateral, PAST_RAD, gap_mm)
    return {obstacle.name: obstacle for obstacle in obstacles}


def area(obstacle: Obstacle) -> shapely.Geometry:
    radii = np.broadcast_to(obstacle.radius_mm, len(obstacle.points_mm))
    discs = zip(obstacle.points_mm, radii, strict=True)
    return shapely.union_all([shapely.Point(*point).buffer(radius) for point, radius in discs])


def windings(robot: Robot) -> np.ndarray:
    return np.linspace(-PAST_RAD, robot.spring.wind_rad, POSITIONS)


@pytest.mark.thorough
@each("name", NAMES)
@each("link", ["main leg", "front link", "foot"])
def test_a_link_stays_inside_its_sweep_all_the_way(name: str, link: str) -> None:
    robot = built(name)
    design, sections = robot.design, robot.layout.sections
    toes = design.l5_mm * np.cos(np.radians(design.ground_link_angle_deg))
    thinnest = min(sections.toe_tip_height_mm, sections.rail_tip_mm)
    low = thinnest / 2.0 - sections.foot_depth_mm
    body, ends, radius = {
        "main leg": (MAIN_LEG, [[0.0, 0.0], [design.l2_mm, 0.0]], sections.leg_tip_mm / 2.0),
        "front link": (FRONT_LINK, [[0.0, 0.0], [design.l3_mm, 0.0]], sections.front_mm / 2.0),
        "foot": (FOOT, [[-toes, low], [design.l4_mm, low]], thinnest / 2.0),
    }[link]
    room = area(swept(robot)[link]).buffer(BETWEEN_MM[link])
    for wind in windings(robot):
        bar = shapely.LineString(in_body(robot, body, wind, np.array(ends))).buffer(radius)
        assert room.contains(bar), f"{link} loaded by {np.degrees(wind):.1f}°"


def test_the_lever_leads_the_leg_by_its_angle_and_swings_on_past_rest() -> None:
    """Loaded by 53° the lever has turned by 53° with the leg; 6° past rest it is still inside."""
    robot = built("best-bo")
    layout = robot.layout
    cam = layout.drive.cam
    room = area(swept(robot)["lever"]).buffer(BETWEEN_MM["lever"])
    for turn in windings(robot):
        angle = cam.geometry.lever_start_rad + turn  # winding turns the leg up towards the body: counter-clockwise
        tip = layout.hub_mm + cam.geometry.lever_mm * np.array([np.cos(angle), np.sin(angle)])
        assert room.contains(shapely.LineString([layout.hub_mm, tip]).buffer(layout.sections.lever_root_mm / 2.0))


def test_the_gap_is_added_all_around_and_intervals_are_kept() -> None:
    robot = built("kenan-2.0")
    bare, wider = swept(robot), swept(robot, 0.8)
    for name, obstacle in bare.items():
        assert wider[name].radius_mm == pytest.approx(obstacle.radius_mm + 0.8)
        assert np.array_equal(wider[name].points_mm, obstacle.points_mm)
    half = robot.layout.sections.thickness_mm / 2.0
    assert bare["main leg"].y_mm == bare["front link"].y_mm == (-half, half)
    assert bare["foot"].y_mm == EVERYWHERE


@pytest.mark.parametrize("name", [*NAMES, "kenan-1.0", "best-ga"])
def test_the_gap_between_the_legs_is_shapelys(name: str) -> None:
    """Tapered leg and straight link with round eyes, at many more positions than the layout checks."""
    robot = built(name)
    design, sections = robot.design, robot.layout.sections
    eye, root, tip = sections.eye_radius_mm, sections.leg_root_mm / 2.0, sections.leg_tip_mm / 2.0
    leg = [[0.0, root], [design.l2_mm, tip], [design.l2_mm, -tip], [0.0, -root]]
    smallest = np.inf
    for wind in windings(robot):
        ankle, front = body_in_plane(robot, FOOT, wind)[:2, 2], body_in_plane(robot, FRONT_LINK, wind)[:2, 2]
        eyes = in_body(robot, FOOT, wind, np.array([design.l4_mm, 0.0]))
        beam = shapely.Polygon(in_body(robot, MAIN_LEG, wind, np.array(leg)))
        ends = shapely.Point(*robot.layout.hub_mm).buffer(root), shapely.Point(*ankle).buffer(max(tip, eye))
        main_leg = shapely.union_all([beam, *ends])
        link = shapely.LineString([front, eyes]).buffer(sections.front_mm / 2.0)
        link = shapely.union_all([link, shapely.Point(*front).buffer(eye), shapely.Point(*eyes).buffer(eye)])
        smallest = min(smallest, main_leg.distance(link))
    assert legs_apart_mm(Linkage(design), sections, PAST_RAD) == pytest.approx(smallest, abs=0.35)


@pytest.mark.parametrize("name", NAMES)
def test_the_foots_toes_and_rails_are_in_its_sweep_and_no_more(name: str) -> None:
    """From the ankle both get lower; they stand on the sole, half as much above and below their middle lines."""
    robot = built(name)
    sections, design = robot.layout.sections, robot.design
    foot, loaded = swept(robot)["foot"], robot.spring.wind_rad
    toe = -design.l5_mm * np.cos(np.radians(design.ground_link_angle_deg)) - 2.5  # the tip is round, 5 mm wide
    for reach, root, tip in (
        (toe, sections.toe_root_mm, sections.toe_tip_height_mm),
        (design.l4_mm, sections.rail_root_mm, sections.rail_tip_mm),
    ):
        for share, height in ((0.0, root), (1.0, tip)):
            place = in_body(robot, FOOT, loaded, np.array([[share * reach, height / 2.0 - sections.foot_depth_mm]]))[0]
            found = np.hypot(*(foot.points_mm - place).T).argmin()
            assert foot.points_mm[found] == pytest.approx(place, abs=0.3)
            assert foot.radius_mm[found] == pytest.approx(height / 2.0)


def test_the_lever_takes_its_screw_with_the_head_to_the_left(kenan: Robot) -> None:
    """Its interval of y is that of the screw, and a head's height more towards the left, which is up along y."""
    layout = kenan.layout
    found = swept_obstacles(layout.linkage, layout.sections, layout.drive, layout.lateral, 0.1)
    (right, left), screw = {one.name: one.y_mm for one in found}["lever"], layout.lateral.roller_screw
    assert right == screw[0]
    assert SCREW_HEAD_MM <= left - screw[1] < SCREW_HEAD_MM + 0.1
    assert left - screw[1] == pytest.approx(LEVER_HEAD_MM)
