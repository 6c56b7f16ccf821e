"""Compiled where numba is installed, plain Python elsewhere: the same statements, and so the same numbers."""

from collections.abc import Callable
from contextlib import suppress
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Return a function compiled to machine code, kept on disk for the next process, or as it is without numba.

    Where no folder can be written (containers, system installs) every process compiles anew, for some seconds.
    Numba notices a change in the file of a function, not one in the files of what that function calls: everything that
    is compiled stands in one module.
    """
    try:
        from numba import njit
    except ImportError:
        return function
    try:
        made = njit(cache=True, error_model="numpy")(function)
    except RuntimeError:  # numba's "cannot cache function: no locator available"
        return cast(Function, njit(error_model="numpy")(function))
    if cache := getattr(made, "_cache", None):  # none where compiling is switched off
        save = cache.save_overload

        def save_if_possible(*given: Any) -> None:
            with suppress(OSError):  # a full disk, or a quota: the next process compiles anew
                save(*given)

        cache.save_overload = save_if_possible
    return cast(Function, made)
