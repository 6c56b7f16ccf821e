"""What a calibration writes for simulations: medians, draws in pairs, and the floor where it is one robot's."""

import tomllib
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from support.calibrations import stand_in

from jumpcad.calibration.posterior import CalibrationPosterior
from jumpcad.calibration.settings_file import DIGITS, SAVED, elsewhere, settings_toml
from jumpcad.errors import JumpcadError


def posterior(*shapes: str, **more: Any) -> Any:
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
    found = posterior("uniform")
    one = {"robot": "k0", "what": "speed", "measured": 17.2, "off_by_deviations": 9.0}
    vars(found)["residuals"] = lambda: [one]
    settings_toml(found)
    for off in (134.0, -11.0):
        one["off_by_deviations"] = off
        with pytest.raises(JumpcadError, match=rf"k0: speed = 17.2 m/s is off by \{off:+.1f} standard deviations"):
            settings_toml(found)


def test_medians_stand_for_a_jump_and_pairs_of_draws_for_many() -> None:
    found = tomllib.loads(settings_toml(posterior("lognormal")))
    assert found.pop("draws") == {
        "spring_efficiency": [round(0.8 + 0.2 * (n / 99.0) ** 2, DIGITS) for n in range(SAVED)],
        "pin_friction": [round(0.4 - 0.3 * n / 99.0, DIGITS) for n in range(SAVED)],
    }  # fmt: skip
    assert found == {"spring_efficiency": 0.85, "pin_friction": 0.25}


def test_what_settings_do_not_take_is_cut_off() -> None:
    wild = {"spring_efficiency": np.linspace(0.0, 3.0, 991), "pin_friction": np.linspace(-1.0, 5.0, 991)}
    draws = tomllib.loads(settings_toml(posterior("uniform", **wild)))["draws"]
    assert (min(draws["spring_efficiency"]), max(draws["spring_efficiency"])) == (0.1, 1.5)
    assert (min(draws["pin_friction"]), max(draws["pin_friction"])) == (0.0, 2.0)


def test_what_is_found_of_a_robot_is_told_for_the_place_where_it_stands() -> None:
    """The floor of feet with or without pads; the rate of a shared pair of springs, from stock or made to order."""
    found = {"rate:ours": np.full(991, 1.25), "floor:k2": np.full(991, 0.3)}
    told = posterior("lognormal", "uniform", "lognormal", **found)
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
    found = posterior("uniform", **{"mass:k0": np.full(991, factor), "rate:k0": np.ones(991)})
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
    text = settings_toml(posterior("uniform", "uniform", drive_efficiency=np.linspace(0.5, 0.7, 991)))
    assert "# Calibrated on k0, k1 by jumpcad calibrate" in text
    assert "over 0.60." in text
    assert "Drive" not in settings_toml(posterior("uniform"))
