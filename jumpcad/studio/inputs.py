"""Inputs of the page: what happens when a person changes one, and not when the program does."""

from collections.abc import Callable
from typing import Any


def when_changed(handle: Any, act: Callable[[], object]) -> None:
    """Call a function whenever an input of viser is changed in a browser."""

    def changed(event: Any) -> None:
        if event.client is not None:
            act()

    handle.on_update(changed)
