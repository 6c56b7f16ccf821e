"""Pictures of assembly: few colours, near those drawn."""

import numpy as np
import pytest
from PIL import Image

from jumpcad.bundle import step_pictures as module
from jumpcad.bundle.step_pictures import paletted


def test_a_palette_keeps_the_ground_and_changes_no_colour_visibly() -> None:
    """A ramp of all shades of one colour, and greys that are nearly white, on a white ground."""
    shades = np.full((40, 256, 3), 255, dtype=np.uint8)
    shades[10:20] = np.linspace(224, 254, 256)[:, None]
    shades[20:] = np.arange(256)[:, None] * np.array([1.0, 0.6, 0.2])
    picture = paletted(Image.fromarray(shades))
    assert picture.mode == "P"
    assert len(picture.getcolors() or []) <= 256
    drawn, seen = (shades.astype(int), np.asarray(picture.convert("RGB")).astype(int))
    assert (seen[:10] == 255).all()
    assert np.abs(seen - drawn).max() <= 16


@pytest.mark.parametrize("ground", [(255, 255, 255), (250, 249, 251), (10, 20, 30)])
def test_a_ground_that_is_rare_keeps_its_colour_and_changes_no_other(ground: tuple[int, int, int]) -> None:
    """One row of it, and shades of another colour and light greys."""
    shades = np.full((40, 256, 3), ground, dtype=np.uint8)
    shades[1:20] = np.arange(256)[:, None] * np.array([1.0, 0.6, 0.2])
    shades[20:] = np.linspace(224, 254, 256)[:, None]
    seen = np.asarray(paletted(Image.fromarray(shades)).convert("RGB")).astype(int)
    assert (seen[0] == ground).all()
    assert np.abs(seen - shades.astype(int)).max() <= 16


def test_details_are_drawn_smaller_than_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    views = [("step-1", "whole"), ("step-1-pads", "pads"), ("step-12", "other"), ("step-12-springs", "springs")]
    monkeypatch.setattr(module, "named_views", lambda robot: views)
    monkeypatch.setattr(module, "_picture", lambda view, number, scene, size: (view, size))
    found = module.step_pictures(None, (), None)  # type: ignore[arg-type]
    large, small = found["step-1"][1], found["step-1-pads"][1]
    assert found == {name: (view, small if name.count("-") == 2 else large) for name, view in views}
    assert small[0] < large[0]
