"""assembly.html: one well-formed page that holds its pictures and asks for nothing else."""

import base64
import re
from xml.etree import ElementTree as ET

from support.built import built

from jumpcad.bundle.guide.markdown import write_guide, write_page

PNG = b"\x89PNG\r\n\x1a\n"


def page_of(text: str, name: str = "A", **others: str) -> ET.Element:
    """Return the page of a guide whose assembly.md, and perhaps other documents, are given."""
    pictures = {"pictures/step-1.png": PNG}
    guide = {f"{part}.md": words for part, words in others.items()} | {"assembly.md": text}
    return ET.fromstring(write_page(guide, name, pictures).replace("<!DOCTYPE html>", "", 1))


def test_the_page_is_well_formed_and_needs_no_other_file() -> None:
    guide = write_guide(built("kenan-2.0"), ["rest", "step-1", "step-13-springs"])
    files = {f"pictures/{name}.png": PNG for name in ("rest", "step-1", "step-13-springs")}
    files |= {f"{name}.svg": b"<svg/>" for name in ("wiring", "soldering", "leads", "order/spring-right-hand")}
    page = write_page(guide, "kenan-2.0", files)
    root = ET.fromstring(page.replace("<!DOCTYPE html>", "", 1))
    images = [image.get("src") or "" for image in root.iter("img")]
    assert len(images) == 7
    kinds = [source.partition(";")[0].removeprefix("data:image/") for source in images]
    assert sorted(kinds) == ["png"] * 3 + ["svg+xml"] * 4
    read = {kind: base64.b64decode(source.partition(",")[2]) for kind, source in zip(kinds, images, strict=True)}
    assert read == {"png": PNG, "svg+xml": b"<svg/>"}
    assert not re.search(r"(src|href)=\"(?!data:|#)", page)


def test_the_page_says_what_the_guide_says() -> None:
    root = page_of("# A <b>\n\nUse **care** & `wind`.\n\n| a | b |\n|---|--:|\n| 1 | 2 |\n\n> Hot.\n")
    assert root.findtext("body/section/h1") == "A <b>"
    (care,) = root.findall("body/section/p")
    assert ("".join(care.itertext()), care.findtext("strong"), care.findtext("code")) == (
        "Use care & wind.", "care", "wind",
    )  # fmt: skip
    assert [cell.text for cell in root.iter("td")] == ["1", "2"]
    assert root.findtext("body/section/blockquote/p") == "Hot."


def test_a_name_is_text_in_the_page_whatever_it_holds() -> None:
    name = "<b>frog</b> & <script>"
    root = page_of("# A\n", name)
    assert root.findtext("head/title") == f"{name}: assembly"


def test_each_hand_has_its_drawing_with_the_rate() -> None:
    from jumpcad.bundle.drawings.spring_sheet import spring_sheets

    sheets = dict(spring_sheets(built("kenan-2.0")))
    assert list(sheets) == ["order/spring-right-hand.svg", "order/spring-left-hand.svg"]
    for hand, sheet in zip(("right", "left"), sheets.values(), strict=True):
        ET.fromstring(sheet)
        assert "4.60 N·mm/° ±10 %" in sheet
        assert "order 2 and choose" in sheet
        assert "agree within 5 %" in sheet
        assert re.search(r"° \+4° / -10°; 180° is opposite directions", sheet)
        assert f"rises to the {hand}" in sheet


def test_lines_to_tick_have_a_box_and_a_step_has_its_pictures_beside_its_words() -> None:
    step = "## 1. Leg\n\n![step-1](pictures/step-1.png)\n\nDo it.\n\n- ☐ It *turns*.\n- free\n"
    guide = f"# A\n\n{step}\n## Tools\n\n- ☐ all\n"
    root = page_of(guide)
    items = ["".join(item.itertext()) for item in root.iter("li") if item.find("input") is not None]
    assert items == ["It turns.", "all"]
    *_, step, tools = root.iter("section")
    shown, told = step.findall("div")
    assert [len(list(one.iter("img"))) for one in (shown, told, tools)] == [1, 0, 0]
    assert "".join(told.itertext()).split() == ["Do", "it.", "It", "turns.", "free"]
    assert (step.findtext("h3"), tools.find("div")) == ("1. Leg", None)


def test_the_menu_leads_to_the_documents_and_each_document_to_its_sections() -> None:
    """By anchors that are there; a link from one document to another stays on the page."""
    text = "# A\n\n[first](order.md)\n\n## 1. Feet & eyes\n\n### not me\n\n## After *use*\n\ntext\n"
    root = page_of(text, order="# 1. Order\n\n## Buy\n")
    links = [(link.get("href"), "".join(link.itertext())) for link in root.iter("a")]
    assert [href for href, _ in links] == ["#order", "#assembly", "#order", "#buy", "#1-feet-eyes", "#after-use"]
    assert links[4][1] == "1. Feet & eyes"
    anchors = {element.get("id") for element in root.iter() if element.get("id")}
    assert anchors == {str(href)[1:] for href, _ in links}
    (lower,) = root.iter("h4")
    assert lower.text == "not me"
