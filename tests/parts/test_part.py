"""How parts are laid on the bed, and placed again."""

import numpy as np
import pytest

from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.model import BODY
from jumpcad.parts.part import Drawing, Placement, lying_on_left, lying_on_right, lying_stack, upright
from jumpcad.solids.outline import rectangle

WEDGE = [(2.0, 5.0, rectangle((8.0, 3.0), (4.0, 1.5))), (5.0, 7.0, rectangle((2.0, 3.0), (1.0, 1.5)))]
"""Asymmetric in every direction: 8 x 3 mm below, 2 x 3 mm above, over y from 2 to 7."""


@pytest.mark.parametrize("face", ["left", "right"])
def test_a_part_laid_and_placed_is_where_it_was_drawn(face: str) -> None:
    stack, pose = lying_stack(WEDGE, face)
    mesh = Drawing("wedge", "body", stack, (Placement(BODY, pose),)).mesh.apply_transform(pose)
    assert stack.z0_mm == 0.0
    np.testing.assert_allclose(mesh.bounds, [[0.0, 2.0, 0.0], [8.0, 7.0, 3.0]], atol=1e-6)
    # 72 mm³ at (4, 3.5) and 12 mm³ at (1, 6)
    np.testing.assert_allclose(mesh.center_mass, [(72 * 4 + 12) / 84, (72 * 3.5 + 12 * 6) / 84, 1.5], atol=1e-6)


def test_the_named_face_lies_on_the_bed() -> None:
    """Left is where y is greatest."""
    left, _ = lying_stack(WEDGE, "left")
    right, _ = lying_stack(WEDGE, "right")
    assert left.slabs[0].region.area() == 6.0
    assert right.slabs[0].region.area() == 24.0


@pytest.mark.parametrize("pose", [lying_on_left(3.0, 1.0, 2.0), lying_on_right(3.0, 1.0, 2.0), upright(3.0, 1.0, 2.0)])
def test_poses_are_rigid_and_right_handed(pose: np.ndarray) -> None:
    np.testing.assert_allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-15)
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)


def test_a_long_part_fits_the_bed_askew_only() -> None:
    stack, pose = lying_stack([(0.0, 6.0, rectangle((230.0, 10.0)))])
    beam = Drawing("beam", "links", stack, (Placement(BODY, pose),))
    assert beam.fit_to_bed((250.0, 210.0, 200.0)).angle_deg % 90.0 == 0.0
    assert beam.fit_to_bed((250.0, 210.0, 200.0)).margin_mm == pytest.approx(20.0)
    askew = beam.fit_to_bed((180.0, 180.0, 180.0))
    # at 45° a bar of 230 x 10 mm needs (230 + 10)/sqrt(2) = 169.7 mm both ways
    assert 0.0 < askew.angle_deg < 90.0
    assert 0.0 <= askew.margin_mm <= 180.0 - 240.0 / np.sqrt(2.0) + 1e-6
    with pytest.raises(CannotBuildError, match=r"part beam of 230\.0×10\.0×6\.0 mm does not fit the bed of 160\.0×160"):
        beam.require_bed((160.0, 160.0, 180.0))
    with pytest.raises(CannotBuildError, match="choose a larger printer"):
        beam.require_bed((250.0, 210.0, 5.0))
