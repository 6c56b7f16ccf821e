"""The proposal: active bounds, choices, refusals."""

import math

import numpy as np
import pytest
from support.hills import FIXED, SMALL

from jumpcad.search.propose.acquisition import Proposal, propose
from jumpcad.search.propose.posterior import SearchPosterior
from jumpcad.search.propose.surrogate import Surrogate
from jumpcad.search.space import Space

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


class Known:
    """A posterior whose logarithms fall with the square of the distance from points of two coordinates."""

    def log_improvement(self, points, best):
        return -10.0 * (points[:, 0] - 0.37) ** 2 - best

    def log_feasible(self, points):
        return -5.0 * (points[:, 2] - 0.71) ** 2


def ask(best=0.0, **others):
    return propose(SMALL, Known(), best, np.empty((0, 3)), lambda variant: True, np.random.default_rng(1), **others)


def test_the_top_of_improvement_and_feasibility_together_is_proposed_with_both():
    """Coordinates have four digits, and the design is that of them."""
    found = ask(2.5)
    assert found.unit[[0, 2]] == pytest.approx([0.37, 0.71], abs=1e-3)
    assert found.unit.tolist() == found.unit.round(4).tolist()
    assert found.variant == SMALL.to_variant(found.unit)
    assert found.log_improvement == pytest.approx(-10.0 * (found.unit[0] - 0.37) ** 2 - 2.5)
    assert found.log_feasible == pytest.approx(-5.0 * (found.unit[2] - 0.71) ** 2)
    assert found.log_value == found.log_improvement + found.log_feasible


@pytest.mark.parametrize(("less", "taken"), [(0.15, True), (0.25, False)])
def test_what_held_in_a_dry_run_is_proposed_where_another_promises_little_more(less, taken):
    """A fifth, in logarithms."""
    known = np.array([0.37 + np.sqrt(less / 10.0), 0.5, 0.71])
    assert (ask(held=[known]).unit.tolist() == known.tolist()) == taken


def test_a_promise_is_twice_the_gain_of_the_root_as_a_share_of_the_best():
    """A gain of the root by 0.1 of a score of 4 is one by 0.4: a tenth of it. Of no best score it is infinite."""
    found = Proposal(SMALL.to_variant([0.5] * 3), np.full(3, 0.5), math.log(0.4), math.log(0.25))
    assert found.promised_gain(4.0) == pytest.approx(0.1)
    assert found.promised_gain(0.0) == found.promised_gain(-1.0) == math.inf
    assert math.isfinite(Proposal(found.variant, found.unit, 1e9, 0.0).promised_gain(1.0))
