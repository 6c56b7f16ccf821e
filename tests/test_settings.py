"""Settings: presets, and errors that name file, line, key, value and limit."""

from pathlib import Path

import pytest
from support.each import each
from support.machines import rubbing

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.settings import coefficients, takeoff_clearance_m
from jumpcad.simulation import Settings, load_settings


def test_default_file_says_what_the_program_does() -> None:
    assert load_settings("default") == Settings()


def test_default_file_lists_every_key() -> None:
    from jumpcad.files import find_template, read_toml

    path = find_template("settings", "default")
    data, text = read_toml(path)
    follow = {name for name, value in Settings() if value is None}
    assert set(data) == set(Settings.model_fields) - follow - {"draws"}  # a calibration's
    assert follow == {
        "ground_friction",
        "body_friction",
        "pin_friction",
        "joint_damping_nms_per_rad",
        "takeoff_clearance_m",
    }
    assert all(f"# {name} " in text for name in follow)


def test_friction_of_the_contacts_is_that_of_the_reference_flights() -> None:
    kenan = capsule_robot(load_design("kenan-2.0"))
    rubs = coefficients(kenan, Settings())
    assert (rubs.contact("foot"), rubs.contact("body")) == (1.5, 0.75)
    assert (rubs.pin, rubs.joint_damping_nms_per_rad) == (0.0, 0.001)


def test_a_printed_robot_rubs_as_its_workshop_says_and_a_file_overrides_each() -> None:
    kenan = rubbing(capsule_robot(load_design("kenan-2.0")), foot=0.8, pin=0.25)
    own = coefficients(kenan, Settings())
    assert (own.contact("foot"), own.contact("body")) == pytest.approx((0.8, 0.35))
    assert (own.pin, own.joint_damping_nms_per_rad) == (0.25, 0.0)
    asked = coefficients(kenan, Settings(ground_friction=0.5, pin_friction=0.1, joint_damping_nms_per_rad=0.002))
    assert asked.contact("foot") == 0.5
    assert (asked.pin, asked.joint_damping_nms_per_rad) == (0.1, 0.002)
    assert coefficients(kenan, load_settings("published-table")).contact("foot") == 1.5 * 0.8


def test_a_printed_robot_that_jumps_clears_the_ground_by_a_millimetre() -> None:
    """Twice the hop of a foot that tips over its nose; of the study's capsules nothing is asked, and a file may say."""
    capsules = capsule_robot(load_design("kenan-2.0"))
    printed = rubbing(capsules)
    assert takeoff_clearance_m(capsules, Settings()) == 0.0
    assert takeoff_clearance_m(printed, Settings()) == 2.0 * 0.0005
    for robot in (capsules, printed):
        for asked in (0.0, 0.003):
            assert takeoff_clearance_m(robot, Settings(takeoff_clearance_m=asked)) == asked


@each(
    ("text", "message"),
    [
        ("dt_s = 0.1", r"mine.toml:1: dt_s = 0.1: must be at most 0.00416667"),
        ("# slow\ndt_s = nan", r"mine.toml:2: dt_s = nan: must be a finite number"),
        ("dt = 0.001", r"mine.toml:1: dt: unknown key"),
        ("foot_frictoin = 1.0", r"foot_frictoin: unknown key \(did you mean foot_friction\?\)"),
        ("ground_friction = -1.0", r"ground_friction = -1.0: must be at least 0"),
        ('flight = "long"', r"flight = 'long': must be 'ballistic' or 'simulated'"),
        ("solver_iterations = 50.5", r"solver_iterations = 50.5: must be a valid integer"),
        ("restitution = true", r"restitution = True: must be a valid number"),
        ("gravity_m_s2 = 0.0", r"gravity_m_s2 = 0.0: must be at least 0.1"),
    ],
)
def test_bad_settings_are_named(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(text)
    with pytest.raises(JumpcadError, match=message) as caught:
        load_settings(path)
    assert "\n" not in str(caught.value)


def test_missing_settings(tmp_path: Path) -> None:
    with pytest.raises(JumpcadError, match=r"nowhere\.toml: no such file"):
        load_settings(tmp_path / "nowhere.toml")
    with pytest.raises(JumpcadError, match=r"screening \(did you mean screening\?\)"):
        load_settings("screning")


@pytest.mark.parametrize(("efficiencies", "frictions"), [([0.9, 0.95], [0.3]), ([0.9], [0.3, 0.25]), ([], [0.3])])
def test_draws_of_a_calibration_go_together_one_by_one(
    tmp_path: Path, efficiencies: list[float], frictions: list[float]
) -> None:
    path, several = tmp_path / "mine.toml", len(efficiencies)
    path.write_text(f"[draws]\nspring_efficiency = {efficiencies}\npin_friction = {frictions}\n")
    words = f"pin_friction = {len(frictions)}: must be as many values as spring_efficiency has, {several}$"
    with pytest.raises(JumpcadError, match=rf"mine.toml:3: draws\.{words}"):
        load_settings(path)
    path.write_text(f"[draws]\nspring_efficiency = {efficiencies}\npin_friction = {frictions[:1] * several}\n")
    assert bool(load_settings(path).draws) == (several > 0)  # whether there are any
