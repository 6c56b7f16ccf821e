"""Counts in words."""

import pytest

from jumpcad.plural import counted


@pytest.mark.parametrize(
    ("number", "noun", "words"),
    [
        (0, "design", "0 designs"),
        (1, "design", "1 design"),
        (2, "design", "2 designs"),
        (1, "parameter free", "1 parameter free"),
        (8, "parameter free", "8 parameters free"),
    ],
)
def test_one_is_singular_and_all_else_plural(number: int, noun: str, words: str) -> None:
    assert counted(number, noun) == words
