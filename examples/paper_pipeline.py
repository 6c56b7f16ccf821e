"""The study's second half, end to end: sweeps and importance, then GA, then BO, then the robust pick.

Run `python examples/paper_pipeline.py [--model capsule] [--evaluations 250] [--folder out]`.
"""

import argparse
from pathlib import Path

from jumpcad import load_design, load_workshop
from jumpcad.files.outputs import write_atomically
from jumpcad.search import plots
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.explore import sweep
from jumpcad.search.figures import save
from jumpcad.search.models import RobotModel
from jumpcad.search.objective import find_objective
from jumpcad.search.pool import local_pool
from jumpcad.search.request import Request
from jumpcad.search.space import Space
from jumpcad.search.store import StudyStore
from jumpcad.search.study import run_study
from jumpcad.search.study_plots import plot_study


def main() -> None:
    """Explore, optimise, pick, and write the winner with its pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", default="printed")
    parser.add_argument("--evaluations", type=int, default=250)
    parser.add_argument("--points", type=int, default=11)
    parser.add_argument("--folder", type=Path, default=Path("paper-pipeline"))
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    space, objective = Space.default(), find_objective("fitness")
    model = RobotModel(arguments.model, load_workshop("default") if arguments.model == "printed" else None)

    with local_pool() as pool:
        # One parameter at a time, about the design that the study ended with.
        with StudyStore.write(None, {}) as store:
            swept = sweep(Evaluator(space, objective, model, store, pool), load_design("best-bo"), arguments.points)
        save(plots.sweeps(swept, objective), arguments.folder, "sweeps")

        # GA, then BO on everything that the GA saw. Run it again after an interruption: it goes on.
        path = arguments.folder / "study.db"
        result = run_study(Request(space, model, evaluations=arguments.evaluations), path, pool)
    with StudyStore.read(path) as store:
        plot_study(store, arguments.folder)

    if result.winner is None:
        raise SystemExit("no design jumps: allow more evaluations")
    assert result.best is not None
    print(f"best {result.best.score:.3f}, robust pick {result.winner.score:.3f} body lengths")
    for bound in result.bounds:
        worth = f"refused ({bound.reason})" if bound.worth is None else f"worth {bound.worth:+.3f}"
        print(f"{bound.name} is on its {bound.side} bound; going to {bound.beyond:g} is {worth}")
    write_atomically(arguments.folder / "winner.toml", result.winner.design.to_toml())


if __name__ == "__main__":
    main()
