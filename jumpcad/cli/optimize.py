"""`jumpcad optimize`: search for the best printable robot."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, print_json
from jumpcad.cli.searching import (  # fmt: skip
    AroundOption,
    BoundOption,
    ChooseOption,
    DaskOption,
    EngineOption,
    FixOption,
    LimitOption,
    ModelOption,
    ObjectiveOption,
    OnlyOption,
    PlotsOption,
    SeedOption,
    SettingsOption,
    StudyOption,
    WithinOption,
    WorkersOption,
    WorkshopOption,
    design_lines,
    make_model,
    make_pool,
    make_space,
    require_other_files,
    require_plots,
    require_study,
    row_data,
    watching,
)

if TYPE_CHECKING:
    from jumpcad.search.models import RobotModel
    from jumpcad.search.store import Trial
    from jumpcad.search.study import Request, Result

HEADING = "# Found by jumpcad optimize"
SHOWN = 10
"""Candidates that are printed; --json has all of them."""

MethodArgument = Annotated[
    str | None,
    typer.Argument(help="The method; without one GA, then BO on all that it saw.", metavar="[ga|bo|pareto|nsga2]"),
]
EvaluationsOption = Annotated[int, typer.Option(help="Designs to evaluate; the robust pick comes on top.")]
PresetOption = Annotated[str, typer.Option(help="Settings of the genetic algorithm: recommended or published.")]
BatchOption = Annotated[int, typer.Option(help="BO proposals evaluated together: more than 1 for many workers.")]
FromOption = Annotated[
    Path | None, typer.Option(help="An earlier study to learn from.", metavar="F.db", dir_okay=False)
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", help="The winner's design file.", metavar="FILE.toml", dir_okay=False)
]


def register(app: typer.Typer) -> None:
    """Add the commands of this module."""
    app.command()(optimize)


def optimize(
    method: MethodArgument = None,
    model: ModelOption = "printed",
    evaluations: EvaluationsOption = 250,
    study: StudyOption = None,
    seed: SeedOption = 0,
    workers: WorkersOption = None,
    dask: DaskOption = None,
    objective: ObjectiveOption = None,
    fix: FixOption = None,
    bound: BoundOption = None,
    choose: ChooseOption = None,
    around: AroundOption = None,
    only: OnlyOption = None,
    within: WithinOption = None,
    preset: PresetOption = "recommended",
    batch: BatchOption = 1,
    from_study: FromOption = None,
    workshop: WorkshopOption = "default",
    settings: SettingsOption = "default",
    engine: EngineOption = None,
    limit: LimitOption = 60.0,
    output: OutputOption = None,
    plots: PlotsOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Search for the design that jumps farthest, and pick one whose neighbours jump well too.

    Every evaluation is kept in the study file, from which the same command goes on after whatever interrupted it. The
    exit code is 1 if every design was refused.
    """
    from jumpcad.files.outputs import require_target
    from jumpcad.search.study import FRONTS, Request, run_study

    robot = make_model(model, workshop, settings, engine)
    request = Request(
        make_space(fix, bound, choose, around, only, within), robot,
        objective or ("range" if method in FRONTS else "fitness"), method or "ga+bo", evaluations, seed, preset, batch,
        from_study, _tolerance_mm(robot),
    )  # fmt: skip
    path = study or Path(request.default_name())
    require_study(path)
    design_file = output or path.with_suffix(".toml")
    require_other_files(path, output=design_file, from_study=from_study)
    require_target(design_file, (".toml",), force)
    require_plots(plots, force)
    with make_pool(workers, dask, limit) as pool, watching(evaluations, as_json) as watch:
        if not as_json:
            print(f"study {path}: {request.method} on the {model} robot, free parameters: {request.space.dimension}")
        result = run_study(request, path, pool, watch)
    if result.winner is not None:
        require_target(design_file, (".toml",), force)  # once more: a search takes hours
        _write_design(design_file, result.winner, request)
    pictures = _plot(path, plots)
    if as_json:
        print_json({"study": str(path), "pictures": pictures} | _data(request, result, design_file))
    else:
        _print_result(request, result, design_file)
    if result.winner is None:
        raise typer.Exit(1)


def _tolerance_mm(model: "RobotModel") -> float:
    """Return by how much a printed link may come out wrong: both its ends have the play of a sliding fit."""
    return 0.2 if model.workshop is None else 2.0 * float(model.workshop.fits.sliding_mm)


def _write_design(path: Path, winner: "Trial", request: "Request") -> None:
    from jumpcad.files.outputs import sealed, write_atomically

    name = request.model.describe()["name"]
    heading = f"{HEADING}: {request.method} on the {name} robot, {request.objective} {winner.score:.4g}.\n"
    write_atomically(path, sealed(heading + winner.design.to_toml()))


def _plot(path: Path, folder: Path | None) -> list[str]:
    if folder is None:
        return []
    from jumpcad.search.store import StudyStore
    from jumpcad.search.studies import plot_study

    with StudyStore.read(path) as store:
        return [str(picture) for picture in plot_study(store, folder)]


def _data(request: "Request", result: "Result", design_file: Path) -> dict[str, Any]:
    from jumpcad.search.methods.pareto import front, hypervolume
    from jumpcad.search.study import FRONTS, count_refusals

    data: dict[str, Any] = {
        "method": request.method,
        "objective": request.objective,
        "evaluations": len(result.rows),
        "refused": count_refusals(result.rows),
        "best": None if result.best is None else row_data(result.best),
        "winner": None if result.winner is None else row_data(result.winner),
        "design_file": None if result.winner is None else str(design_file),
        "candidates": [
            {
                "score": candidate.row.score,
                "robust_score": candidate.robust_score,
                "parameters_score": candidate.parameters_score,
                "print_score": candidate.print_score,
                "refusals": candidate.refusals,
                "design": candidate.row.design.model_dump(),
            }
            for candidate in result.candidates
        ],
        "active_bounds": [asdict(bound) for bound in result.bounds],
        "notes": result.notes,
    }
    if request.method in FRONTS:
        data["front"] = [row_data(row) for row in front(result.rows)]
        data["hypervolume"] = hypervolume(result.rows)
    return data


def _print_result(request: "Request", result: "Result", design_file: Path) -> None:
    from jumpcad.search.methods.pareto import energy_j, front, hypervolume
    from jumpcad.search.study import FRONTS, count_refusals

    refused = ", ".join(f"{name} {count}" for name, count in count_refusals(result.rows).items())
    print(f"{len(result.rows)} designs evaluated; refused: {refused or 'none'}")
    for note in result.notes:
        print(f"note: {note}")
    if result.best is None or result.winner is None:
        print("no design jumps: widen the bounds, raise --evaluations, or see the reasons above")
        return
    if request.method in FRONTS:
        print(f"\n{request.objective} against spring energy; hypervolume {hypervolume(result.rows):.4f}")
        for row in front(result.rows):
            print(f"  {energy_j(row.design):8.4f} J  {row.score:10.4f}")
    print(f"\nbest {request.objective} {result.best.score:.4f}")
    if result.candidates:
        print(f"nine in ten neighbours reach, with parameters ±1 % and with lengths ±{request.tolerance_mm:g} mm:")
        print(f"  {'itself':>10s}{'±1 %':>10s}{'lengths':>10s}  refused of 32")
    for candidate in result.candidates[:SHOWN]:
        refusals = ", ".join(f"{name} {count}" for name, count in candidate.refusals.items()) or "none"
        print(
            f"  {candidate.row.score:10.4f}{candidate.parameters_score:10.4f}{candidate.print_score:10.4f}  {refusals}"
        )
    print(f"\n{design_file}: {request.objective} {result.winner.score:.4f}")
    print("\n".join(design_lines(result.winner)))
    for bound in result.bounds:
        gain = "is refused: " + bound.reason if bound.worth is None else f"changes the score by {bound.worth:+.4f}"
        print(f"on its {bound.side} bound: {bound.name} = {bound.value:g}; {bound.beyond:g} {gain}")
    print(f"\nnext: jumpcad build {design_file}")
