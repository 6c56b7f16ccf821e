"""The loop.json beside a URDF file, from strangers: every value spoilt, left out, or nested without end."""

import json
from collections.abc import Callable

import numpy as np
import pytest
from support.each import each
from support.mutations import DOCUMENTS, JSON_VALUES, Spoil, accidents, places, with_value, without
from support.sandbox import ANY, Sandbox

from hostile.conftest import ENGINES, Originals

UNREAD = ("release", "rest_rad")
"""What a simulation works out itself."""
NEVER = ("nan", "infinity", "overflow", "digits", "null", "object", "deep")
"""Values that are right nowhere in this file."""
SAMPLE = 110
WHOLE = {"null": "null", "list": "[]", "object": "{}", "number": "5", "text": '"x"', "deep": JSON_VALUES["deep"]}

Check = Callable[[str | bytes, tuple[int, ...]], None]


def exits(place: tuple[str | int, ...], value: str) -> tuple[int, ...]:
    return (2,) if value in NEVER and not set(place) & set(UNREAD) else ANY


@pytest.fixture
def check(sandbox: Sandbox, originals: Originals, still_works: Callable[[str], None]) -> Check:
    """Return what simulates the good URDF file with a spoilt loop in both engines."""

    def check(loop: str | bytes, exits: tuple[int, ...]) -> None:
        originals.lay_urdf(sandbox, originals.urdf, loop.encode() if isinstance(loop, str) else loop)
        for engine in ENGINES:
            try:
                sandbox.run("simulate", "robot.urdf", "--json", "--engine", engine, exits=exits)
            finally:
                still_works(engine)

    return check


@each("number", range(SAMPLE))
def test_a_strange_value_is_borne_or_refused(check: Check, sandbox: Sandbox, originals: Originals, number: int) -> None:
    generator = np.random.default_rng(number)
    found = list(places(originals.loop))
    place = found[number * 7 % len(found)]  # 7 has no divisor in common with their number: each one has its turn
    value = str(generator.choice(list(JSON_VALUES)))
    sandbox.case = f"{place} = {value}"
    check(with_value(originals.loop, place, JSON_VALUES[value]), exits(place, value))


@each(
    "place",
    [
        *((key,) for key in ("design", "loop", "spring", "travel_rad", "foot_depth_m", "surfaces", "release")),
        ("loop", "body_a"), ("loop", "point_b_m"), ("loop", "point_a_m", 1), ("spring", "joint"),
        ("spring", "stiffness_nm_per_rad"), ("travel_rad", "leg"), ("travel_rad", "front", 0), ("surfaces", "back"),
        ("design", "d_coef"),
    ],
)  # fmt: skip
def test_a_missing_section_or_value_is_refused(
    check: Check, originals: Originals, place: tuple[str | int, ...]
) -> None:
    check(without(originals.loop, place), ANY if place[0] in UNREAD else (2,))


@each("case", [*DOCUMENTS, *accidents(12, 6), *(f"is-{name}" for name in WHOLE)])
def test_what_is_no_loop_is_refused(check: Check, originals: Originals, case: str) -> None:
    spoils: dict[str, Spoil] = DOCUMENTS | accidents(12, 6)
    good = json.dumps(originals.loop, indent=2).encode()
    loop = spoils[case](good) if case in spoils else WHOLE[case.removeprefix("is-")]
    harmless = case in ("byte-order-mark", "carriage-returns", "utf-16") or case.startswith("flip")
    check(loop, ANY if harmless else (2,))
