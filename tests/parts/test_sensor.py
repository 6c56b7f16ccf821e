"""The sensor's mount on its mesh: the switch fits, its terminals come out, its screws hold in the plate."""

from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest
import shapely
import trimesh
from support.built import built, cut, hole_centres, placed, region
from support.fits import chamfered

from jumpcad.errors import CannotBuildError
from jumpcad.layout.sensor import EAR_RADIUS_MM, MOUNT_PLAY_MM, MOUNT_WALL_MM, OPENING_MM
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.sensor import (
    EAR_MM,
    EDGE_MM,
    THREAD_MIN_MM,
    _require_base,
    ear_height_mm,
    plate_pad,
    screw_mm,
    sensor_mount,
)
from jumpcad.robot import Robot


@pytest.fixture(scope="module", params=["kenan-2.0", "best-bo"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


def along(robot: Robot, shape: shapely.Geometry) -> shapely.Geometry:
    """A section turned so that the switch's long side lies along x, about the switch."""
    sensor = robot.layout.sensor
    moved = shapely.affinity.translate(shape, *(-sensor.place_mm))
    return shapely.affinity.rotate(moved, -sensor.turn_rad, origin=(0.0, 0.0), use_radians=True)


def test_the_case_lies_in_the_mount_up_to_its_ceiling(robot: Robot) -> None:
    """The cavity is as high as the base stands out of the plate; above it 1.2 mm with a window 0.9 mm inside."""
    sensor, outside = robot.layout.sensor, robot.layout.lateral.left_plate[1]
    mesh, (length, width) = placed(robot, "sensor_mount"), robot.layout.sensor.case_mm
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


def test_both_screws_pass_the_ears_into_the_plate(robot: Robot) -> None:
    """M2: a clearance hole in the mount, a tapped one in the plate at the same place, and in it 1.6 mm of thread."""
    lateral, fits = robot.layout.lateral, robot.workshop.fits
    mount, plate = placed(robot, "sensor_mount"), placed(robot, "body_plate_left")
    ears = hole_centres(cut(mount, lateral.left_plate[1] + 0.5 * min(robot.layout.sensor.base_mm, 2.0)))
    through = {at: width for at, width in ears.items() if width == pytest.approx(fits.m2_clearance_mm, abs=0.05)}
    tapped = hole_centres(cut(plate, sum(lateral.left_plate) / 2.0))
    assert len(through) == 2
    for at in through:
        widths = [width for other, width in tapped.items() if np.hypot(*np.subtract(at, other)) < 0.02]
        assert widths == [pytest.approx(fits.m2_tap_mm, abs=0.05)]
    for number in (1, 2):
        screw = next(one for one in robot.hardware if one.name == f"sensor_screw_{number}")
        points = screw.look.copy().apply_transform(screw.T_body_part)
        assert lateral.left_plate[0] - 1e-6 <= points.bounds[0, 1] <= lateral.left_plate[1] - 1.6 + 1e-6
        middle = points.bounds.mean(axis=0)[::2]
        assert min(np.hypot(*np.subtract(middle, at)) for at in through) < 0.02


def test_the_plate_leaves_the_case_a_gap_and_has_material_around_it(robot: Robot) -> None:
    sensor, lateral = robot.layout.sensor, robot.layout.lateral
    length, width = sensor.case_mm
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
    bounds = item.look.copy().apply_transform(item.T_body_part).bounds
    assert bounds[1, 1] == pytest.approx(robot.layout.lateral.left_plate[1] + sensor.base_mm)
    assert np.ptp(bounds[:, 1]) == pytest.approx(sensor.needs.travel.total_mm)


@pytest.mark.parametrize("base_mm", [0.5, 1.0, 1.999, 2.0, 2.4, 6.0])
def test_the_mounts_ears_are_2_mm_high_however_far_the_base_stands_out(robot: Robot, base_mm: float) -> None:
    """A base that stands out less than the ears leaves them above its ceiling's underside, whole but for the window.

    By hand: the mount without ears is a box over the case with play and wall; the ears and what joins them add their
    outline as high as they are.
    """
    layout = replace(robot.layout, sensor=replace(robot.layout.sensor, base_mm=base_mm))
    (mount,) = sensor_mount(layout, robot.workshop)
    mesh, (length, width) = mount.mesh, layout.sensor.case_mm
    assert ear_height_mm(layout) == pytest.approx(2.0)
    assert mesh.bounds[1, 2] == pytest.approx(base_mm + 1.2)

    def section(height_mm: float) -> shapely.Geometry:
        return region(trimesh.intersections.mesh_plane(mesh, [0.0, 0.0, 1.0], [0.0, 0.0, height_mm])[:, :, :2])

    heights = [z for z in (0.7, 1.5, 1.97, 2.03, 3.0, 6.6, 7.1) if z < base_mm + 1.2 and abs(z - base_mm) > 0.02]
    case = shapely.box(-length / 2.0, -width / 2.0, length / 2.0, width / 2.0)
    for height in heights:
        found = section(height)
        reach = length / 2.0 + MOUNT_PLAY_MM + MOUNT_WALL_MM
        if height < 2.0:
            reach = layout.sensor.ear_mm + EAR_RADIUS_MM
        assert (found.bounds[0], found.bounds[2]) == pytest.approx((-reach, reach), abs=0.02), height
        if height < 2.0:  # ears as wide as their round ends, up to the mount's walls
            ear = found.intersection(shapely.box(length / 2.0 + 1.5, -50.0, length / 2.0 + 3.2, 50.0))
            assert (ear.bounds[1], ear.bounds[3]) == pytest.approx((-2.6, 2.6), abs=0.02), height
            at, wall = layout.sensor.ear_mm, length / 2.0 + MOUNT_PLAY_MM
            neck = shapely.box(wall + 0.5, -2.58, at, 2.58) - shapely.Point(at, 0.0).buffer(1.4)
            assert neck.difference(found).area < 1e-2, height
        opened = case if height < base_mm else case.buffer(-0.9, join_style="mitre")
        assert found.intersection(opened).area < 1e-3, height
        closed = case.difference(opened) if height > base_mm else case.buffer(0.0).difference(case)
        assert closed.difference(found).area < 1e-3, height


def test_the_mount_is_refused_on_a_plate_so_thick_that_the_base_does_not_stand_out(robot: Robot) -> None:
    """At least the first layer's chamfer, or that layer, is left of the rim around the base."""
    least = max(robot.workshop.fits.first_layer_chamfer_mm, robot.workshop.process.first_layer_mm)
    low, high = robot.layout.lateral.left_plate
    told = rf"is {least - 0.001:.2f} mm outside the left plate, which is {high - low:.1f} mm thick, {least:.2f} mm are"
    for base_mm, fits in ((least + 0.001, True), (least - 0.001, False)):
        layout = replace(robot.layout, sensor=replace(robot.layout.sensor, base_mm=base_mm))
        with nullcontext() if fits else pytest.raises(CannotBuildError, match=told) as no:
            assert len(list(sensor_mount(layout, robot.workshop))) == 1
        if not fits:
            assert no.value.margin == pytest.approx(-0.001)


def test_the_shortest_screw_that_holds_goes_through_the_ear_and_four_threads() -> None:
    """M2 has a pitch of 0.4 mm (ISO 261), so four are 1.6 mm; with 2 mm of ear a screw of 4 mm is long enough."""
    assert screw_mm() == 4.0
    assert screw_mm() >= EAR_MM + 4 * 0.4
    assert pytest.approx(4 * 0.4) == THREAD_MIN_MM
    thin = built("kenan-2.0").layout
    plate = thin.lateral.left_plate
    for thickness, height in ((plate[1] - plate[0], 2.0), (1.6, 2.6)):
        lateral = replace(thin.lateral, left_plate=(plate[0], plate[0] + thickness))
        ear = ear_height_mm(replace(thin, lateral=lateral))
        assert ear == pytest.approx(height)
        assert screw_mm() <= ear + thickness  # it ends inside the plate


@pytest.mark.parametrize("more_mm", [0.0, 1.5])
def test_the_plates_pad_under_the_mount_reaches_2_mm_beyond_the_opening(robot: Robot, more_mm: float) -> None:
    """And as far as the mount with its ears, along the switch's long side and across; a margin is added all around."""
    sensor = robot.layout.sensor
    pad = plate_pad(sensor, more_mm) if more_mm else plate_pad(sensor)
    contours = [shapely.Polygon(contour) for contour in pad.to_polygons()]
    low_x, low_y, high_x, high_y = along(robot, shapely.union_all(contours)).bounds
    wide = max(sensor.half_mm[1], sensor.case_mm[1] / 2.0 + 0.4 + 2.0) + more_mm
    assert (-low_x, high_x) == pytest.approx([sensor.half_mm[0] + more_mm] * 2, abs=2e-3)
    assert (-low_y, high_y) == pytest.approx([wide] * 2, abs=2e-3)


@pytest.mark.parametrize(("layer", "fits"), [("first_layer_mm", False), ("layer_height_mm", True)])
def test_the_base_of_the_switch_is_at_least_a_first_layer_outside_the_plate(layer: str, fits: bool) -> None:
    """However high the layers above are: the rim of the mount around it is printed first."""
    robot = built("kenan-2.0")
    holes, base = HoleSizes.of(robot.workshop, robot.layout.hub_bearing), robot.layout.sensor.base_mm
    process = holes.process.model_copy(update={"first_layer_mm": base - 0.01, layer: base + 0.01})
    with nullcontext() if fits else pytest.raises(CannotBuildError, match=f"{base + 0.01:.2f} mm are needed"):
        _require_base(robot.layout, replace(holes, process=process))


def test_the_mount_stands_on_chamfered_edges(robot: Robot) -> None:
    """The switch's case goes in there."""
    assert chamfered(robot, "sensor_mount")


def test_the_plates_pad_reaches_as_far_as_the_mount_across_it() -> None:
    """The mount stands on it: half the case, play and wall, within half the opening and the material around it."""
    assert OPENING_MM + EDGE_MM >= MOUNT_PLAY_MM + MOUNT_WALL_MM
