"""Linear algebra in one thread: sums in a fixed order give the same bits however many cores there are."""

from contextlib import AbstractContextManager
from functools import cache
from typing import Any

from threadpoolctl import ThreadpoolController


def one_thread() -> AbstractContextManager[Any]:
    """Return a context in which numpy's and scipy's linear algebra has one thread."""
    context: AbstractContextManager[Any] = _libraries().limit(limits=1)
    return context


@cache
def _libraries() -> ThreadpoolController:
    """Return the linear algebra underneath, which it takes some milliseconds to look for."""
    import scipy.linalg  # noqa: F401  # has libraries of its own

    return ThreadpoolController()
