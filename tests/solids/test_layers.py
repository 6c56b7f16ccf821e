"""The printed mass against arithmetic on paper; against a slicer it is tested in tests/clients."""

import math

import numpy as np
import pytest
from manifold3d import CrossSection, OpType

from jumpcad.solids.blocks import Bar, Blocks, Finger
from jumpcad.solids.layers import _common, line_spacing_mm, mass_properties, sliced
from jumpcad.solids.outline import disc, rectangle, tapered_bar
from jumpcad.solids.stack import Stack
from jumpcad.workshop import load_workshop

PROCESS = load_workshop("default").process.model_copy(
    update={"perimeters": 2, "top_layers": 3, "bottom_layers": 2, "infill": 0.2}
)
BOX = Stack.of([(0, 4, rectangle((40.0, 30.0)))])


def grams(shape, **changes):
    return 1000.0 * mass_properties(shape, 1.0, PROCESS.model_copy(update=changes), 0.4).mass_kg


def test_lines_lie_apart_by_the_area_of_their_cross_section():
    w, h = 0.45, 0.2
    assert line_spacing_mm(w, h) * h == pytest.approx((w - h) * h + math.pi * h**2 / 4.0)


def test_a_box_weighs_what_its_lines_and_infill_add_up_to():
    s = 0.45 - 0.2 * (1.0 - math.pi / 4.0)
    void, shell = (0.45 - s) / 2.0, 2.0 * s + (0.45 - s) / 2.0
    outline, core = 2.0 * (40.0 + 30.0), (40.0 - 2.0 * shell) * (30.0 - 2.0 * shell)
    border = 2.0 * (70.0 - 4.0 * shell)
    walls = 1200.0 - core - void * outline
    solid = core + 0.5 * s * border
    sparse = 0.2 * core + 0.8 * 0.25 * s * border
    bridge = (math.pi * 0.4**2 / 4.0 / (0.45 * 0.2) - 1.0) * core
    volume = 0.2 * (20 * walls + 5 * solid + 15 * sparse + bridge)
    assert grams(BOX) == pytest.approx(volume / 1000.0, rel=1e-6)


def test_what_is_all_solid_weighs_its_volume_within_three_percent():
    for changes in ({"infill": 1.0}, {"top_layers": 50}, {"bottom_layers": 50}):
        assert grams(BOX, **changes) == pytest.approx(4.8, rel=0.03)


def test_more_plastic_weighs_more():
    for key, values in (("infill", (0.0, 0.15, 0.4, 0.8)), ("perimeters", (1, 2, 4)), ("top_layers", (0, 3, 6))):
        masses = [grams(BOX, **{key: value}) for value in values]
        assert masses == sorted(masses)
        assert masses[-1] > 1.05 * masses[0]


def test_a_hollow_part_turns_as_if_its_mass_lay_outside():
    solid = mass_properties(BOX, 1.0, PROCESS, 0.4, "solid")
    printed = mass_properties(BOX, 1.0, PROCESS, 0.4)
    assert solid.mass_kg == pytest.approx(4.8e-3)
    for axis in range(3):
        share = printed.inertia_kg_m2[axis, axis] / printed.mass_kg
        assert share > 1.01 * solid.inertia_kg_m2[axis, axis] / solid.mass_kg


def test_a_step_is_a_top_of_its_own():
    step = Stack.of([(0, 4, rectangle((40.0, 30.0))), (4, 8, rectangle((20.0, 30.0), (10.0, 0.0)))])
    block = Stack.of([(0, 8, rectangle((20.0, 30.0)))])
    low = Stack.of([(0, 4, rectangle((20.0, 30.0)))])
    # cut in two where the step is, the pieces have one wall more each, and the tall piece is as before
    inner_walls = 2.0 * 4.0 * 30.0 * (2.0 * 0.407 + 0.02) * 0.8 / 1000.0
    assert grams(step) == pytest.approx(grams(block) + grams(low) - inner_walls, rel=0.03)


def test_small_sparse_areas_are_filled_when_the_process_says_so():
    peg = Stack.of([(0, 10, disc(10.0))])
    assert grams(peg, solid_below_area_mm2=70.0) == pytest.approx(grams(peg, infill=1.0), rel=0.07)
    assert grams(peg, solid_below_area_mm2=70.0) > 1.3 * grams(peg)


def test_layers_cover_the_part_from_the_bed_up():
    process = PROCESS.model_copy(update={"first_layer_mm": 0.3})
    layers = sliced(BOX.moved(z_mm=1.0), process)
    assert (layers[0].z0_mm, layers[0].z1_mm) == pytest.approx((1.0, 1.3))
    assert layers[-1].z1_mm == pytest.approx(5.0, abs=0.1)
    assert len({layer.section for layer in layers}) == 1


class Turned:
    """A shape turned about z and moved."""

    def __init__(self, shape, angle_deg):
        self.shape, self.angle_deg = shape, angle_deg
        self.bounds_mm = shape.bounds_mm

    def regions_at(self, heights_mm):
        turned = {}
        regions = self.shape.regions_at(heights_mm)
        return [turned.setdefault(r, r.rotate(self.angle_deg).translate((1.234567, -0.7654321))) for r in regions]


def test_a_part_weighs_the_same_however_it_lies_on_the_bed():
    # where sloping sides make every layer another, clipping leaves slivers that must not count as lines
    toe = Finger(np.array([0.0, 8.0]), 7.0, 7.5, np.array([-70.0, 60.0]), 5.0, 4.5)
    shape = Blocks((toe, Bar(tapered_bar((0.0, 5.0), (70.0, 5.0), 10.0, 7.0), ((5.0, 9.0),))))
    masses = [grams(Turned(shape, angle)) for angle in (0.0, 17.0, 33.3, 71.0)]
    assert masses == pytest.approx([masses[0]] * 4, rel=3e-4)


def test_what_rows_of_regions_have_in_common_does_not_depend_on_how_it_is_found():
    regions = [rectangle((10.0, 10.0), (x, y)) for x, y in ((0, 0), (1, 3), (4, 1), (4, 1), (2, 2), (-1, 0), (0, 3))]
    for count in range(1, 8):
        found = _common(regions, count)
        expected = [
            CrossSection.batch_boolean(regions[n : n + count], OpType.Intersect)
            for n in range(len(regions) - count + 1)
        ]
        assert [region.area() for region in found] == pytest.approx([region.area() for region in expected])
        assert len(found) == len(expected)
