"""What limits cost, against a problem whose multipliers are known."""

from dataclasses import replace

import numpy as np
import pytest
from support.built import built

from jumpcad import next_step
from jumpcad.findings import at_most
from jumpcad.next_step import next_steps
from jumpcad.simulation import simulate


def test_shadow_prices_of_a_linear_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    """Way = 0.4 m·(use of a) + 0.1 m·(use of b): 5 % more of a is worth 20 mm, of b 5 mm, of c nothing."""
    robot = built("kenan-2.0")
    start, here = np.array(robot.design.to_vector()), next_step._way_m(robot)
    slopes = np.zeros((3, 8))
    slopes[0, 4], slopes[1, 6], slopes[2, 0] = 2.0, 1.0, 1.0

    def figures(vector: np.ndarray, *_: object) -> np.ndarray:
        uses = np.array([0.99, 0.98, 0.97]) + slopes @ (vector / start - 1.0)
        return np.array([here + 0.4 * (uses[0] - 0.99) + 0.1 * (uses[1] - 0.98), *uses])

    monkeypatch.setattr(next_step, "_figures", figures)
    near = [at_most(name, use, 1.0, "", "", "") for name, use in (("c", 0.97), ("b", 0.98), ("a", 0.99), ("far", 0.5))]
    (first, second, gram), explained = next_steps(robot, near)
    assert (first.limit, first.number, second.limit) == ("a", "compression_ratio", "b")
    assert (first.gain_mm, first.change, second.gain_mm) == pytest.approx((20.0, 0.025, 5.0), rel=1e-6)
    assert explained == pytest.approx(1.0)
    lighter = replace(robot.bodies["body"], mass_kg=robot.bodies["body"].mass_kg - 0.001)
    jumps = [
        simulate(one, engine="planar") for one in (robot, replace(robot, bodies={**robot.bodies, "body": lighter}))
    ]
    gained_mm = 1000.0 * (jumps[1].touchdown_distance_m - jumps[0].touchdown_distance_m)
    assert gram.gain_mm == pytest.approx(gained_mm, abs=0.2)
