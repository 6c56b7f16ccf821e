"""Hub bearings against the equilibrium of the leg on two supports."""

import math
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest
from support.built import built
from support.fits import LOADS
from support.workshops import workshop_with

from jumpcad.catalogue import load_catalogue
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.strength.bearings import (
    allowed_n,
    bearing_load_n,
    first_guess,
    hub_bearings,
    hub_width_mm,
    loaded_forces_n,
    roller_bearing,
    roller_screw_mm,
    roller_washer,
)
from jumpcad.workshop import load_workshop

BEARING = load_catalogue().bearings["MR63"]
NONE = np.zeros(2)


def test_both_bearings_share_a_force_in_their_middle() -> None:
    assert bearing_load_n((np.array([0.0, 30.0]), NONE), 8.0, 4.0, BEARING) == pytest.approx(15.0)


@pytest.mark.parametrize("leg_mm", [8.0, 12.0])
def test_a_force_beside_the_leg_presses_the_nearer_bearing_by_more_than_itself(leg_mm: float) -> None:
    """Moments about the farther bearing: load times the bearings' distance is the force times its own."""
    apart = leg_mm - BEARING.width_mm
    beside = leg_mm / 2.0 + 0.5 + 4.0 / 2.0  # a washer of 0.5 mm, half of the roller
    load = bearing_load_n((NONE, np.array([20.0, 0.0])), leg_mm, 4.0, BEARING)
    assert load * apart == pytest.approx(20.0 * (beside + apart / 2.0))
    assert load > 20.0


@pytest.mark.parametrize(
    ("outer_mm", "outer_ring_mm", "washer_mm"),
    # where SKF's tables of 623, 619/3 (693) and 618/3 (683) have the edge of the outer ring, about
    [(10.0, 8.2, 7.0), (8.0, 6.7, 6.0), (7.0, 6.0, 5.0)],
)
def test_the_washer_beside_the_roller_leaves_its_outer_ring_free(
    outer_mm: float, outer_ring_mm: float, washer_mm: float
) -> None:
    roller = load_catalogue().bearings["623"].model_copy(update={"outer_mm": outer_mm})
    assert roller.outer_ring_mm == pytest.approx(outer_ring_mm, abs=0.05)
    assert roller_washer(roller, load_catalogue()).outer_mm == washer_mm < outer_ring_mm


def test_a_roller_whose_outer_ring_the_screws_head_would_clamp_is_refused() -> None:
    """The head of ISO 7380-1 M3 is 5.7 mm wide; the outer ring of an MR63 (6 mm) begins nearer."""
    with pytest.raises(JumpcadError, match=r'^bought\.roller = "MR63": .* head of 5\.7 mm .* choose a bearing of 7 mm'):
        roller_bearing(workshop_with(bought={"roller": "MR63"}))


@pytest.mark.parametrize(("outer_mm", "fits"), [(13.0, True), (16.0, False)])
def test_a_roller_that_would_meet_its_cam_past_rest_is_refused(outer_mm: float, fits: bool, tmp_path: Path) -> None:
    """Solids of built robots: a roller of 16 mm and its cam share 0.14 mm³ and more, one of 13 mm none."""
    file = tmp_path / "shop.toml"
    file.write_text(
        f'[bought]\nroller = "own"\n[bearings.own]\nlike = "623"\nouter_mm = {outer_mm}\nsource = "by hand"\n',
        encoding="utf-8",
    )
    shop = load_workshop(file)
    refused = pytest.raises(JumpcadError, match=r'bought\.roller = "own": with 16 mm .* 13 mm diameter or less')
    with nullcontext() if fits else refused:
        assert roller_bearing(shop).outer_mm == outer_mm


def test_a_narrow_leg_grows_to_the_width_that_two_bearings_need() -> None:
    forces = (np.array([3.0, 4.0]), np.array([20.0, 0.0]))
    assert hub_width_mm(BEARING) == pytest.approx(2.0 * BEARING.width_mm + 0.8)
    narrow, wide = (bearing_load_n(forces, width, 4.0, BEARING) for width in (1.0, hub_width_mm(BEARING)))
    assert narrow == wide
    assert hub_width_mm(None) == 0.0


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_arms_and_cam_turn_the_leg_by_the_same_torque(name: str) -> None:
    """Moments about the hub: the arms' force at the pin is the springs' torque; the cam's holds it, with its angle."""
    robot = built(name)
    design, drive = robot.design, robot.layout.drive
    arms, cam = loaded_forces_n(design, drive)
    leg = math.radians(design.rest_angle_deg) - design.compression_rad  # below the x axis
    pin = drive.spring.arms.pin_radius_mm * np.array([math.cos(leg), -math.sin(leg)])
    torque = 1000.0 * design.peak_spring_torque_nm
    assert pin[0] * arms[1] - pin[1] * arms[0] == pytest.approx(-torque)  # clockwise, towards rest
    lever = drive.cam.geometry.lever_start_rad + design.compression_rad
    roller = drive.cam.geometry.lever_mm * np.array([math.cos(lever), math.sin(lever)])
    assert roller[0] * cam[1] - roller[1] * cam[0] >= torque - 1e-9  # the contact is not square to the lever


def test_a_workshop_offers_the_bearings_of_its_axle_the_lightest_first() -> None:
    workshop = load_workshop()
    found = [bearing for bearing in hub_bearings(workshop) if bearing]
    assert {bearing.bore_mm for bearing in found} == {3.0}
    assert [bearing.mass_g for bearing in found] == sorted(bearing.mass_g for bearing in found)
    assert hub_bearings(workshop_with(bought={"leg_bearing": ""})) == [None]


def test_the_first_guess_passes_over_bearings_of_too_small_a_rating_only() -> None:
    workshop, design = load_workshop(), load_design("best-bo")
    bearings = hub_bearings(workshop)
    number = first_guess(bearings, design, workshop)
    assert all(
        bearing is None or allowed_n(bearing, workshop) < 100.0 * design.peak_spring_torque_nm
        for bearing in bearings[:number]
    )
    safer = workshop_with(workshop, safety={"bearing_factor": 20.0})
    assert first_guess(bearings, design, safer) == len(bearings) - 1
    assert allowed_n(BEARING, safer) == pytest.approx(BEARING.static_load_n / 20.0 / LOADS)


def test_the_nearer_bearing_bears_more_than_the_cam_pushes() -> None:
    """A lever beyond its two supports: F·(a + b)/a (Shigley, table A-9, overhanging load)."""
    bearing = load_catalogue().bearings["MR63"]
    push = (np.zeros(2), np.array([0.0, 10.0]))
    apart, beside = 8.0 - 2.5, 4.0 + 0.5 + 2.0
    assert bearing_load_n(push, 8.0, 4.0, bearing) == pytest.approx(10.0 * (apart / 2.0 + beside) / apart)
    assert bearing_load_n(push[::-1], 8.0, 4.0, bearing) == pytest.approx(5.0)
    against = (np.array([0.0, -100.0]), push[1])  # arms in the middle, which the cam unloads at its own side alone
    assert bearing_load_n(against, 8.0, 4.0, bearing) == pytest.approx(50.0 + 10.0 * (beside - apart / 2.0) / apart)


def test_the_rollers_screw_goes_through_leg_washer_roller_and_lock_nut() -> None:
    """6 + 0.5 + 4 mm and a nut of 4 mm (DIN 985, M3) are 14.5 mm; 12, 16 and 20 mm are sold (ISO 7380-1)."""
    catalogue = load_catalogue()
    lengths = [roller_screw_mm(leg_mm, catalogue.bearings["623"], catalogue) for leg_mm in (3.4, 3.6, 6.0, 7.6)]
    assert lengths == [12.0, 16.0, 16.0, 20.0]
