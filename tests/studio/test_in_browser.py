"""The studio in Debian's Chromium without a screen: what is typed moves what is seen; nothing leaves the machine."""

import io
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from scipy.ndimage import uniform_filter
from support import needs
from support.browsers import PHONE, browser, needs_browser, require_quiet, wait, webdriver

viser = needs.package("viser")

from jumpcad.studio import Points, Studio  # noqa: E402
from jumpcad.studio.server import OwnServer  # noqa: E402

pytestmark = needs_browser
KEYS = webdriver.common.keys.Keys
LEFT, TOP = 320, 20
"""Upper left corner of what is looked at (pixels)."""
CHANGED = 2.0
"""Mean difference of brightness of what is seen, out of 255: more than none, less than a robot that moved."""


@pytest.fixture(scope="module")
def studio(study: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    server = OwnServer(0)
    server.scene.configure_environment_map(None)  # with it, and with shadows, software rendering takes 20 s
    server.scene.configure_default_lights(cast_shadow=False)
    points = Points(study)
    made = Studio(points.trial(3).design, "four", ["of the study"], server, tmp_path_factory.mktemp("saved"), points, 3)
    made.start()
    yield made
    made.end()
    server.stop()


@pytest.fixture(scope="module")
def driver(studio: Studio) -> Iterator[Any]:
    made = browser("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=900,500")
    made.get(address(studio))
    wait(made, lambda _: "printed robot" in words(made))
    yield made
    made.quit()


def address(studio: Studio) -> str:
    return str(studio.server.address)


def words(driver: Any) -> str:
    return str(driver.find_element("tag name", "body").text)


def seen(driver: Any) -> np.ndarray:
    """Return what is seen of the scene between the browser's note and the panel (grey, 0 to 255)."""
    picture = Image.open(io.BytesIO(driver.get_screenshot_as_png())).convert("L")
    return np.asarray(picture.crop((LEFT, TOP, 490, 340)), dtype=float)


def type_into(driver: Any, label: str, text: str) -> None:
    """Type into the number of an input of the panel, by the keyboard alone."""
    (field,) = driver.find_elements(
        "xpath", f"//label[.='{label}']/ancestor::*[.//input[not(@type='hidden')]][1]//input[not(@type='hidden')]"
    )
    field.send_keys(KEYS.CONTROL, "a")
    field.send_keys(text, KEYS.ENTER)


def changed(driver: Any, before: np.ndarray) -> Callable[[Any], bool]:
    return lambda _: bool(np.abs(seen(driver) - before).mean() > CHANGED)


def test_the_time_slider_moves_the_robot(driver: Any, studio: Studio) -> None:
    wait(driver, lambda _: len(np.unique(seen(driver))) > 60)  # not blank
    rest = seen(driver)
    type_into(driver, "motion, s", "7.0")
    wait(driver, changed(driver, rest))
    wait(driver, lambda _: "flight, " in words(driver))
    flying = seen(driver)
    (button,) = driver.find_elements("xpath", "//button[.='Play']")
    button.send_keys(KEYS.ENTER)
    wait(driver, lambda _: studio.player.time.value == studio.player.time.max)
    wait(driver, changed(driver, flying))


def test_a_click_on_a_part_says_what_it_is(driver: Any) -> None:
    """The darkest place of the picture is on the robot."""
    wait(driver, lambda _: seen(driver).min() < 100.0)
    canvas, dark = driver.find_element("tag name", "canvas"), uniform_filter(seen(driver), 7)
    down, right = np.unravel_index(np.argmin(dark), dark.shape)
    size = canvas.size
    x, y = LEFT + int(right) - size["width"] // 2, TOP + int(down) - size["height"] // 2
    webdriver.ActionChains(driver).move_to_element_with_offset(canvas, x, y).click().perform()
    wait(driver, lambda _: " g, " in words(driver))


def test_a_chosen_trial_is_another_robot(driver: Any, studio: Studio) -> None:
    before = seen(driver)
    type_into(driver, "trial", "1")
    wait(driver, lambda _: "trial 1 of 4" in words(driver) and "at rest" in words(driver))
    wait(driver, changed(driver, before))
    assert studio.design == studio.points.trial(1).design
    type_into(driver, "trial", "2")
    wait(driver, lambda _: "cannot be built" in words(driver))


def test_it_fits_a_phone(driver: Any) -> None:
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", PHONE)
    wait(driver, lambda _: driver.execute_script("return window.innerWidth") == PHONE["width"])
    wait(driver, lambda _: "carrying_link_mm" in words(driver))
    assert driver.execute_script("return document.documentElement.scrollWidth") <= PHONE["width"]


def test_nothing_leaves_the_machine_and_no_error_is_logged(driver: Any, studio: Studio) -> None:
    require_quiet(driver, own=address(studio))


def test_without_webgl_a_sentence_stands_there(studio: Studio) -> None:
    made = browser("--disable-3d-apis", "--window-size=900,500")
    try:
        made.get(address(studio))
        wait(made, lambda _: "WebGL is unavailable" in words(made))
    finally:
        made.quit()
