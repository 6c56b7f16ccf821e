"""A campaign: one search's evaluations, each taken from the ledger where it is finished, computed where it is not."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.search.objective import QUARANTINED, Model, Objective
from jumpcad.search.pool import Pool
from jumpcad.search.space import Space
from jumpcad.search.store import Key, StudyStore, Trial

Watch = Callable[[Trial, bool], None]
"""Is told of every row, and whether it was computed now (or found in the ledger)."""


class Evaluator:
    """What optimisers work with.

    A search is a deterministic function of its seed and of the rows it has seen. It therefore resumes by being run
    again: proposals that are finished come out of the ledger, and the first that is not is where computing goes on.

    Parameters
    ----------
    space, objective
        Where is searched, and for what.
    model
        Evaluates a design; sent to the workers.
    ledger, pool
        Where rows are kept, and who computes them.
    prior
        Rows of an earlier study that the search may learn from.
    watch
        Is told of every row.
    """

    def __init__(
        self,
        space: Space,
        objective: Objective,
        model: Model,
        store: StudyStore,
        pool: Pool,
        prior: Sequence[Trial] = (),
        watch: Watch = lambda row, computed: None,
    ) -> None:
        self.space = space
        self.objective = objective
        self.store = store
        self.model = model
        self._pool = pool
        self._watch = watch
        held = store.rows()
        self._finished = {row.key: row for row in held}
        self._taken = {(row.phase, row.step, row.place): row.key for row in held}
        self._seen: dict[Key, Trial] = {}
        self.prior = list(prior)
        pool.notice = store.note

    @property
    def rows(self) -> list[Trial]:
        """All rows that this campaign has come by, in order."""
        return list(self._seen.values())

    def admits(self, design: Design) -> bool:
        """Whether a design is new, and the model's free test does not refuse it."""
        return tuple(design.to_vector()) not in self._seen and self.model.admits(design)

    def finished(self, phase: str, step: int, count: int) -> list[Trial] | None:
        """Take a whole step of `count` rows out of the ledger, or nothing if one of them is missing."""
        rows = sorted(
            (row for row in self._finished.values() if (row.phase, row.step) == (phase, step)),
            key=lambda row: row.place,
        )
        if len(rows) != count:
            return None
        for row in rows:
            self._come_by(row, computed=False)
        return rows

    def evaluate(
        self,
        designs: Sequence[Design],
        phase: str,
        step: int,
        limit: int | None = None,
        proposals: Sequence[Mapping[str, Any]] | None = None,
    ) -> list[Trial | None]:
        """Return the rows of designs, computing those that are not finished; at most `limit` new ones.

        Rows are kept in one transaction; if the run is interrupted meanwhile, those that are finished are kept.

        Raises
        ------
        JumpcadError
            If the model cannot work at all, or the ledger holds other designs at these places.
        """
        fresh: dict[Key, int] = {}
        for index, design in enumerate(designs):
            key = tuple(design.to_vector())
            if key not in self._seen and key not in fresh and (limit is None or len(fresh) < limit):
                fresh[key] = index
        places = {key: (phase, step, place) for place, key in enumerate(fresh)}
        if any(self._taken.get(place, key) != key for key, place in places.items()):
            raise JumpcadError(
                f"{self.store.path}: this search proposes other designs than the study holds; start anew"
            )
        missing = [key for key in fresh if key not in self._finished]
        computed: list[Trial] = []
        try:
            for outcome in self._pool.evaluate(self.model, [designs[fresh[key]] for key in missing]):
                key = missing[outcome.index]
                proposal = {} if proposals is None else proposals[fresh[key]]
                score = self.objective.score(outcome.evaluation)
                computed.append(
                    Trial(*places[key], designs[fresh[key]], outcome.evaluation, score, self.model.digest,
                        outcome.duration_s, proposal)
                )  # fmt: skip
            self._refuse_a_dead_model(computed)
        except JumpcadError:
            raise
        except BaseException:
            self._commit(computed)
            raise
        self._commit(computed)
        for key in fresh:
            self._come_by(self._finished[key], computed=key in missing)
        return [self._seen.get(tuple(design.to_vector())) for design in designs]

    def _commit(self, rows: list[Trial]) -> None:
        if rows:
            self.store.append(sorted(rows, key=lambda row: row.position))
        for row in rows:
            self._finished[row.key] = row
            self._taken[row.phase, row.step, row.place] = row.key

    def _come_by(self, row: Trial, computed: bool) -> None:
        self._seen[row.key] = row
        self._watch(row, computed)

    def _refuse_a_dead_model(self, rows: list[Trial]) -> None:
        """If the very first batch is lost as a whole, then not the designs are to blame."""
        if len(rows) > 1 and not self._finished and all(row.evaluation.verdict == QUARANTINED for row in rows):
            raise JumpcadError(f"every evaluation failed, so the model cannot work here: {rows[0].evaluation.detail}")
