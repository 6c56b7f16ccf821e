"""Sliders: how far they reach, and in which steps."""

from types import SimpleNamespace
from typing import Any

from jumpcad.studio.inputs import when_changed


def test_only_a_person_s_changes_are_acted_on() -> None:
    acts: list[Any] = []
    seen: list[int] = []
    when_changed(SimpleNamespace(on_update=acts.append), lambda: seen.append(1))
    (changed,) = acts
    changed(SimpleNamespace(client=None))
    assert seen == []
    changed(SimpleNamespace(client="a browser"))
    assert seen == [1]
