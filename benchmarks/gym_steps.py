"""Steps a second of the environment `JumpEnv`, by start and control: `python benchmarks/gym_steps.py [STEPS]`."""

import sys
import time

import jumpcad


def main(steps: int) -> None:
    """Print CPU time of resets and of steps with random actions."""
    for start in ("loaded", "lying"):
        for control in ("switch", "torque"):
            env = jumpcad.JumpEnv(start=start, control=control)
            env.action_space.seed(0)
            begun = time.process_time()
            env.reset(seed=0)
            reset = time.process_time()
            for _ in range(steps):
                *_, over, _ = env.step(env.action_space.sample())
                if over:
                    env.reset()
            rate = steps / (time.process_time() - reset)
            took_ms = 1000.0 * (reset - begun)
            print(f"{start:<7} {control:<7} reset {took_ms:4.0f} ms, {rate:5.0f} steps a second of 50 ms")


if __name__ == "__main__":
    main(int(sys.argv[1]) if sys.argv[1:] else 1000)
