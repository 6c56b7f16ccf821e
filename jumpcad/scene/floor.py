"""A floor with stripes of a known width, as a scale, under a picture of a robot, and a caption."""

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from jumpcad.scene.camera import Camera
from jumpcad.transforms import Array

STRIPE_M = 0.1
STRIPES = (232, 234, 237), (212, 215, 220)
INK = (70, 74, 80)
BESIDE_M = 0.03
"""How far the floor extends beyond what stands on it."""
LETTERS = 20
"""Height of a picture over its font size."""
WHITE = 255


def with_floor(picture: Image.Image, camera: Camera, frame_m: Array, caption: str) -> Image.Image:
    """Return a picture with a floor behind the robot and a caption in its upper left corner.

    Parameters
    ----------
    picture
        On a white background, as seen by the camera.
    camera
        The picture's camera.
    frame_m
        Points (n, 3) that the picture shows; the floor lies below them at z = 0.
    caption
        One line.
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
    pen.text((letters // 2, letters // 2), caption, fill=INK, font=ImageFont.load_default(letters))
    empty = (np.asarray(picture) == WHITE).all(axis=2)
    return Image.composite(floor, picture, Image.fromarray(np.where(empty, 255, 0).astype(np.uint8)))
