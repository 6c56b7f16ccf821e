"""The environment of Gymnasium: its checker, the law of what it rewards, and who is refused."""

import math
import subprocess
import sys

import numpy as np
import pytest
from support import needs
from support.built import built
from support.workshops import workshop_with

import jumpcad
from jumpcad.environment import LEFT, RELEASE, WAIT, WIND
from jumpcad.errors import JumpcadError
from jumpcad.landing.obstacles import Obstacle
from jumpcad.workshop import load_workshop

gymnasium = needs.package("gymnasium")
WALL = {"kind": "wall", "at_m": (0.3, 0.0), "height_mm": 300.0}
NAMES = list(jumpcad.JumpEnv.OBSERVATIONS)


def of(observed: np.ndarray, name: str) -> float:
    return float(observed[NAMES.index(name)])


def test_gymnasium_s_checker_finds_nothing_wrong() -> None:
    from gymnasium.utils.env_checker import check_env

    kenan = built("kenan-2.0")
    for options in (
        {"steps_mm": (10.0, 60.0), "render_mode": "rgb_array", "picture": (120, 80), "obstacles": [WALL]},
        {"start": "lying", "control": "torque", "target_m": (2.0,)},
    ):
        check_env(jumpcad.JumpEnv(kenan, **options), skip_render_check=False)


def test_the_rewards_of_a_jump_are_its_way_and_its_height_that_of_the_simulation() -> None:
    """Nothing moves before the release; then the centre of mass rises as `simulate` says."""
    env = jumpcad.JumpEnv(built("kenan-2.0"), episode_s=3.0, step_s=0.01)
    first, _ = env.reset(seed=0)
    assert of(first, "loaded") == pytest.approx(1.0, abs=0.01)
    for _ in range(10):
        rested, way, *_ = env.step(WAIT)
        assert way == pytest.approx(0.0, abs=1e-4)
    observed, way, _, _, _ = env.step(RELEASE)
    heights, ways, over = [of(observed, "height")], [way], False
    while not over:
        observed, way, _, over, figures = env.step(WAIT)
        heights.append(of(observed, "height"))
        ways.append(way)
    jump = jumpcad.simulate(built("kenan-2.0"), engine="mujoco")
    assert max(heights) - of(rested, "height") == pytest.approx(jump.com_rise_m, abs=0.004)
    assert sum(ways) > 0.5 * (jump.ballistic_range_m or 0.0)
    assert figures["time_s"] == pytest.approx(3.0)


def test_winding_takes_the_drives_time_and_the_cam_releases_nothing_before() -> None:
    robot = built("kenan-2.0")
    env = jumpcad.JumpEnv(robot, start="standing")
    env.reset(seed=0)
    observed, *_ = env.step(WIND)
    for _ in range(5):
        observed, *_ = env.step(RELEASE)
    assert 0.0 < of(observed, "loaded") < 0.1
    steps = 1
    while of(observed, "loaded") < 0.98:
        observed, *_ = env.step(WIND)
        steps += 1
    assert 0.05 * steps == pytest.approx(robot.layout.drive.train.winding_s, rel=0.05)


def test_the_distance_of_a_step_falls_by_the_way_made() -> None:
    env = jumpcad.JumpEnv(built("kenan-2.0"), steps_mm=(40.0, 40.0))
    first, _ = env.reset(seed=3)
    assert of(first, "step_height") == pytest.approx(0.04)
    observed, way, *_ = env.step(RELEASE)
    for _ in range(20):
        observed, more, *_ = env.step(WAIT)
        way += more
    assert of(first, "step_ahead") - of(observed, "step_ahead") == pytest.approx(way, abs=1e-5)


def test_a_step_bears_what_falls_on_it() -> None:
    """With its front far behind the robot, the floor is the step's top: what rests there is higher by its height."""
    heights = []
    for height in (0.0, 0.2):
        env = jumpcad.JumpEnv(built("kenan-2.0"), steps_mm=(1.0, 1.0), start="standing")
        env.reset(seed=0)
        arena = env.unwrapped._arena
        arena.put(np.array([1.0, 0.0, 0.0, 0.0]), height + 0.01, np.zeros(3), np.zeros(3))
        arena.place(0, Obstacle(kind="step", at_m=(-1.0, 0.0), height_mm=1000.0 * height) if height else None)
        arena.rest()
        heights.append(float(arena.centre_of_mass_m[2]))
    assert heights[1] - heights[0] == pytest.approx(0.2, abs=0.002)


def test_a_target_rewards_what_comes_nearer_and_ends_the_episode_there() -> None:
    """The rewards of a jump are by how much its distance from the target fell; 1 more where it ends."""
    env = jumpcad.JumpEnv(built("kenan-2.0"), target_m=(0.45, 0.0), step_s=0.02)
    observed, _ = env.reset(seed=0)
    assert (of(observed, "target_ahead"), of(observed, "target_left")) == pytest.approx((0.45, 0.0), abs=1e-5)
    rewards, there, over = 0.0, False, False
    while not (there or over):
        observed, reward, there, over, _ = env.step(RELEASE)
        rewards += reward
    left_m = math.hypot(of(observed, "target_ahead"), of(observed, "target_left"))
    assert there
    assert left_m <= 0.35
    assert rewards == pytest.approx(0.45 - left_m + 1.0, abs=1e-5)


def test_a_wall_is_where_it_is_placed_and_stops_a_jump() -> None:
    env = jumpcad.JumpEnv(built("kenan-2.0"), episode_s=2.0)
    ways = []
    for obstacles in ([], [WALL], [WALL | {"at_m": (-0.3, 0.0), "facing_deg": 180.0}]):
        env.reset(seed=0, options={"obstacles": obstacles})
        ways.append(sum(env.step(RELEASE)[1] for _ in range(40)))
    assert ways[1] < ways[0] - 0.02
    assert ways[2] == pytest.approx(ways[0], abs=1e-6)


@pytest.mark.thorough
def test_a_wheel_is_a_second_action_that_turns_the_target_aside() -> None:
    shop = workshop_with(load_workshop("best-jumper"), steering={"wheel": "o-ring"})
    env = jumpcad.JumpEnv(jumpcad.build(jumpcad.load_design("best-jumper"), shop), target_m=(2.0, 0.0))
    env.reset(seed=0)
    for _ in range(20):
        observed, *_ = env.step((WAIT, LEFT))
    angle = math.degrees(math.atan2(of(observed, "target_left"), of(observed, "target_ahead")))
    assert -20.0 < angle < -8.0  # to the right of a robot that turned left by some 15°/s for 1 s
    with pytest.raises(JumpcadError, match=r"the wheel's 0 \(stand\), 1 \(left\) or 2 \(right\)"):
        env.step(WAIT)


def test_seeds_decide_and_robots_as_made_are_not_alike() -> None:
    env = jumpcad.JumpEnv(built("kenan-2.0"), made=3)
    seen: dict[int, list[float]] = {}
    for seed in (1, 2, 3, 4, 1):
        env.reset(seed=seed)
        observed, *_ = env.step(RELEASE)
        assert seen.setdefault(seed, observed.tolist()) == observed.tolist()
    assert len({tuple(one) for one in seen.values()}) > 1


def test_several_are_stepped_together() -> None:
    envs = gymnasium.make_vec("Jump-v0", num_envs=2, vectorization_mode="sync", robot=built("kenan-2.0"))
    observed, _ = envs.reset(seed=0)
    assert observed.shape == (2, len(NAMES))
    assert envs.step(np.array([WAIT, RELEASE]))[0].shape == (2, len(NAMES))


def test_wrong_arguments_are_one_line() -> None:
    for options, words in (
        ({"start": "flying"}, "start = 'flying': must be one of 'loaded', 'standing', 'lying'"),
        ({"control": "will"}, "control = 'will'"),
        ({"steps_mm": (60.0, 10.0)}, "must be the least and the largest height"),
        ({"step_s": 0.0}, "step_s = 0: must be above 0"),
        ({"step_s": None}, r"JumpEnv\(\) takes a number as step_s, not None"),
        ({"target_m": (1.0, 2.0, 3.0)}, "target_m = .*: must be x and y, or one distance"),
        ({"picture": (0, 10)}, "picture = .*: must be width and height, 16 to 4096 pixels"),
        ({"obstacles": [{"kind": "hole"}]}, "'bar', 'step' or 'wall'"),
        ({"steps_mm": (1.0,)}, "must be the least and the largest height"),
        ({"workshop": "default"}, "takes a Workshop"),
    ):
        with pytest.raises(JumpcadError, match=words):
            jumpcad.JumpEnv(built("kenan-2.0"), **options)
    for control, actions in (("switch", (3, 0.5, "x", None)), ("torque", (math.nan, [], [0.0, 0.0], "x"))):
        env = jumpcad.JumpEnv(built("kenan-2.0"), control=control)
        env.reset(seed=0)
        for action in actions:
            with pytest.raises(JumpcadError, match=r"action = .*: must be"):
                env.step(action)


def test_without_gymnasium_the_way_to_install_it_is_said() -> None:
    code = "import sys; sys.modules['gymnasium'] = None; import jumpcad; jumpcad.JumpEnv()"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert 'JumpEnv needs Gymnasium: pip install "jumpcad[gym]"' in done.stderr


def test_nothing_is_rewarded_or_shown_before_an_episode_begins() -> None:
    env = jumpcad.JumpEnv(built("kenan-2.0"), render_mode="rgb_array")
    for ask in (lambda: env.step(WAIT), env.render):
        with pytest.raises(gymnasium.error.ResetNeeded, match=r"call reset\(\) first"):
            ask()
    with pytest.raises(JumpcadError, match=r"takes a table as options, not 5"):
        env.reset(options=5)  # type: ignore[arg-type]
    for obstacles, words in ((3, r"takes a list of .* as obstacles, not 3"), ([WALL | {"at_m": (0.0, 0.0)}], "stands")):
        with pytest.raises(JumpcadError, match=words):
            env.reset(options={"obstacles": obstacles})
    with pytest.raises(JumpcadError, match=r"made = -1: must be at least 0"):
        jumpcad.JumpEnv(built("kenan-2.0"), made=-1)
