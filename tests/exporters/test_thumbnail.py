"""The thumbnail of a print plate: the whole bed, and on it the parts where they are printed, in their colour."""

import io

import numpy as np
from PIL import Image

from jumpcad.coupon.pieces import Piece
from jumpcad.exporters.threemf import thumbnail
from jumpcad.printing.plates import packed
from jumpcad.solids.outline import rectangle
from jumpcad.solids.stack import Stack

BED_MM = (240.0, 130.0, 180.0)


def seen(*sides_mm: float, bed_mm: tuple[float, float, float] = BED_MM) -> tuple[np.ndarray, np.ndarray]:
    """Return where a picture of flat square parts shows anything, and where it shows parts: not grey."""
    flat = [Stack.of([(0.0, 1.0, rectangle((side, side)))]) for side in sides_mm]
    parts = [Piece(f"part_{number}", "PLA", shape) for number, shape in enumerate(flat)]
    (plate,) = packed(parts, bed_mm, 5.0)
    image = Image.open(io.BytesIO(thumbnail(plate, bed_mm)))
    assert image.format == "PNG"
    assert image.size == (256, 256)
    pixels = np.asarray(image.convert("RGB"), dtype=float)
    return (np.abs(pixels - pixels[0, 0]).max(axis=2) > 8.0), np.ptp(pixels, axis=2) > 40.0


def test_the_same_plate_gives_the_same_picture() -> None:
    one, other = seen(30.0, 20.0), seen(30.0, 20.0)
    assert all((a == b).all() for a, b in zip(one, other, strict=True))
