"""What a search's quick refusal is worth: its error on exact robots, wrong refusals, share caught, time saved.

`--robots N` builds N robots of random designs in random workshops, from the shipped ones to all that
`jumpcad.search.quick_mass` allows, and compares masses and centres exactly with the estimate. `--fit` prints its
coefficients fitted to them. `--speed N` times N random designs against the published simulation, in turn.
Run `python benchmarks/refuse.py --robots 2000 [--seed N] [--fit]` or `python benchmarks/refuse.py --speed 200`.
"""

import argparse
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from time import process_time
from typing import NamedTuple

import numpy as np
from evaluate import cpu_ms

from jumpcad import published
from jumpcad.building import build
from jumpcad.catalogue import load_catalogue
from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import BODY, FOOT, MAIN_LEG, Body
from jumpcad.search import quick_mass, robot_model
from jumpcad.search.quick_refusal import is_certain
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop, load_workshop, varied

CHOICES = {
    "bought.kit": "kits", "bought.leg_bearing": "bearings", "bought.roller": "bearings", "bought.spring": "springs",
    "bought.leg": "bars", "bought.axle": "rods", "ground.pad": "pads", "body.stop_pad": "pads",
}  # fmt: skip
"""Parts that are chosen at random, and where in the catalogue they stand."""
KINDS = ("shipped", "choices", "own")
ROUNDS, WARM = 50, 10
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
            values[".".join(key)] = float(rng.uniform(*quick_mass.RANGES[key]))
    if kind == "choices":
        return kind, varied(base, values)
    for (table, key), (low, high) in quick_mass.ranges().items():
        if some(rng, 0.05):
            values[f"{table}.{key}"] = float(rng.uniform(low, high))
    data = varied(base, values).model_dump(exclude_none=True)
    for material in data["materials"].values():
        for key, (low, high) in quick_mass.MATERIALS.items():
            if some(rng, 0.3):
                material[key] = float(rng.uniform(low, high))
    if some(rng, 0.5):
        own = catalogue.batteries[data["bought"]["battery"]].model_dump(exclude_none=True)
        own["mass_g"] = float(rng.uniform(*quick_mass.CARRIED_G["battery"]))
        larger = (own["mass_g"] / rng.uniform(8.0, 12.5)) ** (1.0 / 3.0)  # about as dense as those of the catalogue
        own |= {key: own[key] * larger * rng.uniform(0.85, 1.15) for key in ("length_mm", "width_mm", "height_mm")}
        data["batteries"], data["bought"]["battery"] = {"own": own}, "own"
    if some(rng, 0.3):
        data["bought"]["motors"] = []
    return kind, Workshop(**data)


class Row(NamedTuple):
    """A robot: its box, its kind of workshop, design, workshop, and its bodies by name."""

    box: str
    kind: str
    design: Design
    workshop: Workshop
    bodies: Mapping[str, Body]


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
        for box, bounds in (("default box", BOX), ("wider box", quick_mass.DESIGNS)) * DESIGNS_EACH:
            design = Design.from_vector([float(rng.uniform(*bounds[name])) for name in BOX])
            if errors(geometry_findings(design)) or not quick_mass.known(design, made):
                continue
            try:
                robot = build(design, made, "")
            except JumpcadError:  # no room
                continue
            found += 1
            yield Row(box, kind, design, made, robot.bodies)


def statics(row: Row, bodies: Mapping[str, Body]) -> tuple[Finding, ...]:
    """Return the findings `tips` and `too_weak` of a row's robot with these bodies."""
    quick = quick_mass.quick_robot(row.design, row.workshop)
    return tuple(statics_findings(replace(quick, bodies=bodies)))


def report(rows: Sequence[Row]) -> None:
    """Print errors, wrong refusals and the share of refusals caught, for every box and kind of workshop."""
    print("needed energy estimated/exact, and exact less estimated distance from the support's edge (mm): percentiles")
    for box in ("default box", "wider box"):
        for kind in (*KINDS, "all"):
            chosen = [row for row in rows if row.box == box and kind in (row.kind, "all")]
            if not chosen:
                continue
            pairs = [(statics(row, row.bodies), statics(row, quick_bodies(row))) for row in chosen]
            energy = [quick[1].limit / exact[1].limit for exact, quick in pairs]
            edge = [exact[0].margin - quick[0].margin for exact, quick in pairs]
            refused = [any(is_certain(one) for one in quick) for _, quick in pairs]
            fails = [bool(errors(exact)) for exact, _ in pairs]
            wrong = sum(no and not bad for no, bad in zip(refused, fails, strict=True))
            print(f"{box}, {kind}: {len(chosen)} robots, energy {shown(energy)}, edge {shown(edge)}")
            print(
                f"    {sum(fails)} fail statics, {sum(refused) / max(1, sum(fails)):.0%} refused first, {wrong} wrongly"
            )


def quick_bodies(row: Row) -> Mapping[str, Body]:
    """Return the estimated bodies of a row."""
    return quick_mass.quick_robot(row.design, row.workshop).bodies


def shown(values: Sequence[float]) -> str:
    """Return percentiles 0, 1, 50, 99, 100."""
    return " ".join(f"{value:.3g}" for value in np.percentile(values, [0, 1, 50, 99, 100]))


def fit(rows: Sequence[Row]) -> None:
    """Print the coefficients that estimate the masses best: least absolute error, relative to the mass."""
    for name in quick_mass.MASS:
        exact = np.array([1000.0 * row.bodies[name].mass_kg for row in rows])
        bought = np.array([quick_mass.known_masses(row.design, row.workshop)[name] for row in rows])
        columns = np.array([quick_mass.mass_features(row.design, row.workshop)[name] for row in rows])
        print(name, least(columns / exact[:, None], (exact - bought) / exact))
    body = [row.bodies[BODY] for row in rows]
    columns = np.array([
        quick_mass.body_x_features(row.design, row.workshop, 1000.0 * one.mass_kg)
        for row, one in zip(rows, body, strict=True)
    ])  # fmt: skip
    print("body x", least(columns, np.array([1000.0 * one.com_m[0] for one in body])))
    print("body z", np.median([1000.0 * one.com_m[2] for one in body]))
    print("leg", np.median([1000.0 * row.bodies[MAIN_LEG].com_m[0] / row.design.l2_mm for row in rows]))
    foot = np.array([quick_mass.foot_x_features(row.design) for row in rows])
    print("foot x", least(foot, np.array([1000.0 * row.bodies[FOOT].com_m[0] for row in rows])))


def least(columns: Array, values: Array) -> Array:
    """Return coefficients with the least sum of absolute errors, by least squares with weights."""
    weights, found = np.ones(len(values)), np.zeros(columns.shape[1])
    for _ in range(ROUNDS):
        found = np.linalg.lstsq(columns * weights[:, None], values * weights, rcond=None)[0]
        weights = np.maximum(np.abs(values - columns @ found), 1e-5) ** -0.5
    return found.round(4)


def speed(count: int, seed: int) -> None:
    """Print CPU times of random designs that are rejected, with and without quick refusals, by verdict.

    Each is timed with the published simulation of the same designs, in turn, so that a busy machine slows both alike.
    """
    rng = np.random.default_rng(seed)
    designs = [Design.from_vector([float(rng.uniform(*limits)) for limits in BOX.values()]) for _ in range(count)]
    exact = replace(robot_model("printed"), stand_in=True)
    for design in designs[:WARM]:
        exact(design)
    for name, model in (("all built", exact), ("refused first", replace(exact, stand_in=False))):
        spent: dict[str, list[float]] = defaultdict(list)
        published_ms = []
        for design in designs:
            published_ms.append(cpu_ms(lambda: published.simulate(design)))  # noqa: B023
            start = process_time()
            found = model(design)
            if not found.feasible:
                spent[found.verdict].append(1000.0 * (process_time() - start))
        rejected = [time for times in spent.values() for time in times]
        base, mean = float(np.mean(published_ms)), float(np.mean(rejected))
        print(f"{name}: {len(rejected)} of {count} rejected; {mean:.1f} ms in the mean, "
              f"{np.median(rejected):.2f} in the middle; published {base:.1f}, ratio {base / mean:.2f}")  # fmt: skip
        print(", ".join(f"{verdict}: {len(times)}, {np.mean(times):.2f} ms" for verdict, times in spent.items()))


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=0)
    parser.add_argument("--speed", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--fit", action="store_true")
    arguments = parser.parse_args()
    rows = list(robots(arguments.robots, arguments.seed))
    if rows:
        (fit if arguments.fit else report)(rows)
    if arguments.speed:
        speed(arguments.speed, arguments.seed)


if __name__ == "__main__":
    main()
