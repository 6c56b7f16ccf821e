"""What lies on the trays: sizes by hand from the catalogue, seats apart from each other."""

import itertools
from dataclasses import replace

import pytest
import shapely

from jumpcad.catalogue import load_catalogue
from jumpcad.robot.electronics.place import Electronics

CATALOGUE = load_catalogue()
CARRIED = Electronics(CATALOGUE.batteries["lipo-2s-180"], CATALOGUE.boards["xiao-esp32c3"], CATALOGUE.boards["drv8833"])


@pytest.mark.parametrize(("wall_mm", "play_mm"), [(0.8, 0.2), (0.54, 0.14), (0.8, 0.35), (1.2, 0.2), (1.2, 0.5)])
def test_what_lies_on_a_tray_has_its_own_place_between_the_plates(wall_mm: float, play_mm: float) -> None:
    """And the tray, which is narrower by its play, has a printable wall around and between all slots."""
    parts = CATALOGUE.components
    full = replace(
        CARRIED, regulator=CATALOGUE.boards["s7v7f5"],
        components={"plug": parts["jst-ph-2"], "capacitor": parts["electrolytic-100uf"]},
        wall_mm=wall_mm, play_mm=play_mm,
    )  # fmt: skip
    inside = (-full.width_mm / 2.0, full.width_mm / 2.0)
    boxes = {
        role: shapely.box(s.x_mm - s.size_mm[0] / 2, s.y_mm - s.size_mm[1] / 2, s.x_mm + s.size_mm[0] / 2,
                          s.y_mm + s.size_mm[1] / 2)
        for role, s in full.seats(inside).items()
    }  # fmt: skip
    slots = [shapely.box(x - w / 2, y - h / 2, x + w / 2, y + h / 2)
             for pairs in full.tie_slots(inside).values() for x, y, (w, h) in pairs]  # fmt: skip
    tray = shapely.box(-full.length_mm / 2, inside[0] + play_mm, full.length_mm / 2, inside[1] - play_mm)
    upper = [box for role, box in boxes.items() if role != "battery"]
    assert len(upper) == 5
    assert len(slots) == 10
    assert all(tray.covers(box) for box in boxes.values())
    assert all(tray.buffer(1e-6 - wall_mm).covers(slot) for slot in slots)
    assert all(one.distance(other) > wall_mm - 1e-6 for one, other in itertools.combinations(slots, 2))
    for one, other in itertools.combinations([*upper, *slots], 2):
        assert one.intersection(other).area < 1e-6
