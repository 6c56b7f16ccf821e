"""Learns to reach points anywhere around the robot, from nothing but what JumpEnv rewards, in minutes on two cores.

python examples/learn_to_steer.py [--rounds 5] [--episodes 4] [--candidates 12]; needs Gymnasium: pip install ".[gym]"

The cross-entropy method over three numbers: candidates are drawn about a mean, each tries the same points, and the best
quarter gives the next mean. The numbers weigh where the target lies; their sum turns the wheel to the left above 1, to
the right below -1, and lets the robot jump between. They begin at 0: it jumps straight on, wherever the point is.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from math import hypot
from multiprocessing import get_context

import numpy as np

import jumpcad

DESIGN = "best-steered"
AWAY_M, BEST = 1.3, 0.25
WAIT, WIND, RELEASE = range(3)
STAND, LEFT, RIGHT = range(3)


@cache
def environment() -> jumpcad.JumpEnv:
    """Return the environment, built once in each process."""
    return jumpcad.JumpEnv(jumpcad.build(DESIGN), target_m=(AWAY_M,), episode_s=60.0, step_s=0.1)


def action(seen: dict[str, float], weights: np.ndarray) -> tuple[int, int]:
    """Return what the motor does, and the wheel."""
    moves = hypot(seen["velocity_x"], seen["velocity_y"], seen["velocity_z"]) > 0.02 or not seen["touches"]
    if seen["loaded"] < 0.98:
        return (WAIT if moves else WIND), STAND
    ahead, left = seen["target_ahead"], seen["target_left"]
    away = hypot(ahead, left)
    turn = float(weights @ (left / away, ahead / away, 1.0))
    return (RELEASE, STAND) if abs(turn) < 1.0 else (WAIT, LEFT if turn > 0.0 else RIGHT)


def tried(weights: np.ndarray, episodes: range) -> tuple[float, int]:
    """Return the mean reward of some episodes, and in how many the robot reached its point."""
    env, rewards, arrived = environment(), 0.0, 0
    for episode in episodes:
        observed, _ = env.reset(seed=episode)
        there = over = False
        while not (there or over):
            seen = dict(zip(env.OBSERVATIONS, observed.tolist(), strict=True))
            observed, reward, there, over, _ = env.step(action(seen, weights))
            rewards += reward
        arrived += there
    return rewards / len(episodes), arrived


def main() -> None:
    """Learn, and try what was learnt on other points."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--episodes", type=int, default=4)
    parser.add_argument("--candidates", type=int, default=12)
    parser.add_argument("--workers", type=int, default=2)
    asked = parser.parse_args()
    rng, mean, spread = np.random.default_rng(0), np.zeros(3), np.full(3, 3.0)
    with ProcessPoolExecutor(asked.workers, get_context("spawn")) as pool:
        for number in range(asked.rounds):
            candidates = rng.normal(mean, spread, (asked.candidates, 3))
            points = range(number * asked.episodes, (number + 1) * asked.episodes)
            found = list(pool.map(tried, candidates, [points] * asked.candidates))
            order = np.argsort([-reward for reward, _ in found])
            best = candidates[order[: max(2, round(BEST * asked.candidates))]]
            mean, spread = best.mean(axis=0), best.std(axis=0) + 0.2
            print(f"round {number + 1}: rewards {found[order[0]][0]:.2f} at best, {found[order[-1]][0]:.2f} at worst, "
                  f"numbers {np.round(mean, 1)}", flush=True)  # fmt: skip
        tests = [range(10_000 + one, 10_001 + one) for one in range(5 * asked.episodes)]
        for words, weights in (("before", np.zeros(3)), ("after", mean)):
            arrived = sum(there for _, there in pool.map(tried, [weights] * len(tests), tests))
            print(f"{words} learning: {arrived} of {len(tests)} new points at {AWAY_M:g} m reached")


if __name__ == "__main__":
    main()
