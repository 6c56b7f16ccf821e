"""`jumpcad optimize`: search for the best printable robot."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import jumpcad
from jumpcad import search
from jumpcad.cli.output import ForceFlag, JsonFlag, complain, print_json, print_text, shell_quoted, status
from jumpcad.cli.searching import OptimizeOptions, PlotsOption, require_plots, watching, with_options
from jumpcad.cli.seeds import SeedsOption, most_robust, print_seeds, seeds_facts, seeds_of, study_files
from jumpcad.cli.subjects import File, Texts, argument, option
from jumpcad.dimensions import counted
from jumpcad.errors import without_controls
from jumpcad.findings import Finding, errors
from jumpcad.search.methods import DEFAULT, EVALUATIONS, LEAST_PICK, METHODS, NAMES, SEQUENCES

if TYPE_CHECKING:
    from jumpcad.search.study.evaluator import Watch

_MEANINGS = "; ".join(f"{name}: {method.meaning}" for name, method in METHODS.items())
_SEQUENCES = "; ".join(f"{name}: {first}, then {second} on its results" for name, (first, second) in SEQUENCES.items())

_METHODS = f"{_MEANINGS}; {_SEQUENCES}. Without one: {DEFAULT}. Several with --seeds."
MethodArgument = Annotated[Texts, argument(_METHODS, f"[{'|'.join(NAMES)}]…")]
EvaluationsOption = Annotated[int, typer.Option(help="Most designs to evaluate, those of the robust pick included.")]
OutputOption = Annotated[File, option("The winner's design file.", "FILE.toml", "-o", "--output", dir_okay=False)]
NO_PICK = f"none for the robust pick, which needs {4 * LEAST_PICK} in all"


@with_options
def optimize(
    *,
    context: typer.Context,
    methods: MethodArgument = None,
    evaluations: EvaluationsOption = EVALUATIONS,
    options: OptimizeOptions,
    seeds: SeedsOption = None,
    output: OutputOption = None,
    plots: PlotsOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Search for the design that jumps farthest, and pick one whose neighbours jump well too.

    Every evaluation is kept in the study file; the same command continues
    after an interruption. The exit code is 1 if every design is rejected.
    --seeds runs a search for each seed, of one method or of several that
    are compared; the design is the most robust winner of all.
    """
    from jumpcad.comparison import changes_in_words
    from jumpcad.files.outputs import require_apart, require_target
    from jumpcad.search.study.database import require_study
    from jumpcad.search.study.result import workshop_file
    from jumpcad.search.study.run import run_study

    source = context.get_parameter_source("seed")
    asked = seeds_of(seeds, methods or (), source is not None and source.name == "COMMANDLINE")
    requests = options.requests(methods or [DEFAULT], asked or [options.seed], evaluations)
    robot, space, centre = options.robot_model(), requests[0].space, requests[0].around
    base = options.study or Path(requests[0].default_name())
    paths = [base] if asked is None else study_files(requests, options.study)
    for path in paths:
        require_study(path)
    design_file = output or base.with_suffix(".toml")
    studies = {f"the study{f' {number}' if asked else ''}": path for number, path in enumerate(paths, 1)}
    outputs = {**studies, "the design file": design_file, "--plots": plots}
    if space.of_workshop:
        outputs["the workshop file"] = workshop_file(design_file)
        require_target(workshop_file(design_file), (".toml",), force)
    require_apart(outputs, options.inputs())
    require_target(design_file, (".toml",), force)
    require_plots(plots, force)
    results = []
    with options.pool() as pool:
        for request, path in zip(requests, paths, strict=True):
            with watching(evaluations, as_json) as watch:
                headed = watch if as_json else _headed(request, path, watch)
                tell = str if as_json else partial(complain, exit_code=1)  # str: to nobody
                try:
                    results.append(run_study(request, path, pool, headed, tell))
                except KeyboardInterrupt:
                    if path.exists():
                        complain(f"{path} keeps all evaluations that ended; the same command goes on", 1)
                    raise
    chosen = most_robust(results)
    result, path, facts = results[chosen], paths[chosen], seeds_facts(results, paths) if asked else None
    if result.winner is not None:
        result.save(design_file, force)
    pictures: list[Path] = []
    if plots is not None:
        with search.StudyStore.read(path) as store:
            pictures += search.plot_study(store, plots, force)
        if asked:
            from jumpcad.search.report.page import best_so_far

            pictures.append(search.save_figure(best_so_far(results), plots, "seeds", force))
    violated, before = _violated(result, robot), _before(result, robot, centre)
    if as_json:
        written = None if result.winner is None else str(design_file)
        data: dict[str, Any] = {"study": str(path), "pictures": [*map(str, pictures)], "design_file": written}
        if space.of_workshop:
            data["workshop_file"] = None if result.winner is None else str(workshop_file(design_file))
        if facts:
            data["seeds"] = facts
        data["began_with"] = before
        data["violated"] = [finding.to_dict() for finding in violated]
        print_json(data | result.to_dict())
    else:
        of_winner = result.winner is not None and result.winner.workshop
        if facts:
            print_seeds(facts, chosen, result.request.aim.name)
        used = str(workshop_file(design_file)) if of_winner else options.workshop
        made = shell_quoted(str(design_file)) + (f" --workshop {shell_quoted(used)}" if used else "")
        changed = changes_in_words(before, result.winner.evaluation.metrics) if before and result.winner else ""
        print_text(
            "optimize", result=result, design_file=str(design_file), violated=violated, made=made, counted=counted,
            changed=changed, around=options.around,
        )  # fmt: skip
    if result.winner is None:
        raise typer.Exit(1)


def _before(result: "search.Result", robot: "search.RobotModel", centre: "jumpcad.Design | None") -> dict[str, float]:
    """Return the figures of the printed robot that the search began with, whose winner may need stronger springs."""
    if centre is None or result.winner is None or robot.name != "printed":
        return {}
    with status("building the robot that it began with …"):
        return dict(robot(centre).metrics)


def _violated(result: "search.Result", robot: "search.RobotModel") -> list[Finding]:
    """Return the limits that a printed winner violates, of those that a search does not look at."""
    from jumpcad.building import build
    from jumpcad.checks import costly_findings

    if result.winner is None or not isinstance(robot, search.PrintedModel):
        return []
    with status("checking the winner …"):
        return errors(costly_findings(build(result.design, robot.varied(result.winner.workshop).workshop)))


def _headed(request: "search.Request", path: Path, watch: "Watch") -> "Watch":
    """Return a watch that says what is searched before the first trial, when the study was opened without error."""
    name, free = request.model.name, request.space.dimension
    pick = f"{request.pick} for the robust pick" if request.pick else NO_PICK
    study = f"study {without_controls(str(path))}: {request.method} on the {name} robot, free parameters: {free}"
    waiting = [f"{study}\nevaluations: {request.searched} for the search, {pick}"]

    def headed(trial: "search.Trial", computed: bool) -> None:
        if waiting:
            print(waiting.pop(), flush=True)
        watch(trial, computed)

    return headed
