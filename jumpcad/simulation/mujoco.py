"""The MuJoCo back end: it runs the exported model, without the visible meshes, with the stop of the other engines."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from jumpcad.errors import JumpcadError
from jumpcad.exporters.mjcf import SUBSTEPS, write_mjcf
from jumpcad.exporters.xml import friction_nm
from jumpcad.mechanism.model import Mechanism, Multibody, ReleasePose, Spring, release_pose
from jumpcad.settings import Settings, coefficients
from jumpcad.simulation.engines import import_mujoco
from jumpcad.simulation.mechanics import State, StopPad
from jumpcad.simulation.run import Run
from jumpcad.transforms import Array, quaternion_about_y

CARRIED_SHARE = 0.02
"""Of the weight: with less than this the robot has left the ground. MuJoCo's contacts are soft where they begin, and a
foot that leaves trails some force for 1 ms; with this share it leaves when PyBullet's does (within 0.2 ms)."""
LEG = 0
"""Place of the leg joint among a mechanism's."""


class MujocoEngine:
    """Makes a model of its own for every robot."""

    run = Run

    def __init__(self) -> None:
        self._mujoco = import_mujoco()
        # By default it writes a file into the current folder; the audit reports runs that diverge. MuJoCo keeps what it
        # is given until after Python's end: a function of this module would keep all that the module refers to.
        self._mujoco.set_mju_user_warning(str)

    @contextmanager
    def world(self, mechanism: Multibody, settings: Settings) -> Iterator["MujocoWorld"]:
        """Put a robot on the ground, ready for release."""
        if settings.restitution:
            raise JumpcadError(
                f"restitution = {settings.restitution:g}: MuJoCo has none; set it to 0 or use --engine pybullet"
            )
        if settings.pin_friction is not None and not isinstance(mechanism, Mechanism):
            raise JumpcadError(
                f"pin_friction = {settings.pin_friction:g}: a chain of hinges is simulated without it: leave it out; "
                "its joints have friction_nmm"
            )
        yield MujocoWorld(self._mujoco, mechanism, settings)


class MujocoWorld:
    """One robot on the ground; a `World` for `Run`.

    Robots that are no five-bars have neither a pad nor a leg: what `advance` returns is minus the share of the springs'
    energy that is still in them. Their time steps are MuJoCo's own, of which it takes `stride` as one.
    """

    def __init__(self, mujoco: Any, mechanism: Multibody, settings: Settings) -> None:
        self._mujoco = mujoco
        rubs = coefficients(mechanism, settings)
        five_bar = isinstance(mechanism, Mechanism)
        self._substeps, self.stride = SUBSTEPS if five_bar else 1, 1
        self._dt_s = settings.dt_s / self._substeps
        inner = settings if five_bar else settings.model_copy(update={"dt_s": SUBSTEPS * settings.dt_s})
        self._damping_nms = rubs.joint_damping_nms_per_rad
        self._dry_nm = np.array([friction_nm(joint, mechanism, settings) for joint in mechanism.joints])
        self.joint_damping_j = self.slip_j = 0.0
        self._loaded = True
        self.model = mujoco.MjModel.from_xml_string(write_mjcf(mechanism, inner))
        self.data = mujoco.MjData(self.model)
        self._carried_n = CARRIED_SHARE * mechanism.mass_kg * settings.gravity_m_s2
        self._rows = int(self.model.pair_dim[0])
        self._bodies = [self.model.body(name).id for name in mechanism.order]
        self._joints = [int(self.model.joint(joint.name).dofadr[0]) for joint in mechanism.joints]
        self._sprung = [int(self.model.joint(spring.joint).qposadr[0]) for spring in mechanism.springs]
        self._springs, self._wound_j = mechanism.springs, mechanism.spring_energy_j
        self._pad: StopPad | None = None
        if isinstance(mechanism, Mechanism):
            leg = self.model.joint(mechanism.spring.joint)
            self._leg, self._leg_dof = int(leg.qposadr[0]), int(leg.dofadr[0])
            leg.limited = 0  # by the pad instead
            self._pad = StopPad(mechanism, self._dt_s)
        self._place(release_pose(mechanism))

    def advance(self, steps: int) -> float:
        """Go on by a number of time steps; MuJoCo's own spring acts in each."""
        lost_w = 0.0
        while steps > 0:
            taken = min(steps, self.stride)
            if steps == taken:
                before = self._progress()
            if self.stride > 1:
                self.model.opt.timestep = taken * self._dt_s
                self.model.opt.integrator = self._mujoco.mjtIntegrator.mjINT_RK4
            self._loaded = False
            for _ in range(self._substeps):
                speeds = self.data.qvel[self._joints]
                lost_w += taken * (self._damping_nms * float(speeds @ speeds) + float(self._dry_nm @ np.abs(speeds)))
                if self._pad:
                    pad_nm = self._pad.torque_nm(float(self.data.qpos[self._leg]), float(speeds[LEG]))
                    self.data.qfrc_applied[self._leg_dof] = -pad_nm
                self._mujoco.mj_step(self.model, self.data)
                self._touch()
            steps -= taken
        self.joint_damping_j += self._dt_s * lost_w
        return before

    def _progress(self) -> float:
        if self._pad:
            return float(self.data.qpos[self._leg])
        return -math.fsum(map(Spring.stored_j, self._springs, self._spring_rad())) / self._wound_j

    def _spring_rad(self) -> tuple[float, ...]:
        return tuple(self.data.qpos[self._sprung].tolist())

    def pull(self, acceleration_m_s2: Array) -> None:
        """Take another gravity (3,)."""
        self.model.opt.gravity[:] = acceleration_m_s2

    def loaded(self) -> bool:
        """Tell whether the ground carried any of the robot during the last time step."""
        return self._loaded

    def state(self) -> State:
        """Return where the bodies are and how they move, leaving the solver's warm start and contacts as they are."""
        mujoco, model, data = self._mujoco, self.model, self.data
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        rotation = np.array([data.xmat[body].reshape(3, 3) for body in self._bodies])
        velocity = np.zeros((len(self._bodies), 6))
        for row, body in zip(velocity, self._bodies, strict=True):
            mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, row, 0)
        return State(data.xipos[self._bodies].copy(), rotation, velocity[:, 3:], velocity[:, :3], self._spring_rad())

    def _touch(self) -> None:
        """Take up what the ground did in MuJoCo's last own step: whether it pushed, and the work of its friction.

        Contacts are MuJoCo's last constraints; each has a row for its normal and one for every direction of sliding.
        """
        data = self.data
        first = data.ne + data.nf + data.nl
        if data.nefc > first:
            forces = data.efc_force[first:].reshape(-1, self._rows)
            self._loaded = self._loaded or float(forces[:, 0].sum()) > self._carried_n
            speeds = data.efc_vel[first:].reshape(-1, self._rows)
            self.slip_j -= self._dt_s * float((forces[:, 1:] * speeds[:, 1:]).sum())

    def _place(self, release: ReleasePose) -> None:
        """Put the body's frame and every joint where they are at release, moving as they do there."""
        if self._pad:
            self.data.joint("free").qpos = [*release.body_position_m, *quaternion_about_y(release.body_pitch_rad)]
            self.data.joint("free").qvel = [*release.body_m_s, 0.0, release.body_rad_s, 0.0]
        else:
            self.data.joint("root z").qpos = release.body_position_m[2]
            self.data.joint("root pitch").qpos = release.body_pitch_rad
        for name, angle in release.joint_rad.items():
            self.data.joint(name).qpos, self.data.joint(name).qvel = angle, release.joint_rad_s[name]
        self._mujoco.mj_forward(self.model, self.data)
