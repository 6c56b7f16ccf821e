"""A robot that was not calibrated on: its own properties stay open, shared ones follow the calibration."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from jumpcad.calibration.likelihood import CalibrationModel
from jumpcad.calibration.measurements import Measurements
from jumpcad.calibration.posterior import CalibrationPosterior, sampled
from jumpcad.calibration.prediction import predicted_jump
from jumpcad.calibration.settings_file import SAVED, elsewhere, settings_toml
from jumpcad.calibration.subject import Subject
from jumpcad.settings import Settings, load_settings

SAID: dict[str, Any] = {"design": "kenan-2.0", "source": "a test", "release": "dog"}
HEIGHT = ({"height_mm": (80.0,), "height_of": "absolute"},)
JUMPS = ({"distance_mm": (220.0,), "distance_of": "centre-of-mass"},)


@pytest.fixture(scope="module")
def posterior(subject: Subject) -> CalibrationPosterior:
    """Of a weighed robot on a tested floor."""
    measured = Measurements(**SAID, jumps=JUMPS, mass={"robot_g": 103.0}, floor={"slope_deg": (38.0,)})
    return sampled(CalibrationModel([subject.remeasured(measured)]), 0, 300, 300, 30)


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


def test_springs_that_robots_share_are_those_of_the_calibration(
    posterior: CalibrationPosterior, subject: Subject
) -> None:
    shared = posterior.values["rate:kenan-2.0"]
    found = predicted_jump(posterior, twin(subject, jumps=JUMPS, spring={"pair": "kenan-2.0"}))
    assert found.values["rate:kenan-2.0"] is shared


def test_a_robot_of_the_same_name_has_springs_of_its_own(posterior: CalibrationPosterior, subject: Subject) -> None:
    """As two files measured.toml in two folders: a rate on the scale of 0.8 times the model's is believed."""
    rate = {"rate_nmm_per_deg": 0.8 * subject.rate_nmm_per_deg, "springs": 2}
    found = predicted_jump(posterior, subject.remeasured(Measurements(**SAID, jumps=JUMPS, spring=rate)))
    assert np.median(found.values["rate:kenan-2.0"]) == pytest.approx(0.8, abs=0.01)


def test_what_stays_open_is_drawn_by_the_seed(posterior: CalibrationPosterior, subject: Subject) -> None:
    other = twin(subject, jumps=JUMPS, mass={"robot_g": 103.0})
    draws = [predicted_jump(posterior, other, seed).values["floor:twin"].tolist() for seed in (0, 0, 1)]
    assert draws[0] == draws[1] != draws[2]


def test_a_twin_jumps_as_far_with_a_wider_interval(posterior: CalibrationPosterior, subject: Subject) -> None:
    found = predicted_jump(posterior, twin(subject, jumps=JUMPS, mass={"robot_g": 103.0}))
    low, _, high = found.quantiles()["ballistic_range_m"]
    own = np.quantile(posterior.predicted["kenan-2.0"].jump.range_m, (0.1, 0.5, 0.9))
    assert high - low > own[2] - own[0]
    assert low < own[1] < high
    (row,) = found.beside()
    assert row["measured"] == pytest.approx(0.22)
    assert row["predicted"][0] < 0.22 < row["predicted"][2]


def test_settings_are_read_back(posterior: CalibrationPosterior, tmp_path: Any) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(settings_toml(posterior))
    settings = load_settings(path)
    assert settings.spring_efficiency == pytest.approx(np.median(posterior.values["spring_efficiency"]), abs=1e-4)
    assert settings.ground_friction is None  # the workshop's: a calibrated robot may jump on another floor
    assert len(settings.draws.spring_efficiency) == len(settings.draws.pin_friction) == SAVED
    assert settings.model_copy(update={"draws": Settings().draws}).spring_efficiency == settings.spring_efficiency


def test_what_is_no_setting_is_told_with_its_place(posterior: CalibrationPosterior) -> None:
    """The weight on the scale, the floor on which it slips at 38°, the design's stiffness times what was found."""
    weight, floor, rate = elsewhere(posterior)
    assert weight.startswith("kenan-2.0, in its workshop: [mass.weighed_g] of its parts")
    assert float(weight.split(" it has ")[1].split()[0]) == pytest.approx(103.0, rel=5e-3)
    subject, found = posterior.model.subjects[0], posterior.values
    key = "friction" if subject.robot.workshop.ground.pad else "bare_friction"
    assert floor.startswith(f"kenan-2.0, in its workshop: [ground] {key} = ")
    assert float(floor.split(" = ")[1]) == pytest.approx(math.tan(math.radians(38.0)), rel=0.1)
    assert rate.startswith("kenan-2.0, in its design: stiffness_nmm_per_deg = ")
    stiffness = np.median(found[f"rate:{subject.pair}"]) * subject.robot.design.stiffness_nmm_per_deg
    assert float(rate.split(" = ")[1]) == pytest.approx(stiffness, rel=5e-3)
    (line,) = elsewhere(
        replace(posterior, model=CalibrationModel([subject.remeasured(Measurements(**SAID, jumps=JUMPS))]))
    )
    assert "ground" not in line
