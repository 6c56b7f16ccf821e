"""`jumpcad explore`: views of the design space, before or instead of a search."""

import math
from collections import Counter
from collections.abc import Callable
from functools import partial
from typing import Annotated, Any

import typer

import jumpcad
from jumpcad import search
from jumpcad.cli.output import ForceFlag, JsonFlag, answer, print_text
from jumpcad.cli.searching import PlotsOption, SearchOptions, require_plots, watching, with_options
from jumpcad.cli.subjects import Text, option
from jumpcad.dimensions import counted, unit_of_key
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean

VIEWS = ("sweep", "pca", "importance", "feasibility")

SAMPLES, POINTS, AROUND, OVER = 1000, 21, "best-bo", "rest_angle_deg,compression_ratio"
"""Defaults of the options."""
VARYING = ("sweep", "feasibility")
USED_BY = {"samples": ("pca", "importance"), "points": VARYING, "around": VARYING, "over": ("feasibility",)}
"""Views that an option applies to."""
ALONG = "Values of each parameter in a sweep or along an axis of the map."


@with_options
def explore(
    *,
    view: Annotated[str, typer.Argument(help="What to look at.", metavar="|".join(VIEWS))],
    samples: Annotated[
        int | None, option("Designs sampled for pca and importance.", shown=str(SAMPLES), min=20, max=100_000)
    ] = None,
    points: Annotated[int | None, typer.Option(help=ALONG, min=2, max=1000, show_default=str(POINTS))] = None,
    around: Annotated[Text, option("The design that sweep and feasibility vary.", "DESIGN", shown=AROUND)] = None,
    over: Annotated[
        Text, option("The two parameters of the feasibility map.", "NAME,NAME", shown=OVER.replace(",", ", "))
    ] = None,
    options: SearchOptions,
    plots: PlotsOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Sweep parameters one at a time, find principal components and importance, or map rejected designs.

    With --study, evaluations are kept and not repeated.
    """
    from jumpcad.files.outputs import require_apart
    from jumpcad.search.study.database import require_study

    if view not in VIEWS:
        raise JumpcadError(f"{view!r} is not one of the views {', '.join(VIEWS)}{did_you_mean(view, VIEWS)}")
    for name, value in {"samples": samples, "points": points, "around": around, "over": over}.items():
        if value is not None and view not in USED_BY[name]:
            raise JumpcadError(f"--{name} {value}: does not apply to {view}, only to {' and '.join(USED_BY[name])}")
    samples, points, over = samples or SAMPLES, points or POINTS, over or OVER
    require_apart({"--study": options.study, "--plots": plots}, {"--around": around, **options.inputs()})
    require_study(options.study)
    require_plots(plots, force)
    robot = options.robot_model()
    space = options.space(robot)
    request = search.Request(space, robot, options.objective, "ga")
    robot, objective = request.model, request.aim
    centre = jumpcad.load_design(around or AROUND)
    identity = {
        "model": robot.describe(), **objective.describe(), "method": f"explore {view}", "space": space.describe(),
        "around": centre.model_dump(), "seed": options.seed, "versions": robot.versions(),
    }  # fmt: skip
    if view in ("pca", "importance"):
        total, run = samples, partial(_sampled, view=view, samples=samples, seed=options.seed)
    else:
        counts = {one.name: len(one.choices) or points for one in space.free}
        names = [name.strip() for name in over.split(",")]
        if len(names) != 2:
            raise JumpcadError(f"--over {over}: a map has two parameters, NAME,NAME")
        total = sum(counts.values()) if view == "sweep" else math.prod(counts.get(name, points) for name in names)
        view_of = _swept if view == "sweep" else partial(_mapped, names=names)
        run = partial(view_of, centre=centre, points=points)
    with (
        options.pool() as pool,
        search.StudyStore.write(options.study, identity) as store,
        watching(total, as_json) as watch,
    ):
        data, figures = run(search.Evaluator(request, store, pool, watch=watch))
    if plots is not None:
        data["pictures"] = [str(search.save_figure(draw(), plots, name, force)) for name, draw in figures.items()]
    data = {"view": view, "model": options.model, "objective": objective.name} | data
    reasons = Counter(reason for line in data.get("verdicts", ()) for reason in line)
    words = {"base": around or AROUND, "total": total, "counts": reasons.most_common(), "counted": counted}
    answer(as_json, data, print_text, "explore", **data, **words)


Found = tuple[dict[str, Any], dict[str, Callable[[], Any]]]
"""Data for JSON and text, and functions that draw pictures, by name."""


def _swept(evaluator: "search.Evaluator", centre: "jumpcad.Design", points: int) -> Found:
    sweeps = search.sweep(evaluator, centre, points)
    data = {
        one.parameter: [
            {"value": one.names[int(value)] if one.names else value, "score": trial.score,
             "verdict": trial.evaluation.verdict, "reasons": trial.evaluation.reasons}
            for value, trial in zip(one.values, one.trials, strict=True)
        ]
        for one in sweeps
    }  # fmt: skip
    words = {"units": {one.parameter: unit_of_key(one.parameter) for one in sweeps},
             "score_unit": evaluator.objective.unit}  # fmt: skip
    return {"sweeps": data, **words}, {"sweeps": lambda: search.plots.sweeps(sweeps, evaluator.objective, centre)}


def _sampled(evaluator: "search.Evaluator", view: str, samples: int, seed: int) -> Found:
    from jumpcad.search.explore import LEAST_R_SQUARED, UNIFORM_NOTE, elite

    trials = search.sample(evaluator, samples, seed)
    if view == "importance":
        found = search.importance(evaluator, trials, seed)
        order = found.mean.argsort()[::-1]
        means, deviations = ({found.names[i]: of[i] for i in order} for of in (found.mean, found.deviation))
        data = {"importance": means, "deviation": deviations, "r_squared": found.r_squared, "designs": found.designs}
        if found.r_squared < LEAST_R_SQUARED:
            data["note"] = "R² is too low to say what is important: raise --samples, or narrow the bounds"
        return data, {"importance": lambda: search.plots.importance(found)}
    best = elite(trials)
    views = {"sampled": search.components(evaluator, trials), "elite": search.components(evaluator, best)}
    data = {"note": UNIFORM_NOTE, "parameters": views["elite"].names}
    for name, view_of in views.items():
        data[name] = {"designs": view_of.designs, "shares": view_of.shares, "directions": view_of.directions}
    return data, {"pca": lambda: search.plots.components(views)}


def _mapped(evaluator: "search.Evaluator", centre: "jumpcad.Design", names: list[str], points: int) -> Found:
    found = search.feasibility_map(evaluator, centre, names[0], names[1], points)
    reasons = [[" ".join(trial.evaluation.reasons) or "jump" for trial in line] for line in found.trials]
    x = {"name": found.x_name, "values": found.x_names or found.x}
    y = {"name": found.y_name, "values": found.y_names or found.y}
    return {"x": x, "y": y, "verdicts": reasons}, {"feasibility": lambda: search.plots.feasibility(found, centre)}
