"""Limits of every value of a workshop, of its names and of its free text."""

import json
import re

import pytest
from support.documented import documented_ranges, wrongly_taken
from support.each import each

from jumpcad.errors import JumpcadError
from jumpcad.workshop import load_workshop


@each(
    "name",
    ["x/../../../report", "x\\y", ".hidden", "=HYPERLINK(1)", "+1", "-1", "@x", "a\u0001", "[/x]", "a\nb", "", " a",
     "a|b", "a<b", "P" * 51, "\u202ex"],
)  # fmt: skip
def test_names_that_could_become_paths_formulas_or_markup_are_refused(name, written):
    quoted = json.dumps(name)  # TOML writes such texts as JSON does
    for text in (
        f"[roles]\nlinks = {quoted}\n[materials.{quoted}]\ndensity_g_cm3 = 1.2\n",
        f"[mass.weighed_g]\n{quoted} = 1.0\n",
        f"[prices_eur]\n{quoted} = 1.0\n",
        f"[bought]\nmotors = [{quoted}]\n",
        f"[bought]\nroller = {quoted}\n",
    ):
        with pytest.raises(JumpcadError, match="a name has 1 to 50 letters, digits, spaces") as caught:
            load_workshop(written(text))
        assert str(caught.value).isprintable()


@pytest.mark.parametrize("text", ["a\x07", "a\x1b[31m", "a\nb", "a\u2028b", "a\u202eb", "a" * 1001])
def test_free_text_is_one_line_that_steers_no_terminal(text, written):
    for key in ("printer.name", "printer.source", "materials.PETG.source"):
        with pytest.raises(JumpcadError, match=f"{key} = .*: (contains the control character U|has 1001 characters)"):
            load_workshop(written(f"{key} = {json.dumps(text)}"))


def test_fits_that_no_printer_needs_are_refused(written):
    fits = ("press_mm", "sliding_mm", "loose_mm", "holes_small_mm")
    with pytest.raises(JumpcadError) as caught:
        load_workshop(written("[fits]\n" + "".join(f"{key} = -0.5\n" for key in fits)))
    assert all(f"fits.{key} = -0.5: must be at least" in str(caught.value) for key in fits)


@each(
    ("text", "message"),
    [
        ("[printer]\nnozzle_mm = 0", r"my.toml:2: printer.nozzle_mm = 0: must be at least 0.1"),
        ("[process]\ninfill = nan", r"process.infill = nan: must be a finite number"),
        ("[fits]\npress_mm = -0.6", r"fits.press_mm = -0.6: must be at least -0.2"),
        ("[fits]\nlose_mm = 0.4", r"fits.lose_mm: unknown key \(did you mean loose_mm\?\)"),
        ('[roles]\nlinks = "PA12"', r"materials.PA12.strength_in_plane_mpa: missing"),
        ("process = 3", r"process = 3: must be"),
        ("[mass.weighed_g]\nfoot = -1", r"weighed_g.foot = -1: must be at least 0.0001"),
        ("[prices_eur]\nnut = -1", r"prices_eur.nut = -1: must be at least 0"),
        ("[materials.PETG]\nprice_eur_per_kg = -20.0", r"PETG.price_eur_per_kg = -20.0: must be at least 0"),
        ('[mass]\nmodel = "guess"', r"mass.model = 'guess': must be 'printed' or 'solid'"),
    ],
)
def test_values_beyond_their_limits_are_one_line(text, message, refusal):
    assert re.search(message, refusal(text))


@each(
    ("table", "ranges"),
    [("printer", 2), ("process", 9), ("fits", 20), ("bought", 1), ("body", 4), ("seats", 6), ("ground", 2),
     ("pins", 1), ("spring", 1), ("release", 10), ("safety", 20)],
)  # fmt: skip
def test_numbers_may_have_the_ranges_that_the_reference_tells(table, ranges):
    assert len(documented_ranges(table)) == ranges
    assert wrongly_taken(table, type(getattr(load_workshop(), table))) == []


def test_materials_may_have_the_ranges_that_the_reference_tells():
    for name, material in load_workshop().materials.items():
        assert len(documented_ranges(f"materials.{name}")) == 7
        assert wrongly_taken(f"materials.{name}", type(material)) == []


def test_a_link_is_as_far_off_as_the_play_of_both_its_ends():
    """Sliding fits of 0.2 mm a diameter."""
    assert load_workshop().fits.sliding_mm == 0.2
    assert load_workshop().fits.link_tolerance_mm == pytest.approx(0.4)


def test_a_motors_share_has_its_reserve_and_the_stiffest_springs():
    """5 % in reserve, springs up to 10 % stiffer than ordered: 0.95/1.1."""
    figures = {"motor_torque_reserve": 0.05, "spring_rate_scatter": 0.1, "stress_reserve": 0.3, "kick_reserve": 0.4}
    safety = load_workshop().safety.model_copy(update=figures)
    assert safety.motor_share == pytest.approx(0.95 / 1.1)


def test_factors_of_safety_multiply():
    """Springs up to 10 % stiffer and 5 % in reserve: 1.155 times the load; on top of 3 for prints, 1.5 for metal."""
    figures = {"spring_rate_scatter": 0.1, "stress_reserve": 0.05, "strength_factor": 3.0, "steel_factor": 1.5}
    others = {"motor_torque_reserve": 0.3, "kick_reserve": 0.4, "leg_flex_share": 0.2}
    safety = load_workshop().safety.model_copy(update=figures | others)
    assert safety.load_factor == pytest.approx(1.155)
    assert safety.printed_factor == pytest.approx(3.465)
    assert safety.metal_factor == pytest.approx(1.7325)


@pytest.mark.parametrize(("pad", "friction"), [("sj5616", 0.7), ("", 0.3)])
def test_feet_have_the_friction_of_their_pads_or_of_what_is_printed(pad, friction):
    ground = load_workshop().ground.model_copy(update={"pad": pad, "friction": 0.7, "bare_friction": 0.3})
    assert ground.foot_friction == friction
