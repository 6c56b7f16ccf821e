"""Designs, workshops, settings and coupon readings: values, keys, names and files that nobody foresaw."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from support.each import each
from support.mutations import DIGITS, DOCUMENTS, NESTED, Spoil, accidents
from support.sandbox import ANY, Sandbox, lay_odd

from jumpcad.design import PARAMETERS, load_design
from jumpcad.files import to_toml
from jumpcad.workshop import load_workshop

DESIGN = load_design("kenan-2.0").to_toml()
VALUES = {
    "nan": "nan",
    "infinity": "-inf",
    "minus": "-1",
    "zero": "0",
    "overflow": "1e999",
    "digits": DIGITS,
    "text": '"long"',
    "true": "true",
    "list": "[1.0]",
    "table": "{ a = 1 }",
    "date": "1979-05-27",
    "deep": "[" * NESTED + "]" * NESTED,
    "escape": '"\\u001b[31m\\n[/x]"',
    "nothing": "",
}
READINGS = "[gauge.PETG]\naxle_press_mm = 0.1\naxle_sliding_mm = 0.2\npegs_mm = [4.0, 6.0, 8.0]\n[gears]\n"
KEYS = {
    "workshop": ["[fits]\npress_mm", "[fits]\nbridge_mm", "[process]\nperimeters", "[process]\ninfill", "printer",
                 "[printer]\nbed_mm", "[printer]\nname", "[roles]\nlinks", "roles", "[materials]\nPETG", "base",
                 "[materials.PETG]\ndensity_g_cm3", "[bought]\nmotors", "[bought]\nbattery", "[bought]\naxle_mm",
                 "[safety]\njumps", "[mass]\nmodel", "[mass.weighed_g]\nfoot", "[prices_eur]\nscrew", "fits",
                 "motors", "[motors]\na", "[motors.a]\nlike", "[bearings.a]\nbore_mm", "[boards.a]\nsource"],
    "settings": ["dt_s", "solver_iterations", "gravity_m_s2", "ground_friction", "flight", "max_time_s",
                 "trajectory_rate_hz", "trajectory", "drag_area_m2"],
    "readings": ["[gauge.PETG]\naxle_press_mm", "[gauge.PETG]\npegs_mm", "[gauge]\nPETG", "gauge", "gears",
                 "[gears]\nturns_freely_mm"],
}  # fmt: skip
NEVER = ("nan", "infinity", "overflow", "deep", "nothing", "date")
"""Values that are right under no key."""


def ask(sandbox: Sandbox, kind: str, exits: tuple[int, ...] = ANY) -> None:
    """Give the file `x.toml` to the cheapest command that reads all of it."""
    commands = {
        "design": ("simulate", "x.toml", "--capsule"),
        "workshop": ("coupon", "--measured", "readings.toml", "--workshop", "x.toml", "-o", "w.toml"),
        "settings": ("simulate", "kenan-2.0", "--capsule", "--settings", "x.toml"),
        "readings": ("coupon", "--measured", "x.toml", "-o", "w.toml"),
    }
    if kind == "workshop":
        sandbox.write("readings.toml", READINGS)
    sandbox.run(*commands[kind], "--json", exits=exits, writes=["w.toml"])


@each("number", range(48))
def test_a_strange_number_in_a_design_is_refused(sandbox: Sandbox, number: int) -> None:
    key, value = PARAMETERS[number % 8], list(VALUES)[(number // 8 + number) % len(VALUES)]
    sandbox.case = f"{key} = {value}"
    lines = [f"{key} = {VALUES[value]}" if line.startswith(key) else line for line in DESIGN.splitlines()]
    sandbox.write("x.toml", "\n".join(lines))
    ask(sandbox, "design", (2,))


@each("value", VALUES)
@each(("kind", "key"), [(kind, key) for kind, keys in KEYS.items() for key in keys])
def test_a_strange_value_is_borne_or_refused(sandbox: Sandbox, kind: str, key: str, value: str) -> None:
    sandbox.write("x.toml", f"{key} = {VALUES[value]}\n")
    ask(sandbox, kind, (2,) if value in NEVER else ANY)


TEXTS: dict[str, str] = {
    "unknown tables": "".join(f"[table_{n}]\n" for n in range(5_000)),
    "a long key": "k" * 100_000 + " = 1\n",
    "a long value": f'carrying_link_mm = "{"v" * 1_000_000}"\n',
    "digits after the point": f"carrying_link_mm = 1.{DIGITS}\n",
    "a key of a terminal": '"\\u001b[2J\\u0007" = 1\n',
    "a key of two lines": '"a\\nb" = 1\n',
    "a key of markup": '"[/x]" = 1\n',
    "a key of half a character": '"\\ud800" = 1\n',
    "a key of nothing": '"" = 1\n',
    "a key of direction": '"\\u202e\\u2028" = 1\n',
    "a key twice": "c_coef = 1\nc_coef = 2\n",
    "a raw control character": "c_coef = 1 # \x07\n",
    "a value of a terminal": 'c_coef = "\\u001b]0;x\\u0007"\n',
    "braces": 'c_coef = "{0} {x} %s"\n',
}


@each("kind", ["design", "workshop", "settings", "readings"])
@each("case", TEXTS)
def test_a_strange_text_is_refused(sandbox: Sandbox, kind: str, case: str) -> None:
    sandbox.write("x.toml", TEXTS[case])
    ask(sandbox, kind, (2,))


@each("case", [*DOCUMENTS, *accidents(12, 4)])
def test_a_spoilt_design_is_borne_or_refused(sandbox: Sandbox, case: str) -> None:
    spoils: dict[str, Spoil] = DOCUMENTS | accidents(12, 4)
    sandbox.write("x.toml", spoils[case](DESIGN.encode()))
    ask(sandbox, "design")


@each("seed", range(12))
def test_a_spoilt_workshop_is_borne_or_refused(sandbox: Sandbox, seed: int) -> None:
    text = load_workshop("default").to_toml().encode()
    sandbox.write("x.toml", accidents(12, 0)[f"flip-{seed}"](text))
    ask(sandbox, "workshop")


BASES: dict[str, Callable[[Path], str]] = {
    "itself": lambda folder: "x.toml",
    "a pipe": lambda folder: lay_odd(folder / "odd.toml", "pipe") or "odd.toml",
    "a loop": lambda folder: lay_odd(folder / "odd.toml", "loop") or "odd.toml",
    "another kind": lambda folder: "../../templates/robots/kenan-2.0.toml",
    "a user's file": lambda folder: "../home/.bashrc",
    "nul": lambda folder: "a\\u0000.toml",
    "a long name": lambda folder: "x" * 5000 + ".toml",
}


@each("key", ["base", "printer"])
@each("case", BASES)
def test_a_workshop_stands_on_no_strange_ground(sandbox: Sandbox, case: str, key: str) -> None:
    sandbox.write("readings.toml", READINGS)
    sandbox.write("x.toml", f'{key} = "{BASES[case](sandbox.work)}"\n')
    ask(sandbox, "workshop", (2,))


LIMITS = ((20, 400), (0.3, 3), (0.1, 3), (0.1, 3), (0.01, 0.99), (5, 90), (0.1, 200), (1, 89))
"""What a design can be, by its own documentation."""


def write_design(sandbox: Sandbox, vector: list[float]) -> None:
    sandbox.write("x.toml", to_toml(dict(zip(PARAMETERS, vector, strict=True))))


HOLDS_BADLY = [47.2223, 0.3388, 0.5689, 0.263, 0.3217, 53.5764, 200, 28.8995]


@each("seed", range(6))
def test_a_valid_design_is_built_or_cannot_be(sandbox: Sandbox, seed: int) -> None:
    """About a known troublemaker, and anywhere near the searched box."""
    generator = np.random.default_rng(seed)
    vector = np.array(HOLDS_BADLY) * (generator.uniform(0.97, 1.03, 8) if seed else 1.0)
    if seed > 3:
        vector = np.array([100, 1, 0.833, 0.934, 0.46, 70, 9.2, 40]) * generator.uniform(0.6, 1.25, 8)
    limits = np.array(LIMITS)
    write_design(sandbox, np.clip(vector, limits[:, 0], limits[:, 1]).tolist())
    sandbox.run("check" if seed <= 3 else "simulate", "x.toml", "--json", exits=(0, 1))


@settings(
    derandomize=True, max_examples=60, deadline=None, database=None, phases=[Phase.generate],
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)  # fmt: skip
@given(st.text(st.characters(exclude_categories=["Cs"]), max_size=200))
def test_any_text_is_borne_or_refused(sandbox: Sandbox, text: str) -> None:
    sandbox.write("x.toml", text.encode("utf-8", "replace"))
    ask(sandbox, "design", (2,))
