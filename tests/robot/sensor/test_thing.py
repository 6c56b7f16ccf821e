"""The sensor's mount on its mesh: the switch fits, its terminals come out, its screws hold in the plate."""

import numpy as np
import pytest
import shapely
from support.built import cut, placed, region

from jumpcad.robot.robot import Robot


def along(robot: Robot, shape: shapely.Geometry) -> shapely.Geometry:
    """A section turned so that the switch's long side lies along x, about the switch."""
    sensor = robot.layout.sensor
    moved = shapely.affinity.translate(shape, *(-sensor.place_mm))
    return shapely.affinity.rotate(moved, -sensor.turn_rad, origin=(0.0, 0.0), use_radians=True)


def test_the_case_lies_in_the_mount_up_to_its_ceiling(robot: Robot) -> None:
    """The cavity is as high as the base stands out of the plate; above it 1.2 mm with a window 0.9 mm inside."""
    sensor, outside = robot.layout.sensor, robot.layout.lateral.left_plate[1]
    mesh, (length, width) = placed(robot, "sensor_mount"), robot.layout.sensor.needs.case_mm
    assert (mesh.bounds[0, 1], mesh.bounds[1, 1]) == pytest.approx((outside, outside + sensor.base_mm + 1.2))
    below = along(robot, region(cut(mesh, outside + 0.5 * sensor.base_mm)))
    above = along(robot, region(cut(mesh, outside + sensor.base_mm + 1.0)))
    case = shapely.box(-length / 2.0, -width / 2.0, length / 2.0, width / 2.0)
    assert below.intersection(case).area == pytest.approx(0.0, abs=1e-6)
    play = below.distance(case)
    assert play == pytest.approx(0.2, abs=2e-3)
    for x, y in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)):  # on all four sides
        edges = [(x * (length / 2.0 + gap), y * (width / 2.0 + gap)) for gap in (0.19, 0.21)]
        assert [below.intersects(shapely.Point(*edge)) for edge in edges] == [False, True]
    ledge = above.intersection(case)
    assert ledge.area == pytest.approx(length * width - (length - 1.8) * (width - 1.8), rel=1e-3)
    assert (below.bounds[0] + below.bounds[2], below.bounds[1] + below.bounds[3]) == pytest.approx((0, 0), abs=1e-3)


def test_the_plate_leaves_the_case_a_gap_and_has_material_around_it(robot: Robot) -> None:
    sensor, lateral = robot.layout.sensor, robot.layout.lateral
    length, width = sensor.needs.case_mm
    section = along(robot, region(cut(placed(robot, "body_plate_left"), sum(lateral.left_plate) / 2.0)))
    case = shapely.box(-length / 2.0, -width / 2.0, length / 2.0, width / 2.0)
    assert section.intersection(case).area == pytest.approx(0.0, abs=1e-6)
    for side in (-1.0, 1.0):
        ray = shapely.LineString([(0.0, 0.0), (0.0, side * (width / 2.0 + 3.0))])
        gap = section.intersection(ray).distance(case)
        assert gap == pytest.approx(0.4, abs=0.02)
        ray = shapely.LineString([(0.0, 0.0), (side * (length / 2.0 + 1.5), 0.0)])
        assert section.intersection(ray).distance(case) == pytest.approx(0.4, abs=0.02)
        begin, end = sorted(side * (width / 2.0 + gap + more) for more in (1e-3, 1.9))
        assert shapely.box(2.0 - length / 2.0, begin, length / 2.0 - 2.0, end).difference(section).area < 0.05


def test_the_switch_stands_in_its_mount_with_its_plunger_inwards(robot: Robot) -> None:
    sensor, item = robot.layout.sensor, next(one for one in robot.hardware if one.name == "sensor")
    bounds = item.shown_mesh.copy().apply_transform(item.T_body_part).bounds
    assert bounds[1, 1] == pytest.approx(robot.layout.lateral.left_plate[1] + sensor.base_mm)
    assert np.ptp(bounds[:, 1]) == pytest.approx(sensor.needs.travel.total_mm)
