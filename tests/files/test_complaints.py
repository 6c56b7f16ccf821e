"""Hints at the nearest known word."""

from jumpcad.files import (
    did_you_mean,
)


def test_hint_only_where_something_is_near() -> None:
    assert did_you_mean("kenan2", ["kenan-2.0", "best-bo"]) == " (did you mean kenan-2.0?)"
    assert did_you_mean("zzz", ["kenan-2.0", "best-bo"]) == ""
