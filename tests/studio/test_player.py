"""The player's controls, on a stage and a server that only write down what they are asked."""

import threading
from contextlib import nullcontext
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from jumpcad.studio import player
from jumpcad.studio.player import PAUSE, PLAY, Player

END_S = 4.0


class Clock:
    """A clock that only sleeping moves; sleeping takes a tenth longer than it is asked for."""

    def __init__(self) -> None:
        self.now_s = 100.0

    def monotonic(self) -> float:
        return self.now_s

    def sleep(self, time_s: float) -> None:
        self.now_s += 1.1 * time_s


@pytest.fixture
def stage() -> Any:
    found = SimpleNamespace(lock=threading.RLock(), moved=[], paths=[])
    found.move, found.show_path = found.moved.append, found.paths.append
    return found


@pytest.fixture
def made(stage: Any, monkeypatch: pytest.MonkeyPatch) -> Player:
    """A player of a motion of four seconds, each of whose moments is its time."""

    def control(*given: Any, **_: Any) -> Any:
        made = SimpleNamespace(label=given[0], value=given[-1], acts=[])
        made.on_click = made.on_update = made.acts.append
        return made

    gui = SimpleNamespace(
        add_button=control, add_slider=control, add_markdown=lambda text: SimpleNamespace(content=text)
    )
    motion: Any = SimpleNamespace(
        end_s=END_S, com_m=np.zeros((2, 3)),
        at=lambda shown_s: SimpleNamespace(shown_s=shown_s, to_text=lambda slower: f"{shown_s:g} s, {slower:g} times"),
    )  # fmt: skip
    started: list[Any] = []

    def thread(target: Any, args: Any, daemon: bool) -> Any:
        return SimpleNamespace(start=lambda: started.append(args))

    monkeypatch.setattr(player, "time", Clock())
    monkeypatch.setattr(player, "threading", SimpleNamespace(Thread=thread))
    found = Player(SimpleNamespace(gui=gui, atomic=nullcontext), stage, lambda: motion)
    vars(found)["started"] = started
    return found


def test_a_click_plays_and_what_is_moved_by_hand_is_shown(made: Player, stage: Any) -> None:
    """Not what the program itself moves while it plays."""
    (click,), (moved,) = made.button.acts, made.time.acts  # type: ignore[attr-defined]
    click(None)
    assert (made.button.label, len(vars(made)["started"])) == (PAUSE, 1)
    made.time.value = 2.25
    moved(SimpleNamespace(client=None))
    assert (made.button.label, stage.moved) == (PAUSE, [])
    moved(SimpleNamespace(client="a browser"))
    assert made.button.label == PLAY
    assert [moment.shown_s for moment in stage.moved] == [2.25]
