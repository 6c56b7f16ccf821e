"""Energy lost in joint damping until take-off: the work of a torque against the speeds, in every engine."""

import numpy as np
import pytest
from support import needs

from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import Mechanism
from jumpcad.settings import Settings
from jumpcad.simulation import simulate

DAMPING = 0.001


@pytest.mark.parametrize("engine", ["pybullet", "mujoco", "planar"])
def test_damping_takes_the_work_of_its_torque(kenan: Mechanism, engine: str) -> None:
    """Work of c·q' along q: c·∫ q'² dt of all three joints, from the leg's angle over time and the linkage."""
    if engine != "planar":
        needs.package(engine)
    settings = Settings(trajectory=True, trajectory_rate_hz=2000.0, joint_damping_nms_per_rad=DAMPING)
    jump = simulate(kenan, settings, engine)
    path, energy = jump.trajectory, jump.energy
    assert path is not None
    assert energy is not None
    assert jump.takeoff_time_s is not None
    until = path.time_s <= jump.takeoff_time_s
    stiffness = kenan.spring.stiffness_nm_per_rad
    leg = np.minimum(-np.sqrt(2.0 * path.spring_j[until] / stiffness), 0.0)
    pose = Linkage(kenan.design).pose(leg)
    speeds = [np.gradient(turn, path.time_s[until]) for turn in (leg, pose.front_rad, pose.ankle_rad)]
    taken = DAMPING * sum(float(np.trapezoid(speed**2, path.time_s[until])) for speed in speeds)
    assert energy.joint_damping_j == pytest.approx(taken, rel=0.05)
