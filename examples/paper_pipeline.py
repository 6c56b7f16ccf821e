"""The study's second half, end to end: sweeps, then GA, then BO, then the robust pick.

Run `python examples/paper_pipeline.py [--model capsule] [--evaluations 250] [--folder out]`.
"""

import argparse
from pathlib import Path

import jumpcad
from jumpcad.search import (
    Evaluator,
    Request,
    Space,
    StudyStore,
    find_objective,
    local_pool,
    plot_study,
    plots,
    robot_model,
    save_figure,
    sweep,
)


def main() -> None:
    """Explore, optimise, pick, and write the winner with its pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", default="printed")
    parser.add_argument("--evaluations", type=int, default=250)
    parser.add_argument("--points", type=int, default=11)
    parser.add_argument("--folder", type=Path, default=Path("paper-pipeline"))
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)

    # One parameter at a time, about the design that the study ended with.
    objective = find_objective("fitness")
    request = Request(Space.default(), robot_model(arguments.model), objective)
    with local_pool() as pool, StudyStore.write(None, request.identity([])) as store:
        evaluator = Evaluator(request, store, pool)
        swept = sweep(evaluator, jumpcad.load_design("best-bo"), arguments.points)
    save_figure(plots.sweeps(swept, objective), arguments.folder, "sweeps")

    # GA, then BO on the designs of the GA. Run it again after an interruption: it continues.
    study = arguments.folder / "study.db"
    result = jumpcad.optimize("ga+bo", evaluations=arguments.evaluations, model=arguments.model, study=study)
    with StudyStore.read(study) as store:
        plot_study(store, arguments.folder)

    if result.best is None:
        raise SystemExit("no design jumps: evaluate more designs")
    print(f"best {result.best.score:.3f}, robust pick {result.score:.3f} {result.request.aim.unit}")
    for bound in result.bounds:
        change = f"is rejected ({bound.reason})" if bound.worth is None else f"changes the score by {bound.worth:+.3f}"
        print(f"{bound.name} is at its {bound.side} bound; {bound.beyond:g} {change}")
    result.save(arguments.folder / "winner.toml", force=True)


if __name__ == "__main__":
    main()
