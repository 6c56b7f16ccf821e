"""A public function works with any argument, or says in one line what it takes."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, Protocol, runtime_checkable

import numpy as np
import pytest
from support.built import built

import jumpcad
from jumpcad import checks
from jumpcad.arguments import MADE_BY, check_arguments, check_fields
from jumpcad.calibration import predicted_jump, settings_toml
from jumpcad.errors import JumpcadError
from jumpcad.settings import load_settings
from jumpcad.simulation import simulate, uncertain_jump
from jumpcad.workshop import varied, workshop_value

ODD: list[Any] = [
    None, "", "x\n[/red]y", "a\0b.toml", "x" * 5000, b"kenan-2.0", 0, -1, float("nan"), float("inf"), 10**400, True, [],
    [1.0] * 7, ["1"] * 8, np.zeros(8), np.zeros((2, 4)), {}, {"a": 1}, {1.0}, object(), int, iter([1.0] * 8), jumpcad,
    Path("nowhere.toml"), Path(),
]  # fmt: skip

DESIGN = jumpcad.load_design("kenan-2.0")
CAPSULE = jumpcad.capsule_robot(DESIGN)

CALLS = {
    "build design": jumpcad.build,
    "build workshop": lambda odd: jumpcad.build(DESIGN, 0 if odd is None else odd),
    "build name": lambda odd: jumpcad.build(DESIGN, None, 0 if odd is None or isinstance(odd, str) else odd),
    "capsule_robot": jumpcad.capsule_robot,
    "check": jumpcad.check,
    "evaluate design": jumpcad.evaluate,
    "evaluate workshop": lambda odd: jumpcad.evaluate(DESIGN, 0 if odd is None else odd),
    "evaluate settings": lambda odd: jumpcad.evaluate(DESIGN, None, 0 if odd is None else odd),
    "evaluate engine": lambda odd: jumpcad.evaluate(DESIGN, None, None, 0 if odd is None else odd),
    "export robot": lambda odd: jumpcad.export(odd, "out"),
    "export folder": lambda odd: jumpcad.export(CAPSULE, odd),
    "load_design": jumpcad.load_design,
    "load_settings": jumpcad.load_settings,
    "load_workshop": jumpcad.load_workshop,
    "published": jumpcad.published.simulate,
    "land": jumpcad.land,
    "jumps": jumpcad.jumps,
    "variants": jumpcad.variants,
    "load_robot": jumpcad.load_robot,
    "predicted_jump": lambda odd: predicted_jump(odd, odd),
    "settings_toml": settings_toml,
    "simulation.simulate": simulate,
    "uncertain_jump": lambda odd: uncertain_jump(odd, load_settings("default"), "planar"),
    "varied": lambda odd: varied(odd, {}),
    "workshop_value": lambda odd: workshop_value(odd, "fits.press_mm"),
    "simulate robot": jumpcad.simulate,
    "simulate settings": lambda odd: jumpcad.simulate(CAPSULE, 0 if odd is None else odd),
    "simulate engine": lambda odd: jumpcad.simulate(CAPSULE, None, 0 if odd is None else odd),
    "Design": jumpcad.Design,
    "Design alone": lambda odd: jumpcad.Design(c_coef=odd),
    "Design value": lambda odd: jumpcad.Design(**{**DESIGN.model_dump(), "c_coef": odd}),
    "from_vector": jumpcad.Design.from_vector,
    "from_vector value": lambda odd: jumpcad.Design.from_vector([odd] * 8),
    "Settings": jumpcad.Settings,
    "Settings value": lambda odd: jumpcad.Settings(dt_s=odd),
    "Settings key": lambda odd: jumpcad.Settings(**{str(odd): odd}),
    "Workshop": jumpcad.Workshop,
    "Workshop value": lambda odd: jumpcad.Workshop(printer=odd),
}


@pytest.mark.parametrize("call", CALLS)
def test_nonsense_is_refused(call: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    for odd in ODD:
        with pytest.raises(JumpcadError) as caught:
            CALLS[call](odd)
        assert str(caught.value).isprintable()
        assert len(str(caught.value)) <= 4000 + len(str(odd)), "ten clauses of a path, a key, a value and a reason"
    assert list(tmp_path.iterdir()) == []


def test_a_name_in_place_of_a_design_says_how_to_load_it() -> None:
    with pytest.raises(JumpcadError) as caught:
        jumpcad.capsule_robot("kenan-2.0")
    assert str(caught.value) == (
        "capsule_robot() takes a Design, not 'kenan-2.0' (str): jumpcad.load_design('kenan-2.0') makes one"
    )


def test_the_way_out_that_is_told_makes_what_is_asked_for() -> None:
    for kind in (jumpcad.Design, jumpcad.Robot, jumpcad.Settings, jumpcad.Workshop):
        made = MADE_BY[kind.__name__]
        if kind is not jumpcad.Robot:
            assert isinstance(eval(made, {"jumpcad": jumpcad}), kind), made
    with pytest.raises(JumpcadError, match=r"takes a Settings, not 7 \(int\): jumpcad.load_settings\('default'\)"):
        jumpcad.simulate(CAPSULE, 7)


@runtime_checkable
class Weigher(Protocol):
    def __call__(self, name: str) -> float: ...

    def named(self) -> str: ...


class Scale:
    def __call__(self, name: str) -> float:
        return float(name)

    def named(self) -> str:
        return "scale"


class Leg:
    @check_arguments
    def __init__(self, length_mm: float) -> None:
        self.length_mm = length_mm


@dataclass(frozen=True)
class Bar:
    length_mm: float
    name: str = "bar"
    bent: bool = field(init=False)  # which is found out afterwards

    def __post_init__(self) -> None:
        check_fields(self)


@check_arguments
def taken(
    what: Any = None, count: int = 1, length_mm: float = 1.0, name: str | Path | None = None, loud: bool = False,
    ends_mm: Path | Sequence[float] = (), names: list[str] | None = None, place: tuple[str, float] = ("", 0.0),
    springs: Literal[1, 2] = 1, scale: Weigher | None = None, **more: Any,
) -> dict[str, Any]:  # fmt: skip
    return locals() | more


def test_all_that_annotations_allow_passes_as_it_is_and_numbers_of_numpy_become_python_s() -> None:
    scale = Scale()
    for given in (
        {"what": None}, {"what": "a"}, {"count": 2}, {"length_mm": 3}, {"length_mm": 2.5}, {"name": "a"},
        {"name": Path("a")}, {"name": None}, {"loud": True}, {"ends_mm": [1, 2.5]}, {"ends_mm": (1.0,)},
        {"ends_mm": Path("a")}, {"names": ["leg"]}, {"place": ("hub", 4.0)}, {"springs": 2}, {"scale": scale},
        {"colour": "red"},
    ):  # fmt: skip
        ((name, value),) = given.items()
        assert taken(**given)[name] is value, given
    found = taken(count=np.int64(3), length_mm=np.float32(0.5), what=np.float32(0.5), name=None)
    assert [type(found[name]) for name in ("count", "length_mm", "what")] == [int, float, np.float32]
    assert type(taken(length_mm=np.int32(2))["length_mm"]) is int
    assert (Leg(3).length_mm, Bar(3).length_mm) == (3, 3)


def test_all_else_is_refused_in_words_that_say_what_is_taken() -> None:
    """A truth is no number though Python counts with it; of a wrong item it is told and not the whole list."""
    for call, message in {
        lambda: taken(name=1): "taken() takes a text or a path as name, not 1 (int)",
        lambda: taken(loud="yes"): "taken() takes True or False as loud, not 'yes' (str)",
        lambda: taken(length_mm="2"): "taken() takes a number as length_mm, not '2' (str)",
        lambda: taken(count=True): "taken() takes a whole number as count, not True (bool)",
        lambda: taken(length_mm=False): "as length_mm, not False (bool)",
        lambda: taken(count=1.5): "as count, not 1.5 (float)",
        lambda: taken(count=np.float64(3.0)): "taken() takes a whole number as count",
        lambda: taken(count=np.True_): "taken() takes a whole number as count",
        lambda: taken(count=np.array([3])): "taken() takes a whole number as count",
        lambda: taken(ends_mm=[1.0, True]): "as ends_mm, not one with True (bool)",
        lambda: taken(ends_mm=[1.0, "far"]): "a path or a list of float as ends_mm, not one with 'far' (str)",
        lambda: taken(ends_mm="far"): "as ends_mm, not 'far' (str)",
        lambda: taken(names=["leg", 2]): "taken() takes a list of str as names, not one with 2 (int)",
        lambda: taken(springs="2"): "taken() takes a whole number as springs, not '2' (str)",
        lambda: taken(scale=float): "taken() takes a Weigher as scale, not ",
        lambda: taken(scale=lambda name: 1.0): "taken() takes a Weigher as scale, not ",
        lambda: Leg("long"): "Leg() takes a number as length_mm, not 'long' (str)",
        lambda: Leg(): "Leg(self, length_mm): missing a required argument: 'length_mm'",
        lambda: Bar(3.0, 2): "Bar() takes a text as name, not 2 (int)",
        lambda: jumpcad.build(): "build(design, workshop=None, name=None): missing a required argument: 'design'",
        lambda: jumpcad.simulate(CAPSULE, colour="red"): "engine=None): got an unexpected keyword argument 'col",
        lambda: jumpcad.Design(100.0, 1.0): "Design takes its values by name, Design(carrying_link_mm=…), not 100",
    }.items():
        with pytest.raises(JumpcadError) as caught:
            call()
        assert message in str(caught.value), str(caught.value)
        assert "\n" not in str(caught.value)


@pytest.mark.thorough
@pytest.mark.usefixtures("built_once")
def test_a_design_is_built_where_a_robot_is_wanted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))  # without solids
    robot = jumpcad.build(DESIGN)
    assert jumpcad.check(DESIGN) == jumpcad.check(robot)
    assert repr(jumpcad.simulate(DESIGN)) == repr(jumpcad.simulate(robot))
    ours, theirs = (jumpcad.export(one, tmp_path / str(n), pictures=False) for n, one in enumerate((DESIGN, robot)))
    assert ours.files == theirs.files


def test_a_vector_may_be_of_any_numbers() -> None:
    for kind in (list, tuple, np.array, np.float32):
        assert jumpcad.Design.from_vector(kind([100, 1, 1, 1, 0.5, 60, 8, 40])).carrying_link_mm == 100.0


def test_a_robot_without_parts_is_not_exported(tmp_path: Path) -> None:
    with pytest.raises(JumpcadError, match=r"takes a Robot or a Design or a text or a path, not <Mechanism"):
        jumpcad.export(CAPSULE, tmp_path / "out")


def test_counts_and_seeds_have_limits() -> None:
    for call, words in {
        lambda: jumpcad.variants(built("kenan-2.0"), 10**6): "count = 1000000: must be at least 1 and at most 100000",
        lambda: jumpcad.land(built("kenan-2.0"), 10**12): "tries = 1000000000000: must be at least 1 and at most 10000",
        lambda: jumpcad.jumps(built("kenan-2.0"), 0): "count = 0: must be at least 1",
        lambda: jumpcad.variants(built("kenan-2.0"), 1, seed=-1): "seed = -1: must be at least 0",
    }.items():
        with pytest.raises(JumpcadError, match=words):
            call()
