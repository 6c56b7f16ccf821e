"""What refusing by an estimate of the masses is worth: its error on exact robots, wrong refusals, share caught.

`--robots N` builds N robots of random designs in random workshops, from the shipped ones to all that `estimated_masses`
allows, simulates their jumps, and compares them with the estimates. `--fit` prints the coefficients fitted to them.
Run `python benchmarks/refuse.py --robots 2000 [--seed N] [--fit]`.
"""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import fields
from typing import NamedTuple

import numpy as np

from jumpcad.building import build
from jumpcad.catalogue import load_catalogue
from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import BODY, FOOT, MAIN_LEG, Mechanism
from jumpcad.search.estimate import estimated_masses
from jumpcad.search.estimate.refusal import statics_refusal
from jumpcad.simulation import Settings, simulate
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop, load_workshop, varied

CHOICES = {
    "bought.kit": "kits", "bought.leg_bearing": "bearings", "bought.roller": "bearings", "bought.spring": "springs",
    "bought.leg": "bars", "bought.axle": "rods", "ground.pad": "pads", "body.stop_pad": "pads",
}  # fmt: skip
"""Parts that are chosen at random, and where in the catalogue they stand."""
KINDS = ("shipped", "choices", "own")
ROUNDS = 50
DESIGNS_EACH = 2
"""Designs of each box that are tried in a workshop."""
BOX = {name: (bound.lower, bound.upper) for name, bound in SEARCH_BOUNDS.items()}


def some(rng: np.random.Generator, share: float) -> bool:
    """Return True with a probability."""
    return bool(rng.random() < share)


def workshop(rng: np.random.Generator, templates: dict[str, Workshop]) -> tuple[str, Workshop]:
    """Return a workshop and what it is: shipped, with other choices, or with numbers and parts of its own."""
    base = templates[str(rng.choice(list(templates)))]
    kind = str(rng.choice(KINDS))
    if kind == "shipped":
        return kind, base
    catalogue, values = load_catalogue(), {}
    for key, part in CHOICES.items():
        if some(rng, 0.2):
            values[key] = str(rng.choice(list(getattr(catalogue, part))))
    for role in ("links", "body", "gears"):
        if some(rng, 0.3):
            values[f"roles.{role}"] = str(rng.choice(["PLA", "PETG"]))
    if some(rng, 0.2):
        values["bought.retention"] = str(rng.choice(["plates", "clips", "nuts"]))
    if some(rng, 0.1):
        values["mass.model"] = "solid"
    for key in (("process", "infill"), ("body", "plate_mm")):
        if some(rng, 0.5):
            values[".".join(key)] = float(rng.uniform(*estimated_masses.RANGES[key]))
    if kind == "choices":
        return kind, varied(base, values)
    for (table, key), (low, high) in estimated_masses.ranges().items():
        if some(rng, 0.05):
            values[f"{table}.{key}"] = float(rng.uniform(low, high))
    data = varied(base, values).model_dump(exclude_none=True)
    for material in data["materials"].values():
        for key, (low, high) in estimated_masses.MATERIALS.items():
            if some(rng, 0.3):
                material[key] = float(rng.uniform(low, high))
    if some(rng, 0.5):
        own = catalogue.batteries[data["bought"]["battery"]].model_dump(exclude_none=True)
        own["mass_g"] = float(rng.uniform(*estimated_masses.CARRIED_G["battery"]))
        larger = (own["mass_g"] / rng.uniform(8.0, 12.5)) ** (1.0 / 3.0)  # about as dense as those of the catalogue
        own |= {key: own[key] * larger * rng.uniform(0.85, 1.15) for key in ("length_mm", "width_mm", "height_mm")}
        data["batteries"], data["bought"]["battery"] = {"own": own}, "own"
    if some(rng, 0.3):
        data["bought"]["motors"] = []
    return kind, Workshop(**data)


class Row(NamedTuple):
    """A robot: box, kind of workshop, design, workshop, masses; the verdict with a share of its springs' energy."""

    box: str
    kind: str
    design: Design
    workshop: Workshop
    robot: Mechanism
    share: float
    verdict: str


def robots(count: int, seed: int) -> Iterator[Row]:
    """Yield robots of random designs, half of them within a search's default bounds, for which there is an estimate."""
    rng = np.random.default_rng(seed)
    templates = {name: load_workshop(name) for name in template_names("workshops")}
    found = 0
    while found < count:
        try:
            kind, made = workshop(rng, templates)
        except JumpcadError:  # values that contradict each other
            continue
        boxes = {"default box": BOX, "wider box": estimated_masses.DESIGNS}
        for box, bounds in list(boxes.items()) * DESIGNS_EACH:
            design = Design.from_vector([float(rng.uniform(*bounds[name])) for name in BOX])
            if errors(geometry_findings(design)) or not estimated_masses.known(design, made):
                continue
            try:
                robot = build(design, made, "")
            except JumpcadError:  # no room
                continue
            found += 1
            plain = Mechanism(**{one.name: getattr(robot, one.name) for one in fields(Mechanism)})
            share = float(rng.uniform(0.6, 1.0)) if some(rng, 0.3) else 1.0
            verdict = simulate(robot, Settings(spring_efficiency=share)).verdict
            yield Row(box, kind, design, made, plain, share, verdict)


def report(rows: Sequence[Row]) -> None:
    """Print errors, wrong refusals and the share of refusals caught, for every box and kind of workshop."""
    print("percentiles 0, 1, 50, 99, 100 of estimated over exact energy that statics need, of exact less estimated")
    print("distance from the support's edge (mm)")
    for box in ("default box", "wider box"):
        for kind in (*KINDS, "all"):
            chosen = [row for row in rows if row.box == box and kind in (row.kind, "all")]
            if not chosen:
                continue
            print(f"{box}, {kind}: {len(chosen)} robots")
            estimates = [estimated_masses.robot_of_masses(row.design, row.workshop) for row in chosen]
            pairs = [
                (statics_findings(row.robot), statics_findings(estimate))
                for row, estimate in zip(chosen, estimates, strict=True)
            ]
            energy = [found[1].limit / exact[1].limit for exact, found in pairs if exact[0].margin >= 0.0]
            edge = [exact[0].margin - found[0].margin for exact, found in pairs if exact[1].margin >= 0.0]
            print(f"    energy {shown(energy)}, edge {shown(edge)}")
            how = [Settings(spring_efficiency=row.share) for row in chosen]
            refused = [
                bool(statics_refusal(row.design, row.workshop, one)) for row, one in zip(chosen, how, strict=True)
            ]
            for verdict in sorted({row.verdict for row in chosen}):
                caught = [no for row, no in zip(chosen, refused, strict=True) if row.verdict == verdict]
                wrong = f", {sum(caught)} WRONGLY" if verdict == "jump" else ""
                print(f"    {verdict}: {len(caught)}, {np.mean(caught):.1%} refused first{wrong}")


def shown(values: Sequence[float]) -> str:
    """Return percentiles 0, 1, 50, 99, 100."""
    if not len(values):
        return "-"
    return " ".join(f"{value:.3g}" for value in np.percentile(values, [0, 1, 50, 99, 100]))


def fit(rows: Sequence[Row]) -> None:
    """Print the coefficients that estimate the masses best: least absolute error, relative to the mass."""
    for name in estimated_masses.MASS:
        exact = np.array([1000.0 * row.robot.bodies[name].mass_kg for row in rows])
        bought = np.array([estimated_masses.known_masses(row.design, row.workshop)[name] for row in rows])
        columns = np.array([estimated_masses.mass_features(row.design, row.workshop)[name] for row in rows])
        print(name, least(columns / exact[:, None], (exact - bought) / exact))
    body = [row.robot.bodies[BODY] for row in rows]
    columns = np.array([
        estimated_masses.body_x_features(row.design, row.workshop, 1000.0 * one.mass_kg)
        for row, one in zip(rows, body, strict=True)
    ])  # fmt: skip
    print("body x", least(columns, np.array([1000.0 * one.com_m[0] for one in body])))
    print("body z", np.median([1000.0 * one.com_m[2] for one in body]))
    print("leg", np.median([1000.0 * row.robot.bodies[MAIN_LEG].com_m[0] / row.design.l2_mm for row in rows]))
    foot = np.array([estimated_masses.foot_x_features(row.design) for row in rows])
    print("foot x", least(foot, np.array([1000.0 * row.robot.bodies[FOOT].com_m[0] for row in rows])))


def least(columns: Array, values: Array) -> Array:
    """Return coefficients with the least sum of absolute errors, by least squares with weights."""
    weights, found = np.ones(len(values)), np.zeros(columns.shape[1])
    for _ in range(ROUNDS):
        found = np.linalg.lstsq(columns * weights[:, None], values * weights, rcond=None)[0]
        weights = np.maximum(np.abs(values - columns @ found), 1e-5) ** -0.5
    return found.round(4)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--fit", action="store_true")
    arguments = parser.parse_args()
    (fit if arguments.fit else report)(list(robots(arguments.robots, arguments.seed)))


if __name__ == "__main__":
    main()
