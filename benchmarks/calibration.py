"""Calibration on robots whose parameters are known, and the study's own test: from Kenan 1.0 to Kenan 2.0.

`trials`: parameters are drawn from the priors; the planar engine jumps with them (not the interpolated jumps that the
calibration uses); noise as large as the likelihood says is added. The 80 % interval of every parameter should hold the
true one in 70 to 90 of 100 trials. `paper`: calibrated on the first prototype, the second predicted.
"""

import argparse
import json
import math
from collections import defaultdict
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from jumpcad.calibration import CalibrationModel, calibrate, load_subject, predicted_jump
from jumpcad.calibration.likelihood import ANGLE_DEG, JUMP_SHARE, MODEL_SHARE, STUDENT_T_DEGREES, energy_per_mass
from jumpcad.calibration.measurements import Measurements
from jumpcad.calibration.posterior import CalibrationPosterior, sampled
from jumpcad.calibration.prediction import Prediction
from jumpcad.calibration.priors import FLOOR, PIN_FRICTION, QUANTILES, SPRING_EFFICIENCY, modelled_mass
from jumpcad.calibration.subject import Subject
from jumpcad.calibration.surface import ENERGY
from jumpcad.calibration.video import TakeoffSeen, seen_takeoff
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.settings import Settings
from jumpcad.simulation import Jump, simulate
from jumpcad.transforms import Array

PLANS = ("ranges", "ranges, mass, rate", "ranges, mass, rate, video")
JUMPS = 5
RATE_SHARE, SCALE_SHARE = 0.03, 0.01
FRAMES, CLOCK_S, PIXEL_M = 20, 1.0 / 120.0, 0.002
"""Frames of a video, their distance in time, and how well a point is seen."""
FLOORS_TRIED = 101
"""Coefficients of friction, of which one that explains a distance is chosen."""
SHORT = {"steps": 400, "most_steps": 400, "walkers_each": 40}
"""Many walkers on short chains, some 2,000 independent draws: for hundreds of calibrations."""


def hidden(subject: Subject, rng: np.random.Generator) -> tuple[dict[str, float], Jump]:
    """Draw true parameters from the priors, and the jump of the engine with them; again until it jumps."""
    priors = {
        "spring_efficiency": SPRING_EFFICIENCY,
        "pin_friction": PIN_FRICTION,
        "rate": subject.rate,
        "mass": modelled_mass(1.0),
        "floor": FLOOR,
    }
    while True:
        true = {name: float(prior.at(np.array(rng.standard_normal()))) for name, prior in priors.items()}
        energy = true["spring_efficiency"] * true["rate"] / true["mass"]
        settings = Settings(pin_friction=true["pin_friction"], ground_friction=true["floor"])
        jump = simulate(with_spring_factor(subject.robot, energy), settings, "planar")
        if jump.verdict == "jump":
            return true, jump


def measured(subject: Subject, true: dict[str, float], jump: Jump, plan: int, rng: np.random.Generator) -> Subject:
    """Return the robot with what a plan measures on the hidden one."""
    assert jump.ballistic_range_m is not None
    assert jump.takeoff_speed_m_s is not None
    assert jump.takeoff_angle_deg is not None
    deviation = math.hypot(JUMP_SHARE / math.sqrt(JUMPS), MODEL_SHARE)
    single = JUMP_SHARE * rng.standard_normal(JUMPS)
    logs = (
        math.log(1000.0 * jump.ballistic_range_m)
        + deviation * rng.standard_t(STUDENT_T_DEGREES)
        + single
        - single.mean()
    )
    data: dict[str, Any] = {
        "design": subject.measured.design, "source": "synthetic", "release": "dog",
        "jumps": ({"distance_mm": tuple(np.exp(logs).tolist()), "distance_of": "centre-of-mass"},),
    }  # fmt: skip
    seen: tuple[TakeoffSeen, ...] = ()
    if plan >= 1:
        scale = 1.0 + SCALE_SHARE * rng.standard_normal()
        data["mass"] = {"robot_g": 1000.0 * subject.robot.mass_kg * true["mass"] * scale}
        rate = subject.rate_nmm_per_deg * true["rate"] * (1.0 + RATE_SHARE * rng.standard_normal())
        data["spring"] = {"rate_nmm_per_deg": rate, "springs": 2, "error_share": RATE_SHARE}
    if plan >= 2:
        share = math.hypot(JUMP_SHARE / 2.0, MODEL_SHARE)
        speed = jump.takeoff_speed_m_s * math.exp(share * rng.standard_normal())
        angle = math.radians(jump.takeoff_angle_deg + ANGLE_DEG * rng.standard_normal())
        t = CLOCK_S * np.arange(FRAMES)
        x, z = speed * math.cos(angle) * t, speed * math.sin(angle) * t - 0.5 * 9.81 * t**2
        noise = PIXEL_M * rng.standard_normal((2, FRAMES))
        points = np.column_stack([t, x + noise[0], z + noise[1]])
        seen = (seen_takeoff(points, "synthetic", subject.fastest_m_s),)
        data["videos"] = ({"points": "synthetic.csv", "point": "centre-of-mass"},)
    other = replace(subject, measured=Measurements(**data), seen=seen)
    vars(other).update({name: getattr(subject, name) for name in ("surface", "standing_m", "beyond_m")})
    return other


def trials(robot: str, count: int, seed: int) -> dict[str, Any]:
    """Return, by plan and parameter, in how many trials the 80 % interval holds the truth, and its median width."""
    subject = replace(load_subject(robot), name="robot")
    result: dict[str, Any] = {}
    for plan, name in enumerate(PLANS):
        held: dict[str, list[bool]] = defaultdict(list)
        widths: dict[str, list[float]] = defaultdict(list)
        for trial in range(count):
            rng = np.random.default_rng([seed, trial])
            true, jump = hidden(subject, rng)
            posterior = sampled(CalibrationModel([measured(subject, true, jump, plan, rng)]), trial, **SHORT)
            true["energy per mass"] = true["spring_efficiency"] * true["rate"] / true["mass"]
            found = {key.split(":")[0]: values for key, values in posterior.values.items()}
            found["energy per mass"] = found["spring_efficiency"] * found["rate"] / found["mass"]
            for key, value in true.items():
                low, middle, high = np.quantile(found[key], QUANTILES)
                held[key].append(bool(low <= value <= high))
                widths[key].append(float(high - low) / middle)
        result[name] = {
            key: {"held": sum(held[key]), "of": count, "width_share": float(np.median(widths[key]))} for key in held
        }
    return result


@dataclass(frozen=True)
class Explanation:
    """A property, its predicted value, and the value at which the robot jumps as far as measured (None: no value)."""

    what: str
    predicted: float
    needed: float | None
    unit: str


def explanations(prediction: Prediction, distance_m: float) -> list[Explanation]:
    """Return the values of single properties at which a robot reaches a distance, all others at their medians."""
    subject, surface = prediction.subject, prediction.subject.surface
    values = {key: np.array([float(np.median(value))]) for key, value in prediction.values.items()}
    energy = float(energy_per_mass(subject, values)[0])
    pins, floor = float(values["pin_friction"][0]), float(values[f"floor:{subject.name}"][0])
    energies = np.geomspace(ENERGY[0], ENERGY[-1], 400)
    ranges = surface.at(energies, np.full(400, pins), np.full(400, floor)).range_m
    needed = _crossing(energies, ranges, distance_m)
    mass = float(values[f"mass:{subject.name}"][0]) * 1000.0 * subject.robot.mass_kg
    rate = subject.rate_nmm_per_deg * float(values[f"rate:{subject.pair}"][0])
    floors = np.linspace(0.2, 1.3, FLOORS_TRIED)
    by_floor = surface.at(np.full(FLOORS_TRIED, energy), np.full(FLOORS_TRIED, pins), floors).range_m
    touchdown = float(surface.at(np.array([energy]), np.array([pins]), np.array([floor])).range_m[0])
    touchdown += subject.beyond_m[0]
    return [
        Explanation("energy of the springs over mass, over the model's", energy, needed, ""),
        Explanation("mass, all else as predicted", mass, needed and mass * energy / needed, "g"),
        Explanation("spring rate, all else as predicted", rate, needed and rate * needed / energy, "N·mm/°"),
        Explanation("friction of the floor", floor, _crossing(floors, by_floor, distance_m), ""),
        Explanation("travel after landing", 0.0, 1000.0 * max(distance_m - touchdown, 0.0), "mm"),
    ]


def growth(posterior: CalibrationPosterior, name: str, prediction: Prediction) -> Array:
    """Return the predicted range over that of a robot that was calibrated on (draws,); NaN without a jump."""
    times: Array = prediction.predicted.jump.range_m / posterior.predicted[name].jump.range_m
    return times


def _crossing(at: Array, values: Array, goal: float) -> float | None:
    """Return the first of `at` (n,) whose value (n,) reaches a goal; None if the goal is outside the values."""
    known = np.isfinite(values)
    if not known.any() or not values[known].min() <= goal <= values[known].max():
        return None
    index = int(np.argmax(np.where(known, values, -math.inf) >= goal))
    return float(at[index])


@cache
def paper(seed: int) -> dict[str, Any]:
    """Calibrate on Kenan 1.0, predict Kenan 2.0, and say what would have to differ between them; and the other way."""
    first, second = calibrate(["kenan-1.0"], seed), load_subject("kenan-2.0")
    prediction = predicted_jump(first, second, seed)
    times = growth(first, "kenan-1.0", prediction)
    times = times[np.isfinite(times)]
    both = calibrate(["kenan-1.0", "kenan-2.0"], seed)
    back = predicted_jump(calibrate(["kenan-2.0"], seed), load_subject("kenan-1.0"), seed)
    return {
        "parameters": first.summaries(),
        "energy_per_mass": first.energies(),
        "residuals": first.residuals(),
        "prediction": prediction.quantiles(),
        "beside": prediction.beside(),
        "beside, the other way": back.beside(),
        "growth": np.quantile(times, QUANTILES).tolist(),
        "growth_of_1.40": float((times >= 1.4).mean()),
        "explanations": [vars(one) for one in explanations(prediction, 0.35)],
        "both": {"energy_per_mass": both.energies(), "residuals": both.residuals(), "parameters": _plain(both)},
    }


def _plain(posterior: CalibrationPosterior) -> dict[str, list[float]]:
    return {one["key"]: [round(value, 3) for value in one["posterior"]] for one in posterior.summaries()}


def main() -> None:
    """Compute and print as JSON."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", choices=("trials", "paper"))
    parser.add_argument("--robot", default="kenan-2.0")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    found = (
        paper(arguments.seed) if arguments.part == "paper" else trials(arguments.robot, arguments.count, arguments.seed)
    )
    print(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()
