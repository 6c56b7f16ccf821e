"""The proposal: active bounds, choices, refusals."""

import numpy as np
import pytest
from support.hills import FIXED, SMALL

from jumpcad.search.acquisition import _apart, propose
from jumpcad.search.posterior import SearchPosterior
from jumpcad.search.space import Space
from jumpcad.search.surrogate import Surrogate
from jumpcad.workshop import load_workshop

STIFFNESS = "stiffness_nmm_per_deg"


def fitted_to(function, count=40):
    """Return the posterior of a function (n, 3) to (n,) of the unit cube."""
    x = SMALL.spread(count, np.random.default_rng(0))
    return SearchPosterior(Surrogate(x, function(x)), {})


def test_bounds_become_active_where_the_top_is_beyond_them():
    proposal = propose(
        SMALL,
        fitted_to(lambda x: x[:, 0] - x[:, 2]),
        4.0,
        np.empty((0, 3)),
        lambda variant: True,
        np.random.default_rng(1),
    )
    assert proposal.unit[[0, 2]].tolist() == [1.0, 0.0]
    assert proposal.variant.design.compression_ratio == SMALL.free[0].upper


def test_choices_and_refusals_are_respected():
    space = Space.parse(fix=FIXED, choose=["stiffness_nmm_per_deg=8,19,30"])
    posterior = fitted_to(lambda x: -((x - 0.4) ** 2).sum(axis=1))
    proposal = propose(space, posterior, 0.0, np.empty((0, 3)), lambda variant: True, np.random.default_rng(1))
    assert proposal.variant.design.stiffness_nmm_per_deg == 19.0
    other = propose(
        space, posterior, 0.0, np.empty((0, 3)), lambda v: v.value(STIFFNESS) != 19.0, np.random.default_rng(1)
    )
    assert other.variant.design.stiffness_nmm_per_deg == 8.0
    assert propose(space, posterior, 0.0, np.empty((0, 3)), lambda d: False, np.random.default_rng(1)) is None


def test_climbs_begin_at_points_that_are_apart_the_best_first():
    """By more than a twentieth along some axis; as many as asked for."""
    points = np.array([[0.5, 0.5], [0.54, 0.46], [0.5, 0.56], [0.9, 0.9], [0.86, 0.94], [0.1, 0.5]])
    assert _apart(points, np.arange(6), 6) == [0, 2, 3, 5]
    assert _apart(points, np.arange(6)[::-1], 2) == [5, 4]


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_what_is_punished_is_not_proposed(side):
    """The top of the surrogate at 0.5 is forbidden on one side of 0.4 or 0.6: the nearest place beside that is best."""
    posterior = fitted_to(lambda x: -((x - 0.5) ** 2).sum(axis=1))

    def penalty(points):
        return 1e4 * np.maximum(0.1 - side * (points[:, 0] - 0.5), 0.0) ** 2

    plain, away = (
        propose(SMALL, posterior, 0.0, np.empty((0, 3)), lambda variant: True, np.random.default_rng(1), one)
        for one in (None, penalty)
    )
    assert plain.unit == pytest.approx(np.full(3, 0.5), abs=0.03)
    assert away.unit[0] == pytest.approx(0.5 + 0.1 * side, abs=0.03)


def test_names_near_a_good_design_are_mostly_its_own():
    """Of 128 points near each, names are drawn again three times in ten, and then half of them are the same of two."""
    asked = []

    class Flat:
        def log_improvement(self, points, best):
            asked.append(points)
            return np.zeros(len(points))

        def log_feasible(self, points):
            return np.zeros(len(points))

    choice = "bought.battery=lipo-2s-180,lipo-1s-300"
    space = Space.parse(fix=FIXED, choose=[choice], workshop=load_workshop())
    elite = np.array([[0.5, 0.5, 0.5, 0.0], [0.5, 0.5, 0.5, 1.0]])
    propose(space, Flat(), 1.0, elite, lambda variant: True, np.random.default_rng(0))
    near = asked[0][-2 * 128 :].reshape(2, 128, 4)
    for points, own in zip(near, elite, strict=True):
        assert 0.75 < (points[:, 3] == own[3]).mean() < 0.95
        off = np.abs(points[:, :3] - own[:3])
        assert 0.001 < np.median(off) < 0.1
