"""Stacks with the usual difficulties: shared, nearly shared and crossing outlines, pockets, bores, chamfers."""

from dataclasses import replace

import numpy as np

from jumpcad.solids.outline import disc, hole, polygon, rectangle, stadium, tapered_bar
from jumpcad.solids.stack import Stack

HOLED = Stack.of([(0, 3, rectangle((40, 30), (5, 0)) - hole(3.4, (-8, 6))), (0, 9, disc(12, (12, 2)))])
"""A plate with a hole, and a round boss three times as high."""


def random_stack(rng: np.random.Generator) -> Stack:
    """Return a part of round bars with a pocket, bores and a chamfer, turned by any angle."""
    p, q, width = rng.uniform(-30, 30, 2), rng.uniform(-30, 30, 2), rng.uniform(6, 14)
    z = np.round(rng.uniform(1, 5, 3), 2).cumsum()
    slabs = [
        (0.0, z[0], stadium(p, q, width)),
        (0.0, z[1], disc(width + rng.uniform(-1, 3), p)),
        (0.0, z[2], disc(width - 1, q)),
        (z[0], z[1], tapered_bar(p, q, width * rng.choice([1.0, 0.8]), width)),
    ]
    pocket = polygon(q + rng.uniform(-4, 4, (3, 2)))
    cuts = [(z[0] - 0.5, z[2], hole(4.0, q)), (z[1] - rng.choice([0.0, 0.3]), z[2], pocket)]
    whole, turn_deg = Stack.of(slabs).through(hole(3.2, p)).minus(cuts).chamfered(0.35, 0.2), rng.uniform(0, 360)
    return Stack(tuple(replace(slab, outline=slab.outline.rotate(turn_deg)) for slab in whole.slabs))
