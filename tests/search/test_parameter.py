"""One parameter of a search."""

import math

import pytest

from jumpcad.design import PARAMETERS
from jumpcad.errors import JumpcadError
from jumpcad.search.parameter import Kind, SearchParameter, changed_parameter, physical_limits, read_changes
from jumpcad.search.space import Space
from jumpcad.workshop import load_workshop


def told(kind, text, workshop=None):
    """Return the parameter of a text from the command line."""
    ((name, values),) = read_changes(kind, [text]).items()
    return changed_parameter(kind, name, values, workshop)


def test_a_leg_moves_by_factors_where_its_range_is_wide_and_by_millimetres_where_not():
    """A step is as long as in the study's range: what counts as 1 is the logarithm of 2, or all of the range."""
    wide, study = SearchParameter("carrying_link_mm", 20.0, 250.0), SearchParameter("carrying_link_mm", 100.0, 200.0)
    assert wide.at([0.0, 0.5, 1.0]) == pytest.approx([20.0, math.sqrt(20.0 * 250.0), 250.0])
    assert study.at([0.5]) == [150.0]
    assert [wide.unit(number) for number in wide.at([0.3, 0.7])] == pytest.approx([0.3, 0.7])
    assert (wide.scale, study.scale) == pytest.approx((math.log(2.0) / math.log(12.5), 1.0))
    assert SearchParameter("rest_angle_deg", 15.0, 90.0).scale == pytest.approx(50.0 / 75.0)


@pytest.mark.parametrize("name", PARAMETERS)
def test_a_search_may_go_to_the_ends_of_what_a_design_can_be_and_no_further(name):
    ends = physical_limits(name)
    found = changed_parameter("bound", name, ends, None)
    assert (found.lower, found.upper) == ends
    for end, beyond in zip(ends, (-math.inf, math.inf), strict=True):
        with pytest.raises(JumpcadError, match=f"{name} = .* is outside .*: no design can have it"):
            changed_parameter("fix", name, (math.nextafter(end, beyond),), None)


def test_a_place_in_the_unit_interval_is_a_value_or_the_nearest_choice():
    free = SearchParameter("c_coef", 0.8, 1.2)
    assert free.at([-0.1, 0.0, 0.25, 1.0, 1.1]) == pytest.approx([0.8, 0.8, 0.9, 1.2, 1.2])
    chosen = SearchParameter("c_coef", 0.8, 1.2, (0.8, 0.9, 1.2))
    assert chosen.levels == pytest.approx((0.0, 0.25, 1.0))
    assert chosen.at([0.1, 0.2, 0.6, 0.7]).tolist() == [0.8, 0.9, 0.9, 1.2]


def test_a_narrowed_range_stays_within_what_a_design_can_be():
    angle = SearchParameter("rest_angle_deg", 20.0, 70.0)
    for centre, percent, ends in ((50, 10, (45, 55)), (88, 10, (83, 90)), (6, 10, (5, 11)), (45, 100, (5, 90))):
        near = angle.narrowed(centre, percent, physical_limits("rest_angle_deg"))
        assert (near.lower, near.upper) == pytest.approx(ends)


def test_bounds_of_a_workshops_value_are_numbers_and_its_choices_are_left_to_the_workshop() -> None:
    assert read_changes("bound", [" body.plate_mm = 1.2:2.4"]) == {"body.plate_mm": (1.2, 2.4)}
    assert read_changes("choose", ["bought.battery=one, two"]) == {"bought.battery": ("one", "two")}
    assert read_changes("fix", ["body_joint_mm=90"]) == {"body_joint_mm": (90.0,)}
    with pytest.raises(JumpcadError, match="'thin' is not a number"):
        read_changes("bound", ["body.plate_mm=thin:2.4"])


def test_whole_numbers_are_not_fixed_or_chosen_between_two() -> None:
    """A print has two perimeters or three; a robot with 2.6 would be another than its file says."""
    shop = load_workshop()
    for change in (("fix", "process.perimeters=2.6"), ("choose", "process.perimeters=2,2.6")):
        with pytest.raises(JumpcadError, match=r"process\.perimeters = 2\.6 is not a whole number"):
            told(*change, shop)
    found = told("choose", "process.perimeters=2,4", shop)
    assert found.choices == (2.0, 4.0)


def test_a_name_of_nothing_is_told_before_its_values() -> None:
    with pytest.raises(JumpcadError, match=r"'materials' is not a parameter .* a value of the workshop is TABLE\.NAME"):
        read_changes("choose", ["materials=PLA,PETG"])
    with pytest.raises(JumpcadError, match=r"'plate_mm' is not a parameter .* a value of the workshop is TABLE\.NAME"):
        told("fix", "plate_mm=2", load_workshop())


def test_a_whole_number_of_the_workshop_stays_one_from_bound_to_bound() -> None:
    found = told("bound", "process.perimeters=2:5", load_workshop())
    assert found.choices == (2.0, 3.0, 4.0, 5.0)
    shop = load_workshop()
    for bounds, said in (("2.5:5.5", {"choices": [3.0, 4.0, 5.0]}), ("2.5:3.4", {"fixed": 3.0})):
        space = Space.parse(bound=[f"process.perimeters={bounds}"], workshop=shop)
        assert space.describe()["process.perimeters"] == said
        assert Space.from_record(space.describe()) == space  # as a study is read again
    with pytest.raises(JumpcadError, match=r"perimeters = 2.2:2.8 holds no whole number, .*: widen the range"):
        Space.parse(bound=["process.perimeters=2.2:2.8"], workshop=shop)
    found = told("bound", "process.infill=0.2:0.5", load_workshop())
    assert found.choices == ()


def test_values_of_a_cage_are_searched_where_there_is_one() -> None:
    shop = load_workshop("best-jumper")
    assert Space.parse(choose=["cage.bow=true,false"], workshop=shop).describe()["cage.bow"] == {"choices": [0.0, 1.0]}
    for bounds, workshop, reason in (
        ("cage.rear_radius_mm=0:100", shop, "cage.rear_radius_mm = 1.0: must be at least 40, or 0"),
        ("cage.rear_radius_mm=80:100", load_workshop(), "cage.rear_radius_mm: the workshop has no cage: fix cage.rod"),
    ):
        with pytest.raises(JumpcadError, match=reason):
            Space.parse(bound=[bounds], workshop=workshop)
    Space.parse(bound=["cage.rear_radius_mm=80:100"], fix=["cage.rod=glass-1.5"], workshop=load_workshop())


@pytest.mark.parametrize("workshop", [None, load_workshop()], ids=["capsule", "printed"])
@pytest.mark.parametrize("kind", ["fix", "bound", "choose"])
def test_a_name_that_no_parameter_has_is_not_passed_over(kind, workshop):
    with pytest.raises(
        JumpcadError, match=r"'carrying_lnk_mm' is not a parameter of a design.*did you mean carrying_link_mm"
    ):
        changed_parameter(kind, "carrying_lnk_mm", (100.0, 120.0), workshop)
    with pytest.raises(JumpcadError, match="made in no workshop" if workshop is None else "did you mean body.plate_mm"):
        changed_parameter(kind, "body.plate", (1.0, 2.0), workshop)


def test_names_are_numbered_and_unknown_ones_are_no_number() -> None:
    named = SearchParameter.among("bought.battery", ["one", "two", "three"])
    assert [named.number(value) for value in ("one", "three")] == [0.0, 2.0]
    assert [named.value(number) for number in (0.0, 1.2, 1.9)] == ["one", "two", "three"]
    assert math.isnan(named.number("four"))
    plain = SearchParameter("c_coef", 0.8, 1.2)
    assert (plain.number(0.9), plain.value(0.9)) == (0.9, 0.9)
    assert math.isnan(plain.number("one"))


def test_names_are_chosen_and_have_no_bounds() -> None:
    names = ("lipo-1s-300", "lipo-2s-180")
    with pytest.raises(JumpcadError, match="choose among names, or give a range"):
        changed_parameter("bound", "bought.battery", names, load_workshop())
    named = changed_parameter("choose", "bought.battery", names, load_workshop())
    assert [named.value(number) for number in (0.0, 1.0)] == list(names)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("bound", "c_coef", (0.9,)), "c_coef has 1 bounds; give the lower and the upper one"),
        (("bound", "c_coef", (0.9, 1.0, 1.1)), "c_coef has 3 bounds; give the lower and the upper one"),
        (("choose", "c_coef", ()), "c_coef has no values to choose from; give at least one"),
        (("fix", "c_coef", ("1",)), r"c_coef = '1' \(str\) is not a number"),
        (("fix", "body.plate_mm", (None,)), "body.plate_mm = None is neither a number nor a name"),
        (("fix", "body.plate_mm", (2.5,)), ""), (("fix", "body.plate_mm", ("2.5",)), ""),
    ],
)  # fmt: skip
def test_a_change_has_as_many_numbers_as_its_kind_takes(
    change: tuple[Kind, str, tuple[object, ...]], said: str
) -> None:
    """A number of the workshop may be written as text, one of the design not."""
    if said:
        with pytest.raises(JumpcadError, match=said):
            changed_parameter(*change, load_workshop())
    else:
        assert changed_parameter(*change, load_workshop()).describe() == {"fixed": 2.5}
