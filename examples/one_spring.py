"""With a given spring, which links jump farthest?

Spring, winding and rest angle stay those of the prototypes; only the links are searched. From fewer
than 100 evaluations a search may bring links that jump less far than the prototypes'.
Run `python examples/one_spring.py [--model capsule] [--evaluations 100]`.
"""

import argparse

import jumpcad
from jumpcad.search import robot_model


def main() -> None:
    """Compare both prototypes with the best links for their spring."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", default="printed")
    parser.add_argument("--evaluations", type=int, default=100)
    arguments = parser.parse_args()
    model = robot_model(arguments.model)
    for name in ("kenan-1.0", "kenan-2.0"):
        evaluation = model(jumpcad.load_design(name))
        print(f"{name:10s} {evaluation.verdict}: {evaluation.metrics.get('fitness', 0.0):.3f} of the longest link")

    prototype = jumpcad.load_design("kenan-2.0")
    kept = ("stiffness_nmm_per_deg", "compression_ratio", "rest_angle_deg")
    best = jumpcad.optimize(
        "bo",
        evaluations=arguments.evaluations,
        model=arguments.model,
        objective="fitness",
        fixed={name: getattr(prototype, name) for name in kept},
    )
    print(f"best links jump: {best.score:.3f} of the longest link")
    print(best.design.to_toml())


if __name__ == "__main__":
    main()
