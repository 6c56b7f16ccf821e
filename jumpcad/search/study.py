"""A whole study: what is asked for, in which stages it is searched, and what comes out.

This is the front door of the search: `run_study` starts or continues, and ends with the same rows either way.
"""

import hashlib
import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.search.evaluator import Evaluator, Watch
from jumpcad.search.methods.bayesian import default_initial, run_bayesian
from jumpcad.search.methods.genetic import find_preset, run_genetic
from jumpcad.search.methods.pareto import run_nsga2, run_pareto
from jumpcad.search.models import versions
from jumpcad.search.objective import Model, find_objective
from jumpcad.search.pool import Pool
from jumpcad.search.robust import ActiveBound, Candidate, active_bounds, rank_candidates
from jumpcad.search.space import Space
from jumpcad.search.store import SEARCH_PHASES, StudyStore, Trial

FRONTS = ("pareto", "nsga2")
"""Methods that look for a front instead of one best design."""
MOST_EVALUATIONS = 1_000_000
"""A week at two a second."""
METHODS = ("ga+bo", "ga", "bo", *FRONTS)
LEARNING_VERSIONS = ("scipy", "scikit-learn", "pygad")
"""Packages that decide what is proposed next, beside those that decide an evaluation."""


@dataclass(frozen=True)
class Request:
    """What a study is asked for.

    Parameters
    ----------
    space, model, objective
        Where is searched, with which robot, and for what (a name among the objectives).
    method
        One of `METHODS`: genetic, Bayesian, the one after the other, or the front of score against spring energy.
    evaluations
        How many designs are evaluated; the robust pick comes on top.
    seed
        Decides all that chance decides.
    preset
        Settings of the genetic algorithm.
    batch
        Bayesian proposals that are evaluated together; 1 learns the most from each.
    prior
        A study file to learn from.
    tolerance_mm
        By how much a length may come out wrong, for the robust pick.
    """

    space: Space
    model: Model
    objective: str = "fitness"
    method: str = "ga+bo"
    evaluations: int = 250
    seed: int = 0
    preset: str = "recommended"
    batch: int = 1
    prior: Path | None = None
    tolerance_mm: float = 0.2

    def __post_init__(self) -> None:
        find_objective(self.objective)
        find_preset(self.preset)
        if self.method not in METHODS:
            hint = did_you_mean(self.method, METHODS)
            raise JumpcadError(f"{self.method!r} is not one of the methods {', '.join(METHODS)}{hint}")
        for name, value, least, most in (
            ("evaluations", self.evaluations, 1, MOST_EVALUATIONS),
            ("seed", self.seed, 0, 2**32 - 1),
            ("batch", self.batch, 1, MOST_EVALUATIONS),
            ("tolerance_mm", self.tolerance_mm, 0, 100),
        ):
            if value < least:
                raise JumpcadError(f"{name} = {value:g} must be at least {least}")
            if value > most:
                raise JumpcadError(f"{name} = {value} must be at most {most}")

    def identity(self, prior: Sequence[Trial]) -> dict[str, Any]:
        """Return all that decides the rows of the study, except how many they are."""
        learned = json.dumps([[row.key, row.score] for row in prior])
        return {
            "model": self.model.describe(),
            "objective": self.objective,
            "method": self.method,
            "space": self.space.describe(),
            "seed": self.seed,
            "preset": self.preset,
            "batch": self.batch,
            "tolerance_mm": self.tolerance_mm,
            "prior": hashlib.sha256(learned.encode()).hexdigest() if prior else None,
            "versions": self.model.versions() | versions(*LEARNING_VERSIONS),
        }

    def default_name(self) -> str:
        """Return a file name that the same request always has, and no other one."""
        record = [self.identity([]), str(self.prior), self.evaluations if self.method == "ga+bo" else 0]
        digest = hashlib.sha256(json.dumps(record, sort_keys=True).encode()).hexdigest()
        return f"study-{self.method.replace('+', '-')}-{digest[:8]}.db"


@dataclass(frozen=True)
class Stage:
    """One method at work: how many evaluations, and how many of them spread evenly at first (where it does that)."""

    method: str
    evaluations: int
    initial: int = 0


@dataclass(frozen=True)
class Result:
    """What a study found: its rows in order, the best, the most robust first, the winner's active bounds, its notes."""

    rows: list[Trial]
    best: Trial | None
    candidates: list[Candidate]
    bounds: list[ActiveBound]
    notes: list[str]

    @property
    def winner(self) -> Trial | None:
        """The most robust of the best designs."""
        return self.candidates[0].row if self.candidates else self.best


def plan_stages(request: Request, prior: int = 0) -> list[Stage]:
    """Return the stages of a request.

    Of both methods together, Bayesian optimisation gets a fifth, at least 50 and at most half of all: with that it ends
    at the top from whatever hill the genetic algorithm found.
    """
    total = request.evaluations
    if request.method == "ga+bo":
        last = min(max(total // 5, 50), total // 2, 100)
        return [Stage("ga", total - last), Stage("bo", last)]
    if request.method in ("bo", "pareto"):
        return [Stage(request.method, total, default_initial(request.space, total, prior))]
    return [Stage(request.method, total)]


def run_study(
    request: Request,
    path: Path | None,
    pool: Pool,
    watch: Watch = lambda row, computed: None,
) -> Result:
    """Run a study, or go on with it where its file ends; None keeps it in memory.

    Raises
    ------
    JumpcadError
        If the request is wrong, or the file holds another study, is damaged or in use.
    """
    prior, remark = _read_prior(request)
    with StudyStore.write(path, request.identity(prior)) as store:
        if remark and remark not in store.notes():
            store.note(remark)
        stages = _stages(request, store, len(prior))
        objective = find_objective(request.objective)
        evaluator = Evaluator(request.space, objective, request.model, store, pool, prior, watch)
        for stage in stages:
            _run_stage(evaluator, stage, request)
        rows = evaluator.rows
        best = best_row(rows)
        candidates = []
        if request.method not in FRONTS:
            candidates = rank_candidates(evaluator, rows, request.seed, request.tolerance_mm)
        bounds = active_bounds(evaluator, candidates[0].row, len(rows)) if candidates else []
        return Result(rows, best, candidates, bounds, store.notes())


def best_row(rows: Sequence[Trial]) -> Trial | None:
    """Return the row with the highest score, the first of equals; None where every design is refused."""
    feasible = [row for row in rows if row.score is not None]
    return max(feasible, key=lambda row: row.score or 0.0) if feasible else None


def search_rows(rows: Sequence[Trial]) -> list[Trial]:
    """Return the rows that the search proposed, without those of the robust pick and the active bounds."""
    return [row for row in rows if row.phase in SEARCH_PHASES]


def count_refusals(rows: Sequence[Trial]) -> dict[str, int]:
    """Return how many rows each reason refused, most frequent first."""
    return dict(Counter(reason for row in rows for reason in row.evaluation.reasons).most_common())


def _run_stage(evaluator: Evaluator, stage: Stage, request: Request) -> None:
    if stage.method == "ga":
        run_genetic(evaluator, stage.evaluations, request.seed, request.preset)
    elif stage.method == "bo":
        run_bayesian(evaluator, stage.evaluations, request.seed, stage.initial, request.batch)
    elif stage.method == "pareto":
        run_pareto(evaluator, stage.evaluations, request.seed, stage.initial)
    else:
        run_nsga2(evaluator, stage.evaluations, request.seed)


def _stages(request: Request, store: StudyStore, prior: int) -> list[Stage]:
    """Return the stages that the study has been planned with; a larger budget lengthens the last of them."""
    planned = store.recall("stages")
    if planned is None:
        stages = plan_stages(request, prior)
    else:
        stages = [Stage(**stage) for stage in planned]
        more = request.evaluations - sum(stage.evaluations for stage in stages)
        if more < 0:
            raise JumpcadError(
                f"{store.path}: is planned for {request.evaluations - more} evaluations, not {request.evaluations}; "
                f"ask for as many or more, or name another file"
            )
        stages[-1] = replace(stages[-1], evaluations=stages[-1].evaluations + more)
    store.remember("stages", [asdict(stage) for stage in stages])
    return stages


def _read_prior(request: Request) -> tuple[list[Trial], str]:
    """Return the rows of the prior study that lie in the space, scored by this request's objective, and a remark."""
    if request.prior is None:
        return [], ""
    with StudyStore.read(request.prior) as store:
        theirs, ours = store.identity["model"], json.loads(json.dumps(request.model.describe()))
        if theirs != ours:
            raise JumpcadError(
                f"{request.prior}: was made with another model ({theirs['name']}, or other settings) than this search"
            )
        objective = find_objective(request.objective)
        rows = [
            replace(row, score=objective.score(row.evaluation))
            for row in store.rows()
            if request.space.contains(row.design)
        ]
        same = all(row.model == request.model.digest for row in rows)
        return rows, "" if same else f"{request.prior} was made by another program; it is learned from all the same"
