"""Bundles with few pictures of their kinds, for tests of what becomes of them."""

import pytest

from jumpcad.bundle import renders, step_pictures


def with_few_pictures(patch: pytest.MonkeyPatch, frames: int = 3) -> None:
    """Draw a jump in few pictures, and three steps of the assembly."""
    views = step_pictures.named_views
    patch.setattr(renders, "JUMP_FRAMES", frames)
    patch.setattr(step_pictures, "named_views", lambda robot: views(robot)[:3])
