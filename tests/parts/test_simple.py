"""Boxes and screws stand where and as long as they are asked for."""

import numpy as np
import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.parts.purchased import BoughtPart
from jumpcad.parts.simple import box_outline, placed_box, placed_screw, round_outline

CATALOGUE = load_catalogue()


def bounds(item: BoughtPart) -> np.ndarray:
    """Return the least and the greatest coordinates in the body's frame (2, 3)."""
    return np.asarray(item.look.copy().apply_transform(item.T_body_part).bounds)


def test_a_box_stands_on_the_middle_of_its_underside() -> None:
    box = placed_box("board", "a board", 10.0, -3.0, 5.0, 20.0, 8.0, 1.6, 2.5)
    np.testing.assert_allclose(bounds(box), [[0.0, -7.0, 5.0], [20.0, 1.0, 6.6]], atol=2e-3)
    assert (box.name, box.article, box.body) == ("board", "a board", BODY)
    assert box.mass_kg == pytest.approx(2.5e-3)
    assert box.mass.com_m == pytest.approx([0.010, -0.003, 0.0058], abs=2e-6)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_screw_has_its_head_beyond_one_end_of_its_shank(side: float) -> None:
    """M3, button head ISO 7380: 5.7 mm wide, 1.65 mm high."""
    screw = CATALOGUE.screws["M3"]
    found = placed_screw("screw", FOOT, np.array([7.0, 4.0]), (0.0, 12.0), side, screw, CATALOGUE)
    assert found.article.startswith("screw M3 x 12 ")
    assert found.body == FOOT
    corners = np.asarray(found.look.copy().apply_transform(found.T_body_part).vertices)
    wide = np.hypot(corners[:, 0] - 7.0, corners[:, 2] - 4.0)
    high = screw.button_head_height_mm
    ends = (12.0, 12.0 + high) if side > 0 else (-high, 0.0)
    assert np.sort(corners[:, 1])[[0, -1]] == pytest.approx([min(0.0, ends[0]), max(12.0, ends[1])], abs=2e-3)
    of_head = corners[wide > 2.0, 1]
    assert (of_head.min(), of_head.max()) == pytest.approx(ends, abs=2e-3)
    assert wide.max() == pytest.approx(screw.button_head_mm / 2.0, abs=0.05)
    cylinders = 3.0**2 * 12.0 + 0.7 * screw.button_head_mm**2 * high  # a button's head is a calotte
    assert found.mass_kg == pytest.approx(7.85e-6 * np.pi / 4.0 * cylinders, rel=0.01)


def test_outlines_lie_about_the_origin() -> None:
    np.testing.assert_allclose(box_outline(6.0, 2.0).bounds(), [-3.0, -1.0, 3.0, 1.0])
    assert round_outline(6.0).area() == pytest.approx(9.0 * np.pi, rel=0.01)
    assert round_outline(6.0, 4.0).area() == pytest.approx(5.0 * np.pi, rel=0.01)
