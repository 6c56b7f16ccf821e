"""The figures of calibration and of missing effects that README and docs show; `readme.py` compares them."""

from collections.abc import Iterable
from typing import Any

import calibration
import effects
import numpy as np

from jumpcad.building import build
from jumpcad.calibration import calibrate, load_subject, predicted_jump
from jumpcad.calibration.hypotheses import compare_hypotheses
from jumpcad.design import load_design
from jumpcad.files import to_toml
from jumpcad.simulation import Settings, uncertain_jump

SAMPLER_SLACK = 0.05
"""How far apart (share) quantiles of the sampler may be on two machines."""
SEED = 0
SLIPPERY = 0.4
DIGITS = 3
"""Of what is shipped: millimetres, and parts in a thousand."""
READINGS = {
    ("distance", "centre-of-mass"): "distance, as ballistic range",
    ("distance", "resting-place"): "distance, as resting place",
    ("height", "rise"): "height, as rise",
    ("height", "absolute"): "height, as absolute",
    ("battery", "battery"): "energy from the battery",
}


def of_calibration() -> dict[str, str]:
    """Return the study's test, calibrated on Kenan 1.0 and Kenan 2.0 predicted, and one jump with its interval."""
    found = calibration.paper(SEED)
    rows = {(one["what"], one["as"]): one for one in found["beside"]}
    ballistic, rest = rows["distance", "centre-of-mass"], rows["distance", "resting-place"]
    ways = {one["what"].partition(",")[0]: one for one in found["explanations"]}
    energy, mass = ways["energy of the springs over mass"], ways["mass"]
    rate, travel = ways["spring rate"], ways["travel after landing"]
    if ways["friction of the floor"]["needed"] is not None:
        raise SystemExit("a floor explains the distance of Kenan 2.0: docs/calibration.md says that none does")
    both = found["both"]
    return {
        "calibrated robot": _calibrated(found),
        "calibrated prediction": _beside(rows),
        "calibrated growth": f"The ratio of ranges is predicted as {_three(found['growth'])}; "
        f"{100.0 * found['growth_of_1.40']:.1f} % of the draws reach the measured 1.40.",
        "calibrated explanations": "\n".join(
            (
                "| all else as predicted | needed | instead of |",
                "|---|--:|--:|",
                f"| energy of the springs over mass, of the model's | {energy['needed']:.2f} | "
                f"{energy['predicted']:.2f} |",
                f"| … that is, a robot of | {mass['needed']:.0f} g | {mass['predicted']:.0f} g |",
                f"| … or springs of | {rate['needed']:.1f} N·mm/° | {rate['predicted']:.1f} N·mm/° |",
                f"| or a travel after landing of | {travel['needed']:.0f} mm | |",
            )
        ),
        "calibrated both": "\n".join(
            (
                "| calibrated on both | 10…50…90 %, of the model's |",
                "|---|--:|",
                f"| energy over mass, Kenan 1.0 | {_three(both['energy_per_mass']['kenan-1.0'])} |",
                f"| energy over mass, Kenan 2.0 | {_three(both['energy_per_mass']['kenan-2.0'])} |",
                f"| mass, Kenan 2.0 | {_three(both['parameters']['mass:kenan-2.0'])} |",
            )
        ),
        "calibrated in short": f"a range of {_mm(ballistic['predicted'][1:2])} in the median, or "
        f"{_mm(rest['predicted'][1:2])} to where it came to rest; 350 mm was measured. This is above "
        f"{_share(ballistic['below_share'])} and {_share(rest['below_share'])} of the predictions. To explain it, "
        f"Kenan 2.0 would need {energy['needed'] / energy['predicted']:.1f} times the springs' energy over its mass, "
        f"or {travel['needed']:.0f} mm of travel after landing",
        "calibrated landing": _landed(),
        "calibrated hypotheses": _hypotheses(),
        "uncertain": _uncertain(),
    }


def comparisons() -> dict[str, str]:
    """Return the files of `templates/compared`, by name: each prototype, predicted by a calibration on the other."""
    found = calibration.paper(SEED)
    pairs = (("kenan-2.0", "kenan-1.0", "beside"), ("kenan-1.0", "kenan-2.0", "beside, the other way"))
    return {
        name: f"# jumpcad calibrate {other} --predict {name}\n"
        + to_toml(
            {
                "design": name,
                "calibrated_on": other,
                "rows": [
                    {
                        "what": one["what"],
                        "reading": one["as"],
                        "measured": round(one["measured"], DIGITS),
                        "predicted": [round(value, DIGITS) for value in one["predicted"]],
                        "below_share": round(one["below_share"], DIGITS),
                    }
                    for one in found[key]
                ],
            }
        )
        for name, other, key in pairs
    }


def _landed() -> str:
    """Return the resting place of Kenan 2.0 by simulated landings, calibrated on Kenan 1.0."""
    other = load_subject("kenan-2.0").landing()
    rows = predicted_jump(calibrate(["kenan-1.0"], SEED, landing=True), other, SEED).beside()
    (rest,) = (one for one in rows if one["as"] == "resting-place")
    return (
        f"a travel of {other.travel.first:.0f} ± {other.travel.second:.0f} mm, and a resting place at "
        f"{_mm(rest['predicted'])}. The measured 350 mm is above {_share(rest['below_share'])} of the predictions"
    )


def _calibrated(found: dict[str, Any]) -> str:
    """Return what the first robot's jump says of the parameters."""
    (height,) = (one for one in found["residuals"] if one["what"] == "height")
    reading = max(height["readings"], key=height["readings"].__getitem__)
    words = {"rise": "the rise", "absolute": "the absolute one"}
    known = [one for one in found["parameters"] if one["verdict"] == "identified"]
    if [one["key"] for one in known] != ["drive_efficiency"]:
        raise SystemExit(f"identified are {[one['key'] for one in known]}: docs/calibration.md says the drive alone")
    return (
        f"the likeliest reading of the height is {words[reading]} ({_share(height['readings'][reading])}). Only the "
        f"drive is identified ({_three(known[0]['posterior'])} of the model's efficiency)"
    )


def _hypotheses() -> str:
    """Return the odds of explanations of both prototypes, with what each misses at worst."""
    found = compare_hypotheses([load_subject("kenan-1.0"), load_subject("kenan-2.0")], SEED)
    lines = ["| explanation | travel | odds | energy over mass | Kenan 1.0 misses | Kenan 2.0 misses | read as |",
             "|---|---|--:|--:|--:|--:|---|"]  # fmt: skip
    for one in found:
        missed = [
            ", ".join(
                f"{100.0 * row['off_share']:+.0f} %"
                for row in one["figures"]
                if row["robot"] == robot and row["what"] in one["readings"]
            )
            for robot in one["energy_per_mass"]
        ]
        energies = ", ".join(f"{value:.2f}" for value in one["energy_per_mass"].values())
        read = ", ".join(one["readings"].values())
        lines.append(
            f"| {one['name']} | {one['travel']} | {one['odds']:.2g} | {energies} | {' | '.join(missed)} | {read} |"
        )
    return "\n".join(lines)


def _beside(rows: dict[tuple[str, str], dict[str, Any]]) -> str:
    """Return the table of what is predicted for Kenan 2.0 and what was measured."""
    lines = ["| Kenan 2.0 | predicted (10…50…90 %) | measured | predictions below it |", "|---|--:|--:|--:|"]
    for key, label in READINGS.items():
        one = rows[key]
        battery = key[0] == "battery"
        predicted = f"{_three(one['predicted'])} J" if battery else _mm(one["predicted"])
        measured = f"{one['measured']:.1f} J" if battery else f"{1000.0 * one['measured']:.0f} mm"
        lines.append(f"| {label} | {predicted} | {measured} | {_share(one['below_share'])} |")
    return "\n".join(lines)


def _uncertain() -> str:
    found = uncertain_jump(build(load_design("kenan-2.0")), Settings(), "planar", SEED)
    shares = sorted(found.first_order.items(), key=lambda item: -item[1]["touchdown_distance_m"])
    rows = [f"| index: {name} | {of['touchdown_distance_m']:.2f} |" for name, of in shares]
    span = f"| touchdown, 10…50…90 % | {_mm(found.quantiles['touchdown_distance_m'])} |"
    return "\n".join(("| Kenan 2.0, uncalibrated | |", "|---|--:|", span, *rows))


def of_effects() -> dict[str, str]:
    """Return what effects that are not modelled are worth, and what slippery floors take; from the templates."""
    found = effects.computed()
    priced = {key: [one[key] for one in found["effects"].values()] for key in next(iter(found["effects"].values()))}
    friction = found["floors"]["friction"]
    ranges = [np.array(found["floors"][name]["range_m"]) * 1000.0 for name in effects.SWEPT]
    slips = [next(at for at, far in zip(friction, one, strict=True) if far > 0.98 * one[-1]) for one in ranges]
    low, weaker = friction.index(SLIPPERY), "lower `spring_efficiency` in the settings"
    return {
        "effects": "\n".join(
            (
                "| left out | worth | what to do |",
                "|---|---|---|",
                f"| the main leg bends | holds {_span(priced['leg_flex_energy'])} of the springs' energy; "
                f"{_span(priced['leg_flex_range'])} of the range if none comes back | {weaker} |",
                f"| air drag | {_span(priced['drag_range'])} of the range | give `drag_area_m2` in the settings |",
                f"| internal friction of the springs, {100.0 * effects.SPRING_FRICTION:.0f} % | "
                f"{_span(priced['spring_friction_range'])} of the range | {weaker} |",
                f"| gear stages {100.0 * effects.GEAR_LOSS:.0f} % less efficient | "
                f"{_span(priced['gears_energy'])} more energy and "
                f"{_span(priced['gears_time'])} more time to wind, no range | "
                "measure the battery's energy and calibrate |",
            )
        ),
        "floors": "\n".join(
            (
                f"| | {' | '.join(effects.SWEPT)} |",
                "|---|--:|--:|",
                f"| loses more than 2 % of the range below a friction of | {slips[0]:g} | {slips[1]:g} |",
                f"| range at {SLIPPERY:g}, of that without slipping | "
                + " | ".join(f"{one[low]:.0f} of {one[-1]:.0f} mm" for one in ranges)
                + " |",
            )
        ),
    }


def _three(values: Iterable[float]) -> str:
    return "…".join(f"{value:.2f}" for value in values)


def _mm(values_m: Iterable[float]) -> str:
    return "…".join(f"{1000.0 * value:.0f}" for value in values_m) + " mm"


def _share(value: float) -> str:
    """Return a share in per cent; a sampler's is never whole."""
    return f"{min(100.0 * value, 99.0):.0f} %"


def _span(values: list[float]) -> str:
    return f"{min(values):.1f} to {max(values):.1f} %"
