"""Settings: presets, and errors that name file, line, key, value and limit."""

from pathlib import Path

import pytest

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.settings import surface_friction
from jumpcad.simulation import Settings, load_settings


def test_default_file_says_what_the_program_does() -> None:
    assert load_settings("default") == Settings()


def test_default_file_lists_every_key() -> None:
    from jumpcad.files import find_template, read_toml

    data, _ = read_toml(find_template("settings", "default"))
    assert set(data) == set(Settings.model_fields)


def test_presets_load() -> None:
    assert template_names("settings") == ["default", "fine", "published-table", "screening"]
    assert load_settings("screening").dt_s == 1 / 1000
    fine = load_settings("fine")
    assert (fine.dt_s, fine.solver_iterations) == (1 / 16000, 200)


def test_published_table_is_the_papers() -> None:
    """Lateral friction 0.8, spinning 0.1, rolling 0.01, joint damping 0.001, restitution 0.8."""
    table = load_settings("published-table")
    assert (table.foot_friction, table.spinning_friction_m, table.rolling_friction_m) == (0.8, 0.1, 0.01)
    assert (table.joint_damping_nms_per_rad, table.restitution) == (0.001, 0.8)


def test_friction_of_the_contacts_is_that_of_the_reference_flights() -> None:
    kenan = capsule_robot(load_design("kenan-2.0"))
    settings = Settings()
    assert settings.ground_friction * surface_friction(kenan.bodies[FOOT], settings) == 1.5
    assert settings.ground_friction * surface_friction(kenan.bodies[BODY], settings) == 0.75


@pytest.mark.parametrize(
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
