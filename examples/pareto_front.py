"""How far for how many joules: the front of range against spring energy.

Run `python examples/pareto_front.py [--model capsule] [--evaluations 200] [--folder out]`.
"""

import argparse
from pathlib import Path

from jumpcad import load_workshop
from jumpcad.search import plots
from jumpcad.search.figures import save
from jumpcad.search.methods.pareto import energy_j, front, hypervolume
from jumpcad.search.models import RobotModel
from jumpcad.search.objective import find_objective
from jumpcad.search.pool import local_pool
from jumpcad.search.request import Request
from jumpcad.search.space import Space
from jumpcad.search.study import run_study


def main() -> None:
    """Search the front, print it and draw it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", default="printed")
    parser.add_argument("--evaluations", type=int, default=200)
    parser.add_argument("--folder", type=Path, default=Path("pareto-front"))
    arguments = parser.parse_args()
    model = RobotModel(arguments.model, load_workshop("default") if arguments.model == "printed" else None)
    request = Request(Space.default(), model, "range", "pareto", arguments.evaluations)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    with local_pool() as pool:
        result = run_study(request, arguments.folder / "study.db", pool)
    print("energy (J)   range (m)")
    for trial in front(result.trials):
        print(f"{energy_j(trial.design):10.4f}  {trial.score:10.4f}")
    print(f"hypervolume {hypervolume(result.trials):.4f}")
    save(plots.pareto(result.trials, find_objective("range")), arguments.folder, "front")


if __name__ == "__main__":
    main()
