"""The studio's page: sliders, figures and playback, on a viser server."""

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from jumpcad.bundle.export import export
from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.errors import JumpcadError
from jumpcad.files.outputs import require_free, sealed, write_atomically
from jumpcad.mechanism.poses import body_poses
from jumpcad.simulation.engines import default_engine
from jumpcad.studio.answers import Printed, capsule_answer, printed_answer, simulated_motion
from jumpcad.studio.stage import Stage
from jumpcad.studio.wrong_parts import wrong_parts
from jumpcad.workshop import Workshop, load_workshop

FRAME_S = 1.0 / 30.0
"""Time between two frames of the playback."""
WIDER = 0.5
"""How far sliders extend beyond the bounds of the search, over the bounds' distance."""


class Studio:
    """A studio that serves one design until it is stopped.

    Parameters
    ----------
    design, name
        The first design; saved files and bundles are called after `name`.
    workshops
        Names or files of workshops to choose from; the first is used at the start.
    server
        A viser server.
    folder
        Where designs are saved and bundles built.

    Raises
    ------
    JumpcadError
        If the first workshop cannot be loaded.
    """

    def __init__(self, design: Design, name: str, workshops: list[str], server: Any, folder: Path) -> None:
        self.first, self.name, self.folder = design, name, folder
        self.server, self.stage = server, Stage(server)
        self.shown: Printed | None = None
        self.kept: Printed | None = None
        self._newest = threading.Condition()
        self._wanted: Design | None = design
        self._ended = False
        self._playing = threading.Event()
        self.workshop: Workshop = load_workshop(workshops[0])
        self.stage.look_at(design)
        self._make_panel(workshops)

    def start(self) -> None:
        """Build the first robot, and one after every change of a slider, in a thread."""
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def end(self) -> None:
        """End the threads and forget the robots: solids that live longer than their library are complained of."""
        with self._newest:
            self._ended = True
            self._newest.notify()
        self._playing.clear()
        self._thread.join()
        self.shown = self.kept = None
        self.stage.meshes.clear()

    @property
    def design(self) -> Design:
        """The design of the sliders."""
        return Design(**{key: slider.value for key, slider in self.sliders.items()})

    def _make_panel(self, workshops: list[str]) -> None:
        gui = self.server.gui
        gui.set_panel_label(self.name)
        gui.configure_theme(control_width="large", show_logo=False, show_share_button=False)  # sharing needs a network
        self.quick, self.figures = gui.add_markdown(""), gui.add_markdown("building …")
        self.sliders = {}
        for key, value in self.first.model_dump().items():
            low, high = _range(key, value)
            hint = Design.model_fields[key].description
            slider = gui.add_slider(key, low, high, _step(high - low), value, hint=hint)
            slider.on_update(lambda _: self._ask())
            self.sliders[key] = slider
        choice = gui.add_dropdown("workshop", tuple(workshops), initial_value=workshops[0])
        choice.on_update(lambda _: self._change_workshop(choice.value))
        actions = {
            "Play jump": self._play, "Keep as ghost": self._keep, "Reset": self._reset,
            "Save design": self._save, "Build bundle": self._build,
        }  # fmt: skip
        buttons = gui.add_button_group("", tuple(actions))
        buttons.on_click(lambda _: self._run_action(actions[buttons.value]))
        self.status = gui.add_markdown("")

    def _ask(self) -> None:
        """Show the capsule robot's figures at once; let the thread build the newest design."""
        self._playing.clear()
        design = self.design
        self.quick.content = capsule_answer(design)
        with self._newest:
            self._wanted = design
            self._newest.notify()

    def _work(self) -> None:
        """Build printed robots, one at a time, until the studio ends."""
        while True:
            with self._newest:
                while self._wanted is None and not self._ended:
                    self._newest.wait()
                if self._ended or self._wanted is None:
                    return
                design, self._wanted = self._wanted, None
            self.answer(design)

    def answer(self, design: Design) -> Printed:
        """Build, simulate and show a design; return its figures."""
        found = printed_answer(design, self.workshop, self.name)
        self.quick.content = capsule_answer(design)
        self.figures.content = found.to_markdown(self.kept)
        if found.robot is not None:
            with self.server.atomic():
                self.stage.show(found.robot, wrong_parts(found.findings))
        self.shown = found
        return found

    def _change_workshop(self, name: str) -> None:
        self.workshop = load_workshop(name)
        self._ask()

    def _run_action(self, action: Callable[[], str]) -> None:
        """Run a button's action and show its result or its error."""
        try:
            self.status.content = action()
        except JumpcadError as error:
            self.status.content = f"**not possible**: {error}"

    def _reset(self) -> str:
        for key, value in self.first.model_dump().items():
            self.sliders[key].value = value
        self._ask()
        return "as at the start"

    def _keep(self) -> str:
        self.kept = self.shown
        if self.kept is None or self.kept.robot is None:
            self.kept = None
            self.stage.show_ghost(None)
            return "no ghost"
        self.stage.show_ghost(self.kept.robot)
        return "kept: figures show the difference to it"

    def _play(self) -> str:
        robot = self.shown.robot if self.shown else None
        if robot is None:
            raise JumpcadError("there is no robot to play: it cannot be built")
        motion = simulated_motion(robot, default_engine())
        self._playing.set()
        threading.Thread(target=self._animate, args=(motion, body_poses(robot)), daemon=True).start()
        return "winding, drop, push-off and flight, slowed"

    def _animate(self, motion: Any, rest: Any) -> None:
        """Show the poses of a motion at their times, then the robot at rest; late poses are skipped."""
        start, number = time.monotonic(), 0
        shown = motion["show_s"]
        while number < len(shown) and self._playing.is_set():
            with self.server.atomic():
                for body, poses in motion["frames"].items():
                    self.stage.place(f"/robot/{body}", poses[number])
            time.sleep(FRAME_S)
            while number < len(shown) and shown[number] <= time.monotonic() - start:
                number += 1
        self.stage.pose(rest)

    def _save(self) -> str:
        path = self.folder / f"{self.name}-studio.toml"
        require_free(path)
        write_atomically(path, sealed(self.design.to_toml()))
        return f"saved {path}"

    def _build(self) -> str:
        found = printed_answer(self.design, self.workshop, self.name)
        if found.robot is None:
            raise JumpcadError(found.reason)
        bundle = export(found.robot, self.folder / f"{self.name}-studio", pictures=True)
        return f"built {bundle.folder}"


def _range(key: str, value: float) -> tuple[float, float]:
    """Return the ends of a parameter's slider: the search's bounds, widened, within what a design may be."""
    bounds = SEARCH_BOUNDS[key]
    more = WIDER * (bounds.upper - bounds.lower)
    limits = {type(one).__name__: one for one in Design.model_fields[key].metadata}
    low = max(limits["Ge"].ge, min(bounds.lower - more, value))
    high = min(limits["Le"].le, max(bounds.upper + more, value))
    return round(low, 4), round(high, 4)


def _step(span: float) -> float:
    """Return a slider's step: a power of ten, at most a 500th of the slider's range."""
    step = 1.0
    while step > span / 500.0:
        step /= 10.0
    return step
