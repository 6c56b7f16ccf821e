"""An error is one line, whatever it quotes."""

import pickle

import pytest

from jumpcad.errors import CannotBuildError, JumpcadError


def test_an_error_is_one_line_whatever_it_quotes() -> None:
    told = str(JumpcadError("a\nb\x1b[31m\0\u2028\ud800: no such file"))
    assert told == r"a\nb\x1b[31m\x00\u2028\ud800: no such file"


def test_errors_pass_from_worker_to_worker() -> None:
    for kind in (JumpcadError, CannotBuildError):
        again = pickle.loads(pickle.dumps(kind("too\tlong")))
        assert (type(again), str(again), again.exit_code) == (kind, r"too\tlong", kind.exit_code)


def test_a_wrong_request_is_two_and_a_design_that_cannot_be_built_is_one() -> None:
    """The exit codes that docs/commands.md names."""
    assert (JumpcadError("x").exit_code, CannotBuildError("x").exit_code) == (2, 1)


@pytest.mark.parametrize(("room_mm", "margin_mm"), [(-2.5, -2.5), (1e-9, 0.0), (None, None)])
def test_what_cannot_be_built_never_has_room_left(room_mm: float | None, margin_mm: float | None) -> None:
    """Where a place is measured twice, rounding may leave a little room that was not there."""
    assert CannotBuildError("x", "room", room_mm).margin == margin_mm
