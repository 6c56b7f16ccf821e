"""What one step of a search learns from its trials, and again from each rehearsal of a proposal."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from jumpcad.search.acquisition import Proposal
from jumpcad.search.rehearsal import Rehearsal
from jumpcad.search.space import Space
from jumpcad.search.surrogate import NO_GUESSES, SearchPosterior
from jumpcad.search.trial import Trial
from jumpcad.transforms import Array

ROUNDS = 16
"""Most rehearsals of a proposal."""
HELD = 6
"""Of which so many hold; the best of them is evaluated."""


class Learner:
    """Makes the posterior of a step, and proposals that were rehearsed.

    Parameters
    ----------
    space, trials
        The space, and evaluated designs in it.
    rehearsal
        Where proposals are tried; None where they are not.
    thetas
        Hyperparameters of the step before.
    refit
        Whether they are fitted anew.
    """

    def __init__(
        self,
        space: Space,
        trials: Sequence[Trial],
        rehearsal: Rehearsal | None,
        thetas: Mapping[str, Any],
        refit: bool,
    ) -> None:
        self._space, self._trials, self._rehearsal = space, trials, rehearsal
        self.thetas: Mapping[str, Any] = thetas
        self._fit: Sequence[str] | None = None if refit else ()
        self.tried: list[Array] = []
        self._proposed: list[Array] = []
        if rehearsal is not None:
            rehearsal.learn(trials)

    def propose(self, ask: Callable[..., Proposal | None]) -> Proposal | None:
        """Return a proposal of `ask`, which is called with a posterior and the points that were rehearsed for it.

        Its own mean is then believed, as if it had been measured, until the step is over.
        """
        held: list[Array] = []
        proposal = ask(self._learned(), rehearsed=held)
        for _ in range(ROUNDS if self._rehearsal else 0):
            assert self._rehearsal is not None
            if proposal is None or len(held) == HELD or any((proposal.unit == point).all() for point in held):
                break
            self.tried.append(proposal.unit)
            if self._rehearsal.holds(proposal.variant):
                held.append(proposal.unit)
            proposal = ask(self._learned(), rehearsed=held)
        if proposal is not None:
            self._proposed.append(proposal.unit)
        return proposal

    def _learned(self) -> SearchPosterior:
        """Return the posterior of the trials and all rehearsals, with what was proposed believed."""
        trials, guesses = list(self._trials), NO_GUESSES
        if self._rehearsal is not None:
            trials += self._rehearsal.failures(self._trials, self.tried)
            guesses = self._rehearsal.guesses(self._trials, self.tried)
        posterior = SearchPosterior.from_trials(self._space, trials, self.thetas, self._fit, guesses)
        self.thetas, self._fit = {**self.thetas, **posterior.thetas}, ()
        for point in self._proposed:
            posterior = posterior.condition_on(point)
        return posterior
