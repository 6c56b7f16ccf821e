"""A tier of the screen: what its errors are, measured on robots whose guesses are known to miss by so much."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.quick import SPACE

from jumpcad.design import Design
from jumpcad.findings import Finding
from jumpcad.search.estimate.corrected_estimate import (
    BESIDE,
    CAREFUL,
    LESS,
    MORE,
    PAIRS,
    TRIED,
    Expected,
    Tier,
    log_ratio,
)
from jumpcad.search.estimate.estimate import Guess
from jumpcad.search.estimate.fitting import LAID, MARK
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial
from jumpcad.search.study.variant import Variant
from jumpcad.transforms import Array

Guessing = Callable[[Design], Guess | None]
FIGURES = {MARK: 1.0, "body_mass_kg": 0.1}


def trials_along_a_line(count: int) -> list[Trial]:
    """Return robots of which the first is the best and each next is farther from it; all keep 1 mm of reach."""

    def of(place: int) -> Trial:
        design = SPACE.to_variant(np.full(SPACE.dimension, 0.5 + 0.4 * place / count)).design
        reach = Finding("reach", "info", 1.0, "mm", "", "")
        return Trial("ga", 0, place, design, Evaluation("jump", FIGURES, (reach,)), 2.0 - 0.01 * place, "m", 1.0)

    return [of(place) for place in range(count)]


class Known:
    """Guesses that are known."""

    def __init__(self, guessing: Guessing) -> None:
        self.guessing = guessing

    def __call__(self, one: Variant, *_: object) -> Guess | None:
        return self.guessing(one.design)

    def from_columns(self, design: Design, _: object) -> Guess | None:
        return self.guessing(design)


def learned(trials: list[Trial], guessing: Callable[[int], Guess | None]) -> Tier:
    """Return a tier that learned robots whose guesses are told by their number."""
    number = {trial.design: place for place, trial in enumerate(trials)}
    tier = Tier(SPACE, Known(lambda design: guessing(number[design])), laid=False)  # type: ignore[arg-type]
    tier.learn(trials)
    return tier


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_margin_s_error_is_twice_the_largest_miss_of_the_nearest_robots(sign: float) -> None:
    """The seventh misses by 0.3 mm, all others by 0.1 mm; one that is too far away to be tried misses by 9 mm."""

    def guess(place: int) -> Guess:
        miss = {6: 0.3, TRIED: 9.0}.get(place, 0.1)
        return Guess(1.0, {"reach": 1.0 - sign * miss})

    errors = learned(trials_along_a_line(TRIED + 1), guess).fit.errors
    assert CAREFUL == 2.0
    assert errors["reach"] == pytest.approx(2.0 * 0.3)


def test_limits_that_robots_missed_are_learned_with_their_figures() -> None:
    """Four of five robots keep no reach: its margin is fitted, as the masses are."""
    missed = Evaluation("jump", FIGURES, (Finding("reach", "error", -0.5, "mm", "", ""),))
    trials = [replace(one, evaluation=missed) if one.place % 5 else one for one in trials_along_a_line(BESIDE)]
    fitted = learned(trials, lambda _: Guess(1.0, {})).fit.coefficients
    assert {"margin reach", "log body_mass_kg"} <= set(fitted)


def test_where_guesses_miss_alike_a_score_is_as_well_known_as_the_robots_say() -> None:
    """All score a third more than guessed: the process knows it, and what is left of the error is next to nothing."""
    trials = trials_along_a_line(BESIDE)
    tier = learned(trials, lambda place: Guess(trials[place].score / (4.0 / 3.0), {}))  # type: ignore[operator]
    tier.correct(trials)
    found = tier.guess(trials[0].variant, {})
    assert found is not None
    assert found.score == pytest.approx(trials[0].score, rel=1e-6)
    assert found.least == pytest.approx(found.score, rel=1e-6) == found.most


def test_nineteen_of_twenty_robots_score_no_more_and_nineteen_no_less_than_the_errors_say(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Guesses miss by 6 deviations too much to 13 too little, and what they miss is not learned."""
    flat = SimpleNamespace(predict=lambda _: (np.zeros(1), np.full(1, 0.03)), scatter=0.04)
    monkeypatch.setattr(Tier, "_ratios_of", lambda *_: flat)
    trials = trials_along_a_line(TRIED)
    misses = np.arange(-6.0, 14.0)

    def errors(misses: Array) -> Mapping[str, float]:
        known = [Guess(one.score * np.exp(-0.05 * miss), {}) for one, miss in zip(trials, misses, strict=True)]
        return learned(trials, lambda place: known[place]).fit.errors

    found, much_too_much, much_too_little = errors(misses), errors(misses - 30.0), errors(misses + 30.0)
    assert np.mean(misses <= found[MORE]) == np.mean(misses >= found[LESS]) == 0.95
    assert much_too_much[MORE] == much_too_little[LESS] == 0.0  # a guess is never outside its own errors


@pytest.mark.parametrize(("count", "known"), [(PAIRS, False), (PAIRS + 1, True)])
def test_of_a_few_robots_no_error_is_told(count: int, known: bool) -> None:
    """Each is held out, so that there must be one more. Without an error a guess bars nothing and passes every bar."""
    trials = trials_along_a_line(count)
    tier = learned(trials, lambda place: Guess(trials[place].score, {}))
    tier.correct(trials)
    assert (MORE in tier.fit.errors) is known
    found = tier.guess(trials[0].variant, {})
    if not known:
        assert found == Expected(trials[0].score, 0.0, np.inf, False)


def test_fewer_robots_than_figures_tell_what_guesses_miss() -> None:
    """Eight of which the layout is known too: all score a third more than guessed, and so do others beside them."""
    trials = [
        replace(trial, evaluation=replace(trial.evaluation, metrics=FIGURES | dict.fromkeys(LAID, 1.0)))
        for trial in trials_along_a_line(PAIRS)
    ]
    scores = {trial.design: trial.score for trial in trials}
    known = Known(lambda design: Guess(0.75 * scores[design], {}))  # type: ignore[operator]
    tier = Tier(SPACE, known, laid=True)  # type: ignore[arg-type]
    tier.correct(trials)
    assert tier._process is not None
    place = tier._place(trials[3].variant, trials[3].evaluation.metrics)
    assert len(place) == SPACE.dimension + len(LAID) > PAIRS
    mean, _ = tier._process.predict(place[None])
    assert mean == pytest.approx(np.log(4.0 / 3.0), abs=1e-6)


def test_what_cannot_be_guessed_tells_no_error() -> None:
    trials = trials_along_a_line(PAIRS + 3)
    tier = learned(trials, lambda place: None if place % 3 == 0 else Guess(None, {"reach": 0.5}))
    assert tier.fit.errors == {"reach": pytest.approx(2.0 * 0.5)}
    assert tier.guess(trials[0].variant, {}) is None
    assert tier.guess(trials[1].variant, {}) == Expected(None, 0.0, 0.0, False)


@pytest.mark.parametrize(
    ("exact", "guessed", "ratio"),
    [(2.0, 1.0, np.log(2.0)), (1.0, 2.0, -np.log(2.0)), (None, 1.0, None), (1.0, None, None), (0.0, 1.0, None)],
)
def test_the_ratio_of_exact_to_guessed(exact: float | None, guessed: float | None, ratio: float | None) -> None:
    assert log_ratio(exact, guessed) == (ratio if ratio is None else pytest.approx(ratio))
