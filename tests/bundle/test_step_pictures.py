"""Pictures of assembly: front and left are marked as they are seen; few colours, near those drawn."""

import numpy as np
import pytest
from PIL import Image
from support.built import built

from jumpcad.bundle import renders
from jumpcad.scene.camera import aimed
from jumpcad.scene.renderer import paletted


def test_every_picture_marks_where_front_and_left_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """As a camera sees a point ahead of the robot, and one to the left of it, against the picture's middle."""
    marked: list[dict[str, np.ndarray]] = []
    monkeypatch.setattr(renders, "labelled", lambda picture, *_: marked.append(_[-1]) or picture)

    class Blank:
        def picture(self, _poses: object, size: tuple[int, int], *_: object) -> Image.Image:
            return Image.new("RGB", size)

    robot = built("kenan-2.0")
    views = [view for _, view in renders.named_views(robot)]
    numbers = {thing.name: index for view in views for index, thing in enumerate(view.things)}
    for view in views:
        renders._picture(view, dict.fromkeys(numbers, 0), Blank(), (560, 520))  # type: ignore[arg-type]
    assert len(marked) == len(views) > 20
    for view, marks in zip(views, marked, strict=True):
        middle = view.frame_m.mean(axis=0)
        (camera, size), step = (aimed(view.frame_m, view.view, 1.0), (500, 500)), 0.001 * np.eye(3)
        seen = camera.seen(np.array([middle, middle + step[0], middle + step[1]]), size)[0]
        for way, (name, mark) in zip(seen[1:] - seen[0], marks.items(), strict=True):
            assert mark @ way > 0.99 * np.hypot(*way) * np.hypot(*mark), (view.title, name)
        assert [*marks] == ["front", "left"]


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
