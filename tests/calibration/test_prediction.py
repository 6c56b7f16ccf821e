"""A robot that was not calibrated on: its own properties stay open, shared ones follow the calibration."""

import math
import tomllib
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from support.calibrations import remeasured, stand_in

from jumpcad.calibration.likelihood import CalibrationModel
from jumpcad.calibration.measurements import Measurements
from jumpcad.calibration.posterior import CalibrationPosterior, sampled
from jumpcad.calibration.prediction import DIGITS, SAVED, elsewhere, predicted_jump, settings_toml
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
    return sampled(CalibrationModel([remeasured(subject, measured)]), 0, 300, 300, 30)


def twin(subject: Subject, **data: Any) -> Subject:
    """Return the same robot under another name, with a pair of springs of its own."""
    found = remeasured(subject, Measurements(**SAID, **data))
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
    found = predicted_jump(posterior, remeasured(subject, Measurements(**SAID, jumps=JUMPS, spring=rate)))
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
        replace(posterior, model=CalibrationModel([remeasured(subject, Measurements(**SAID, jumps=JUMPS))]))
    )
    assert "ground" not in line


def made_up(*shapes: str, **more: Any) -> Any:
    """Return a made-up posterior of robots whose floors have priors of these shapes."""
    ramp = np.linspace(0.0, 1.0, 991)
    values = {f"mass:k{n}": np.full(991, 0.9) for n in range(len(shapes))}
    values |= {"spring_efficiency": 0.8 + 0.2 * ramp**2, "pin_friction": 0.4 - 0.3 * ramp, "floor:k0": 0.5 + 0.4 * ramp}
    unweighed = SimpleNamespace(mass=SimpleNamespace(robot_g=None, parts_g={}))
    subjects = [SimpleNamespace(name=f"k{n}", floor=SimpleNamespace(shape=shape), measured=unweighed)
                for n, shape in enumerate(shapes)]  # fmt: skip
    model = SimpleNamespace(subjects=subjects)
    return stand_in(CalibrationPosterior, model=model, values=values | more, z=np.zeros((991, 3)), residuals=list)


def test_measurements_that_no_parameters_explain_write_no_settings() -> None:
    found = made_up("uniform")
    one = {"robot": "k0", "what": "speed", "measured": 17.2, "off_by_deviations": 9.0}
    vars(found)["residuals"] = lambda: [one]
    settings_toml(found)
    for off in (134.0, -11.0):
        one["off_by_deviations"] = off
        with pytest.raises(JumpcadError, match=rf"k0: speed = 17.2 m/s is off by \{off:+.1f} standard deviations"):
            settings_toml(found)


def test_medians_stand_for_a_jump_and_pairs_of_draws_for_many() -> None:
    found = tomllib.loads(settings_toml(made_up("lognormal")))
    assert found.pop("draws") == {
        "spring_efficiency": [round(0.8 + 0.2 * (n / 99.0) ** 2, DIGITS) for n in range(SAVED)],
        "pin_friction": [round(0.4 - 0.3 * n / 99.0, DIGITS) for n in range(SAVED)],
    }  # fmt: skip
    assert found == {"spring_efficiency": 0.85, "pin_friction": 0.25}


def test_what_settings_do_not_take_is_cut_off() -> None:
    wild = {"spring_efficiency": np.linspace(0.0, 3.0, 991), "pin_friction": np.linspace(-1.0, 5.0, 991)}
    draws = tomllib.loads(settings_toml(made_up("uniform", **wild)))["draws"]
    assert (min(draws["spring_efficiency"]), max(draws["spring_efficiency"])) == (0.1, 1.5)
    assert (min(draws["pin_friction"]), max(draws["pin_friction"])) == (0.0, 2.0)


def test_what_is_found_of_a_robot_is_told_for_the_place_where_it_stands() -> None:
    """The floor of feet with or without pads; the rate of a shared pair of springs, from stock or made to order."""
    found = {"rate:ours": np.full(991, 1.25), "floor:k2": np.full(991, 0.3)}
    told = made_up("lognormal", "uniform", "lognormal", **found)
    stock = SimpleNamespace(name="9271K619", rate_nmm_per_deg=8.0)
    for subject, pad, spring in zip(told.model.subjects, ("rubber", "rubber", ""), (None, stock, None), strict=True):
        subject.pair = "ours"
        shop = SimpleNamespace(ground=SimpleNamespace(pad=pad), stock_spring=spring)
        subject.robot = SimpleNamespace(workshop=shop, design=SimpleNamespace(stiffness_nmm_per_deg=20.0), mass_kg=0.12)
    assert list(elsewhere(told)) == [
        "k0, in its workshop: [ground] friction = 0.70", "k0, in its design: stiffness_nmm_per_deg = 25",
        "k1, in [springs.9271K619]: rate_nmm_per_deg = 10",
        "k2, in its workshop: [ground] bare_friction = 0.30", "k2, in its design: stiffness_nmm_per_deg = 25",
    ]  # fmt: skip


@pytest.mark.parametrize(("factor", "told"), [(0.9, True), (1.011, True), (0.991, False)])
def test_a_robot_that_weighs_something_else_is_told_to_be_weighed_in_parts(factor: float, told: bool) -> None:
    """No setting stands for a weight, and a scale is right within a hundredth."""
    found = made_up("uniform", **{"mass:k0": np.full(991, factor), "rate:k0": np.ones(991)})
    (subject,) = found.model.subjects
    subject.measured = SimpleNamespace(mass=SimpleNamespace(robot_g=108.0, parts_g={"foot": 8.0, "cam": 2.25}))
    shop, design = SimpleNamespace(stock_spring=None), SimpleNamespace(stiffness_nmm_per_deg=20.0)
    subject.pair, subject.robot = "k0", SimpleNamespace(workshop=shop, design=design, mass_kg=0.12)
    parts, *weight, _ = elsewhere(found)
    assert parts == "k0, in its workshop: [mass.weighed_g] foot = 8, cam = 2.25"
    assert len(weight) == told
    if told:
        assert weight[0].endswith(f"weighed one by one: it has {120.0 * factor:.4g} g, by the model 120 g")


def test_robots_and_drive_are_told_in_the_heading() -> None:
    text = settings_toml(made_up("uniform", "uniform", drive_efficiency=np.linspace(0.5, 0.7, 991)))
    assert "# Calibrated on k0, k1 by jumpcad calibrate" in text
    assert "over 0.60." in text
    assert "Drive" not in settings_toml(made_up("uniform"))
