"""The planar engine against the table of converged flights and both general engines."""

from dataclasses import replace

import pytest
from support import needs
from support.built import built
from support.flights import Flight, base_distance_m
from support.machines import one_sided

from jumpcad.errors import JumpcadError
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, load_settings, simulate
from jumpcad.simulation import planar_kernel as kernel
from jumpcad.simulation.engines import default_engine
from jumpcad.simulation.planar import PlanarEngine, PlanarRun, PlanarWorld, touchdown
from jumpcad.simulation.planar_model import PlanarMotion

FINE = load_settings("fine")


def test_verdicts(flights: list[Flight]) -> None:
    verdicts = {flight.name: simulate(flight.robot, engine="planar").verdict for flight in flights}
    weak_as_no_takeoff = {name: "no_takeoff" if v == "too_weak" else v for name, v in verdicts.items()}
    assert weak_as_no_takeoff == {flight.name: flight.verdict for flight in flights}


def test_a_robot_that_does_not_clear_what_is_asked_for_does_not_jump(kenan: Robot) -> None:
    """Its foot is 70 mm above the ground at the highest point, whatever engine computes the push-off."""
    for engine in ("planar", default_engine()):
        low, high = (simulate(kenan, Settings(takeoff_clearance_m=asked), engine) for asked in (0.002, 0.1))
        assert (low.verdict, high.verdict) == ("jump", "no_takeoff"), engine


def test_jumps_of_the_table(jumping: list[Flight]) -> None:
    """At the default step."""
    for flight in jumping:
        jump, table = simulate(flight.robot, Settings(flight="simulated", trajectory=True), "planar"), flight.values
        assert jump.engine == "planar"
        assert jump.ballistic_range_m == pytest.approx(table["ballistic_range_m"], rel=0.003), flight.name
        assert jump.com_rise_m == pytest.approx(table["com_rise_m"], rel=0.003), flight.name
        assert jump.takeoff_energy_ratio == pytest.approx(table["takeoff_energy_ratio"], abs=0.007), flight.name
        assert base_distance_m(jump) == pytest.approx(table["touchdown_distance_m"], abs=0.003), flight.name


def test_the_compiled_flight_is_that_of_all_engines() -> None:
    """The same closed form, from other equations of motion, of robots with a stop."""
    for robot in (built("kenan-2.0"), built("best-printable")):
        for friction in (0.5, 1.2):
            settings = Settings(ground_friction=friction, push_off_steps=0)
            jump, found = simulate(robot, settings, "planar"), touchdown(robot, settings)
            assert (found is None) == (jump.verdict != "jump")
            if found:
                assert found == pytest.approx((jump.touchdown_distance_m, jump.touchdown_pitch_deg), abs=1e-9)


def test_range_converges(jumping: list[Flight]) -> None:
    best = next(flight.robot for flight in jumping if flight.name == "best-bo")
    ranges = [
        simulate(best, Settings(dt_s=1 / rate, push_off_steps=0), "planar").ballistic_range_m
        for rate in (1000, 4000, 16000, 64000)
    ]
    errors = [abs(value / ranges[-1] - 1) for value in ranges[:-1]]
    assert errors[0] > 2 * errors[1] > 4 * errors[2]
    assert errors[2] < 2e-4


@pytest.mark.parametrize("friction", [0.3, 0.6])
def test_slipping(kenan: Robot, friction: float) -> None:
    """Against both engines: some contacts in each are lost before the last."""
    settings = FINE.model_copy(update={"ground_friction": friction})
    planar = simulate(kenan, settings, "planar")
    assert planar.energy is not None
    assert planar.energy.slip_j > 0.005 * planar.spring_energy_j
    needs.package("mujoco")
    assert planar.ballistic_range_m == pytest.approx(simulate(kenan, settings, "mujoco").ballistic_range_m, rel=0.003)
    needs.package("pybullet")
    assert planar.ballistic_range_m == pytest.approx(simulate(kenan, settings, "pybullet").ballistic_range_m, rel=0.002)


def test_a_hop_with_wound_springs_is_no_takeoff(kenan: Robot) -> None:
    """Thrown up by 0.3 mm with springs too weak for a jump: in the air for more than 4 ms, rising, and down again."""
    weak = replace(kenan, springs=(replace(kenan.spring, stiffness_nm_per_rad=0.02),))
    world = PlanarWorld(weak, FINE)
    world.go_to(world.moment._replace(speed=PlanarMotion(0.08j, 0.0, 0.0)))
    thrown = world.moment
    world.advance(round(0.005 / FINE.dt_s))
    assert not world.loaded()
    assert kernel.rising(world.model, world.moment)
    world.go_to(thrown)
    found = world.push_off()
    assert not found.flown
    assert found.steps * FINE.dt_s > 0.02


def test_a_body_that_comes_down_is_said(flights: list[Flight]) -> None:
    """A robot that is too weak, simulated all the same: it rises a little and comes down on its body."""
    robot = next(flight.robot for flight in flights if flight.name == "random-00")
    with PlanarEngine().world(robot, Settings()) as world:
        run = PlanarRun(world, robot, Settings())
        run.go()
    assert run.takeoff is None
    finding = run.findings()[-1]
    assert (finding.name, finding.severity) == ("body_contact", "warning")
    assert -1.0 < finding.margin <= 0.0
    assert "pybullet" in finding.remedy
    run.body_gap_m = -2.5e-4
    assert run.findings()[-1].margin == pytest.approx(-0.25)
    run.body_gap_m = 1e-4  # near, not there
    assert "body_contact" not in [one.name for one in run.findings()]


@pytest.mark.parametrize(("key", "value"), [("restitution", 0.5), ("rolling_friction_m", 0.01)])
def test_what_the_plane_does_not_have_is_refused(kenan: Robot, key: str, value: float) -> None:
    with pytest.raises(JumpcadError, match=f"{key} = {value}.*pybullet"):
        simulate(kenan, Settings(**{key: value}), "planar")


def test_a_dead_point_in_flight_is_said(jumping: list[Flight]) -> None:
    """A leg that turns on to where foot and front link are in line, beyond which its angle does not tell the pose."""
    robot = next(flight.robot for flight in jumping if flight.name == "ga-c")
    world = PlanarWorld(one_sided(robot), Settings())
    speed = PlanarMotion(0j, 0.0, 60.0)
    world.go_to(world.moment._replace(ankle_m=1j, leg_rad=0.0, speed=speed))
    moment, steps = world.moment, 0
    while moment.closed:
        moment, steps = kernel.advance(world.model, moment, world.settings.dt_s, 1), steps + 1
    for more in (0, 1, 50):  # it does not go on from there, where the pose is not known
        assert kernel.advance(world.model, world.moment, world.settings.dt_s, steps + more) == moment
    with pytest.raises(JumpcadError, match=r"into line in flight.*pybullet") as caught:
        world.advance(200)
    assert "\n" not in str(caught.value)
