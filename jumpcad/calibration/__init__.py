"""From measured jumps to a calibrated model, and from a calibrated model to jumps with an interval."""

from jumpcad.calibration.likelihood import CalibrationModel
from jumpcad.calibration.measurements import Measurements, load_measurements
from jumpcad.calibration.posterior import CalibrationPosterior, calibrate
from jumpcad.calibration.prediction import elsewhere, predicted_jump, settings_toml
from jumpcad.calibration.subject import Subject, load_subject

__all__ = [
    "CalibrationModel", "CalibrationPosterior", "Measurements", "Subject", "calibrate", "elsewhere",
    "load_measurements", "load_subject", "predicted_jump", "settings_toml",
]  # fmt: skip
