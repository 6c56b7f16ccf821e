"""From a coupon's readings to fits: what a simulated printer does to holes and teeth, and impossible readings."""

import math
import tomllib

import pytest
from manifold3d import JoinType
from support.built import built
from support.each import each
from support.gearing import turning_play_deg
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.checks import constraint_findings
from jumpcad.coupon.pieces import coupon_holes, coupon_pair, pinion, series_of
from jumpcad.coupon.readings import LEAST_PLAY_MM, Readings, floor_breaks_n, measured_workshop
from jumpcad.design import load_design
from jumpcad.dimensions import AXLE_FLOOR_MM
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.foot.thing import rolls
from jumpcad.solids.outline import polygon
from jumpcad.workshop import Workshop, load_workshop

WORKSHOP = load_workshop("default")


def read(text: str, workshop: Workshop = WORKSHOP) -> Workshop:
    return measured_workshop(Readings.from_data(tomllib.loads(text), "r.toml", text), workshop, "r.toml")


@pytest.mark.parametrize("shrinkage_mm", [0.03, 0.21, 0.34])
def test_a_printer_that_narrows_holes_gets_fits_that_fit(shrinkage_mm: float) -> None:
    """Try the gauge on a printer that narrows every hole by an amount, and print with the resulting fits."""
    steps = series_of(coupon_holes(WORKSHOP)).axle_mm

    def first_with(play_mm: float) -> float:
        return next(step for step in steps if 2.0 * step - shrinkage_mm >= play_mm)

    wanted = {"axle_press_mm": -0.03, "axle_sliding_mm": 0.06, "axle_loose_mm": 0.15}
    readings = "\n".join(f"{key} = {first_with(play)}" for key, play in wanted.items())
    holes = coupon_holes(read(f"[gauge.PETG]\n{readings}"))
    for bore, play in zip((holes.press(3.0), holes.running(3.0), holes.loose(3.0)), wanted.values(), strict=True):
        assert play <= bore - shrinkage_mm - 3.0 < play + 0.1  # within one step of what was wanted, in diameter
    default_mm = 0.2  # that the default's press fit allows for
    for unread in (HoleSizes.lying, HoleSizes.eye):  # follow
        assert unread(holes, 3.0) - shrinkage_mm == pytest.approx(
            unread(coupon_holes(WORKSHOP), 3.0) - default_mm, abs=0.1
        )


def test_one_number_corrects_all_holes_of_a_printer_that_narrows_them_and_is_no_play() -> None:
    """Of a printer whose holes come out 0.2 mm too small: tried, or by the caliper, all holes are as they should be."""
    tried = read("[gauge.PETG]\naxle_press_mm = 0.2")
    assert tried == read("press_hole_mm = 2.8")
    assert tried.fits == WORKSHOP.fits.model_copy(update={"holes_small_mm": 0.2})
    for size in (HoleSizes.press, HoleSizes.eye, HoleSizes.lying, HoleSizes.running, HoleSizes.loose):
        assert size(coupon_holes(tried), 3.0) == pytest.approx(size(coupon_holes(WORKSHOP), 3.0) + 0.2)
    more = read("[gauge.PETG]\naxle_press_mm = 0.25", tried)  # of its own coupon: 0.05 mm a side more
    assert more.fits.holes_small_mm == pytest.approx(0.3)
    drawn = read(
        "[gauge.PETG]\naxle_press_mm = 0.2\n[joints]\nlying_mm = 0.22\nm2_tap_mm = 1.85\nrib_mm = 0.0"
    ).fits.drawn
    assert (drawn.lying_mm, drawn.m2_tap_mm, drawn.rib_mm, drawn.sliding_mm) == pytest.approx((0.22, 1.85, 0.0, 0.3))
    found = build(load_design("kenan-2.0"), tried)
    assert not errors(constraint_findings(found))
    play, plain = (rolls(one)[0].play_deg for one in (found, built("kenan-2.0")))
    assert play == pytest.approx(plain, rel=1e-3)


@pytest.mark.parametrize("growth_mm", [-0.02, 0.04, 0.12])
def test_pegs_foretell_the_play_of_gears_that_spread_likewise(growth_mm: float) -> None:
    pegs = [round(peg + growth_mm, 3) for peg in (4.0, 6.0, 8.0)]
    fits = read(f"[gauge.PETG]\npegs_mm = {pegs}\n[gauge.PLA]\npegs_mm = [4.2, 6.2, 8.2]").fits
    play = fits.backlash_circumferential_mm
    assert play == round(play, 3)  # as a file has it: a caliper reads hundredths
    pair = coupon_pair()
    printed = [polygon(gear.profile_mm).offset(growth_mm / 2.0, JoinType.Miter) for gear in (pair.wheel, pinion(play))]
    turn = turning_play_deg(printed[0].rotate(9.0), printed[1], pair.centre_distance_mm, 24.0)
    assert math.radians(turn) * pair.pinion.pitch_radius_mm == pytest.approx(LEAST_PLAY_MM, abs=0.008)


def test_only_the_fits_change_and_gears_outweigh_pegs() -> None:
    after = read("[gauge.PETG]\npegs_mm = [4.1, 6.1, 8.1]\n[gears]\nturns_freely_mm = 0.22")
    assert after.fits == WORKSHOP.fits.model_copy(update={"backlash_circumferential_mm": 0.22})
    assert after.model_copy(update={"fits": WORKSHOP.fits}) == WORKSHOP


def test_the_reading_counts_with_which_every_material_still_works() -> None:
    fits = read(
        "[gauge.PETG]\naxle_press_mm = 0.15\nbearing_press_mm = 0.12\naxle_sliding_mm = 0.2\naxle_loose_mm = 0.35\n"
        "[gauge.PLA]\naxle_press_mm = 0.10\naxle_sliding_mm = 0.25\naxle_loose_mm = 0.30"
    ).fits.drawn
    assert (fits.press_mm, fits.sliding_mm, fits.loose_mm) == (0.10, 0.25, 0.35)
    for bearing_mm, tighter_mm, small_mm in ((0.05, 0.05, 0.0), (0.15, 0.10, 0.1)):
        found = read(f"[gauge.PETG]\naxle_press_mm = 0.10\n[gauge.PLA]\nbearing_press_mm = {bearing_mm}").fits
        assert (found.drawn.press_mm, found.holes_small_mm) == pytest.approx((tighter_mm, small_mm))


def test_a_floor_is_of_the_bodys_material_and_pegs_tell_of_the_gears() -> None:
    """Links alone in PETG: the floor bears π·d·t·σ/√3 of PLA, and PLA's pegs, 0.1 mm too thick, take 0.2/cos 20°."""
    roles = WORKSHOP.roles.model_copy(update={"links": "PETG", "body": "PLA", "gears": "PLA"})
    bought = WORKSHOP.bought.model_copy(update={"axle_mm": 4.0, "leg_bearing": ""})
    shop = WORKSHOP.model_copy(update={"roles": roles, "bought": bought})
    strength = shop.materials["PLA"].strength_in_plane_mpa
    assert strength != shop.materials["PETG"].strength_in_plane_mpa
    assert floor_breaks_n(shop) == pytest.approx(math.pi * 4.0 * AXLE_FLOOR_MM * strength / math.sqrt(3.0))
    fits = read("[gauge.PLA]\npegs_mm = [4.1, 6.1, 8.1]\n[gauge.PETG]\npegs_mm = [4.3, 6.3, 8.3]", shop).fits
    play = LEAST_PLAY_MM + 0.2 / math.cos(math.radians(20.0))
    assert fits.backlash_circumferential_mm == pytest.approx(play, abs=5e-4)


def test_joints_are_read_too() -> None:
    """The widest running fit counts, and the tightest press fit; a floor sheared off at F has F·√3/(pi·d·t)."""
    text = "[joints]\nm2_tap_mm = 1.7\nrib_mm = 0.1\nlying_mm = 0.15\ndog_sliding_mm = 0.25\ntray_sliding_mm = 0.15"
    fits = read(f"{text}\nseat_press_mm = 0.05").fits.drawn
    assert (fits.m2_tap_mm, fits.rib_mm, fits.lying_mm, fits.sliding_mm) == (1.7, 0.1, 0.15, 0.25)
    assert fits.drawn.press_mm == 0.05
    weak = read("[joints]\nfloor_n = 100").materials["PLA"].strength_in_plane_mpa
    assert weak == round(100.0 * math.sqrt(3.0) / (math.pi * 3.0 * 0.8), 1)
    assert read("[joints]\nfloor_n = 1000").materials == WORKSHOP.materials


def test_a_floor_as_strong_as_the_material_says_changes_nothing_and_a_weaker_one_says_why() -> None:
    """By hand: PLA's 54 MPa over √3, on pi·3·0.8 mm²."""
    breaks = 54.0 / math.sqrt(3.0) * math.pi * 3.0 * 0.8
    before = WORKSHOP.materials["PLA"]
    assert before.strength_in_plane_mpa == 54.0
    assert read(f"[joints]\nfloor_n = {breaks + 0.01}").materials == WORKSHOP.materials
    assert read(f"[joints]\nfloor_n = {breaks - 0.01}").materials == WORKSHOP.materials  # 54.0 MPa too
    weaker = read("[joints]\nfloor_n = 200").materials
    assert weaker["PLA"].strength_in_plane_mpa < 54.0
    assert weaker["PLA"].source == f"{before.source.rstrip('.')}; strength in plane: a bore's floor broke at 200 N"
    assert {name: one for name, one in weaker.items() if name != "PLA"} == {
        name: one for name, one in WORKSHOP.materials.items() if name != "PLA"
    }


@pytest.mark.parametrize(("floor_n", "between"), [(200.0, 30.0), (100.0, 23.0)])
def test_layers_hold_each_other_no_better_than_a_floor_that_broke_holds_itself(floor_n: float, between: float) -> None:
    """By hand: 100 N·√3 on pi·3·0.8 mm² are 23.0 MPa, below the 30 MPa of PLA between its layers; 200 N are 45.9."""
    assert read(f"[joints]\nfloor_n = {floor_n}").materials["PLA"].strength_interlayer_mpa == between


@each(
    ("text", "message"),
    [
        ("", r"r\.toml: no reading: fill in at least one"),
        ("[gauge.PETG]\n[gears]", r"r\.toml: no reading"),
        ("axle_mm = 3", r"r\.toml: no reading"),
        (
            "axle_mm = 2\n[gauge.PETG]\naxle_press_mm = 0.1",
            r"r\.toml: axle_mm = 2: this coupon is for rods of 2 mm, the workshop has 3: print the workshop's own",
        ),
        ("[gauge.ABS]\naxle_press_mm = 0.1", r"r\.toml: gauge\.ABS: the workshop prints in PETG, PLA"),
        (
            "[gauge.PETG]\naxle_press_mm = 0.45",
            r"r\.toml: gauge\.PETG\.axle_press_mm = 0\.45: must be 0\.00…0\.40 as engraved; if nothing fits",
        ),
        ("[gauge.PLA]\nbearing_press_mm = -0.05", r"bearing_press_mm = -0\.05: must be 0\.00…0\.20"),
        ("[joints]\nm2_tap_mm = 2.0", r"r\.toml: joints\.m2_tap_mm = 2: must be 1\.50…1\.70 as engraved"),
        ("[gears]\nturns_freely_mm = 0.3", r"gears\.turns_freely_mm = 0\.3: must be 0\.05…0\.25"),
        (
            "[gauge.PETG]\naxle_press_mm = 0.25\naxle_sliding_mm = 0.2",
            r"r\.toml:3: gauge\.PETG\.axle_sliding_mm = 0\.2: must be at least axle_press_mm = 0\.25",
        ),
        ("press_hole_mm = 1.5", r"r\.toml: fits\.holes_small_mm = 1\.5: must be at most 1"),
        ("[gauge.PETG]\naxle_press_mm = 0.2\n[joints]\nlying_mm = 0.3", r"lying_mm = 0\.3: must be 0\.05…0\.25"),
        ("[gauge.PETG]\npegs_mm = [4.0, 6.0]", r"r\.toml:2: gauge\.PETG\.pegs_mm = .*: must be 3 diameters, of the"),
        ("[gauge.PETG]\npegs_mm = [4.0, 6.0, 8.0, 10.0]", "must be 3 diameters, of the pegs 4, 6, 8 mm"),
        ("[gauge.PETG]\npegs_mm = [4.0, 6.6, 8.0]", r"pegs_mm = .*: 6\.6 for the peg of 6 mm is outside 5\.5…6\.5"),
        ("[gauge.PETG]\npegs_mm = [3.4, 6.0, 8.0]", r"pegs_mm = .*: 3\.4 for the peg of 4 mm is outside 3\.5…4\.5"),
        ("[gauge.PETG]\npegs_mm = [4.0, 6.0, nan]", r"pegs_mm\.2 = nan: must be a finite number"),
        ("[gauge.PETG]\naxle_pres_mm = 0.1", r"axle_pres_mm: unknown key"),
        (
            '[gauge.PETG]\naxle_press_mm = ".10"',
            r"r\.toml:2: gauge\.PETG\.axle_press_mm = '\.10': must be a valid number",
        ),
    ],
)
def test_readings_that_cannot_be_are_one_line(text: str, message: str) -> None:
    with pytest.raises(JumpcadError, match=message) as caught:
        read(text)
    assert "\n" not in str(caught.value)
    assert caught.value.exit_code == 2


def test_a_bearing_that_the_workshop_does_not_have_has_no_seat() -> None:
    bare = workshop_with(WORKSHOP, bought={"leg_bearing": ""})
    with pytest.raises(JumpcadError, match=r"bearing_press_mm = 0\.1: the workshop's legs have no bearing"):
        read("[gauge.PETG]\nbearing_press_mm = 0.1", bare)
