"""Memory of a process that reads, plots, exports or resumes a long study; the target is less than 400 MB for each.

Run `python benchmarks/growth.py [--rows N] [--json]`. The study is written first: trials of the capsule robot's space
with the figures and findings of a printed robot's, as many and as long. Every use runs in a process of its own.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from jumpcad.design import load_design
from jumpcad.search.models import CapsuleModel, robot_model
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request, Stage
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial

TARGET_MB = 400.0
BATCH = 1000
SPACE = Space.default()


def request_of(rows: int) -> Request:
    """Return the request that the study answers."""
    return Request(SPACE, CapsuleModel(), method="ga", evaluations=rows)


def trials(rows: int) -> Iterator[Trial]:
    """Yield trials at spread points, all with the evaluation of best-printable and a score of their own."""
    found: Evaluation = robot_model("printed")(load_design("best-printable")).bare
    points, scores = SPACE.spread(rows, np.random.default_rng(0)), np.random.default_rng(1).random(rows)
    for number in range(rows):
        evaluation = replace(found, metrics={**found.metrics, "fitness": float(scores[number])})
        yield Trial(
            "ga", number, 0, SPACE.to_design(points[number]), evaluation, float(scores[number]), "m" * 64, 0.1
        )  # fmt: skip


def write(path: Path, rows: int) -> None:
    """Write the study."""
    request = request_of(rows)
    with StudyStore.write(path, request.identity([])) as store:
        batch: list[Trial] = []
        for trial in trials(rows):
            batch.append(trial)
            if len(batch) == BATCH:
                store.append(batch)
                batch = []
        store.append(batch)


def resume(path: Path, rows: int) -> None:
    """Go on: the evaluator reads all trials, and Bayesian optimisation proposes from them."""
    from jumpcad.search.propose.bayesian import run_bayesian
    from jumpcad.search.study.evaluator import Evaluator

    request = request_of(rows)
    with StudyStore.write(path, request.identity([])) as store, local_pool(0) as pool:
        evaluator = Evaluator(SPACE, request.aim, request.model, store, pool)
        points = SPACE.spread(rows, np.random.default_rng(0))
        for number, point in enumerate(points):  # as a method's steps, from the study
            evaluator.evaluate([SPACE.to_design(point)], "ga", number)
        run_bayesian(evaluator, Stage(request, "bo", 2))


def use(name: str, path: Path, rows: int) -> None:
    """Do one thing with the study."""
    if name == "resume":
        resume(path, rows)
        return
    with StudyStore.read(path) as store:  # what a use needs is imported for it alone, as by the command line
        if name == "read":
            assert len(store.trials()) == rows
        elif name == "plot":
            from jumpcad.search.report.study_plots import plot_study

            plot_study(store, path.parent / "plots")
        else:
            from jumpcad.search.study.table import write_table

            write_table(store.trials(), path.parent / "trials.csv")


USES = ("read", "plot", "export", "resume")


def peak_mb(name: str, path: Path, rows: int) -> float:
    """Return the greatest memory of a process that does one thing with the study (MB)."""
    command = [sys.executable, __file__, "--use", name, "--study", str(path), "--rows", str(rows)]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()[-1])


def measured(rows: int, uses: Iterable[str] = USES) -> dict[str, float]:
    """Return the peak of every use (MB), and the study's size on the disk."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "long.db")
        write(path, rows)
        size = path.stat().st_size / 1e6
        return {"file": size} | {name: peak_mb(name, path, rows) for name in uses}


def main() -> None:
    """Measure and print; with --use, do one thing in this process."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rows", type=int, default=50_000)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--use", choices=USES)
    parser.add_argument("--study", type=Path)
    arguments = parser.parse_args()
    if arguments.use:
        use(arguments.use, arguments.study, arguments.rows)
        print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0)
        return
    found = measured(arguments.rows)
    if arguments.json:
        print(json.dumps({"rows": arguments.rows, "mb": found}, indent=2))
        return
    for name, mb in found.items():
        verdict = "" if name == "file" or mb < TARGET_MB else f"  more than {TARGET_MB:.0f} MB"
        print(f"{name:8s}{mb:8.0f} MB{verdict}")


if __name__ == "__main__":
    main()
