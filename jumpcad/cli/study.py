"""`jumpcad study`: the content of a study file as figures, tables and pictures."""

import time
from pathlib import Path
from typing import Annotated, Any

import typer

from jumpcad import search
from jumpcad.cli.output import ForceFlag, JsonFlag, print_json, print_text
from jumpcad.cli.searching import PlotsOption, require_plots
from jumpcad.cli.subjects import File, option
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError
from jumpcad.search.methods import METHODS, SEARCH_PHASES

WATCH_S = 5.0


def study(
    files: Annotated[list[Path], typer.Argument(help="One study to show, or several to compare.", metavar="F.db…")],
    best: Annotated[int, typer.Option("--list", help="Number of best trials to show.", metavar="COUNT", min=0)] = 5,
    export: Annotated[File, option("Write all trials to FILE.csv or FILE.parquet.", "FILE")] = None,
    plots: PlotsOption = None,
    force: ForceFlag = False,
    watch: Annotated[
        bool, option("Print the progress of the search until it ends, then the study.", None, "--watch")
    ] = False,
    as_json: JsonFlag = False,
) -> None:
    """Show a study, also while it runs; compare several; export the trials."""
    from jumpcad.files.outputs import require_apart, require_target
    from jumpcad.search.study.trial import TABLES

    if len(files) > 1 and (export or plots):
        raise JumpcadError("--export and --plots are for one study; name one file")
    if watch and (len(files) > 1 or as_json):
        raise JumpcadError("--watch is for one study, and for people: name one file, and leave --json out")
    require_apart({"--export": export, "--plots": plots}, {f"the study {file}": file for file in files})
    require_plots(plots, force)
    if export is not None:
        require_target(export, TABLES, force)
    if watch:
        _watch(files[0])
    summaries = []
    for file in files:
        with search.StudyStore.read(file) as store:
            summaries.append(_summary(file, store, best))
            if export is not None:
                search.write_table(store.trials(), export, force)
            if plots is not None:
                summaries[-1]["pictures"] = [str(picture) for picture in search.plot_study(store, plots, force)]
    if as_json:
        print_json(summaries[0] if len(files) == 1 else {"studies": summaries})
    elif len(files) == 1:
        (summary,) = summaries
        method = summary["identity"]["method"]
        done = _done(summary["evaluations"], summary["planned"])
        print_text("study", **summary, done=done, shares=method in METHODS and METHODS[method].shares)
    else:
        _print_comparison(summaries)


def _watch(file: Path) -> None:
    """Print the progress of a search whenever it changes, until no search writes the study."""
    from jumpcad.search.study.database import is_written
    from jumpcad.search.study.objective import described_objective

    printed = ""
    while True:
        running = is_written(file)  # before reading, so that the last trials are read too
        with search.StudyStore.read(file) as store:
            counts, best = store.progress()
            planned = sum(stage["evaluations"] for stage in store.recall("stages", []))
            objective = described_objective(store.identity)
        searched = sum(count for phase, count in counts.items() if phase in SEARCH_PHASES)
        around = sum(counts.values()) - searched
        line = f"{_done(searched, planned)}, best {'none' if best is None else objective.shown(best)}"
        line += f", {around} around the best" if around else ""
        if line != printed:
            print(line, flush=True)
            printed = line
        if not running:
            return
        time.sleep(WATCH_S)


def _summary(file: Path, store: "search.StudyStore", best: int) -> dict[str, Any]:
    from jumpcad.search.study.store import ENDED
    from jumpcad.search.study.trial import count_rejections, feasible_trials, searched, trial_numbers

    trials, identity = store.trials(), store.identity
    proposed = searched(trials)
    top = feasible_trials(proposed)
    numbers = trial_numbers(trials)
    return {
        "study": str(file), "identity": identity,
        "planned": sum(stage["evaluations"] for stage in store.recall("stages", [])), "ended": store.recall(ENDED),
        "evaluations": len(proposed), "other_evaluations": len(trials) - len(proposed),
        "refused": count_rejections(proposed), "evaluation_time_s": sum(trial.duration_s for trial in trials),
        "best": top[0].to_dict() if top else None,
        "top": [{"trial": numbers[trial.position], **trial.to_dict()} for trial in top[:best]],
        "quarantined": [trial.to_dict() for trial in trials if trial.evaluation.verdict == "quarantined"],
        "notes": store.notes(),
    }  # fmt: skip


def _done(designs: int, planned: int) -> str:
    return f"{designs} of {counted(planned, 'design')}" if planned else counted(designs, "design")


def _print_comparison(summaries: list[dict[str, Any]]) -> None:
    from jumpcad.search.study.objective import described_objective

    for summary in summaries:
        identity, best = summary["identity"], summary["best"]
        score = "none" if best is None else described_objective(identity).shown(best["score"])
        print(
            f"{summary['study']}: best {identity['objective']} {score} in {counted(summary['evaluations'], 'design')} "
            f"({identity['method']}, {identity['model']['name']}, seed {identity['seed']})"
        )
