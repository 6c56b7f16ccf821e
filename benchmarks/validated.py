"""The tables of docs/validation.md, as `jumpcad validate` computes them; `readme.py` compares them."""

from typing import Any

from jumpcad.validation.table import TIERS, validate

SEED = 0
LABELS = {
    "takeoff_speed_m_s": ("take-off speed", "m/s"), "takeoff_angle_deg": ("take-off angle", "°"),
    "efficiency": ("kinetic over spring energy", ""), "pushoff_ms": ("push-off", "ms"), "height_m": ("height", "m"),
    "distance_m": ("distance", "m"), "jump_s": ("time in the air", "s"),
}  # fmt: skip


def of_validation() -> dict[str, str]:
    """Return a table for every tier in which something is computed or measured."""
    robots = validate(seed=SEED)
    made = {}
    for tier in TIERS[:-1]:
        lines = ["| robot | figure | measured | known | computed (5…50…95 %) | |", "|---|---|--:|---|--:|---|"]
        for robot in robots:
            if robot["tier"] == tier:
                lines += [_line(robot["name"], row) for row in robot["figures"]]
        made[f"validation {tier}"] = "\n".join(lines)
    return made


def _line(robot: str, row: dict[str, Any]) -> str:
    name, _, reading = row["name"].partition(" as ")
    label, unit = LABELS[name]
    mark = " ?" if row["confidence"] in ("remembered", "derived") else ""
    computed = "" if row["low"] is None else f"{row['low']:.3g}…{row['median']:.3g}…{row['high']:.3g}"
    read = f" as {reading}" if reading else ""
    measured = f"{row['measured']:.3g} {unit}".strip()
    return f"| {robot} | {label}{read} | {measured}{mark} | {row['confidence']} | {computed} | {row['verdict']} |"
