"""The published simulation: parity with the study's own results."""

import csv
import sys

import numpy as np
import pytest
from support import needs
from support.each import each
from support.places import DATA

from jumpcad import published
from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError, JumpcadError

with (DATA / "reference_jumps.csv").open(encoding="utf-8") as stream:
    ROWS = {row["name"]: row for row in csv.DictReader(stream)}
CHAOTIC = ("artefact-a", "artefact-b")
LOWER, UPPER = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
OTHERS = np.random.default_rng(1).uniform(LOWER, UPPER, (40, len(PARAMETERS))).tolist()


def design_of(name: str) -> Design:
    return Design.from_vector([float(ROWS[name][parameter]) for parameter in PARAMETERS])


@each("name", [name for name in ROWS if name not in CHAOTIC])
def test_reference_jumps_are_met_to_the_last_printed_digit(name: str) -> None:
    needs.package("pybullet")
    jump, row = published.simulate(design_of(name)), ROWS[name]
    found = (jump.distance_m, jump.base_height_m, jump.energy_j)
    printed = [float(row[name]) for name in ("distance_m", "base_height_m", "energy_j")]
    assert found == pytest.approx(printed, rel=0, abs=6e-7)


@pytest.mark.thorough
@each("parameters", OTHERS)
def test_other_designs_jump_as_the_recipe_says(parameters: list[float]) -> None:
    """To the last bit: `math.degrees` moves six of them by more than 1e-9 m, `math.asin` one."""
    needs.package("pybullet")
    from support.published_recipe import recipe_jump

    jump = published.simulate(Design.from_vector(parameters))
    assert (jump.distance_m, jump.base_height_m) == recipe_jump(parameters)


def test_every_build_of_pybullet_gives_what_3_2_7_gave() -> None:
    """For designs that do not amplify the last bit of a parameter, which another processor may round otherwise."""
    needs.package("pybullet")
    with (DATA / "reference_stable.csv").open(encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            jump = published.simulate(Design.from_vector([float(row[name]) for name in PARAMETERS]))
            stored = [float(row["distance_m"]), float(row["base_height_m"])]
            assert [jump.distance_m, jump.base_height_m] == pytest.approx(stored, rel=0, abs=1e-9), row


@pytest.mark.parametrize("name", CHAOTIC)
def test_artefacts_are_chaotic(name: str) -> None:
    needs.package("pybullet")
    design = design_of(name)
    nearby = design.model_copy(update={"carrying_link_mm": design.carrying_link_mm * (1 + 1e-9)})
    moved = published.simulate(nearby).distance_m - published.simulate(design).distance_m
    assert abs(moved) > 0.01


def test_the_same_bits_whatever_ran_before() -> None:
    pybullet = needs.package("pybullet")
    design = load_design("kenan-2.0")
    first = published.simulate(design)
    client = pybullet.connect(pybullet.DIRECT)
    try:  # a value that Bullet keeps for the whole process
        pybullet.setPhysicsEngineParameter(contactBreakingThreshold=0.001, physicsClientId=client)
        published.simulate(load_design("best-ga"))
        again = published.simulate(design)
    finally:
        pybullet.disconnect(client)
    assert again == first


def test_its_client_is_closed_even_after_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    pybullet = needs.package("pybullet")

    def broken(**_: int) -> None:
        raise RuntimeError("out of order")

    def connected() -> list[int]:
        return [client for client in range(1024) if pybullet.isConnected(client)]

    before = connected()
    published.simulate(load_design("kenan-2.0"))
    monkeypatch.setattr(pybullet, "stepSimulation", broken)
    with pytest.raises(RuntimeError, match="out of order"):
        published.simulate(load_design("kenan-2.0"))
    assert connected() == before


def test_impossible_design_is_refused_before_the_engine() -> None:
    design = load_design("kenan-2.0").model_copy(update={"c_coef": 3.0})
    with pytest.raises(CannotBuildError, match="no assembled pose"):
        published.simulate(design)


def test_missing_pybullet_is_one_line_that_says_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pybullet", None)
    with pytest.raises(JumpcadError, match=r"pip install pybullet-arm64.*no other engine") as caught:
        published.simulate(load_design("kenan-2.0"))
    assert "\n" not in str(caught.value)
