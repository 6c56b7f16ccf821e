"""What a search's quick refusal is worth: its error on exact robots, wrong refusals, share caught, time saved.

`--robots N` builds N robots of random designs in random workshops, from the shipped ones to all that
`quick_mass` allows, simulates their jumps, and compares them with the estimates. `--kinds` chooses among
the kinds of workshops. `--fit` prints the estimates' coefficients fitted to these robots, of `quick_mass` unless all
are near. `--speed N` times N random designs against the published simulation, in turn.
Run `python benchmarks/refuse.py --robots 2000 [--seed N] [--fit]` or `python benchmarks/refuse.py --speed 200`.
"""

import argparse
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import fields, replace
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
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import BODY, FOOT, MAIN_LEG, Mechanism
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.search import robot_model
from jumpcad.search.estimate import quick_mass, sized_robot
from jumpcad.search.estimate.quick_refusal import quick_refusal
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.planar import PlanarWorld
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop, load_workshop, varied
from jumpcad.workshop.varied import Value

CHOICES = {
    "bought.kit": "kits", "bought.leg_bearing": "bearings", "bought.roller": "bearings", "bought.spring": "springs",
    "bought.leg": "bars", "bought.axle": "rods", "ground.pad": "pads", "body.stop_pad": "pads",
}  # fmt: skip
"""Parts that are chosen at random, and where in the catalogue they stand."""
KINDS = ("shipped", "near", "choices", "own")
ROUNDS, WARM = 50, 10
SCAN = np.arange(0.9, 1.3, 0.01)
"""Strengths of the springs with which estimated robots push off."""
FAR_TOO_WEAK = 0.6
"""Share of the energy that is needed, below which robots are not fitted: other estimates refuse them."""
DESIGNS_EACH = 2
"""Designs of each box that are tried in a workshop."""
BOX = {name: (bound.lower, bound.upper) for name, bound in SEARCH_BOUNDS.items()}


def some(rng: np.random.Generator, share: float) -> bool:
    """Return True with a probability."""
    return bool(rng.random() < share)


def workshop(
    rng: np.random.Generator, templates: dict[str, Workshop], kinds: Sequence[str] = KINDS
) -> tuple[str, Workshop]:
    """Return a workshop and what it is: shipped, with other choices, or with numbers and parts of its own."""
    base = templates[str(rng.choice(list(templates)))]
    kind = str(rng.choice(kinds))
    if kind == "shipped":
        return kind, base
    if kind == "near":
        return kind, near_workshop(rng, base)
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


def near_workshop(rng: np.random.Generator, base: Workshop) -> Workshop:
    """Return a workshop that differs from a shipped one in what `sized_robot` allows."""
    values: dict[str, Value] = {}
    for (table, key), limits in sized_robot.NUMBERS.items():
        if some(rng, 0.5):
            values[f"{table}.{key}"] = float(rng.uniform(*limits))
    for role in sized_robot.CHOICES["roles"]:
        if some(rng, 0.3):
            values[f"roles.{role}"] = str(rng.choice(["PLA", "PETG"]))
    batteries = list(base.catalogue.batteries)
    options = {
        "kit": ["light-1s", "strong-2s"], "retention": ["plates", "clips", "nuts"], "leg_bearing": ["any", ""],
        "battery": batteries,
    }  # fmt: skip
    for key, names in options.items():
        if some(rng, 0.3):
            values[f"bought.{key}"] = str(rng.choice(names))
    return varied(base, values)


def is_near(kinds: Sequence[str]) -> bool:
    """Tell whether kinds of workshops are all those of `sized_robot`."""
    return set(kinds) <= {"shipped", "near"}


class Row(NamedTuple):
    """A robot: box, kind of workshop, design, workshop, masses; the verdict with a share of its springs' energy."""

    box: str
    kind: str
    design: Design
    workshop: Workshop
    robot: Mechanism
    share: float
    verdict: str


def robots(count: int, seed: int, kinds: Sequence[str] = KINDS) -> Iterator[Row]:
    """Yield robots of random designs, half of them within a search's default bounds, for which there is an estimate."""
    rng = np.random.default_rng(seed)
    templates = {name: load_workshop(name) for name in template_names("workshops")}
    found = 0
    while found < count:
        try:
            kind, made = workshop(rng, templates, kinds)
        except JumpcadError:  # values that contradict each other
            continue
        boxes = {"default box": BOX} if is_near(kinds) else {"default box": BOX, "wider box": quick_mass.DESIGNS}
        for box, bounds in list(boxes.items()) * DESIGNS_EACH:
            design = Design.from_vector([float(rng.uniform(*bounds[name])) for name in BOX])
            if errors(geometry_findings(design)) or not quick_mass.known(design, made):
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
    print(
        "distance from the support's edge (mm), and of the strength with which estimates of robots that jump take off"
    )
    for box in ("default box", "wider box"):
        for kind in (*KINDS, "all"):
            chosen = [row for row in rows if row.box == box and kind in (row.kind, "all")]
            if not chosen:
                continue
            print(f"{box}, {kind}: {len(chosen)} robots")
            errors_of("quick", chosen, [quick_mass.quick_robot(row.design, row.workshop) for row in chosen])
            near = [row for row in chosen if sized_robot.near(row.design, row.workshop)]
            errors_of("sized", near, [sized_robot.sized_robot(row.design, row.workshop) for row in near])
            refused = [bool(quick_refusal(row.design, row.workshop, how_to_simulate(row))) for row in chosen]
            verdicts = sorted({row.verdict for row in chosen})
            for verdict in verdicts:
                caught = [no for row, no in zip(chosen, refused, strict=True) if row.verdict == verdict]
                wrong = f", {sum(caught)} WRONGLY" if verdict == "jump" else ""
                print(f"    {verdict}: {len(caught)}, {np.mean(caught):.1%} refused first{wrong}")


def how_to_simulate(row: Row) -> Settings:
    """Return the settings in which a search would judge a row first."""
    return robot_model("printed", settings=Settings(spring_efficiency=row.share)).guess_settings


def errors_of(name: str, rows: Sequence[Row], robots: Sequence[Mechanism]) -> None:
    """Print the errors of estimated robots, each of those that the other limits do not reject."""
    pairs = [(statics_findings(row.robot), statics_findings(robot)) for row, robot in zip(rows, robots, strict=True)]
    energy = [quick[1].limit / exact[1].limit for exact, quick in pairs if exact[0].margin >= 0.0]
    edge = [exact[0].margin - quick[0].margin for exact, quick in pairs if exact[1].margin >= 0.0]
    print(f"    {name}: energy {shown(energy)}, edge {shown(edge)}")
    if name == "sized":
        flying = [(robot, row.share) for row, robot in zip(rows, robots, strict=True) if row.verdict == "jump"]
        print(f"    least strength of {len(flying)} that jump: {shown([least_strength(*one) for one in flying])}")


def least_strength(robot: Mechanism, share: float) -> float:
    """Return the least of `SCAN` with which a robot's springs, of a share of their energy, let it take off."""
    settings = robot_model("printed").guess_settings
    for strength in SCAN:
        if PlanarWorld(with_spring_factor(robot, share * strength), settings).push_off().flown:
            return float(strength)
    return float("inf")


def shown(values: Sequence[float]) -> str:
    """Return percentiles 0, 1, 50, 99, 100."""
    if not len(values):
        return "-"
    return " ".join(f"{value:.3g}" for value in np.percentile(values, [0, 1, 50, 99, 100]))


def fit(rows: Sequence[Row]) -> None:
    """Print the coefficients that estimate the masses best: least absolute error, relative to the mass."""
    for name in quick_mass.MASS:
        exact = np.array([1000.0 * row.robot.bodies[name].mass_kg for row in rows])
        bought = np.array([quick_mass.known_masses(row.design, row.workshop)[name] for row in rows])
        columns = np.array([quick_mass.mass_features(row.design, row.workshop)[name] for row in rows])
        print(name, least(columns / exact[:, None], (exact - bought) / exact))
    body = [row.robot.bodies[BODY] for row in rows]
    columns = np.array([
        quick_mass.body_x_features(row.design, row.workshop, 1000.0 * one.mass_kg)
        for row, one in zip(rows, body, strict=True)
    ])  # fmt: skip
    print("body x", least(columns, np.array([1000.0 * one.com_m[0] for one in body])))
    print("body z", np.median([1000.0 * one.com_m[2] for one in body]))
    print("leg", np.median([1000.0 * row.robot.bodies[MAIN_LEG].com_m[0] / row.design.l2_mm for row in rows]))
    foot = np.array([quick_mass.foot_x_features(row.design) for row in rows])
    print("foot x", least(foot, np.array([1000.0 * row.robot.bodies[FOOT].com_m[0] for row in rows])))


def fit_sized(rows: Sequence[Row]) -> None:
    """Print the coefficients of `sized_robot`, fitted to robots that are not far too weak, which others refuse."""
    weak = [statics_findings(row.robot)[1] for row in rows]
    rows = [row for row, one in zip(rows, weak, strict=True) if one.value > FAR_TOO_WEAK * one.limit]
    links = [sized_robot.SizedLinks.of(row.design, row.workshop) for row in rows]
    masses = [{name: 1000.0 * body.mass_kg for name, body in row.robot.bodies.items()} for row in rows]
    tables = {
        "place": ([one.places(mass) for one, mass in zip(links, masses, strict=True)], lambda b: 1e3 * b.com_m[0]),
        "height": ([one.heights(mass) for one, mass in zip(links, masses, strict=True)], lambda b: 1e3 * b.com_m[2]),
        "inertia": (
            [one.inertias(mass) for one, mass in zip(links, masses, strict=True)],
            lambda b: 1e9 * b.inertia_kg_m2[1, 1],
        ),
    }
    for name in sized_robot.MASS:
        exact, known = (np.array([one[name] for one in of]) for of in (masses, [one.known_g for one in links]))
        columns = np.array([one.mass_features[name] for one in links])
        print(name, "mass", least(columns / exact[:, None], (exact - known) / exact))
        for what, (found, true) in tables.items():
            values = np.array([true(row.robot.bodies[name]) for row in rows])
            scale = values if what == "inertia" else np.ones(len(rows))
            print(name, what, least(np.array([one[name] for one in found]) / scale[:, None], values / scale))


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
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS)
    parser.add_argument("--fit", action="store_true")
    arguments = parser.parse_args()
    rows = list(robots(arguments.robots, arguments.seed, arguments.kinds))
    if rows and arguments.fit:
        (fit_sized if is_near(arguments.kinds) else fit)(rows)
    elif rows:
        report(rows)
    if arguments.speed:
        speed(arguments.speed, arguments.seed)


if __name__ == "__main__":
    main()
