"""What `jumpcad optimize` prints of a search's result."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from jumpcad.cli.output import escaped, shell_quoted
from jumpcad.plural import counted

if TYPE_CHECKING:
    from jumpcad.findings import Finding
    from jumpcad.search.study.result import Result

SHOWN = 10
"""Candidates that are printed; --json has all of them."""


def print_result(
    result: "Result", design_file: Path, violated: "Sequence[Finding]" = (), workshop: str | None = None
) -> None:
    """Print how the search went, its best design, the winner of the pick and its bounds, and what to do next.

    Parameters
    ----------
    design_file
        Where the winner was written.
    violated
        Limits of a printed robot that the winner violates, of those that a search does not look at.
    workshop
        What the user gave as the workshop.
    """
    _print_course(result)
    if result.best is None or result.winner is None:
        print("no design jumps: widen the bounds, raise --evaluations, or see the reasons above")
        return
    request = result.request
    if request.is_front:
        cost = request.cost
        print(f"\n{request.objective} against {cost.figure.meaning}; hypervolume {result.hypervolume:.4f}")
        for trial in result.front:
            print(f"  {cost.shown(cost.of(trial)):8.4f} {cost.figure.unit}  {request.aim.shown(trial.score or 0.0)}")
    print(f"\nbest {request.objective} {request.aim.shown(result.best.score or 0.0)}")
    _print_candidates(result)
    print(f"\n{escaped(str(design_file))}: {request.objective} {request.aim.shown(result.score)}")
    for name, value in result.design.model_dump().items():
        print(f"  {name:24s}{value:12.5g}")
    for key, value in result.winner.workshop.items():
        print(f"  {key:24s}" + (f"{value or repr(value):>12s}" if isinstance(value, str) else f"{value:12.5g}"))
    _print_bounds(result)
    _print_next(result, design_file, violated, workshop)


def _print_course(result: "Result") -> None:
    """Print how many designs were evaluated, and why the search ended."""
    request = result.request
    more = result.evaluations - len(result.trials)
    around = f", and {_of(more, request.pick)} for the robust pick" if more else ""
    print(f"{counted(len(result.trials), 'design')} evaluated{around}; rejected: {_counted(result.rejected)}")
    if result.converged:
        print(
            f"ended before {request.searched}: in its last steps less than {request.until_percent:g} % of the best "
            "score was gained; --until 0 goes on"
        )
    if len(result.trials) >= request.space.size:
        print("these are all designs of the space")
    for note in result.notes:
        print(f"note: {note}")


def _print_candidates(result: "Result") -> None:
    """Print the scores of the robust pick's candidates and of their neighbours."""
    if result.candidates:
        print(f"score that nine of ten neighbours reach, parameters ±1 %, or {result.request.making.words}:")
        print(f"  {'itself':>10s}{'±1 %':>10s}{'as made':>10s}  neighbours, rejected")
    for one in result.candidates[:SHOWN]:
        scores = (one.trial.score or 0.0, one.parameters_score, one.print_score)
        print(f"  {''.join(f'{score:10.4f}' for score in scores)}  {one.neighbours:10d}, {_counted(one.rejections)}")


def _print_bounds(result: "Result") -> None:
    """Print what lies beyond the bounds on which the winner lies."""
    for bound in result.bounds:
        change = f"is {bound.reason}" if bound.unknown else f"is rejected: {bound.reason}"
        if bound.worth is not None:
            change = f"changes the score by {bound.worth:+.4f}"
        print(f"at its {bound.side} bound: {bound.name} = {bound.value:g}; {bound.beyond:g} {change}")


def _print_next(result: "Result", design_file: Path, violated: "Sequence[Finding]", workshop: str | None) -> None:
    """Print the violated limits, and the command that builds the winner or checks it."""
    from jumpcad.search.study.result import workshop_file

    of_winner = result.winner is not None and result.winner.workshop
    used = str(workshop_file(design_file)) if of_winner else workshop
    made = shell_quoted(str(design_file)) + (f" --workshop {shell_quoted(used)}" if used else "")
    for finding in violated:
        print(f"error: {finding.name}: {finding.message}; {finding.remedy}")
    if violated:
        print(f"\nnext: jumpcad check {made}: do not build it as it is; a search does not look at these limits")
    else:
        print(f"\nnext: jumpcad build {made}")


def _of(spent: int, most: int) -> str:
    """Return a number of evaluations; of how many, where some are left."""
    return f"{spent} of {most}" if spent < most else str(spent)


def _counted(reasons: dict[str, int]) -> str:
    return ", ".join(f"{name} {count}" for name, count in reasons.items()) or "none"
