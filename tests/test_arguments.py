"""A public function works with any argument, or says in one line what it takes."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, Protocol

import numpy as np
import pytest

import jumpcad
from jumpcad import checks
from jumpcad.arguments import require_fields, typed
from jumpcad.errors import JumpcadError

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
    "build name": lambda odd: jumpcad.build(DESIGN, None, odd if not isinstance(odd, str) else 0),
    "capsule_robot": jumpcad.capsule_robot,
    "check": jumpcad.check,
    "evaluate design": jumpcad.evaluate,
    "evaluate workshop": lambda odd: jumpcad.evaluate(DESIGN, 0 if odd is None else odd),
    "evaluate settings": lambda odd: jumpcad.evaluate(DESIGN, None, 0 if odd is None else odd),
    "evaluate engine": lambda odd: jumpcad.evaluate(DESIGN, None, None, odd),
    "export robot": lambda odd: jumpcad.export(odd, "out"),
    "export folder": lambda odd: jumpcad.export(CAPSULE, odd),
    "load_design": jumpcad.load_design,
    "load_settings": jumpcad.load_settings,
    "load_workshop": jumpcad.load_workshop,
    "published": jumpcad.published.simulate,
    "simulate robot": jumpcad.simulate,
    "simulate settings": lambda odd: jumpcad.simulate(CAPSULE, 0 if odd is None else odd),
    "simulate engine": lambda odd: jumpcad.simulate(CAPSULE, None, odd),
    "Design": jumpcad.Design,
    "Design value": lambda odd: jumpcad.Design(**{**DESIGN.model_dump(), "c_coef": odd}),
    "from_vector": jumpcad.Design.from_vector,
    "from_vector value": lambda odd: jumpcad.Design.from_vector([odd] * 8),
    "Settings": jumpcad.Settings,
    "Settings value": lambda odd: jumpcad.Settings(dt_s=odd),
    "Workshop": jumpcad.Workshop,
    "Workshop value": lambda odd: jumpcad.Workshop(printer=odd),
}


@pytest.mark.parametrize("call", CALLS)
def test_nonsense_is_refused(call: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    for odd in ODD:
        with pytest.raises(JumpcadError):
            CALLS[call](odd)
    assert list(tmp_path.iterdir()) == []


def test_a_name_in_place_of_a_design_says_how_to_load_it() -> None:
    with pytest.raises(JumpcadError) as caught:
        jumpcad.build("kenan-2.0")
    assert str(caught.value) == (
        "build() takes a Design, not 'kenan-2.0' (str): jumpcad.load_design('kenan-2.0') makes one"
    )


@pytest.mark.parametrize("value", [7, "x" * 5000, Path("y" * 61)], ids=["number", "long text", "long path"])
def test_the_way_out_that_is_told_makes_what_is_asked_for(value: Any) -> None:
    """With a shipped template's name where the value is no name that fits on a line."""

    @typed
    def given(design: jumpcad.Design | None = None, settings: jumpcad.Settings | None = None,
              workshop: jumpcad.Workshop | None = None) -> None: ...  # fmt: skip

    for name, kind in (("design", jumpcad.Design), ("settings", jumpcad.Settings), ("workshop", jumpcad.Workshop)):
        with pytest.raises(JumpcadError) as caught:
            given(**{name: value})
        made = str(caught.value).rpartition(": ")[2].removesuffix(" makes one")
        assert isinstance(eval(made, {"jumpcad": jumpcad}), kind)


@pytest.mark.parametrize("name", ["mine.toml", "z" * 60])
def test_a_name_that_fits_on_a_line_is_in_the_way_out(name: str) -> None:
    with pytest.raises(JumpcadError, match=rf"jumpcad\.load_settings\('{name}'\) makes one$"):
        jumpcad.simulate(CAPSULE, name)


def test_what_makes_an_object_is_called_by_its_class() -> None:
    """Nobody calls `__init__`."""

    class Leg:
        @typed
        def __init__(self, length_mm: float) -> None:
            self.length_mm = length_mm

    assert Leg(3).length_mm == 3
    with pytest.raises(JumpcadError, match=r"Leg\(\) takes .* as length_mm, not 'long' \(str\)"):
        Leg("long")  # type: ignore[arg-type]
    with pytest.raises(JumpcadError, match=r"Leg\(self, length_mm\): missing a required argument: 'length_mm'"):
        Leg()  # type: ignore[call-arg]
    with pytest.raises(JumpcadError, match=r"Leg\(\) takes no 'colour', only length_mm$"):
        Leg(3.0, colour="red")  # type: ignore[call-arg]


def test_missing_and_unknown_arguments_are_named() -> None:
    with pytest.raises(JumpcadError, match=r"build\(design, workshop=None, name='robot'\): missing .*'design'"):
        jumpcad.build()
    with pytest.raises(JumpcadError, match=r"simulate\(\) takes no 'colour', only robot, settings and engine$"):
        jumpcad.simulate(CAPSULE, colour="red")
    with pytest.raises(JumpcadError, match=r"^optimize\(\) takes no 'bound' \(did you mean bounds\?\), only method, "):
        jumpcad.optimize(bound={"c_coef": (1.0, 1.1)})


def test_values_without_names_are_refused() -> None:
    with pytest.raises(JumpcadError, match=r"Design takes its values by name, Design\(carrying_link_mm=…\), not 100"):
        jumpcad.Design(100.0, 1.0)


def test_all_that_annotations_allow_passes() -> None:
    @typed
    def told(what: Any, name: str | Path | None = None, loud: bool = False) -> tuple[Any, ...]:
        return what, name, loud

    for what, name in itertools.product((1, None, "a"), ("a", Path("a"), None)):
        assert told(what, name=name) == (what, name, False)
    with pytest.raises(JumpcadError, match=r"told\(\) takes a text or a path as name, not 1 \(int\)"):
        told(1, 1)
    with pytest.raises(JumpcadError, match=r"told\(\) takes True or False as loud, not 'yes' \(str\)"):
        told(1, None, "yes")


def test_what_a_function_or_method_does_is_asked_of_an_object_not_its_class_s_name() -> None:
    """A protocol's own methods, and whether it can be called; what Python gives to every class does not count."""

    class Model(Protocol):
        def __call__(self, design: str) -> float: ...

        def named(self) -> str: ...

        def weighed(self) -> float: ...

    class Whole:
        def __call__(self, design: str) -> float:
            return float(design)

        def named(self) -> str:
            return "whole"

        def weighed(self) -> float:
            return 1.0

    class Silent:
        named, weighed = Whole.named, Whole.weighed

    class Weightless:
        named, __call__ = Whole.named, Whole.__call__

    @typed
    def judged(model: Model) -> float:
        return model("2.5")

    assert judged(Whole()) == 2.5
    for wrong in (Silent(), Weightless(), float, lambda design: 1.0, 2.5):
        with pytest.raises(JumpcadError, match=r"judged\(\) takes a Model, not "):
            judged(wrong)  # type: ignore[arg-type]


def test_a_function_that_takes_any_names_beside_its_own_is_given_them() -> None:
    @typed
    def noted(count: int, **more: Any) -> dict[str, Any]:
        return {"count": count} | more

    assert noted(1, colour="red") == {"count": 1, "colour": "red"}
    with pytest.raises(JumpcadError, match=r"noted\(\) takes .* as count, not 'red' \(str\)"):
        noted("red", colour=1)  # type: ignore[arg-type]


@pytest.mark.usefixtures("built_once")
def test_a_design_is_built_where_a_robot_is_wanted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))  # without solids
    robot = jumpcad.build(DESIGN)
    assert jumpcad.check(DESIGN) == jumpcad.check(robot)
    assert repr(jumpcad.simulate(DESIGN)) == repr(jumpcad.simulate(robot))
    ours, theirs = (jumpcad.export(one, tmp_path / str(n), pictures=False) for n, one in enumerate((DESIGN, robot)))
    assert ours.files == theirs.files


def test_a_whole_number_is_taken_for_any_number_and_a_text_is_not() -> None:
    @typed
    def doubled(length_mm: float) -> float:
        return 2.0 * length_mm

    assert (doubled(2), doubled(2.5)) == (4.0, 5.0)
    with pytest.raises(JumpcadError, match=r"doubled\(\) takes .* as length_mm, not '2'"):
        doubled("2")  # type: ignore[arg-type]


@pytest.mark.parametrize("truth", [True, False])
def test_a_truth_is_no_number_of_anything(truth: bool) -> None:
    """Though Python counts with it: neither a whole number nor any other, nor one of several."""

    @typed
    def counted(
        count: int = 1, length_mm: float = 1.0, ends_mm: Sequence[float] = (), share: float | None = None
    ) -> float:
        return count * length_mm

    assert counted(2, 3) == 6
    for wrong in ({"count": truth}, {"length_mm": truth}, {"ends_mm": [1.0, truth]}, {"share": truth}):
        with pytest.raises(JumpcadError, match=rf"as {next(iter(wrong))}, not .*{truth} \(bool\)"):
            counted(**wrong)  # type: ignore[arg-type]


def test_each_of_several_is_checked_whatever_holds_them_and_pairs_of_two_kinds_are_not() -> None:
    @typed
    def joined(names: list[str], lengths_mm: tuple[float, ...] = (), place: tuple[str, float] = ("", 0.0)) -> int:
        return len(names) + len(lengths_mm) + len(place)

    assert joined(["leg"], (1.0, 2, 3.5), ("hub", 4.0)) == 6
    for wrong in ({"names": ["leg", 2]}, {"names": [], "lengths_mm": (1.0, "2")}):
        with pytest.raises(JumpcadError, match=r"joined\(\) takes .* not one with '?2'?"):
            joined(**wrong)  # type: ignore[arg-type]


def test_of_one_wrong_item_it_is_told_and_not_the_whole_list_wherever_lists_stand_among_the_kinds() -> None:
    @typed
    def first(ends_mm: list[float] | None) -> None: ...

    @typed
    def last(ends_mm: Path | list[float]) -> None: ...

    for function in (first, last):
        with pytest.raises(JumpcadError, match=r" as ends_mm, not one with 'far' \(str\)$"):
            function([1.0, "far"])  # type: ignore[list-item]


def test_a_value_of_a_few_is_of_the_kind_that_they_are() -> None:
    @typed
    def wound(springs: Literal[1, 2] = 1, release: Literal["dog", "fixed"] = "dog") -> None: ...

    wound(2, "fixed")
    for wrong in ({"springs": "2"}, {"release": 2}):
        with pytest.raises(JumpcadError, match=r"wound\(\) takes "):
            wound(**wrong)  # type: ignore[arg-type]


def test_a_record_checks_its_fields() -> None:
    @dataclass(frozen=True)
    class Leg:
        length_mm: float
        name: str = "leg"
        bent: bool = field(init=False)  # which is found out afterwards

        def __post_init__(self) -> None:
            require_fields(self)

    assert Leg(3).length_mm == 3
    with pytest.raises(JumpcadError, match=r"Leg\(\) takes .* as name, not 2 \(int\)"):
        Leg(3.0, 2)  # type: ignore[arg-type]


def test_a_vector_may_be_of_any_numbers() -> None:
    for kind in (list, tuple, np.array, np.float32):
        assert jumpcad.Design.from_vector(kind([100, 1, 1, 1, 0.5, 60, 8, 40])).carrying_link_mm == 100.0


def test_a_number_of_numpy_is_taken_as_python_s() -> None:
    """As from `for seed in np.arange(3)`; what is no number, or no whole one, is refused as ever."""

    @typed
    def drawn(seed: int, share: float = 1.0, *more: Any) -> tuple[Any, ...]:
        return seed, share, *more

    @typed
    def kept(one: Any) -> Any:
        return one

    taken = drawn(np.int64(3), np.float32(0.5), np.int64(4))
    assert taken == (3, 0.5, 4)
    assert [type(one) for one in taken] == [int, float, np.int64]
    assert kept(np.float32(0.5)).dtype == np.float32  # where anything is taken, it is taken as it is
    assert type(drawn(1, share=np.int32(2))[1]) is int
    for odd in (np.float64(3.0), np.True_, np.array([3])):
        with pytest.raises(JumpcadError, match=r"drawn\(\) takes a whole number as seed"):
            drawn(odd)  # type: ignore[arg-type]


def test_a_robot_without_parts_is_not_exported(tmp_path: Path) -> None:
    with pytest.raises(JumpcadError, match=r"takes a Robot or a Design, not <Mechanism"):
        jumpcad.export(CAPSULE, tmp_path / "out")
