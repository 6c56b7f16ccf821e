"""When and where to release on steps of random height: simple rules against chance, in the environment JumpEnv.

python examples/when_to_release.py [--episodes 20] [--robot kenan-2.0]; needs Gymnasium: pip install ".[gym]"

Every rule winds until the springs are loaded. One then releases at once, one waits until the robot stands still on its
feet, and one also holds its jump where a step stands within the jump's range that is too high to land on.
"""

import argparse
from collections.abc import Callable

import numpy as np

import jumpcad

WAIT, WIND, RELEASE = range(3)
Seen = dict[str, float]

parser = argparse.ArgumentParser()
parser.add_argument("--episodes", type=int, default=20)
parser.add_argument("--robot", default="kenan-2.0")
asked = parser.parse_args()

env = jumpcad.JumpEnv(asked.robot, start="standing", steps_mm=(0.0, 60.0), made=4, episode_s=30.0)
jump = jumpcad.simulate(env.robot)
reach_m, lands_on_m = jump.ballistic_range_m or 0.0, (jump.lands_on_mm or 0.0) / 1000.0
rng = np.random.default_rng(0)


def stands_still(seen: Seen) -> bool:
    return seen["foot_up"] > 0.94 and abs(seen["velocity_x"]) + abs(seen["velocity_z"]) < 0.02


def is_free(seen: Seen) -> bool:
    return not (0.0 < seen["step_ahead"] < reach_m and seen["step_height"] > lands_on_m)


def way_mm(act: Callable[[Seen], int], episode: int) -> float:
    """Return how far the robot comes in an episode (mm)."""
    observed, _ = env.reset(seed=episode)
    way, over = 0.0, False
    while not over:
        seen = dict(zip(jumpcad.JumpEnv.OBSERVATIONS, observed.tolist(), strict=True))
        observed, reward, _, over, _ = env.step(act(seen))
        way += 1000.0 * reward
    return way


def rule(ready: Callable[[Seen], bool]) -> Callable[[Seen], int]:
    """Wind, then release when ready."""
    return lambda seen: WIND if seen["loaded"] < 0.98 else RELEASE if ready(seen) else WAIT


agents = {
    "by chance": lambda seen: int(rng.integers(3)),
    "at once": rule(lambda seen: True),
    "still on its feet": rule(stands_still),
    "and not against steps": rule(lambda seen: stands_still(seen) and is_free(seen)),
}
for name, act in agents.items():
    ways = [way_mm(act, episode) for episode in range(asked.episodes)]
    print(f"{name:<22} {np.mean(ways):5.0f} mm in 30 s, from {min(ways):.0f} to {max(ways):.0f}")
