"""Kenan 2.0's story: the lab has one spring. Which links make the most of it?

Spring, winding and rest angle stay those of the prototypes; only the links are searched.
Run `python examples/one_spring.py [--model capsule] [--evaluations 100]`.
"""

import argparse

from jumpcad import load_design, load_workshop
from jumpcad.search.models import RobotModel
from jumpcad.search.pool import local_pool
from jumpcad.search.request import Request
from jumpcad.search.space import Space
from jumpcad.search.study import run_study


def main() -> None:
    """Compare both prototypes with the best links for their spring."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", default="printed")
    parser.add_argument("--evaluations", type=int, default=100)
    arguments = parser.parse_args()
    model = RobotModel(arguments.model, load_workshop("default") if arguments.model == "printed" else None)
    prototype = load_design("kenan-2.0")
    kept = ("stiffness_nmm_per_deg", "compression_ratio", "rest_angle_deg")
    space = Space.parse(fix=[f"{name}={getattr(prototype, name)}" for name in kept])

    for name in ("kenan-1.0", "kenan-2.0"):
        evaluation = model(load_design(name))
        print(f"{name:10s} {evaluation.verdict}: {evaluation.metrics.get('fitness', 0.0):.3f} body lengths")
    with local_pool() as pool:
        result = run_study(Request(space, model, method="bo", evaluations=arguments.evaluations), None, pool)
    if result.winner is None:
        raise SystemExit("no design jumps: allow more evaluations")
    print(f"best links jump: {result.winner.score:.3f} body lengths")
    print(result.winner.design.to_toml())


if __name__ == "__main__":
    main()
