"""What is drawn under and over a picture: a floor as a scale, a caption, labels and arrows.

Letters of labels are polygons, the outlines of a font that comes with the plotting library: the same pixels everywhere.
"""

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from jumpcad.scene.renderer import Camera
from jumpcad.solids.outline import text
from jumpcad.transforms import Array

STRIPE_M = 0.1
STRIPES = (232, 234, 237), (212, 215, 220)
CAPTION_INK = (70, 74, 80)
BESIDE_M = 0.03
"""How far the floor extends beyond what stands on it."""
LETTERS = 20
"""Height of a picture over its font size."""
WHITE = 255


def with_floor(picture: Image.Image, camera: Camera, frame_m: Array, caption: str) -> Image.Image:
    """Return a picture on white with a floor behind the robot and a caption in its upper left corner.

    `frame_m` are points (n, 3) that the picture shows; the floor lies below them at z = 0.
    """
    floor = Image.new("RGB", picture.size, (WHITE,) * 3)
    pen = ImageDraw.Draw(floor)
    low, high = frame_m.min(axis=0) - BESIDE_M, frame_m.max(axis=0) + BESIDE_M
    for number in range(int(np.floor(low[0] / STRIPE_M)), int(np.ceil(high[0] / STRIPE_M))):
        left, right = max(low[0], number * STRIPE_M), min(high[0], (number + 1) * STRIPE_M)
        corners = np.array([[left, low[1], 0], [right, low[1], 0], [right, high[1], 0], [left, high[1], 0]])
        pixels, _ = camera.seen(corners, picture.size)
        pen.polygon([tuple(pixel) for pixel in pixels.tolist()], fill=STRIPES[number % 2])
    letters = max(8, picture.height // LETTERS)
    pen.text((letters // 2, letters // 2), caption, fill=CAPTION_INK, font=ImageFont.load_default(letters))
    empty = (np.asarray(picture) == WHITE).all(axis=2)
    return Image.composite(floor, picture, Image.fromarray(np.where(empty, 255, 0).astype(np.uint8)))


FINE = 3
"""Letters and lines are drawn this many times larger and scaled down."""
CAPITAL_PX, ROW_PX, EDGE_PX = 11.0, 24.0, 8.0
COMPASS_PX, COMPASS_ROOM_PX, COMPASS_EDGE_PX = 45.0, 100, 90.0
"""Of the arrows in the lower left corner: length across the view, height kept free, least distance from the edge."""
INK, LINE, ARROW = (25, 28, 33), (120, 125, 132), (200, 40, 30)
HEAD_PX = 9.0


def labelled(
    picture: Image.Image, names: Sequence[str], at_px: Array | Sequence[Array] = (),
    place_px: Array | Sequence[Array] = (), margin_px: int = 0, turns_px: Sequence[Array] = (),
    compass: Mapping[str, Array] = MappingProxyType({}),
) -> Image.Image:  # fmt: skip
    """Return a picture between two margins with labels.

    One name for each part (n); `at_px` and `place_px` (n, 2) are where each part is drawn, and where it goes, in pixels
    of the picture without margins: an arrow joins them where they are apart. `turns_px` are curves (k, 2), drawn as
    arrows: senses of rotation. `compass` has unit vectors (2,) of the picture by the names of their directions, drawn
    as arrows in the lower left corner.
    """
    size = (picture.width + 2 * margin_px, picture.height)
    sheet = Image.new("RGB", size, (255, 255, 255))
    sheet.paste(picture, (margin_px, 0))
    beside = np.array([margin_px, 0.0])
    ends = np.asarray(at_px, dtype=float).reshape(-1, 2) + beside
    goals = np.asarray(place_px, dtype=float).reshape(-1, 2) + beside
    large = sheet.resize((FINE * size[0], FINE * size[1]), Image.Resampling.NEAREST)
    draw = ImageDraw.Draw(large)
    for end, goal in zip(ends, goals, strict=True):
        if np.hypot(*(goal - end)) > 2.0 * HEAD_PX:
            _arrow(draw, end, goal)
    for line in turns_px:
        curve = np.asarray(line) + beside
        draw.line([tuple(FINE * point) for point in curve[:-1]], fill=ARROW, width=2 * FINE)
        _arrow(draw, curve[-3], curve[-1])
    middle = np.array([max(margin_px / 2.0, COMPASS_EDGE_PX), size[1] - COMPASS_ROOM_PX / 2.0])
    for name, direction in compass.items():
        tip = middle + COMPASS_PX * direction
        _arrow(draw, middle, tip, INK)
        _words(draw, name, tip[0] + math.copysign(EDGE_PX, direction[0]), tip[1], bool(direction[0] < 0.0))
    for name, end, (x, y), left in _rows(names, ends, size, COMPASS_ROOM_PX if compass else 0):
        _words(draw, name, x, y, left)
        start = (x + EDGE_PX, y) if left else (x - EDGE_PX, y)
        draw.line([tuple(FINE * np.array(start)), tuple(FINE * end)], fill=LINE, width=FINE)
        x, y = FINE * end
        draw.ellipse([x - 2 * FINE, y - 2 * FINE, x + 2 * FINE, y + 2 * FINE], fill=INK)
    return large.reduce(FINE)


def _rows(
    names: Sequence[str], ends: Array, size: tuple[int, int], free_px: int
) -> list[tuple[str, Array, tuple[float, float], bool]]:
    """Return for each name the end of its leader line at the part, its end at the text, and if it is on the left.

    On the left as much as `free_px` is left free below.
    """
    order: list[int] = np.argsort(ends[:, 0], kind="stable").tolist()
    half = len(order) // 2
    rows = []
    for side, indices in ((True, order[:half]), (False, order[half:])):
        indices = sorted(indices, key=lambda index: ends[index, 1])
        y = _spread([float(ends[index, 1]) for index in indices], size[1] - (free_px if side else 0))
        widest = max((_width(names[index]) for index in indices), default=0.0)
        x = EDGE_PX + widest if side else size[0] - EDGE_PX - widest
        rows += [(names[index], ends[index], (x, height), side) for index, height in zip(indices, y, strict=True)]
    return rows


def _spread(wanted: list[float], height: int) -> list[float]:
    """Return y coordinates (px) at least a row apart, near those wanted (in ascending order)."""
    placed: list[float] = []
    for want in wanted:
        placed.append(max(want, placed[-1] + ROW_PX if placed else ROW_PX))
    over = (placed[-1] - (height - ROW_PX)) if placed else 0.0
    for index in range(len(placed) - 1, -1, -1):
        limit = height - ROW_PX if index == len(placed) - 1 else placed[index + 1] - ROW_PX
        placed[index] = min(placed[index], limit) if over > 0.0 else placed[index]
    return placed


def _width(name: str) -> float:
    return float(text(name, CAPITAL_PX).bounds()[2])


def _words(draw: ImageDraw.ImageDraw, name: str, x: float, y: float, left: bool) -> None:
    """Draw a text that ends (on the left) or begins (on the right) at a point, centred in height."""
    start = x - _width(name) if left else x
    outlines = [
        FINE * np.column_stack([start + contour[:, 0], y + CAPITAL_PX / 2.0 - contour[:, 1]])
        for contour in text(name, CAPITAL_PX).to_polygons()
    ]
    # y points down: outlines run clockwise, holes counter-clockwise; holes are drawn last
    for points in sorted(outlines, key=_turn):
        draw.polygon([tuple(point) for point in points], fill=INK if _turn(points) < 0.0 else (255, 255, 255))


def _turn(points: Array) -> float:
    """Return twice the signed area of a contour (n, 2)."""
    after = np.roll(points, -1, axis=0)
    return float(np.sum(points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0]))


def _arrow(draw: ImageDraw.ImageDraw, start: Array, end: Array, colour: tuple[int, int, int] = ARROW) -> None:
    along = (end - start) / np.hypot(*(end - start))
    across = np.array([-along[1], along[0]])
    neck = end - HEAD_PX * along
    draw.line([tuple(FINE * start), tuple(FINE * neck)], fill=colour, width=2 * FINE)
    head = [end, neck + 0.45 * HEAD_PX * across, neck - 0.45 * HEAD_PX * across]
    draw.polygon([tuple(FINE * point) for point in head], fill=colour)
