"""`Evaluator`: the evaluations of one search, each read from the study file if it is there, computed if not."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from jumpcad.arguments import check_arguments
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.search.models import RobotModel
from jumpcad.search.space import Space
from jumpcad.search.study.objective import QUARANTINED, Evaluation, Objective
from jumpcad.search.study.pool import Pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial, in_order
from jumpcad.search.study.variant import NOTHING, Key, Variant

Watch = Callable[[Trial, bool], None]
"""Called with every trial, and whether it was computed now (or read from the study file)."""


class Evaluator:
    """Evaluates designs for the methods.

    A search is a deterministic function of its seed and of the trials it has seen. It resumes by being run again:
    proposals that are in the study file are read, the others computed. It may learn from the trials of a `prior` study.
    `expired` says whether evaluations or time are spent; who proposes designs asks before every step.
    """

    @check_arguments
    def __init__(
        self, request: Request, store: StudyStore, pool: Pool, prior: Sequence[Trial] = (),
        watch: Watch = lambda trial, computed: None, expired: Callable[[], bool] = lambda: False,
    ) -> None:  # fmt: skip
        self.request, self.store, self.expired = request, store, expired
        self._pool, self._watch = pool, watch
        self.shared = pool.shared
        """Returns what a function returns for each argument; workers of the search take part."""
        held = store.trials()
        self._finished = {trial.key: trial for trial in held}
        self._taken = {trial.position: trial.key for trial in held}
        self._seen: dict[Key, Trial] = {}
        self.prior = list(prior)
        self._known = {trial.key for trial in self.prior}
        pool.notice = store.note

    @property
    def space(self) -> Space:
        return self.request.space

    @property
    def objective(self) -> Objective:
        return self.request.aim

    @property
    def model(self) -> RobotModel:
        return self.request.model

    @property
    def trials(self) -> list[Trial]:
        """All trials of this search so far, in order."""
        return list(self._seen.values())

    def unrequired(self, trial: Trial) -> float | None:
        """Return the score of a trial, whatever is required; None of what is rejected otherwise."""
        return self.objective.unrequired(trial.evaluation) if trial.score is None else trial.score

    def admits(self, one: Design | Variant) -> bool:
        """Whether a design or variant is new, also to the prior, and the model admits it without an evaluation."""
        key = (variant := Variant.of(one)).key
        return key not in self._seen and key not in self._known and self.model.admits(variant.design)

    def holds(self, variant: Variant) -> bool:
        """Whether a trial of a variant is there, in this run or in the study file."""
        return variant.key in self._finished

    def finished(self, phase: str, step: int, count: int, run: int = 0) -> list[Trial] | None:
        """Read a whole step of `count` trials from the study file; None if one of them is missing."""
        at = phase, run, step
        trials = in_order(trial for trial in self._finished.values() if trial.position[:3] == at)
        if len(trials) != count:
            return None
        for trial in trials:
            self._add(trial, computed=False)
        return trials

    def evaluate(
        self, designs: Sequence[Design | Variant], phase: str, step: int, limit: int | None = None,
        proposals: Sequence[Mapping[str, Any]] | None = None, left_out: Mapping[Key, Evaluation] = NOTHING,
        run: int = 0,
    ) -> list[Trial | None]:  # fmt: skip
        """Return the trials of designs, computing those that are not finished; at most `limit` new ones.

        Of variants that are `left_out`, by their keys, the outcome is given. If the run is interrupted or fails
        meanwhile, the finished trials are kept.
        """
        variants = [Variant.of(design) for design in designs]
        fresh: dict[Key, int] = {}
        for index, key in enumerate(variant.key for variant in variants):
            if key not in self._seen and key not in fresh and (limit is None or len(fresh) < limit):
                fresh[key] = index
        places = {key: (phase, run, step, place) for place, key in enumerate(fresh)}
        if any(self._taken.get(place, key) != key for key, place in places.items()):
            raise JumpcadError(
                f"{self.store.path}: this search proposes other designs than the study holds; start a new study"
            )

        def trial_of(key: Key, found: Evaluation, score: float | None) -> Trial:
            one, (*_, place) = variants[fresh[key]], places[key]
            return Trial(
                phase, step, place, one.design, found.bare, score, self.model.digest, 0.0, {}, one.workshop, run
            )

        new = [key for key in fresh if key not in self._finished]
        done = [trial_of(key, left_out[key], None) for key in new if key in left_out]
        missing = [key for key in new if key not in left_out]
        try:
            for outcome in self._pool.evaluate(self.model, [variants[fresh[key]] for key in missing]):
                key = missing[outcome.index]
                trial = trial_of(key, outcome.evaluation, self.objective.score(outcome.evaluation))
                note = {} if proposals is None else proposals[fresh[key]]
                done.append(replace(trial, duration_s=outcome.duration_s, proposal=note))
        except BaseException:
            self._commit(done)
            raise
        if len(done) > 1 and not self._finished and all(one.evaluation.verdict == QUARANTINED for one in done):
            # then the cause is the model, not a design
            raise JumpcadError(f"every evaluation failed, so the model cannot work here: {done[0].evaluation.detail}")
        self._commit(done)
        for key in fresh:
            self._add(self._finished[key], computed=key in new)
        return [self._seen.get(variant.key) for variant in variants]

    def _commit(self, trials: list[Trial]) -> None:
        for trial in self.store.append(in_order(trials)) if trials else ():  # as a search that goes on reads them
            self._finished[trial.key] = trial
            self._taken[trial.position] = trial.key

    def _add(self, trial: Trial, computed: bool) -> None:
        self._seen[trial.key] = trial
        self._watch(trial, computed)
