"""A robot on a floor in MuJoCo: it is dropped, winds, is released, flies and comes to rest (SI units).

The model is the one that bundles hold (`exporters.mjcf_robot`): bodies collide with the floor by their convex hulls,
not with each other. Its equality `latch` winds the leg, as motor and cam do.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from jumpcad.collision.hulls import CAGE
from jumpcad.exporters.mjcf_robot import STEP_S, write_robot
from jumpcad.exporters.steered import WHEEL
from jumpcad.landing.obstacles import BOX, Obstacle
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, body_poses, release_pose
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.limits import steers
from jumpcad.robot.steering.place import Steering
from jumpcad.scene.visuals import visuals
from jumpcad.settings import Settings, coefficients
from jumpcad.simulation.engines import import_mujoco
from jumpcad.simulation.mechanics import drag_m_s2, drag_per_m
from jumpcad.transforms import Array, chained, pose_at, rotation_about_y

QUIET_STEP_S = 0.001
"""Time step of winding and waiting, four times that of a jump."""
ROD_S = 0.02
"""Contacts of the cage's rods are softer than this, and all others harder."""
TARGETS = 200
"""Steps in which the leg is wound."""
TURN_LOOKS = 8
"""How often a robot that steers is looked at."""
LOOK_S = 0.005
"""How often a landing robot is looked at."""
STILL_M_S, STILL_RAD_S, STILL_S = 0.02, 0.3, 0.2
"""Speeds below which the body stands still, and for how long it must: then it rests."""
FASTEST_M_S = 7.0
"""Upward speed that no robot has at take-off: one that does not fall before gravity has taken it does not jump."""
REST_WITHIN_S = 8.0
"""A landing is over after this time, at rest or not."""
UPRIGHT = math.cos(math.radians(20.0))
"""A robot stands on its feet where the foot's upward axis is at most 20° from the vertical."""
ENDS = (("nose", "back"), ("left", "right"), ("top", "belly"))
"""What a robot rests on where the body's x, y or z axis points down, or up."""


@dataclass(frozen=True)
class Floor:
    """A floor: a factor on the friction of feet and body, and the time constant of MuJoCo's contacts (s).

    Half a millisecond is stone under plastic, 5 ms a carpet: judgement.
    """

    friction: float = 1.0
    softness_s: float = 0.001


class Arena:
    """One printed robot on one floor with obstacles; methods go on from where the last one ended.

    Of the settings gravity and friction hold.
    """

    def __init__(self, robot: Robot, settings: Settings | None = None, obstacles: Sequence[Obstacle] = ()) -> None:
        self._mujoco = mujoco = import_mujoco()
        settings = settings or Settings()
        self.robot, self.gravity_m_s2 = robot, settings.gravity_m_s2
        self._drag_per_m = drag_per_m(settings.drag_area_m2, robot.mass_kg)
        text = write_robot(robot, visuals(robot), looks=False, floor=True)
        boxes = (BOX.format(number, *one.half_m) for number, one in enumerate(obstacles))
        text = text.replace("</worldbody>", "".join(boxes) + "</worldbody>")
        self.model = model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(model)
        model.opt.gravity[2] = -settings.gravity_m_s2
        wheel = () if robot.layout.of(Steering) is None else (WHEEL,)
        self.bodies = {name: int(model.body(name).id) for name in (*BODY_NAMES, *wheel)}
        joint = model.joint(robot.spring.joint)
        self._leg, self._leg_rate = int(joint.qposadr[0]), int(joint.dofadr[0])
        self._latch = int(model.equality("latch").id)
        rubs = coefficients(robot, settings)
        of = {
            body: rubs.contact("foot" if name == WHEEL else robot.bodies[name].surface)
            for name, body in self.bodies.items()
        }
        self._friction = np.array([of.get(int(body), 0.0) for body in model.geom_bodyid])
        self.watch: Callable[[], None] | None = None
        """Called after each of MuJoCo's own steps, where something must see them all."""
        self.rods = np.array([model.geom(index).name.startswith(CAGE) for index in range(model.ngeom)])
        self.rods &= model.geom_solref[:, 0] > ROD_S
        self.stand_on(Floor())
        self._obstacles = {int(model.geom(f"obstacle{number}").id): number for number in range(len(obstacles))}
        for number, one in enumerate(obstacles):
            self.place(number, one)

    def stand_on(self, floor: Floor) -> None:
        """Take another floor; the cage's rods stay as soft as they are."""
        self.model.geom_friction[:, 0] = floor.friction * self._friction
        self.model.geom_solref[~self.rods] = max(floor.softness_s, 2.0 * STEP_S), 1.0

    def stand(self, key: str = "wound") -> None:
        """Stand in a key frame: `home`, springs at rest, or `wound`, held by the latch."""
        self._mujoco.mj_resetDataKeyframe(self.model, self.data, self.model.key(key).id)
        self.data.ctrl[:] = 0.0
        self._hold(key == "wound")
        self._mujoco.mj_forward(self.model, self.data)

    def place(self, number: int, obstacle: Obstacle | None) -> None:
        """Put the obstacle of a number where another one of its kind stands, and as high; None: below the floor."""
        pose = pose_at(np.eye(3), np.array([0.0, 0.0, -9.0])) if obstacle is None else obstacle.pose
        self.data.mocap_pos[number] = pose[:3, 3]
        self._mujoco.mju_mat2Quat(self.data.mocap_quat[number], np.ascontiguousarray(pose[:3, :3]).ravel())
        self.model.key_mpos[:], self.model.key_mquat[:] = self.data.mocap_pos.ravel(), self.data.mocap_quat.ravel()
        self._mujoco.mj_forward(self.model, self.data)

    def put(self, quaternion_wxyz: Array, height_m: float, velocity_m_s: Array, spin_rad_s: Array) -> None:
        """Put the robot with relaxed springs in an attitude (4,), its lowest point at a height, moving and turning."""
        self.stand("home")
        data = self.data
        data.qpos[3:7] = quaternion_wxyz
        self._mujoco.mj_forward(self.model, data)
        data.qpos[2] += height_m - self.lowest_m()
        data.qvel[:3], data.qvel[3:6] = velocity_m_s, spin_rad_s
        self._mujoco.mj_forward(self.model, data)

    def step(self, time_s: float, quiet: bool = False) -> None:
        """Go on for a time; `quiet` where nothing is fast. Air brakes with the speed at its beginning."""
        if self._drag_per_m:
            air = drag_m_s2(self.velocity_m_s, self._drag_per_m)
            self.model.opt.gravity[:] = air - np.array([0.0, 0.0, self.gravity_m_s2])
        self.model.opt.timestep = QUIET_STEP_S if quiet else STEP_S
        steps = max(1, round(time_s / self.model.opt.timestep))
        if self.watch is None:
            self._mujoco.mj_step(self.model, self.data, nstep=steps)
            return
        for _ in range(steps):
            self._mujoco.mj_step(self.model, self.data)
            self.watch()

    def wind_on(self, share: float) -> None:
        """Move the latch by a share of the springs' travel, from where it holds the leg or else from the leg."""
        wind = self.robot.spring.wind_rad
        at = self.model.eq_data[self._latch, 0] if self.held else min(float(self.data.qpos[self._leg]), 0.0)
        self._hold(True)
        self.model.eq_data[self._latch, 0] = max(at - share * wind, -wind)

    def push(self, share: float) -> None:
        """Load the springs by a share of the motor's largest torque, from 0 to 1, without the latch."""
        self._hold(False)
        self.data.ctrl[0] = share * self.model.actuator_ctrlrange[0, 0]

    def wind(self, time_s: float, look: Callable[[], None] = lambda: None) -> None:
        """Wind the leg at an even rate within a time, wherever the robot lies, and hold it."""
        self._hold(True)
        for target in np.linspace(float(self.data.qpos[self._leg]), -self.robot.spring.wind_rad, TARGETS + 1)[1:]:
            self.model.eq_data[self._latch, 0] = target
            self.step(time_s / TARGETS, quiet=True)
            look()

    def steer(self, angle_deg: float, look: Callable[[], None] = lambda: None) -> None:
        """Turn by the wheel, to the left where positive, by time, as the firmware does."""
        does, drive = steers(self.robot), self.data.actuator("steer")
        drive.ctrl = math.copysign(does.free_rad_s, angle_deg)
        for _ in range(TURN_LOOKS):
            self.step(abs(angle_deg) / does.figures["steering_rate_deg_s"] / TURN_LOOKS, quiet=True)
            look()
        drive.ctrl = 0.0
        self.step(STILL_S, quiet=True)

    def release(self) -> None:
        """Let the springs go: where the robot has a cam, from the state in which the roller has left it.

        The foot stays where it is and stands still; what the springs lose on the cam is lost.
        """
        self._hold(False)
        robot, data = self.robot, self.data
        if robot.roller_off is None:
            return
        release = release_pose(robot)
        flat = body_poses(robot, -robot.roller_off.leg_rad / robot.spring.wind_rad)[FOOT]
        here = chained(self.pose(FOOT), np.asarray(np.linalg.inv(flat)))
        body = chained(here, pose_at(rotation_about_y(release.body_pitch_rad), release.body_position_m))
        data.qpos[:3] = body[:3, 3]
        self._mujoco.mju_mat2Quat(data.qpos[3:7], np.ascontiguousarray(body[:3, :3]).ravel())
        data.qvel[:] = 0.0
        data.qvel[:3], data.qvel[4] = here[:3, :3] @ release.body_m_s, release.body_rad_s
        for name, angle in release.joint_rad.items():
            data.joint(name).qpos, data.joint(name).qvel = angle, release.joint_rad_s[name]
        self._mujoco.mj_forward(self.model, data)

    def fall(self, look: Callable[[], None] = lambda: None) -> bool:
        """Go on until the robot, in the air, begins to fall; return whether it does."""
        begun = float(self.data.time)
        while self.data.time - begun < FASTEST_M_S / self.gravity_m_s2:
            self.step(LOOK_S)
            look()
            if self.data.ncon == 0 and self.velocity_m_s[2] < 0.0:
                return True
        return False

    def turn(self, rotation: Array, spin_rad_s: Array) -> None:
        """Turn the whole robot about its centre of mass (3, 3), and add a spin (3,) in the body's frame."""
        data, centre, velocity = self.data, self.centre_of_mass_m, self.velocity_m_s
        placed = rotation @ self.pose(BODY)[:3, :3]
        data.qpos[:3] = centre + rotation @ (data.qpos[:3] - centre)
        self._mujoco.mju_mat2Quat(data.qpos[3:7], np.ascontiguousarray(placed).ravel())
        data.qvel[:3] = velocity + rotation @ (data.qvel[:3] - velocity)
        data.qvel[3:6] += spin_rad_s
        self._mujoco.mj_forward(self.model, data)

    def rest(self, look: Callable[[], None] = lambda: None) -> float:
        """Go on until the robot lies still, looking at it meanwhile; return the time that it took (s)."""
        still_s = 0.0
        begun = float(self.data.time)
        while still_s < STILL_S and self.data.time - begun < REST_WITHIN_S:
            self.step(LOOK_S)
            look()
            slow = np.abs(self.data.qvel[:3]).max() < STILL_M_S and np.abs(self.data.qvel[3:6]).max() < STILL_RAD_S
            still_s = still_s + LOOK_S if slow else 0.0
        return float(self.data.time) - begun

    @property
    def struck(self) -> set[int]:
        """Numbers of the obstacles that the robot touches."""
        geoms = self.data.contact.geom.ravel() if self.data.ncon else ()
        return {self._obstacles[geom] for geom in geoms if geom in self._obstacles}

    @property
    def held(self) -> bool:
        """Whether the latch holds the leg."""
        return bool(self.data.eq_active[self._latch])

    @property
    def loaded(self) -> float:
        """Share of the springs' travel by which the leg is wound."""
        return -float(self.data.qpos[self._leg]) / self.robot.spring.wind_rad

    @property
    def leg_rad_s(self) -> float:
        """Speed of the leg's joint."""
        return float(self.data.qvel[self._leg_rate])

    @property
    def stands(self) -> bool:
        """Whether the foot is flat on the floor."""
        return bool(self.pose(FOOT)[2, 2] > UPRIGHT)

    @property
    def rests_on(self) -> str:
        """What the robot lies on: `feet`, or the end of the body's axis nearest to the vertical that points down."""
        if self.stands:
            return "feet"
        up = self.pose(BODY)[2, :3]
        axis = int(np.argmax(np.abs(up)))
        return ENDS[axis][int(up[axis] > 0.0)]

    @property
    def heading_rad(self) -> float:
        """Direction in which the body's x axis points, seen from above."""
        return math.atan2(*self.pose(BODY)[[1, 0], 0])

    @property
    def centre_of_mass_m(self) -> Array:
        """Of the robot (3,)."""
        return np.array(self.data.subtree_com[self.bodies[BODY]])

    @property
    def velocity_m_s(self) -> Array:
        """Of the centre of mass (3,)."""
        self._mujoco.mj_subtreeVel(self.model, self.data)
        return np.array(self.data.subtree_linvel[self.bodies[BODY]])

    @property
    def energies_j(self) -> tuple[float, float, float]:
        """Kinetic energy, potential energy above z = 0, and that of the springs."""
        self._mujoco.mj_energyPos(self.model, self.data)
        self._mujoco.mj_energyVel(self.model, self.data)
        mass, (held, moving) = self.robot.mass_kg, self.data.energy.tolist()
        height = mass * self.gravity_m_s2 * float(self.centre_of_mass_m[2])
        return moving, height, held + mass * float(self.model.opt.gravity @ self.centre_of_mass_m)

    def pose(self, body: str) -> Array:
        """Return the pose (4, 4) of a body's frame."""
        number = self.bodies[body]
        return pose_at(self.data.xmat[number].reshape(3, 3), self.data.xpos[number])

    def lowest_m(self) -> float:
        """Return the height of the robot's lowest point."""
        model, data = self.model, self.data
        lows = []
        for geom in np.flatnonzero(np.isin(model.geom_bodyid, list(self.bodies.values()))):
            up = data.geom_xmat[geom].reshape(3, 3)[2]
            mesh = model.geom_dataid[geom]
            if mesh >= 0:
                first = model.mesh_vertadr[mesh]
                reach = float((model.mesh_vert[first : first + model.mesh_vertnum[mesh]] @ up).min())
            elif model.geom_type[geom] == self._mujoco.mjtGeom.mjGEOM_ELLIPSOID:
                reach = -float(np.linalg.norm(model.geom_size[geom] * up))
            else:
                radius, half = model.geom_size[geom, :2]
                reach = -radius - abs(up[2]) * half
            lows.append(float(data.geom_xpos[geom, 2]) + reach)
        return min(lows)

    def _hold(self, held: bool) -> None:
        self.data.eq_active[self._latch] = int(held)
        self.model.eq_data[self._latch, 0] = -self.robot.spring.wind_rad
