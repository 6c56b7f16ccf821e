"""Articles of the catalogue: rules that every motor, bearing, battery and board keeps."""

from contextlib import nullcontext

import pytest
from pydantic import TypeAdapter, ValidationError
from support.documented import documented_ranges, wrongly_taken

from jumpcad.catalogue import load_catalogue
from jumpcad.catalogue.articles import Volts


def test_shipped_parts_keep_the_rules_of_own_ones() -> None:
    shipped = load_catalogue()
    parts = [part for kind in ("motors", "bearings", "batteries", "boards") for part in getattr(shipped, kind).values()]
    assert not [wrong for part in parts for wrong in part.contradictions()]
    assert all(part.source for part in parts)


def test_numbers_of_ones_own_parts_may_be_what_the_reference_tells() -> None:
    ranges = {"motors": 18, "bearings": 5, "batteries": 11, "boards": 14, "springs": 7, "pads": 5}
    for kind, count in ranges.items():
        assert len(documented_ranges(f"{kind}.NAME")) == count, kind
        assert wrongly_taken(f"{kind}.NAME", type(next(iter(getattr(load_catalogue(), kind).values())))) == []


@pytest.mark.parametrize(("volts", "taken"), [((3.0, 3.001), True), ((3.0, 3.0), False), ((4.2, 3.0), False)])
def test_a_range_of_voltages_has_room_between_its_ends(volts: tuple[float, float], taken: bool) -> None:
    with nullcontext() if taken else pytest.raises(ValidationError, match=r"must be \[lowest, highest\] in volts"):
        assert TypeAdapter(Volts).validate_python(volts) == volts
