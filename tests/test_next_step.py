"""What limits cost, against a problem whose multipliers are known."""

from dataclasses import replace

import numpy as np
import pytest
from support.built import built

from jumpcad import next_step
from jumpcad.findings import Finding, at_most
from jumpcad.next_step import ALL, next_steps
from jumpcad.simulation import simulate


def test_shadow_prices_of_a_linear_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    """Way = 0.4 m·(use of a) + 0.1 m·(use of b): 5 % more of a is worth 20 mm, of b 5 mm, of both 25 mm, of c nothing.

    Within its limits it gains the 4 and 2 mm that are left of both. d goes with a: alone neither is worth anything.
    """
    robot = built("kenan-2.0")
    start, here = np.array(robot.design.to_vector()), next_step._way_m(robot)
    slopes = np.zeros((4, 8))
    slopes[0, 4], slopes[1, 6], slopes[2, 0], slopes[3, 4] = 2.0, 2.0, 1.0, 2.0
    uses = np.array([0.99, 0.98, 0.97, 0.91])

    def figures(vector: np.ndarray, *_: object) -> np.ndarray:
        more = slopes @ (vector / start - 1.0)
        return np.array([here + 0.4 * more[0] + 0.1 * more[1], *(uses + more)])

    def near(*used: float) -> list[Finding]:
        return [at_most(name, use, 1.0, "", "", "") for name, use in zip("dcba", used[::-1], strict=True)]

    monkeypatch.setattr(next_step, "_figures", figures)
    (both, first, second, gram), within_mm = next_steps(robot, near(*uses))
    assert (both.limit, first.limit, first.number, second.limit) == (ALL, "a", "compression_ratio", "b")
    assert (both.gain_mm, first.gain_mm, second.gain_mm, within_mm) == pytest.approx((25.0, 20.0, 5.0, 6.0), rel=1e-6)
    assert first.change == pytest.approx(0.025)
    uses[3] = 0.99
    assert [one.limit for one in next_steps(robot, near(*uses))[0]] == [ALL, "b", ""]
    lighter = replace(robot.bodies["body"], mass_kg=robot.bodies["body"].mass_kg - 0.001)
    jumps = [
        simulate(one, engine="planar") for one in (robot, replace(robot, bodies={**robot.bodies, "body": lighter}))
    ]
    gained_mm = 1000.0 * (jumps[1].touchdown_distance_m - jumps[0].touchdown_distance_m)
    assert gram.gain_mm == pytest.approx(gained_mm, abs=0.2)
