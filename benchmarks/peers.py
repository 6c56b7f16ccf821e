"""Bayesian optimisation against optimisers of other projects that handle constraints, on the printed robot.

Three problems: the default box in the default workshop, the same box in the workshop `light`, and a box whose bounds
lie a quarter of their range farther out. A rejected design scores 0.

Every peer gets what `bo` has: its first designs (half ranked by the capsule robot, half evenly spread, each with room
for its parts); the signed margins of the limits that rejected a design, at most `MAX_CONSTRAINTS` with the verdict, in
units of their typical size and large ones compressed; the square root of the score; and the knowledge, free of charge,
that a linkage does not close. What `bo` alone has is its dry run: the layout and an estimate of the jump, for each
proposal, and what was refused while the start was chosen.

- `logcei`: BoTorch, logarithm of the constrained expected improvement (Ament et al., NeurIPS 2023). Matérn 5/2 with
  BoTorch's prior on length scales; scores of jumps, and each margin where it is known; also candidates near the best.
- `scbo`: BoTorch, Thompson samples of score and margins in a trust region (Eriksson and Poloczek, AISTATS 2021), with
  the settings of its tutorial and the same processes.
- `gpsampler`, `tpe`: Optuna, its samplers' defaults, with constraints as by `constraints_func`. They need a score and
  all margins of every design: what is rejected has the mean score of what is not (with 0, GPSampler's seed 0 ended at
  4.02, not 4.49), and what is unknown the median of what is known.
- `pycma-al`, `pycma-first`: pycma from the best first design, σ = 0.2, with its augmented Lagrangian (a rejected design
  has the score 0), and with rejected designs ranked behind all others by their violation. What does not close is drawn
  again. It needs no first designs but that one; they count.
- `ga`: PyGAD with the recommended settings, as `optimize --method ga` runs it, with its own first population.

Rows are appended to `--log` as searches end; what it holds is not run again, unless with `--again`, and of equals the
last one counts. `--table FILE` prints it as Markdown. Not among the extras are torch and BoTorch:
`pip install botorch`. GPSampler needs torch too.
The table of docs/searching.md has seeds 0, 1, … and torch 2.15.0. The peers ran on another machine than `bo`, on robots
whose plates and sections grew otherwise, which changes about a third of the designs a little.
Run `python benchmarks/peers.py --log FILE [--methods a,b] [--problems a,b] [--seeds N]`; one search takes 10 to 120 s.
"""

import argparse
import importlib.util
import json
import math
import warnings
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
from search import bayesian, genetic

from jumpcad.design import SEARCH_BOUNDS
from jumpcad.search.models import robot_model
from jumpcad.search.parameter import physical_limits
from jumpcad.search.propose.bayesian import incumbent
from jumpcad.search.propose.dry_run import DryRun
from jumpcad.search.propose.initial_designs import first_points
from jumpcad.search.propose.posterior import VERDICT, constraint_margins, forwards, warped
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import default_initial
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial
from jumpcad.search.study.versions import versions
from jumpcad.transforms import Array

EVALUATIONS = 60
MARKS = (40, 60)
WIDER = 0.25
"""Share of its range by which each bound of the wider box lies farther out."""
TRIES = 20
"""Most proposals in a row that do not close before a random design is taken instead."""
RAW, NEAR, RESTARTS = 512, 64, 8
"""Candidates of LogCEI in the whole box, near each of the best designs, and of them those that are polished."""
CANDIDATES = 1000
"""Candidates of SCBO; the tutorial has 2,000, which take four times as long."""


def wider_space() -> Space:
    """Return the default space with wider bounds, within what a design can be."""
    bounds = {}
    for name, limits in SEARCH_BOUNDS.items():
        (least, most), more = physical_limits(name), WIDER * (limits.upper - limits.lower)
        bounds[name] = max(least, limits.lower - more), min(most, limits.upper + more)
    return Space.make(bounds=bounds)


PROBLEMS: dict[str, tuple[str, Callable[[], Space]]] = {
    "default": ("default", Space.default),
    "light": ("light", Space.default),
    "wider box": ("default", wider_space),
}


@dataclass(frozen=True)
class Seen:
    """What a peer learns from: points (n, d), warped scores (n,), NaN of rejected ones, and margins (n,) by name.

    A margin that is not known is NaN. Margins are positive where a limit is met.
    """

    points: Array
    scores: Array
    margins: dict[str, Array]

    @property
    def jumps(self) -> Array:
        """Whether each design has a score (n,)."""
        return np.isfinite(self.scores)

    @property
    def rewards(self) -> Array:
        """Scores (n,) with 0 for rejected designs."""
        return np.where(self.jumps, self.scores, 0.0)

    @property
    def levelled(self) -> Array:
        """Scores (n,) with their mean for rejected designs."""
        return np.where(self.jumps, self.scores, np.nanmean(self.scores) if self.jumps.any() else 0.0)

    @property
    def violations(self) -> Array:
        """Negative margins (n, k) with no gaps: the median for what is unknown, and that as met where a robot jumps."""
        columns = []
        for margins in self.margins.values():
            middle = float(np.nanmedian(margins))
            columns.append(-np.where(np.isfinite(margins), margins, np.where(self.jumps, abs(middle), middle)))
        return np.column_stack(columns)


class Search:
    """One search of a peer: its first designs are evaluated, the others one by one.

    Parameters
    ----------
    evaluator
        Of the problem; it has no trials yet.
    seed, evaluations
        Of the search.
    """

    def __init__(self, evaluator: Evaluator, seed: int, evaluations: int) -> None:
        self.evaluator, self.seed, self.evaluations = evaluator, seed, evaluations
        self.space = evaluator.space
        self.generator = np.random.default_rng([seed, 3])
        self._free: list[Trial] = []
        initial = default_initial(self.space, evaluations, guessed=True)
        dry_run = DryRun.of(evaluator, "bo", seed, 0)
        assert dry_run is not None
        generator = np.random.default_rng([seed, 1])  # as `bo` does
        self.evaluate(first_points(self.space, initial, generator, dry_run.ranked, dry_run.starts_with))

    @property
    def left(self) -> int:
        """How many evaluations are left."""
        return self.evaluations - len(self.evaluator.trials)

    def admits(self, point: Array) -> bool:
        """Whether a point (d,) is new, and its linkage closes."""
        return self.evaluator.admits(self.space.to_design(point))

    def evaluate(self, points: Array) -> None:
        """Evaluate points (n, d)."""
        designs = [self.space.to_design(point) for point in np.clip(points, 0.0, 1.0)]
        self.evaluator.evaluate(designs, "sample", len(self.evaluator.trials))

    def learn(self, point: Array) -> None:
        """Learn, without an evaluation, the margins of a linkage that does not close."""
        design = self.space.to_design(point)
        self._free.append(Trial("", 0, 0, design, self.evaluator.model(design).bare, None, "", 0.0))

    def random_point(self) -> Array:
        """Return a random point (d,) whose linkage closes."""
        points = (self.generator.random(self.space.dimension) for _ in range(10_000))
        return next(point for point in points if self.admits(point))

    def seen(self, free: bool = False) -> Seen:
        """Return what the trials show; with `free`, also what was learned without an evaluation, at the end."""
        trials = [*self.evaluator.trials, *(self._free if free else ())]
        scores = np.array([math.nan if trial.score is None else trial.score for trial in trials])
        jumps = np.isfinite(scores)
        if jumps.any():
            scores[jumps] = warped(forwards(scores[jumps], scores[jumps]))
        margins = constraint_margins(trials) or {VERDICT: np.ones(len(trials))}
        sizes = {name: float(np.nanmedian(np.abs(values))) or 1.0 for name, values in margins.items()}
        points = np.array([self.space.to_unit(trial.variant) for trial in trials])
        return Seen(points, scores, {name: np.arcsinh(values / sizes[name]) for name, values in margins.items()})


def log_cei(evaluator: Evaluator, seed: int, evaluations: int) -> None:
    """Run BoTorch's constrained expected improvement."""
    import torch
    from botorch.acquisition.analytic import LogConstrainedExpectedImprovement, LogProbabilityOfFeasibility
    from botorch.models import ModelListGP
    from botorch.optim import optimize_acqf

    torch.manual_seed(seed)
    search, processes = Search(evaluator, seed, evaluations), Processes()
    dimension = search.space.dimension
    while search.left > 0:
        seen = search.seen()
        models = processes.fit_margins(seen)
        if seen.jumps.sum() >= 2:
            best = float(np.nanmax(seen.scores))
            models = [processes.fit("score", seen.points[seen.jumps], seen.scores[seen.jumps]), *models]
            limits = dict.fromkeys(range(1, len(models)), (0.0, None))
            acquisition = LogConstrainedExpectedImprovement(ModelListGP(*models), best, 0, limits)
        else:
            limits = dict.fromkeys(range(len(models)), (0.0, None))
            acquisition = LogProbabilityOfFeasibility(ModelListGP(*models), limits)
        _, elite = incumbent(search.space, evaluator.trials)
        near = [point + _steps(search.generator, dimension) for point in elite]
        raw = torch.tensor(np.clip(np.vstack([search.space.spread(RAW, search.generator), *near]), 0.0, 1.0))
        with torch.no_grad():
            values = acquisition(raw[:, None, :])
        starts = raw[values.argsort(descending=True)[:RESTARTS]]
        box = torch.tensor([[0.0] * dimension, [1.0] * dimension], dtype=torch.double)
        ends, end_values = optimize_acqf(
            acquisition, box, q=1, num_restarts=RESTARTS, batch_initial_conditions=starts[:, None, :],
            return_best_only=False, options={"maxiter": 100},
        )  # fmt: skip
        points = torch.cat([ends[:, 0, :], raw]).numpy()
        order = torch.cat([end_values.reshape(-1), values]).argsort(descending=True).tolist()
        admitted = (points[index] for index in order if search.admits(points[index]))
        search.evaluate(next(admitted, search.random_point())[None])


def scbo(evaluator: Evaluator, seed: int, evaluations: int) -> None:
    """Run BoTorch's trust region: doubled after ten successes in a row, halved after as many failures as axes."""
    import gpytorch
    import torch
    from botorch.generation.sampling import ConstrainedMaxPosteriorSampling
    from botorch.models import ModelListGP
    from torch.quasirandom import SobolEngine

    torch.manual_seed(seed)
    search, processes = Search(evaluator, seed, evaluations), Processes()
    dimension = search.space.dimension
    length, successes, failures = 0.8, 0, 0
    while search.left > 0:
        seen = search.seen()
        models = processes.fit_margins(seen, sign=-1.0)
        jumps = seen.jumps if seen.jumps.sum() >= 2 else np.full(len(seen.points), True)
        score = processes.fit("score", seen.points[jumps], seen.rewards[jumps])
        centre = seen.points[_best(seen)]
        scales = score.covar_module.lengthscale.detach().numpy().reshape(-1)
        half = 0.5 * length * scales / np.exp(np.log(scales).mean())
        lower, upper = np.clip(centre - half, 0.0, 1.0), np.clip(centre + half, 0.0, 1.0)
        draws = SobolEngine(dimension, scramble=True, seed=seed * 1000 + search.left).draw(CANDIDATES).double().numpy()
        moved = search.generator.random((CANDIDATES, dimension)) <= min(20.0 / dimension, 1.0)
        moved[~moved.any(axis=1), 0] = True
        candidates = np.where(moved, lower + (upper - lower) * draws, centre)
        candidates = np.array([point for point in candidates if search.admits(point)]).reshape(-1, dimension)
        if not len(candidates):
            candidates = search.random_point()[None]
        with torch.no_grad(), gpytorch.settings.max_cholesky_size(float("inf")):
            sampling = ConstrainedMaxPosteriorSampling(score, constraint_model=ModelListGP(*models), replacement=False)
            point = sampling(torch.tensor(candidates), num_samples=1).numpy()
        search.evaluate(point)
        after = search.seen()
        improved = _best(after) == len(after.points) - 1
        successes, failures = (successes + 1, 0) if improved else (0, failures + 1)
        if successes == 10:
            length, successes = min(2.0 * length, 1.6), 0
        elif failures == max(4, dimension):
            length, failures = length / 2.0, 0
            length = 0.8 if length < 0.5**7 else length


def _best(seen: Seen) -> int:
    """Return the index of the best design; of the least violation where none jumps."""
    if seen.jumps.any():
        return int(np.nanargmax(seen.scores))
    return int(np.maximum(seen.violations, 0.0).sum(axis=1).argmin())


def _steps(generator: np.random.Generator, dimension: int) -> Array:
    """Return steps (n, d) of many sizes, as `bo` draws them near its best designs."""
    scale = 10.0 ** generator.uniform(-3, -0.7, (NEAR, 1))
    steps: Array = scale * generator.standard_normal((NEAR, dimension))
    return steps


class Processes:
    """BoTorch's processes of one search; each fit starts where the one before it ended."""

    def __init__(self) -> None:
        self._states: dict[str, dict[str, Any]] = {}

    def fit(self, name: str, points: Array, values: Array) -> Any:
        """Return the process of values (n,) at points (n, d)."""
        import torch
        from botorch.fit import fit_gpytorch_mll
        from botorch.models import SingleTaskGP
        from botorch.models.transforms import Standardize
        from botorch.models.utils.gpytorch_modules import get_covar_module_with_dim_scaled_prior
        from gpytorch.mlls import ExactMarginalLogLikelihood

        kernel = get_covar_module_with_dim_scaled_prior(ard_num_dims=points.shape[1], use_rbf_kernel=False)
        process = SingleTaskGP(
            torch.tensor(points), torch.tensor(values)[:, None], covar_module=kernel, outcome_transform=Standardize(1)
        )
        process.load_state_dict({**process.state_dict(), **self._states.get(name, {})})
        fit_gpytorch_mll(ExactMarginalLogLikelihood(process.likelihood, process))
        self._states[name] = {key: value.clone() for key, value in process.named_parameters()}
        return process

    def fit_margins(self, seen: Seen, sign: float = 1.0) -> list[Any]:
        """Return the processes of the margins, each where it is known, times a sign."""
        known = {name: np.isfinite(margins) for name, margins in seen.margins.items()}
        return [
            self.fit(name, seen.points[known[name]], sign * margins[known[name]])
            for name, margins in seen.margins.items()
        ]


def optuna_search(evaluator: Evaluator, seed: int, evaluations: int, sampler: str) -> None:
    """Run a sampler of Optuna. Its study is made anew for every step: the limits and their sizes change."""
    import optuna

    optuna.logging.set_verbosity(optuna.logging.ERROR)
    search = Search(evaluator, seed, evaluations)
    names = [parameter.name for parameter in search.space.free]
    ranges = {name: optuna.distributions.FloatDistribution(0.0, 1.0) for name in names}
    others: dict[str, Any] = {"deterministic_objective": True} if sampler == "GPSampler" else {}
    tries, limits, proposer = 0, 0, None
    while search.left > 0:
        seen = search.seen(free=True)
        if proposer is None or len(seen.margins) != limits:  # it starts its fits where those before ended
            limits = len(seen.margins)
            proposer = getattr(optuna.samplers, sampler)(
                seed=1000 * seed + len(seen.points), n_startup_trials=0, constraints_func=_no_constraints, **others
            )
        study = optuna.create_study(direction="maximize", sampler=proposer)
        for point, reward, violations in zip(seen.points, seen.levelled, seen.violations, strict=True):
            parameters = dict(zip(names, np.clip(point, 0.0, 1.0).tolist(), strict=True))
            attributes = {"constraints": violations.tolist()}
            study.add_trial(
                optuna.trial.create_trial(
                    params=parameters, distributions=ranges, value=float(reward), system_attrs=attributes
                )
            )
        proposed = study.ask(ranges).params
        point = np.array([proposed[name] for name in names])
        if search.admits(point):
            search.evaluate(point[None])
            tries = 0
        elif tries < TRIES:
            search.learn(point)
            tries += 1
        else:
            search.evaluate(search.random_point()[None])
            tries = 0


def _no_constraints(_trial: Any) -> Sequence[float]:
    raise AssertionError("constraints are given with the trials")


def pycma(evaluator: Evaluator, seed: int, evaluations: int, lagrangian: bool) -> None:
    """Run pycma with its augmented Lagrangian, or with feasible designs first."""
    import cma
    from cma.constraints_handler import AugmentedLagrangian

    search = Search(evaluator, seed, evaluations)
    seen = search.seen()
    names = list(seen.margins)
    penalties = AugmentedLagrangian(search.space.dimension)
    penalties.logging = 0
    options = {"bounds": [0, 1], "seed": seed + 1, "verbose": -9}
    start = np.clip(seen.points[_best(seen)], 0.0, 1.0)
    strategy = cma.CMAEvolutionStrategy(start, 0.2, options)
    while search.left > 0:
        points = [_closing(search, strategy) for _ in range(strategy.popsize)][: search.left]
        before = len(evaluator.trials)
        search.evaluate(np.array(points))
        if len(points) < strategy.popsize or len(evaluator.trials) < before + len(points):
            break
        seen = search.seen()
        losses = -seen.rewards[before:]
        if lagrangian:
            columns = dict(zip(seen.margins, seen.violations.T, strict=True))
            nothing = np.zeros(len(seen.points))
            limits = np.column_stack([columns.get(name, nothing) for name in names])[before:]
            if not penalties.is_initialized:
                penalties.set_coefficients(losses, limits)
            losses = losses + np.array([sum(penalties(row)) for row in limits])
            favourite = int(losses.argmin())
            penalties.update(-seen.rewards[before:][favourite], limits[favourite])
        else:
            violation = np.maximum(seen.violations[before:], 0.0).sum(axis=1)
            losses = np.where(seen.jumps[before:], losses, violation)
        strategy.tell(points, losses.tolist())


def _closing(search: Search, strategy: Any) -> Array:
    """Return a point (d,) that pycma draws and whose linkage closes."""
    for _ in range(TRIES):
        point = np.asarray(strategy.ask(1)[0])
        if search.admits(point):
            return point
    return search.random_point()


METHODS: dict[str, tuple[str, Callable[..., None], tuple[str, ...]]] = {
    "bo": ("jumpcad, `bo`", bayesian, ()),
    "logcei": ("BoTorch, LogCEI", log_cei, ("botorch", "torch")),
    "scbo": ("BoTorch, SCBO", scbo, ("botorch", "torch")),
    "gpsampler": ("Optuna, GPSampler", partial(optuna_search, sampler="GPSampler"), ("optuna", "torch")),
    "tpe": ("Optuna, TPE", partial(optuna_search, sampler="TPESampler"), ("optuna",)),
    "pycma-al": ("pycma, augmented Lagrangian", partial(pycma, lagrangian=True), ("cma",)),
    "pycma-first": ("pycma, feasible first", partial(pycma, lagrangian=False), ("cma",)),
    "ga": ("PyGAD, recommended settings", genetic, ("pygad",)),
}
"""Name in the table, function, and the packages that it needs."""


def run_search(method: str, problem: str, seed: int, evaluations: int) -> dict[str, Any]:
    """Run one search; return its row of the log."""
    workshop, space = PROBLEMS[problem]
    model = replace(robot_model("printed", workshop), stand_in=True)
    _, function, packages = METHODS[method]
    with StudyStore.write(None, {}) as store, local_pool(0) as pool:
        evaluator = Evaluator(space(), find_objective(model.default_objective), model, store, pool)
        start = process_time()
        function(evaluator, seed, evaluations)
        spent = process_time() - start
        trials = evaluator.trials[:evaluations]
    best = np.maximum.accumulate([trial.score or 0.0 for trial in trials])
    return {
        "problem": problem,
        "method": method,
        "seed": seed,
        "best": best.round(4).tolist(),
        "rejected": sum(trial.score is None for trial in trials) / len(trials),
        "cpu_s": round(spent, 2),
        "versions": versions("jumpcad", *packages),
    }


def read_log(log: Path) -> dict[tuple[str, str, int], dict[str, Any]]:
    """Return the rows of a log by problem, method and seed; of equals, the last."""
    lines = log.read_text(encoding="utf-8").splitlines() if log.exists() else []
    rows = (json.loads(line) for line in lines)
    return {(row["problem"], row["method"], row["seed"]): row for row in rows}


def table(log: Path) -> Iterator[str]:
    """Yield the lines of a log's Markdown table: median [least, greatest] at the marks, rejections, CPU time."""
    groups: dict[tuple[str, str], list[dict[str, Any]]] = defaultdict(list)
    for (problem, method, _), row in read_log(log).items():
        groups[problem, method].append(row)
    yield "| problem | method | seeds | " + " | ".join(f"at {mark}" for mark in MARKS) + " | rejected | CPU s |"
    yield "|---|---|--:|" + "---|" * len(MARKS) + "--:|--:|"
    for problem in PROBLEMS:
        for method, (title, _, _) in METHODS.items():
            rows = groups.get((problem, method))
            if not rows:
                continue
            cells = []
            for mark in MARKS:
                scores = [row["best"][min(mark, len(row["best"])) - 1] for row in rows]
                cells.append(f"{np.median(scores):.2f} [{min(scores):.2f}, {max(scores):.2f}]")
            rejected, spent = (float(np.median([row[key] for row in rows])) for key in ("rejected", "cpu_s"))
            cells += [f"{100 * rejected:.0f} %", f"{spent:.0f}"]
            yield f"| {problem} | {title} | {len(rows)} | {' | '.join(cells)} |"


def missing(method: str) -> list[str]:
    """Return the packages that a method needs and that are not installed."""
    return [package for package in METHODS[method][2] if importlib.util.find_spec(package) is None]


def main() -> None:
    """Run the searches that the log lacks, or print its table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--log", type=Path, help="JSON lines, one a search")
    parser.add_argument("--table", type=Path, metavar="LOG", help="print the table of a log and end")
    parser.add_argument("--methods", default=",".join(METHODS))
    parser.add_argument("--problems", default=",".join(PROBLEMS))
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--evaluations", type=int, default=EVALUATIONS, help="of a search; another number, another log")
    parser.add_argument("--again", action="store_true", help="run what the log holds too")
    arguments = parser.parse_args()
    if arguments.table:
        print("\n".join(table(arguments.table)))
        return
    if arguments.log is None:
        parser.error("give --log FILE, or --table LOG")
    warnings.simplefilter("ignore")
    if importlib.util.find_spec("torch"):
        import torch

        torch.set_num_threads(1)
    done = {} if arguments.again else read_log(arguments.log)
    for method in arguments.methods.split(","):
        if lacking := missing(method):
            print(f"{method} is left out: install {' and '.join(lacking)}", flush=True)
            continue
        for problem in arguments.problems.split(","):
            for seed in range(arguments.seeds):
                if (problem, method, seed) in done:
                    continue
                row = run_search(method, problem, seed, arguments.evaluations)
                with arguments.log.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(row) + "\n")
                marks = ", ".join(f"{row['best'][min(mark, len(row['best'])) - 1]:.2f}" for mark in MARKS)
                print(f"{problem:10s} {method:12s} {seed}: {marks}  {row['cpu_s']:.0f} s", flush=True)


if __name__ == "__main__":
    main()
