"""The same robot and settings give the same bits, whatever was simulated before and wherever."""

import subprocess
import sys
import threading
from importlib.util import find_spec

import pytest
from support import needs
from support.flights import Flight

from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.bullet import RESET_EVERY

SETTINGS = Settings(flight="simulated", trajectory=True)
PROGRAM = """
import sys
from jumpcad import Settings, capsule_robot, load_design, simulate
for engine in sys.argv[1:]:
    jump = simulate(capsule_robot(load_design("kenan-2.0")), Settings(flight="simulated", trajectory=True), engine)
    print(jump.to_dict(), jump.trajectory.position_m.tobytes().hex())
"""
ENGINES = [name for name in ("pybullet", "mujoco") if find_spec(name)]


def bits(robot: Robot, engine: str = "pybullet") -> str:
    """Return everything that a simulation says, as text."""
    needs.package(engine)
    jump = simulate(robot, SETTINGS, engine)
    assert jump.trajectory is not None
    return f"{jump.to_dict()} {jump.trajectory.position_m.tobytes().hex()}"


@pytest.fixture(scope="module")
def fresh() -> dict[str, str]:
    """What a fresh process says of the same jump, by engine: the first jump that it simulates with each."""
    command = [sys.executable, "-c", PROGRAM, *ENGINES]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    return dict(zip(ENGINES, said, strict=True))


@pytest.mark.thorough
@pytest.mark.parametrize("engine", ["pybullet", "mujoco"])
def test_repeats_other_robots_and_a_fresh_process(
    kenan: Robot, jumping: list[Flight], fresh: dict[str, str], engine: str
) -> None:
    needs.package(engine)
    first = bits(kenan, engine)
    assert bits(kenan, engine) == first
    for flight in jumping[:2]:
        simulate(flight.robot, Settings(dt_s=0.001, foot_friction=0.4, gravity_m_s2=3.7), engine)
        assert bits(kenan, engine) == first
    assert fresh[engine] == first


def test_a_renewed_world_changes_nothing(kenan: Robot) -> None:
    """Across the reset that returns memory (2 s)."""
    first = bits(kenan)
    quick = Settings(dt_s=1 / 240, max_time_s=0.001)
    for _ in range(RESET_EVERY + 20):
        simulate(kenan, quick)
    assert bits(kenan) == first


def test_a_foreign_disconnect_is_survived(kenan: Robot) -> None:
    bullet = needs.package("pybullet")
    first = bits(kenan)
    for client in range(8):
        if bullet.isConnected(client):
            bullet.disconnect(client)
    assert bits(kenan) == first


def test_threads_do_not_disturb_each_other(kenan: Robot, jumping: list[Flight]) -> None:
    first, results = bits(kenan), []
    work = [flight.robot for flight in jumping[:4]] * 3 + [kenan] * 4

    def one(robot: Robot) -> None:
        results.append((robot is kenan, bits(robot)))

    threads = [threading.Thread(target=one, args=(robot,)) for robot in work]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == len(work)
    assert {said for is_kenan, said in results if is_kenan} == {first}


def test_a_failed_run_leaves_no_robot_behind(kenan: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    first = bits(kenan)

    def interrupted(_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr("jumpcad.simulation.run.Run.go", interrupted)
        with pytest.raises(KeyboardInterrupt):
            simulate(kenan)
    assert bits(kenan) == first
