"""`jumpcad explore`: look around in the design space before, or instead of, optimising."""

from collections import Counter
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, print_json
from jumpcad.cli.searching import (  # fmt: skip
    BoundOption,
    ChooseOption,
    DaskOption,
    EngineOption,
    FixOption,
    LimitOption,
    ModelOption,
    ObjectiveOption,
    PlotsOption,
    SeedOption,
    SettingsOption,
    StudyOption,
    WorkersOption,
    WorkshopOption,
    make_model,
    make_pool,
    make_space,
    require_plots,
    require_study,
    watching,
)
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean

if TYPE_CHECKING:
    from jumpcad.design import Design
    from jumpcad.search.evaluator import Evaluator

VIEWS = ("sweep", "pca", "importance", "feasibility")
LEAST_R_SQUARED = 0.5
"""Below it, an importance says more of the surrogate's luck than of the robot."""

ViewArgument = Annotated[str, typer.Argument(help="What to look at.", metavar="|".join(VIEWS))]
SamplesOption = Annotated[int, typer.Option(help="Designs sampled for pca and importance.", min=20, max=100_000)]
PointsOption = Annotated[
    int, typer.Option(help="Values of each parameter in a sweep or on a map's side.", min=2, max=1000)
]
AroundOption = Annotated[str, typer.Option(help="The design about which sweep and feasibility look.", metavar="DESIGN")]
OverOption = Annotated[str, typer.Option(help="The two parameters of the feasibility map.", metavar="NAME,NAME")]


def register(app: typer.Typer) -> None:
    """Add the commands of this module."""
    app.command()(explore)


def explore(
    view: ViewArgument,
    model: ModelOption = "printed",
    samples: SamplesOption = 1000,
    points: PointsOption = 21,
    around: AroundOption = "best-bo",
    over: OverOption = "rest_angle_deg,compression_ratio",
    study: StudyOption = None,
    seed: SeedOption = 0,
    workers: WorkersOption = None,
    dask: DaskOption = None,
    objective: ObjectiveOption = None,
    fix: FixOption = None,
    bound: BoundOption = None,
    choose: ChooseOption = None,
    workshop: WorkshopOption = "default",
    settings: SettingsOption = "default",
    engine: EngineOption = None,
    limit: LimitOption = 60.0,
    plots: PlotsOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Sweep parameters one at a time, find principal components and importance, or map what is refused.

    With --study, evaluations are kept and not repeated.
    """
    from jumpcad.design import load_design
    from jumpcad.search.evaluator import Evaluator
    from jumpcad.search.objective import find_objective
    from jumpcad.search.store import StudyStore

    if view not in VIEWS:
        raise JumpcadError(f"{view!r} is not one of the views {', '.join(VIEWS)}{did_you_mean(view, VIEWS)}")
    require_study(study)
    require_plots(plots, force)
    space, robot = make_space(fix, bound, choose, None, None, None), make_model(model, workshop, settings, engine)
    aim, centre = find_objective(objective or "fitness"), load_design(around)
    identity = {
        "model": robot.describe(), "objective": aim.name, "method": f"explore {view}", "space": space.describe(),
        "around": centre.model_dump(), "seed": seed, "versions": robot.versions(),
    }  # fmt: skip
    if view in ("pca", "importance"):
        total, run = samples, _looker(view, samples, seed)
    else:
        total = points * (space.dimension if view == "sweep" else points)
        run = _swept(centre, points) if view == "sweep" else _mapped(centre, over, points)
    with (
        make_pool(workers, dask, limit) as pool,
        StudyStore.write(study, identity) as store,
        watching(total, as_json) as watch,
    ):
        data, lines, figures = run(Evaluator(space, aim, robot, store, pool, watch=watch))
    if plots is not None:
        from jumpcad.search.figures import save

        data["pictures"] = [str(save(draw(), plots, name)) for name, draw in figures.items()]
    if as_json:
        print_json({"view": view, "model": model, "objective": aim.name} | data)
    else:
        print("\n".join(lines))


View = Callable[["Evaluator"], tuple[dict[str, Any], list[str], dict[str, Callable[[], Any]]]]
"""Runs on a campaign; returns data, lines of text, and how to draw the pictures, by name."""


def _swept(centre: "Design", points: int) -> View:
    def run(evaluator: "Evaluator") -> tuple[dict[str, Any], list[str], dict[str, Callable[[], Any]]]:
        from jumpcad.search import plots
        from jumpcad.search.explore import sweep

        sweeps = sweep(evaluator, centre, points)
        data = {
            one.parameter: [
                {"value": value, "score": row.score, "verdict": row.evaluation.verdict}
                for value, row in zip(one.values, one.rows, strict=True)
            ]
            for one in sweeps
        }
        lines = []
        for one in sweeps:
            scores = [row.score for row in one.rows if row.score is not None]
            reach = f"{min(scores):9.4f} … {max(scores):9.4f}" if scores else "never feasible       "
            lines.append(f"{one.parameter:24s}{reach}  feasible at {len(scores)} of {len(one.rows)} values")
        return {"sweeps": data}, lines, {"sweeps": lambda: plots.sweeps(sweeps, evaluator.objective)}

    return run


def _looker(view: str, samples: int, seed: int) -> View:
    def run(evaluator: "Evaluator") -> tuple[dict[str, Any], list[str], dict[str, Callable[[], Any]]]:
        from jumpcad.search import plots
        from jumpcad.search.explore import UNIFORM_NOTE, components, elite, importance, sample

        rows = sample(evaluator, samples, seed)
        if view == "importance":
            found = importance(evaluator, rows, seed)
            order = found.mean.argsort()[::-1]
            data = {
                "importance": {found.names[i]: found.mean[i] for i in order},
                "r_squared": found.r_squared,
                "designs": found.designs,
            }
            lines = [f"{found.names[i]:24s}{found.mean[i]:8.3f} ± {found.deviation[i]:.3f}" for i in order]
            lines.append(f"R² on designs held out: {found.r_squared:.3f} ({found.designs} of {len(rows)} designs jump)")
            if found.r_squared < LEAST_R_SQUARED:
                lines.append("that is too little to tell what is important: raise --samples, or narrow the bounds")
            return data, lines, {"importance": lambda: plots.importance(found)}
        best = elite(rows)
        views = {"sampled": components(evaluator, rows), "elite": components(evaluator, best)}
        data, lines = {"note": UNIFORM_NOTE}, []
        for name, view_of in views.items():
            data[name] = {"designs": view_of.designs, "shares": view_of.shares, "directions": view_of.directions}
            lines.append(f"{name:8s} ({view_of.designs} designs): " + "  ".join(f"{s:.3f}" for s in view_of.shares))
        return data, [*lines, UNIFORM_NOTE], {"pca": lambda: plots.components(views)}

    return run


def _mapped(centre: "Design", over: str, points: int) -> View:
    names = [name.strip() for name in over.split(",")]
    if len(names) != 2:
        raise JumpcadError(f"--over {over}: a map has two parameters, NAME,NAME")

    def run(evaluator: "Evaluator") -> tuple[dict[str, Any], list[str], dict[str, Callable[[], Any]]]:
        from jumpcad.search import plots
        from jumpcad.search.explore import feasibility_map

        found = feasibility_map(evaluator, centre, names[0], names[1], points)
        reasons = [[" ".join(row.evaluation.reasons) or "jump" for row in line] for line in found.rows]
        counts = Counter(reason for line in reasons for reason in line).most_common()
        data = {
            "x": {"name": found.x_name, "values": found.x},
            "y": {"name": found.y_name, "values": found.y},
            "verdicts": reasons,
        }
        lines = [f"{count:6d}  {reason}" for reason, count in counts]
        return data, lines, {"feasibility": lambda: plots.feasibility(found)}

    return run
