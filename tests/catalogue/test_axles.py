"""Articles for axles: what a rod is of which only a bore would be said, and clips whose sizes ascend."""

import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.catalogue.axles import Clip, Rod


def test_a_rod_is_solid_where_no_bore_is_said() -> None:
    """Of the shipped ones the tube alone is bored: 3 x 0.5 mm has a bore of 2 mm."""
    plain = Rod(name="own", source="a label", description="rod", density_g_cm3=7.85, yield_mpa=400.0, grooves=True)
    assert plain.bore_share == 0.0
    bored = {name: rod.bore_share for name, rod in load_catalogue().rods.items() if rod.bore_share}
    assert bored == {"steel-tube": pytest.approx(2.0 / 3.0, rel=1e-3)}


def test_a_clip_is_wider_than_its_shaft_and_the_shaft_than_the_groove() -> None:
    """2.3 mm in a shaft of 3 mm, under a ring of 6.3 mm (DIN 6799)."""
    clip = load_catalogue().clips["2.3"]
    for groove, shaft, outer, refused in (
        (2.3, 3.0, 6.3, False), (3.0, 3.0, 6.3, True), (2.3, 6.3, 6.3, True), (2.3, 7.0, 6.3, True),
    ):  # fmt: skip
        sizes = {"name": "own", "groove_mm": groove, "shaft_mm": shaft, "outer_mm": outer}
        found = [place for place, *_ in Clip(**clip.model_dump() | sizes).contradictions()]
        assert found == [("groove_mm",)] * refused
