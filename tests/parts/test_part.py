"""How parts are laid on the bed, and placed again."""

import numpy as np
import pytest
from support.built import LONG_TOES, built, geared

from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.mass import MassProperties
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.parts.part import Drawing, Part, Placement, laid, lying_on_left, lying_on_right, upright
from jumpcad.solids.outline import rectangle

WEDGE = [(2.0, 5.0, rectangle((8.0, 3.0), (4.0, 1.5))), (5.0, 7.0, rectangle((2.0, 3.0), (1.0, 1.5)))]
"""Asymmetric in every direction: 8 x 3 mm below, 2 x 3 mm above, over y from 2 to 7."""


@pytest.mark.parametrize("face", ["left", "right"])
def test_a_part_laid_and_placed_is_where_it_was_drawn(face: str) -> None:
    stack, pose = laid(WEDGE, face)
    mesh = Drawing("wedge", "body", stack, (Placement(BODY, pose),)).mesh.apply_transform(pose)
    assert stack.z0_mm == 0.0
    np.testing.assert_allclose(mesh.bounds, [[0.0, 2.0, 0.0], [8.0, 7.0, 3.0]], atol=1e-6)
    # 72 mm³ at (4, 3.5) and 12 mm³ at (1, 6)
    np.testing.assert_allclose(mesh.center_mass, [(72 * 4 + 12) / 84, (72 * 3.5 + 12 * 6) / 84, 1.5], atol=1e-6)


def test_the_named_face_lies_on_the_bed() -> None:
    """Left is where y is greatest."""
    left, _ = laid(WEDGE, "left")
    right, _ = laid(WEDGE, "right")
    assert left.slabs[0].region.area() == 6.0
    assert right.slabs[0].region.area() == 24.0


@pytest.mark.parametrize("pose", [lying_on_left(3.0, 1.0, 2.0), lying_on_right(3.0, 1.0, 2.0), upright(3.0, 1.0, 2.0)])
def test_poses_are_rigid_and_right_handed(pose: np.ndarray) -> None:
    np.testing.assert_allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-15)
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)


@pytest.mark.parametrize("which", ["kenan-2.0", LONG_TOES, "geared"])
def test_everything_on_a_robot_is_placed_rigidly(which: str) -> None:
    robot = geared() if which == "geared" else built(which)
    poses = [placement.T_body_part for part in robot.parts for placement in part.placements]
    poses += [item.T_body_part for item in robot.hardware]
    assert len(poses) > 45
    for pose in poses:
        np.testing.assert_allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-12)
        assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)
        np.testing.assert_array_equal(pose[3], [0.0, 0.0, 0.0, 1.0])


def test_a_part_that_stands_is_at_the_origin_unless_it_is_moved() -> None:
    np.testing.assert_array_equal(upright(2.5) @ [1.0, 2.0, 3.0, 1.0], [1.0, 2.0, 5.5, 1.0])
    np.testing.assert_array_equal(upright(0.0, 4.0, 5.0) @ [1.0, 2.0, 3.0, 1.0], [5.0, 7.0, 3.0, 1.0])


def test_a_long_part_fits_the_bed_askew_only() -> None:
    stack, pose = laid([(0.0, 6.0, rectangle((230.0, 10.0)))])
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


def test_a_part_is_a_copys_mass_and_as_many_as_its_places() -> None:
    """Copies weigh alike: one ring of 2 g at two places is two rings of 2 g each."""
    stack, pose = laid(WEDGE)
    drawing = Drawing("wedge", "body", stack, (Placement(BODY, pose), Placement(FOOT, pose)))
    part = Part(drawing, "PETG", MassProperties.box(0.002, (0.008, 0.005, 0.003)), "weighed")
    assert (part.name, part.quantity, part.mass_kg) == ("wedge", 2, 0.002)
    assert [place.body for place in part.placements] == [BODY, FOOT]
    assert part.mesh.volume == pytest.approx(84.0)
    assert part.look.volume == pytest.approx(84.0, rel=0.01)
    assert repr(part) == "<Part 'wedge': 2 x 2.00 g of PETG, weighed>"


def test_what_a_robot_is_made_of_is_read_line_by_line() -> None:
    """In a console, a part takes one line of a terminal 160 letters wide."""
    robot = built("kenan-2.0")
    for piece in (*robot.parts, *robot.hardware, robot.linkage):
        assert 20 < len(repr(piece)) <= 160
        assert getattr(piece, "name", "Linkage") in repr(piece)
