"""The printed mass against arithmetic on paper; against a slicer it is tested in tests/clients."""

import math

import numpy as np
import pytest
from support.each import each

from jumpcad.printing import layers
from jumpcad.printing.layer_mass import line_spacing_mm, mass_properties, printed_moments, sliced
from jumpcad.solids.blocks import Bar, Blocks, Finger
from jumpcad.solids.outline import disc, rectangle, tapered_bar
from jumpcad.solids.slab import CrossSections
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


@pytest.mark.parametrize("height", [0.2, 0.28, 0.32])
@pytest.mark.parametrize("infill", [0.2, 1.0])
def test_a_box_weighs_what_its_lines_and_infill_add_up_to(infill, height):
    """Threads bridge sparse layers, with which a box that is filled has nothing to do.

    Round ones of 0.4 mm, 0.45 mm apart, are more plastic than a layer of up to 0.279 mm, and less than a thicker one.
    """
    s = 0.45 - height * (1.0 - math.pi / 4.0)
    void, shell = (0.45 - s) / 2.0, 2.0 * s + (0.45 - s) / 2.0
    outline, core = 2.0 * (40.0 + 30.0), (40.0 - 2.0 * shell) * (30.0 - 2.0 * shell)
    border = 2.0 * (70.0 - 4.0 * shell)
    walls = 1200.0 - core - void * outline
    solid = core + 0.5 * s * border
    sparse = infill * core + (1.0 - infill) * 0.25 * s * border
    bridge = (infill < 1.0) * (math.pi * 0.4**2 / 4.0 / (0.45 * height) - 1.0) * core
    volume = height * (20 * walls + 5 * solid + 15 * sparse + bridge)
    box = Stack.of([(0, 20 * height, rectangle((40.0, 30.0)))])
    found = grams(box, infill=infill, layer_height_mm=height, first_layer_mm=height)
    assert found == pytest.approx(volume / 1000.0, rel=1e-6)


def test_a_thicker_first_layer_is_more_of_the_same_lines():
    """0.3 mm high, the others 0.2 mm, which lines' distance is reckoned by: a solid layer weighs half as much more."""
    thicker = Stack.of([(0, 4.1, rectangle((40.0, 30.0)))])
    first_g = grams(thicker, first_layer_mm=0.3) - grams(BOX)
    solid_g = grams(BOX, bottom_layers=3) - grams(BOX, bottom_layers=2)  # less one of infill
    sparse_g = grams(Stack.of([(0, 4.2, rectangle((40.0, 30.0)))])) - grams(BOX)
    assert first_g == pytest.approx(0.5 * (solid_g + sparse_g), rel=1e-6)


def test_blocks_that_share_no_place_have_tops_and_bottoms_of_their_own():
    """One beside the other and higher: nothing of either is above or below the other."""
    beside = Stack.of([(0, 4, rectangle((40.0, 30.0))), (4, 8, rectangle((40.0, 30.0), (100.0, 0.0)))])
    assert grams(beside) == pytest.approx(2.0 * grams(BOX), rel=1e-6)
    assert grams(beside, solid_below_area_mm2=0.0) == pytest.approx(
        2.0 * grams(BOX, solid_below_area_mm2=0.0), rel=1e-6
    )


def test_a_piece_that_is_filled_for_being_small_leaves_the_others_as_they_are():
    """A post of 5 mm beside a block: below 30 mm² inside its perimeters is solid, which the block is not."""
    post, far = rectangle((5.0, 5.0)), rectangle((5.0, 5.0), (100.0, 0.0))
    beside = Stack.of([(0, 4, rectangle((40.0, 30.0)) + far)])
    solid = grams(Stack.of([(0, 4, post)]), bottom_layers=50)
    assert solid > 1.05 * grams(Stack.of([(0, 4, post)]))
    found = grams(beside, solid_below_area_mm2=30.0)
    assert found == pytest.approx(grams(BOX) + solid, rel=1e-6)


def test_what_is_all_solid_weighs_its_volume_within_three_percent():
    for changes in ({"infill": 1.0}, {"top_layers": 50}, {"bottom_layers": 50}):
        assert grams(BOX, **changes) == pytest.approx(4.8, rel=0.03)


def test_more_plastic_weighs_more():
    for key, values in (("infill", (0.0, 0.15, 0.4, 0.8)), ("perimeters", (1, 2, 4)), ("top_layers", (0, 3, 6))):
        masses = [grams(BOX, **{key: value}) for value in values]
        assert masses == sorted(masses)
        assert masses[-1] > 1.05 * masses[0]


def test_a_wider_nozzle_bridges_with_a_thicker_thread():
    """Round ones, 0.05 mm apart, in the first layer over the infill: π·d²/4 over their distance and the layer."""
    s = 0.45 - 0.2 * (1.0 - math.pi / 4.0)
    shell = 2.0 * s + (0.45 - s) / 2.0
    core = (40.0 - 2.0 * shell) * (30.0 - 2.0 * shell)
    thin, thick = (1000.0 * mass_properties(BOX, 1.0, PROCESS, nozzle).mass_kg for nozzle in (0.4, 0.5))
    more = math.pi / 4.0 * (0.5**2 / 0.55 - 0.4**2 / 0.45) * core
    assert thick - thin == pytest.approx(more / 1000.0, rel=1e-6)


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
    levels, sections = sliced(Stack.of([(1, 5, rectangle((40.0, 30.0)))]), process)
    assert levels[:2] == pytest.approx([1.0, 1.3])
    assert np.diff(levels)[1:] == pytest.approx(process.layer_height_mm)
    assert levels[-1] == pytest.approx(5.0, abs=0.1)
    assert len(levels) == len(sections.which) + 1
    assert set(sections.which.tolist()) == {0}


@pytest.mark.parametrize(
    ("top_mm", "layers"), [(0.05, 1), (0.28, 1), (0.32, 2), (0.88, 4), (0.92, 5), (1.08, 5), (1.12, 6)]
)
def test_a_layer_is_printed_where_its_middle_lies_in_the_part(top_mm: float, layers: int) -> None:
    """Of 0.2 mm, as slicers take it: the fifth from 0.8 to 1.0 mm in a part that is higher than 0.9. One in any."""
    levels, _ = sliced(Stack.of([(0.0, top_mm, rectangle((10.0, 10.0)))]), PROCESS)
    assert len(levels) == layers + 1


def test_parts_of_the_same_layers_are_weighed_once():
    one, same, other = (Stack.of([(0, top, disc(wide))]) for top, wide in ((4.0, 12.0), (4.05, 12.0), (4.0, 12.1)))
    assert printed_moments(one, PROCESS, 0.4) is printed_moments(same, PROCESS, 0.4)
    assert grams(other) > grams(one)
    assert grams(one, infill=1.0) > grams(one)


class Turned:
    """A shape turned about z and moved."""

    def __init__(self, shape, angle_deg):
        self.shape, self.angle_deg = shape, angle_deg
        self.bounds_mm = shape.bounds_mm

    def sections_at(self, heights_mm):
        outlines, which, inset_mm, _ = self.shape.sections_at(heights_mm)
        turned = [outline.rotate(self.angle_deg).translate((1.234567, -0.7654321)) for outline in outlines]
        return CrossSections(turned, which, inset_mm)


def test_a_part_weighs_the_same_however_it_lies_on_the_bed():
    # where sloping sides make every layer another, clipping leaves slivers that must not count as lines
    toe = Finger(np.array([0.0, 8.0]), 7.0, 7.5, np.array([-70.0, 60.0]), 5.0, 4.5)
    shape = Blocks((toe, Bar(tapered_bar((0.0, 5.0), (70.0, 5.0), 10.0, 7.0), ((5.0, 9.0),))))
    masses = [grams(Turned(shape, angle)) for angle in (0.0, 17.0, 33.3, 71.0)]
    assert masses == pytest.approx([masses[0]] * 4, rel=3e-4)


@pytest.mark.parametrize("top_layers", [2, 5])
@pytest.mark.parametrize("slope_mm", [0.3, 3.0, 9.0])
def test_layers_that_change_little_by_little_are_as_if_each_were_taken_by_itself(slope_mm, top_layers, monkeypatch):
    process = PROCESS.model_copy(update={"top_layers": top_layers, "layer_height_mm": 0.1})
    toe = Finger(np.array([0.0, 8.0]), 7.0, 9.5, np.array([-70.0, 60.0]), 5.0, 9.5 - slope_mm)
    rail = tapered_bar((0.0, 5.0), (70.0, 4.0), 10.0, 7.0) - disc(3.2, (0.0, 5.0))
    shape = Blocks((toe, Bar(rail, ((5.0, 9.0),))))
    together = mass_properties(shape, 1.0, process, 0.4)
    monkeypatch.setattr(layers, "ALIKE_LAYERS", 1)
    apart = mass_properties(Turned(shape, 0.0), 1.0, process, 0.4)
    assert together.mass_kg == pytest.approx(apart.mass_kg, rel=6e-3)
    assert np.diag(together.inertia_kg_m2) == pytest.approx(np.diag(apart.inertia_kg_m2), rel=1e-2)


def test_a_chamfer_weighs_as_much_as_slabs_that_are_narrower():
    outline = tapered_bar((0.0, 0.0), (60.0, 0.0), 14.0, 9.0) - disc(5.0)
    slabs = Stack.of([(0, 5, outline)]).chamfered(0.35, 0.2).slabs
    chamfered, stepped = Stack(slabs), Stack.of([(slab.z0_mm, slab.z1_mm, slab.region) for slab in slabs])
    assert grams(chamfered) == pytest.approx(grams(stepped), rel=1e-3)
    assert grams(chamfered) < grams(Stack.of([(0, 5, outline)]))


def test_a_cavity_of_one_layer_makes_the_layers_around_it_solid():
    wide, hollow = rectangle((40.0, 30.0)), rectangle((40.0, 30.0)) - disc(16.0)
    cavity = Stack.of([(0, 4, wide), (4, 4.2, hollow), (4.2, 8.2, wide)])
    s, r, shell = 0.45 - 0.2 * (1.0 - math.pi / 4.0), 8.0, 2.0 * 0.407 + 0.0215
    area, border = math.pi * r**2, 2.0 * math.pi * r
    # three layers below it and two above are solid there instead of sparse, the lowest of them is bridged
    solid = 5.0 * (0.8 * area + s * border * (0.5 + 0.8 * 0.25)) + (math.pi * 0.4**2 / 4.0 / 0.09 - 1.0) * area
    walls = 0.8 * math.pi * ((r + shell) ** 2 - r**2) - 0.0215 * border + 0.8 * 0.25 * s * 2.0 * math.pi * (r + shell)
    more = 0.2 * (solid + walls - 0.2 * area)
    assert grams(cavity) - grams(Stack.of([(0, 8.2, wide)])) == pytest.approx(more / 1000.0, rel=0.01)


def test_pockets_in_one_outline_weigh_what_outlines_of_their_own_do():
    block = Stack.of([(0, 6, rectangle((40, 30), corner_radius_mm=4)), (6, 8, disc(12))])
    pockets = [(2 + 0.2 * n, 2.2 + 0.2 * n, disc(12 - 0.3 * n, (9, 3)) - disc(5, (9, 3))) for n in range(20)]
    shapes = block.pocketed(pockets), block.minus(pockets)
    kept, cut = (mass_properties(shape.chamfered(0.4, 0.2), 1.24, PROCESS, 0.4) for shape in shapes)
    assert kept.mass_kg == pytest.approx(cut.mass_kg, rel=1e-9)
    assert kept.com_m == pytest.approx(cut.com_m, rel=1e-7)
    assert kept.inertia_kg_m2 == pytest.approx(cut.inertia_kg_m2, rel=1e-7, abs=1e-15)


@each("bottom", [0, 1, 2])
@each(("nozzle", "height", "deep"), [(0.4, 0.2, 2), (0.5, 0.2, 2), (0.6, 0.2, 3), (0.4, 0.28, 1), (0.4, 0.32, 1)])
def test_threads_bridge_only_what_is_as_deep_as_they_are_thick(nozzle, height, deep, bottom):
    """A nozzle of 0.4 mm lays round threads over two sparse layers of 0.2 mm; over one it lays flat lines.

    Its layers are counted whole: three of 0.2 mm for 0.6 mm, one of 0.28 mm for 0.4 mm.
    """
    s = 0.45 - height * (1.0 - math.pi / 4.0)
    void, shell = (0.45 - s) / 2.0, 2.0 * s + (0.45 - s) / 2.0
    core, border = (40.0 - 2.0 * shell) * (30.0 - 2.0 * shell), 2.0 * (70.0 - 4.0 * shell)
    walls = 1200.0 - core - void * 140.0
    solid, sparse = core + 0.5 * s * border, 0.2 * core + 0.8 * 0.25 * s * border
    changes = {"bottom_layers": bottom, "layer_height_mm": height, "first_layer_mm": height}
    for sparse_layers in range(1, 5):
        bridge = (sparse_layers >= deep) * (math.pi * nozzle**2 / 4.0 / ((nozzle + 0.05) * height) - 1.0) * core
        layers = bottom + 3 + sparse_layers
        volume = height * (layers * walls + (bottom + 3) * solid + sparse_layers * sparse + bridge)
        plate = Stack.of([(0, height * layers, rectangle((40.0, 30.0)))])
        found = mass_properties(plate, 1.0, PROCESS.model_copy(update=changes), nozzle).mass_kg
        assert found == pytest.approx(volume / 1e6, rel=1e-6)
