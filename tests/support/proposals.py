"""Proposals of a search and its winner's landings with less work, for tests of what becomes of them.

The tests of `search/propose` have the whole work.
"""

import pytest

from jumpcad.search.propose import acquisition, initial_designs, surrogate
from jumpcad.search.study import summary

LESS = {
    (acquisition, "CANDIDATES"): 256,
    (acquisition, "LOCAL"): 32,
    (acquisition, "STARTS"): 2,
    (acquisition, "_STEPS"): 12,
    (surrogate, "_FIT_STEPS"): 8,
    (initial_designs, "SCREENED"): 64,
    (initial_designs, "GENERATIONS"): 2,
    (summary, "TRIES"): 2,
}


def with_less_work(patch: pytest.MonkeyPatch) -> None:
    """Draw fewer candidates, improve them and the processes with fewer steps, and let a winner land less often."""
    for (module, name), value in LESS.items():
        patch.setattr(module, name, value)
