"""assembly.html: one well-formed page that holds its pictures and asks for nothing else."""

import re
from xml.etree import ElementTree as ET

from support.built import built

from jumpcad.bundle.guide import write_guide
from jumpcad.bundle.guide_page import write_page

PNG = b"\x89PNG\r\n\x1a\n"


def test_the_page_is_well_formed_and_needs_no_other_file() -> None:
    guide = write_guide(built("kenan-2.0"), ["step-1", "step-13-springs"])
    files = {"pictures/step-1.png": PNG, "pictures/step-13-springs.png": PNG, "wiring.svg": b"<svg/>"}
    files["soldering.svg"] = b"<svg/>"
    page = write_page(guide, "kenan-2.0", files)
    root = ET.fromstring(page.replace("<!DOCTYPE html>", "", 1))
    images = [image.get("src") or "" for image in root.iter("img")]
    assert len(images) == 4
    assert all(source.startswith("data:image/") for source in images)
    assert not re.search(r"(src|href)=\"(?!data:|#)", page)


def test_the_page_says_what_the_guide_says() -> None:
    page = write_page("# A <b>\n\nUse **care** & `wind`.\n\n| a | b |\n|---|--:|\n| 1 | 2 |\n\n> Hot.\n", "A", {})
    root = ET.fromstring(page.replace("<!DOCTYPE html>", "", 1))
    assert root.findtext("body/h1") == "A <b>"
    (care,) = root.findall("body/p")
    assert ("".join(care.itertext()), care.findtext("strong"), care.findtext("code")) == (
        "Use care & wind.", "care", "wind",
    )  # fmt: skip
    assert [cell.text for cell in root.iter("td")] == ["1", "2"]
    assert root.findtext("body/blockquote/p") == "Hot."


def test_every_number_in_the_texts_is_filled_in() -> None:
    """No name in braces is left, and the kitchen scale shows rate times angle over lever and gravity."""
    robot = built("kenan-2.0")
    guide = write_guide(robot)
    assert not re.search(r"\{\w+\}", guide)
    row = re.search(r"\| 20° \| (\d+) g \|", guide)
    lever = re.search(r"it touches ([\d.]+) mm along the arm", guide)
    assert row is not None
    assert lever is not None
    grams = robot.design.stiffness_nmm_per_deg / 2.0 * 20.0 / float(lever[1]) / 9.81 * 1000.0
    assert abs(float(row[1]) - grams) < 0.01 * grams


def test_each_hand_has_its_drawing_with_the_rate() -> None:
    from jumpcad.bundle.spring_sheet import spring_sheets

    sheets = dict(spring_sheets(built("kenan-2.0")))
    assert list(sheets) == ["order/spring-right-hand.svg", "order/spring-left-hand.svg"]
    for hand, sheet in zip(("right", "left"), sheets.values(), strict=True):
        ET.fromstring(sheet)
        assert "4.60 N·mm/° ±10 %" in sheet
        assert f"rises to the {hand}" in sheet
