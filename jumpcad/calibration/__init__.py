"""From measured jumps to a calibrated model, and from a calibrated model to jumps with an interval.

The public names load when they are first used.
"""

from typing import TYPE_CHECKING

from jumpcad.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from jumpcad.calibration import plots as plots
    from jumpcad.calibration.likelihood import CalibrationModel as CalibrationModel
    from jumpcad.calibration.measurements import Measurements as Measurements
    from jumpcad.calibration.measurements import load_measurements as load_measurements
    from jumpcad.calibration.posterior import CalibrationPosterior as CalibrationPosterior
    from jumpcad.calibration.posterior import calibrate as calibrate
    from jumpcad.calibration.prediction import explanations as explanations
    from jumpcad.calibration.prediction import predicted_jump as predicted_jump
    from jumpcad.calibration.settings_file import elsewhere as elsewhere
    from jumpcad.calibration.settings_file import settings_toml as settings_toml
    from jumpcad.calibration.subject import Subject as Subject
    from jumpcad.calibration.subject import load_subject as load_subject

_HOMES = {
    "CalibrationPosterior": "posterior",
    "Measurements": "measurements",
    "CalibrationModel": "likelihood",
    "Subject": "subject",
    "calibrate": "posterior",
    "elsewhere": "settings_file",
    "explanations": "prediction",
    "load_measurements": "measurements",
    "load_subject": "subject",
    "plots": "plots",
    "predicted_jump": "prediction",
    "settings_toml": "settings_file",
}

__all__ = list(_HOMES)
__getattr__, __dir__ = lazy_exports(__name__, _HOMES)
