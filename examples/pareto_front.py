"""Range against spring energy: the front of designs that no other one beats in both.

Run `python examples/pareto_front.py [--model capsule] [--evaluations 200] [--folder out]`.
"""

import argparse
from pathlib import Path

import jumpcad
from jumpcad.search import energy_j, find_objective, plots, save_figure


def main() -> None:
    """Search the front, print it and draw it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", default="printed")
    parser.add_argument("--evaluations", type=int, default=200)
    parser.add_argument("--folder", type=Path, default=Path("pareto-front"))
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    result = jumpcad.optimize(
        "pareto",
        evaluations=arguments.evaluations,
        model=arguments.model,
        study=arguments.folder / "study.db",
    )
    print("energy (J)   range (m)")
    for trial in result.front:
        print(f"{energy_j(trial.design):10.4f}  {trial.score:10.4f}")
    print(f"hypervolume {result.hypervolume:.4f}")
    save_figure(plots.pareto(result.trials, find_objective("range")), arguments.folder, "front")


if __name__ == "__main__":
    main()
