"""What lies inside perimeters, against plane geometry on paper."""

import numpy as np
import pytest
from support.each import each

from jumpcad.printing.layers import ALIKE_LAYERS, Cores, LayerRun, jumps_of, runs_of, section_moments
from jumpcad.solids.moments import areas_moments
from jumpcad.solids.outline import Region, rectangle
from jumpcad.solids.stack import Stack
from jumpcad.workshop import load_workshop


def inside(region: Region, shell_mm: float, spacing_mm: float) -> Region:
    """Return what is inside the perimeters of a plate of one outline."""
    sections = Stack.of([(0.0, 1.0, region)]).sections_at(np.array([0.5]))
    return Cores(sections, [0], shell_mm, spacing_mm).inside[0]


@pytest.mark.parametrize(("width_mm", "core_mm"), [(1.0, 0.0), (1.38, 0.0), (1.42, 0.42), (3.0, 2.0)])
def test_a_wall_has_a_core_as_soon_as_a_line_fits_between_its_perimeters(width_mm: float, core_mm: float) -> None:
    """Perimeters of 0.5 mm in all on either side, lines 0.4 mm apart: less is filled by wider perimeters."""
    core = inside(rectangle((60.0, width_mm)), 0.5, 0.4)
    assert core.area() == pytest.approx(59.0 * core_mm, abs=1e-6)


def test_a_slim_strip_is_kept_where_a_line_fits_somewhere_in_it() -> None:
    """0.2 mm wide but for a square of 1 mm, in which a line of 0.4 mm fits; without the square nothing is left."""
    strip, square = rectangle((101.0, 1.2)), rectangle((2.0, 2.0))
    assert inside(strip, 0.5, 0.4).is_empty()
    assert inside(strip + square, 0.5, 0.4).area() == pytest.approx(99.0 * 0.2 + 1.0, rel=0.01)


def test_a_pocket_has_perimeters_of_its_own() -> None:
    """A plate of 40 mm with a pocket of 10 mm: 1 mm less outside, 1 mm more around it; moments by difference."""
    plate, pocket = rectangle((40.0, 40.0)), rectangle((10.0, 10.0), (3.0, 0.0))
    stack = Stack.of([(0.0, 2.0, plate)]).pocketed([(1.0, 2.0, pocket)])
    sections = stack.sections_at(np.array([0.5, 1.5]))
    first, second = (int(number) for number in sections.which)
    found = Cores(sections, [first, second], 1.0, 0.4).inside
    assert found[first].area() == pytest.approx(38.0**2)
    assert found[second].area() == pytest.approx(38.0**2 - 12.0**2)
    areas, borders = section_moments(sections, sections.contours())
    assert areas[[first, second], 0] == pytest.approx([1600.0, 1500.0])
    assert borders[[first, second], 0] == pytest.approx([160.0, 200.0])
    assert areas[second, 1] == pytest.approx(-100.0 * 3.0)


@each("others", [[1], [2], [3], [1, 2], [2, 3], [1, 2, 3]])
@each("number", [0, 1, 2, 3])
def test_a_core_shares_with_other_layers_what_lies_in_all_of_them(number: int, others: list[int]) -> None:
    """A whole plate of 40 mm, with one pocket, with another one that overlaps it, and a smaller plate on top."""
    plate, small = rectangle((40.0, 40.0)), rectangle((20.0, 60.0), (6.0, 0.0)) ^ rectangle((40.0, 40.0))
    stack = Stack.of([(0.0, 3.0, plate), (3.0, 4.0, small)])
    first, second = rectangle((10.0, 12.0), (3.0, 0.0)), rectangle((14.0, 10.0), (8.0, 5.0))
    stack = stack.pocketed([(1.0, 2.0, first), (2.0, 3.0, second)])
    heights = np.array([0.5, 1.5, 2.5, 3.5])
    sections, layers = stack.sections_at(heights), stack.regions_at(heights)
    which = [int(one) for one in sections.which]
    cores = Cores(sections, [which[number]], 1.0, 0.4)
    expected = core = cores.inside[which[number]]
    for other in others:
        expected = expected ^ layers[other]
    rest, found = cores.divided(which[number], [which[other] for other in others])
    assert ((found - expected) + (expected - found)).area() < 1e-6
    assert rest.area() == pytest.approx(core.area() - found.area())
    assert found.area() > 0.0


PROCESS = load_workshop("default").process.model_copy(update={"top_layers": 3, "bottom_layers": 2})


def disc_moments(radii_mm):
    """Return the area moments (n, 6) of discs about the origin: π r², and π r⁴ / 4 about either axis."""
    r = np.asarray(radii_mm, dtype=float)
    zero = np.zeros_like(r)
    return np.pi * np.stack([r**2, zero, zero, r**4 / 4.0, r**4 / 4.0, zero], axis=-1)


def cut(area, jumps):
    runs = runs_of(area, jumps, PROCESS)
    assert [run.first for run in runs[1:]] == [run.end for run in runs[:-1]]
    assert (runs[0].first, runs[-1].end) == (0, len(area))
    return runs


def test_a_cylinder_is_bottom_middle_and_top():
    area = disc_moments([5.0] * 20)
    assert jumps_of(np.zeros(20, dtype=np.int64), area[:, 0]) == []
    assert cut(area, []) == [LayerRun(0, 2), LayerRun(2, 17), LayerRun(17, 20)]


def test_a_shoulder_is_a_jump_with_a_top_below_and_a_bottom_above():
    area = disc_moments([8.0] * 12 + [5.0] * 12)
    jumps = jumps_of(np.repeat([0, 1], 12), area[:, 0])
    assert jumps == [12]
    assert [run.first for run in cut(area, jumps)] == [0, 2, 9, 12, 14, 21]


def test_a_cone_has_no_jumps_and_short_odd_runs():
    area = disc_moments(np.linspace(9.0, 3.0, 40))
    assert jumps_of(np.arange(40), area[:, 0]) == []
    inner = [run for run in cut(area, []) if run.first >= 2 and run.end <= 37]
    assert inner
    assert all((run.end - run.first) % 2 == 1 and run.end - run.first <= min(ALIKE_LAYERS, 3) for run in inner)


@pytest.mark.parametrize(("top_layers", "most"), [(0, 1), (1, 1), (2, 1), (3, 3), (4, 3), (5, 5), (9, 5)])
def test_runs_of_what_changes_are_odd_and_no_longer_than_a_top_nor_than_five_layers(top_layers, most):
    area = disc_moments(np.linspace(9.0, 8.0, 60))
    runs = runs_of(area, [], PROCESS.model_copy(update={"top_layers": top_layers}))
    inner = [run.end - run.first for run in runs if run.first >= 2 and run.end < 60 - top_layers]
    assert max(inner) == most
    assert all(length % 2 for length in inner)


def test_layers_that_are_equal_are_one_run_beside_those_that_change():
    """Of 30 equal layers under a cone only those that it makes tops are apart from the others, and the bottom."""
    area = disc_moments(np.concatenate([np.full(30, 9.0), np.linspace(9.0, 3.0, 11)[1:]]))
    runs = cut(area, [])
    (long,) = (run for run in runs if run.end - run.first > ALIKE_LAYERS)
    assert long.first == PROCESS.bottom_layers
    assert 30 - PROCESS.top_layers - 1 <= long.end <= 30


def test_a_gap_between_layers_has_a_top_below_and_a_bottom_above():
    area = disc_moments([5.0] * 10 + [0.0] * 3 + [5.0] * 10)
    jumps = jumps_of(np.repeat([0, 1, 0], [10, 3, 10]), area[:, 0])
    assert jumps == [10, 13]
    assert [run.first for run in cut(area, jumps)] == [0, 2, 7, 10, 12, 13, 15, 20]
    over_it = disc_moments([5.0] * 10 + [0.0] * 3 + [9.0 - 0.3 * n for n in range(20)])
    assert all(run.end - run.first <= PROCESS.top_layers for run in cut(over_it, jumps) if 15 <= run.first < 30)


def test_a_cone_that_ends_in_a_plate_jumps_there():
    radii = np.concatenate([np.linspace(9.0, 8.0, 20), np.full(10, 14.0)])
    which = np.concatenate([np.arange(20), np.full(10, 20)])
    assert jumps_of(which, disc_moments(radii)[:, 0]) == [20]


def test_the_middle_of_an_odd_run_is_its_middle():
    assert LayerRun(4, 9).middle == 6
    assert LayerRun(7, 8).middle == 7


@pytest.mark.parametrize("slope", [0.4, 3.0])
def test_runs_do_not_depend_on_where_a_part_lies(slope):
    """What makes layers alike are areas and polar moments about their own centres, wherever these are."""
    taper = np.linspace(1.0, 1.0 + slope, 40) ** 2

    def runs_at(x, y, shift):
        moved = [rectangle((20.0 * side, 10.0), (x + shift * n, y)) for n, side in enumerate(taper)]
        return runs_of(areas_moments(moved), [], PROCESS)

    assert runs_at(0.0, 0.0, 0.0) == runs_at(300.0, -150.0, 0.0) == runs_at(40.0, 20.0, 0.7)
