"""Pictures of assembly: few colours, near those drawn."""

import numpy as np
from PIL import Image

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
