"""Competing explanations of measured jumps, and the odds that the measurements give them.

Each explanation changes what all robots have in common: springs, or energy over mass. The odds are ratios of evidences,
the mean likelihood over draws from the priors. Unlike a calibration, which takes each measurement alone, all robots
were measured in one way: their distances have one reading, their heights another.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
from scipy.special import logsumexp

from jumpcad.calibration.likelihood import CalibrationModel, Datum, Predicted, energy_per_mass, predict
from jumpcad.calibration.priors import Prior
from jumpcad.calibration.subject import Subject
from jumpcad.transforms import Array

DRAWS = 100_000
"""Draws from the priors for each explanation."""
PRELOAD_DEG = Prior("half-normal", 0.0, 15.0, "judgement: arms are bent by hand, and springs are mounted by eye")
PRELOADS = (0.1, 0.3, 0.5, 0.7, 0.9)
"""Probabilities at which the preload is taken: each stands for a fifth of its prior."""
SHARED_FACTOR = Prior("lognormal", 1.0, 0.5, "judgement: anything that all robots have in common")

Values = dict[str, Array]
Parts = list[tuple[Sequence[Subject], Values]]
"""Parts of equal probability: the robots, and parameters by key, each (n,)."""


def compare_hypotheses(subjects: Sequence[Subject], seed: int = 0) -> list[dict[str, Any]]:
    """Return every explanation with its odds over the first, and what it predicts, as plain data.

    Each is taken with the travel after landing of its prior, and with that of simulated landings (MuJoCo).
    """
    model, landed = CalibrationModel(subjects), CalibrationModel([subject.landing() for subject in subjects])
    found = []
    for name, explained in HYPOTHESES.items():
        rng = np.random.default_rng(seed)
        z = rng.standard_normal((DRAWS, len(model.parameters)))
        parts = explained(subjects, model.values(z), rng)
        for travel, after in (("prior", model.values(z)), ("simulated", landed.values(z))):
            travels = {key: one for key, one in after.items() if key.startswith("travel:")}
            draws = [(robots, changed | travels) for robots, changed in parts]
            found.append({"name": name, "travel": travel} | _judged(model, draws))
    first = found[0]["log_evidence"]
    for one in found:
        one["odds"] = math.exp(one.pop("log_evidence") - first)
    return found


def _judged(model: CalibrationModel, draws: Parts) -> dict[str, Any]:
    """Return evidence, likeliest reading, and energies and measurements as predicted under that reading."""
    parts = [{one.name: predict(one, values) for one in robots} for robots, values in draws]
    kinds = {one.what: one.readings for one in model.data if one.of == "unknown"}
    ways = [dict(zip(kinds, way, strict=True)) for way in product(*kinds.values())]
    chance = np.array([[_log_likelihood(model, part, way) for part in parts] for way in ways])
    likely = int(np.argmax(logsumexp(chance, axis=(1, 2))))
    weight = np.exp(chance[likely] - chance[likely].max()).ravel()
    rows = [_row(datum, parts, ways[likely].get(datum.what, datum.of), weight) for datum in model.data]
    energies = {}
    for place, one in enumerate(model.subjects):
        springs = [robots[place].robot.spring.energy_j / one.robot.spring.energy_j for robots, _ in draws]
        given = [more * energy_per_mass(one, values) for more, (_, values) in zip(springs, draws, strict=True)]
        energies[one.name] = _median(np.concatenate(given), weight)
    return {
        "log_evidence": float(logsumexp(chance)) - math.log(chance.size), "readings": ways[likely],
        "energy_per_mass": energies, "figures": rows,
        "worst_share": max(abs(row["off_share"]) for row in rows if row["what"] != "battery"),
    }  # fmt: skip


def _log_likelihood(model: CalibrationModel, predicted: dict[str, Predicted], way: dict[str, str]) -> Array:
    """Return the logarithm of the likelihood (n,) where all lengths of a kind have one reading."""
    found: Array = np.zeros(1)
    for datum in model.data:
        alike = replace(datum, of=way.get(datum.what, datum.of)) if datum.of == "unknown" else datum
        found = found + model.log_readings(alike, predicted[datum.subject])[0]
    return np.where(np.isfinite(found), found, -np.inf)


def _row(datum: Datum, parts: list[dict[str, Predicted]], reading: str, weight: Array) -> dict[str, Any]:
    """Return a measurement beside the weighted median of its predictions."""
    reading = reading if datum.of == "unknown" else datum.of
    median = _median(np.concatenate([part[datum.subject].of(datum.what, reading) for part in parts]), weight)
    return {"robot": datum.subject, "what": datum.what, "as": reading, "measured": datum.value, "predicted": median,
            "off_share": median / datum.value - 1.0}  # fmt: skip


def _median(values: Array, weight: Array) -> float:
    """Return the weighted median of values (n,); those that are not finite have no weight."""
    order = np.argsort(values)
    share = np.cumsum(np.where(np.isfinite(values), weight, 0.0)[order])
    return float(values[order][int(np.searchsorted(share, 0.5 * share[-1]))])


def _scaled(values: Values, kind: str, factor: float | Array) -> Values:
    """Return parameters of which those of a kind are multiplied."""
    return {key: factor * one if key.startswith(f"{kind}:") else one for key, one in values.items()}


def _preloaded(subjects: Sequence[Subject], values: Values) -> Parts:
    """The springs are still loaded at rest, by one angle in all robots; the battery gives that much more."""
    parts: Parts = []
    for preload_deg in PRELOAD_DEG.quantiles(PRELOADS):
        robots = [_with_preload(subject, math.radians(preload_deg)) for subject in subjects]
        more = np.mean(
            [one.robot.spring.energy_j / old.robot.spring.energy_j for one, old in zip(robots, subjects, strict=True)]
        )
        drive = {"drive_efficiency": values["drive_efficiency"] / more} if "drive_efficiency" in values else {}
        parts.append((robots, values | drive))
    return parts


def _with_preload(subject: Subject, preload_rad: float) -> Subject:
    """Return a robot whose springs are loaded further; the leg leaves the cam with the same share of their energy."""
    robot = subject.robot
    spring = replace(robot.spring, preload_rad=robot.spring.preload_rad + preload_rad)
    faster = math.sqrt(spring.energy_j / robot.spring.energy_j)
    off = robot.roller_off and replace(robot.roller_off, leg_rad_s=faster * robot.roller_off.leg_rad_s)
    return replace(subject, robot=replace(robot, springs=(spring,), roller_off=off))


HYPOTHESES: dict[str, Callable[[Sequence[Subject], Values, np.random.Generator], Parts]] = {
    "as designed": lambda subjects, values, _: [(subjects, values)],
    "springs preloaded at rest": lambda subjects, values, _: _preloaded(subjects, values),
    "two springs of the stated rate": lambda subjects, values, _: [(subjects, _scaled(values, "rate", 2.0))],
    "one factor on energy over mass": lambda subjects, values, rng: [
        (subjects, _scaled(values, "mass", 1.0 / SHARED_FACTOR.at(rng.standard_normal(DRAWS))))
    ],
}
"""What each explanation makes of robots and parameters; the first is that to which the others' odds are."""
