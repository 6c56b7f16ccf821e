"""The release in a contact simulation of the exported files keeps the energy, and kicks as hard, as the manifest says.

`release_contact` reads the bundle alone. Both take stiffnesses, friction and motors from the same assumptions, so this
confirms mechanics and shapes, not those figures. The simulation also has losses where roller and cam touch, and hops.
"""

import math
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from clients.release_contact import Contact, Outcome

STEP_S = 4e-6
"""With half of it, as by default, ratios of energy are the same to 2e-4, and torques to 2 %."""


@pytest.fixture(scope="module")
def released(bundle_of: Callable[[str], Path]) -> Callable[[str], tuple[Contact, list[Outcome]]]:
    """Return a function that gives a template's contact simulation, and its release by each of the assumed motors."""

    @cache
    def made(name: str) -> tuple[Contact, list[Outcome]]:
        contact = Contact(bundle_of(name))
        return contact, [
            contact.run(motor, step_s=STEP_S) for motor in contact.files.manifest["drive"]["release"]["assumed"]
        ]

    return made


@pytest.mark.parametrize("name", ["kenan-2.0", "best-printable"])
def test_the_release_keeps_the_energy_and_kicks_as_the_manifest_says(
    name: str, released: Callable[[str], tuple[Contact, list[Outcome]]]
) -> None:
    contact, outcomes = released(name)
    said = contact.files.manifest["drive"]["release"]
    assert math.degrees(contact.play) == pytest.approx(said["free_play_deg"], abs=0.1)
    for motor, outcome in zip(said["assumed"], outcomes, strict=True):
        assert contact.cam_kg_m2 == pytest.approx(motor["cam_kg_m2"], rel=0.1)
        assert outcome.energy_ratio == pytest.approx(said["energy_ratio_with_bending"], abs=0.005)
        assert outcome.energy_ratio > 0.97 * said["bending_ratio"]
    kick = max(outcome.kick_nm for outcome in outcomes)
    assert kick == pytest.approx(said["kick_nm"], rel=0.1)  # the reserve that the checks keep
    assert kick < said["kick_limit_nm"]


def test_a_slow_motor_is_the_hard_case(released: Callable[[str], tuple[Contact, list[Outcome]]]) -> None:
    """The leg swings up on its lever while the roller comes over the top, the more the quicker: less throws the cam."""
    contact, (by_quick, by_slow) = released("kenan-2.0")
    quick, slow = contact.files.manifest["drive"]["release"]["assumed"]
    assert slow["cam_rad_s"] < 0.5 * quick["cam_rad_s"]
    assert by_quick.kick_nm < 0.9 * by_slow.kick_nm


def test_too_little_play_loses_more_and_kicks_harder(bundle_of: Callable[[str], Path]) -> None:
    """With 5° the cam meets the end of its play while the roller is on its corner."""
    contact = Contact(bundle_of("best-printable"))
    said = contact.files.manifest["drive"]["release"]
    short = contact.run(said["assumed"][1], math.radians(5.0), step_s=STEP_S)
    assert short.energy_ratio < said["energy_ratio_with_bending"] - 0.05
    assert short.kick_nm > 1.5 * said["kick_nm"]
