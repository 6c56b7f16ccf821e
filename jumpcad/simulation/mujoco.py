"""The MuJoCo back end: it runs the exported model, without the visible meshes."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from jumpcad.errors import JumpcadError
from jumpcad.exporters.mjcf import SUBSTEPS, write_mjcf
from jumpcad.mechanism.model import BODY_NAMES, Mechanism
from jumpcad.mechanism.poses import Release, release_pose
from jumpcad.settings import Settings
from jumpcad.simulation.engines import import_mujoco
from jumpcad.simulation.mechanics import State
from jumpcad.simulation.run import Run
from jumpcad.transforms import quaternion_about_y


class MujocoEngine:
    """Makes a model of its own for every robot."""

    run = Run

    def __init__(self) -> None:
        self._mujoco = import_mujoco()
        # By default it writes a file into the current folder; the audit reports runs that diverge.
        self._mujoco.set_mju_user_warning(lambda text: None)

    @contextmanager
    def world(self, mechanism: Mechanism, settings: Settings) -> Iterator["MujocoWorld"]:
        """Put a robot on the ground, ready for release.

        Raises
        ------
        JumpcadError
            If the settings ask for what MuJoCo does not have.
        """
        for key in ("restitution", "drag_per_s"):
            if getattr(settings, key):
                raise JumpcadError(
                    f"{key} = {getattr(settings, key):g}: MuJoCo has none; set it to 0 or use --engine pybullet"
                )
        yield MujocoWorld(self._mujoco, mechanism, settings)


class MujocoWorld:
    """One robot on the ground; a `World` for `Run`."""

    def __init__(self, mujoco: Any, mechanism: Mechanism, settings: Settings) -> None:
        self._mujoco = mujoco
        self._damping_dt = settings.joint_damping_nms_per_rad * settings.dt_s / SUBSTEPS
        self.joint_damping_j = 0.0
        self._loaded = True
        self._force = np.zeros(6)
        self.model = mujoco.MjModel.from_xml_string(write_mjcf(mechanism, settings=settings))
        self.data = mujoco.MjData(self.model)
        self._bodies = [self.model.body(name).id for name in BODY_NAMES]
        self._joints = [int(self.model.joint(joint.name).dofadr[0]) for joint in mechanism.joints]
        self._leg = int(self.model.joint(mechanism.spring.joint).qposadr[0])
        self._place(release_pose(mechanism))

    def advance(self, steps: int) -> float:
        """Go on by a number of time steps; MuJoCo's own joint spring acts in each."""
        squares = 0.0
        for _ in range(steps):
            leg_rad = float(self.data.qpos[self._leg])
            self._loaded = False
            for _ in range(SUBSTEPS):
                speeds = self.data.qvel[self._joints]
                squares += float(speeds @ speeds)
                self._mujoco.mj_step(self.model, self.data)
                self._loaded = self._loaded or self._carried()
        self.joint_damping_j += self._damping_dt * squares
        return leg_rad

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
        return State(
            data.xipos[self._bodies].copy(), rotation, velocity[:, 3:], velocity[:, :3], float(data.qpos[self._leg])
        )

    def _carried(self) -> bool:
        """Say whether the ground pushed during MuJoCo's last own step."""
        for index in range(self.data.ncon):
            self._mujoco.mj_contactForce(self.model, self.data, index, self._force)
            if self._force[0] > 0.0:
                return True
        return False

    def _place(self, release: Release) -> None:
        """Put the body's frame and every joint where they are before release."""
        self.data.joint("free").qpos = [*release.body_position_m, *quaternion_about_y(release.body_pitch_rad)]
        for name, angle in release.joint_rad.items():
            self.data.joint(name).qpos = angle
        self._mujoco.mj_forward(self.model, self.data)
