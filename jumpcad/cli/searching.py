"""What the commands of the search share: options, the objects made from them, progress, and how rows are shown."""

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jumpcad.cli.output import console
from jumpcad.errors import JumpcadError
from jumpcad.simulation.engines import ENGINES, default_engine, in_words, require_engine

if TYPE_CHECKING:
    from jumpcad.search.evaluator import Watch
    from jumpcad.search.models import RobotModel
    from jumpcad.search.pool import Pool
    from jumpcad.search.space import Space
    from jumpcad.search.store import Trial

ModelOption = Annotated[str, typer.Option(help="The robot behind the objective: printed, capsule or published.")]
StudyOption = Annotated[
    Path | None, typer.Option(help="The study file; made, or continued.", metavar="F.db", dir_okay=False)
]
SeedOption = Annotated[int, typer.Option(help="Random seed.", min=0, max=2**32 - 1)]
WorkersOption = Annotated[int | None, typer.Option(help="Processes, one for each core unless given; 0 for none.")]
DaskOption = Annotated[
    str | None, typer.Option(help="Scheduler of a Dask cluster instead of processes.", metavar="ADDRESS")
]
ObjectiveOption = Annotated[
    str | None, typer.Option(help="fitness, range, rise, range-per-joule or jumps-per-joule.", show_default="fitness")
]
FixOption = Annotated[list[str] | None, typer.Option(help="Fix a parameter.", metavar="NAME=VALUE")]
BoundOption = Annotated[
    list[str] | None, typer.Option(help="Search a parameter in another range.", metavar="NAME=LO:HI")
]
ChooseOption = Annotated[list[str] | None, typer.Option(help="Allow some values only.", metavar="NAME=a,b,c")]
AroundOption = Annotated[
    str | None, typer.Option(help="The design from which --only and --within start.", metavar="DESIGN")
]
OnlyOption = Annotated[
    str | None, typer.Option(help="Free these parameters alone; the rest as in --around.", metavar="NAME,…")
]
WithinOption = Annotated[
    float | None, typer.Option(help="Search each range within ± this share of it.", metavar="PERCENT")
]
WorkshopOption = Annotated[str, typer.Option(help="Workshop of the printed robot: a template's name or a file.")]
SettingsOption = Annotated[str, typer.Option(help="Settings of the simulation: a template's name or a file.")]
EngineOption = Annotated[str | None, typer.Option(help=f"{in_words(ENGINES, 'or')}; the first that is installed.")]
LimitOption = Annotated[float, typer.Option(help="Seconds that one evaluation may take.", metavar="SECONDS")]
PlotsOption = Annotated[
    Path | None, typer.Option(help="Write pictures into this folder.", metavar="FOLDER", file_okay=False)
]


def require_study(study: Path | None) -> None:
    """Refuse, before a search, a file that cannot be its study.

    Raises
    ------
    JumpcadError
        Naming the file and the way out.
    """
    from jumpcad.files.outputs import require_folder

    if study is None:
        return
    if study.suffix != ".db":
        raise JumpcadError(f"{study}: a study file must end in .db")
    require_folder(study)
    if os.path.lexists(study) and not os.path.isfile(study):
        raise JumpcadError(f"{study}: is there already and is no file; choose another name")


def require_other_files(study: Path, **others: Path | None) -> None:
    """Refuse, before a search, files that are its study file; `others` are by their options: `output` of `--output`.

    Raises
    ------
    JumpcadError
        Naming the option.
    """
    from jumpcad.files.outputs import same_file

    for option, other in others.items():
        if other is not None and same_file(study, other):
            raise JumpcadError(f"--{option.replace('_', '-')} {other}: is the study file itself; choose another name")


def require_plots(folder: Path | None, force: bool) -> None:
    """Refuse, before the work, a folder in which pictures cannot be written or would replace a user's own.

    Raises
    ------
    JumpcadError
        Naming the folder or picture and the way out.
    """
    from jumpcad.files.outputs import require_free
    from jumpcad.search.figures import PICTURES

    if folder is None:
        return
    if os.path.lexists(folder) and not os.path.isdir(folder):
        raise JumpcadError(f"{folder}: is there already and is no folder; choose another name")
    for name in PICTURES:
        require_free(folder / f"{name}.svg", force)


def make_space(
    fix: Sequence[str] | None,
    bound: Sequence[str] | None,
    choose: Sequence[str] | None,
    around: str | None,
    only: str | None,
    within: float | None,
) -> "Space":
    """Return the space that the options describe."""
    from jumpcad.design import load_design
    from jumpcad.search.space import Space

    centre = load_design(around) if around else None
    names = [name.strip() for name in only.split(",")] if only else []
    return Space.parse(fix or (), bound or (), choose or (), centre, names, within)


def make_model(name: str, workshop: str, settings: str, engine: str | None) -> "RobotModel":
    """Return the model that the options describe."""
    from jumpcad.search.models import MODELS, RobotModel
    from jumpcad.settings import load_settings
    from jumpcad.workshop import load_workshop

    if engine is not None:
        require_engine(engine)
    if name not in MODELS or name == "published":
        return RobotModel(name)
    return RobotModel(
        name,
        load_workshop(workshop) if name == "printed" else None,
        load_settings(settings),
        engine or default_engine(),
    )


def make_pool(workers: int | None, dask: str | None, limit_s: float) -> "Pool":
    """Return the pool that the options describe."""
    from jumpcad.search.pool import dask_pool, local_pool

    if dask is not None and workers is not None:
        raise JumpcadError("--workers and --dask exclude each other: Dask has its own workers")
    return local_pool(workers, limit_s) if dask is None else dask_pool(dask, limit_s)


@contextmanager
def watching(total: int, quiet: bool) -> Iterator["Watch"]:
    """Show rate, best and time left on standard error while a search runs, if a terminal is there to see it."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    from jumpcad.search.store import SEARCH_PHASES

    columns = (
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}  best {task.fields[best]}"), TimeRemainingColumn(),
    )  # fmt: skip
    with Progress(*columns, console=console(stderr=True), disable=quiet or not sys.stderr.isatty()) as progress:
        task = progress.add_task("search", total=total, rate="", best="–")
        best: list[float] = []

        def watch(row: "Trial", computed: bool) -> None:
            if row.phase not in SEARCH_PHASES:
                progress.update(task, description="robust pick")
                return
            if row.score is not None and (not best or row.score > best[0]):
                best[:] = [row.score]
            speed = progress.tasks[0].speed
            progress.update(
                task, advance=1, description=row.phase,
                rate=f"{speed:.1f}/s" if speed else "", best=f"{best[0]:.4g}" if best else "–",
            )  # fmt: skip

        yield watch


def row_data(row: "Trial") -> dict[str, Any]:
    """Return a row as plain data for JSON."""
    evaluation = row.evaluation
    return {
        "phase": row.phase,
        "score": row.score,
        "fitness": evaluation.metrics.get("fitness") if evaluation.feasible else 0.0,
        "verdict": evaluation.verdict,
        "detail": evaluation.detail,
        "design": row.design.model_dump(),
        "metrics": dict(evaluation.metrics),
        "margins": {finding.name: {"margin": finding.margin, "unit": finding.unit} for finding in evaluation.findings},
    }


def design_lines(row: "Trial") -> list[str]:
    """Return the parameters of a row's design, one a line."""
    return [f"  {name:24s}{value:12.5g}" for name, value in row.design.model_dump().items()]
