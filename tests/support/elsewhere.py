"""The environment of a process that stands for another machine."""

import os

ELSEWHERE = {"PYTHONHASHSEED": "11", "TZ": "Asia/Tokyo", "OPENBLAS_CORETYPE": "Prescott", "OPENBLAS_NUM_THREADS": "2"}
"""Another hash seed and time zone, and the linear algebra of a processor from 2004, in two threads."""


def environment(**more: str) -> dict[str, str]:
    """Return the variables of such a process, with some more of them."""
    return {**os.environ, **ELSEWHERE, **more}
