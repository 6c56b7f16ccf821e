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
from jumpcad.bundle.inputs import robot_of
from jumpcad.bundle.renders import JUMP_VIEW, corners_of
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import described
from jumpcad.landing.arena import STILL_M_S, STILL_RAD_S, Arena, Floor
from jumpcad.landing.landing import DROP_M, scattered_floor
from jumpcad.landing.obstacles import STEP_M, Obstacle
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.robot.robot import Robot
from jumpcad.scene.camera import aimed
from jumpcad.scene.floor import with_floor
from jumpcad.scene.renderer import Renderer
from jumpcad.scene.visuals import visuals
from jumpcad.transforms import Array, chained
from jumpcad.variation import variants
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
WAIT, WIND, RELEASE = range(3)
"""Actions of the control `switch`."""
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
}
"""What is observed: unit, least and largest value.

The vertical and the spin in the body's frame; velocity and height of the centre of mass; the share of the springs'
travel that is loaded, and the leg's speed; how far the foot's axis points up (1: it stands); whether anything touches
the ground; distance and height of the step, 0 without one.
"""
LOADED = 0.98
"""Share of the travel from which the cam lets the leg go; judgement: the latch holds it within 1 %."""
STEP = Obstacle(kind="step", at_m=(0.0, 0.0), height_mm=1.0, wide_m=3.0)
"""A random step."""
STEP_AHEAD_M = (0.15, 0.6)
"""Distances of a random step from the robot's centre of mass."""
LONGEST_S = 86400.0
"""Longest episode."""
PICTURE, FRAME_M = (320, 240), np.array([[-0.2, -0.1, 0.0], [0.5, 0.1, 0.3]])
"""Size of a picture (pixels), and what it shows about the centre of mass, from the ground on."""


class JumpEnv(Base):  # type: ignore[misc, valid-type, unused-ignore]
    """One robot that is wound, released and lands, as an environment of Gymnasium.

    The reward is the way forward of the centre of mass (m). An episode ends (truncated) after `episode_s`.

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
        loaded, as the cam cannot. `torque`: the share of the largest torque that loads the springs, from 0 to 1.
    steps_mm
        Least and largest height of a step somewhere ahead; (0, 0): the floor is flat.
    made
        Number of robots as they may be made (`jumpcad.variants`), of which each episode takes one, on a floor of random
        friction and softness; 0: always the design's robot on the workshop's floor.
    episode_s, step_s
        Simulated time of an episode and of a step.
    render_mode
        None or `rgb_array`.

    Raises
    ------
    JumpcadError
        If Gymnasium is not installed, or an argument is none of these.
    """

    OBSERVATIONS = OBSERVATIONS
    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 20}  # noqa: RUF012  Gymnasium's own type

    @check_arguments
    def __init__(
        self,
        robot: Robot | Design | str | Path = "kenan-2.0",
        workshop: Workshop | None = None,
        start: Start = "loaded",
        control: Control = "switch",
        steps_mm: Sequence[float] = (0.0, 0.0),
        made: int = 0,
        episode_s: float = 20.0,
        step_s: float = 0.05,
        render_mode: str | None = None,
    ) -> None:
        if gymnasium is None:
            raise JumpcadError('JumpEnv needs Gymnasium: pip install "jumpcad[gym]"')
        for name, value, known in (
            ("start", start, get_args(Start)),
            ("control", control, get_args(Control)),
            ("render_mode", render_mode, (None, "rgb_array")),
        ):
            if value not in known:
                raise JumpcadError(f"{name} = {value!r}: must be one of {', '.join(map(repr, known))}")
        if len(steps_mm) != 2 or not 0.0 <= steps_mm[0] <= steps_mm[1] <= 1000.0 * STEP_M[1]:
            raise JumpcadError(f"steps_mm = {steps_mm}: must be the least and the largest height, 0 to 500 mm")
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
        torque = gymnasium.spaces.Box(0.0, 1.0, (1,), np.float32)
        self.observation_space: Any = gymnasium.spaces.Box(low, high)
        self.action_space: Any = gymnasium.spaces.Discrete(3) if control == "switch" else torque
        self._arena = self._arena_of(0)
        self._step_at, self._flies, self._begun_s = (0.0, 0.0), False, math.nan

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
        arena = self._arena = self._arena_of(int(rng.integers(len(self._robots))))
        arena.stand_on(scattered_floor(rng) if self._scattered else Floor())
        if start == "lying":
            arena.place(0, None)
            attitude, drop = Rotation.random(rng=rng).as_quat(scalar_first=True), float(rng.uniform(*DROP_M))
            arena.put(attitude, drop, np.zeros(3), np.zeros(3))
            arena.rest()
        else:
            arena.stand("wound" if start == "loaded" else "home")
        height = float(rng.uniform(*self._steps_mm)) / 1000.0
        at = arena.centre_of_mass_m[0] + float(rng.uniform(*STEP_AHEAD_M))
        self._step_at = (at, height) if height > 0.0 else (0.0, 0.0)
        arena.place(0, self._step)
        self._flies, self._begun_s = self._control == "torque", float(arena.data.time)
        return self._observed(), self._figures()

    def step(self, action: Any) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Act for a step's time; return observation, way forward (m), False, whether the time is over, and figures.

        Raises
        ------
        gymnasium.error.ResetNeeded
            If no episode has begun.
        JumpcadError
            If the action is none.
        """
        self._require_begun()
        arena, before = self._arena, self._arena.centre_of_mass_m[0]
        action = self._asked(action)
        if self._control == "torque":
            arena.push(min(max(action, 0.0), 1.0))
        elif action == WIND:
            arena.wind_on(self._step_s / arena.robot.layout.drive.train.winding_s)
        elif action == RELEASE and arena.held and arena.loaded >= LOADED:
            arena.release()
            self._flies = True
        arena.step(self._step_s, quiet=not self._flies)
        if self._control == "switch" and self._flies:
            speeds = np.abs(arena.data.qvel[:6])
            self._flies = bool(arena.data.ncon == 0 or speeds[:3].max() > STILL_M_S or speeds[3:].max() > STILL_RAD_S)
        way = float(arena.centre_of_mass_m[0] - before)
        over = arena.data.time - self._begun_s >= self._episode_s - 0.5 * self._step_s
        return self._observed(), way, False, bool(over), self._figures()

    def _require_begun(self) -> None:
        if math.isnan(self._begun_s):
            raise gymnasium.error.ResetNeeded("JumpEnv: no episode has begun: call reset() first")

    def _asked(self, action: Any) -> float:
        """Return an action as a number."""
        try:
            found = float(np.asarray(action, dtype=float).item())
        except (TypeError, ValueError):
            found = math.nan
        torque = self._control == "torque"
        if not (math.isfinite(found) if torque else found in (WAIT, WIND, RELEASE)):
            known = "a torque from 0 to 1" if torque else f"{WAIT} (wait), {WIND} (wind) or {RELEASE} (release)"
            raise JumpcadError(f"action = {described(action)}: must be {known}")
        return found

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
        step = self._step
        picture = self._renderer.picture([*poses, None if step is None else step.pose], PICTURE, JUMP_VIEW, frame)
        caption = f"{self._arena.data.time - self._begun_s:.2f} s"
        floor = with_floor(picture, aimed(frame, JUMP_VIEW, PICTURE[0] / PICTURE[1]), frame, caption)
        return np.asarray(floor.convert("RGB"))

    @property
    def _step(self) -> Obstacle | None:
        x, height = self._step_at
        return None if height == 0.0 else STEP.model_copy(update={"at_m": (x, 0.0), "height_mm": 1000.0 * height})

    @cached_property
    def _renderer(self) -> Renderer:
        box = trimesh.creation.box(extents=2000.0 * np.array(STEP.half_m))
        return Renderer([*((thing.mesh, thing.colour) for thing in visuals(self.robot)), (box, (0.8, 0.8, 0.78))])

    def _arena_of(self, number: int) -> Arena:
        if number not in self._arenas:
            self._arenas[number] = Arena(self._robots[number], obstacles=(STEP,))
        return self._arenas[number]

    def _observed(self) -> Array:
        arena = self._arena
        ahead, height = self._step_at
        found = [
            *arena.pose(BODY)[2, :3], *arena.data.qvel[3:6], *arena.velocity_m_s, arena.centre_of_mass_m[2],
            arena.heading_rad, arena.loaded, arena.leg_rad_s, arena.pose(FOOT)[2, 2], float(arena.data.ncon > 0),
            ahead - arena.centre_of_mass_m[0] if height > 0.0 else 0.0, height,
        ]  # fmt: skip
        return np.clip(np.array(found, dtype=np.float32), self.observation_space.low, self.observation_space.high)

    def _figures(self) -> dict[str, Any]:
        arena = self._arena
        return {"robot": arena.robot.name, "time_s": float(arena.data.time) - self._begun_s, "stands": arena.stands,
                "loaded": arena.loaded >= LOADED}  # fmt: skip


if gymnasium is not None:
    gymnasium.register("Jump-v0", entry_point=f"{__name__}:JumpEnv")
