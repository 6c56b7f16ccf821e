"""A robot that was not calibrated on: its own properties stay open, shared ones follow the calibration."""

from typing import Any

import numpy as np
import pytest

from jumpcad.calibration.likelihood import Model
from jumpcad.calibration.measurements import Measurements
from jumpcad.calibration.posterior import CalibrationPosterior, sampled
from jumpcad.calibration.prediction import explanations, growth, predicted_jump
from jumpcad.calibration.settings_file import SAVED, settings_toml
from jumpcad.calibration.subject import Subject
from jumpcad.settings import Settings, load_settings

SAID: dict[str, Any] = {"design": "kenan-2.0", "source": "a test", "release": "dog"}
JUMPS = ({"distance_mm": (220.0,), "distance_of": "centre-of-mass"},)


@pytest.fixture(scope="module")
def posterior(subject: Subject) -> CalibrationPosterior:
    """Of a weighed robot on a tested floor."""
    measured = Measurements(**SAID, jumps=JUMPS, mass={"robot_g": 103.0}, floor={"slope_deg": (38.0,)})
    return sampled(Model([subject.remeasured(measured)]), 0, 300, 300, 30)


def twin(subject: Subject, **data: Any) -> Subject:
    """Return the same robot under another name, with a pair of springs of its own."""
    found = subject.remeasured(Measurements(**SAID, **data))
    object.__setattr__(found, "name", "twin")
    return found


def test_shared_parameters_are_those_of_the_calibration(posterior: CalibrationPosterior, subject: Subject) -> None:
    found = predicted_jump(posterior, twin(subject, jumps=JUMPS, mass={"robot_g": 103.0}))
    assert found.values["spring_efficiency"] is posterior.values["spring_efficiency"]
    assert np.corrcoef(found.values["floor:twin"], posterior.values["floor:kenan-2.0"])[0, 1] == pytest.approx(
        0.0, abs=0.1
    )


def test_a_twin_jumps_as_far_with_a_wider_interval(posterior: CalibrationPosterior, subject: Subject) -> None:
    found = predicted_jump(posterior, twin(subject, jumps=JUMPS, mass={"robot_g": 103.0}))
    low, middle, high = found.quantiles()["ballistic_range_m"]
    own = np.quantile(posterior.predicted["kenan-2.0"].jump.range_m, (0.1, 0.5, 0.9))
    assert high - low > own[2] - own[0]
    assert low < own[1] < high
    (row,) = found.beside()
    assert row["measured"] == pytest.approx(0.22)
    assert row["predicted"][0] < 0.22 < row["predicted"][2]
    assert np.nanmedian(growth(posterior, "kenan-2.0", found)) == pytest.approx(middle / own[1], rel=0.1)


def test_explanations_reach_the_distance(posterior: CalibrationPosterior, subject: Subject) -> None:
    """The energy that is said to be needed does give the distance; the mass is its inverse."""
    found = predicted_jump(posterior, twin(subject, jumps=JUMPS, mass={"robot_g": 103.0}))
    energy, mass, rate, floor, travel = explanations(found, 0.35)
    assert energy.needed is not None
    pins = np.array([np.median(found.values["pin_friction"])])
    ground = np.array([np.median(found.values["floor:twin"])])
    assert subject.surface.at(np.array([energy.needed]), pins, ground).range_m[0] == pytest.approx(0.35, rel=0.02)
    assert mass.needed == pytest.approx(mass.predicted * energy.predicted / energy.needed)
    assert rate.needed == pytest.approx(rate.predicted * energy.needed / energy.predicted)
    assert floor.needed is None  # a foot that sticks already gains nothing from more friction
    assert travel.needed == pytest.approx(350.0 - 220.0, abs=30.0)


def test_settings_are_read_back(posterior: CalibrationPosterior, tmp_path: Any) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(settings_toml(posterior))
    settings = load_settings(path)
    assert settings.spring_efficiency == pytest.approx(np.median(posterior.values["spring_efficiency"]), abs=1e-4)
    assert settings.ground_friction == pytest.approx(np.tan(np.radians(38.0)), rel=0.1)
    assert len(settings.draws.spring_efficiency) == len(settings.draws.pin_friction) == SAVED
    assert settings.model_copy(update={"draws": Settings().draws}).spring_efficiency == settings.spring_efficiency
