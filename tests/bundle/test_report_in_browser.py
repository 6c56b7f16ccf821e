"""report.html in Debian's Chromium without a screen: it shows, plays and answers, and asks the network for nothing."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from support.browsers import PHONE, browser, needs_browser, require_quiet, wait, webdriver

from jumpcad.notebook import ShownPage

pytestmark = needs_browser
Keys = webdriver.Keys
THREE_D = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1400,1200")


def opened(driver: Any, page: Path) -> Any:
    """Open a page and return the viewer's box, once it is ready or has failed."""
    driver.get(page.as_uri())
    box = driver.find_element("id", "viewer")
    wait(driver, lambda _: box.get_attribute("data-state"))
    return box


def put(driver: Any, slider: str, value: float) -> None:
    driver.execute_script(
        "const e = document.getElementById(arguments[0]); e.value = arguments[1]; e.dispatchEvent(new Event('input'))",
        slider,
        value,
    )


def seen(box: Any, path: Path) -> np.ndarray:
    path.write_bytes(box.screenshot_as_png)
    return np.asarray(Image.open(path).convert("RGB"), dtype=int)


@pytest.fixture(scope="module")
def page(bundle_of: Callable[..., Path]) -> Path:
    return bundle_of("kenan-2.0", pictures=True) / "report.html"


@pytest.fixture(scope="module")
def driver() -> Iterator[Any]:
    made = browser(*THREE_D)
    yield made
    made.quit()


@pytest.fixture
def box(driver: Any, page: Path) -> Any:
    """Return the viewer's box of the page, which is opened again only if another one was: that takes a second."""
    if driver.current_url == page.as_uri():
        return driver.find_element("id", "viewer")
    return opened(driver, page)


def test_play_scrub_apart_assembly_and_toggles_change_what_is_seen(driver: Any, box: Any, tmp_path: Path) -> None:
    assert box.get_attribute("data-state") == "ready"
    shot = tmp_path / "shot.png"
    rest = seen(box, shot)
    assert len(np.unique(rest.reshape(-1, 3), axis=0)) > 500  # not blank
    parts = int(box.get_attribute("data-parts"))
    changes = {"scrub": 6.5, "explode": 1.0, "step": 2}
    for slider, value in changes.items():
        put(driver, slider, value)
        assert np.abs(seen(box, shot) - rest).mean() > 0.2, slider
        put(driver, slider, {"scrub": 0.0, "explode": 0.0, "step": 99}[slider])
    assert np.abs(seen(box, shot) - rest).mean() < 0.05
    put(driver, "step", 1)
    assert 0 < int(box.get_attribute("data-parts")) < parts
    put(driver, "step", 99)
    toggle = driver.find_element("id", "show-plates")
    toggle.send_keys(Keys.SPACE)
    assert int(box.get_attribute("data-parts")) == parts - 2  # the left and the right one
    assert np.abs(seen(box, shot) - rest).mean() > 0.2
    toggle.send_keys(Keys.SPACE)
    before = float(box.get_attribute("data-shown"))
    driver.find_element("id", "play").click()
    wait(driver, lambda _: float(box.get_attribute("data-shown")) > before)
    driver.find_element("id", "play").click()
    put(driver, "scrub", 0.0)


def test_the_keyboard_turns_moves_zooms_and_plays(driver: Any, box: Any, tmp_path: Path) -> None:
    """Each key moves the camera, and 0 brings it back; the canvas says its keys, and shows that it has the focus."""
    shot = tmp_path / "shot.png"
    driver.execute_script("document.getElementById('home').focus()")
    without_focus = seen(box, shot)
    driver.execute_script("document.querySelector('nav a:last-of-type').focus()")
    driver.switch_to.active_element.send_keys(Keys.TAB)
    canvas = driver.switch_to.active_element
    assert canvas.tag_name == "canvas"
    assert "Arrow keys turn" in canvas.get_attribute("aria-label")
    first = seen(box, shot)
    assert np.count_nonzero(np.abs(first - without_focus).sum(axis=2) > 60) > 1000  # the ring around it
    home = box.get_attribute("data-camera")
    for key in (Keys.ARROW_LEFT, Keys.ARROW_UP, "+", "-", Keys.SHIFT + Keys.ARROW_LEFT + Keys.SHIFT):
        canvas.send_keys(key)
        assert box.get_attribute("data-camera") != home, key
        canvas.send_keys("0")
        assert box.get_attribute("data-camera") == home, key
    canvas.send_keys(Keys.ARROW_LEFT)
    assert np.abs(seen(box, shot) - first).mean() > 0.2
    canvas.send_keys(".")
    assert box.get_attribute("data-shown") == "0.020"
    # Without new pictures the motion cannot come to its end between two keys, after which space starts it again.
    driver.execute_script("window.drawn = requestAnimationFrame; window.requestAnimationFrame = () => 0")
    canvas.send_keys(",", " ")
    assert box.get_attribute("data-playing") == "true"
    held = {"type": "keyDown", "key": " ", "code": "Space", "text": " ", "windowsVirtualKeyCode": 32}
    driver.execute_cdp_cmd("Input.dispatchKeyEvent", held | {"autoRepeat": True})
    assert box.get_attribute("data-playing") == "true"  # a key held down does not play and pause in turn
    canvas.send_keys(" ")
    assert box.get_attribute("data-playing") == "false"
    driver.execute_script("window.requestAnimationFrame = window.drawn")
    choose = driver.find_element("id", "choose")
    choose.send_keys("cam gear")
    assert box.get_attribute("data-part") == "cam_gear"
    link = driver.find_element("css selector", "#part a")
    assert link.get_attribute("href").endswith("stl/cam_gear.stl")
    put(driver, "scrub", 0.0)


def test_a_click_on_a_part_tells_what_it_is(driver: Any, box: Any) -> None:
    driver.execute_script("arguments[0].scrollIntoView()", box)
    canvas = driver.find_element("css selector", "#viewer canvas")
    height = canvas.size["height"]
    for up in range(-height // 4, height // 4, 12):  # somewhere on the middle line stands the robot
        webdriver.ActionChains(driver).move_to_element_with_offset(canvas, 0, up).click().perform()
        if box.get_attribute("data-part"):
            break
    assert box.get_attribute("data-part")
    assert " g, " in driver.find_element("id", "part").text


@pytest.mark.usefixtures("box")
def test_nothing_is_asked_of_the_network_and_no_error_is_logged(driver: Any) -> None:
    require_quiet(driver)


def legs(box: Any, path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return the places of the pixels of the robot's orange legs, as shares of the picture's width and height."""
    red, _, blue = np.moveaxis(seen(box, path), -1, 0)
    down, right = np.nonzero(red - blue > 150)  # the path has 118
    assert len(down) > 300
    return right / red.shape[1], down / red.shape[0]


def test_the_camera_stands_still_and_shows_the_whole_jump(driver: Any, box: Any, tmp_path: Path) -> None:
    """The robot crosses the picture and stays inside; its shadow is palest at the top, and as at first on landing."""
    driver.execute_script("arguments[0].scrollIntoView()", box)
    driver.find_element("id", "home").click()
    end = float(driver.find_element("id", "scrub").get_attribute("max"))
    cameras, shadows, middles = set(), [], []
    for moment in (0.0, 0.85 * end, end):
        put(driver, "scrub", moment)
        right, down = legs(box, tmp_path / "shot.png")
        assert min(right.min(), down.min()) > 0.01
        assert max(right.max(), down.max()) < 0.99
        middles.append((right.min() + right.max()) / 2)
        cameras.add(box.get_attribute("data-camera"))
        shadows.append(float(box.get_attribute("data-shadow")))
    assert len(cameras) == 1
    assert middles[2] - middles[0] > 0.2
    assert middles[0] < middles[1] < middles[2]
    assert shadows[1] < shadows[0] == shadows[2]
    put(driver, "scrub", 0.0)


def test_it_fits_a_phone(page: Path) -> None:
    made = browser(*THREE_D)
    try:
        made.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", PHONE)
        opened(made, page)
        assert made.execute_script("return document.documentElement.scrollWidth") <= 390
    finally:
        made.quit()


def test_without_webgl_a_sentence_stands_in_its_place(page: Path) -> None:
    made = browser("--disable-3d-apis", "--window-size=1400,1200")
    try:
        box = opened(made, page)
        assert box.get_attribute("data-state") == "failed"
        assert "cannot be shown in 3-D" in made.find_element("id", "viewer-message").text
        assert not made.find_element("id", "viewer-controls").is_displayed()
    finally:
        made.quit()


def test_in_the_frame_of_a_notebook_it_plays_too(driver: Any, page: Path, tmp_path: Path) -> None:
    cell = tmp_path / "cell.html"
    frame = ShownPage(page.read_text(encoding="utf-8"))._repr_html_()
    cell.write_text(f"<!DOCTYPE html><html><body>{frame}</body></html>", encoding="utf-8")
    driver.get(cell.as_uri())
    driver.switch_to.frame(0)
    try:
        box = driver.find_element("id", "viewer")
        wait(driver, lambda _: box.get_attribute("data-state"))
        assert box.get_attribute("data-state") == "ready"
    finally:
        driver.switch_to.default_content()
