"""A robot that was not calibrated on: its own properties stay open, shared ones follow the calibration."""

import math
import tomllib
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from jumpcad.calibration.likelihood import CalibrationModel
from jumpcad.calibration.measurements import Measurements
from jumpcad.calibration.posterior import CalibrationPosterior, sampled
from jumpcad.calibration.prediction import explanations, growth, predicted_jump
from jumpcad.calibration.settings_file import SAVED, _limits, elsewhere, settings_toml
from jumpcad.calibration.subject import Subject
from jumpcad.errors import JumpcadError
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
    (rate,) = (one for one in explanations(found, 0.3) if one.unit == "N·mm/°")
    assert rate.predicted == pytest.approx(subject.rate_nmm_per_deg * np.median(shared))


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
    middle = {key: float(np.median(value)) for key, value in found.values.items()}
    assert mass.predicted == pytest.approx(1000.0 * subject.robot.mass_kg * middle["mass:twin"])
    assert rate.predicted == pytest.approx(subject.robot.design.stiffness_nmm_per_deg * middle["rate:twin"])
    assert energy.predicted == pytest.approx(middle["spring_efficiency"] * middle["rate:twin"] / middle["mass:twin"])
    assert floor.predicted == middle["floor:twin"]
    reached = subject.surface.at(np.array([energy.predicted]), pins, ground).range_m[0]
    assert travel.needed == pytest.approx(1000.0 * (0.35 - reached - subject.beyond_m[0]))
    assert floor.needed is None  # a foot that sticks already gains nothing from more friction
    assert travel.needed == pytest.approx(350.0 - 220.0, abs=30.0)


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


def test_the_draws_of_a_file_are_spread_over_the_whole_chain(posterior: CalibrationPosterior) -> None:
    """From the first to the last, in pairs: neighbours are of the same walkers and alike."""
    kept, found = tomllib.loads(settings_toml(posterior))["draws"], posterior.values
    rows = np.linspace(0, len(posterior.z) - 1, 100).astype(int)
    assert len(posterior.z) > 10 * len(rows)
    for key in ("spring_efficiency", "pin_friction"):
        low, high = _limits(key)
        assert kept[key] == pytest.approx(np.clip(found[key][rows], low, high), abs=6e-5)


def test_an_easier_floor_explains_a_jump_that_slipped(posterior: CalibrationPosterior, subject: Subject) -> None:
    """Of two floors with one range each, that on which the robot jumps as far; nearer than measured needs no travel."""
    found = predicted_jump(posterior, twin(subject, jumps=JUMPS, mass={"robot_g": 103.0}))
    values = {key: np.array([np.median(value)]) for key, value in found.values.items()}
    energy = values["spring_efficiency"] * values["rate:twin"] / values["mass:twin"]
    slips = float(subject.surface.at(energy, values["pin_friction"], np.array([0.42])).range_m[0])
    *_, floor, travel = explanations(found, slips)
    assert floor.needed == pytest.approx(0.42, abs=0.012)  # one of 101 from 0.2 to 1.3
    assert travel.needed == 0.0


def test_errors_are_in_what_a_measurement_is_predicted_as(posterior: CalibrationPosterior, subject: Subject) -> None:
    """A height scatters by 15 mm besides its shares; of a normal, 10 and 90 % lie 1.2816 deviations off the middle."""
    found = predicted_jump(posterior, twin(subject, jumps=HEIGHT, mass={"robot_g": 103.0}))
    assert found.jumps_share == 1.0
    plain = found.predicted.of("height", "absolute")
    (row,) = found.beside()
    assert (row["what"], row["as"], row["measured"]) == ("height", "absolute", pytest.approx(0.08))
    low, middle, high = row["predicted"]
    assert middle == pytest.approx(np.median(plain), abs=0.004)
    spread = np.hypot(plain.std(), np.hypot(0.015, np.hypot(0.08, 0.03) * plain.mean()))
    assert (high - low) / 2.0 == pytest.approx(1.2816 * spread, rel=0.15)
    (datum,) = CalibrationModel([found.subject]).data
    for value in (0.08, middle - spread, middle + spread):
        share = found._beside(replace(datum, value=value), "absolute")["below_share"]
        assert share == pytest.approx(0.5 * (1.0 + math.erf((value - middle) / spread / math.sqrt(2.0))), abs=0.05)


def test_the_share_of_draws_that_jump_is_said(posterior: CalibrationPosterior, subject: Subject) -> None:
    """Robots of fifty times the mass do not; no jump counts as none far."""
    found = predicted_jump(posterior, twin(subject, jumps=JUMPS, mass={"robot_g": 103.0}))
    assert found.jumps_share == 1.0
    mass = found.values["mass:twin"].copy()
    mass[::2] *= 50.0
    heavy = type(found)(found.subject, found.values | {"mass:twin": mass}, found.generator)
    assert heavy.jumps_share == pytest.approx(0.5, abs=0.01)
    assert heavy.quantiles()["ballistic_range_m"][0] == 0.0 < heavy.quantiles()["ballistic_range_m"][2]


@pytest.mark.parametrize("key", ["spring_efficiency", "pin_friction"])
def test_what_a_calibration_may_write_is_what_settings_take(key: str) -> None:
    """Its draws are cut off at the ends of what a file of settings may say, and nowhere before."""
    least, most = _limits(key)
    for value in (least, most):
        assert getattr(Settings(**{key: value}), key) == value
    for value in (least - 1e-6, most + 1e-6):
        with pytest.raises(JumpcadError, match=key):
            Settings(**{key: value})


def test_a_length_of_which_it_is_unknown_what_it_is_stands_beside_all_that_it_may_be(
    posterior: CalibrationPosterior, subject: Subject
) -> None:
    unknown = {"distance_of": "unknown", "height_of": "unknown"}
    jumps = ({"distance_mm": (220.0,), "height_mm": (80.0,)} | unknown,)
    found = predicted_jump(posterior, twin(subject, jumps=jumps, mass={"robot_g": 103.0}))
    rows = [(row["what"], row["as"]) for row in found.beside()]
    lengths = [("distance", of) for of in ("centre-of-mass", "first-touchdown", "resting-place")]
    assert sorted(rows) == sorted([*lengths, ("height", "rise"), ("height", "absolute")])
