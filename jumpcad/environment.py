"""A jumping robot for reinforcement learning: an environment of Gymnasium (extra `gym`), simulated in MuJoCo."""

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np
import trimesh
from scipy.spatial.transform import Rotation

from jumpcad.arguments import check_arguments
from jumpcad.bundle.manifest import robot_of
from jumpcad.bundle.renders import JUMP_VIEW, corners_of
from jumpcad.bundle.variants import variants
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import described
from jumpcad.landing.arena import STILL_M_S, STILL_RAD_S, Arena, Floor
from jumpcad.landing.course import FARTHEST_M, WITHIN_M
from jumpcad.landing.landing import DROP_M, scattered_floor
from jumpcad.landing.obstacles import STEP_M, Obstacle
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.limits import steers
from jumpcad.robot.steering.place import Steering
from jumpcad.scene.labels import with_floor
from jumpcad.scene.renderer import Renderer, aimed
from jumpcad.scene.visuals import visuals
from jumpcad.transforms import Array, chained, pose_about_z
from jumpcad.workshop import Workshop

try:
    import gymnasium
except ImportError:  # an optional extra
    gymnasium = None  # type: ignore[assignment, unused-ignore]

if TYPE_CHECKING:
    Base = gymnasium.Env[Array, Any]
else:
    Base = gymnasium.Env if gymnasium else object

Start = Literal["loaded", "standing", "lying"]
Control = Literal["switch", "torque"]
Rendered = Literal["rgb_array", None]
WAIT, WIND, RELEASE = range(3)
"""Actions of the control `switch`."""
STAND, LEFT, RIGHT = range(3)
"""Of the steering wheel, with that control."""
OBSERVATIONS: dict[str, tuple[str, float, float]] = {
    "up_x": ("", -1.0, 1.0),
    "up_y": ("", -1.0, 1.0),
    "up_z": ("", -1.0, 1.0),
    "spin_x": ("rad/s", -200.0, 200.0),
    "spin_y": ("rad/s", -200.0, 200.0),
    "spin_z": ("rad/s", -200.0, 200.0),
    "velocity_x": ("m/s", -20.0, 20.0),
    "velocity_y": ("m/s", -20.0, 20.0),
    "velocity_z": ("m/s", -20.0, 20.0),
    "height": ("m", -1.0, 10.0),
    "heading": ("rad", -math.pi, math.pi),
    "loaded": ("", -5.0, 5.0),
    "leg_speed": ("rad/s", -500.0, 500.0),
    "foot_up": ("", -1.0, 1.0),
    "touches": ("", 0.0, 1.0),
    "step_ahead": ("m", -50.0, 50.0),
    "step_height": ("m", 0.0, 1.0),
    "target_ahead": ("m", -50.0, 50.0),
    "target_left": ("m", -50.0, 50.0),
}
"""What is observed: unit, least and largest value.

The vertical and the spin in the body's frame; velocity and height of the centre of mass; the share of the springs'
travel that is loaded, and the leg's speed; how far the foot's axis points up (1: it stands); whether anything touches
the ground; distance and height of the random step, 0 without one; where the target lies, seen from the robot, 0 without
one.
"""
LOADED = 0.98
"""Share of the travel from which the cam lets the leg go; judgement: the latch holds it within 1 %."""
STEP = Obstacle(kind="step", at_m=(0.0, 0.0), height_mm=1.0, wide_m=3.0)
"""A random step."""
STEP_AHEAD_M = (0.15, 0.6)
"""Distances of a random step from the robot's centre of mass."""
LONGEST_S = 86400.0
"""Longest episode."""
FRAME_M = np.array([[-0.2, -0.1, 0.0], [0.5, 0.1, 0.3]])
"""What a picture shows about the centre of mass, from the ground on."""
LARGEST = 4096
"""Most pixels of a picture's side."""


class JumpEnv(Base):  # type: ignore[misc, valid-type, unused-ignore]
    """One robot that is wound, released and lands, as an environment of Gymnasium.

    The reward is the way forward of the centre of mass (m); with a target, by how much nearer to it that comes, and 1
    when it is there (`WITHIN_M`) and has landed, which ends the episode (terminated). It is truncated after
    `episode_s`.

    Parameters
    ----------
    robot
        A template's name, a design or its file, or a robot.
    workshop
        In which a design is built; without, a template's own or the default.
    start
        `loaded` (held by the cam), `standing` with relaxed springs, or `lying` in any attitude; `reset` also takes it,
        as `options={"start": "lying"}`.
    control
        `switch`: 0 waits, 1 winds at the drive's own speed, 2 releases, which does nothing before the springs are
        loaded, as the cam cannot. `torque`: the share of the largest torque that loads the springs, from 0 to 1. Of a
        robot that steers there is a second value: 0 lets its wheel stand, 1 turns it to the left and 2 to the right,
        once it is wound; with `torque` it is the share of the wheel's speed, from -1 to 1.
    steps_mm
        Least and largest height of a step somewhere ahead; (0, 0): the floor is flat.
    target_m
        Where to go: x ahead and y to the left; one number: so far, in any direction; none: straight ahead, for ever.
    obstacles
        Bars, steps and walls, as tables with the fields of `jumpcad.landing.obstacles.Obstacle`; `reset` also takes
        them, as `options={"obstacles": [...]}`.
    made
        Number of robots as they may be made (`jumpcad.variants`), of which each episode takes one, on a floor of random
        friction and softness; 0: always the design's robot on the workshop's floor.
    episode_s, step_s
        Simulated time of an episode and of a step.
    render_mode
        None or `rgb_array`.
    picture
        Width and height of a picture (pixels).

    Raises
    ------
    JumpcadError
        If Gymnasium is not installed, or an argument is none of these.
    """

    OBSERVATIONS = OBSERVATIONS
    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 20}  # noqa: RUF012  Gymnasium's own type

    @check_arguments
    def __init__(
        self, robot: Robot | Design | str | Path = "kenan-2.0", workshop: Workshop | None = None,
        start: Start = "loaded", control: Control = "switch", steps_mm: Sequence[float] = (0.0, 0.0),
        target_m: Sequence[float] = (), obstacles: Sequence[Mapping[str, Any] | Obstacle] = (), made: int = 0,
        episode_s: float = 20.0, step_s: float = 0.05, render_mode: Rendered = None,
        picture: Sequence[int] = (320, 240),
    ) -> None:  # fmt: skip
        if gymnasium is None:
            raise JumpcadError('JumpEnv needs Gymnasium: pip install "jumpcad[gym]"')
        if len(steps_mm) != 2 or not 0.0 <= steps_mm[0] <= steps_mm[1] <= 1000.0 * STEP_M[1]:
            raise JumpcadError(f"steps_mm = {steps_mm}: must be the least and the largest height, 0 to 500 mm")
        if len(target_m) > 2 or not all(abs(one) <= FARTHEST_M for one in target_m):
            raise JumpcadError(f"target_m = {target_m}: must be x and y, or one distance, at most {FARTHEST_M:g} m")
        if len(picture) != 2 or not all(16 <= one <= LARGEST for one in picture):
            raise JumpcadError(f"picture = {picture}: must be width and height, 16 to {LARGEST} pixels")
        if not 0.0 < step_s <= episode_s <= LONGEST_S:
            raise JumpcadError(
                f"step_s = {step_s:g}: must be above 0, and at most episode_s = {episode_s:g}, that {LONGEST_S:g}"
            )
        self.robot = robot if isinstance(robot, Robot) else robot_of(robot, workshop)
        self._robots = variants(self.robot, made) if made else (self.robot,)
        self._arenas: dict[int, Arena] = {}
        self._start, self._control, self._steps_mm = start, control, (steps_mm[0], steps_mm[1])
        self._scattered, self._episode_s, self._step_s = made > 0, episode_s, step_s
        self.render_mode = render_mode
        low, high = np.array([limits for _, *limits in OBSERVATIONS.values()], dtype=np.float32).T
        self._wheel_rad_s = steers(self.robot).free_rad_s if self.robot.layout.of(Steering) else None
        self._target_m, self._picture = tuple(target_m), (picture[0], picture[1])
        least = np.array([0.0, -1.0][: 1 + self.steers], dtype=np.float32)
        torque = gymnasium.spaces.Box(least, np.ones_like(least))
        switch = gymnasium.spaces.MultiDiscrete([3, 3]) if self.steers else gymnasium.spaces.Discrete(3)
        self.observation_space: Any = gymnasium.spaces.Box(low, high)
        self.action_space: Any = switch if control == "switch" else torque
        self._obstacles = obstacles_of(obstacles)
        self._arena = self._arena_of(0)
        self._step_at, self._target, self._flies, self._begun_s = (0.0, 0.0), np.zeros(0), False, math.nan

    @property
    def steers(self) -> bool:
        """Whether the robot has a steering wheel."""
        return self._wheel_rad_s is not None

    @check_arguments
    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """Begin an episode; return the first observation and its figures."""
        super().reset(seed=seed)
        rng = self.np_random
        start = (options or {}).get("start", self._start)
        if start not in get_args(Start):
            raise JumpcadError(f"start = {start!r}: must be one of {', '.join(map(repr, get_args(Start)))}")
        if options and "obstacles" in options:
            self._obstacles, self._arenas = obstacles_of(options["obstacles"]), {}
            self.__dict__.pop("_renderer", None)
        arena = self._arena = self._arena_of(int(rng.integers(len(self._robots))))
        arena.stand_on(scattered_floor(rng) if self._scattered else Floor())
        if start == "lying":
            arena.place(0, None)
            attitude, drop = Rotation.random(rng=rng).as_quat(scalar_first=True), float(rng.uniform(*DROP_M))
            arena.put(attitude, drop, np.zeros(3), np.zeros(3))
            arena.rest()
        else:
            arena.stand("wound" if start == "loaded" else "home")
            if struck := arena.struck:
                raise JumpcadError(f"obstacles[{min(struck) - 1}] stands where the robot does, at 0, 0: move its at_m")
        height = float(rng.uniform(*self._steps_mm)) / 1000.0
        at = arena.centre_of_mass_m[0] + float(rng.uniform(*STEP_AHEAD_M))
        self._step_at = (at, height) if height > 0.0 else (0.0, 0.0)
        arena.place(0, self._step)
        if self._target_m:
            turned = rng.uniform(-math.pi, math.pi) if len(self._target_m) == 1 else 0.0
            point = np.array([*self._target_m, 0.0][:2])
            self._target = arena.centre_of_mass_m[:2] + pose_about_z(turned)[:2, :2] @ point
        self._flies, self._begun_s = self._control == "torque", float(arena.data.time)
        return self._observed(), self._figures()

    def step(self, action: Any) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Act for a step's time; return observation, reward, whether it is there, whether time is over, and figures.

        Raises
        ------
        gymnasium.error.ResetNeeded
            If no episode has begun.
        JumpcadError
            If the action is none.
        """
        self._require_begun()
        arena = self._arena
        before, (action, wheel) = self._merit_m, self._asked(action)
        wound = arena.held and arena.loaded >= LOADED
        if self._control == "torque":
            arena.push(min(max(action, 0.0), 1.0))
        elif action == WIND:
            arena.wind_on(self._step_s / arena.robot.layout.drive.train.winding_s)
        elif action == RELEASE and wound:
            arena.release()
            self._flies = True
        if self._wheel_rad_s is not None:
            share = wheel if self._control == "torque" else (0.0, 1.0, -1.0)[int(wheel)] * (wound and not self._flies)
            arena.data.actuator("steer").ctrl = min(max(share, -1.0), 1.0) * self._wheel_rad_s
        arena.step(self._step_s, quiet=not self._flies)
        if self._control == "switch" and self._flies:
            speeds = np.abs(arena.data.qvel[:6])
            self._flies = bool(arena.data.ncon == 0 or speeds[:3].max() > STILL_M_S or speeds[3:].max() > STILL_RAD_S)
        over = arena.data.time - self._begun_s >= self._episode_s - 0.5 * self._step_s
        lies = arena.data.ncon > 0 and bool(np.abs(arena.data.qvel[:3]).max() < STILL_M_S)
        there = bool(self._target.size) and lies and -self._merit_m <= WITHIN_M
        return self._observed(), self._merit_m - before + there, there, bool(over), self._figures()

    @property
    def _merit_m(self) -> float:
        """What a step's reward is the gain of: how far ahead the robot is, or how near to the target."""
        place = self._arena.centre_of_mass_m
        return -float(np.linalg.norm(self._target - place[:2])) if self._target.size else float(place[0])

    def _require_begun(self) -> None:
        if math.isnan(self._begun_s):
            raise gymnasium.error.ResetNeeded("JumpEnv: no episode has begun: call reset() first")

    def _asked(self, action: Any) -> tuple[float, float]:
        """Return an action as numbers: what the motor does, and the wheel."""
        count, torque = 1 + self.steers, self._control == "torque"
        try:
            found = np.asarray(action, dtype=float).ravel()
        except (TypeError, ValueError):
            found = np.array([])
        fits = np.isfinite(found) if torque else np.isin(found, (WAIT, WIND, RELEASE))
        if len(found) != count or not fits.all():
            known = "a torque from 0 to 1" if torque else f"{WAIT} (wait), {WIND} (wind) or {RELEASE} (release)"
            wheel = "speed from -1 to 1" if torque else "0 (stand), 1 (left) or 2 (right)"
            also = f", and the wheel's {wheel}" * self.steers
            raise JumpcadError(f"action = {described(action)}: must be {known}{also}")
        return float(found[0]), float(found[-1]) if self.steers else 0.0

    def render(self) -> Any:
        """Return a picture (height, width, 3) of the robot from its right; None without a render mode."""
        if self.render_mode is None:
            return None
        self._require_begun()
        things = visuals(self.robot)
        poses = [chained(self._arena.pose(thing.body), thing.T_body_mesh) for thing in things]
        corners = corners_of(things, poses)
        centre = self._arena.centre_of_mass_m * (1.0, 1.0, 0.0)
        frame = np.concatenate([corners, centre + FRAME_M])
        stand = [None if one is None else one.pose for one in (self._step, *self._obstacles)]
        picture = self._renderer.picture([*poses, *stand], self._picture, JUMP_VIEW, frame)
        caption = f"{self._arena.data.time - self._begun_s:.2f} s"
        floor = with_floor(picture, aimed(frame, JUMP_VIEW, self._picture[0] / self._picture[1]), frame, caption)
        return np.asarray(floor.convert("RGB"))

    @property
    def _step(self) -> Obstacle | None:
        x, height = self._step_at
        return None if height == 0.0 else STEP.model_copy(update={"at_m": (x, 0.0), "height_mm": 1000.0 * height})

    @cached_property
    def _renderer(self) -> Renderer:
        boxes = [trimesh.creation.box(extents=2000.0 * np.array(one.half_m)) for one in (STEP, *self._obstacles)]
        things = [(thing.mesh, thing.colour) for thing in visuals(self.robot)]
        return Renderer([*things, *((box, (0.8, 0.8, 0.78)) for box in boxes)])

    def _arena_of(self, number: int) -> Arena:
        if number not in self._arenas:
            self._arenas[number] = Arena(self._robots[number], obstacles=(STEP, *self._obstacles))
            self._arenas[number].place(0, None)
        return self._arenas[number]

    def _observed(self) -> Array:
        arena = self._arena
        ahead, height = self._step_at
        way = self._target - arena.centre_of_mass_m[:2] if self._target.size else np.zeros(2)
        found = [
            *arena.pose(BODY)[2, :3], *arena.data.qvel[3:6], *arena.velocity_m_s, arena.centre_of_mass_m[2],
            arena.heading_rad, arena.loaded, arena.leg_rad_s, arena.pose(FOOT)[2, 2], float(arena.data.ncon > 0),
            ahead - arena.centre_of_mass_m[0] if height > 0.0 else 0.0, height,
            *(pose_about_z(-arena.heading_rad)[:2, :2] @ way),
        ]  # fmt: skip
        return np.clip(np.array(found, dtype=np.float32), self.observation_space.low, self.observation_space.high)

    def _figures(self) -> dict[str, Any]:
        arena = self._arena
        return {"robot": arena.robot.name, "time_s": float(arena.data.time) - self._begun_s, "stands": arena.stands,
                "loaded": arena.loaded >= LOADED}  # fmt: skip


@check_arguments
def obstacles_of(obstacles: Sequence[Mapping[str, Any] | Obstacle]) -> tuple[Obstacle, ...]:
    """Return bars, steps and walls as they are kept."""
    return tuple(one if isinstance(one, Obstacle) else Obstacle(**one) for one in obstacles)


if gymnasium is not None:
    gymnasium.register("Jump-v0", entry_point=f"{__name__}:JumpEnv")
