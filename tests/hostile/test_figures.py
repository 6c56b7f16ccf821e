"""Every figure of a workshop and of settings, one at a time, at the ends of its range.

Both ends are read; a robot is built at one of them, at another one for the next figure. Between lie the shipped
workshops and those of `tests/test_any_design.py`.
"""

import re
import typing
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pytest
from annotated_types import Ge, Gt, Le, Lt
from pydantic import BaseModel
from support.each import each
from support.sandbox import Sandbox

from jumpcad.building import build
from jumpcad.checks import quick_findings
from jumpcad.design import Design, load_design
from jumpcad.errors import JumpcadError
from jumpcad.exporters.loop_file import LoopFile
from jumpcad.files import Record
from jumpcad.robot.robot import Robot
from jumpcad.settings import Settings
from jumpcad.workshop import Workshop, load_workshop

TINY = 5e-324
"""The smallest number above 0: one over it overflows."""

Place = tuple[str | int, ...]
"""Keys and places in lists that lead to a figure; `*` stands for any name of a table of tables."""


@dataclass(frozen=True)
class Range:
    """What a figure may be: from `low` to `high`; `open` where the low end is not in it, or an end is missing."""

    low: float
    high: float
    whole: bool
    open: bool

    def ends(self) -> list[float]:
        """Return both ends; of a range from 0, the smallest number above it too."""
        return [self.low, *([TINY] if self.low == 0.0 and not self.whole else []), self.high]


def figures(model: type[BaseModel], place: Place = ()) -> Iterator[tuple[Place, Range]]:
    """Yield every number in a model with its range."""
    for name, field in model.model_fields.items():
        yield from _figures(field.annotation, list(field.metadata), (*place, name))


def _figures(kind: Any, limits: list[Any], place: Place) -> Iterator[tuple[Place, Range]]:
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin is typing.Annotated:
        more = [limit for one in inner[1:] for limit in getattr(one, "metadata", [one])]
        yield from _figures(inner[0], [*limits, *more], place)
    elif isinstance(kind, type) and issubclass(kind, BaseModel):
        yield from figures(kind, place)
    elif kind in (float, int):
        yield place, _range(limits, kind is int)
    elif origin is dict:
        yield from _figures(inner[1], [], (*place, "*"))
    elif origin is tuple:
        for number, one in enumerate(inner):
            yield from _figures(one, [], (*place, number))
    else:
        for one in inner:  # of a union
            yield from _figures(one, limits, place)


def _range(limits: list[Any], whole: bool) -> Range:
    lows = [limit.ge for limit in limits if isinstance(limit, Ge)]
    highs = [limit.le for limit in limits if isinstance(limit, Le)]
    is_open = not (lows and highs) or any(isinstance(limit, Gt | Lt) for limit in limits)
    return Range(max(lows, default=0.0), min(highs, default=0.0), whole, is_open)


DESIGN = load_design("kenan-2.0")
MODELS = (Design, Workshop, Settings, LoopFile)
WORKSHOP, SETTINGS = dict(figures(Workshop)), dict(figures(Settings))
NUMBER = {place: number for number, place in enumerate(WORKSHOP)}
SMALLEST, LARGEST = 1e-6, 1e9
"""No figure of a robot is smaller (µs, µm, mg) or larger (jumps); their quotients and powers are finite."""
SMALLEST_INERTIA = 1e-12
"""A milligram a millimetre from its axis (kg·m²)."""
WEIGHED = ("process", "printer", "materials", "mass", "fits", "body")
"""Sections that the layer model reads, or that change shapes; elsewhere parts weigh volume times density."""
MODEL = ("mass", "model")
NO_NUMBER = re.compile(r"\b(nan|inf)\b")
OWN = """
[materials.Own]
density_g_cm3 = 1.2
strength_in_plane_mpa = 45.0
strength_interlayer_mpa = 30.0
modulus_mpa = 2000.0
price_eur_per_kg = 20.0
[roles]
links = "Own"
body = "Own"
gears = "Own"
[bought]
motors = ["own"]
leg_bearing = "own"
roller = "own"
battery = "own"
driver = "own"
[body]
stop_pad = "own"
[ground]
pad = "own"
[motors.own]
like = "n20-298"
source = "mine"
[bearings.own]
like = "623"
source = "mine"
[batteries.own]
like = "lipo-2s-180"
source = "mine"
[boards.own]
like = "drv8833"
source = "mine"
[pads.own]
like = "sj5616"
source = "mine"
[springs.own]
source = "mine"
wire_mm = 1.0
inside_diameter_mm = 8.0
turns = 4.5
arm_angle_deg = 0.0
arm_length_mm = 20.0
rate_nmm_per_deg = 1.5
[prices_eur]
screw = 0.05
[mass.weighed_g]
foot = 3.0
"""


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Robot:
    """Return the robot of a workshop in which everything is the user's own: while it stays, its parts' masses do."""
    path = tmp_path_factory.mktemp("figures") / "own.toml"
    path.write_text(OWN)
    robot = build(DESIGN, load_workshop(path), "")
    assert quick_findings(robot)
    return robot


@pytest.fixture(scope="module")
def own(robot: Robot) -> dict[str, Any]:
    """Return the data of its workshop."""
    return robot.workshop.model_dump()


def with_figure(data: Any, place: Place, value: float | str) -> Any:
    """Return nested data with one figure, or word, replaced."""
    if not place:
        return value
    if data is None:  # an optional pair: both ends alike
        return (value, value)
    if isinstance(data, tuple):
        return tuple(
            with_figure(one, place[1:], value) if number == place[0] else one for number, one in enumerate(data)
        )
    key = next(iter(data)) if place[0] == "*" else place[0]
    return {**data, key: with_figure(data.get(key, value), place[1:], value)}


@each("place", WORKSHOP)
def test_a_figure_at_its_limits_is_borne_or_refused(own: dict[str, Any], sandbox: Sandbox, place: Place) -> None:
    ends = WORKSHOP[place].ends()
    for end, value in enumerate(ends):
        sandbox.tries += 1
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            data = with_figure(own if place[0] in WEIGHED else with_figure(own, MODEL, "solid"), place, value)
            said = outcome(data, built=end == NUMBER[place] % len(ends))
        assert not NO_NUMBER.search(said), f"{value}: {said}"


def outcome(data: dict[str, Any], built: bool) -> str:
    """Return what is said of a robot built in a workshop: the findings of the cheap checks, or why there is none."""
    try:
        workshop = Workshop(**data)
        return " ".join(str(found.to_dict()) for found in quick_findings(build(DESIGN, workshop, ""))) if built else ""
    except JumpcadError as error:
        return str(error)


@each(("place", "model"), [(place, model) for model in MODELS for place, _ in figures(model)])
def test_a_figure_has_two_ends_and_none_near_nothing(place: Place, model: type[Record]) -> None:
    found = dict(figures(model))[place]
    assert not found.open
    smallest = SMALLEST_INERTIA if any(str(key).endswith("_kg_m2") for key in place) else SMALLEST
    assert found.low <= 0.0 or found.low >= smallest
    assert found.high <= LARGEST


@each("field", SETTINGS)
def test_a_setting_at_its_limits_is_borne(sandbox: Sandbox, field: Place) -> None:
    for value in SETTINGS[field].ends():
        if not (field == ("dt_s",) and value < 1e-4):  # takes minutes
            number = int(value) if SETTINGS[field].whole else value
            sandbox.write("x.toml", f"{field[0]} = {number}\n" if len(field) == 1 else draws(field[1], number))
            sandbox.run("simulate", "kenan-2.0", "--capsule", "--settings", "x.toml", "--json", exits=(0, 1))


def draws(name: Any, value: float) -> str:
    """Return a table of one draw with one of its values changed."""
    one = {"spring_efficiency": 1.0, "pin_friction": 0.2} | {name: value}
    return "[draws]\n" + "".join(f"{key} = [{number}]\n" for key, number in one.items())
