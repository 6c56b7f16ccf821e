"""What two placed stacks share, by hand and by booleans of their solids."""

import math

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold, OpType

from jumpcad.solids.outline import disc, hole, rectangle, tapered_bar
from jumpcad.solids.overlap import overlap_volume_mm3
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
