"""Bundles with few pictures of their kinds, and plots with less work, for tests of what becomes of them."""

import pytest
from matplotlib.layout_engine import ConstrainedLayoutEngine

from jumpcad.bundle import renders


def with_few_pictures(patch: pytest.MonkeyPatch, frames: int = 3) -> None:
    """Draw a jump in few pictures, and three steps of the assembly."""
    views = renders.named_views
    patch.setattr(renders, "JUMP_FRAMES", frames)
    patch.setattr(renders, "named_views", lambda robot: list(views(robot))[:3])


def with_plain_figures(patch: pytest.MonkeyPatch) -> None:
    """Leave panels of a plot where they are: to find places in which no two texts meet takes half of its time."""
    patch.setattr(ConstrainedLayoutEngine, "execute", lambda *_: None)
