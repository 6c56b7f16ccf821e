"""Plates with openings side by side: evenly apart, with a margin all around, each with its label in front."""

import numpy as np
import pytest
from manifold3d import CrossSection

from jumpcad.coupon import joints
from jumpcad.coupon.joints import joint_pieces, rib_steps_mm, steps_mm
from jumpcad.coupon.pieces import coupon_holes
from jumpcad.parts.part import Piece
from jumpcad.workshop import load_workshop


def test_steps_lie_on_both_sides_of_a_fit_and_ribs_are_never_negative() -> None:
    assert steps_mm(0.2, 0.1) == pytest.approx((0.1, 0.2, 0.3))
    below, fit, above = steps_mm(0.3)
    assert fit == 0.3
    assert fit - below == pytest.approx(above - fit)
    fits = load_workshop().fits
    assert rib_steps_mm(fits)[1] >= fits.rib_mm
    assert min(rib_steps_mm(fits.model_copy(update={"rib_mm": 0.0}))) == 0.0
    # in a bore of 0.1 mm less per side than the shaft, ribs of 0.1 mm are the bore's own wall
    assert rib_steps_mm(fits.model_copy(update={"press_mm": -0.1})) == pytest.approx((0.1, 0.15, 0.2))


@pytest.fixture(scope="module")
def pieces() -> dict[str, Piece]:
    shop = load_workshop()
    return {piece.name: piece for piece in joint_pieces(shop, coupon_holes(shop))}


def holes_of(region: CrossSection) -> list[np.ndarray]:
    """Sizes (2,) of the holes in a section, from left to right."""
    boxes = [np.array([points.min(axis=0), points.max(axis=0)]) for points in region.to_polygons()]
    whole = max(boxes, key=lambda box: np.ptp(box, axis=0).prod())
    return [np.ptp(box, axis=0) for box in sorted(boxes, key=lambda box: box[0, 0]) if box is not whole]


def test_openings_are_what_they_hold_with_the_engraved_offset_on_every_side(pieces: dict[str, Piece]) -> None:
    """Taps for M2 by their diameters; a tab of 10 x 1.6 mm, motor and bearing by the sizes of the catalogue."""
    shop = load_workshop()
    fits, motor, (bearing,) = shop.fits, joints._motor(shop), joints.seats(shop)
    sliding = steps_mm(fits.sliding_mm)
    expected = {
        "taps": [(fits.m2_tap_mm + more,) * 2 for more in (-0.1, 0.0, 0.1)],
        "tray_slots": [(10.0 + 2.0 * step, 1.6 + 2.0 * step) for step in sliding],
        "motor_sockets": [(motor.width_mm + 2.0 * step, motor.height_mm + 2.0 * step) for step in sliding],
        "seat": [(bearing.outer_mm + 2.0 * step,) * 2 for step in steps_mm(fits.press_mm)],
        "axle_floor": [(3.0 + 2.0 * fits.sliding_mm,) * 2],
    }
    for name, sizes in expected.items():
        found = holes_of(pieces[name].shape.solid().slice(1.5))
        assert found == [pytest.approx(size, abs=0.01) for size in sizes], name
    for one in (bearing, *shop.catalogue.bearings.values()):  # deep enough for it, and no thinner than the gauge
        seat = joints._seats(one, coupon_holes(shop))
        assert seat.bounds_mm[:, 2].tolist() == [0.0, max(3.0, one.width_mm)]
    assert np.ptp(pieces["tray_tab"].mesh.bounds, axis=0) == pytest.approx([10.0, 30.0, 1.6])
    assert holes_of(pieces["axle_floor"].shape.solid().slice(0.75)) == []  # 0.8 mm close a plate's bore
