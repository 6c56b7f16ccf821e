"""The public functions in Python, with what they were not made for: each succeeds or raises a `JumpcadError`."""

from collections.abc import Callable
from typing import Any

import numpy as np
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from support.each import each
from support.sandbox import LONGEST, Sandbox

import jumpcad

ODD: dict[str, Any] = {
    "none": None,
    "nothing": "",
    "text": "kenan-9",
    "colour": "\x1b[31m\n[/x]",
    "bytes": b"kenan-2.0",
    "number": 5,
    "minus": -1.0,
    "nan": float("nan"),
    "infinity": float("inf"),
    "huge": 10**400,
    "true": True,
    "list": [],
    "eight": [1.0] * 8,
    "eight words": ["x"] * 8,
    "eight of nothing": [None] * 8,
    "nine": np.ones(9),
    "square": np.ones((8, 8)),
    "not numbers": np.full(8, np.nan),
    "table": {"carrying_link_mm": 100},
    "object": object(),
    "class": jumpcad.Design,
    "function": len,
    "folder": ".",
    "missing": "no/such/file.toml",
    "nul": "a\0b",
    "long": "x" * 5000,
}
TAKES_ONE: dict[str, Callable[[Any], Any]] = {
    "load_design": lambda odd: jumpcad.load_design(odd),
    "load_workshop": lambda odd: jumpcad.load_workshop(odd),
    "load_settings": lambda odd: jumpcad.load_settings(odd),
    "from_vector": lambda odd: jumpcad.Design.from_vector(odd),
    "build": lambda odd: jumpcad.build(odd),
    "capsule_robot": lambda odd: jumpcad.capsule_robot(odd),
    "simulate": lambda odd: jumpcad.simulate(odd),
    "check": lambda odd: jumpcad.check(odd),
    "evaluate": lambda odd: jumpcad.evaluate(odd),
    "published": lambda odd: jumpcad.published.simulate(odd),
    "export": lambda odd: jumpcad.export(odd, "robot"),
}
GOOD = jumpcad.load_design("kenan-2.0")
CAPSULES = jumpcad.capsule_robot(GOOD)
TAKES_MORE: dict[str, Callable[[Any], Any]] = {
    "build in": lambda odd: jumpcad.build(GOOD, odd),
    "build named": lambda odd: jumpcad.build(GOOD, None, odd),
    "evaluate in": lambda odd: jumpcad.evaluate(GOOD, odd),
    "simulate with": lambda odd: jumpcad.simulate(CAPSULES, odd),
    "simulate by": lambda odd: jumpcad.simulate(CAPSULES, None, odd),
    "export to": lambda odd: jumpcad.export(CAPSULES, odd, pictures=False),
    "settings": lambda odd: jumpcad.Settings(dt_s=odd),
    "settings unknown": lambda odd: jumpcad.Settings(**{str(odd): odd}),
    "workshop": lambda odd: jumpcad.Workshop(printer=odd),
    "weights": lambda odd: changed_workshop("mass", {"weighed_g": odd}),
    "weight": lambda odd: changed_workshop("mass", {"weighed_g": {"main_leg": odd}}),
    "design": lambda odd: jumpcad.Design(**{**GOOD.model_dump(), "c_coef": odd}),
    "design missing": lambda odd: jumpcad.Design(c_coef=odd),
}
HEAVY = {"build in", "build named", "evaluate in"}
"""Where an odd value that is accepted costs a build."""
TELLING = ("text", "number", "object", "nan", "colour")


def changed_workshop(section: str, values: dict[str, Any]) -> object:
    """Return the default workshop made again with other values, as a script does it."""
    data = jumpcad.load_workshop().model_dump()
    return jumpcad.Workshop(**{**data, section: {**data[section], **values}})


def ask(sandbox: Sandbox, call: Callable[[Any], Any], odd: object) -> None:
    """Call with an odd value: it succeeds, or what is raised is a line for a user, in which the value may be said."""
    places = ["exports", "robot", *([odd] if odd is ODD["text"] else [])]
    with sandbox.untouched(writes=places):
        try:
            call(odd)
        except jumpcad.JumpcadError as error:
            own = str(error).replace(str(odd), "").replace(repr(odd), "")
            assert own
            assert len(own) <= LONGEST
            assert "\n" not in own


@each("odd", ODD)
@each("function", TAKES_ONE)
def test_an_odd_argument_is_named(sandbox: Sandbox, function: str, odd: str) -> None:
    ask(sandbox, TAKES_ONE[function], ODD[odd])


@each(
    ("function", "odd"),
    [(function, odd) for function in TAKES_MORE for odd in ODD if function not in HEAVY or odd in TELLING],
)
def test_an_odd_option_is_named(sandbox: Sandbox, function: str, odd: str) -> None:
    ask(sandbox, TAKES_MORE[function], ODD[odd])


TEXT = st.text(st.characters(exclude_categories=["Cs"]), max_size=20)  # as by default, without a second to find it out
ANYTHING = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), TEXT, st.binary(max_size=9))


@settings(
    derandomize=True, max_examples=100, deadline=None, database=None, phases=[Phase.generate],
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)  # fmt: skip
@given(st.one_of(st.lists(ANYTHING, max_size=9), st.lists(ANYTHING, min_size=8, max_size=8)))
def test_any_vector_is_a_design_or_is_refused(sandbox: Sandbox, vector: list[Any]) -> None:
    ask(sandbox, jumpcad.Design.from_vector, vector)
