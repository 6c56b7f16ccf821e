"""What lies inside perimeters, against plane geometry on paper."""

import numpy as np
import pytest
from support.each import each

from jumpcad.printing.cores import Cores, section_moments
from jumpcad.solids.outline import Region, rectangle
from jumpcad.solids.stack import Stack


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
