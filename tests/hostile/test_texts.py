"""Free texts and names of own parts, as odd as they may be, in every file that a robot's bundle has."""

import ast
import json
import re
from pathlib import Path

import pytest
from support.sandbox import Sandbox

TEXT = (
    r"""<script>alert(1)</script> & "q" 'a' \"\"\" \ \n {WIND_S} {0} | ` --> ]]> ](javascript:x) [/x] %s ${HOME} =1"""
)
NAME = "x.,()+- WIND_S é機"
LIKE = {
    "motors": "n20-298-mp", "bearings": "623", "batteries": "lipo-1s-300", "boards": "xiao-esp32c3", "pads": "rubber-2",
}  # fmt: skip
TEXTS = {"motors": ("article",), "batteries": ("description", "plug"), "boards": ("description",),
         "pads": ("description",), "bearings": ()}  # fmt: skip


def workshop() -> str:
    """Return a workshop whose texts are all `TEXT` and whose names are all `NAME`."""
    text, name, motor = json.dumps(TEXT), json.dumps(NAME), json.dumps(f"gear motor {NAME}")
    lines = [
        f"[printer]\nname = {text}\nsource = {text}\nbed_mm = [250, 210, 220]\nnozzle_mm = 0.4",
        f"[materials.{name}]\ndensity_g_cm3 = 1.2\nstrength_in_plane_mpa = 45.0\nstrength_interlayer_mpa = 30.0",
        f"modulus_mpa = 2000.0\nsource = {text}\n[roles]\nlinks = {name}\nbody = {name}\ngears = {name}",
        f"[bought]\nmotors = [{name}]\nleg_bearing = {name}\nroller = {name}\nbattery = {name}\ncontroller = {name}",
        f"[body]\nstop_pad = {name}\n[ground]\nsurface = {text}\npad = {name}\n[prices_eur]\n{motor} = 0.05",
    ]
    for kind, like in LIKE.items():
        lines += [f'[{kind}.{name}]\nlike = "{like}"\nsource = {text}', *(f"{key} = {text}" for key in TEXTS[kind])]
    return "\n".join(lines) + "\n"


@pytest.fixture
def built(sandbox: Sandbox) -> Path:
    sandbox.write("x.toml", workshop())
    words = ("build", "kenan-2.0", "--workshop", "x.toml", "-o", "robot", "--no-pictures", "--json")
    sandbox.run(*words, exits=(0,), writes=["robot"])
    return sandbox.work / "robot"


def test_odd_texts_stay_texts_in_every_file(built: Path) -> None:
    """Files are read as what they are by the sandbox; here, that texts are neither code nor HTML nor cells."""
    numbers = ast.parse((built / "firmware" / "robot.py").read_text(encoding="utf-8")).body
    assert isinstance(numbers[0], ast.Expr)
    assert all(isinstance(line, ast.Assign) and isinstance(line.value, ast.Constant) for line in numbers[1:])
    for file in built.rglob("*.md"):
        text = file.read_text(encoding="utf-8")
        assert not re.search(r"(?<!\\)<\w", text), file
        columns = [len(re.findall(r"(?<!\\)\|", line)) for line in text.splitlines() if "script" in line]
        assert set(columns) <= {0, 4, 5}, file
    assert "{WIND_S}" in (built / "firmware" / "README.md").read_text(encoding="utf-8")
