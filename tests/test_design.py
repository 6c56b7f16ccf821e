"""The eight numbers: what follows from them, their limits, their files."""

import math
import re
from pathlib import Path

import pytest
from support.each import each

from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError, JumpcadError

KENAN_2 = [100.0, 1.0, 0.833, 0.934, 0.46145125, 88.2, 9.2, 40.0]


def changed(**changes: float) -> Design:
    return Design.from_vector(KENAN_2).model_copy(update=changes)


def test_equal_legs_have_no_tilt_and_a_body_as_long_as_the_foot() -> None:
    design = Design.from_vector(KENAN_2)
    assert design.beta_rad == 0.0
    assert design.l1_mm == pytest.approx(design.l4_mm)


@pytest.mark.parametrize("name", ["kenan-1.0", "best-ga"])
def test_assembled_pose_closes(name: str) -> None:
    """The way along body, front link, foot and main leg ends where it began, with the foot flat."""
    design = load_design(name)
    tilt, leg = design.beta_rad, math.radians(design.rest_angle_deg) - design.beta_rad
    forwards = design.l1_mm * math.cos(tilt) + (design.l3_mm - design.l2_mm) * math.cos(leg) - design.l4_mm
    upwards = design.l1_mm * math.sin(tilt) - (design.l3_mm - design.l2_mm) * math.sin(leg)
    assert (forwards, upwards) == pytest.approx((0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize(
    ("name", "energy_j", "torque_nm"),
    [("kenan-1.0", 0.153, None), ("kenan-2.0", 0.133, 0.374), ("best-bo", 0.719, 1.56), ("best-ga", 0.730, None)],
)
def test_spring_energy_and_torque_are_the_published_ones(name: str, energy_j: float, torque_nm: float | None) -> None:
    design = load_design(name)
    assert design.spring_energy_j == pytest.approx(energy_j, abs=5e-4)
    if torque_nm:
        assert design.peak_spring_torque_nm == pytest.approx(torque_nm, rel=5e-3)


def test_work_of_the_springs_is_the_integral_of_their_torque() -> None:
    design = load_design("best-bo")
    degrees = math.degrees(design.compression_rad)
    by_degrees = sum(design.stiffness_nmm_per_deg / 1000.0 * (i + 0.5) / 1000 * degrees for i in range(1000)) / 1000
    assert design.spring_energy_j == pytest.approx(by_degrees * design.compression_rad, rel=1e-9)


def test_longest_link() -> None:
    assert changed().l_max_mm == 100.0
    assert changed(c_coef=1.1).l_max_mm == pytest.approx(110.0)
    assert changed(e_coef=1.2).l_max_mm == pytest.approx(120.0)
    assert changed(d_coef=1.3).l_max_mm == 100.0  # the foot is none of the study's lengths of a body


def test_vector_keeps_the_order_of_the_study() -> None:
    assert tuple(SEARCH_BOUNDS) == PARAMETERS
    design = Design.from_vector(KENAN_2)
    assert design.to_vector() == KENAN_2
    assert (design.l3_mm, design.l4_mm, design.l5_mm) == pytest.approx((100.0, 83.3, 93.4))


def test_template_is_the_prototype() -> None:
    assert load_design("kenan-2.0").to_vector() == KENAN_2


def test_toml_keeps_every_bit(tmp_path: Path) -> None:
    design = changed(carrying_link_mm=100.0 / 3 * math.pi, c_coef=1.0000000000000002)
    file = tmp_path / "thirds.toml"
    file.write_text(design.to_toml())
    assert load_design(file) == design


def test_whole_numbers_are_numbers() -> None:
    assert Design.from_vector([int(value) or 1 for value in KENAN_2[:1]] + KENAN_2[1:]) == Design.from_vector(KENAN_2)


@pytest.mark.parametrize("count", [0, 7, 9])
def test_vector_of_another_length_is_refused(count: int) -> None:
    with pytest.raises(JumpcadError, match=f"has 8 values, not {count}"):
        Design.from_vector([1.0] * count)


@each(
    ("name", "value", "limit"),
    [
        ("carrying_link_mm", 9000.0, "at most 400"),
        ("carrying_link_mm", -1.0, "at least 20"),
        ("rest_angle_deg", 95.0, "at most 90"),
        ("compression_ratio", 1.0, "at most 0.99"),
        ("stiffness_nmm_per_deg", math.nan, "a finite number"),
        ("stiffness_nmm_per_deg", math.inf, "a finite number"),
        ("d_coef", "0.8", "a valid number"),
        ("e_coef", True, "a valid number"),
    ],
)
def test_values_out_of_range_are_refused_by_name(name: str, value: object, limit: str) -> None:
    values = dict(zip(PARAMETERS, KENAN_2, strict=True)) | {name: value}
    with pytest.raises(JumpcadError, match=rf"^{name} = .*must be {limit}$"):
        Design(**values)


@pytest.mark.parametrize(
    "changes",
    [
        {"c_coef": 2.0, "d_coef": 0.5},
        {"c_coef": 2.0, "d_coef": 0.9, "rest_angle_deg": 30.0},
        {"c_coef": 0.3, "d_coef": 0.5},
    ],
    ids=["front link too long", "pivots would change places", "front link too short"],
)
def test_design_without_assembled_pose_is_refused(changes: dict[str, float]) -> None:
    design = changed(**changes)
    assert design.assembly_margin_mm < 0
    with pytest.raises(CannotBuildError, match=r"no assembled pose.*c_coef.*d_coef"):
        _ = design.l1_mm


@pytest.mark.parametrize("changes", [{"c_coef": 2.0, "d_coef": 0.5}, {"c_coef": 0.3, "d_coef": 0.5}])
def test_the_foot_that_is_asked_for_is_just_long_enough(changes: dict[str, float]) -> None:
    """To the tenth of a millimetre in which it is said."""
    design = changed(**changes)
    with pytest.raises(CannotBuildError) as refused:
        _ = design.beta_rad
    said = re.search(r"l4 = ([\d.]+) mm must be more than ([\d.]+) mm", str(refused.value))
    assert said is not None
    assert float(said[1]) == pytest.approx(design.l4_mm, abs=0.051)
    for more_mm, is_enough in ((0.1, True), (-0.1, False)):
        foot = changed(**changes | {"d_coef": (float(said[2]) + more_mm) / design.l2_mm})
        assert (foot.assembly_margin_mm > 0.0) == is_enough


def test_a_shorter_front_link_needs_a_foot_as_long_as_the_legs_differ_in_height_alone() -> None:
    """Legs of 100 and 50 mm that stand at 30° differ by 25 mm in height; lying flat they fold the other way round."""
    short = changed(c_coef=0.5, d_coef=0.4, rest_angle_deg=30.0)
    assert short.assembly_margin_mm == pytest.approx(40.0 - 25.0)
    assert short.l1_mm > 0.0


def test_assembly_margin_is_the_limit_of_a_real_body() -> None:
    """The body's length goes to zero with the margin where the front link is longer."""
    long = changed(c_coef=1.833 - 1e-6, rest_angle_deg=40.0)
    assert 0 < long.assembly_margin_mm < 1e-3
    assert 0 < long.l1_mm < 0.02


def test_designs_are_values() -> None:
    design = Design.from_vector(KENAN_2)
    assert hash(design) == hash(Design.from_vector(KENAN_2))
    with pytest.raises(JumpcadError, match=r"^Design\.\w+ cannot be changed: make a copy that differs, [^\n]+$"):
        design.c_coef = 2.0  # type: ignore[misc]


def test_files_of_another_kind_are_named_in_one_clause(tmp_path: Path) -> None:
    file = tmp_path / "x.toml"
    for text in ('base = "default"\n[cage]\nrod = "glass-1.5"\n', "[bodies.foot]\nmass_g = 2.0\n", "[design]\n"):
        file.write_text(text, encoding="utf-8")
        with pytest.raises(JumpcadError, match=r"x\.toml: is no design") as told:
            load_design(file)
        assert "missing" not in str(told.value), text
