"""The drawing of the eight parameters: its angle is the design's, and no label lies across a link."""

import cmath
import math
import xml.etree.ElementTree as ET

import pytest

from jumpcad.design import load_design
from jumpcad.files import template_names
from jumpcad.scene.parameters import parameter_drawing

SVG = "{http://www.w3.org/2000/svg}"
LINK_PX = 3.0
"""Least width of a link's line."""


def panels(name: str) -> list[ET.Element]:
    return ET.fromstring(parameter_drawing(load_design(name))).findall(f"{SVG}g")


def links(panel: ET.Element) -> list[tuple[complex, complex]]:
    lines = [one.attrib for one in panel.findall(f"{SVG}line") if float(one.get("stroke-width", "0")) >= LINK_PX]
    return [(complex(float(at["x1"]), float(at["y1"])), complex(float(at["x2"]), float(at["y2"]))) for at in lines]


@pytest.mark.parametrize("name", template_names("robots"))
def test_the_angle_that_is_drawn_is_the_rest_angle(name: str) -> None:
    """Between the front link and the body's line beyond it: at rest both legs are parallel."""
    _, _, (front, eye), (back, ankle), body = links(panels(name)[0])
    assert body == (back, front)
    below = cmath.phase((eye - front) / (front - back)), cmath.phase((ankle - back) / (front - back))
    assert [math.degrees(angle) for angle in below] == pytest.approx([load_design(name).rest_angle_deg] * 2, abs=0.1)


@pytest.mark.parametrize("name", template_names("robots"))
def test_every_parameter_has_its_value_below_its_name(name: str) -> None:
    """Lengths in mm, ratios with what they give, angles in degrees; the loaded angle is a share of rest and tilt."""
    design = load_design(name)
    told = {}
    for panel in panels(name):
        texts = [text.text or "" for text in panel.findall(f"{SVG}text")]
        told |= dict(zip(texts[::2], texts[1::2], strict=True))
    tilt = math.asin((design.c_coef - 1.0) * math.sin(math.radians(design.rest_angle_deg)) / design.d_coef)
    loaded = design.compression_ratio * (design.rest_angle_deg + math.degrees(tilt))
    main = design.carrying_link_mm
    share, _, degrees = told.pop("compression_ratio").partition(" of the way to a flat leg: ")
    assert share == f"{design.compression_ratio:.3g}"
    assert float(degrees.removesuffix("°")) == pytest.approx(loaded, abs=0.0501)
    assert told == {
        "carrying_link_mm": f"{main:g} mm",
        "c_coef": f"× main leg = {design.c_coef * main:.1f} mm",
        "d_coef": f"× main leg = {design.d_coef * main:.1f} mm",
        "rest_angle_deg": f"{design.rest_angle_deg:g}°",
        "stiffness_nmm_per_deg": f"{design.stiffness_nmm_per_deg:g} N·mm/°, both springs",
        "e_coef": f"× main leg = {design.e_coef * main:.1f} mm each",
        "ground_link_angle_deg": f"{design.ground_link_angle_deg:g}°",
    }


@pytest.mark.parametrize("name", template_names("robots"))
def test_loaded_springs_have_turned_the_leg_away_from_where_it_was(name: str) -> None:
    """A dashed line is the leg at rest, as long as the leg, from the same pivot and the loaded angle apart."""
    design, panel = load_design(name), panels(name)[1]
    (ghost,) = (line.attrib for line in panel.findall(f"{SVG}line") if "stroke-dasharray" in line.attrib)
    _, _, _, (back, ankle), (_, front) = links(panel)
    before = complex(float(ghost["x2"]), float(ghost["y2"])) - back
    assert complex(float(ghost["x1"]), float(ghost["y1"])) == back
    assert abs(before) == pytest.approx(abs(ankle - back), rel=5e-3)
    below = [math.degrees(cmath.phase(leg / (front - back))) for leg in (before, ankle - back)]
    assert below[0] == pytest.approx(design.rest_angle_deg, abs=0.2)
    assert below[0] - below[1] == pytest.approx(math.degrees(design.compression_rad), abs=0.3)
