"""What refusing robots before they are built is worth: wrong refusals, share caught, least body.

N robots of random designs in random workshops are built and simulated with a random share of their springs' energy.
The last line has the CPU time of random designs of a search that are refused, over that of published simulations: both
take turns.
Run `python benchmarks/refuse.py --robots 2000 [--seed N]`.
"""

import argparse
from collections import Counter
from collections.abc import Iterator
from time import process_time

import numpy as np

from jumpcad import published
from jumpcad.building import build
from jumpcad.building.growth import statics_refusal
from jumpcad.catalogue import load_catalogue
from jumpcad.design import PRINTED_BOUNDS, Design, load_design
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.mechanism.model import BODY
from jumpcad.search.models import robot_model
from jumpcad.simulation import Settings, simulate
from jumpcad.workshop import Workshop, load_workshop, varied

CHOICES = {
    "bought.kit": "kits", "bought.leg_bearing": "bearings", "bought.roller": "bearings", "bought.spring": "springs",
    "bought.leg": "bars", "bought.axle": "rods", "ground.pad": "pads", "body.stop_pad": "pads",
}  # fmt: skip
"""Parts that are chosen at random, and where in the catalogue they stand."""
NUMBERS = {"process.infill": (0.0, 1.0), "body.plate_mm": (1.0, 5.0)}
"""Numbers that are drawn; the lightest robots have thin plates and no infill."""
TURNS = 150
"""Designs whose refusal is timed."""


def workshop(rng: np.random.Generator) -> Workshop:
    """Return a shipped workshop with other choices and numbers."""
    base, catalogue = load_workshop(str(rng.choice(template_names("workshops")))), load_catalogue()
    values: dict[str, str | float] = {
        key: str(rng.choice(list(getattr(catalogue, part)))) for key, part in CHOICES.items() if rng.random() < 0.2
    }
    return varied(
        base, values | {key: float(rng.uniform(*ends)) for key, ends in NUMBERS.items() if rng.random() < 0.5}
    )


def random_design(rng: np.random.Generator) -> Design:
    """Return a design within the bounds of a search."""
    return Design(**{name: rng.uniform(one.lower, one.upper) for name, one in PRINTED_BOUNDS.items()})


def refusal_share(seed: int) -> float:
    """Return the mean CPU time of refused designs of a search over that of a published simulation."""
    rng, model, known = np.random.default_rng(seed), robot_model(), load_design("kenan-2.0")
    refused: list[float] = []
    simulated: list[float] = []
    while len(refused) < TURNS:
        design, start = random_design(rng), process_time()
        found, middle = model(design), process_time()
        published.simulate(known)
        if not found.feasible:
            refused.append(middle - start)
            simulated.append(process_time() - middle)
    return float(np.mean(refused) / np.mean(simulated))


def robots(count: int, seed: int) -> Iterator[tuple[str, str, float]]:
    """Yield verdict, for what it was refused first if it was, and mass of the body (kg) of random robots."""
    rng, found = np.random.default_rng(seed), 0
    while found < count:
        design = random_design(rng)
        try:
            made = workshop(rng)
            if errors(geometry_findings(design)):
                continue
            robot = build(design, made, "")
        except (JumpcadError, ValueError):  # out of what a design can be, contradictory values, no room
            continue
        found += 1
        settings = Settings(spring_efficiency=float(rng.uniform(0.3, 1.0)))
        refused = [finding.name for finding in statics_refusal(design, made, settings)]
        yield simulate(robot, settings).verdict, "".join(refused), robot.bodies[BODY].mass_kg


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    rows = list(robots(arguments.robots, arguments.seed))
    all_of, refused = (Counter(verdict for verdict, no, _ in rows if no or every) for every in (True, False))
    for verdict, count in sorted(all_of.items()):
        wrongly = sum(no not in ("", one) and (one == "jump" or no == "tips") for one, no, _ in rows if one == verdict)
        wrong = f", {wrongly} WRONGLY" if wrongly else ""
        print(f"{verdict}: {count}, {refused[verdict] / count:.1%} refused first{wrong}")
    print(f"lightest body: {1000.0 * min(mass for *_, mass in rows):.1f} g")
    print(f"a refused design: {refusal_share(arguments.seed):.2f} of a published simulation")


if __name__ == "__main__":
    main()
