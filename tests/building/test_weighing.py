"""Printed parts weigh what the layer model or the user's scales say; weights of parts that no robot has are refused."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import built
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.building.assembly import drawings, layout_of
from jumpcad.building.weighing import require_parts, weighed_part
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import FOOT
from jumpcad.printing import layer_mass, layers
from jumpcad.printing.layer_mass import printed_moments
from jumpcad.solids.moments import mass_of
from jumpcad.workshop import Workshop, load_workshop


def weighed(**grams: float) -> Workshop:
    """Return the default workshop with weights of parts (g)."""
    return workshop_with(mass={"weighed_g": grams})


def test_solid_parts_weigh_their_volume() -> None:
    """PETG 1.27 and PLA 1.24 g/cm³."""
    robot = built("kenan-2.0", mass_model="solid")
    for part in robot.parts:
        density = {"PETG": 1270.0, "PLA": 1240.0}[part.material]
        assert part.mass_kg == pytest.approx(density * part.mesh.volume * 1e-9, rel=5e-4), part.name


def test_printed_parts_are_mostly_lighter_than_solid_ones() -> None:
    """Nothing but narrow frames, in which a slicer's lines overlap, is heavier (PrusaSlicer: the trays by 3 %)."""
    printed, solid = built("kenan-2.0"), built("kenan-2.0", mass_model="solid")
    for light, heavy in zip(printed.parts, solid.parts, strict=True):
        assert 0.4 * heavy.mass_kg < light.mass_kg < 1.08 * heavy.mass_kg, light.name
    assert printed.mass_kg < solid.mass_kg


def test_a_weighed_part_weighs_what_the_scale_says() -> None:
    robot = build(load_design("kenan-2.0"), workshop_with(mass={"weighed_g": {"foot": 12.5}}))
    foot = next(part for part in robot.parts if part.name == "foot")
    assert foot.mass_kg == pytest.approx(0.0125)
    assert foot.mass_source == "weighed"
    gained = 0.0125 - next(part for part in built("kenan-2.0").parts if part.name == "foot").mass_kg
    assert robot.bodies[FOOT].mass_kg - built("kenan-2.0").bodies[FOOT].mass_kg == pytest.approx(gained, rel=1e-9)


def test_a_misspelt_weighed_part_is_told_when_the_parts_are_known() -> None:
    with pytest.raises(
        JumpcadError, match=r"mass\.weighed_g\.fot: no such part \(did you mean foot\?\); the robot has"
    ):
        build(load_design("kenan-2.0"), weighed(fot=12.5))


@pytest.mark.parametrize("grams", [-1.0, 0.0, math.nan, math.inf, "5", None, True])
def test_weights_that_nothing_has_are_refused_in_python_too(grams: float) -> None:
    with pytest.raises(JumpcadError, match=r"mass\.weighed_g\.foot = .*: must be"):
        build(load_design("kenan-2.0"), weighed(foot=grams))
    changed = load_workshop().model_copy(deep=True)
    changed.mass.weighed_g["foot"] = grams
    with pytest.raises(JumpcadError, match=r"mass\.weighed_g\.foot = .*: must be"):
        build(load_design("kenan-2.0"), changed)


@pytest.mark.parametrize("share", [1e-3, 1e3])
def test_a_weight_in_kilograms_or_milligrams_is_refused(share: float) -> None:
    (foot,) = (part for part in built("kenan-2.0").parts if part.name == "foot")
    with pytest.raises(JumpcadError, match=r"weighed_g\.foot = .*: as drawn it weighs about 8\.5 g: is it in grams"):
        build(load_design("kenan-2.0"), weighed(foot=share * 1000.0 * foot.mass_kg))


def test_parts_of_which_a_workshops_choice_decides_may_be_weighed_for_all_robots() -> None:
    """Ends of legs of bars, and the mount of a sensor: for a robot without them their weights are of no use."""
    whole = layout_of(load_design("kenan-2.0"), shop := load_workshop())
    barred = layout_of(load_design("kenan-2.0"), workshop_with(bought={"leg": "carbon-tube-4x2"}))
    few, more = ({one.name for one in drawings(layout, shop)} for layout in (replace(whole, sensor=None), barred))
    assert more - few == {"main_leg_end", "sensor_mount"}
    require_parts(more, sorted(few))


def test_a_part_weighs_what_the_printers_own_nozzle_lays() -> None:
    """A wider one bridges the infill of a plate with thicker threads."""
    workshop = load_workshop()
    wide = workshop_with(workshop, printer={"nozzle_mm": 0.6})
    drawing = next(part.drawing for part in built("kenan-2.0").parts if part.name == "body_plate_right")
    assert weighed_part(drawing, wide).mass_kg > 1.001 * weighed_part(drawing, workshop).mass_kg


def test_corners_that_are_left_out_of_plates_weigh_next_to_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """At most 0.05 % of a part's mass and 0.1 % of its inertia, against corners of half the tolerance."""
    robots = [built("kenan-2.0"), built("best-printable", "light")]
    parts = [part for robot in robots for part in robot.parts if part.name.startswith(("body_plate", "electronics"))]
    assert len(parts) == 8
    monkeypatch.setattr(layers, "MANY_HOLES", 10_000)
    monkeypatch.setattr(layer_mass, "FEW", 0)
    for part, shop in zip(parts, [robot.workshop for robot in robots for _ in range(4)], strict=True):
        density = shop.material("body").density_g_cm3
        moments = printed_moments(part.drawing.shape, shop.process, shop.printer.nozzle_mm)
        fine = mass_of(moments, density)
        assert part.mass_kg != fine.mass_kg or part.name.startswith("electronics"), "no corner was left out"
        assert part.mass_kg == pytest.approx(fine.mass_kg, rel=5e-4), part.name
        assert np.diag(part.mass.inertia_kg_m2) == pytest.approx(np.diag(fine.inertia_kg_m2), rel=1e-3), part.name
