"""Priors against scipy's distributions."""

import re

import numpy as np
import pytest
from support.places import ROOT

from jumpcad.calibration import priors
from jumpcad.calibration.priors import release_share, weighed_mass


def test_weights_and_floors() -> None:
    """A robot of 110 g by the model that weighs 121 ± 2 g; pulls of 0.5 and 0.7 have the mean 0.6."""
    mass = weighed_mass(121.0, 110.0, 2.0)
    assert (mass.first, mass.second) == pytest.approx((1.1, 2.0 / 110.0))
    assert priors.tested_floor([0.5, 0.7]).first == pytest.approx(0.6)


def test_a_release_keeps_all_or_what_a_standing_cam_leaves() -> None:
    assert release_share(np.array([0.0, 1.0])).tolist() == pytest.approx([0.4, 1.0])


def test_priors_are_those_that_the_documentation_says() -> None:
    """docs/calibration.md, Priors: distributions, and shares of what is weighed, measured and tested."""
    page = (ROOT / "docs" / "calibration.md").read_text(encoding="utf-8").split("**Priors.**")[1].split("| measured")[0]
    shapes = {"N": "normal", "LogN": "lognormal", "U": "uniform"}
    said = {
        name: (shapes[shape], float(first), float(second))
        for name, shape, first, second in re.findall(
            r"(spring efficiency|pin friction|back efficiency|model's|floor) \| (LogN|N|U)\(([\d.]+), ([\d.]+)\)", page
        )
    }
    known = {
        "spring efficiency": priors.SPRING_EFFICIENCY, "pin friction": priors.PIN_FRICTION,
        "back efficiency": priors.BACK_EFFICIENCY, "model's": priors.DRIVE_EFFICIENCY, "floor": priors.FLOOR,
    }  # fmt: skip
    assert {name: (one.shape, one.first, one.second) for name, one in known.items()} == said
    travel, mass = re.search(r"half-normal with (\d+) mm.*mass \| N\(model, (\d+) %\)", page, re.S).groups()  # type: ignore[union-attr]
    assert (priors.TRAVEL_MM.shape, priors.TRAVEL_MM.first, priors.TRAVEL_MM.second) == (
        "half-normal",
        0,
        float(travel),
    )
    floor, weighed = re.search(r"tested floor, (\d+) %/√n.*weighed mass, (\d+) %", page, re.S).groups()  # type: ignore[union-attr]
    assert weighed_mass(100.0, 100.0, None).second == pytest.approx(float(weighed) / 100.0)
    shares = np.hypot(float(mass) * np.array([0.0, 0.5, 1.0]), float(weighed)) / 100.0
    assert [priors.modelled_mass(share).second for share in (0.0, 0.5, 1.0)] == pytest.approx(shares)
    assert priors.tested_floor([0.6]).second == pytest.approx(float(floor) / 100.0)
    assert priors.tested_floor([0.5] * 4).second == pytest.approx(float(floor) / 200.0)


def test_no_mass_and_no_efficiency_falls_to_nothing() -> None:
    """Fifty deviations below the mean there is something left."""
    for prior in (weighed_mass(100.0, 110.0, 50.0), priors.modelled_mass(1.0), priors.SPRING_EFFICIENCY):
        assert 0.05 < prior.at(np.array([-50.0]))[0] < 0.5
