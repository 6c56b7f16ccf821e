"""Why a search found nothing: what rejects most of its designs, and the bounds that it meets; what to relax."""

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from decimal import ROUND_CEILING, ROUND_FLOOR, Context

from jumpcad.building.growth import built_and_checked
from jumpcad.design import PRINTED_BOUNDS, SEARCH_BOUNDS
from jumpcad.dimensions import counted
from jumpcad.drive.spring_choice import SPRING, STIFFNESS
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Change, Finding, Remedy, errors, in_words
from jumpcad.search.models import PrintedModel, RobotModel
from jumpcad.search.space import Space
from jumpcad.search.study.objective import CANNOT_BUILD
from jumpcad.search.study.requirement import Requirement
from jumpcad.search.study.trial import Trial, count_rejections, nearest_to_required
from jumpcad.workshop import load_workshop

FIRST, MOST = 40, 3
"""Designs after which it is said why none jumps; most reasons that are told."""
NUMBERS = re.compile(r"-?\d[\d.]*")


def why_required(trials: Sequence[Trial]) -> str:
    """Return what to relax, so that the nearest design is admitted, where only requirements reject all; else empty."""
    near = nearest_to_required(trials)
    if not near or any(trial.score is not None for trial in trials):
        return ""
    margins = near[0].evaluation.margins
    missed = {name: Requirement.parse(name) for name in near[0].evaluation.reasons}
    reached = ", ".join(f"{one.name} = {one.at(margins[name]):.4g}" for name, one in missed.items())
    outward = {
        name: Context(4, ROUND_CEILING if one.least is None else ROUND_FLOOR).create_decimal(one.at(margins[name]))
        for name, one in missed.items()
    }
    relaxed = " and ".join(f"{name} to {float(to):g}" for name, to in outward.items())
    return (
        f"no design keeps what is required, but {len(near)} of {counted(len(trials), 'design')} would jump and keep "
        f"all other limits; the nearest has {reached}: relax {relaxed}, or evaluate more designs"
    )


def why_rejected(trials: Sequence[Trial], space: Space, model: RobotModel) -> list[str]:
    """Return a line for each of the few reasons that reject most of some trials, of which none has a score.

    With the remedy of the design that lacks least, a number where one cures it, and the bounds that it meets.
    """
    lines = []
    for (name, text), count in Counter(cause for trial in trials for cause in _causes(trial)).most_common(MOST):
        its = [trial for trial in trials if (name, text) in _causes(trial)]
        message, remedy = _told(name, max(its, key=lambda one: one.evaluation.margins.get(name, 0.0)), model)
        met = ", ".join(_bounds(remedy, space, model))
        parts = (message, in_words(remedy), f"move what keeps it from that: {met}" if met else "")
        lines.append(f"{name}, {count} of {len(trials)}: {'; '.join(filter(None, parts))}")
    return lines


def why_hopeless(trials: Sequence[Trial], space: Space, model: RobotModel) -> list[str]:
    """Return lines that say why none of the first trials has a score."""
    if lacking := why_required(trials):
        return [lacking]
    reasons = ", ".join(f"{name} {count}" for name, count in list(count_rejections(trials).items())[:5])
    first = f"none of the first {len(trials)} designs jumps ({reasons}): there may be no robot within these bounds"
    return [first, *why_rejected(trials, space, model)]


def _causes(trial: Trial) -> list[tuple[str, str]]:
    """Return the reasons of a trial; a refused layout without a margin by what it says, whatever the numbers."""
    said = NUMBERS.sub("#", trial.evaluation.detail)
    return [(name, said if name == CANNOT_BUILD else "") for name in trial.evaluation.reasons]


def _told(name: str, trial: Trial, model: RobotModel) -> tuple[str, Remedy]:
    """Return what a design's refusal says, and its remedy, with a number where one is found for a printed robot."""
    from jumpcad.remedy_numbers import Remedies

    evaluation = trial.evaluation
    if evaluation.detail and evaluation.verdict != CANNOT_BUILD:  # it may have ended its worker
        return evaluation.detail, ""
    found: Sequence[Finding] = ()
    if isinstance(model, PrintedModel):
        model = model.varied(trial.workshop) if trial.workshop else model
        shop = model.workshop or load_workshop()
        remedies = Remedies(trial.design, shop)
        if evaluation.detail:
            try:  # a study keeps no ways out
                built_and_checked(trial.design, shop, "")
            except CannotBuildError as refusal:
                refusal = remedies.of_refusal(refusal)
                return refusal.what, refusal.ways
        found = remedies.of_findings(errors(model(trial.design).findings))
    elif not evaluation.detail:
        found = errors(model(trial.design).findings)
    return next(((one.message, one.ways) for one in found if one.name == name), (evaluation.detail, ""))


def _bounds(remedy: Remedy, space: Space, model: RobotModel) -> Iterator[str]:
    """Yield the bounds that a remedy's number lies beyond; where it has none, those narrower than the usual ones."""
    parameters = {one.name: one for one in space.parameters if not one.names}
    bounds = PRINTED_BOUNDS if isinstance(model, PrintedModel) else SEARCH_BOUNDS
    stock = model.workshop.stock_spring if isinstance(model, PrintedModel) and model.workshop else None
    for change in remedy:
        if not isinstance(change, Change):
            continue
        key, up = change.key, change.way == "raise"
        if stock and key in (STIFFNESS, SPRING):
            yield f"bought.spring = {stock.name}, whose stiffness it is"
        elif change.way in ("lower", "raise") and (one := parameters.pop(key, None)):
            usual = bounds.get(key, one)
            end, value = (one.upper, usual.upper) if up else (one.lower, usual.lower)
            value = value if change.value is None else change.value
            if (value > end) if up else (value < end):
                yield f"{key} {('at most' if up else 'at least') if one.free else 'fixed at'} {end:g}"
