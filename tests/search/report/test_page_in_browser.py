"""The page of a study in Debian's Chromium: a point shows its robot, by mouse and by keyboard; nothing is asked."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.browsers import PHONE, browser, needs_browser, require_quiet, webdriver
from support.bumps import REST, studied

from jumpcad.search.report.page import write_study_page
from jumpcad.search.space import Space

pytestmark = needs_browser
Keys = webdriver.Keys


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("study")
    with studied(folder / "front.db", Space.parse(fix=REST), "nsga2", 60) as store:
        (folder / "front.html").write_text(write_study_page(store, "front"), encoding="utf-8")
    return folder / "front.html"


@pytest.fixture(scope="module")
def driver() -> Iterator[Any]:
    made = browser("--window-size=1400,1200")
    yield made
    made.quit()


def shown(driver: Any) -> list[str]:
    """Return the headings of the designs that are seen."""
    sections = driver.find_elements("css selector", "section.design")
    return [one.find_element("tag name", "h3").text for one in sections if one.is_displayed()]


def points(driver: Any) -> list[Any]:
    found: list[Any] = driver.find_elements("css selector", "svg.chart a")
    return found


def test_a_click_on_a_point_shows_its_robot(driver: Any, page: Path) -> None:
    driver.get(page.as_uri())
    (first,) = shown(driver)
    last = points(driver)[-1]
    number = last.get_attribute("data-design")  # of a front, the highest score
    assert first.startswith(f"Design {number} (")
    driver.find_element("css selector", 'td a[data-design="1"]').click()
    assert shown(driver)[0].startswith("Design 1 (")
    box = driver.find_element("id", "robots")
    before = box.screenshot_as_png
    last.find_element("css selector", "circle:last-child").click()
    (now,) = shown(driver)
    assert now.startswith(f"Design {number} (")
    assert box.screenshot_as_png != before
    drawn = driver.find_element("css selector", f'[data-of="{number}"] svg.side')
    assert drawn.size["width"] > 200
    assert drawn.size["height"] > 50
    assert last.get_attribute("aria-current") == "true"
    driver.find_element("css selector", 'td a[data-design="2"]').click()
    assert shown(driver)[0].startswith("Design 2 (")


def test_the_keyboard_goes_from_point_to_point(driver: Any, page: Path) -> None:
    driver.get(page.as_uri())
    for _ in range(20):
        driver.switch_to.active_element.send_keys(Keys.TAB)
        if driver.switch_to.active_element.get_attribute("data-design"):
            break
    driver.switch_to.active_element.send_keys(Keys.ARROW_RIGHT)
    driver.switch_to.active_element.send_keys(Keys.ARROW_RIGHT)
    assert shown(driver)[0].startswith("Design 3 (")
    driver.switch_to.active_element.send_keys(Keys.ARROW_LEFT)
    assert shown(driver)[0].startswith("Design 2 (")


def test_nothing_is_asked_of_the_network_and_no_error_is_logged(driver: Any, page: Path) -> None:
    driver.get(page.as_uri())
    points(driver)[-1].find_element("css selector", "circle:last-child").click()
    require_quiet(driver)


def test_points_on_each_other_are_shown_by_one_click_after_the_other(driver: Any, page: Path) -> None:
    """So does `Next`; the pictures below mark what is chosen, and nothing else."""
    driver.get(page.as_uri())
    driver.execute_script(
        "for (const one of arguments[1].children) for (const at of ['cx', 'cy'])"
        " one.setAttribute(at, arguments[0].lastElementChild.getAttribute(at))",
        *points(driver)[:2],
    )
    for number in (1, 2, 1, 2):
        points(driver)[1].find_element("css selector", "circle:last-child").click()
        assert shown(driver)[0].startswith(f"Design {number} (")
    driver.find_element("id", "after").click()
    assert shown(driver)[0].startswith("Design 3 (")
    marked = driver.execute_script(
        "return [...document.querySelectorAll('[data-of]')].filter(one => getComputedStyle(one).display != 'none')"
        ".map(one => one.dataset.of)"
    )
    assert marked == ["3"] * 5  # in the chart, its side view, both slices, and its line


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_and_plots_stand_out_from_the_paper(driver: Any, page: Path, scheme: str) -> None:
    driver.execute_cdp_cmd(
        "Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]}
    )
    driver.get(page.as_uri())
    read = "const s = getComputedStyle(document.querySelector(arguments[0])); return s[arguments[1]]"
    paper = driver.execute_script(read, "body", "backgroundColor")
    for thing, colour in (("svg.chart text", "fill"), ("svg.side .rest path", "stroke"), ("h1", "color")):
        assert contrast(driver.execute_script(read, thing, colour), paper) > 4.5, thing
    for line in ("best", "phase0", "age0", "age4", "top", "bundle3"):  # as their legends show them
        stroke = driver.execute_script(read, f"svg.drawn:not(.mark) .{line}", "stroke")
        assert driver.execute_script(read, f".legend .{line}", "stroke") == stroke
        assert contrast(stroke, paper) > 3.0, line


def contrast(one: str, other: str) -> float:
    """Return the contrast ratio of two colours, `rgb(r, g, b)` (WCAG 2.1)."""
    light, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def luminance(colour: str) -> float:
    parts = [int(part) / 255.0 for part in colour.partition("(")[2].rstrip(")").split(",")[:3]]
    linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_it_fits_a_phone(driver: Any, page: Path) -> None:
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", PHONE)
    driver.get(page.as_uri())
    assert driver.execute_script("return document.documentElement.scrollWidth") <= 390
    sizes = driver.execute_script(
        "return [...document.querySelectorAll('svg.drawn:not(.mark) text, svg.chart text')].map(one =>"
        " parseFloat(getComputedStyle(one).fontSize) * one.getScreenCTM().a)"
    )
    assert min(abs(size) for size in sizes) > 10.0  # pixels
    assert driver.execute_script(
        "return [...document.querySelectorAll('.wide')].every(one => one.scrollWidth <= one.clientWidth)"
    )
    last = points(driver)[-1]
    last.find_element("css selector", "circle:last-child").click()
    assert shown(driver)[0].startswith(f"Design {last.get_attribute('data-design')} (")
    driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
