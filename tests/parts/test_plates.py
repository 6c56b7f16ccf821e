"""Packing: everything on the bed, nothing on top of anything else."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import pytest
import shapely
import trimesh
from support.built import built

from jumpcad.errors import CannotBuildError
from jumpcad.parts.plates import _turn, packed


@dataclass(frozen=True)
class Part:
    name: str
    mesh: trimesh.Trimesh
    material: str
    quantity: int = 1


def box(name, size, material="PLA", quantity=1):
    return Part(name, trimesh.creation.box(size), material, quantity)


def corners(item):
    points = trimesh.transform_points(item.part.mesh.vertices, item.T_bed_part)
    return points.min(axis=0), points.max(axis=0)


PARTS = [
    box("plate", (120, 70, 3), quantity=2),
    box("tray", (60, 31.37, 2)),
    box("spacer", (7, 7, 9.5), quantity=12),
    box("leg", (130, 14, 8), "PETG"),
    box("gear", (33, 33, 5), "PETG", 3),
]
BED = (180.0, 160.0, 100.0)


def test_every_copy_lies_on_the_bed_apart_from_the_others():
    plates = packed(PARTS, BED, 5.0)
    assert sorted(item.part.name for plate in plates for item in plate.items) == sorted(
        part.name for part in PARTS for _ in range(part.quantity)
    )
    for plate in plates:
        boxes = [corners(item) for item in plate.items]
        assert {item.part.material for item in plate.items} == {plate.material}
        for low, high in boxes:
            assert np.all(low >= -1e-6)
            assert low[2] == pytest.approx(0.0, abs=1e-9)
            assert np.all(high <= np.array(BED) + 1e-6)
        for (low_a, high_a), (low_b, high_b) in combinations(boxes, 2):
            assert np.max(np.maximum(low_a - high_b, low_b - high_a)[:2]) >= 5.0 - 1e-6


def test_a_full_plate_is_followed_by_another():
    plates = packed([box("slab", (100, 100, 5), quantity=3)], (120.0, 120.0, 50.0), 5.0)
    assert [plate.name for plate in plates] == ["plate-1-PLA", "plate-2-PLA", "plate-3-PLA"]


@pytest.mark.parametrize("size", [(205, 10, 6), (10, 205, 6), (12, 198, 6)])
def test_a_long_part_lies_along_the_diagonal_of_a_narrow_bed(size):
    """By 34° or by 56°, as the diagonal of 180 x 120 mm does: less or more than half of a right angle."""
    (plate,) = packed([box("leg", size)], (180.0, 120.0, 100.0), 5.0)
    low, high = corners(plate.items[0])
    assert np.all(low >= -1e-6)
    assert np.all(high <= np.array([180.0, 120.0, 100.0]) + 1e-6)


@pytest.mark.parametrize("size", [(300, 10, 6), (170, 170, 200)])
def test_a_part_larger_than_the_bed_is_refused(size):
    with pytest.raises(CannotBuildError, match=r"part giant of .* does not fit the bed of 180\.0×180\.0×180\.0 mm"):
        packed([box("giant", size)], (180.0, 180.0, 180.0), 5.0)


@pytest.mark.parametrize(("side", "left"), [(100.0, 10.0), (109.0, 5.5), (118.0, 1.0), (120.0, 0.0)])
def test_a_plate_lies_in_the_middle_of_the_bed(side, left):
    (plate,) = packed([box("slab", (side, 60.0, 5.0))], (120.0, 100.0, 50.0), 5.0)
    low, high = corners(plate.items[0])
    assert (low[0], 120.0 - high[0]) == pytest.approx((left, left), abs=0.02)
    assert (low[1], 100.0 - high[1]) == pytest.approx((20.0, 20.0), abs=0.02)


def test_the_beds_edge_stays_free_where_that_takes_no_further_plate():
    """Kenan 2.0 on a bed of 250 x 210 mm: two plates with 5 mm around, where a tight packing touches two edges."""
    robot = built("kenan-2.0")
    plates = packed(robot.parts, (250.0, 210.0, 220.0), robot.workshop.process.part_spacing_mm)
    assert len(plates) == 2
    for plate in plates:
        lows, highs = zip(*map(corners, plate.items), strict=True)
        assert np.min(lows, axis=0)[:2].min() >= 5.0
        assert (np.array([250.0, 210.0]) - np.max(highs, axis=0)[:2]).min() >= 5.0


def test_the_beds_edge_is_used_where_that_saves_a_plate():
    """Two slabs side by side take 119 of 120 mm; with 5 mm free around them they would need a plate each."""
    (plate,) = packed([box("slab", (57.0, 100.0, 5.0), quantity=2)], (120.0, 120.0, 50.0), 5.0)
    assert len(plate.items) == 2
    assert len(packed([box("slab", (52.0, 100.0, 5.0), quantity=2)], (120.0, 120.0, 50.0), 5.0)) == 1
    assert len(packed([box("slab", (58.0, 100.0, 5.0), quantity=2)], (120.0, 120.0, 50.0), 5.0)) == 2


def test_parts_are_turned_by_a_right_angle_as_needed():
    """One that fits across alone, and two that share a plate only side by side."""
    (plate,) = packed([box("tall", (40, 100, 5))], (100.0, 50.0, 50.0), 5.0)
    low, high = corners(plate.items[0])
    assert high - low == pytest.approx([100.0, 40.0, 5.0])
    (plate,) = packed([box("tall", (40, 100, 5)), box("wide", (100, 40, 5))], (100.0, 85.0, 50.0), 5.0)
    assert len(plate.items) == 2


def test_parts_are_turned_by_one_right_angle_at_most():
    """What has more room on the bed when it is turned lies as it stands where only so it fits beside another."""
    (plate,) = packed([box("large", (80, 80, 5)), box("slim", (10, 60, 5))], (100.0, 85.0, 50.0), 5.0)
    for item in plate.items:
        assert item.T_bed_part[:3, :3].tolist() == np.eye(3).tolist()


@pytest.mark.parametrize("mirrored", [1.0, -1.0])
def test_a_long_part_without_symmetry_is_turned_the_way_that_fits(mirrored):
    """A right triangle of 280 x 80 mm fits a bed of 250 x 210 mm only askew, and turned the other way it does not."""
    corners_mm = np.array([[0.0, 0.0], [280.0, 0.0], [0.0, 80.0 * mirrored]])
    wedge = trimesh.creation.extrude_polygon(shapely.Polygon(corners_mm), 5.0)
    (plate,) = packed([Part("wedge", wedge, "PLA")], (250.0, 210.0, 50.0), 5.0)
    low, high = corners(plate.items[0])
    assert np.all(low >= -1e-6)
    assert np.all(high <= np.array([250.0, 210.0, 50.0]) + 1e-6)


@pytest.mark.parametrize("angle_deg", [0.0, 30.0, 90.0])
def test_a_turn_on_the_bed_moves_nothing_and_tilts_nothing(angle_deg: float) -> None:
    pose = _turn(angle_deg)
    assert pose[3].tolist() == [0.0, 0.0, 0.0, 1.0]
    assert pose[:3, 3].tolist() == [0.0, 0.0, 0.0]
    assert pose[2, :3].tolist() == pose[:3, 2].tolist() == [0.0, 0.0, 1.0]
    assert pose[:2, 0] == pytest.approx([np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))])
