"""Debian's Chromium without a screen, for tests of pages."""

import shutil
from collections.abc import Callable
from typing import Any

import pytest

from support import needs

webdriver = pytest.importorskip("selenium.webdriver", reason="selenium is not installed")
from selenium.webdriver.support.ui import WebDriverWait  # noqa: E402

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
needs_browser = needs.without("chromedriver" if CHROMIUM else "chromium")
WAIT_S = 60.0
"""A browser that does not answer within this time has failed."""
PHONE = {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True}


def browser(*arguments: str) -> Any:
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for argument in (
        "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
        "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", *arguments,
    ):  # fmt: skip
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options, service=webdriver.ChromeService(DRIVER))


def wait(driver: Any, condition: Callable[[Any], object]) -> None:
    WebDriverWait(driver, WAIT_S).until(condition)


def require_quiet(driver: Any, own: str = "file:") -> None:
    """Fail if a page asked the network for anything but an address of its `own`, or logged an error."""
    asked = [
        entry["message"] for entry in driver.get_log("performance") if "Network.requestWillBeSent" in entry["message"]
    ]
    assert [message for message in asked if '"url":"http' in message and f'"url":"{own}' not in message] == []
    assert [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"] == []
