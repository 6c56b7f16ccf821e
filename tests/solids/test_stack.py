"""Stacks: what slabs make together, how they weigh, and whether their files are closed."""

import numpy as np
import pytest
import trimesh
from manifold3d import Error
from support.stacks import random_stack

from jumpcad.errors import JumpcadError
from jumpcad.solids.outline import disc, hole, rectangle
from jumpcad.solids.stack import Stack
from jumpcad.solids.stl import faults, to_trimesh


def stl(stack):
    return trimesh.exchange.stl.export_stl(to_trimesh(stack.solid()))


def test_a_stack_of_slivers_alone_is_an_empty_solid() -> None:
    """A box may cut off less of a part than a file can hold."""
    solid = Stack.of([(0, 4, rectangle((10, 1e-4)))]).solid()
    assert solid.is_empty()
    assert solid.volume() == 0.0


def test_overlapping_slabs_count_once():
    stack = Stack.of([(0, 4, rectangle((10, 10))), (2, 6, rectangle((10, 10), (5, 0)))])
    assert stack.moments[0] == pytest.approx(400 + 400 - 2 * 50)
    assert [(slab.z0_mm, slab.z1_mm) for slab in stack.slabs] == [(0, 2), (2, 4), (4, 6)]
    np.testing.assert_allclose(stack.bounds_mm, [[-5, -5, 0], [10, 5, 6]])


def test_cuts_leave_the_rest():
    stack = Stack.of([(0, 5, rectangle((20, 20)))]).through(rectangle((4, 4))).minus([(3, 9, rectangle((8, 8)))])
    assert stack.moments[0] == pytest.approx(5 * 400 - 3 * 16 - 2 * 64)
    with pytest.raises(JumpcadError, match="nothing is left"):
        stack.minus([(0, 5, rectangle((30, 30)))])


def test_a_chamfer_is_the_slope_sampled_in_the_middle_of_each_layer():
    block = Stack.of([(0, 3, rectangle((20, 20)))]).chamfered(0.35, 0.2)
    assert [slab.region.bounds()[2] for slab in block.slabs] == pytest.approx([10 - 0.25, 10 - 0.05, 10])
    assert [slab.z0_mm for slab in block.slabs] == pytest.approx([0.0, 0.2, 0.4])
    frustum = (20.0**2 + 19.3**2 + 20.0 * 19.3) / 3.0 * 0.35
    assert block.moments[0] == pytest.approx(400 * 2.65 + frustum, abs=2.0)
    bored = Stack.of([(0, 3, disc(20))]).through(hole(6.0)).chamfered(0.35, 0.2)
    assert max(np.hypot(*contour.T).min() for contour in bored.slabs[0].region.to_polygons()[1:]) > 3.24
    with pytest.raises(JumpcadError, match=r"bottom slab of 0\.3 mm is too thin"):
        Stack.of([(0, 0.3, disc(9))]).chamfered(0.35, 0.2)


def test_stacks_that_are_made_alike_are_equal_and_others_are_not():
    slabs = [(0, 3, (10.0, 0.0)), (1, 5, (6.0, 2.0))]

    def made(changes=(0.0, 0.0)):
        return Stack.of([(z0, z1 + changes[0], disc(d + changes[1], (x, 0.0))) for z0, z1, (d, x) in slabs])

    assert made() == made()
    assert hash(made()) == hash(made())
    assert len({made(), made((0.1, 0.0)), made((0.0, 0.1))}) == 3
    assert made() != made().chamfered(0.35, 0.2)
    assert Stack.of([(0, 3, disc(9))]) != Stack.of([(0, 4, disc(9))])


@pytest.mark.thorough
def test_files_of_random_parts_are_closed_and_in_one_piece():
    rng = np.random.default_rng(20)
    for _ in range(40):
        stack = random_stack(rng)
        assert faults(stl(stack)) == []
        assert stack.solid().volume() == pytest.approx(stack.moments[0], rel=5e-4)


@pytest.mark.parametrize("seed", [43, 86, 98])
def test_outlines_that_cross_next_to_a_grid_point_leave_no_crowded_edge(seed):
    # without drawing short edges together, slabs of these parts meet along an edge of one micrometre
    assert faults(stl(random_stack(np.random.default_rng(seed)))) == []


def test_corners_survive_32_bits():
    vertices = to_trimesh(random_stack(np.random.default_rng(3)).solid()).vertices
    flat = vertices[:, :2]
    assert np.array_equal(flat.astype(np.float32).astype(np.float64), flat)
    assert len(np.unique(vertices.astype(np.float32), axis=0)) == len(vertices)


def test_a_pocket_cuts_what_subtracting_it_cuts():
    block = Stack.of([(0, 6, rectangle((30, 20))), (6, 9, rectangle((20, 20)))]).through(disc(3)).chamfered(0.4, 0.2)
    pockets = [(2, 3, disc(4, (6, 0))), (3, 7, disc(5, (6, 0))), (8, 9, disc(5, (-6, 0)))]
    cut, made = block.minus(pockets), block.pocketed(pockets)
    assert made.moments == pytest.approx(cut.moments, rel=1e-9, abs=1e-9)
    heights = np.linspace(0.1, 8.9, 23)
    for one, other in zip(made.regions_at(heights), cut.regions_at(heights), strict=True):
        assert (one - other).area() + (other - one).area() < 1e-9
    assert made.bounds_mm == pytest.approx(cut.bounds_mm)
    assert made.solid().volume() == pytest.approx(cut.solid().volume())
    assert made.solid().status() == Error.NoError
    assert made == block.pocketed(pockets) != block.pocketed([(2, 3, disc(4, (6, 1))), *pockets[1:]])
