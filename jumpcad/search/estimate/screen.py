"""A screen for searches of many candidates: what the guess of a candidate leaves out is not built.

A candidate is guessed from its parameters first, then from its layout too, which also tells whether its parts have
room. A candidate is left out only if it fails, or scores less than another, by more than the error of guesses of robots
that were held out. A guess is never a score: what is proposed as the best was built.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from jumpcad.blas_threads import one_thread
from jumpcad.search.estimate.corrected_estimate import Expected, Tier
from jumpcad.search.estimate.estimate import Fit, Guesser
from jumpcad.search.estimate.fitting import MARK, learned_rows
from jumpcad.search.models import RobotModel
from jumpcad.search.space import Space
from jumpcad.search.study.objective import GUESSED, SCREENED, Evaluation, Objective
from jumpcad.search.study.trial import Trial, best_trial
from jumpcad.search.study.variant import NOTHING, Key, Variant

LEAST, GROWTH = 16, 1.25
"""Robots from which on the screen works; it is fitted anew when there are so many times more."""
WORTH = 0.0005
"""Least gain, as a share of the best score, for which a robot is built: what a search ends by. With 0.003 a search
builds a third less, and ends 1 % lower (ten seeds)."""


class Screen:
    """Guesses for one search; see `Tier` for what it learns.

    Parameters
    ----------
    space, model, objective
        Of the search: a printed robot, whose workshop does not vary.
    """

    def __init__(self, space: Space, model: RobotModel, objective: Objective) -> None:
        self.space, self.model, self.objective = space, model, objective
        self.tiers: dict[bool, Tier] = {}
        """Without and with figures of the layout."""
        self._rows = self._known = 0

    def learn(self, trials: Sequence[Trial], kept: Mapping[str, Any] | None = None) -> bool:
        """Learn the robots of the search so far, with fits that were kept, if any; return whether they are new ones."""
        known = [trial for trial in trials if MARK in trial.evaluation.metrics]
        rows = learned_rows(len(known), LEAST, GROWTH)
        if best_trial(known[:rows]) is None or len(known) == self._known:
            return False
        if not self.tiers:
            guesser = Guesser.quick(self.space, self.model, self.objective, known[0])
            self.tiers = {laid: Tier(self.space, guesser, laid) for laid in (False, True)}
        new = False
        with one_thread():
            for laid, tier in self.tiers.items():
                if rows != self._rows and kept is not None and kept["rows"] == rows:
                    tier.take(Fit.from_record(kept["laid" if laid else "plain"]))
                elif rows != self._rows:
                    tier.learn(known[:rows])
                    new = True
                tier.correct(known)
        self._rows, self._known = rows, len(known)
        return new

    def to_record(self) -> dict[str, Any]:
        """Return the fits as plain data, as the study keeps them."""
        fits = {"laid" if laid else "plain": tier.fit.to_record() for laid, tier in self.tiers.items() if tier.fit}
        return {"rows": self._rows, **fits}

    def guess(self, one: Variant, laid: Mapping[str, float] = NOTHING) -> Expected | None:
        """Return what a variant would do; None where nothing is known yet, or its jump cannot be guessed."""
        return self.tiers[bool(laid)].guess(one, laid) if self.tiers else None

    def outcomes(self, variants: Iterable[Variant], best: float) -> dict[Key, Evaluation]:
        """Return the outcomes of the variants of a generation that need not be built.

        They fail for certain, or are worse than the best score, or than another of them, by more than the errors.
        """
        found, offers, held = {}, [], []
        bar = best * (1.0 + WORTH)
        for one in variants:
            if not self.model.admits(one.design):  # refused at once
                continue
            guess = self.guess(one)
            if guess is not None and leaves_out(guess, bar):
                found[one.key] = _screened(guess)
            elif refused := self.model.refused_first(one.design):
                found[one.key] = refused.bare
            elif guess is not None:
                offers.append((one, guess))
        for one, guess in sorted(offers, key=lambda offer: -(offer[1].score or 0.0)):
            if leaves_out(guess, bar):
                found[one.key] = _screened(guess)
                continue
            laid = self.model.laid_out(one)
            if isinstance(laid, Evaluation):
                found[one.key] = laid.bare
                continue
            better = self.guess(one, laid)
            if better is not None:
                held.append((one, better))
                bar = max(bar, better.least)
        return found | {one.key: _screened(guess) for one, guess in held if leaves_out(guess, bar)}


def leaves_out(guess: Expected, bar: float) -> bool:
    """Whether a guess fails for certain, or is worse than a score even at most."""
    return guess.fails or guess.most < bar


def _screened(guess: Expected) -> Evaluation:
    """Return the outcome of what is left out, with the guessed score unless it fails."""
    return Evaluation(SCREENED, {} if guess.fails or guess.score is None else {GUESSED: guess.score})
