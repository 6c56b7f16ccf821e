"""Legs with a bought bar between printed ends: measured on meshes, and against handbook formulas."""

from dataclasses import replace

import numpy as np
import pytest
from manifold3d import CrossSection
from support.built import built
from support.fits import with_fits_apart
from support.workshops import workshop_with

from jumpcad import build, load_design
from jumpcad.catalogue import load_catalogue
from jumpcad.checks import check
from jumpcad.errors import CannotBuildError
from jumpcad.findings import errors
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.leg.bar_limits import _socket
from jumpcad.robot.leg.drawing import front_bar_place, leg_bar_place, main_leg
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot

BARS = load_catalogue().bars


def robot(leg: str) -> Robot:
    return built("kenan-2.0", leg=leg)


def pieces(found: Robot, body: str) -> dict[str, np.ndarray]:
    """Bounds (2, 3) of every piece of a leg in the leg's frame (mm), the bar's too."""
    sizes = {}
    for part in found.parts:
        for number, place in enumerate(part.placements):
            if place.body == body and part.name.startswith(body):
                mesh = part.mesh.copy().apply_transform(place.T_body_part)
                assert mesh.is_watertight
                sizes[f"{part.name}{number}"] = mesh.bounds
    bar = next(item for item in found.hardware if item.name == f"{body}_bar")
    sizes["bar"] = bar.shown_mesh.copy().apply_transform(bar.T_body_part).bounds
    return sizes


@pytest.mark.parametrize("leg", ["carbon-tube-4x2", "carbon-strip-3x6"])
def test_bars_sit_in_the_sockets_of_both_ends(leg: str) -> None:
    """Each end holds the bar over twice its height or 8 mm, and nothing else joins them."""
    found = robot(leg)
    for body, last in (("main_leg", "main_leg_end0"), ("front_link", "front_link1")):
        sizes = pieces(found, body)
        first, end, bar = (sizes[name][:, 0] for name in (f"{body}0", last, "bar"))
        assert first[1] < end[0], "the printed ends are apart"
        assert bar[0] < first[1] - 7.5
        assert bar[1] > end[0] + 7.5
        height, width = np.ptp(sizes["bar"][:, 2]), np.ptp(sizes["bar"][:, 1])
        assert (width, height) == pytest.approx((BARS[leg].width_mm, BARS[leg].height_mm), abs=0.1)


def test_the_whole_heel_is_printed() -> None:
    """However far from the hub the stop is: the socket's mouth is not before the pad's end and half a millimetre."""
    found = robot("carbon-tube-4x2")
    layout = found.layout
    far = replace(layout, stop=replace(layout.stop, radius_mm=40.0))
    place = leg_bar_place(far, HoleSizes.of(found.workshop, layout.hub_bearing))
    assert place is not None
    assert place.mouth_mm == pytest.approx(40.0 + 8.0 / 2.0 + 0.5)


@pytest.mark.thorough
@pytest.mark.parametrize("leg", ["carbon-tube-4x2", "carbon-strip-3x6"])
def test_such_legs_pass_every_check_and_nothing_meets(leg: str) -> None:
    found = check(robot(leg))
    assert not errors(found)
    names = {finding.name for finding in found}
    assert {"leg_bar_strength", "leg_socket_strength", "leg_bar_bond", "leg_bar_flex", "front_bar_buckling"} <= names
    assert not {"leg_flex", "front_link_buckling"} & names


def test_a_tube_makes_the_legs_lighter() -> None:
    whole, light = robot(""), robot("carbon-tube-4x2")
    assert whole.mass_kg - light.mass_kg > 2e-3
    assert light.bodies["main_leg"].inertia_kg_m2[1, 1] < whole.bodies["main_leg"].inertia_kg_m2[1, 1]


def test_the_mass_of_a_bar_is_its_section_times_its_length() -> None:
    """4 x 2 mm of 1.5 g/cm³: 14.1 g a metre."""
    bar = next(item for item in robot("carbon-tube-4x2").hardware if item.name == "front_link_bar")
    length = np.ptp(bar.shape.bounds_mm[:, 0])
    assert bar.mass_kg == pytest.approx(14.1e-6 * length, rel=0.01)
    assert f"cut {length:.1f} mm" in bar.article


def test_a_bar_has_the_fit_of_lying_holes_in_its_sockets() -> None:
    """A strip of 3 x 6 mm with 0.15 mm on every side, 3.3 x 6.3 mm, printed and checked; other fits are smaller."""
    found = robot("carbon-strip-3x6")
    shop = with_fits_apart(found.workshop)
    layout, holes = found.layout, HoleSizes.of(shop, found.layout.hub_bearing)
    place, middle = leg_bar_place(layout, holes), layout.sections.thickness_mm / 2.0
    assert place is not None
    drawing, *_ = main_leg(layout, shop)
    levels = middle + np.array([-1.7, -1.6, 0.0, 1.6, 1.7])
    across = CrossSection.square((1.0, 50.0), True).translate((place.mouth_mm - 2.0, 0.0))
    left = np.array([(across ^ one).area() for one in drawing.shape.regions_at(levels)])
    assert left[0] - left == pytest.approx([0.0, 6.3, 6.3, 6.3, 0.0], abs=1e-3)
    assert _socket(LoadCase(replace(found, workshop=shop)), place).gap_mm == 0.15


def test_sockets_begin_two_walls_beside_the_holes_of_pins() -> None:
    """Walls of 1.2 mm; the springs' pin of 3 mm has 0.05 mm around it here, the pins in eyes have 0.08 mm."""
    found = robot("carbon-strip-3x6")
    layout, design = found.layout, found.design
    holes = HoleSizes.of(with_fits_apart(found.workshop), layout.hub_bearing)
    leg, front = leg_bar_place(layout, holes), front_bar_place(layout, holes)
    assert leg is not None
    assert front is not None
    assert (leg.floor_mm, leg.far_floor_mm) == pytest.approx((layout.leg_pin_mm + 3.95, design.l2_mm - 3.98))
    assert (front.floor_mm, front.far_floor_mm) == pytest.approx((3.98, design.l3_mm - 3.98))


def test_a_leg_that_is_too_short_is_refused_with_the_length_that_misses() -> None:
    short = load_design("kenan-2.0").model_copy(update={"carrying_link_mm": 62.0})
    with pytest.raises(CannotBuildError, match=r"bought\.leg.* mm of the .* are free between the bar's sockets; 5 mm"):
        build(short, workshop_with(bought={"leg": "carbon-tube-6x4"}))
