"""The loop.json beside a URDF file, from strangers: every value spoilt, left out, or nested without end."""

import json
from collections.abc import Callable

import numpy as np
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

Loop = dict[str, object]


def exits(place: tuple[str | int, ...], value: str) -> tuple[int, ...]:
    return (2,) if value in NEVER and not set(place) & set(UNREAD) else ANY


def check(
    sandbox: Sandbox, originals: Originals, still_works: Callable[[str], None], loop: bytes, exits: tuple[int, ...]
) -> None:
    """Simulate the good URDF file with a spoilt loop in both engines."""
    sandbox.write("robot.urdf", originals.urdf)
    sandbox.write("robot.loop.json", loop)
    for engine in ENGINES:
        try:
            sandbox.run("simulate", "robot.urdf", "--json", "--engine", engine, exits=exits)
        finally:
            still_works(engine)


@each("number", range(SAMPLE))
def test_a_strange_value_is_borne_or_refused(
    sandbox: Sandbox, originals: Originals, still_works: Callable[[str], None], number: int
) -> None:
    generator = np.random.default_rng(number)
    found = list(places(originals.loop))
    place = found[number * 7 % len(found)]  # 7 has no divisor in common with their number: each one has its turn
    value = str(generator.choice(list(JSON_VALUES)))
    sandbox.case = f"{place} = {value}"
    text = with_value(originals.loop, place, JSON_VALUES[value])
    check(sandbox, originals, still_works, text.encode(), exits(place, value))


@each("key", ["design", "loop", "spring", "travel_rad", "foot_depth_m", "surfaces", "release"])
def test_a_missing_section_is_refused(
    sandbox: Sandbox, originals: Originals, still_works: Callable[[str], None], key: str
) -> None:
    text = without(originals.loop, (key,))
    check(sandbox, originals, still_works, text.encode(), ANY if key in UNREAD else (2,))


@each(
    "place",
    [
        ("loop", "body_a"), ("loop", "point_b_m"), ("loop", "point_a_m", 1), ("spring", "joint"),
        ("spring", "stiffness_nm_per_rad"), ("travel_rad", "leg"), ("travel_rad", "front", 0), ("surfaces", "back"),
        ("design", "d_coef"),
    ],
)  # fmt: skip
def test_a_missing_value_is_refused(
    sandbox: Sandbox, originals: Originals, still_works: Callable[[str], None], place: tuple[str | int, ...]
) -> None:
    check(sandbox, originals, still_works, without(originals.loop, place).encode(), (2,))


CONTRADICTIONS = {
    "unknown body": (("loop", "body_a"), '"nobody"'),
    "one body twice": (("loop", "body_a"), '"foot"'),
    "unknown joint": (("spring", "joint"), '"knee"'),
    "negative spring": (("spring", "stiffness_nm_per_rad"), "-1"),
    "spring of a railway car": (("spring", "stiffness_nm_per_rad"), "1e300"),
    "unknown surface": (("surfaces", "back"), '"ice"'),
    "travel backwards": (("travel_rad", "leg"), "[1, -1]"),
    "travel of one": (("travel_rad", "leg"), "[1]"),
    "point in the plane": (("loop", "point_a_m"), "[0.1, 0]"),
    "point of points": (("loop", "point_a_m"), "[[1, 2, 3], [1, 2, 3], [1, 2, 3]]"),
    "point far away": (("loop", "point_a_m"), "[1e300, 0, 0]"),
    "point beside the plane": (("loop", "point_a_m"), "[0.1, 0.05, 0]"),
    "foot above the ground": (("foot_depth_m",), "-1e9"),
    "design of another": (("design", "carrying_link_mm"), "200.0"),
    "design that cannot be": (("design", "c_coef"), "2.9"),
    "unknown parameter": (("design",), '{"\\u001b[2J": 1}'),
}


@each("case", CONTRADICTIONS)
def test_a_loop_that_cannot_be_is_borne_or_refused(
    sandbox: Sandbox, originals: Originals, still_works: Callable[[str], None], case: str
) -> None:
    place, value = CONTRADICTIONS[case]
    check(sandbox, originals, still_works, with_value(originals.loop, place, value).encode(), ANY)


@each("case", [*DOCUMENTS, *accidents(12, 6), *(f"is-{name}" for name in WHOLE)])
def test_what_is_no_loop_is_refused(
    sandbox: Sandbox, originals: Originals, still_works: Callable[[str], None], case: str
) -> None:
    spoils: dict[str, Spoil] = DOCUMENTS | accidents(12, 6)
    good = json.dumps(originals.loop, indent=2).encode()
    loop = spoils[case](good) if case in spoils else WHOLE[case.removeprefix("is-")].encode()
    harmless = case in ("byte-order-mark", "carriage-returns", "utf-16") or case.startswith("flip")
    check(sandbox, originals, still_works, loop, ANY if harmless else (2,))
