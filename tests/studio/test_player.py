"""The player's controls, on a stage and a server that only write down what they are asked."""

import threading
from contextlib import nullcontext
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from jumpcad.errors import JumpcadError
from jumpcad.studio import player
from jumpcad.studio.player import PAUSE, PLAY, RESTING, Player

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


@pytest.mark.parametrize("slower", [0.5, 1.0, 10.0])
def test_a_motion_is_shown_at_its_times_ten_times_slower_where_that_is_asked(
    made: Player, stage: Any, slower: float
) -> None:
    """Late frames are skipped: each step is as long as the clock says, not as the sleep was to be."""
    made.slower.value = slower
    made._ready()
    made._play(1.0, made._run)
    times = [moment.shown_s for moment in stage.moved]
    assert (times[0], times[-1]) == (1.0, END_S)
    assert np.diff(times)[:-1] == pytest.approx(1.1 / 30.0 / slower)
    assert player.time.monotonic() - 100.0 == pytest.approx(3.0 * slower, abs=2.2 / 30.0)  # a frame late, and one more
    assert made.time.value == END_S
    assert made.words.content == f"4 s, {slower:g} times"
    assert made.button.label == PLAY


def test_play_goes_on_from_where_the_slider_is_and_from_the_start_at_the_end(made: Player) -> None:
    started: list[Any] = vars(made)["started"]
    for value, start_s in ((1.5, 1.5), (3.98, 3.98), (4.0, 0.0), (3.995, 0.0)):
        made.time.value = value
        made.toggle()
        assert started.pop() == (start_s, made._run)
        assert made.button.label == PAUSE
        made.toggle()  # what plays is paused
        assert (made.button.label, started) == (PLAY, [])


def test_what_is_paused_or_moved_by_hand_is_not_played_on(made: Player, stage: Any) -> None:
    made._ready()
    run = made._run
    made.pause()
    made._play(0.0, run)
    assert stage.moved == []
    made.time.value, made.button.label = 2.25, PAUSE
    made._scrub()
    assert [moment.shown_s for moment in stage.moved] == [2.25]
    assert made.button.label == PLAY


def test_at_rest_there_is_no_motion_and_no_path(made: Player, stage: Any) -> None:
    made.show(1.0)
    assert (made.time.max, len(stage.paths)) == (END_S, 1)
    made.time.value = 1.0
    made.rest()
    assert (made.time.value, made.words.content, stage.paths[-1], made._motion) == (0.0, RESTING, None, None)


def test_why_there_is_no_motion_is_said(made: Player, stage: Any) -> None:
    def refuse() -> Any:
        raise JumpcadError("no engine")

    made._make = refuse
    made.toggle()
    assert made.words.content == "**no motion**: no engine"
    assert (vars(made)["started"], made.button.label, stage.moved) == ([], PLAY, [])


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
