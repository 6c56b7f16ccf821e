"""firmware/remote.html in Debian's Chromium: what its buttons write to a pretended radio, and what it shows."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.browsers import PHONE, browser, needs_browser, require_quiet, wait

from jumpcad.files.templates import fill

pytestmark = needs_browser
RADIO = """
window.written = []; window.asked = null; let busy = false;
const to = {writeValueWithResponse: async (bytes) => {
  if (busy) throw new Error("GATT operation already in progress");
  busy = true; await new Promise((done) => setTimeout(done, 20)); busy = false;
  window.written.push(new TextDecoder().decode(bytes));
}};
const from = new EventTarget(); from.startNotifications = async () => { window.listens = true; };
window.answer = (text) => {
  from.value = new DataView(new TextEncoder().encode(text).buffer);
  from.dispatchEvent(new Event("characteristicvaluechanged"));
};
const device = window.device = new EventTarget();
const service = {getCharacteristic: async (uuid) => ({2: to, 3: from})[uuid[7]]};
device.gatt = {connect: async () => ({getPrimaryService: async (uuid) => { window.service = uuid; return service; }})};
Object.defineProperty(navigator, "bluetooth", {configurable: true, value: {
  requestDevice: async (options) => { window.asked = options; return device; }}});
"""
NAME = "best-steered"


@pytest.fixture(scope="module")
def driver() -> Iterator[Any]:
    made = browser()
    yield made
    made.quit()


def opened(driver: Any, folder: Path, radio: str, name: str = NAME) -> None:
    """Open the page of a robot on a telephone's screen, with something in place of the browser's radio."""
    page = folder / "remote.html"
    page.write_text(fill("firmware/remote.html.j2", {"name": name}), encoding="utf-8")
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", PHONE)
    script = driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": radio})
    driver.get(page.as_uri())
    driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", script)


def test_buttons_write_the_firmwares_commands_and_answers_are_shown(driver: Any, tmp_path: Path) -> None:
    """Answers come in packets of 20 bytes; a browser refuses a write before the last one is done."""
    opened(driver, tmp_path, RADIO)
    keys = {key.text: key for key in driver.find_elements("css selector", "#keys button")}
    assert not any(key.is_enabled() for key in keys.values())
    driver.find_element("id", "link").click()
    wait(driver, lambda _: driver.find_element("id", "state").text == "connected")
    asked, service, listens = driver.execute_script("return [window.asked, window.service, window.listens]")
    assert asked["filters"] == [{"namePrefix": NAME}]
    assert asked["optionalServices"] == [service] == ["6e400001-b5a3-f393-e0a9-e50e24dcca9e"]
    assert listens
    for words in ("wind", "← left", "right →", "jump", "go 3", "STOP"):
        keys[words].click()
    wait(driver, lambda _: len(driver.execute_script("return window.written")) == 7)
    lines = ["state", "wind", "turn 30", "turn -30", "jump", "go 3", "stop"]
    assert driver.execute_script("return window.written") == [f"{line}\n" for line in lines]
    for packet in ("ready: keep away fro", "m the leg; 0 jumps\n", "turned\nrea"):
        driver.execute_script("window.answer(arguments[0])", packet)
    assert driver.find_element("id", "answer").text == "ready: keep away from the leg; 0 jumps\nturned"
    assert driver.execute_script("return document.documentElement.scrollWidth") <= PHONE["width"]
    driver.execute_script("window.device.dispatchEvent(new Event('gattserverdisconnected'))")
    assert "lost" in driver.find_element("id", "state").text
    assert not keys["STOP"].is_enabled()
    assert driver.find_element("id", "link").is_enabled()
    require_quiet(driver)


def test_a_long_name_is_sought_by_what_is_advertised_of_it(driver: Any, tmp_path: Path) -> None:
    """26 bytes: of 14 letters of two bytes 13."""
    opened(driver, tmp_path, RADIO, "ü" * 14)
    driver.find_element("id", "link").click()
    wait(driver, lambda _: driver.execute_script("return window.asked"))
    assert driver.execute_script("return window.asked.filters") == [{"namePrefix": "ü" * 13}]


def test_a_browser_without_bluetooth_and_a_refusal_are_told(driver: Any, tmp_path: Path) -> None:
    opened(driver, tmp_path, "Object.defineProperty(navigator, 'bluetooth', {value: undefined})")
    assert "no Web Bluetooth" in driver.find_element("id", "state").text
    assert not driver.find_element("id", "link").is_enabled()
    refusal = "requestDevice: async () => { throw new Error('User cancelled'); }"
    opened(driver, tmp_path, f"Object.defineProperty(navigator, 'bluetooth', {{value: {{{refusal}}}}})")
    driver.find_element("id", "link").click()
    wait(driver, lambda _: "User cancelled" in driver.find_element("id", "state").text)
    assert driver.find_element("id", "link").is_enabled()
