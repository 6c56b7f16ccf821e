"""Prior distributions of calibrated parameters, each as a function of a standard normal variable z.

The sampler works on z; a parameter about which the data say nothing keeps its mean 0 and standard deviation 1.
"""

import math

import numpy as np

from jumpcad.simulation.prior import PIN_FRICTION as PIN_FRICTION
from jumpcad.simulation.prior import QUANTILES as QUANTILES
from jumpcad.simulation.prior import SPRING_EFFICIENCY as SPRING_EFFICIENCY
from jumpcad.simulation.prior import Prior as Prior
from jumpcad.transforms import Array

BACK_EFFICIENCY = Prior("uniform", 0.0, 1.0, "nothing is known of a release without a dog")
DRIVE_EFFICIENCY = Prior("lognormal", 0.7, 0.4, "judgement: cam and lever rub, which the model of gears leaves out")
FLOOR = Prior("uniform", 0.3, 1.0, "plastic on tile to rubber on concrete")
TRAVEL_MM = Prior("half-normal", 0.0, 200.0, "simulated landings of the templates travel 130 to 280 mm")
MASS_SHARE = 0.2
"""Relative deviation of a built robot's mass from the model's if nothing is weighed: other builders and materials."""
WEIGHED_SHARE = 0.01
"""Relative error of a mass on a kitchen scale."""
FLOOR_TEST_SHARE = 0.1
"""Relative scatter of single pulls or slopes on one floor; judgement."""
KEPT_WITHOUT_BACKDRIVE = 0.4
"""Share of the springs' energy that is left by a release without a dog whose cam cannot be driven back; judgement:
0.23 to 0.60 were computed for the first printed robots."""


def release_share(back_efficiency: Array) -> Array:
    """Return the share of the springs' energy that is left after a release without a dog."""
    return np.asarray(KEPT_WITHOUT_BACKDRIVE + (1.0 - KEPT_WITHOUT_BACKDRIVE) * back_efficiency)


def weighed_mass(weighed_g: float, model_g: float, error_g: float | None) -> Prior:
    """Return the prior of a weighed robot's mass over the model's."""
    error = WEIGHED_SHARE * weighed_g if error_g is None else error_g
    return Prior("normal", weighed_g / model_g, error / model_g, "weighed", 0.1)


def modelled_mass(open_share: float) -> Prior:
    """Return the prior of a mass over the model's; `open_share` is the share of the mass that is not weighed."""
    return Prior("normal", 1.0, math.hypot(MASS_SHARE * open_share, WEIGHED_SHARE), "model of printed parts", 0.1)


def tested_floor(found: list[float]) -> Prior:
    """Return the prior of a floor's coefficient of friction from single tests."""
    mean = float(np.mean(found))
    return Prior("lognormal", mean, FLOOR_TEST_SHARE / math.sqrt(len(found)), "pulled or tilted")
