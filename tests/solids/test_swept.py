"""What a stack covers on its way: areas and volumes of geometry, and the union of many positions."""

import math

import numpy as np
import pytest
from manifold3d import Manifold, OpType

from jumpcad.solids.outline import disc, rectangle, ring
from jumpcad.solids.stack import Stack
from jumpcad.solids.swept import swept

PLATE = Stack.of([(0.0, 2.0, rectangle((10.0, 10.0)) - rectangle((6.0, 6.0)))])


def test_along_its_axis_a_stack_becomes_longer() -> None:
    """A ring of 6 on 4 mm, 3 mm high, pushed up by 7 mm from below, covers 10 mm of height."""
    room = swept(Stack.of([(0.0, 3.0, ring(6.0, 4.0))]), np.array([0.0, 0.0, 7.0]))
    assert room is not None
    assert (room.z0_mm, room.z1_mm) == (-7.0, 3.0)
    assert room.volume_mm3 == pytest.approx(math.pi / 4.0 * (36.0 - 16.0) * 10.0, rel=0.01)


def test_square_to_its_axis_a_disc_covers_a_stadium() -> None:
    room = swept(Stack.of([(0.0, 1.0, disc(4.0))]), np.array([3.0, 4.0, 0.0]))
    assert room is not None
    assert room.volume_mm3 == pytest.approx(math.pi * 4.0 + 4.0 * 5.0, rel=0.01)


@pytest.mark.parametrize("path", [(4.0, 0.0, 0.0), (3.0, 5.0, 0.0), (0.0, 0.0, -5.0)])
def test_it_is_the_union_of_all_positions(path: tuple[float, float, float]) -> None:
    """The window of a frame closes as far as the frame has passed over it."""
    room = swept(PLATE, np.array(path))
    assert room is not None
    positions = [PLATE.solid().translate(tuple(-share * np.array(path))) for share in np.linspace(0.0, 1.0, 100)]
    union = Manifold.batch_boolean(positions, OpType.Add)
    assert room.volume_mm3 == pytest.approx(union.volume(), rel=0.005)


def test_an_oblique_path_is_not_swept() -> None:
    assert swept(PLATE, np.array([1.0, 0.0, 1.0])) is None
