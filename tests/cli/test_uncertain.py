"""`jumpcad simulate --uncertain`: what is asked of the simulation, and its answer in lines of text."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any

import pytest

from jumpcad.cli import uncertain as module
from jumpcad.cli.uncertain import uncertain


def test_uncertain_inputs_are_drawn_by_the_seed_and_simulated_as_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Plain data come back; meanwhile it says what it does."""
    asked: list[Any] = []
    found = SimpleNamespace(to_dict=lambda: {"jumps": 8})

    @contextmanager
    def status(doing: str) -> Iterator[None]:
        asked.append(doing)
        yield
        asked.append("done")

    monkeypatch.setattr(module, "status", status)
    monkeypatch.setattr("jumpcad.simulation.uncertain_jump", lambda *given: asked.append(given) or found)
    assert uncertain("robot", "settings", "planar", 7) == {"jumps": 8}  # type: ignore[arg-type]
    assert asked == ["simulating samples of the uncertain inputs …", ("robot", "settings", "planar", 7), "done"]
