"""The rest stop's place in the plane: the heel on the pad, the bar behind it, and how far past rest the links reach."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import built
from support.decimals import decimals

from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.linkage import Linkage
from jumpcad.robot.robot import Robot
from jumpcad.robot.space.inside import legs_apart_mm
from jumpcad.robot.space.room import disc
from jumpcad.robot.stop.place import stop_angle_rad, stop_place


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
    with pytest.raises(
        CannotBuildError, match=r"is 1\.49 mm thick; .*at least 1\.5 mm: choose a thicker body.stop_pad"
    ):
        stop_place([], *given[:3], thin, *given[4:])


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
