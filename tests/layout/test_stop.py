"""The rest stop's place in the plane: the heel on the pad, the bar behind it, and how far past rest the links reach."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import built
from support.decimals import decimals

from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError
from jumpcad.layout.room import Obstacle, bar, disc
from jumpcad.layout.stop import stop_angle_rad, stop_obstacles, stop_place, stop_tab_obstacle
from jumpcad.layout.sweep import legs_apart_mm
from jumpcad.mechanism.linkage import Linkage
from jumpcad.robot import Robot


@pytest.fixture(scope="module", params=["kenan-2.0", "best-bo"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


def frame(robot: Robot) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors along the leg at its stop, and out of it, the way that it turns; z is up, angles below x."""
    below = math.radians(robot.design.rest_angle_deg) + robot.layout.stop.angle_rad
    return np.array([math.cos(below), -math.sin(below)]), np.array([-math.sin(below), -math.cos(below)])


def test_the_heel_touches_the_pads_middle(robot: Robot) -> None:
    """Half of the leg's height or its eye's radius, and one layer of 0.2 mm, behind the leg's middle line."""
    stop, sections, (along, behind) = robot.layout.stop, robot.layout.sections, frame(robot)
    heel = max(sections.leg_root_mm / 2.0, sections.eye_radius_mm) + 0.2
    assert stop.heel_mm == pytest.approx(heel)
    np.testing.assert_allclose(stop.face_mm, robot.layout.hub_mm + stop.radius_mm * along + heel * behind, atol=2e-6)
    np.testing.assert_allclose(stop.along, along, atol=1e-8)
    np.testing.assert_allclose(stop.behind, behind, atol=1e-8)
    assert 9.0 <= stop.radius_mm <= 24.25
    assert decimals(stop.face_mm) == 6  # nanometres: cosines differ between processors
    assert decimals([stop.along, stop.behind]) == 9


def test_the_bar_begins_at_the_pads_seat_and_its_tabs_at_the_bars_face(robot: Robot) -> None:
    """The pad is sunk by 0.6 mm; tabs of 5 x 4 mm lie at the bar's edge nearest to the hub."""
    stop, (along, behind) = robot.layout.stop, frame(robot)
    seat = stop.face_mm + (stop.pad.thickness_mm - 0.6) * behind
    np.testing.assert_allclose(stop.seat_mm, seat, atol=1e-6)
    np.testing.assert_allclose(stop.middle_mm, seat + stop.depth_mm / 2.0 * behind, atol=1e-6)
    np.testing.assert_allclose(stop.tab_mm, seat + (2.5 - 4.0) * along + 2.0 * behind, atol=1e-6)
    assert math.degrees(stop.reach_rad - stop.angle_rad) == pytest.approx(3.0)
    assert stop.depth_mm == robot.layout.sections.stop_mm


def test_the_obstacles_are_the_bar_and_its_tabs(robot: Robot) -> None:
    stop, (along, behind) = robot.layout.stop, frame(robot)
    (bar,) = stop_obstacles(stop, robot.layout.lateral.inside)
    tab = stop_tab_obstacle(stop, robot.layout.lateral.left_plate)
    for found, middle, size in (
        (bar, stop.middle_mm, (4.8, stop.depth_mm / 2.0 + 0.8)),
        (tab, stop.tab_mm, (2.5, 2.0)),
    ):
        for axis, half in zip((along, behind), size, strict=True):
            reach = (found.points_mm - middle) @ axis
            assert reach.max() == pytest.approx(-reach.min(), abs=1e-6)
            assert reach.max() + found.radius_mm == pytest.approx(half, abs=1e-6)
    assert bar.y_mm == robot.layout.lateral.inside
    assert tab.y_mm == robot.layout.lateral.left_plate


def test_the_stop_gives_way_to_what_is_there_and_says_what_misses(robot: Robot) -> None:
    layout, stop, (along, _) = robot.layout, robot.layout.stop, frame(robot)
    given = (robot.linkage, layout.sections, stop.angle_rad, stop.pad, layout.lateral.inside, layout.lateral.left_plate)
    free = stop_place([], *given)
    assert free.radius_mm == 18.0  # where it is wanted
    assert free.room_mm == 3.0
    post = disc("post", free.middle_mm + 1.0 * along, 1.0, layout.lateral.inside)
    moved = stop_place([post], *given)
    assert moved.radius_mm < 18.0
    gap = np.abs((post.points_mm[0] - moved.middle_mm) @ along) - 4.0 - 1.0
    assert 0.0 <= gap < 0.25 + 1e-6
    farther = stop_place([post], *given, 0.5)
    assert moved.radius_mm - farther.radius_mm == pytest.approx(0.5)
    with pytest.raises(CannotBuildError, match=r"no room for the rest stop .* mm too little"):
        stop_place([replace(post, radius_mm=40.0)], *given)
    enough, thin = (stop.pad.model_copy(update={"thickness_mm": thickness}) for thickness in (1.5, 1.49))
    assert stop_place([], *given[:3], enough, *given[4:]).pad == enough
    with pytest.raises(CannotBuildError, match=r"is 1\.49 mm thick; .* needs at least 1\.5 mm: choose a thicker pad"):
        stop_place([], *given[:3], thin, *given[4:])


def test_the_stop_keeps_its_place_until_something_touches_the_room_for_it(robot: Robot) -> None:
    """Pad and bar together inside; in the plate a slot for tabs of 5 x 4 mm, with 2.5 mm of material around it."""
    layout, stop, (along, behind) = robot.layout, robot.layout.stop, frame(robot)
    inside, plate = layout.lateral.inside, layout.lateral.left_plate
    given = (robot.linkage, layout.sections, stop.angle_rad, stop.pad, inside, plate)
    free = stop_place([], *given)
    middle = free.face_mm + (free.pad.thickness_mm - 0.6 + free.depth_mm) / 2.0 * behind
    half = (free.pad.thickness_mm - 0.6 + free.depth_mm) / 2.0
    ends = [(middle, 4.0 * side * along, inside) for side in (-1.0, 1.0)]
    ends += [(middle, half * side * behind, inside) for side in (-1.0, 1.0)]
    ends += [(free.tab_mm, (2.5 + 2.5) * side * along, plate) for side in (-1.0, 1.0)]
    ends += [(free.tab_mm, (2.0 + 2.5) * side * behind, plate) for side in (-1.0, 1.0)]
    for place, way, y in ends:
        outwards = way / np.hypot(*way)
        for gap, stays in ((0.01, True), (-0.01, False)):
            post = disc("post", place + way + (1.0 + gap) * outwards, 1.0, y)
            assert (stop_place([post], *given).radius_mm == 18.0) == stays
        post = disc("post", place + way + 3.01 * outwards, 1.0, y)
        assert stop_place([post], *given, 2.0).radius_mm == 18.0
        assert stop_place([post], *given, 2.02).radius_mm != 18.0


@pytest.mark.parametrize(("blocked", "radius"), [((0.0, 19.9), 24.0), ((13.1, 60.0), 9.0)])
def test_the_pad_lies_between_9_and_24_mm_from_the_hub(
    robot: Robot, blocked: tuple[float, float], radius: float
) -> None:
    layout, stop, (along, behind) = robot.layout, robot.layout.stop, frame(robot)
    given = (robot.linkage, layout.sections, stop.angle_rad, stop.pad, layout.lateral.inside, layout.lateral.left_plate)
    line = layout.hub_mm + (stop.heel_mm + 3.0) * behind

    def wall(*ends: float) -> Obstacle:
        points = bar(*(line + end * along for end in ends), spacing_mm=0.05)
        return Obstacle("wall", points, 0.05, layout.lateral.inside)

    assert stop_place([wall(*blocked)], *given).radius_mm == radius
    farther = (blocked[0] - 0.3, blocked[1] + 0.3)
    with pytest.raises(CannotBuildError, match="no room for the rest stop"):
        stop_place([wall(*farther)], *given)


def test_the_stop_is_as_far_past_rest_as_asked_for_or_as_the_loop_closes() -> None:
    """Foot and front link reach as far as they are long together; 3° of the pad's give are needed beyond the stop."""
    sections = built("kenan-2.0").layout.sections
    linkage = Linkage(load_design("kenan-2.0"))
    wanted = math.radians(5.0)
    assert stop_angle_rad(linkage, sections, wanted) == wanted
    far = stop_angle_rad(linkage, sections, math.radians(170.0))
    assert 3.0 <= math.degrees(far) < 170.0
    steps = (170.0 - math.degrees(far)) / 0.5
    assert steps == pytest.approx(round(steps), abs=1e-6)

    def closes(angle: float) -> bool:
        return float(linkage.diagonal_mm(angle + math.radians(3.0))) <= linkage.l3 + linkage.l4

    assert closes(far)


def test_a_gap_that_leg_and_front_link_have_moves_no_stop_and_one_that_they_lack_is_refused(robot: Robot) -> None:
    """They are nearest to each other with loaded springs: a stop nearer to rest would not help."""
    given, wanted = (robot.linkage, robot.layout.sections), math.radians(9.0)
    apart = legs_apart_mm(*given, math.radians(12.0))
    assert apart == legs_apart_mm(*given)
    assert stop_angle_rad(*given, wanted, apart - 0.01) == wanted
    with pytest.raises(CannotBuildError, match=r"front link is 0\.0 mm less than"):
        stop_angle_rad(*given, wanted, apart + 0.01)


@pytest.mark.parametrize(
    ("wanted_deg", "closes_deg", "stop_deg"),
    [(9.0, 12.1, 9.0), (9.0, 10.3, 7.0), (9.0, 7.6, 4.5), (9.0, 6.2, 3.0), (9.2, 6.1, 3.0)],
)
def test_the_stop_is_nearer_to_rest_by_half_degrees_until_the_loop_closes(
    robot: Robot, wanted_deg: float, closes_deg: float, stop_deg: float
) -> None:
    """From where it is wanted on, with 3° more for the pad; at 3° at least."""

    class Short(Linkage):
        def diagonal_mm(self, leg_rad: float) -> np.ndarray:
            return np.asarray(self.l3 + self.l4 + (leg_rad - math.radians(closes_deg)) * 10.0)

    found = stop_angle_rad(Short(robot.design), robot.layout.sections, math.radians(wanted_deg), -50.0)
    assert math.degrees(found) == pytest.approx(stop_deg)


def test_links_that_are_too_short_beyond_the_least_stop_are_refused(robot: Robot) -> None:
    """At 3°, and 3° more for the pad, the ankle is no farther from the front pivot than foot and front link reach."""
    linkage, sections = robot.linkage, robot.layout.sections

    class Short(Linkage):
        def diagonal_mm(self, leg_rad: float) -> np.ndarray:
            return np.asarray(self.l3 + self.l4 + (leg_rad - math.radians(6.0)) * 10.0 + 0.4)

    with pytest.raises(
        CannotBuildError,
        match=r"0\.4 mm too short to close the loop with the leg 6\.0° past rest, which a stop at 3° and",
    ) as refused:
        stop_angle_rad(Short(robot.design), sections, math.radians(9.0))
    assert (refused.value.limit, refused.value.margin) == ("stop_reach", pytest.approx(-0.4))
    wide = replace(sections, leg_root_mm=400.0, leg_tip_mm=400.0)
    with pytest.raises(CannotBuildError, match="the gap of main leg and front link is") as refused:
        stop_angle_rad(linkage, wide, math.radians(9.0), 0.5)
    assert refused.value.margin == pytest.approx(legs_apart_mm(linkage, wide, math.radians(6.0)) - 0.5)
