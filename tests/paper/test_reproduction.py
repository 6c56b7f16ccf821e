"""The study's table: its simulation gives what it printed, and the evaluator something else."""

import pytest
from support import needs

from jumpcad.bundle.page import compared_of
from jumpcad.design import load_design
from jumpcad.files import template_names
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.paper.reproduction import HYPERPARAMETERS, PUBLISHED_RESULTS, Reproduction, reproduce
from jumpcad.simulation import Settings, simulate


@pytest.fixture(scope="module")
def rows() -> dict[str, Reproduction]:
    needs.package("pybullet")
    return {row.published.template: row for row in reproduce()}


def test_published_figures_are_the_simulated_ones_rounded(rows: dict[str, Reproduction]) -> None:
    for name, row in rows.items():
        there, again = row.published.simulated, row.again
        rounding = 0.0075 if name == "kenan-1.0" else 0.0006  # printed as 25 cm, the others to a millimetre
        assert again.distance_m == pytest.approx(there.distance_m, abs=rounding)
        assert again.energy_j == pytest.approx(there.energy_j, abs=0.0015)
        if name != "kenan-1.0":  # whose printed 10 cm no published simulation gives
            assert again.base_height_m == pytest.approx(there.base_height_m, abs=0.0006)


def test_evaluator_says_what_is_known_of_first_touchdowns(rows: dict[str, Reproduction]) -> None:
    """They are where MuJoCo's flights touch down."""
    needs.package("mujoco")
    for name, row in rows.items():
        there = simulate(capsule_robot(load_design(name)), Settings(flight="simulated"), "mujoco")
        assert row.jump.touchdown_distance_m == pytest.approx(there.touchdown_distance_m, rel=0.015)


def test_published_figures_flatter_weak_jumpers(rows: dict[str, Reproduction]) -> None:
    for name in ("kenan-1.0", "kenan-2.0"):
        row = rows[name]
        assert row.again.distance_m > 1.5 * row.jump.ballistic_range_m
        assert row.again.base_height_m > 2 * row.jump.com_rise_m


def test_hyperparameters_are_those_of_the_studys_table_and_of_its_code() -> None:
    """In the table: 0.8, 0.1, 0.01, 0.001, 0.8, without one for the ground; the results come from others."""
    assert HYPERPARAMETERS == {
        "lateral friction": (0.8, 1.0), "spinning friction": (0.1, 0.15), "rolling friction": (0.01, 0.01),
        "joint damping": (0.001, 0.001), "restitution": (0.8, 0.9), "lateral friction of the ground": (None, 1.5),
    }  # fmt: skip


def test_measured_jumps_are_those_that_the_predictions_stand_beside() -> None:
    """Both prototypes' distances, heights and battery energies, as the templates of comparisons have them."""
    measured = {one.template: one.measured for one in PUBLISHED_RESULTS if one.measured is not None}
    assert set(measured) == set(template_names("compared"))
    for name, values in measured.items():
        found = compared_of(load_design(name))
        assert found is not None
        for row in found.rows:
            kinds = {"distance": values.distance_m, "height": values.height_m, "battery": values.electrical_energy_j}
            assert row.measured == kinds[row.what]
        assert {row.what for row in found.rows} == {"distance", "height", "battery"}


def test_a_row_says_what_was_measured_of_a_built_robot(rows: dict[str, Reproduction]) -> None:
    """The bench values of the study's two prototypes; the two optimised robots were not built."""
    measured = {name: row.to_dict()["measured"] for name, row in rows.items()}
    assert measured == {
        "kenan-1.0": {"distance_m": 0.25, "height_m": 0.15, "electrical_energy_j": 1.5},
        "kenan-2.0": {"distance_m": 0.35, "height_m": 0.12, "electrical_energy_j": 1.3},
        "best-ga": None, "best-bo": None,
    }  # fmt: skip
