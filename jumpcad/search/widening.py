"""Moves the active bounds of a search: the change of the score for each alone and for all, and the wider space."""

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from typing import Any

from jumpcad.errors import JumpcadError
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.parameter import SearchParameter, active_sides
from jumpcad.search.space import Space
from jumpcad.search.trial import Trial, best_trial

SHARE = 0.25
"""Distance by which an active bound is moved at a time, over its range."""


@dataclass(frozen=True)
class Widened:
    """A bound that was moved, and the change of the score if the best design goes there with it.

    ``worth`` is None where that design is rejected, for ``reason``, or `unknown`. The ``name`` of all moved bounds
    together is `TOGETHER`.
    """

    name: str
    side: str
    value: float
    beyond: float
    worth: float | None = None
    reason: str = ""

    @property
    def unknown(self) -> bool:
        """Whether the design was not evaluated; the reason says why."""
        return self.reason == NOT_EXAMINED

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        return asdict(self)


TOGETHER = "together"
NOT_EXAMINED = "not examined: the search has no evaluations left"


def widen(evaluator: Evaluator, step: int, evaluations: int | None = None) -> list[Widened]:
    """Move the bounds on which the best design lies, evaluate it there, and widen the evaluator's space.

    At most so many `evaluations` are made; what they do not reach is only moved.

    Returns
    -------
    list of Widened
        Each bound alone and, of several, all together; empty where no bound is active, or none can move.
    """
    best = best_trial(evaluator.trials)
    if best is None:
        return []
    moved = _moved(evaluator.space, best, _allowed(evaluator, best))
    if not moved:
        return []
    changes = [{one.name: one.beyond} for one in moved]
    if len(moved) > 1:
        moved = [*moved, Widened(TOGETHER, "", 0.0, 0.0)]
        changes.append({name: value for change in changes for name, value in change.items()})
    evaluator.space = _wider(evaluator.space, moved)
    trials = evaluator.evaluate([best.variant.changed(change) for change in changes], "widen", step, limit=evaluations)
    return [_judged(one, best, trial) for one, trial in zip(moved, trials, strict=True)]


def _moved(space: Space, best: Trial, allowed: Callable[[str, float], bool]) -> list[Widened]:
    found = []
    for parameter in space.free:
        if parameter.choices:
            continue
        value = parameter.number(best.variant.value(parameter.name))
        for side, bound, beyond in active_sides(parameter, value, SHARE):
            if allowed(parameter.name, beyond):
                found.append(Widened(parameter.name, side, bound, beyond))
    return found


def _allowed(evaluator: Evaluator, best: Trial) -> Callable[[str, float], bool]:
    """Return a function that tells whether design or workshop can have a parameter's value."""

    def allowed(name: str, value: float) -> bool:
        if name not in best.workshop:
            return True
        vary = getattr(evaluator.model, "varied", None)
        try:
            return vary is None or vary({**best.workshop, name: value}) is not None
        except JumpcadError:
            return False

    return allowed


def _wider(space: Space, moved: list[Widened]) -> Space:
    sides = {(one.name, one.side): one.beyond for one in moved}

    def wider(parameter: SearchParameter) -> SearchParameter:
        lower = sides.get((parameter.name, "lower"), parameter.lower)
        upper = sides.get((parameter.name, "upper"), parameter.upper)
        return replace(parameter, lower=lower, upper=upper)

    return Space(tuple(map(wider, space.parameters)))


def _judged(one: Widened, best: Trial, trial: Trial | None) -> Widened:
    if trial is None:
        return replace(one, reason=NOT_EXAMINED)
    if trial.score is None:
        return replace(one, reason=", ".join(trial.evaluation.reasons))
    return replace(one, worth=trial.score - (best.score or 0.0))
