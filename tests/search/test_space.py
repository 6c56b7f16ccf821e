"""The searched part of the design space."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.hills import FIXED

from jumpcad.building import build
from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.search.parameter import SearchParameter
from jumpcad.search.space import Space
from jumpcad.search.study.variant import Variant
from jumpcad.workshop import load_workshop


def test_default_space_is_the_published_box():
    space = Space.default()
    low, high = space.to_design(np.zeros(8)), space.to_design(np.ones(8))
    assert low.to_vector() == [100, 0.8, 0.5, 0.6, 0.1, 20, 5, 10]
    assert high.to_vector() == [200, 1.2, 0.9, 1.4, 0.8, 70, 30, 80]
    assert space.size == np.inf


@settings(max_examples=50, deadline=None)
@given(st.lists(st.floats(0, 1), min_size=8, max_size=8))
def test_unit_cube_and_designs_correspond(unit):
    space = Space.default()
    assert space.to_unit(space.to_design(unit)) == pytest.approx(unit, abs=1e-9)  # of values with ten decimals


def test_a_design_out_of_bounds_is_out_of_the_cube():
    """By as many ranges as it is beyond: 90 mm of 100 to 200 are -0.1, 225 mm are 1.25."""
    space = Space.default()
    middle = space.to_design(np.full(8, 0.5))
    for length, expected in ((90.0, -0.1), (225.0, 1.25)):
        assert space.to_unit(middle.model_copy(update={"carrying_link_mm": length}))[0] == pytest.approx(expected)


def test_fixed_rebounded_and_chosen_parameters():
    space = Space.parse(
        fix=["rest_angle_deg=88.2"], bound=["carrying_link_mm=80:120"], choose=["stiffness_nmm_per_deg=20,9.2,12"]
    )
    assert space.dimension == 7
    assert "rest_angle_deg" not in [parameter.name for parameter in space.free]
    designs = [space.to_design(point) for point in space.spread(64, np.random.default_rng(1))]
    assert {design.rest_angle_deg for design in designs} == {88.2}
    assert {design.stiffness_nmm_per_deg for design in designs} == {9.2, 12.0, 20.0}
    lengths = [design.carrying_link_mm for design in designs]
    assert 80 <= min(lengths) < 85
    assert 115 < max(lengths) <= 120


def test_choices_snap_to_the_nearest():
    space = Space.parse(choose=["stiffness_nmm_per_deg=10,12,20"], around=load_design("best-bo"), only=["d_coef"])
    space = Space.parse(choose=["stiffness_nmm_per_deg=10,12,20"])
    column = [parameter.name for parameter in space.free].index("stiffness_nmm_per_deg")
    points = np.full((3, 8), 0.5)
    points[:, column] = [0.05, 0.55, 0.9]  # 10.5, 15.5 and 19 N·mm/deg
    assert [space.to_design(p).stiffness_nmm_per_deg for p in space.snap(points)] == [10.0, 12.0, 20.0]
    assert Space.parse(fix=[f"{n}={SEARCH_BOUNDS[n].lower}" for n in PARAMETERS if n != "stiffness_nmm_per_deg"],
                       choose=["stiffness_nmm_per_deg=10,12,20"]).size == 3  # fmt: skip
    choices = ["c_coef=0.9,1", "d_coef=0.6,0.7", "stiffness_nmm_per_deg=10,12,20"]
    fixed = [f"{n}={SEARCH_BOUNDS[n].lower}" for n in PARAMETERS if not any(one.startswith(n) for one in choices)]
    assert Space.parse(fix=fixed, choose=choices).size == 2 * 2 * 3


def test_spread_points_of_choices_are_their_levels():
    """Of 10, 12 and 20 the levels are 0, 0.2 and 1: else a model would learn of places where no design was."""
    space = Space.parse(choose=["stiffness_nmm_per_deg=10,12,20"])
    column = [parameter.name for parameter in space.free].index("stiffness_nmm_per_deg")
    points = space.spread(32, np.random.default_rng(0))
    assert np.unique(points[:, column]) == pytest.approx([0.0, 0.2, 1.0])
    assert len(points) == 32
    assert len(np.unique(np.delete(points, column, axis=1))) == 32 * 7


@pytest.mark.parametrize("order", ["a,b,c", "c,a,b"])
def test_every_name_is_spread_as_often_in_whatever_order_it_is_given(order):
    """And every number of unequally spaced ones."""
    names = SearchParameter.among("bought.battery", order.split(","))
    numbers = SearchParameter("c_coef", 0.8, 1.2, (0.8, 0.85, 1.2))
    space = Space((names, numbers))
    points = space.spread(96, np.random.default_rng(0))
    for column, parameter in zip(points.T, space.free, strict=True):
        counts = [np.isclose(column, level).sum() for level in parameter.levels]
        assert sum(counts) == 96
        assert max(counts) - min(counts) <= 3


def test_values_lie_within_bounds_of_any_number_of_digits():
    """A third and two thirds, which the ten decimals of values pass."""
    space = Space.parse(bound=[f"d_coef={2.0 / 3.0 - 0.1!r}:{2.0 / 3.0!r}", f"rest_angle_deg={100.0 / 3.0!r}:50"])
    for point in (np.zeros(8), np.ones(8)):
        design = space.to_design(point)
        assert 2.0 / 3.0 - 0.1 <= design.d_coef <= 2.0 / 3.0
        assert 100.0 / 3.0 <= design.rest_angle_deg <= 50.0


def test_near_a_design_and_only_some_parameters():
    centre = load_design("best-ga")
    near = Space.parse(around=centre, within_percent=10)
    assert near.contains(centre)
    for parameter in near.free:
        full = SEARCH_BOUNDS[parameter.name]
        assert parameter.width <= 0.2 * (full.upper - full.lower) + 1e-9
    two = Space.parse(around=centre, only=["rest_angle_deg", "e_coef"])
    assert {parameter.name for parameter in two.free} == {"rest_angle_deg", "e_coef"}
    assert two.to_design([0.5, 0.5]).carrying_link_mm == centre.carrying_link_mm


def test_contains_knows_ranges_fixed_values_and_choices():
    space = Space.parse(fix=["c_coef=1"], choose=["stiffness_nmm_per_deg=9.2,20"])
    design = space.to_design(np.full(7, 0.3))
    assert space.contains(design)
    for change in ({"c_coef": 1.01}, {"stiffness_nmm_per_deg": 10.0}, {"carrying_link_mm": 201.0}):
        assert not space.contains(design.model_copy(update=change))


def test_a_variant_of_other_values_of_the_workshop_is_not_in_the_space():
    """As many as there are, of other keys or in another order, are not those that are searched."""
    space = Space.parse(bound=["body.plate_mm=1.2:2.4", "process.infill=0.1:0.5"], workshop=load_workshop())
    design = Space.default().to_design(np.full(8, 0.5))
    own = {"body.plate_mm": 1.5, "process.infill": 0.3}
    assert space.contains(Variant(design, own))
    for other in (
        {"body.plate_mm": 1.5, "body.stop_deg": 4.0},
        dict(reversed(own.items())),
        {"body.plate_mm": 1.5},
        {},
    ):
        assert not space.contains(Variant(design, other))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"fix": ["carrying_lnk_mm=100"]}, "did you mean carrying_link_mm"),
        ({"fix": ["zzz=100"]}, "the parameters are carrying_link_mm"), ({"fix": ["c_coef"]}, "NAME=VALUE"),
        ({"fix": ["c_coef=one"]}, "'one' is not a number"),
        ({"fix": ["rest_angle_deg=95"]}, r"rest_angle_deg = 95 is outside 5…90"),
        ({"fix": ["c_coef=nan"]}, "c_coef = nan is outside"), ({"bound": ["c_coef=1.1:0.9"]}, "empty range"),
        ({"bound": ["c_coef=1:1"]}, "empty range"), ({"bound": ["c_coef=1"]}, "NAME=LO:HI"),
        ({"choose": ["c_coef=1,,2"]}, "'' is not a number"),
        ({"fix": ["c_coef=1"], "bound": ["c_coef=0.9:1.1"]}, "given twice"), ({"only": ["c_coef"]}, "around which"),
        ({"within_percent": 10.0}, "around which"),
        ({"within_percent": 0.0, "around": load_design("best-bo")}, "outside 0…100"),
        ({"fix": [f"{name}={limits.lower}" for name, limits in SEARCH_BOUNDS.items()]}, "nothing is left to search"),
    ],
)  # fmt: skip
def test_wrong_spaces_are_refused_in_one_line(options, message):
    with pytest.raises(JumpcadError, match=message) as caught:
        Space.parse(**options)
    assert "\n" not in str(caught.value)


def test_a_part_of_the_space_is_as_wide_as_asked_and_not_wider_than_the_whole():
    """10 % to either side are a fifth of the range; at an end of it a tenth, or what is left."""
    space = Space.default()
    middle, end, beside = (Variant(space.to_design(np.full(8, at))) for at in (0.5, 1.0, 0.05))
    for variant, shares in ((middle, (0.4, 0.6)), (end, (0.9, 1.0)), (beside, (0.0, 0.15))):
        part = space.near(variant, (), 10.0)
        for one, whole in zip(part.free, space.free, strict=True):
            ends = [(value - whole.lower) / whole.width for value in (one.lower, one.upper)]
            assert ends == pytest.approx(shares, abs=1e-9)
    held = space.near(middle, ("e_coef",), None)
    assert [parameter.name for parameter in held.free] == ["e_coef"]
    assert (held.free[0].lower, held.free[0].upper) == (0.6, 1.4)
    assert held.to_design([0.5]) == middle.design


def test_a_space_is_the_same_by_texts_and_by_values():
    """Names keep the order in which they are given, which numbers them."""
    by_text = Space.parse(
        fix=["c_coef=1", "bought.leg_bearing="], bound=["d_coef=0.6:0.7", "body.plate_mm=1.2:2.4"],
        choose=["stiffness_nmm_per_deg=20,9.2", "bought.battery=lipo-2s-180,lipo-1s-300"], workshop=load_workshop(),
    )  # fmt: skip
    by_value = Space.make(
        {"c_coef": 1, "bought.leg_bearing": ""}, {"d_coef": (0.6, 0.7), "body.plate_mm": (1.2, 2.4)},
        {"stiffness_nmm_per_deg": [20, 9.2], "bought.battery": ("lipo-2s-180", "lipo-1s-300")},
        workshop=load_workshop(),
    )  # fmt: skip
    assert by_text == by_value
    named = next(one for one in by_value.free if one.names)
    assert named.names == ("lipo-2s-180", "lipo-1s-300")
    near = {"around": load_design("best-ga"), "only": ["d_coef", "e_coef"], "within_percent": 10.0}
    assert Space.make(**near) == Space.parse(**near) != Space.default()


def test_a_part_of_the_space_keeps_what_is_fixed_and_all_choices():
    """Choices and names are not narrowed: the nearest might be none. What is not named has the centre's value."""
    space = Space.parse(
        fix=[*FIXED[:-1], "body.stop_deg=5"], bound=["body.plate_mm=1.6:2.4"],
        choose=["stiffness_nmm_per_deg=10,20,30", "bought.battery=lipo-2s-180,lipo-1s-300"], workshop=load_workshop(),
    )  # fmt: skip
    centre = space.to_variant(np.full(space.dimension, 0.5)).changed({"bought.battery": "lipo-1s-300"})
    near = space.near(centre, (), 10.0)
    parts = dict(zip([one.name for one in near.parameters], near.parameters, strict=True))
    wholes = dict(zip([one.name for one in space.parameters], space.parameters, strict=True))
    assert parts["stiffness_nmm_per_deg"] == wholes["stiffness_nmm_per_deg"]
    assert parts["bought.battery"] == wholes["bought.battery"]
    assert parts["body.stop_deg"] == wholes["body.stop_deg"]
    assert [parts["body.plate_mm"].lower, parts["body.plate_mm"].upper] == pytest.approx([1.92, 2.08])
    held = space.near(centre, ("body.plate_mm",), None)
    assert [one.name for one in held.free] == ["body.plate_mm"]
    assert held.to_variant([0.5]) == centre
    assert held.to_variant([0.5]).workshop["bought.battery"] == "lipo-1s-300"
    assert space.near(centre, ("c_coef",), None) is None


def test_the_box_follows_springs_from_stock() -> None:
    """Their stiffness is fixed at two of them; angles at which arms miss the room for the pin are left out."""
    shop = load_workshop("first-robot")
    box = {parameter.name: parameter for parameter in Space.make(workshop=shop).parameters}
    assert (box["stiffness_nmm_per_deg"].lower, box["stiffness_nmm_per_deg"].upper) == (2.0 * 26.36, 2.0 * 26.36)
    angle = box["rest_angle_deg"]
    assert angle.lower < load_design("first-robot").rest_angle_deg <= angle.upper
    for outside in (20.0, angle.lower - 3.0):
        with pytest.raises(CannotBuildError, match="the plate's pin must be"):
            build(load_design("kenan-2.0").model_copy(update={"rest_angle_deg": outside}), shop)
    asked = Space.make(bounds={"rest_angle_deg": (30, 40)}, fixed={"stiffness_nmm_per_deg": 9.2}, workshop=shop)
    assert {p.name: (p.lower, p.upper) for p in asked.parameters}["rest_angle_deg"] == (30.0, 40.0)
    near = Space.make(around=load_design("kenan-2.0"), within_percent=25, workshop=shop)
    assert {p.name: (p.lower, p.upper) for p in near.parameters}["rest_angle_deg"] == pytest.approx((69.45, 90.0))


def test_the_box_of_a_printed_robot_is_wider_than_the_study_s_unless_that_is_asked_for() -> None:
    """`--bound study` and the table itself are the same, also beside a value that is fixed; so is a capsule search."""
    shop = load_workshop()
    wide, study = Space.make(workshop=shop), Space.default()
    for wider, narrower in zip(wide.parameters, study.parameters, strict=True):
        assert wider.lower < narrower.lower < narrower.upper < wider.upper, wider.name
    assert Space.parse(bound=["study"], workshop=shop) == Space.make(bounds=SEARCH_BOUNDS, workshop=shop) == study
    assert Space.make() == study == Space.make(workshop=shop, study=True)
    mixed = Space.parse(bound=["study", "c_coef=1:1.3"], fix=["d_coef=0.7"], workshop=shop)
    assert [(one.lower, one.upper) for one in mixed.parameters[1:4]] == [(1.0, 1.3), (0.7, 0.7), (0.6, 1.4)]
