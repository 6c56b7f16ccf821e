"""Linear algebra in one thread: sums in a fixed order give the same bits however many cores there are."""

from contextlib import AbstractContextManager
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""Environment of commands and of workers: small matrices gain nothing by threads, which wait for work at full speed."""


def one_thread() -> AbstractContextManager[Any]:
    """Return a context in which numpy's and scipy's linear algebra has one thread."""
    context: AbstractContextManager[Any] = _libraries().limit(limits=1)
    return context


@cache
def _libraries() -> "ThreadpoolController":
    """Return the linear algebra underneath, which it takes some milliseconds to look for."""
    import scipy.linalg  # noqa: F401  # has libraries of its own
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
