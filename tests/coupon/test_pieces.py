"""The fit coupon as its STL files have it: holes, pegs, letters, gears; and that it prints without support."""

import io
import itertools
import math

import numpy as np
import pytest
import trimesh
from manifold3d import CrossSection, JoinType, Manifold, Mesh64
from support.gearing import turning_play_deg

from jumpcad.coupon.joints import joint_pieces
from jumpcad.coupon.pieces import coupon_holes, pieces
from jumpcad.parts.part import Piece
from jumpcad.parts.plates import packed
from jumpcad.solids.outline import text
from jumpcad.solids.stl import faults, write_stl
from jumpcad.workshop import Workshop, load_workshop

WORKSHOP = load_workshop("default")


def coupon(workshop: Workshop) -> dict[str, Piece]:
    holes = coupon_holes(workshop)
    made = pieces(holes, list(workshop.materials), workshop.material_name("gears")) + joint_pieces(workshop, holes)
    return {piece.name: piece for piece in made}


def reread(piece: Piece) -> Manifold:
    mesh = trimesh.load_mesh(io.BytesIO(write_stl(piece.mesh)), file_type="stl")
    return Manifold(Mesh64(np.asarray(mesh.vertices, dtype=float), mesh.faces.astype(np.uint64)))


def contours(region: CrossSection) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Return the outer contours of a cross-section, and its holes."""
    polygons = [np.asarray(polygon) for polygon in region.to_polygons()]
    areas = [CrossSection([polygon]).area() or -CrossSection([polygon[::-1]]).area() for polygon in polygons]
    outer = [p for p, area in zip(polygons, areas, strict=True) if area > 0]
    return outer, [p for p, area in zip(polygons, areas, strict=True) if area < 0]


def width(polygon: np.ndarray) -> float:
    """Return the diameter of the largest circle about the middle of a polygon that lies inside of it."""
    middle = (polygon.min(axis=0) + polygon.max(axis=0)) / 2.0
    ahead = np.roll(polygon, -1, axis=0) - polygon
    away = polygon - middle
    across = np.abs(ahead[:, 0] * away[:, 1] - ahead[:, 1] * away[:, 0]) / np.hypot(*ahead.T)
    return 2.0 * float(across.min())


PIECES = coupon(WORKSHOP)
OVERHANGS_MM2 = {"shaft_bores": 0.2, "lying_holes": 13.0}
"""Ribs that begin above the chamfer, 0.15 mm deep; three flat roofs, bridges 0.85 mm wide and 5 mm long."""


@pytest.mark.parametrize("material", ["PETG", "PLA"])
def test_holes_are_as_wide_as_is_engraved_under_them(material: str) -> None:
    solid = reread(PIECES[f"gauge_{material}"])
    low, high = solid.slice(1.5), solid.slice(2.8)
    _, holes = contours(low)
    found = sorted(width(polygon) for polygon in holes)
    axle = [3.0 + 0.1 * step for step in range(9)]  # 0.00 … 0.40 per side around press 0.10 and loose 0.30
    bearing = [6.0 + 0.1 * step for step in range(5)]  # 6 mm: ISO 15 outside diameter of an MR63
    assert found == pytest.approx(axle + bearing, abs=2e-3)
    letters = low - high
    for polygon in holes:
        x, y = polygon.mean(axis=0)
        nominal = 3.0 if width(polygon) < 5.0 else 6.0
        label = f"{abs(width(polygon) - nominal) / 2.0:.2f}"[1:]
        below = y - width(polygon) / 2.0
        cut = letters ^ CrossSection.square((13.0, 5.0)).translate((x - 6.5, below - 6.2))
        word = text(label, 3.5)
        shift = np.subtract(cut.bounds()[:2], word.bounds()[:2])
        assert (word.translate(tuple(shift)) ^ cut).area() == pytest.approx(word.area(), rel=0.01)
        assert cut.area() == pytest.approx(word.area(), rel=0.01)


def test_pegs_can_be_measured() -> None:
    pegs, _ = contours(reread(PIECES["gauge_PETG"]).slice(7.0))
    spans = sorted((float(p[:, 0].min()), float(np.ptp(p[:, 0]))) for p in pegs)
    assert [size for _, size in spans] == pytest.approx([4.0, 6.0, 8.0], abs=1e-3)
    gaps = [b[0] - a[0] - a[1] for a, b in itertools.pairwise(spans)]
    assert min(gaps) > 10.0  # jaws of callipers are up to 8 mm wide at the tip
    assert PIECES["gauge_PETG"].mesh.bounds[1, 2] >= 3.0 + 8.0


@pytest.mark.thorough
def test_every_piece_is_one_closed_part_that_hangs_over_nothing() -> None:
    for piece in PIECES.values():
        assert faults(write_stl(piece.mesh)) == []
        solid = reread(piece)
        heights = np.arange(0.1, solid.bounding_box()[5], 0.2)
        for below, above in itertools.pairwise(heights):
            reach = solid.slice(below).offset(
                0.21, JoinType.Round, 2.0, 64
            )  # 45° at layers of 0.2 mm; less at a tooth's corners
            allowed = OVERHANGS_MM2.get(piece.name, 0.1)
            assert (solid.slice(above) - reach).area() < allowed, (piece.name, above)


def test_pinions_play_by_the_backlash_engraved_on_them() -> None:
    _, ends = contours(reread(PIECES["gear_holder"]).slice(3.0))
    distance = float(np.ptp([polygon.mean(axis=0)[0] for polygon in ends]))
    assert [width(polygon) for polygon in ends] == pytest.approx([3.2, 3.2], abs=2e-3)  # press 0.10 per side
    bar = PIECES["gear_holder"].shape.bounds_mm
    assert np.ptp(bar, axis=0)[1] == pytest.approx(3.2 + 4.0 * WORKSHOP.fits.wall_mm)  # two walls on each side
    wheel = reread(PIECES["gear_wheel"]).slice(2.5).rotate(180.0 + 360.0 / 40.0)
    running = 3.0 + 2.0 * WORKSHOP.fits.sliding_mm  # both turn on axles of 3 mm
    assert [width(bore) for bore in contours(wheel)[1]] == pytest.approx([running], abs=2e-3)
    played = {}
    for name in (name for name in PIECES if name.startswith("pinion")):
        solid = reread(PIECES[name])
        assert [width(bore) for bore in contours(solid.slice(2.5))[1]] == pytest.approx([running], abs=2e-3)
        play = math.radians(turning_play_deg(wheel, solid.slice(2.5), distance, 360.0 / 15.0))
        played[name] = play * 1.25 * 15 / 2.0  # along the pitch circle of 15 teeth of module 1.25
        label = f"0.{name[-2:]}"[1:]
        assert (solid.slice(2.5) - solid.slice(4.8)).area() == pytest.approx(text(label, 3.0).area(), rel=0.01)
    expected = {f"pinion_{number:02d}": number / 100.0 for number in (5, 10, 15, 20, 25)}
    assert played == pytest.approx(expected, abs=6e-3)


def test_a_coupon_fits_the_smallest_bed() -> None:
    plates = packed(PIECES.values(), (180.0, 180.0, 180.0), 5.0)
    assert [plate.name for plate in plates] == ["plate-1-PETG", "plate-1-PLA"]


@pytest.mark.parametrize("step", [15, 20, 25])
def test_the_dogs_jaws_turn_in_their_pockets_as_far_as_their_play(step: int) -> None:
    jaws = reread(PIECES["dog_jaws"]).slice(5.0)
    pockets = reread(PIECES[f"dog_pockets_{step}"]).slice(2.5)
    free = [turn for turn in range(-20, 21) if (jaws.rotate(float(turn)) ^ pockets).area() < 0.05]
    assert free == list(range(-7, 8))  # 15 degrees between pockets of 55 and jaws of 40
