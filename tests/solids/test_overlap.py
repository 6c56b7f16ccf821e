"""What two placed stacks share, by hand and by booleans of their solids."""

import math

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold, OpType

from jumpcad.solids.outline import disc, hole, rectangle, ring, tapered_bar
from jumpcad.solids.overlap import overlap_volume_mm3, swept
from jumpcad.solids.stack import Stack


def test_shared_volume_of_coaxial_cylinders():
    a, b = Stack.of([(0, 10, disc(12))]), Stack.of([(0, 10, disc(8))])
    lifted = np.eye(4)
    lifted[2, 3] = 6.0
    assert overlap_volume_mm3(a, np.eye(4), b, lifted) == pytest.approx(math.pi * 16.0 * 4.0, rel=2e-3)
    lifted[0, 3] = 10.5
    assert overlap_volume_mm3(a, np.eye(4), b, lifted) == 0.0


@pytest.mark.parametrize("over", [0.0, 180.0])
def test_shared_volume_agrees_with_booleans_in_space(over):
    rng = np.random.default_rng(5)
    a = Stack.of([(0, 3, tapered_bar((0, 0), (40, 5), 12, 6)), (3, 7, disc(8))])
    b = Stack.of([(0, 5, rectangle((30, 8), (10, 0))), (2, 9, disc(10, (20, 1)))]).through(hole(4.0, (20, 1)))
    for _ in range(5):
        poses = []
        for extra in (0.0, over):
            turn = trimesh.transformations.rotation_matrix(rng.uniform(0, 6.28), (0, 0, 1))
            turn = turn @ trimesh.transformations.rotation_matrix(math.radians(extra), (1, 0, 0))
            turn[:3, 3] = rng.uniform(-3, 3, 3)
            poses.append(trimesh.transformations.rotation_matrix(1.1, (0.3, 0.5, 0.8)) @ turn)
        solids = [s.solid().transform(pose[:3]) for s, pose in zip((a, b), poses, strict=True)]
        expected = Manifold.batch_boolean(solids, OpType.Intersect).volume()
        assert overlap_volume_mm3(a, poses[0], b, poses[1]) == pytest.approx(expected, rel=1e-3, abs=0.05)


def test_what_stands_in_pockets_and_over_chamfers_shares_what_is_left():
    """A plate of 20 x 20 x 6 mm with pockets of 8 and 4 mm above each other, its lower edge chamfered, and a pin."""
    plate = Stack.of([(0, 6, rectangle((20, 20)))]).pocketed([(2, 4, disc(8.0)), (4, 6, disc(4.0))]).chamfered(1.0, 0.5)
    pin, pose = Stack.of([(0, 6, disc(6.0))]), np.eye(4)
    for pose[0, 3] in (0.0, 6.0, 9.75):  # in the middle, beside the pockets, over the edge
        found = overlap_volume_mm3(plate, np.eye(4), pin, pose)
        assert found == pytest.approx((plate.solid() ^ pin.solid().transform(pose[:3])).volume(), rel=1e-3)
        assert found == pytest.approx(overlap_volume_mm3(pin, pose, plate, np.eye(4)), abs=1e-6)
    # below both pockets the whole pin, around the narrower one a ring
    middle = overlap_volume_mm3(plate, np.eye(4), pin, np.eye(4))
    assert middle == pytest.approx(math.pi * (9.0 * 2.0 + (9.0 - 4.0) * 2.0), rel=5e-3)


def test_shared_volume_needs_parallel_axes():
    stack = Stack.of([(0, 3, disc(9))])
    tilted = trimesh.transformations.rotation_matrix(0.1, (1, 0, 0))
    with pytest.raises(ValueError, match="not parallel"):
        overlap_volume_mm3(stack, np.eye(4), stack, tilted)


PLATE = Stack.of([(0.0, 2.0, rectangle((10.0, 10.0)) - rectangle((6.0, 6.0)))])


def test_along_its_axis_a_stack_becomes_longer() -> None:
    """A ring of 6 on 4 mm, 3 mm high, pushed up by 7 mm from below, covers 10 mm of height."""
    room = swept(Stack.of([(0.0, 3.0, ring(6.0, 4.0))]), np.array([0.0, 0.0, 7.0]))
    assert room is not None
    assert (room.z0_mm, room.z1_mm) == (-7.0, 3.0)
    assert room.moments[0] == pytest.approx(math.pi / 4.0 * (36.0 - 16.0) * 10.0, rel=0.01)


def test_square_to_its_axis_a_disc_covers_a_stadium() -> None:
    room = swept(Stack.of([(0.0, 1.0, disc(4.0))]), np.array([3.0, 4.0, 0.0]))
    assert room is not None
    assert room.moments[0] == pytest.approx(math.pi * 4.0 + 4.0 * 5.0, rel=0.01)


@pytest.mark.parametrize("path", [(4.0, 0.0, 0.0), (3.0, 5.0, 0.0), (0.0, 0.0, -5.0)])
def test_it_is_the_union_of_all_positions(path: tuple[float, float, float]) -> None:
    """The window of a frame closes as far as the frame has passed over it."""
    room = swept(PLATE, np.array(path))
    assert room is not None
    positions = [PLATE.solid().translate(tuple(-share * np.array(path))) for share in np.linspace(0.0, 1.0, 100)]
    union = Manifold.batch_boolean(positions, OpType.Add)
    assert room.moments[0] == pytest.approx(union.volume(), rel=0.005)


def test_an_oblique_path_is_not_swept() -> None:
    assert swept(PLATE, np.array([1.0, 0.0, 1.0])) is None
