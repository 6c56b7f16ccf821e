"""Mechanical articles: the stiffness of rubber blocks, the turns of springs with tangent arms, room in a bearing."""

import math

import pytest

from jumpcad.catalogue import StockSpring, load_catalogue


def test_a_wide_pad_is_stiffer_than_its_area_says() -> None:
    """Gent's block between plates: 1 + 2·φ·S² times that of a free one, S = loaded over free area."""
    for pad in load_catalogue().pads.values():
        narrow, thickness = 2.0, pad.thickness_mm
        shape = narrow * narrow / (4.0 * narrow * thickness)
        free = pad.modulus_mpa * narrow * narrow / thickness
        assert pad.rate_n_per_mm(narrow, narrow) == pytest.approx(free * (1.0 + 1.28 * shape**2))
        assert pad.rate_n_per_mm(2.0 * narrow, 2.0 * narrow) > 4.0 * pad.rate_n_per_mm(narrow, narrow)


@pytest.mark.parametrize(("angle_deg", "turns"), [(180.0, 4.0), (90.0, 4.25), (270.0, 3.75)])
def test_turns_follow_from_the_angle_between_tangent_arms(angle_deg: float, turns: float) -> None:
    """Opposite arms of whole turns; each quarter turn more closes the angle by 90°."""
    spring = next(iter(load_catalogue().springs.values())).model_copy(
        update={"turns": turns, "arm_angle_deg": angle_deg}
    )
    assert spring.wound_turns == turns
    assert not [place for place, *_ in spring.contradictions() if place == ("arm_angle_deg",)]
    wrong = spring.model_copy(update={"turns": turns + 0.25})
    ((place, _, reason),) = wrong.contradictions()
    assert place == ("arm_angle_deg",)
    advised = float(reason.partition("have ")[2].partition("°")[0])
    assert advised == (angle_deg - 90.0) % 360.0
    assert f"{angle_deg:g}° take {turns:g} turns" in reason
    assert (f", and {360.0 - angle_deg:g}°" in reason) == (angle_deg != 180.0)  # the same on either side
    assert not list(wrong.model_copy(update={"arm_angle_deg": advised}).contradictions())


def test_a_bearing_has_room_for_its_balls() -> None:
    bearing = next(iter(load_catalogue().bearings.values()))
    thin = bearing.model_copy(update={"outer_mm": bearing.bore_mm + 1.0})
    assert [place for place, *_ in thin.contradictions()] == [("outer_mm",)]
    least = bearing.model_copy(update={"bore_mm": 1.0, "outer_mm": 3.0, "mass_g": 0.12})  # the smallest of ISO 15
    assert not list(least.contradictions())
    assert list(least.model_copy(update={"outer_mm": 2.99}).contradictions())


def test_a_bearing_weighs_less_than_a_ring_of_steel_of_its_size() -> None:
    """That of a 623, of 3 to 10 mm and 4 mm wide: 7.85 mg/mm³ of pi/4·91·4 mm³ are 2.24 g; SKF gives 1.5 g."""
    bearing = load_catalogue().bearings["623"]
    for mass_g, refused in (
        (1.5, False),
        (2.24, False),
        (2.25, True),
        (0.25, False),
        (0.15, True),
        (0.0016, True),
        (800.0, True),
    ):
        found = bearing.model_copy(update={"mass_g": mass_g}).contradictions()
        assert [place for place, *_ in found] == [("mass_g",)] * refused, mass_g


def test_each_hand_is_ordered_by_its_number_or_as_the_twin_of_the_other() -> None:
    springs = load_catalogue().springs
    assert springs["9271K272"].article("right") == "torsion spring, right hand, McMaster-Carr 9271K271"
    assert springs["9271K133"].article("right") == "torsion spring, right hand, 9271K133"
    twin = springs["9271K589"].article("right")
    assert twin.startswith("torsion spring, right hand, twin of McMaster-Carr 9271K589 (90°, ")
    assert "wire 2.667 mm, outside diameter 21.54 mm" in twin  # 0.105 and 0.848 in


@pytest.mark.parametrize("name", list(load_catalogue().springs))
def test_a_rate_per_radian_per_turn_or_in_newton_metres_is_refused(name: str) -> None:
    """Of stock springs the maker's rate is that of their steel wire, E·d⁴/(64·D·n), within 10 %."""
    spring = load_catalogue().springs[name]
    mean = spring.inside_diameter_mm + spring.wire_mm
    by_hand = 206000.0 * spring.wire_mm**4 / (64.0 * mean * spring.turns) * math.pi / 180.0
    assert spring.rate_nmm_per_deg == pytest.approx(by_hand, rel=0.1)
    assert not list(spring.contradictions())
    for factor in (180.0 / math.pi, 360.0, 1e-3, 0.18 / math.pi, 1.0 / 9.81):
        wrong = spring.model_copy(update={"rate_nmm_per_deg": factor * spring.rate_nmm_per_deg})
        assert [place for place, *_ in wrong.contradictions()] == [("rate_nmm_per_deg",)], factor
    bronze = spring.model_copy(update={"rate_nmm_per_deg": 110.0 / 206.0 * spring.rate_nmm_per_deg})
    assert not list(bronze.contradictions())
    assert not list(spring.model_copy(update={"rate_nmm_per_deg": 1.1 * by_hand}).contradictions())


@pytest.mark.parametrize("name", list(load_catalogue().springs))
def test_a_spring_as_a_shop_describes_it_has_the_makers_rate(name: str) -> None:
    """Of wire, outer diameter, turns, angle and arms alone, within 6 %; a rate that is given counts."""
    known = load_catalogue().springs[name]
    words = {"wire_mm", "turns", "arm_angle_deg", "arm_length_mm"}
    figures = known.model_dump(include=words) | {"name": "own", "source": "a drawer"}
    outer = known.inside_diameter_mm + 2.0 * known.wire_mm
    found = StockSpring(**figures, outer_diameter_mm=outer)
    assert found.inside_diameter_mm == pytest.approx(known.inside_diameter_mm)
    assert found.rate_nmm_per_deg == pytest.approx(known.rate_nmm_per_deg, rel=0.06)
    measured = known.rate_nmm_per_deg
    assert StockSpring(**figures, outer_diameter_mm=outer, rate_nmm_per_deg=measured).rate_nmm_per_deg == measured
    for wrong in (0.0, 3.0 * known.wire_mm), (outer, outer):
        both = {key: one for key, one in zip(("inside_diameter_mm", "outer_diameter_mm"), wrong, strict=True) if one}
        assert "outer_diameter_mm of more than three" in str([*StockSpring(**figures, **both).contradictions()])
