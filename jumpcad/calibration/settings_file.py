"""The calibrated settings as TOML: medians, for a single jump, and draws, for `jumpcad simulate --uncertain`."""

import numpy as np

from jumpcad.calibration.posterior import CalibrationPosterior
from jumpcad.files import to_toml
from jumpcad.files.outputs import sealed

SAVED = 100
"""Draws in the file."""
DIGITS = 4
KEYS = ("spring_efficiency", "pin_friction")


def settings_toml(posterior: CalibrationPosterior) -> str:
    """Return the settings file of a calibration.

    The friction of the floor is written only if there was one robot and its floor was tested. Mass and rate of the
    springs are not settings: they belong to workshop and design.
    """
    values = {key: np.clip(np.round(posterior.values[key], DIGITS), *_limits(key)) for key in KEYS}
    names = ", ".join(subject.name for subject in posterior.model.subjects)
    comment = [f"# Calibrated on {names} by jumpcad calibrate: medians, and under [draws] what stays open."]
    if "drive_efficiency" in posterior.values:
        drive = float(np.median(posterior.values["drive_efficiency"]))
        comment.append(f"# Drive: the battery gives what jumpcad build says of the winding, over {drive:.2f}.")
    settings = {key: round(float(np.median(found)), DIGITS) for key, found in values.items()}
    (first, *others) = posterior.model.subjects
    if not others and first.floor.shape == "lognormal":
        settings["ground_friction"] = round(float(np.median(posterior.values[f"floor:{first.name}"])), DIGITS)
    chosen = np.linspace(0, len(posterior.z) - 1, SAVED).astype(int)
    draws = {key: found[chosen].tolist() for key, found in values.items()}
    return sealed("\n".join(comment) + "\n" + to_toml({**settings, "draws": draws}))


def _limits(key: str) -> tuple[float, float]:
    least, most = {"spring_efficiency": (0.1, 1.5), "pin_friction": (0.0, 2.0)}[key]
    return least, most
