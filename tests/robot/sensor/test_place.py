"""The switch's place and track, from the data sheet's plunger positions and plane geometry."""

from dataclasses import replace

import numpy as np
import pytest
from support.built import built, geared

from jumpcad.dimensions import GAP_MM
from jumpcad.errors import CannotBuildError
from jumpcad.robot.robot import Robot
from jumpcad.robot.sensor.place import SensorPlace, middle_mm, sensor_place, track_mm


@pytest.fixture(scope="module", params=[lambda: built("kenan-2.0"), lambda: built("best-bo"), geared])
def robot(request: pytest.FixtureRequest) -> Robot:
    return request.param()


def test_the_track_is_as_wide_as_plunger_and_errors_and_lies_between_dog_and_teeth(robot: Robot) -> None:
    sensor, needs = robot.layout.sensor, robot.layout.sensor.needs
    assert 2.0 * sensor.half_width_mm == pytest.approx(needs.travel.pin_mm + 2.0 * (needs.along_mm + 0.3))
    wall = (track_mm(needs.travel, needs.along_mm) - 2.0 * sensor.half_width_mm) / 2.0
    assert wall > 0.5
    inner, outer = sensor.radius_mm - sensor.half_width_mm, sensor.radius_mm + sensor.half_width_mm
    assert inner - robot.layout.drive.dog.outer_mm / 2.0 >= wall - 1e-3
    assert robot.layout.drive.train.stages[-1].wheel.root_radius_mm - outer >= wall - 1e-3


def test_angles_of_ready_and_open_have_their_scatter_and_reserve(robot: Robot) -> None:
    """On a ramp of 45° an error of height is one along the track; the motor stands before the drop."""
    sensor, needs = robot.layout.sensor, robot.layout.sensor.needs
    scatter = (needs.axial_mm + needs.travel.operating_tolerance_mm + needs.along_mm) / sensor.radius_mm
    assert sensor.scatter_rad == pytest.approx(scatter)
    assert sensor.ready_rad == pytest.approx(scatter + needs.stop_rad + needs.reserve_rad)
    assert sensor.open_rad == pytest.approx(scatter + needs.reserve_rad)
    lift = robot.layout.drive.cam.law.lift_rad
    begin, end = sensor.land_rad(sensor.depth_mm - sensor.press_mm, lift)
    assert lift + sensor.direction_rad - begin == pytest.approx(sensor.ready_rad)
    assert end - lift - sensor.direction_rad == pytest.approx(sensor.open_rad)
    higher = sensor.land_rad(sensor.depth_mm - sensor.press_mm + 0.5, lift)
    assert (higher[0] - begin, end - higher[1]) == pytest.approx((0.5 / sensor.radius_mm, 0.5 / sensor.radius_mm))


def test_the_switchs_base_is_where_the_land_presses_it_in_the_middle_of_its_play(robot: Robot) -> None:
    """The gear can go 0.5 mm to the right and 0.1 mm to the left: its land is 0.2 mm to the right of the drawing."""
    sensor, lateral = robot.layout.sensor, robot.layout.lateral
    land = lateral.gears[0][1] - 0.2
    base = lateral.left_plate[1] + sensor.base_mm
    assert base - land == pytest.approx(middle_mm(sensor.needs.travel), abs=1e-6)
    assert GAP_MM == 0.5


def placed_with(robot: Robot, **travel: float) -> SensorPlace:
    """Return the place of a switch with other positions of its plunger, with nothing in its way."""
    layout, needs = robot.layout, robot.layout.sensor.needs
    other = replace(needs, travel=needs.travel.model_copy(update=travel))
    far = np.array([900.0, 900.0])
    return sensor_place([], layout.drive, layout.lateral, layout.cam_axis_mm, {}, far, layout.axle_mm, other)


def test_the_gear_keeps_1_6_mm_under_the_groove_or_is_refused(robot: Robot) -> None:
    """A plunger that stands out farther needs a groove that is deeper by layers: of 5 mm, 16 of 0.2 mm but not 18."""
    needs, thick = robot.layout.sensor.needs, robot.layout.drive.train.stages[-1].wheel.face_width_mm
    assert (needs.layer_mm, thick) == (0.2, 5.0)
    least = middle_mm(needs.travel) - needs.axial_mm - 0.1
    assert placed_with(robot, free_mm=least + 3.2).depth_mm == pytest.approx(3.2)
    with pytest.raises(
        CannotBuildError, match=r"groove: 3\.6 mm deep, it leaves 1\.4 of the cam gear's 5 mm; 1\.6 mm are needed"
    ) as refused:
        placed_with(robot, free_mm=least + 3.5)
    assert refused.value.margin == pytest.approx(-0.2)
    assert refused.value.limit == "sensor_groove"


def test_the_track_fits_between_dog_and_teeth_with_its_walls_or_is_refused(robot: Robot) -> None:
    """1.6 mm on either side: a plunger may be as thick as that leaves, and lies then in the middle between them."""
    layout, needs = robot.layout, robot.layout.sensor.needs
    wheel, dog = layout.drive.train.stages[-1].wheel, layout.drive.dog
    room = wheel.root_radius_mm - dog.outer_mm / 2.0 - 2.0 * 1.6
    thickest = room - 2.0 * (needs.along_mm + 0.3)
    assert placed_with(robot, pin_mm=thickest - 1e-6).radius_mm == pytest.approx(
        (wheel.root_radius_mm + dog.outer_mm / 2.0) / 2.0, abs=1e-3
    )
    between = rf"its dog of {dog.outer_mm:.1f} mm and its teeth, {2.0 * wheel.root_radius_mm:.1f} mm at their roots"
    with pytest.raises(
        CannotBuildError, match=rf"track on the cam gear: 0\.5 mm too little between {between}"
    ) as refused:
        placed_with(robot, pin_mm=thickest + 0.5)
    assert (refused.value.limit, refused.value.margin) == ("sensor_track", pytest.approx(-0.5))
