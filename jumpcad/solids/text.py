"""Letters as regions, for engraving."""

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from manifold3d import CrossSection, FillRule

from jumpcad.errors import JumpcadError
from jumpcad.solids.outline import SAGITTA_MM, Region
from jumpcad.transforms import Array

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

FONT = "DejaVuSans-Bold.ttf"  # shipped with the plotting library, so the same letters everywhere
TRACED_AT = 100.0  # size at which letters are traced: large enough for smooth curves, small enough for few corners


@lru_cache(maxsize=256)
def text(label: str, height_mm: float) -> Region:
    """Return a line of text with capitals of a given height, from the origin along +x, standing on y = 0.

    Letters that the font lacks are left out: see `engravable`.
    """
    label = engravable(label)
    contours, x = [], 0.0
    for letter in label:
        advance, polygons = _letter(letter)
        contours += [polygon + np.array([x, 0.0]) for polygon in polygons]
        x += advance
    if not contours or not height_mm > 0:
        raise JumpcadError(f"text {label!r} of height {height_mm:g} mm cannot be engraved: give letters and a height")
    capital = max(float(polygon[:, 1].max()) for polygon in _letter("H")[1])
    letters = CrossSection(contours, FillRule.NonZero).scale((height_mm / capital, height_mm / capital))
    return letters.simplify(SAGITTA_MM)


def engravable(label: str) -> str:
    """Return the letters of a label that the font has: Latin, Greek, Cyrillic and some others."""
    known = _font().get_charmap()
    return "".join(letter for letter in label if ord(letter) in known)


@lru_cache(maxsize=1)
def _font() -> "FT2Font":
    import matplotlib  # takes a tenth of a second, and most robots that are built have no name
    from matplotlib.ft2font import FT2Font

    font = FT2Font(str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / FONT))
    font.set_size(TRACED_AT, 72)
    return font


@lru_cache(maxsize=256)
def _letter(letter: str) -> tuple[float, list[Array]]:
    """Return the advance width of a letter, and its closed contours (n, 2)."""
    from matplotlib.ft2font import LoadFlags
    from matplotlib.path import Path as Curve

    font = _font()
    glyph = font.load_char(ord(letter), flags=LoadFlags.NO_HINTING)
    vertices, codes = font.get_path()
    polygons = [np.asarray(polygon) for polygon in Curve(vertices, codes).to_polygons()] if len(vertices) else []
    return glyph.linearHoriAdvance / 65536.0, polygons
