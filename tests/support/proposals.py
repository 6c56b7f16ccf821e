"""Proposals of the Bayesian search with a fifth of the work, for tests of what becomes of them.

The tests of `search/propose` have the whole work.
"""

import pytest

from jumpcad.search.propose import acquisition, initial_designs, surrogate

LESS = {
    (acquisition, "CANDIDATES"): 256,
    (acquisition, "LOCAL"): 32,
    (acquisition, "STARTS"): 2,
    (acquisition, "_STEPS"): 12,
    (surrogate, "_FIT_STEPS"): 8,
    (initial_designs, "SCREENED"): 64,
    (initial_designs, "GENERATIONS"): 2,
}


def with_less_work(patch: pytest.MonkeyPatch) -> None:
    """Draw fewer candidates and improve them, and the processes, with fewer steps."""
    for (module, name), value in LESS.items():
        patch.setattr(module, name, value)
