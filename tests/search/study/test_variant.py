"""Variants of a design: other values by name, and lengths, springs and floors as they are made."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.decimals import decimals

from jumpcad.design import PARAMETERS, Design, load_design
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.search.study.variant import FLOOR, PARTS, PREFIX, SPRINGS, Tolerances, Variant, perturbed, tenth
from jumpcad.settings import Settings, coefficients

DESIGN = load_design("kenan-2.0")
VARIANT = Variant(DESIGN, {"body.plate_mm": 3.0, "bought.retention": "nuts"})
PRINTED = Tolerances(0.2, rate=0.05, mass=0.03, floor=0.15, printed=True)


def as_printed(one: Variant) -> Design:
    """Return the design of a robot that is made otherwise than designed."""
    return one.design.model_copy(update={name: one.workshop[key] for key, name in PARTS.items() if key in one.workshop})


def test_links_vary_evenly_within_their_tolerance() -> None:
    generator = np.random.default_rng(1)
    made = Tolerances(0.2).neighbours(Variant.of(DESIGN), generator)
    printed = PRINTED.neighbours(Variant.of(DESIGN), generator)
    for designs in ([one.design for one in made], [as_printed(one) for one in printed]):
        lengths = np.array([[one.l2_mm, one.l3_mm, one.l4_mm, one.l5_mm] for one in designs])
        off = lengths - [DESIGN.l2_mm, DESIGN.l3_mm, DESIGN.l4_mm, DESIGN.l5_mm]
        assert np.abs(off).max() <= 0.2 + 1e-9
        assert (np.abs(off).max(axis=0) > 0.15).all()
        assert np.abs(off.mean(axis=0)).max() < 0.03
        assert {tuple(one.to_vector()[4:]) for one in designs} == {tuple(DESIGN.to_vector()[4:])}
    assert not any(one.workshop for one in made)


def test_printed_robots_have_springs_a_mass_and_a_floor_that_scatter() -> None:
    """Factor of the springs: rate over mass, deviations 5 % and 3 % together 5.8 %; the floor's logarithm 15 %."""
    made = PRINTED.neighbours(Variant.of(DESIGN), np.random.default_rng(2))
    assert all(one.design == DESIGN for one in made)
    springs, floors = (np.array([one.workshop[key] for one in made], dtype=float) for key in (SPRINGS, FLOOR))
    assert decimals([springs, floors]) == 6
    assert springs.std() == pytest.approx(math.hypot(0.05, 0.03), rel=0.15)
    assert springs.mean() == pytest.approx(1.0, abs=0.01)
    assert np.log(floors).std() == pytest.approx(0.15, rel=0.15)
    assert np.log(floors).mean() == pytest.approx(0.0, abs=0.02)
    heavy = replace(PRINTED, rate=0.0).neighbours(Variant.of(DESIGN), np.random.default_rng(2))
    masses = [1.0 / float(one.workshop[SPRINGS]) for one in heavy]
    assert abs(np.corrcoef(masses, np.log(floors))[0, 1]) < 0.4  # a floor does not know who stands on it
    exact = Tolerances(0.2, rate=0.05, printed=True).neighbours(Variant.of(DESIGN), np.random.default_rng(2))
    assert np.std([float(one.workshop[SPRINGS]) for one in exact]) == pytest.approx(0.05, rel=0.15)
    assert {float(one.workshop[FLOOR]) for one in exact} == {1.0}
    named = {key for one in made for key in one.workshop}
    assert {SPRINGS, FLOOR} <= named <= {SPRINGS, FLOOR, *PARTS}


def test_a_heavier_robot_jumps_as_one_with_weaker_springs() -> None:
    """Masses scatter evenly about 1: so do the reciprocals of the factors, and not the factors."""
    made = Tolerances(0.2, mass=0.2, printed=True).neighbours(Variant.of(DESIGN), np.random.default_rng(2))
    springs = np.array([one.workshop[SPRINGS] for one in made], dtype=float)
    assert (1.0 / springs).mean() == pytest.approx(1.0, abs=0.01)
    assert springs.mean() > 1.02


def test_what_is_made_changes_springs_links_and_floor() -> None:
    """Energy goes with the rate, the springs' of the design as made times their factor."""
    robot = capsule_robot(DESIGN)
    values = {PREFIX + "stiffness_nmm_per_deg": 1.1 * DESIGN.stiffness_nmm_per_deg, SPRINGS: 0.9, FLOOR: 1.5}
    made, settings = perturbed(robot, Settings(), values)
    assert made.spring.stiffness_nm_per_rad == pytest.approx(0.99 * robot.spring.stiffness_nm_per_rad)
    assert settings.ground_friction == pytest.approx(1.5 * coefficients(robot, Settings()).ground)
    links, _ = perturbed(robot, Settings(), {PREFIX + "carrying_link_mm": 1.01 * DESIGN.carrying_link_mm})
    assert links.spring.stiffness_nm_per_rad == pytest.approx(robot.spring.stiffness_nm_per_rad)
    assert np.linalg.norm(links.joint("ankle").origin_m) == pytest.approx(1.01e-3 * DESIGN.carrying_link_mm)


def test_parameters_vary_by_one_per_cent() -> None:
    varied = Tolerances(0.2).varied(Variant.of(DESIGN), np.random.default_rng(3))
    shares = np.array([one.design.to_vector() for one in varied]) / DESIGN.to_vector() - 1.0
    assert shares.shape[1] == len(PARAMETERS)
    assert np.abs(shares).max() <= 0.01 + 1e-12
    assert (np.abs(shares).max(axis=0) > 0.007).all()


def test_tolerances_are_twice_the_deviations_in_words() -> None:
    assert PRINTED.words == "lengths ±0.2 mm, springs ±10 %, mass ±6 %, friction ±30 %"
    assert Tolerances(0.2).words == "lengths ±0.2 mm"


def test_nine_of_ten_reach_the_tenth_score() -> None:
    assert tenth([float(score) for score in range(20)]) == 1.0
    assert tenth([5.0, 3.0, 4.0]) == 3.0


def test_each_value_is_changed_where_it_belongs() -> None:
    changed = VARIANT.changed({"body.plate_mm": 2.5, "c_coef": 1.05})
    assert changed.workshop == {"body.plate_mm": 2.5, "bought.retention": "nuts"}
    assert changed.design == DESIGN.model_copy(update={"c_coef": 1.05})
    assert (VARIANT.workshop["body.plate_mm"], VARIANT.design) == (3.0, DESIGN)
    with pytest.raises(JumpcadError):
        VARIANT.changed({"c_coef": 1e3})
