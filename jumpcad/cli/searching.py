"""The common options of `explore` and `optimize`, and checks of their files."""

import functools
import inspect
import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

from jumpcad.cli.subjects import SeedOption
from jumpcad.errors import JumpcadError

if TYPE_CHECKING:
    from jumpcad.search.models import RobotModel
    from jumpcad.search.study.pool import Pool

PlotsOption = Annotated[
    Path | None, typer.Option(help="Write pictures (SVG and PNG) into this folder.", metavar="FOLDER", file_okay=False)
]

KEYWORD = inspect.Parameter.KEYWORD_ONLY


@dataclass(frozen=True)
class SearchOptions:
    """The options that `explore` and `optimize` have in common."""

    model: Annotated[str, typer.Option(help="The robot that is evaluated: printed, capsule or published.")] = "printed"
    objective: Annotated[
        str | None,
        typer.Option(
            help="body_lengths, touchdown, rest, fitness, range, rise, range-per-joule, range-per-spring-joule, "
            "jumps-per-joule, metres-per-charge, or an own function of a jump's figures.",
            metavar="NAME|FILE.py:FUNCTION",
            show_default="body_lengths; fitness of robots that are not printed",
        ),
    ] = None
    study: Annotated[
        Path | None, typer.Option(help="The study file, new or to be continued.", metavar="F.db", dir_okay=False)
    ] = None
    seed: SeedOption = 0
    fix: Annotated[
        list[str] | None, typer.Option(help="Fix a parameter, or a value of the workshop.", metavar="NAME=VALUE")
    ] = None
    bound: Annotated[
        list[str] | None,
        typer.Option(
            help="Search a parameter, or a value of the workshop, in a range; study: within the study's bounds.",
            metavar="NAME=LO:HI",
        ),
    ] = None
    choose: Annotated[
        list[str] | None, typer.Option(help="Allow some values only: bought.battery=a,b.", metavar="NAME=a,b,c")
    ] = None
    workshop: Annotated[
        str | None,
        typer.Option(help="Workshop of the printed robot: a template's name or a file.", show_default="default"),
    ] = None
    settings: Annotated[
        str | None,
        typer.Option(help="Settings of the simulation: a template's name or a file.", show_default="default"),
    ] = None
    engine: Annotated[str | None, typer.Option(help="pybullet, mujoco or planar; else the first installed.")] = None
    workers: Annotated[int | None, typer.Option(help="Processes, one for each core unless given; 0 for none.")] = None
    dask: Annotated[
        str | None, typer.Option(help="Scheduler of a Dask cluster instead of processes.", metavar="ADDRESS")
    ] = None
    limit: Annotated[
        float, typer.Option(help="Timeout per evaluation (s), own objectives apart.", metavar="SECONDS")
    ] = 60.0

    def robot_model(self) -> "RobotModel":
        """Return the model that the options describe."""
        from jumpcad.search.models import robot_model

        return robot_model(self.model, self.workshop, self.settings, self.engine)

    def inputs(self) -> dict[str, str | None]:
        """Return the files that are read, by their options."""
        return {"--workshop": self.workshop, "--settings": self.settings}

    def pool(self) -> "Pool":
        """Return the pool that the options describe."""
        from jumpcad.search.study.pool import open_pool

        return open_pool(self.workers, self.dask, self.limit)


def with_search_options(command: Callable[..., None]) -> Callable[..., None]:
    """Return a command with an option for each field of `SearchOptions` in place of its parameter `options`."""
    hints = get_type_hints(SearchOptions, include_extras=True)
    names = {field.name for field in fields(SearchOptions)}
    parameters: list[inspect.Parameter] = []
    for parameter in inspect.signature(command).parameters.values():
        if parameter.annotation is SearchOptions:
            parameters += [
                inspect.Parameter(field.name, KEYWORD, annotation=hints[field.name], default=field.default)
                for field in fields(SearchOptions)
            ]
        else:
            parameters.append(parameter.replace(kind=KEYWORD))

    @functools.wraps(command)
    def unfolded(**values: Any) -> None:
        common = {name: values.pop(name) for name in names}
        command(**values, options=SearchOptions(**common))

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
