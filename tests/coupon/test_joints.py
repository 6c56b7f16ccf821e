"""Plates with openings side by side: evenly apart, with a margin all around, each with its label in front."""

import itertools

import numpy as np
import pytest

from jumpcad.coupon import joints
from jumpcad.coupon.joints import joint_pieces, rib_steps_mm, steps_mm
from jumpcad.coupon.pieces import MARGIN_MM, coupon_holes
from jumpcad.solids.outline import hole, rectangle
from jumpcad.solids.stack import Stack
from jumpcad.workshop import load_workshop


def openings(stack: Stack) -> tuple[np.ndarray, list[np.ndarray]]:
    """Bounds (2, 2) of the plate at its bottom, where nothing is engraved, and of its openings from left to right."""
    region = min(stack.slabs, key=lambda slab: slab.z0_mm).region
    boxes = [np.array([contour.min(axis=0), contour.max(axis=0)]) for contour in region.to_polygons()]
    plate = max(boxes, key=lambda box: np.ptp(box, axis=0).prod())
    return plate, sorted((box for box in boxes if box is not plate), key=lambda box: box[0, 0])


@pytest.mark.parametrize("cuts", [[hole(2.0), hole(3.0), hole(4.0)], [rectangle((8.0, 3.0)), rectangle((9.0, 4.0))]])
def test_openings_are_evenly_apart_with_a_margin(cuts: list) -> None:
    plate, found = openings(joints._row(cuts, ["a"] * len(cuts), 5.0))
    assert len(found) == len(cuts)
    sizes = [np.ptp(np.array(cut.bounds()).reshape(2, 2), axis=0) for cut in cuts]
    middles = np.array([box.mean(axis=0) for box in found])
    for box, size in zip(found, sizes, strict=True):
        assert np.ptp(box, axis=0) == pytest.approx(size, abs=2e-3)
    assert np.ptp(middles[:, 1]) < 2e-3
    pitch = np.diff(middles[:, 0])
    assert pitch == pytest.approx(pitch[0], abs=2e-3)
    assert pitch[0] >= max(size[0] for size in sizes) + 2.0 * MARGIN_MM - 2e-3
    for box, other in itertools.pairwise(found):
        assert other[0, 0] - box[1, 0] >= 2.0 * MARGIN_MM - 2e-3
    assert plate[1, 1] - max(box[1, 1] for box in found) == pytest.approx(MARGIN_MM, abs=2e-3)
    assert middles[0, 0] - plate[0, 0] == pytest.approx(plate[1, 0] - middles[-1, 0], abs=2e-3)
    assert middles[0, 0] - plate[0, 0] == pytest.approx(pitch[0] / 2.0, abs=2e-3)
    assert min(box[0, 1] for box in found) - plate[0, 1] > MARGIN_MM + 3.0  # letters in front


def test_steps_lie_on_both_sides_of_a_fit_and_ribs_are_never_negative() -> None:
    assert steps_mm(0.2, 0.1) == pytest.approx((0.1, 0.2, 0.3))
    below, fit, above = steps_mm(0.3)
    assert fit == 0.3
    assert fit - below == pytest.approx(above - fit)
    fits = load_workshop().fits
    assert rib_steps_mm(fits)[1] >= fits.rib_mm
    assert min(rib_steps_mm(fits.model_copy(update={"rib_mm": 0.0}))) == 0.0
    assert joints._number(0.05) == "05"
    assert joints._number(-0.15) == "m15"


def test_every_piece_has_a_name_of_its_own() -> None:
    names = [piece.name for piece in joint_pieces(load_workshop(), coupon_holes(load_workshop()))]
    assert len(set(names)) == len(names)
