"""What one step of a search learns from its trials, and again from each dry run of a proposal.

The score of a printed robot has steps of a per cent, where a section grows or a part takes another place. The processes
smooth over them, and promise nothing where a ridge of steps goes on. Points a step away along each axis (compass
search: Kolda, Lewis and Torczon, SIAM Review 2003) and some aslant are estimated, and the best of them are evaluated.
The score has many hills, too: others are bred of the best estimates, far from all robots.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from jumpcad.search.propose.acquisition import DIGITS, HELD_BONUS, Proposal
from jumpcad.search.propose.dry_run import DryRun
from jumpcad.search.propose.initial_designs import APART, evolved
from jumpcad.search.propose.posterior import SearchPosterior
from jumpcad.search.space import Space, apart
from jumpcad.search.study.trial import Trial, best_trial
from jumpcad.search.study.variant import NOTHING, Key, Variant
from jumpcad.transforms import Array

ROUNDS = 8
"""Most dry runs of a proposal."""
HELD = 4
"""Of which so many hold; the best of them is evaluated."""
AROUND, LEAP = 0.2, 0.02
"""How far beside a best its neighbours along the axes are tried, in scales of the space, and the share by which it must
be better than the last one whose neighbours were; judgement. A search that follows small gains along a bound does not
see what another axis is worth: see docs/decisions/default-search.md."""
WORTH = 0.001
"""Least gain, as a share of the best score, that a further dry run must promise once one holds; judgement."""
STEP = 0.02
"""Distance of a neighbour, in scales of the space; judgement: 0.8 % of a link's length, 1.4° of the toes' angle."""
DRAWN, DRAWN_STEP = 8, 0.04
"""Points that are drawn besides, and how far away each coordinate typically is; judgement: ridges run aslant."""
PARENTS, FAR_BRED, AWAY, LAID_OUT = 16, 6, 0.05, 16
"""Best estimates of which others are bred, for how many generations far from robots, and how far; points with the best
rough estimates that are tried; judgement."""
WITHIN = 0.005, 0.1
"""How much worse than the best's an estimate may be, near it and far away; judgement: near, what it is wrong by."""


class ProposalLoop:
    """Makes the posterior of a step from trials in a space, and proposals; where there is a dry run, these are tried.

    `thetas` are the hyperparameters of the step before, to `refit` or not; for `score_of` see `SearchPosterior`.
    """

    def __init__(
        self, space: Space, trials: Sequence[Trial], dry_run: DryRun | None, thetas: Mapping[str, Any], refit: bool,
        score_of: Callable[[Trial], float | None] = lambda trial: trial.score,
    ) -> None:  # fmt: skip
        self._space, self._trials, self._dry_run = space, trials, dry_run
        self.thetas, self._refit, self._score_of = thetas, refit, score_of
        self.tried: list[Array] = []
        self._proposed: list[Array] = []
        self._failed: set[Key] = set()

    @property
    def _ready(self) -> DryRun | None:
        """The dry run, once it estimates."""
        return self._dry_run if self._dry_run is not None and self._dry_run.estimator.ready else None

    def propose(self, ask: Callable[..., Proposal | None], best: float) -> Proposal | None:
        """Return a proposal of `ask`, which is called with a posterior and the points that held in a dry run for it.

        Its own mean is then believed until the step is over. `best` is the score to be improved.
        """
        held: list[Proposal] = []
        self._look_around()
        posterior = self._learned()
        proposal = ask(posterior, held=[])
        for _ in range(ROUNDS if self._dry_run else 0):
            assert self._dry_run is not None
            if proposal is None:
                proposal = _best_of(held, posterior, best) if held else None
                break
            if any((proposal.unit == one.unit).all() for one in held):
                break
            if len(held) == HELD or (held and proposal.promised_gain(best) < WORTH):
                proposal = _best_of(held, posterior, best)
                break
            self.tried.append(proposal.unit)
            holds = self._dry_run.failure(proposal.variant) is None
            posterior = self._learned()
            if holds:
                held.append(proposal)
                before, proposal = proposal.log_value, _best_of([proposal], posterior, best)
                if proposal.log_value + HELD_BONUS >= before:
                    break
            else:
                self._failed.add(proposal.variant.key)
            proposal = ask(posterior, held=[one.unit for one in held])
        else:
            proposal = _best_of(held, posterior, best) if held else proposal
        if proposal is not None:
            self._proposed.append(proposal.unit)
        return proposal

    def beside(
        self, trials: Sequence[Trial], admits: Callable[[Variant], bool], generator: np.random.Generator, far: bool
    ) -> Proposal | None:
        """Return what lies near the best of some trials, or `far` from all robots, with the best estimate.

        None of a worse one than the best's by more than `WITHIN`. `admits` tells which variants are new.
        """
        best, dry_run = best_trial(trials), self._ready
        if dry_run is None or best is None:
            return None
        points = [] if far else neighbours(self._space, best, generator)
        points += [*self._bred(dry_run, FAR_BRED if far else 1, generator)]
        if far:
            robots = np.array([*(self._space.to_unit(one.variant) for one in self._trials), *self._proposed])
            points = [one for one in points if np.abs(robots - one).max(axis=1).min() > AWAY]
        new = [(point, one) for point in points if admits(one := self._space.to_variant(point))]
        roughly = dry_run.rough([point for point, _ in new])
        new = [new[index] for index in np.argsort(-roughly, kind="stable")[:LAID_OUT]]
        dry_run.look_at(one for _, one in new)
        offers, before = [], {one.key for one in dry_run.tried(self._trials, self.tried)}
        for point, one in new:
            self.tried += [] if one.key in before else [point]
            offers.append((dry_run.score(one) or 0.0, Proposal(one, point, 0.0, 0.0)))
        score, found = max(offers, key=lambda offer: offer[0], default=(0.0, None))
        least = (1.0 - WITHIN[far]) * (dry_run.score(best.variant, required=False) or math.inf)
        if found is None or score < least:
            return None
        found = _best_of([found], self._learned(), best.score or 0.0)
        self._proposed.append(found.unit)
        return found

    def _bred(self, dry_run: DryRun, generations: int, generator: np.random.Generator) -> Array:
        """Return points (n, d) that are bred of the best estimates, of several hills; few estimates breed nothing."""
        known = dry_run.estimates(self._trials, self.tried).values()
        held = [(score, point) for point, score in known if dry_run.failure(self._space.to_variant(point)) is None]
        held.sort(key=lambda one: -one[0])
        chosen = [held[index] for index in apart([point for _, point in held], APART, PARENTS)]
        if len(chosen) < 4:
            return np.empty((0, self._space.dimension))
        points, scores = np.array([point for _, point in chosen]), np.array([score for score, _ in chosen])
        return evolved(points, scores, generations, self._space, dry_run.rough, generator)[0]

    def holds(self, proposal: Proposal) -> bool:
        """Whether a proposal holds in a dry run, of which it is learned."""
        if self._dry_run is None or self._dry_run.failure(proposal.variant) is None:
            return True
        self.tried.append(proposal.unit)
        return False

    def _look_around(self) -> None:
        """Try the neighbours of what the last step found, if it is a leap."""
        dry_run = self._ready
        if dry_run is None or self.tried:
            return
        (leap, found), last = (0.0, None), self._trials[-1]
        for trial in self._trials:
            if trial.score is not None and trial.score > leap * (1.0 + LEAP):
                leap, found = trial.score, trial
        if found is None or found.position[:3] != last.position[:3]:
            return
        centre = self._space.to_unit(found.variant)
        numbers = np.eye(self._space.dimension)[np.array(self._space.categories) == 0]
        beside = np.clip(centre + AROUND * self._space.scale * np.vstack([-numbers, numbers]), 0.0, 1.0)
        free = (np.abs(beside - centre) / self._space.scale).max(axis=1) > 0.5 * AROUND  # else a bound is too near
        self.tried += list(self._space.snap(beside[free].round(DIGITS)))
        dry_run.look_at(map(self._space.to_variant, self.tried))

    def may_hold(self, variant: Variant) -> bool:
        """Whether a variant may be proposed: it has not failed in a dry run of this step, nor has no room."""
        return variant.key not in self._failed and not (self._dry_run and self._dry_run.estimator.refuses(variant))

    def _learned(self) -> SearchPosterior:
        """Return the posterior of the trials and all dry runs, with what was proposed believed."""
        trials, guesses = list(self._trials), NOTHING
        if self._dry_run is not None:
            trials += self._dry_run.failures(self._trials, self.tried)
            guesses = self._dry_run.estimates(self._trials, self.tried)
        posterior = SearchPosterior.from_trials(self._space, trials, self.thetas, self._refit, guesses, self._score_of)
        self.thetas, self._refit = {**self.thetas, **posterior.thetas}, False
        for point in self._proposed:
            posterior = posterior.condition_on(point)
        return posterior


def _best_of(proposals: Sequence[Proposal], posterior: SearchPosterior, best: float) -> Proposal:
    """Return the proposal with the largest acquisition, as the posterior sees it now."""
    units = np.array([one.unit for one in proposals])
    improvement, feasible = posterior.log_improvement(units, best), posterior.log_feasible(units)
    chosen = int((improvement + feasible).argmax())
    return replace(proposals[chosen], log_improvement=float(improvement[chosen]), log_feasible=float(feasible[chosen]))


def neighbours(space: Space, best: Trial, generator: np.random.Generator) -> list[Array]:
    """Return points (d,) near a trial that differ along the axes of numbers on whose bounds it does not lie.

    A step away along each of them, both ways, and `DRAWN` that are drawn at such a distance.
    """
    centre, half = space.to_unit(best.variant), 0.5 * STEP * space.scale
    inside = (centre > half) & (centre < 1.0 - half) & (np.array(space.categories) == 0)
    ways = STEP * np.diag(space.scale)[inside]
    drawn = DRAWN_STEP * space.scale * inside * generator.standard_normal((DRAWN, space.dimension))
    return list(space.snap(np.clip(centre + np.vstack([ways, -ways, drawn]), 0.0, 1.0).round(DIGITS)))
