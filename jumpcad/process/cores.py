"""Work that several cores share: how many there are, and how lists of work are given to them."""

import os
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

A = TypeVar("A")
T = TypeVar("T")
Shared = Callable[[Callable[[Any], Any], Sequence[Any]], list[Any]]
"""Gives what a function returns for each argument: `one_by_one`, or on several cores."""


def cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def one_by_one(function: Callable[[A], T], arguments: Sequence[A]) -> list[T]:
    """Return what a function returns for each argument."""
    return [function(one) for one in arguments]
