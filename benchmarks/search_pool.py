"""Cost of pool and study file, gain of a second worker, and whether a killed study loses anything.

Batches of 20 robots, as the genetic algorithm sends them. Wall times mean nothing on a busy machine, so the second
worker is also tried on evaluations that only wait.
Run `python benchmarks/search_pool.py [--model capsule] [--repeats N] [--kills N]`.
"""

import argparse
import random
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from jumpcad.design import Design
from jumpcad.search.models import PrintedModel, RobotModel
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial
from jumpcad.workshop import load_workshop

BATCH, BATCHES = 20, 15
PAUSE_S = 0.02
# Designs near the optimum: all of them pass the checks and jump, so that an evaluation takes its full time.
SPACE = Space.parse(bound=["compression_ratio=0.6:0.8", "rest_angle_deg=55:70", "c_coef=0.95:1.05", "e_coef=0.8:1.1",
                           "stiffness_nmm_per_deg=20:30", "ground_link_angle_deg=10:40"])  # fmt: skip


@dataclass(frozen=True)
class Waiting(PrintedModel):
    """Waits, and then returns the evaluation of the first design for every design."""

    def __call__(self, design: Design) -> Evaluation:
        """Wait, and return the first design's evaluation."""
        if "answer" not in vars(self):
            vars(self)["answer"] = super().__call__(design)
        time.sleep(PAUSE_S)
        return vars(self)["answer"]


@dataclass(frozen=True)
class Cost:
    """Wall time of all batches, the evaluations' own part of it, and CPU time of the calling process (s)."""

    wall_s: float
    own_s: float
    caller_s: float


def batches_cost(model: RobotModel, workers: int, path: Path | None, repeat: int) -> Cost:
    """Return what all batches cost with that many workers, started beforehand; 0 computes in the calling process."""
    points = SPACE.spread((BATCHES + 1) * BATCH, np.random.default_rng(repeat))
    designs = [SPACE.to_design(point) for point in points]
    with StudyStore.write(path, {}) as store, local_pool(workers) as pool:
        evaluator = Evaluator(SPACE, find_objective("fitness"), model, store, pool)
        evaluator.evaluate(designs[:BATCH], "sample", 0)
        wall, caller = time.perf_counter(), time.process_time()
        for step in range(1, BATCHES + 1):
            evaluator.evaluate(designs[step * BATCH : (step + 1) * BATCH], "sample", step)
        wall, caller = time.perf_counter() - wall, time.process_time() - caller
        return Cost(wall, sum(trial.duration_s for trial in evaluator.trials[BATCH:]), caller)


def contents(path: Path) -> list[Trial]:
    """Return the trials of a study without their durations."""
    with StudyStore.read(path) as store:
        return [replace(trial, duration_s=0.0) for trial in store.trials()]


def killed_trials(kills: int, folder: Path) -> tuple[int, int]:
    """Kill one study repeatedly; return how many trials differ from an uninterrupted one, and how many there are."""

    def command(name: str) -> list[str]:
        options = ["--model", "capsule", "--evaluations", "400", "--workers", "2", "--settings", "fine"]
        return [sys.executable, "-m", "jumpcad", "optimize", "ga", *options, "--study", str(folder / name)]

    moments = random.Random(1)
    for number in range(kills):
        process = subprocess.Popen(command("killed.db"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(moments.uniform(0.5, 5.0))
        process.send_signal(signal.SIGKILL)
        if process.wait() == 0:
            raise SystemExit(f"the study was finished before kill {number + 1}: make it longer")
    for name in ("killed.db", "whole.db"):
        subprocess.run(command(name), check=True, stdout=subprocess.DEVNULL)
    killed, whole = contents(folder / "killed.db"), contents(folder / "whole.db")
    different = sum(one != other for one, other in zip(killed, whole, strict=False)) + abs(len(killed) - len(whole))
    return different, len(whole)


def _shown(values: list[float]) -> str:
    return f"{np.median(values):.2f} ({', '.join(f'{value:.2f}' for value in values)})"


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--repeats", type=int, default=5)
    arguments = parser.parse_args()
    workshop = load_workshop("default")
    real, waiting = PrintedModel(workshop), Waiting(workshop)
    figures: dict[str, list[float]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for repeat in range(arguments.repeats):
            alone = batches_cost(real, 0, None, repeat)
            one, two, waited, waited_two = (
                batches_cost(model, workers, folder / f"{number}-{repeat}.db", repeat)
                for number, (model, workers) in enumerate([(real, 1), (real, 2), (waiting, 1), (waiting, 2)])
            )
            for what, value in (
                ("evaluation, CPU (ms)", 1000 * alone.caller_s / (BATCH * BATCHES)),
                ("pool and study file, CPU of the caller (ms)", 1000 * waited_two.caller_s / (BATCH * BATCHES)),
                ("pool and study file / evaluations, CPU (%)", 100 * waited_two.caller_s / alone.caller_s),
                ("pool and study file, share of one worker's wall time (%)", 100 * (1 - one.own_s / one.wall_s)),
                ("two workers, times as fast as one", one.wall_s / two.wall_s),
                (f"the same, waiting {1000 * PAUSE_S:.0f} ms per design", waited.wall_s / waited_two.wall_s),
            ):
                figures.setdefault(what, []).append(value)
        print(f"printed robot: median, and each of {arguments.repeats}")
        for what, values in figures.items():
            print(f"{what:54s}{_shown(values)}", flush=True)
        if arguments.kills:
            different, total = killed_trials(arguments.kills, folder)
            print(f"{arguments.kills} times killed (SIGKILL): {different} of {total} trials differ")


if __name__ == "__main__":
    main()
