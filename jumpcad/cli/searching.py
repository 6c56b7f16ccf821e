"""What `explore` and `optimize` share: options, checks of files, progress on standard error."""

import functools
import inspect
import os
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import jumpcad
from jumpcad import search
from jumpcad.cli.output import status
from jumpcad.cli.subjects import WORKSHOP, File, SeedOption, Text, Texts, option
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError
from jumpcad.search.methods import PAPER, SEARCH_PHASES, UNTIL_PERCENT

if TYPE_CHECKING:
    from jumpcad.search.study.evaluator import Watch

PlotsOption = Annotated[File, option("Write pictures (SVG and PNG) into this folder.", "FOLDER", file_okay=False)]
KEYWORD = inspect.Parameter.KEYWORD_ONLY
OBJECTIVES = (
    "body_lengths, touchdown, robust, rest, fitness, range, rise, range-per-joule, range-per-spring-joule, "
    "jumps-per-joule, metres-per-charge, or an own function of a jump's figures."
)
USUAL = "body_lengths; fitness of robots that are not printed"
BOUND = "Search a parameter, or a value of the workshop, in a range; study: within the study's bounds."
SETTINGS = "Settings of the simulation: a template's name or a file."
UNTIL = "End when the last steps of BO gain less than this share of the best score; 0: never."
AGAINST = "For pareto and nsga2: electrical-energy, spring-energy, mass, winding-time, or another objective."
USUAL_COST = "electrical-energy; spring-energy of robots that are not printed"
REQUIRE = "Keep a figure, or the margin of a limit, within limits: -30<=touchdown_pitch_deg<=30."


@dataclass(frozen=True)
class SearchOptions:
    """The options that `explore` and `optimize` have in common."""

    model: Annotated[str, option("The robot that is evaluated: printed, capsule or published.")] = "printed"
    objective: Annotated[Text, option(OBJECTIVES, "NAME|FILE.py:FUNCTION", shown=USUAL)] = None
    study: Annotated[File, option("The study file, new or to be continued.", "F.db", dir_okay=False)] = None
    seed: SeedOption = 0
    fix: Annotated[Texts, option("Fix a parameter, or a value of the workshop.", "NAME=VALUE")] = None
    bound: Annotated[Texts, option(BOUND, "NAME=LO:HI")] = None
    choose: Annotated[Texts, option("Allow some values only: bought.battery=a,b.", "NAME=a,b,c")] = None
    workshop: Annotated[Text, option(WORKSHOP, shown="default")] = None
    settings: Annotated[Text, option(SETTINGS, shown="default")] = None
    engine: Annotated[Text, option("pybullet, mujoco or planar; else the first installed.")] = None
    workers: Annotated[int | None, option("Processes, one for each core unless given; 0 for none.")] = None
    dask: Annotated[Text, option("Scheduler of a Dask cluster instead of processes.", "ADDRESS")] = None
    limit: Annotated[float, option("Timeout per evaluation (s), own objectives apart.", "SECONDS")] = 60.0

    def robot_model(self) -> "search.RobotModel":
        """Return the model that the options describe."""
        return search.robot_model(self.model, self.workshop, self.settings, self.engine)

    def space(self, robot: "search.RobotModel", **others: Any) -> "search.Space":
        """Return the space of a robot's workshop that the options describe."""
        changes = (one or () for one in (self.fix, self.bound, self.choose))
        return search.Space.parse(*changes, workshop=robot.workshop, **others)

    def inputs(self) -> dict[str, str | None]:
        """Return the files that are read, by their options."""
        return {"--workshop": self.workshop, "--settings": self.settings}

    def pool(self) -> "search.Pool":
        from jumpcad.search.study.pool import open_pool

        return open_pool(self.workers, self.dask, self.limit)


@dataclass(frozen=True)
class OptimizeOptions(SearchOptions):
    """All that decides the searches of `optimize`, but their methods and number of evaluations."""

    around: Annotated[
        Text, option("The design from which --only and --within start; it is evaluated first.", "DESIGN")
    ] = None
    start: Annotated[Texts, option("A design to begin with; may be repeated.", "DESIGN")] = None
    cold: Annotated[
        bool, option("Begin without the shipped designs, the best of which are else among the first.", None, "--cold")
    ] = False
    only: Annotated[Text, option("Search these parameters only; the others as in --around.", "NAME,…")] = None
    within: Annotated[float | None, option("Search within ± this percentage of each range.", "PERCENT")] = None
    preset: Annotated[str, option("Settings of the genetic algorithm: recommended or published.")] = "recommended"
    batch: Annotated[int, option("BO proposals evaluated in parallel: more than 1 for many workers.")] = 1
    from_study: Annotated[File, option("An earlier study to learn from.", "F.db", dir_okay=False)] = None
    until: Annotated[float, option(UNTIL, "PERCENT")] = UNTIL_PERCENT
    hours: Annotated[float, option("End the search after this time, 0: never; the same command goes on.")] = 0.0
    screen: Annotated[
        bool, option("For ga: leave out candidates that a quick estimate finds too bad.", None, "--screen")
    ] = False
    against: Annotated[Text, option(AGAINST, "NAME", shown=USUAL_COST)] = None
    require: Annotated[Texts, option(REQUIRE, "LIMITS")] = None

    def robot_model(self) -> "search.RobotModel":
        return super().robot_model().requiring(self.require or ())

    def requests(self, methods: Sequence[str], seeds: Iterable[int], evaluations: int) -> "list[search.Request]":
        """Return what is asked for, with each method and seed."""
        begun = [jumpcad.load_design(one) for one in self.start or ()]
        centre = None if self.around is None else jumpcad.load_design(self.around)
        only = [] if self.only is None else [name.strip() for name in self.only.split(",")]
        robot = self.robot_model()
        space = self.space(robot, around=centre, only=only, within_percent=self.within, study=PAPER in methods)
        return [
            search.Request(
                space, robot, self.objective, method, evaluations, seed, self.preset, self.batch, self.from_study,
                self.until, self.hours, self.screen, self.against, begun, centre, self.cold,
            )
            for method in methods for seed in seeds
        ]  # fmt: skip

    def inputs(self) -> dict[str, Any]:
        starts = {f"--start {one}": one for one in self.start or ()}
        return {"--from-study": self.from_study, "--around": self.around, **starts, **super().inputs()}


def with_options(command: Callable[..., None]) -> Callable[..., None]:
    """Return a command with an option for each field of the dataclass of its parameter `options`."""
    record = inspect.signature(command).parameters["options"].annotation
    hints = get_type_hints(record, include_extras=True)
    parameters: list[inspect.Parameter] = []
    for parameter in inspect.signature(command).parameters.values():
        if parameter.name == "options":
            parameters += [inspect.Parameter(one.name, KEYWORD, annotation=hints[one.name], default=one.default)
                           for one in fields(record)]  # fmt: skip
        else:
            parameters.append(parameter.replace(kind=KEYWORD))

    @functools.wraps(command)
    def unfolded(**values: Any) -> None:
        common = {field.name: values.pop(field.name) for field in fields(record)}
        command(**values, options=record(**common))

    del unfolded.__wrapped__  # else Typer reads the signature and the annotations of that function
    unfolded.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    unfolded.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    return unfolded


def require_plots(folder: Path | None, force: bool) -> None:
    """Require, before a search, that its pictures can be written to a folder without replacing a user's files."""
    if folder is not None:  # without matplotlib, which takes 0.4 s to load
        from jumpcad.search.report.figures import PICTURES

        require_pictures(folder, PICTURES, force)


def require_pictures(folder: Path, names: Iterable[str], force: bool) -> None:
    """Require that pictures can be written to a folder without replacing a user's files."""
    from jumpcad.files.outputs import require_free, require_writable

    if os.path.lexists(folder) and not os.path.isdir(folder):
        raise JumpcadError(f"{folder}: is there already and is no folder; choose another name")
    for name in names:
        for suffix in (".svg", ".png"):
            require_free(folder / f"{name}{suffix}", force)
    require_writable(folder)


class Tally:
    """Progress of a search: evaluations done, also read from the study, best score, rate of the others, time left."""

    def __init__(self, total: int) -> None:
        self._total, self._done, self._computed = total, 0, 0
        self._best: float | None = None
        self._start_s = time.monotonic()

    def add(self, trial: "search.Trial", computed: bool) -> str:
        """Count a trial, which was `computed` or read from the study file; return the progress as one line of text."""
        self._done += 1
        self._total = max(self._total, self._done)
        searching = trial.phase in SEARCH_PHASES
        if searching and trial.score is not None:
            self._best = trial.score if self._best is None else max(self._best, trial.score)
        self._computed += computed
        if not self._computed:
            self._start_s = time.monotonic()
        rate = self._computed / elapsed if (elapsed := time.monotonic() - self._start_s) > 0 else 0.0
        best = "–" if self._best is None else f"{self._best:.4g}"
        left = f", about {duration((self._total - self._done) / rate)} left" if rate else ""
        done = f"{self._done} of {counted(self._total, 'evaluation')}"
        return f"{trial.phase if searching else 'robust pick'}: {done}, best {best}, {rate:.2g}/s{left}"


def duration(seconds: float) -> str:
    """Return a time in seconds, minutes or hours."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


@contextmanager
def watching(total: int, quiet: bool) -> Iterator["Watch"]:
    """Show the progress of a search while it runs: always on a terminal, otherwise one line per minute."""
    if quiet:
        yield lambda trial, computed: None
        return
    tally = Tally(total)
    with status("search …") as tell:
        yield lambda trial, computed: tell(tally.add(trial, computed))
