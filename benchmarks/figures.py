"""The figures that README and documentation show, by name, each as the text that it should have; `readme.py` compares.

What follows from the templates alone takes some seconds: `of_robots`, `of_engines`, `of_prototypes`,
`of_best_printable`, `of_loads`, `of_assumptions`. The others take minutes: they run the search, PrusaSlicer and the
benchmarks of this folder. Those of calibrations are in `calibrated.py`.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
from start import children_cpu_s

from jumpcad import published
from jumpcad.building import build
from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.facts import arms_off_deg, early_torque_share, least_energy_share, torque_shares
from jumpcad.collision.hulls import share_on_feet
from jumpcad.design import SEARCH_BOUNDS, load_design
from jumpcad.dimensions import AXLE_END_PLAY_MM
from jumpcad.files import template_names
from jumpcad.landing.landing import distances_m, land, share_righted
from jumpcad.landing.series import jumps
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.paper.reproduction import PUBLISHED_RESULTS, PublishedResult
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot
from jumpcad.search.models import PrintedModel
from jumpcad.search.propose import bayesian
from jumpcad.search.study.objective import find_objective
from jumpcad.search.study.variant import Variant
from jumpcad.settings import coefficients
from jumpcad.simulation import Jump, Settings, simulate
from jumpcad.simulation.engines import BUNDLE_ENGINE
from jumpcad.simulation.prior import floors
from jumpcad.simulation.uncertain import uncertainty_of
from jumpcad.workshop import load_workshop, own_workshop

HERE = Path(__file__).parent
ROBOTS = ("kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable")
JUMPER = "best-jumper"
LANDINGS = 20
SHOWN = ("kenan-1.0", "kenan-2.0", "best-printable", "best-upright", "best-range")
"""The templates of the README."""
STRONG = ("best-ga", "best-bo", "best-printable")
PROTOTYPES = tuple(row for row in PUBLISHED_RESULTS if row.measured is not None)
SEARCH = ("optimize", "--bound", "study", "--seed", "7")
RIVALS = ("pybullet", "mujoco", "planar")
"""The engines that are compared."""
PUBLISHED_MS = 40.0
"""CPU time of one published simulation on the machine that all CPU times are scaled to."""
SEARCH_SLACK = 0.01
SPEED_FACTOR = 1.5
"""How far apart, on two machines, the scores of a search (share) and CPU times (factor) may be."""
GRAVITY_M_S2 = Settings().gravity_m_s2


@dataclass(frozen=True)
class Outcome:
    """The result of a search: the winner of `jumpcad optimize --json`, and its CPU time with that of its workers."""

    winner: dict[str, Any]
    cpu_s: float


@cache
def built(name: str) -> tuple[Robot, Jump, Jump]:
    """Return a template's printed robot, its jump, and that of the capsule robot, as `jumpcad build` does."""
    robot, flight = build(load_design(name), name=name), Settings(flight="simulated")
    return robot, simulate(robot, flight, BUNDLE_ENGINE), simulate(capsule_robot(robot.design), flight, BUNDLE_ENGINE)


def mm(length_m: float | None) -> str:
    """Return a length in whole millimetres."""
    assert length_m is not None
    return f"{1000.0 * length_m:.0f} mm"


def grams(masses_kg: Iterable[float]) -> str:
    """Return masses in whole grams."""
    return " and ".join(f"{1000.0 * mass:.0f} g" for mass in masses_kg)


def percent(shares: Iterable[float]) -> str:
    """Return shares in whole per cent."""
    return " and ".join(f"{100.0 * share:.0f} %" for share in shares)


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    """Return a table whose first column is text; the others are figures."""
    lines = [head, ("---", *["--:"] * (len(head) - 1)), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def as_made(robot: Robot) -> str:
    """Return the median way to the touchdown of robots as they may be made of a design."""
    found = uncertainty_of(robot)
    return mm(found.quantiles["touchdown_distance_m"][1]) if found else "–"


def of_robots() -> dict[str, str]:
    """Return the table of all templates."""
    measured = {row.template: row.measured for row in PROTOTYPES}
    rows = []
    for name in ROBOTS:
        robot, jump, capsules = built(name)
        assert robot.layout is not None
        real = measured.get(name)
        rows.append(
            (f"`{name}`", mm(jump.touchdown_distance_m), as_made(robot), mm(jump.ballistic_range_m),
             mm(jump.com_rise_m), grams([robot.mass_kg]), f"{robot.spring.energy_j:.3f} J",
             f"{robot.layout.drive.train.electrical_j:.2f} J", mm(capsules.touchdown_distance_m),
             f"{mm(real.distance_m)}, {mm(real.height_m)}" if real else "not built")
        )  # fmt: skip
    head = ("design", "touchdown", "as made, median", "range, floor or not", "rise", "mass", "energy in the springs",
            "winding energy (electrical)", "touchdown with the study's masses",
            "real robot: distance, height")  # fmt: skip
    return {"robots": table(head, rows)}


def of_order() -> dict[str, str]:
    """Return what the first robot costs, by shop and article; estimates by the largest, and the rest together."""
    lines = bill_of_materials(build(load_design("first-robot"), load_workshop("first-robot"))).items
    rows, rest = dict[tuple[str, str], float](), 0.0
    for one in lines:
        article = re.split(r",| \(", one.name)[0]
        if one.price_from != "estimate" or (one.total_eur or 0.0) > 2.0:
            rows[article, one.price_from] = rows.get((article, one.price_from), 0.0) + (one.total_eur or 0.0)
        else:
            rest += one.total_eur or 0.0
    table = [f"| {article} | {shop} | {euros:.1f} € |" for (article, shop), euros in rows.items()]
    table += [f"| filament, screws, pins, wires and small things | estimate | {rest:.1f} € |"]
    return {"order": "\n".join(["| article | price from | together |", "|---|---|--:|", *table])}


def of_results() -> dict[str, str]:
    """Return how far five of the templates jump, and how far the real ones did."""
    measured = {row.template: row.measured for row in PROTOTYPES}
    rows = []
    for name in SHOWN:
        robot, jump, _ = built(name)
        real = measured.get(name)
        rows.append(
            (f"`{name}`", mm(jump.touchdown_distance_m), as_made(robot), mm(jump.com_rise_m), grams([robot.mass_kg]),
             f"{mm(real.distance_m)}, {mm(real.height_m)}" if real else "not built")
        )  # fmt: skip
    head = ("design", "simulated touchdown", "as made, median", "rise", "mass", "real robot: distance, height")
    return {"results": table(head, rows)}


def of_engines() -> dict[str, str]:
    """Return range and rise of all templates, printed and as capsule robots, in every engine at its default step."""
    rows = []
    for name in ROBOTS:
        printed = built(name)[0]
        for kind, robot in (("printed", printed), ("capsule", capsule_robot(printed.design))):
            jumps = [simulate(robot, engine=engine) for engine in RIVALS]
            found = [[jump.ballistic_range_m for jump in jumps], [jump.com_rise_m for jump in jumps]]
            cells = [f"{1000.0 * (value or 0.0):.1f}" for values in found for value in values]
            rows.append((f"`{name}`, {kind}", *cells, f"{_apart(found[0]):.2f} %, {_apart(found[1]):.2f} %"))
    head = ("robot", *(f"{figure} (mm), {engine}" for figure in ("range", "rise") for engine in RIVALS), "apart")
    return {"engines": table(head, rows)}


def _apart(values: list[float | None]) -> float:
    """Return how far the smallest value is below the largest (%); inf if one is missing."""
    known = [value for value in values if value is not None]
    return 100.0 * (1.0 - min(known) / max(known)) if len(known) == len(values) else float("inf")


def of_prototypes() -> dict[str, str]:
    """Return the prototypes' measured jumps beside the simulated ones, and what the measured ones would need."""
    columns = [_prototype(row) for row in PROTOTYPES]
    head = ("", *(f"{row.title}, {what}" for row in PROTOTYPES for what in ("distance", "height")))
    rows = [(label, *(cell for column in columns for cell in column[label])) for label in columns[0]]
    robots, jumps, capsules = zip(*(built(row.template) for row in PROTOTYPES), strict=True)
    (first_m, second_m), (first, second) = (row.measured.distance_m for row in PROTOTYPES if row.measured), jumps
    return {
        "prototypes": table(head, rows),
        "first touchdown": mm(capsules[1].touchdown_distance_m),
        "damping": percent([capsules[1].energy.joint_damping_j / capsules[1].spring_energy_j]),
        "printed masses": grams(robot.mass_kg for robot in robots),
        "study's masses": grams(jump.mass_kg for jump in capsules),
        "energy needed": percent(map(_least_energy_share, PROTOTYPES)),
        "measured growth": f"{second_m / first_m:.2f}",
        "simulated growth": f"{second.ballistic_range_m / first.ballistic_range_m:.2f}",
    }


def _prototype(row: PublishedResult) -> dict[str, tuple[str, str]]:
    """Return distance and height of a prototype, by where they come from."""
    assert row.measured is not None
    again, (_, jump, capsules) = published.simulate(load_design(row.template)), built(row.template)
    return {
        "the real robot, measured by the study": (mm(row.measured.distance_m), mm(row.measured.height_m)),
        "the study's simulation (`--published`)": (mm(again.distance_m), mm(again.base_height_m)),
        "jumpcad, printed robot": (mm(jump.touchdown_distance_m), mm(jump.com_rise_m)),
        "jumpcad, printed robot, where it comes to rest (`--landing`)": (_rests(row.template), ""),
        "jumpcad, the study's masses (`--capsule`)": (mm(capsules.touchdown_distance_m), mm(capsules.com_rise_m)),
    }


def _rests(name: str) -> str:
    """Return quantiles of the distance at which a robot rests after its jumps."""
    found = distances_m(built(name)[0], LANDINGS, np.random.default_rng(0))
    low, middle, high = np.quantile([rest for _, rest in found], (0.1, 0.5, 0.9))
    return f"{1000.0 * low:.0f}…{1000.0 * middle:.0f}…{mm(high)}"


def _least_energy_share(row: PublishedResult) -> float:
    """Return the energy of a flight of the measured distance and height over that of the springs.

    A flight of distance R and height h takes m·g·(h + R²/16h); if a part of h is gained before take-off, more.
    """
    assert row.measured is not None
    robot, distance, height = built(row.template)[0], row.measured.distance_m, row.measured.height_m
    return robot.mass_kg * GRAVITY_M_S2 * (height + distance**2 / (16.0 * height)) / robot.spring.energy_j


def of_best_printable() -> dict[str, str]:
    """Return the figures of the template `best-printable` that need no search."""
    design, workshop = load_design("best-printable"), load_workshop("default")
    generator = np.random.default_rng(0)
    model, score = PrintedModel(workshop=workshop), find_objective("fitness").score
    one, making = Variant(design), model.making
    neighbours = [*making.varied(one, generator), *making.neighbours(one, generator)]
    refused = sum(score(model(neighbour.design, neighbour.workshop)) is None for neighbour in neighbours)
    bounds = [
        f"`{name}` ({side})"
        for name, bound in SEARCH_BOUNDS.items()
        for side, limit in (("lower", bound.lower), ("upper", bound.upper))
        if getattr(design, name) == limit
    ]
    return {
        "command": f"`jumpcad {' '.join(SEARCH)}`",
        "best score": f"{model(design).metrics['body_lengths']:.2f}",
        "best fitness": f"{built('best-printable')[1].fitness:.2f}",
        "bounds": f"{len(bounds)} parameters: {', '.join(bounds)}",
        "neighbours": f"Of {len(neighbours)} neighbours, half with parameters ±1 %, half with lengths "
        f"±{making.length_mm:g} mm, {refused or 'none'} {'is' if refused < 2 else 'are'} rejected",
    }


def of_springs() -> dict[str, str]:
    """Return how far accepted springs may be off on the templates, and what that does (`jumpcad.bundle.facts`)."""
    robots = [built(name)[0] for name in ROBOTS]
    more = ", ".join(f"{100.0 * (torque_shares(robot)[1] - 1.0):.0f}" for robot in robots)
    wider = sorted({arms_off_deg(robot)[1] for robot in robots})
    early = [100.0 * (early_torque_share(robot) - 1.0) for robot in robots]
    less = [100.0 * (1.0 - least_energy_share(robot)) for robot in robots]
    return {
        "torque accepted": f"{more} %",
        "arms accepted": " or ".join(f"{angle:.0f}" for angle in wider) + "°",
        "early torque": f"{min(early):.0f} to {max(early):.0f} %",
        "weakest springs": f"{min(less):.0f} to {max(less):.0f} %",
    }


def of_loads() -> dict[str, str]:
    """Return what the docs say of loads that checks leave out, of turns in flight, and of the strong designs' cams."""
    strong = [built(name)[0] for name in STRONG]
    seats = [_seat_mpa(LoadCase(robot)) for robot in strong]
    cams = [1000.0 * robot.layout.drive.cam.law.peak_torque_nm for robot in strong]
    first, second, third = (f"{built(name)[1].turn_deg:.0f}°" for name in SHOWN[:3])
    return {
        "plate seats": f"{min(seats):.1f} to {max(seats):.1f}",
        "turns": f"the prototypes turn forwards by {first} and {second}, `best-printable` by {third}",
        "strong cams": f"{min(cams):.0f} to {max(cams):.0f} mN·m",
    }


def _seat_mpa(case: LoadCase) -> float:
    """Return the pressure of axles and pins on the part of their blind bores that their end play leaves them."""
    lateral, longer = case.layout.lateral, {"leg_axle": case.layout.boss_mm}
    seat = lateral.left_plate[1] - lateral.left_plate[0] - case.layout.floor_mm - AXLE_END_PLAY_MM
    loads = (beam.plate_load_n / (seat + longer.get(name, 0.0)) for name, beam in case.beams.items())
    return max(loads) / case.layout.axle_mm


def of_landings() -> dict[str, str]:
    """Return flights and landings of the templates of the default workshop, and what a charge is to best-jumper."""
    rows = []
    for name in ROBOTS:
        robot, jump, _ = built(name)
        found = land(robot, LANDINGS)
        rests = sorted(one.rest_m for one in found.tries)
        side, often = next(iter(found.rests_on.items()))
        rows.append(
            (f"`{name}`", f"{jump.turn_deg:.0f}°", f"{jump.touchdown_pitch_deg:.0f}°", f"{jump.clears_bar_mm:.0f} mm",
             f"{jump.lands_on_mm:.0f} mm", f"{rests[0]:.2f} to {rests[-1]:.2f} m", f"{side} ({often} of {LANDINGS})",
             f"{found.share_righted * LANDINGS:.0f} of {LANDINGS}", percent([share_on_feet(robot)]))
        )  # fmt: skip
    head = ("design", "turn", "pitch at touchdown", "bar", "step", "rests after", "mostly on",
            "stands when wound again", "stable poses on the feet")  # fmt: skip
    return {"landings": table(head, rows), **_of_jumper()}


def _of_jumper() -> dict[str, str]:
    """Return what a charge is to best-jumper, how it walks in three runs, and its pitches on three floors."""
    robot = build(load_design(JUMPER), load_workshop(own_workshop(JUMPER)), JUMPER)  # its name is engraved
    walks = [jumps(robot, 10, seed) for seed in range(3)]
    turns, away = ([getattr(one, name) for one in walks] for name in ("heading_drift_deg", "distance_m"))
    pitches = [simulate(robot, one).touchdown_pitch_deg or 0.0 for one in (Settings(), *floors(robot, Settings()))]
    return {
        "charge": f"{walks[0].jumps_per_charge} jumps, {walks[0].metres_per_charge:.0f} m along its way",
        "walk": f"{min(turns):.0f} to {max(turns):.0f}°, and ends {min(away):.1f} to {max(away):.1f} m from its start",
        "pitches": "{:.0f}°; {:.0f}°, {:.0f}°".format(*pitches).replace("-", "−"),
    }


def of_assumptions() -> dict[str, str]:
    """Return what the docs say of settings, of the search's call in Python, and of what may differ elsewhere."""
    study = coefficients(capsule_robot(load_design("kenan-2.0")), Settings())
    return {
        "assumptions": f"A friction of {study.ground * study.foot:g} and a joint damping of "
        f"{study.joint_damping_nms_per_rad:g} N·m·s/rad",
        "blind time": f"{published.IGNORED_S:g} s",
        "search in Python": f"`best = jumpcad.optimize(bounds=jumpcad.SEARCH_BOUNDS, seed={SEARCH[-1]})`",
        "search slack": percent([SEARCH_SLACK]),
        "idle steps": f"{bayesian.IDLE}",
        "lone steps": f"{bayesian.IDLE_ALONE}",
        "scale": f"{PUBLISHED_MS:.0f} ms; they may be off by a factor of {SPEED_FACTOR:g}",
    }


@cache
def outcome(model: str) -> Outcome:
    """Run the search and return its result."""
    before = children_cpu_s()
    with tempfile.TemporaryDirectory() as folder:
        files = ["--study", f"{folder}/study.db", "-o", f"{folder}/winner.toml"]
        answer = _json("-m", "jumpcad", *SEARCH, "--model", model, *files)
    return Outcome(answer["winner"], children_cpu_s() - before)


def of_search() -> dict[str, str]:
    """Return the score of what the search ends with."""
    return {"search today": f"{outcome('printed').winner['score']:.2f}"}


def of_masses() -> dict[str, str]:
    """Return the largest difference of PrusaSlicer's masses from the mass model's in all shipped workshops."""
    sliced = []
    for workshop in template_names("workshops"):
        with tempfile.TemporaryDirectory() as folder:
            _json("-m", "jumpcad", "build", "kenan-2.0", "--workshop", workshop, "-o", folder + "/b", "--no-pictures")
            sliced.append(_json("-m", "jumpcad", "slice", folder + "/b"))
    worst = max(abs(part["difference"]) for one in sliced for part in one["parts"])
    return {"mass model": f"{100.0 * worst:.1f} % of PrusaSlicer {sliced[0]['slicer']}"}


def of_speed() -> dict[str, str]:
    """Return the table of CPU times, scaled to a machine on which one published simulation takes `PUBLISHED_MS`."""
    evaluator = _json(str(HERE / "evaluator.py"), "--rounds", "3")["speed"]
    evaluate = _json(str(HERE / "evaluate.py"), "--rounds", "1")
    near = evaluate["speed"]["near the best"]
    building = _json(str(HERE / "build.py"), "kenan-2.0")["kenan-2.0"]
    start = _json(str(HERE / "start.py"), "--only", "help_s", "simulate_s", "build_s")
    studio = _json(str(HERE / "studio.py"), "--steps", "1")
    scale = PUBLISHED_MS / evaluator["published"]["cpu_ms"]
    scale_there = PUBLISHED_MS / near["published_ms"]

    def ms(value: float) -> str:
        return f"{value:.{int(value < 10.0)}f} ms"

    def s(value: float) -> str:
        return f"{scale * value:.{int(scale * value < 10.0)}f} s"

    jumper, rng = build(load_design(JUMPER), load_workshop(own_workshop(JUMPER))), np.random.default_rng(0)
    rows = (
        ("one published simulation", ms(PUBLISHED_MS), "`evaluator.py`"),
        ("one simulation of the capsule robot", ms(scale * evaluator["default"]["cpu_ms"]), "`evaluator.py`"),
        ("`jumpcad.evaluate`: one printed robot built, simulated, checked",
         ms(scale_there * near["evaluate_ms"]), "`evaluate.py`"),
        ("… of this, the masses of its parts", ms(scale_there * evaluate["stages_ms"]["printed masses"]),
         "`evaluate.py`"),
        ("`jumpcad build kenan-2.0`", s(start["build_s"]), "`start.py`"),
        ("… of this, pictures", s(building["pictures"]), "`build.py`"),
        ("`jumpcad simulate kenan-2.0 --json`", s(start["simulate_s"]), "`start.py`"),
        ("`jumpcad --help`", s(start["help_s"]), "`start.py`"),
        ("studio: from a slider to the figures with the study's masses", ms(scale * studio["figures"]["median"]),
         "`studio.py`"),
        ("… to the printed robot's figures", ms(scale * studio["printed"]["median"]), "`studio.py`"),
        ("… to its new meshes", ms(scale * studio["meshes"]["median"]), "`studio.py`"),
        ("`best-jumper`: ten jumps in a row", s(_cpu_s(lambda: jumps(jumper, 10))), "`readme.py`"),
        ("… 200 drops in any attitude", s(_cpu_s(lambda: share_righted(jumper, 200, rng))), "`readme.py`"),
        ("the search for `best-printable`, all workers together", s(outcome("printed").cpu_s), "`readme.py`"),
    )  # fmt: skip
    return {"speed": table(("what", "CPU time", "computed by"), rows)}


def _cpu_s(work: Callable[[], object]) -> float:
    begun = process_time()
    work()
    return process_time() - begun


def _json(*arguments: str) -> Any:
    """Return what Python prints with these arguments and `--json`."""
    here = os.environ | {"PYTHONPATH": str(HERE.parent)}
    done = subprocess.run([sys.executable, *arguments, "--json"], check=True, stdout=subprocess.PIPE, env=here)
    return json.loads(done.stdout)
