"""`jumpcad explore`: views of the design space, before or instead of a search."""

import math
from collections import Counter
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, print_json
from jumpcad.cli.progress import watching
from jumpcad.cli.searching import (
    PlotsOption,
    SearchOptions,
    require_plots,
    with_search_options,
)
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.plural import counted

if TYPE_CHECKING:
    from jumpcad.design import Design
    from jumpcad.search.study.evaluator import Evaluator

VIEWS = ("sweep", "pca", "importance", "feasibility")

ViewArgument = Annotated[str, typer.Argument(help="What to look at.", metavar="|".join(VIEWS))]
SAMPLES, POINTS, AROUND, OVER = 1000, 21, "best-bo", "rest_angle_deg,compression_ratio"
"""Defaults of the options."""
SHOWN = 3
"""Components of the elite that the text shows; JSON has all."""
USED_BY = {
    "samples": ("pca", "importance"),
    "points": ("sweep", "feasibility"),
    "around": ("sweep", "feasibility"),
    "over": ("feasibility",),
}
"""Views that an option applies to."""
SamplesOption = Annotated[
    int | None,
    typer.Option(help="Designs sampled for pca and importance.", min=20, max=100_000, show_default=str(SAMPLES)),
]
PointsOption = Annotated[
    int | None,
    typer.Option(
        help="Values of each parameter in a sweep or along an axis of the map.",
        min=2,
        max=1000,
        show_default=str(POINTS),
    ),
]
AroundOption = Annotated[
    str | None,
    typer.Option(help="The design that sweep and feasibility vary.", metavar="DESIGN", show_default=AROUND),
]
OverOption = Annotated[
    str | None,
    typer.Option(
        help="The two parameters of the feasibility map.", metavar="NAME,NAME", show_default=OVER.replace(",", ", ")
    ),
]


@with_search_options
def explore(
    *,
    view: ViewArgument,
    samples: SamplesOption = None,
    points: PointsOption = None,
    around: AroundOption = None,
    over: OverOption = None,
    options: SearchOptions,
    plots: PlotsOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Sweep parameters one at a time, find principal components and importance, or map rejected designs.

    With --study, evaluations are kept and not repeated.
    """
    from jumpcad.design import load_design
    from jumpcad.files.outputs import require_apart
    from jumpcad.search.space import Space
    from jumpcad.search.study.database import require_study
    from jumpcad.search.study.evaluator import Evaluator
    from jumpcad.search.study.request import Request
    from jumpcad.search.study.store import StudyStore

    if view not in VIEWS:
        raise JumpcadError(f"{view!r} is not one of the views {', '.join(VIEWS)}{did_you_mean(view, VIEWS)}")
    for option, value in {"samples": samples, "points": points, "around": around, "over": over}.items():
        if value is not None and view not in USED_BY[option]:
            raise JumpcadError(f"--{option} {value}: does not apply to {view}, only to {' and '.join(USED_BY[option])}")
    samples, points, over = samples or SAMPLES, points or POINTS, OVER if over is None else over
    require_apart({"--study": options.study, "--plots": plots}, {"--around": around, **options.inputs()})
    require_study(options.study)
    require_plots(plots, force)
    robot = options.robot_model()
    space = Space.parse(options.fix or (), options.bound or (), options.choose or (), workshop=robot.workshop)
    objective = robot.aiming_at(options.objective)
    request = Request(space, robot, objective.name, own=objective if objective.code else None)
    centre = load_design(AROUND if around is None else around)
    identity = {
        "model": robot.describe(), **objective.describe(), "method": f"explore {view}", "space": space.describe(),
        "around": centre.model_dump(), "seed": options.seed, "versions": robot.versions(),
    }  # fmt: skip
    if view in ("pca", "importance"):
        total, run = samples, _sampled(view, samples, options.seed)
    else:
        counts = {one.name: len(one.choices) or points for one in space.free}
        axes = [counts.get(name.strip(), points) for name in over.split(",")]
        total = sum(counts.values()) if view == "sweep" else math.prod(axes)
        run = _swept(centre, points) if view == "sweep" else _mapped(centre, over, points)
    with (
        options.pool() as pool,
        StudyStore.write(options.study, identity) as store,
        watching(total, as_json) as watch,
    ):
        data, lines, figures = run(Evaluator(request, store, pool, watch=watch))
    if plots is not None:
        from jumpcad.search.report.figures import save_figure

        data["pictures"] = [str(save_figure(draw(), plots, name)) for name, draw in figures.items()]
    if as_json:
        print_json({"view": view, "model": options.model, "objective": objective.name} | data)
    else:
        print("\n".join(lines))


View = Callable[["Evaluator"], tuple[dict[str, Any], list[str], dict[str, Callable[[], Any]]]]
"""Evaluates the designs of a view; returns data for JSON, lines of text, and functions that draw pictures, by name."""


def _swept(centre: "Design", points: int) -> View:
    def run(evaluator: "Evaluator") -> tuple[dict[str, Any], list[str], dict[str, Callable[[], Any]]]:
        from jumpcad.search.explore import sweep
        from jumpcad.search.report import plots

        sweeps = sweep(evaluator, centre, points)
        data = {
            one.parameter: [
                {
                    "value": one.names[int(value)] if one.names else value,
                    "score": trial.score,
                    "verdict": trial.evaluation.verdict,
                    "reasons": trial.evaluation.reasons,
                }
                for value, trial in zip(one.values, one.trials, strict=True)
            ]
            for one in sweeps
        }
        lines = []
        for one in sweeps:
            scores = [trial.score for trial in one.trials if trial.score is not None]
            reach = f"{min(scores):9.4f} … {max(scores):9.4f}" if scores else "never feasible       "
            lines.append(
                f"{one.parameter:24s}{reach}  feasible at {len(scores)} of {counted(len(one.trials), 'value')}"
            )
        return {"sweeps": data}, lines, {"sweeps": lambda: plots.sweeps(sweeps, evaluator.objective, centre)}

    return run


def _sampled(view: str, samples: int, seed: int) -> View:
    def run(evaluator: "Evaluator") -> tuple[dict[str, Any], list[str], dict[str, Callable[[], Any]]]:
        from jumpcad.search.explore import LEAST_R_SQUARED, UNIFORM_NOTE, components, elite, importance, sample
        from jumpcad.search.report import plots

        trials = sample(evaluator, samples, seed)
        if view == "importance":
            found = importance(evaluator, trials, seed)
            order = found.mean.argsort()[::-1]
            data = {
                "importance": {found.names[i]: found.mean[i] for i in order},
                "deviation": {found.names[i]: found.deviation[i] for i in order},
                "r_squared": found.r_squared,
                "designs": found.designs,
            }
            lines = [f"{found.names[i]:24s}{found.mean[i]:8.3f} ± {found.deviation[i]:.3f}" for i in order]
            lines.append(
                f"R² on designs held out: {found.r_squared:.3f} ({found.designs} of {len(trials)} designs jump)"
            )
            if found.r_squared < LEAST_R_SQUARED:
                note = "R² is too low to say what is important: raise --samples, or narrow the bounds"
                data["note"] = note
                lines.append(note)
            return data, lines, {"importance": lambda: plots.importance(found)}
        best = elite(trials)
        views = {"sampled": components(evaluator, trials), "elite": components(evaluator, best)}
        data = {"note": UNIFORM_NOTE, "parameters": views["elite"].names}
        lines = ["share of the variance of each component:"]
        for name, view_of in views.items():
            data[name] = {"designs": view_of.designs, "shares": view_of.shares, "directions": view_of.directions}
            lines.append(
                f"{name:8s} ({counted(view_of.designs, 'design')}): " + "  ".join(f"{s:.3f}" for s in view_of.shares)
            )
        first = views["elite"].directions[:SHOWN]
        lines.append(f"first {counted(len(first), 'component')} of the elite:")
        lines += [
            f"{name:24s}" + "  ".join(f"{part:+.3f}" for part in first[:, i])
            for i, name in enumerate(views["elite"].names)
        ]
        return data, [*lines, UNIFORM_NOTE], {"pca": lambda: plots.components(views)}

    return run


def _mapped(centre: "Design", over: str, points: int) -> View:
    names = [name.strip() for name in over.split(",")]
    if len(names) != 2:
        raise JumpcadError(f"--over {over}: a map has two parameters, NAME,NAME")

    def run(evaluator: "Evaluator") -> tuple[dict[str, Any], list[str], dict[str, Callable[[], Any]]]:
        from jumpcad.search.explore import feasibility_map
        from jumpcad.search.report import plots

        found = feasibility_map(evaluator, centre, names[0], names[1], points)
        reasons = [[" ".join(trial.evaluation.reasons) or "jump" for trial in line] for line in found.trials]
        counts = Counter(reason for line in reasons for reason in line).most_common()
        data = {
            "x": {"name": found.x_name, "values": found.x_names or found.x},
            "y": {"name": found.y_name, "values": found.y_names or found.y},
            "verdicts": reasons,
        }
        lines = [f"{count:6d}  {reason}" for reason, count in counts]
        return data, lines, {"feasibility": lambda: plots.feasibility(found, centre)}

    return run
