"""Priors against scipy's distributions."""

import numpy as np
import pytest
from scipy import stats

from jumpcad.calibration import priors
from jumpcad.calibration.priors import Prior, release_share, weighed_mass

SHARES = (0.05, 0.1, 0.5, 0.9, 0.99)


@pytest.mark.parametrize(
    ("prior", "known"),
    [
        (Prior("normal", 0.95, 0.05, ""), stats.norm(0.95, 0.05)),
        (Prior("lognormal", 0.25, 0.4, ""), stats.lognorm(0.4, scale=0.25)),
        (Prior("uniform", 0.3, 1.0, ""), stats.uniform(0.3, 0.7)),
        (Prior("half-normal", 0.0, 60.0, ""), stats.halfnorm(scale=60.0)),
    ],
)
def test_quantiles(prior: Prior, known: stats.rv_continuous) -> None:
    assert prior.quantiles(SHARES) == pytest.approx(known.ppf(SHARES), rel=1e-9)


def test_a_normal_one_ends_at_its_least_value() -> None:
    assert Prior("normal", 1.0, 0.2, "", 0.1).at(np.array([-50.0, 0.0])).tolist() == [0.1, 1.0]


def test_weights_and_floors() -> None:
    """A robot of 110 g by the model that weighs 121 ± 2 g; pulls of 0.5 and 0.7 have the mean 0.6."""
    mass = weighed_mass(121.0, 110.0, 2.0)
    assert (mass.first, mass.second) == pytest.approx((1.1, 2.0 / 110.0))
    assert priors.tested_floor([0.5, 0.7]).first == pytest.approx(0.6)


def test_a_release_keeps_all_or_what_a_standing_cam_leaves() -> None:
    assert release_share(np.array([0.0, 1.0])).tolist() == pytest.approx([0.4, 1.0])
