"""`jumpcad simulate --uncertain`: what is asked of the simulation, and its answer in lines of text."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any

import pytest

from jumpcad.cli import uncertain as module
from jumpcad.cli.uncertain import uncertain, uncertain_lines
from jumpcad.simulation.uncertain import FIGURES

FOUND = {
    "calibrated": True, "jumps": 128, "jumps_share": 0.953,
    "quantiles": {"ballistic_range_m": [0.1, 0.2004, 0.3006], "com_rise_m": [0.05, 0.06, 0.0701]},
    "first_order": {
        "mass": {"ballistic_range_m": 0.1, "com_rise_m": 0.3},
        "lengths": {"ballistic_range_m": 0.05, "com_rise_m": 0.95},
        "floor": {"ballistic_range_m": 0.804, "com_rise_m": 0.206},
    },
}  # fmt: skip
"""A figure's three quantiles are apart, so that none can stand for another."""


def lines_of(**changed: Any) -> list[str]:
    """Return the lines of a result with other values, blanks joined."""
    return [" ".join(line.split()) for line in uncertain_lines(FOUND | changed)]


def test_quantiles_are_told_in_whole_millimetres_from_the_least_to_the_largest() -> None:
    assert lines_of()[1:3] == ["range 100…200…301 mm", "rise 50…60…70 mm"]
    assert [*FIGURES.values()] == ["range", "rise"]


@pytest.mark.parametrize(
    ("calibrated", "jumps", "told"),
    [
        (True, 128, "uncertainty (128 jumps, the calibration's draws), quantiles 10…50…90 %:"),
        (False, 1, "uncertainty (1 jump, the priors of a calibration: none was given), quantiles 10…50…90 %:"),
    ],
)
def test_the_first_line_says_what_was_drawn_from(calibrated: bool, jumps: int, told: str) -> None:
    assert lines_of(calibrated=calibrated, jumps=jumps)[0] == told


def test_shares_are_told_with_the_largest_of_the_range_first() -> None:
    """Of range, of rise, whatever the order in which they come."""
    shown = ["floor 0.80, 0.21", "mass 0.10, 0.30", "lengths 0.05, 0.95"]
    assert lines_of()[-3:] == shown
    assert lines_of()[-4] == "first-order indices: share of the variance of range, of rise"
    backwards = dict(reversed(FOUND["first_order"].items()))  # type: ignore[attr-defined]
    assert lines_of(first_order=backwards)[-3:] == shown


@pytest.mark.parametrize(("share", "told"), [(1.0, []), (0.996, ["100 %"]), (0.953, ["95 %"]), (0.0, ["0 %"])])
def test_how_many_jump_is_told_where_not_all_do(share: float, told: list[str]) -> None:
    lines = lines_of(jumps_share=share)
    assert [line.removeprefix("jumps at all ") for line in lines if "at all" in line] == told
    assert len(lines) == 1 + 2 + len(told) + 1 + 3
    assert not told or lines.index(f"jumps at all {told[0]}") == 3  # after the quantiles, in which they count as 0


def test_values_stand_below_each_other() -> None:
    """In one column, two blanks in and 36 characters on, as in the lines of a jump."""
    lines = uncertain_lines(FOUND)
    headings = [line for line in lines if not line.startswith("  ")]
    assert [lines.index(line) for line in headings] == [0, 4]
    for line in lines:
        if line not in headings:
            assert line[2] != " "
            assert line[37] == " "
            assert line[38] != " "


def test_uncertain_inputs_are_drawn_by_the_seed_and_simulated_as_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Plain data come back; meanwhile it says what it does."""
    asked: list[Any] = []
    found = SimpleNamespace(to_dict=lambda: {"jumps": 8})

    @contextmanager
    def status(doing: str) -> Iterator[None]:
        asked.append(doing)
        yield
        asked.append("done")

    monkeypatch.setattr(module, "status", status)
    monkeypatch.setattr("jumpcad.simulation.uncertain_jump", lambda *given: asked.append(given) or found)
    assert uncertain("robot", "settings", "planar", 7) == {"jumps": 8}  # type: ignore[arg-type]
    assert asked == ["simulating samples of the uncertain inputs …", ("robot", "settings", "planar", 7), "done"]
