"""The studio's page: sliders, figures, motion and the points of a study, on a viser server."""

import itertools
import shlex
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from jumpcad.bundle.export import export
from jumpcad.bundle.limits import limits_of, violation, with_verdict
from jumpcad.bundle.viewer import parts_facts
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.files.outputs import is_sealed, sealed, write_files
from jumpcad.search.study.result import workshop_file
from jumpcad.studio.answers import Playback, Printed, capsule_answer, playback, printed_answer
from jumpcad.studio.player import Player, slider_ends, slider_step, when_changed
from jumpcad.studio.points import STUDYS, Points
from jumpcad.studio.stage import StudioStage
from jumpcad.workshop import DEFAULT, Workshop, load_workshop

BY_NUMBER = "by its number"
"""What the list of points says of one that is not in it."""
CLICK = "Click on a part for its mass, material and file."


class Studio:
    """A studio that serves one design, or the points of a study, on a viser server until it is stopped.

    Saved files and bundles are called after `name`, in a folder. Of the workshops to choose from, names or files, the
    first is used at the start, unless there are points; `design` is that with the `number`.
    """

    def __init__(
        self, design: Design, name: str, workshops: list[str], server: Any, folder: Path,
        points: Points | None = None, number: int = 1,
    ) -> None:  # fmt: skip
        self.first, self.name, self.folder = design, name, folder
        self.points, self.number = points, number
        self.server, self.stage = server, StudioStage(server, self._say_part)
        self.shown: Printed | None = None
        self.kept: Printed | None = None
        self._newest, self._building = threading.Condition(), threading.Lock()
        self._wanted: Design | None = design
        self._ended = False
        self.workshop: Workshop = self._loaded(workshops[0])
        self._chosen = self._opened = workshops[0]
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
        self.player.rest()
        self._thread.join()
        self.shown = self.kept = None
        self.stage.meshes.clear()

    @property
    def design(self) -> Design:
        return Design(**{key: slider.value for key, slider in self.sliders.items()})

    def _make_panel(self, workshops: list[str]) -> None:
        gui = self.server.gui
        gui.set_panel_label(self.name)
        gui.configure_theme(control_width="large", show_logo=False, show_share_button=False)  # sharing needs a network
        self.quick, self.figures = gui.add_markdown(""), gui.add_markdown("building …")
        self.part = gui.add_markdown(CLICK)
        self.player = Player(self.server, self.stage, self._motion)
        if self.points is not None:
            self._make_choice(self.points)
        self.sliders = {}
        for key, value in self.first.model_dump().items():
            low, high = slider_ends(key, value)
            hint = Design.model_fields[key].description
            slider = gui.add_slider(key, low, high, slider_step(high - low), value, hint=hint)
            when_changed(slider, self._ask)
            self.sliders[key] = slider
        self.choice = gui.add_dropdown("workshop", tuple(workshops), initial_value=workshops[0])
        when_changed(self.choice, lambda: self._run_action(self._change_workshop))
        actions = {
            "Keep as ghost": self._keep, "Reset": self._reset, "Save design": self._save, "Build bundle": self._build,
        }  # fmt: skip
        buttons = gui.add_button_group("", tuple(actions))
        buttons.on_click(lambda _: self._run_action(actions[buttons.value]))
        self.status = gui.add_markdown("")

    def _make_choice(self, points: Points) -> None:
        """Make a list of the best trials and the front, and a field for the number of any trial."""
        gui, last, listed = self.server.gui, len(points.trials), points.listed
        self.point = gui.add_markdown(points.to_text(self.number))
        texts = (BY_NUMBER, *listed)
        hint = "the best designs, then the front"
        self.best = gui.add_dropdown("point", texts, initial_value=points.listed_as(self.number, BY_NUMBER), hint=hint)
        self.trial = gui.add_number("trial", self.number, min=1, max=last, step=1, hint=f"any trial, 1 to {last}")
        when_changed(self.best, lambda: self._run_action(lambda: self.open(listed.get(self.best.value, self.number))))
        when_changed(self.trial, lambda: self._run_action(lambda: self.open(int(self.trial.value))))

    def open(self, number: int) -> str:
        """Open the point of a study with a number: its design and its workshop."""
        assert self.points is not None
        trial, before = self.points.trial(number), self.number
        try:
            self.number = number
            self.workshop = self._loaded(STUDYS)
        except JumpcadError:
            self.number = before
            raise
        self.first, self.choice.value, self.trial.value = trial.design, STUDYS, number
        self._chosen = self._opened = STUDYS
        self.point.content = self.points.to_text(number)
        if self.points.listed.get(self.best.value) != number:
            self.best.value = self.points.listed_as(number, BY_NUMBER)
        return self._reset()

    def _loaded(self, workshop: str) -> Workshop:
        if self.points is not None and workshop == STUDYS:
            return self.points.workshop_of(self.points.trial(self.number))
        return load_workshop(workshop)

    def _ask(self) -> None:
        """Show the capsule robot's figures at once; let the thread build the newest design."""
        self.player.pause()
        try:
            design = self.design
        except JumpcadError as error:  # half a number is typed
            self.quick.content = f"**no design**: {error}"
            return
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
        with self.stage.lock, self.server.atomic():
            self.player.rest()
            self.shown = found
            self.part.content = CLICK
            if found.robot is None:
                self.stage.fade()
            else:
                self.stage.show(found.robot, found.wrong_parts)
        return found

    def _motion(self) -> Playback:
        if self.shown is None or self.shown.robot is None:
            raise JumpcadError("there is no robot: the design cannot be built")
        return playback(self.shown.robot)

    def _say_part(self, name: str) -> None:
        if self.shown is not None and self.shown.robot is not None:
            facts = parts_facts(self.shown.robot)[name]
            file = f", {facts['file']}" if facts["file"] else ""
            self.part.content = f"**{facts['label']}**: {facts['mass_g']:.2f} g, {facts['material']}{file}"

    def _change_workshop(self) -> str:
        try:
            self.workshop = self._loaded(self.choice.value)
        except JumpcadError:
            self.choice.value = self._chosen
            raise
        self._chosen = self.choice.value
        self._ask()
        return f"workshop {self._chosen}"

    def _run_action(self, action: Callable[[], str]) -> None:
        """Run a button's action and show its result or its error."""
        try:
            self.status.content = action()
        except JumpcadError as error:
            self.status.content = f"**not possible**: {error}"

    def _reset(self) -> str:
        if self._chosen != self._opened:
            self.workshop = self._loaded(self._opened)
            self.choice.value = self._chosen = self._opened
        for key, value in self.first.model_dump().items():
            slider, (low, high) = self.sliders[key], slider_ends(key, value)
            slider.min, slider.max = min(slider.min, low), max(slider.max, high)
            slider.value = value
        self._ask()
        return "as at the start" if self.points is None else f"as trial {self.number}"

    def _keep(self) -> str:
        robot = self.shown.robot if self.shown else None
        self.kept = self.shown if robot else None
        self.stage.show_ghost(robot)
        return "kept: figures show the difference to it" if robot else "no ghost"

    def _save(self) -> str:
        """Save the design, and the workshop of a point beside it; say with which workshop the design is this robot."""
        design, is_points = self.design, self._chosen == STUDYS and self.workshop != load_workshop()
        path, numbers = self.folder / f"{self.name}-studio.toml", itertools.count(2)
        while any(file.exists() and not is_sealed(file) for file in (path, workshop_file(path))):  # changed since
            path = self.folder / f"{self.name}-studio-{next(numbers)}.toml"
        texts = {path: design.to_toml()} | ({workshop_file(path): self.workshop.to_toml()} if is_points else {})
        write_files(self.folder, {file.name: sealed(text) for file, text in texts.items()})
        used = str(workshop_file(path)) if is_points else self._chosen
        if used in (DEFAULT, STUDYS):
            return f"saved {path}"
        return f"saved {path}; this robot: `jumpcad build {shlex.quote(str(path))} --workshop {shlex.quote(used)}`"

    def _build(self) -> str:
        if not self._building.acquire(blocking=False):
            raise JumpcadError("a bundle is being built; wait until it is there")
        try:
            self.status.content = "building …"
            found = printed_answer(self.design, self.workshop, self.name)
            if found.robot is None or found.jump is None:
                raise JumpcadError(found.reason)
            bundle = export(found.robot, self.folder / f"{self.name}-studio", pictures=True)
        finally:
            self._building.release()
        wrong = [violation(with_verdict(limits_of(found.robot), found.jump))]
        if found.jump.verdict != "jump":
            wrong.insert(0, f"it does not jump ({found.jump.verdict})")
        return "; ".join([f"built {bundle.folder}", *(f"**{one}**" for one in wrong if one)])
