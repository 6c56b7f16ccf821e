"""A sliced part beside its model."""

import pytest

from jumpcad.bundle.sliced import SlicedPart


def test_a_model_that_is_a_tenth_heavier_says_so() -> None:
    part = SlicedPart("main_leg", "PETG", 1, grams=10.0, modelled_grams=11.0, time_s=600.0)
    assert part.difference == pytest.approx(0.10)
