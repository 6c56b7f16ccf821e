"""Every bore measured on the meshes: the largest circle in a section is the nominal diameter plus the fit."""

import math

import numpy as np
import pytest
import shapely
import shapely.affinity
import shapely.ops
from support.built import LONG_TOES, built, cut, geared, inscribed_diameter, part, placed, region
from support.fits import (
    LYING_HOLE,
    MR63_OUTER,
    N20_FLAT,
    N20_SHAFT,
    PRESS,
    RIB,
    RUNNING,
    TOLERANCE_MM,
    measured,
    with_fits_apart,
)

from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.foot import drawing as foot
from jumpcad.robot.leg import drawing as links
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import rectangle
from jumpcad.solids.stack import Stack
from jumpcad.solids.stl import to_trimesh
from jumpcad.workshop import load_workshop


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_foot_holds_its_pins(kenan: Robot, side: float) -> None:
    y = side * (kenan.layout.lateral.lug_left[0] + 2.0)
    for x in (0.0, kenan.design.l4_mm):
        assert measured(kenan, "foot", y, np.array([x, 0.0])) == pytest.approx(LYING_HOLE, abs=TOLERANCE_MM)


def test_each_bore_has_its_own_fit(kenan: Robot) -> None:
    """In the default workshop tight bores, eyes and lying holes have the same 0.1 mm, in others not."""
    layout, design, shop = kenan.layout, kenan.design, with_fits_apart(kenan.workshop)
    lug = layout.lateral.lug_left[0] + 2.0
    expected = [
        (*links.main_leg(layout, shop), 2.5, {0.0: MR63_OUTER + 0.1, layout.leg_pin_mm: 3.1, design.l2_mm: 3.16}),
        (links.front_link(layout, shop), 0.5, {0.0: 3.16, design.l3_mm: 3.16}),
        (foot.foot(layout, shop), lug, {0.0: 3.3, design.l4_mm: 3.3}),
    ]
    for drawing, y, bores in expected:
        section = cut(drawing.mesh.copy().apply_transform(drawing.placements[0].T_body_part), y)
        for x, diameter in bores.items():
            assert inscribed_diameter(section, np.array([x, 0.0])) == pytest.approx(diameter, abs=TOLERANCE_MM)


def test_cam_and_gears(kenan: Robot) -> None:
    layout, lateral = kenan.layout, kenan.layout.lateral
    y = sum(lateral.gears[0]) / 2.0
    assert measured(kenan, "cam", sum(lateral.cam) / 2.0, layout.cam_axis_mm) == pytest.approx(
        RUNNING, abs=TOLERANCE_MM
    )
    assert measured(kenan, "cam_gear", y, layout.cam_axis_mm) == pytest.approx(RUNNING, abs=TOLERANCE_MM)


def test_the_cam_s_jaws_slide_in_the_pockets_of_the_gear(kenan: Robot) -> None:
    """A sliding fit inside and outside; to the end of the play they touch nothing but the gear's jaws."""
    layout, y = kenan.layout, sum(kenan.layout.lateral.gears[0]) / 2.0
    jaws, gear = (
        shapely.affinity.translate(region(cut(placed(kenan, name), y)), *-layout.cam_axis_mm)
        for name in ("cam", "cam_gear")
    )
    sliding, play = kenan.workshop.fits.sliding_mm, layout.drive.dog.play_rad
    for turn in (0.1 * play, 0.5 * play, 0.9 * play):
        ahead = shapely.affinity.rotate(jaws, -turn, (0, 0), use_radians=True)  # clockwise, as the cam turns
        assert ahead.distance(gear) == pytest.approx(min(sliding, 2.7 * min(turn, play - turn)), abs=0.01)
    for turn in (-0.02, play + 0.02):
        assert shapely.affinity.rotate(jaws, -turn, (0, 0), use_radians=True).intersection(gear).area > 0.1


@pytest.mark.parametrize("which", ["kenan-2.0", "two pairs"])
def test_pinion_fits_the_d_shaft(which: str) -> None:
    """Flat to flat with the motor's shaft, whose flat is the side of its section nearest to its axis."""
    robot = geared() if which == "two pairs" else built(which)
    layout, y = robot.layout, sum(robot.layout.lateral.gears[-1]) / 2.0
    shaft = next(item for item in robot.hardware if item.name == "motor_shaft")
    sides = cut(to_trimesh(shaft.solid).apply_transform(shaft.T_body_part), y) - layout.motor_mm
    lines = shapely.multilinestrings(list(shapely.linestrings(sides)))
    nearest = np.array(shapely.ops.nearest_points(lines, shapely.Point(0.0, 0.0))[0].coords[0])
    assert np.hypot(*nearest) == pytest.approx(N20_FLAT - N20_SHAFT / 2, abs=1e-3)
    along = nearest / np.hypot(*nearest)
    segments = cut(placed(robot, "motor_pinion"), y)
    bore = [points for points in (segments - layout.motor_mm).reshape(-1, 2) if np.hypot(*points) < 2.0]
    offsets = np.array(bore) @ along
    assert offsets.max() == pytest.approx(N20_FLAT - N20_SHAFT / 2 + PRESS, abs=0.005)
    across = np.array(bore) @ np.array([-along[1], along[0]])
    # where the bore is narrower than the shaft: on the flat left and right, and opposite and beside it
    ribs = [np.hypot(x, y) < N20_SHAFT / 2 - RIB / 2 for x, y in zip(offsets, across, strict=True)]
    for x, y in ((N20_FLAT - N20_SHAFT / 2 - RIB, 0.75), (N20_FLAT - N20_SHAFT / 2 - RIB, -0.75)):
        assert any(abs(a - x) < 0.01 and abs(b - y) < 0.4 for a, b in zip(offsets, across, strict=True))
    for x, y in ((-(N20_SHAFT / 2 - RIB), 0.0), (0.0, N20_SHAFT / 2 - RIB), (0.0, RIB - N20_SHAFT / 2)):
        assert any(math.dist((a, b), (x, y)) < 0.31 for a, b in zip(offsets[ribs], across[ribs], strict=True))


def test_screws_of_toes_pass_the_toe_and_cut_into_the_stub() -> None:
    robot = built(LONG_TOES)
    toe = part(robot, "toe_left")
    T_toe_foot = np.linalg.inv(toe.placements[0].T_body_part)
    foot = placed(robot, "foot").apply_transform(T_toe_foot)
    middle = toe.mesh.vertices[:, 1].min() + 3.5
    # screws lie across the toe, 16 and 30 mm from the root, at half of the joint's height
    height = toe.mesh.slice_plane([20.0, 0, 0], [-1.0, 0, 0]).bounds[1, 2] / 2.0
    for x in (16.0, 30.0):
        assert inscribed_diameter(cut(toe.mesh, middle), np.array([x, height])) == pytest.approx(3.4, abs=TOLERANCE_MM)
        assert inscribed_diameter(cut(foot, 0.01), np.array([x, height])) == pytest.approx(2.5, abs=TOLERANCE_MM)


@pytest.mark.parametrize("first_mm", [0.2, 0.3])
def test_an_edge_on_the_bed_is_chamfered_layer_by_layer_from_the_first_on(first_mm: float) -> None:
    """0.4 mm at 45° of a plate of 10 mm: each layer is set back by what the slope has in its middle."""
    shop = load_workshop()
    process = shop.process.model_copy(update={"first_layer_mm": first_mm, "layer_height_mm": 0.1})
    fits = shop.fits.model_copy(update={"first_layer_chamfer_mm": 0.4})
    holes = HoleSizes.of(shop.model_copy(update={"process": process, "fits": fits}), None)
    made = holes.chamfered(Stack.of([(0.0, 2.0, rectangle((10.0, 10.0)))]))
    first, second = made.slabs[:2]
    assert (first.z0_mm, first.z1_mm) == pytest.approx((0.0, first_mm))
    assert second.z1_mm - second.z0_mm == pytest.approx(0.1)
    for slab in (first, second):
        side = 10.0 - 2.0 * (0.4 - (slab.z0_mm + slab.z1_mm) / 2.0)
        assert slab.region.area() == pytest.approx(side**2, rel=1e-4)
