"""The studio's controls of a motion: play and pause, a slider of time, how slowly it is played; ends of sliders."""

import math
import threading
import time
from collections.abc import Callable
from typing import Any

from jumpcad.bundle.motion import SHOWN_S
from jumpcad.design import PRINTED_BOUNDS, limits_of
from jumpcad.errors import JumpcadError
from jumpcad.studio.answers import Playback
from jumpcad.studio.stage import StudioStage

FRAME_S = 1.0 / 30.0
"""Time between two frames."""
STEP_S = 0.01
SLOWEST = 10.0
PLAY, PAUSE = "Play", "Pause"
RESTING = "at rest"
WIDER = 0.5
"""How far sliders extend beyond the bounds of the search, over the bounds' distance."""


class Player:
    """Controls of the motion of the robot that a stage shows, which `make` returns when it is first asked for."""

    def __init__(self, server: Any, stage: StudioStage, make: Callable[[], Playback]) -> None:
        self.server, self.stage, self._make = server, stage, make
        self._motion: Playback | None = None
        self._run = 0
        gui, longest = server.gui, round(sum(SHOWN_S.values()), 2)
        self.button = gui.add_button(PLAY, hint="winding, drop of the roller, push-off and flight")
        self.time = gui.add_slider("motion, s", 0.0, longest, STEP_S, 0.0, hint="winding to landing, each phase slowed")
        self.slower = gui.add_slider("slow motion", 0.5, SLOWEST, 0.5, 1.0, hint="how many times slower Play is")
        self.words = gui.add_markdown(RESTING)
        self.button.on_click(lambda _: self.toggle())
        when_changed(self.time, self._scrub)

    def rest(self) -> None:
        """Forget the motion: another robot stands there, at rest."""
        with self.stage.lock:
            self.pause()
            self._motion = None
            self.time.value = 0.0
            self.words.content = RESTING
            self.stage.show_path(None)

    def toggle(self) -> None:
        """Play from where the slider is, or from the start if it is at the end; pause what plays."""
        with self.stage.lock:
            if self.button.label == PAUSE:
                self.pause()
                return
            motion = self._ready()
            if motion is None:
                return
            self.button.label = PAUSE
            start_s = 0.0 if self.time.value >= motion.end_s - STEP_S else self.time.value
            threading.Thread(target=self._play, args=(start_s, self._run), daemon=True).start()

    def pause(self) -> None:
        """Stop where the motion is."""
        with self.stage.lock:
            self._run += 1
            self.button.label = PLAY

    def show(self, shown_s: float) -> None:
        """Show the robot as it is at a time of the motion (s)."""
        with self.stage.lock:
            motion = self._ready()
            if motion is None:
                return
            moment = motion.at(shown_s)
            with self.server.atomic():
                self.stage.move(moment)
                self.words.content = moment.to_text(self.slower.value)

    def _scrub(self) -> None:
        self.pause()
        self.show(self.time.value)

    def _ready(self) -> Playback | None:
        """Return the motion; say why there is none."""
        if self._motion is None:
            try:
                self._motion = self._make()
            except JumpcadError as error:
                self.words.content = f"**no motion**: {error}"
                return None
            self.time.max = self._motion.end_s
            self.stage.show_path(self._motion.com_m)
        return self._motion

    def _play(self, shown_s: float, run: int) -> None:
        """Show the moments of the motion at their times, late ones skipped, until it ends or another run begins."""
        before = time.monotonic()
        while True:
            with self.stage.lock:
                if run != self._run or self._motion is None:
                    return
                shown_s = min(shown_s, self._motion.end_s)
                self.time.value = round(shown_s, 2)
                self.show(shown_s)
                if shown_s == self._motion.end_s:
                    self.pause()
            time.sleep(FRAME_S)
            now = time.monotonic()
            shown_s, before = shown_s + (now - before) / self.slower.value, now


def when_changed(handle: Any, act: Callable[[], object]) -> None:
    """Call a function whenever an input of viser is changed in a browser."""

    def changed(event: Any) -> None:
        if event.client is not None:
            act()

    handle.on_update(changed)


def slider_ends(key: str, value: float) -> tuple[float, float]:
    """Return the ends of a parameter's slider: the search's bounds, widened, within what a design may be."""
    bounds, (lowest, highest) = PRINTED_BOUNDS[key], limits_of(key)
    more = WIDER * (bounds.upper - bounds.lower)
    low = max(lowest, min(bounds.lower - more, value))
    high = min(highest, max(bounds.upper + more, value))
    return round(low, 4), round(high, 4)


def slider_step(span: float) -> float:
    """Return a slider's step: a power of ten, at most a 500th of the slider's range."""
    return min(1.0, 10.0 ** math.floor(math.log10(span / 500.0)))
