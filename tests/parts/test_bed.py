"""How parts lie on the bed: parallel to it or turned, against the diagonal's geometry."""

import math

import numpy as np
import pytest

from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError
from jumpcad.parts.part import fit_to_bed, require_bed

BED = (180.0, 120.0, 100.0)


def fit(x, y, z=10.0, bed=BED):
    corners = np.array([[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]])
    return fit_to_bed(np.array([[0.0, 0.0, 0.0], [x, y, z]]), lambda: corners, bed)


def test_a_part_lies_along_the_bed_with_the_least_side_left_as_margin():
    assert fit(150.0, 100.0).angle_deg == 0.0
    assert fit(150.0, 100.0).margin_mm == pytest.approx(20.0)
    assert fit(100.0, 150.0).angle_deg == 90.0
    assert fit(100.0, 100.0, 95.0).margin_mm == pytest.approx(5.0)


def test_a_slanting_bar_is_turned_to_the_diagonal():
    """A bar at -30° and as long as the diagonal but 2 mm fits at a turn of 30° and the diagonal's own angle."""
    end = 214.0 * np.array([math.cos(math.radians(30.0)), -math.sin(math.radians(30.0))])
    bounds = np.array([[0.0, end[1], 0.0], [end[0], 0.0, 5.0]])
    askew = fit_to_bed(bounds, lambda: np.array([[0.0, 0.0], end]), BED)
    assert askew.margin_mm >= 0.0
    assert askew.angle_deg == pytest.approx(30.0 + math.degrees(math.atan2(BED[1], BED[0])), abs=1.0)


def test_a_part_of_the_beds_size_fits():
    assert fit(*BED).margin_mm == pytest.approx(0.0)


def test_a_part_too_tall_or_too_long_is_refused_with_its_size():
    for size in ((50.0, 50.0, 101.0), (260.0, 20.0, 10.0)):
        bounds = np.array([np.zeros(3), size])
        with pytest.raises(CannotBuildError, match=rf"part leg of {size[0]:.1f}×.*180\.0×120\.0×100\.0 mm") as refused:
            require_bed("leg", bounds, lambda: bounds[:, :2], BED)  # noqa: B023
        assert refused.value.margin == pytest.approx(fit_to_bed(bounds, lambda: bounds[:, :2], BED).margin_mm)  # noqa: B023
        assert refused.value.margin < 0.0


@pytest.mark.parametrize(("long", "turn_deg"), [(230.0, 0.0), (230.0, 90.0), (222.0, 20.0), (260.0, 70.0)])
def test_what_does_not_fit_misses_by_as_little_as_at_its_best_angle(long, turn_deg):
    """Tried at every hundredth of a degree: whole degrees are near enough for a quarter of a millimetre."""
    turn = math.radians(turn_deg)
    ends = np.outer([0.0, long], [math.cos(turn), math.sin(turn)])
    bounds = np.array([[*ends.min(axis=0), 0.0], [*ends.max(axis=0), 5.0]])
    angles = turn + np.radians(np.arange(0.0, 180.0, 0.01))
    sides = long * np.abs([np.cos(angles), np.sin(angles)])
    best = (np.array(BED[:2])[:, None] - sides).min(axis=0).max()
    found = fit_to_bed(bounds, lambda: ends, BED)
    assert best - 2.0 < found.margin_mm <= best + 1e-6
    assert found.margin_mm < 0.0
    at = turn + math.radians(found.angle_deg)
    size = long * abs(math.cos(at)), long * abs(math.sin(at))
    assert found.margin_mm == pytest.approx(min(BED[0] - size[0], BED[1] - size[1]))


@pytest.mark.parametrize("long", ["main_leg", "front_link", "foot", "toe_left", "body_plate_right"])
def test_what_is_advised_makes_the_part_smaller_or_the_rest_of_it_no_larger(long: str) -> None:
    """The lengths of a design that are named, alone, shorten the part."""
    corners = np.array([[0.0, 0.0], [400.0, 0.0], [400.0, 5.0], [0.0, 5.0]])
    with pytest.raises(CannotBuildError) as refused:
        require_bed(long, np.array([[0.0, 0.0, 0.0], [400.0, 5.0, 5.0]]), lambda: corners, BED)
    advice = str(refused.value).rpartition(": ")[2]
    base = load_design("best-printable")
    for name in ("carrying_link_mm", "c_coef", "d_coef", "e_coef"):
        other = base.model_copy(update={name: 0.95 * getattr(base, name)})
        shorter = {
            "main_leg": other.l2_mm < base.l2_mm,
            "front_link": other.l3_mm < base.l3_mm,
            "foot": min(other.l4_mm - base.l4_mm, other.l5_mm - base.l5_mm) < 0.0,
            "toe_left": other.l5_mm < base.l5_mm,
            "body_plate_right": other.l1_mm < base.l1_mm and name != "c_coef",  # which turns the body too
        }
        assert (name in advice) == shorter[long], name


@pytest.mark.parametrize("part", ["body_plate_left", "electronics_tray_lower", "stop_bar"])
def test_parts_of_the_body_are_smaller_in_a_smaller_body_or_with_smaller_electronics(part: str) -> None:
    bounds = np.array([[0.0, 0.0, 0.0], [400.0, 5.0, 5.0]])
    with pytest.raises(CannotBuildError, match=r"or d_coef, or choose a smaller battery or boards$"):
        require_bed(part, bounds, lambda: bounds[:, :2], BED)
