"""Runs of layers: where cross-sections jump, and which layers are taken together."""

import numpy as np
import pytest

from jumpcad.printing.runs import ALIKE_LAYERS, LayerRun, jumps_of, runs_of
from jumpcad.solids.moments import areas_moments
from jumpcad.solids.outline import rectangle
from jumpcad.workshop import load_workshop

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
