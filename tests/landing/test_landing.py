"""Landings, righting and jumps in a row, against mechanics and against the jump that engines simulate."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.built import built

from jumpcad.bundle.motion import series_motion
from jumpcad.collision.hulls import share_on_feet
from jumpcad.errors import JumpcadError
from jumpcad.landing.arena import Arena, Floor
from jumpcad.landing.landing import land, share_righted
from jumpcad.landing.series import Hop, Recorder, Series, jumps
from jumpcad.mechanism.model import BODY_NAMES
from jumpcad.robot.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation import simulate
from jumpcad.simulation.mechanics import Mechanics, loaded_state

pytest.importorskip("mujoco")
NOT_TURNED = np.array([1.0, 0.0, 0.0, 0.0])


@pytest.fixture
def arena(strongest: Robot) -> Arena:
    return Arena(strongest)


def test_a_wound_robot_stands_as_high_as_its_bodies_say(arena: Arena, strongest: Robot) -> None:
    arena.stand()
    arena.step(0.3, quiet=True)
    expected = Mechanics(strongest, 9.81).centre_of_mass_m(loaded_state(strongest))
    assert arena.centre_of_mass_m[2] == pytest.approx(expected[2], abs=2e-4)
    assert arena.stands
    assert arena.rests_on == "feet"


def test_its_hulls_touch_down_where_the_closed_form_says() -> None:
    """Contacts of MuJoCo's convex hulls, of a robot that lands on its back, where spheres alone reach 5 % farther."""
    robot = built("best-printable")
    arena, touched = Arena(robot), list[float]()
    arena.stand()
    start = arena.centre_of_mass_m
    arena.release()
    arena.fall()
    arena.rest(lambda: touched.append(float((arena.centre_of_mass_m - start)[0])) if arena.data.ncon else None)
    assert simulate(robot, engine="mujoco").touchdown_distance_m == pytest.approx(touched[0], rel=0.02)


def test_a_dropped_robot_falls_as_a_stone_does(arena: Arena) -> None:
    """From 0.2 m for √(2·h/g), its lowest point first; thrown sideways it keeps its speed."""
    arena.put(NOT_TURNED, 0.2, np.array([0.5, 0.0, 0.0]), np.zeros(3))
    assert arena.lowest_m() == pytest.approx(0.2, abs=1e-6)
    arena.step(math.sqrt(2.0 * 0.2 / 9.81) - 0.004)
    assert 0.0 < arena.lowest_m() < 0.009
    assert arena.velocity_m_s[0] == pytest.approx(0.5, abs=1e-3)
    assert arena.data.ncon == 0


def test_a_released_robot_rises_as_the_engine_says(arena: Arena, strongest: Robot) -> None:
    arena.stand()
    start, highest = arena.centre_of_mass_m[2], 0.0
    arena.release()

    def look() -> None:
        nonlocal highest
        highest = max(highest, arena.centre_of_mass_m[2])

    assert arena.fall(look)
    assert highest - start == pytest.approx(simulate(strongest, engine="mujoco").com_rise_m, rel=0.01)


def test_a_turned_robot_keeps_place_and_momentum_of_its_centre(arena: Arena) -> None:
    arena.put(NOT_TURNED, 0.3, np.array([0.4, 0.1, 0.2]), np.array([0.0, 3.0, 0.0]))
    before = np.concatenate([arena.centre_of_mass_m, arena.velocity_m_s])
    quarter = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    arena.turn(quarter, np.zeros(3))
    np.testing.assert_allclose(np.concatenate([arena.centre_of_mass_m, arena.velocity_m_s]), before, atol=1e-9)
    assert not arena.stands
    assert arena.rests_on == "right"


def test_a_slippery_floor_lets_a_robot_slide_farther(arena: Arena) -> None:
    """As the square of speed over friction: with a third of it at least twice as far."""
    slid = []
    for friction in (1.0, 1.0 / 3.0):
        arena.stand_on(Floor(friction))
        arena.put(np.array([math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0]), 0.001, np.array([1.0, 0.0, 0.0]), np.zeros(3))
        start = arena.centre_of_mass_m[0]
        arena.rest()
        slid.append(arena.centre_of_mass_m[0] - start)
    assert slid[1] > 2.0 * slid[0] > 0.0


@pytest.mark.thorough
def test_landings_are_those_of_their_seed(strongest: Robot) -> None:
    first, again, other = (land(strongest, 3, seed) for seed in (1, 1, 2))
    assert first == again
    assert first != other
    assert sum(first.rests_on.values()) == 3
    assert all(0.4 < one.touchdown_m < 0.7 for one in first.tries)
    for few in (0, -1):
        with pytest.raises(JumpcadError, match=f"tries = {few}: "):
            land(strongest, few)


def test_jumps_in_a_row_begin_where_the_last_one_ended(strongest: Robot) -> None:
    series, once = jumps(strongest, 2, seed=3), jumps(strongest, 1, seed=3)
    assert series.hops[0].stood
    assert once.hops == series.hops[:1]
    assert once.stands_again == series.hops[1].stood  # looked at after the last jump too
    assert series.distance_m <= series.way_m + 0.05  # winding shifts it too
    train = strongest.layout.drive.train
    assert series.seconds_per_jump > train.winding_s + 2.0 + 3.5
    energy = train.electrical_j / (strongest.mass_kg * 9.81 * once.way_m)
    assert once.cost_of_transport == pytest.approx(energy)
    with pytest.raises(JumpcadError, match="count = 0: "):
        jumps(strongest, 0)


def test_a_charge_takes_a_robot_until_it_lies(strongest: Robot) -> None:
    """One that always stands uses the battery up; what one that lies does is no way, however often it is asked."""
    hop = jumps(strongest, 1, seed=3).hops[0]
    lies = replace(hop, stood=False, way_m=0.01)

    def series(*hops: Hop, again: bool) -> Series:
        return Series(hops, 0.0, 1.0, 2.0, 100, again, 170.0)

    assert series(hop, again=True).metres_per_charge == pytest.approx(100.0 * hop.way_m)
    assert series(hop, hop, again=True).metres_per_charge == pytest.approx(100.0 * hop.way_m)
    for one in (series(hop, again=False), series(hop, lies, again=False), series(hop, lies, hop, again=True)):
        assert (one.unaided, one.metres_per_charge) == (1, pytest.approx(hop.way_m))
        assert one.cost_of_transport == pytest.approx(2.0 / hop.way_m)
    assert series(hop, lies, again=False).heading_drift_deg is None
    back = replace(hop, heading_deg=-170.0)
    assert series(hop, back, back, again=True).heading_drift_deg == pytest.approx(20.0)  # of about 170, 0 and 20


def test_on_the_moon_it_rises_about_six_times_as_high(strongest: Robot) -> None:
    heights = [jumps(strongest, 1, settings=Settings(gravity_m_s2=g)).hops[0].height_m for g in (9.81, 1.62)]
    assert heights[1] / heights[0] == pytest.approx(9.81 / 1.62, rel=0.06)


def test_stable_poses_of_a_robot_without_a_cage_are_mostly_its_sides(strongest: Robot) -> None:
    """A figure between 0 and 1; what few stable poses on the feet promise, drops keep."""
    static = share_on_feet(strongest)
    assert 0.0 < static < 0.4
    assert share_righted(strongest, 12, np.random.default_rng(0)) < 0.5


def test_recorded_jumps_keep_their_energy_in_the_air(strongest: Robot) -> None:
    """What the springs hold when wound; in free flight, its legs on their stop, gains of height cost speed."""
    series = jumps(strongest, 2, seed=3, record=True)
    path = series.trajectory
    assert path is not None
    assert len(path.time_s) == len(series.phases)
    assert np.all(np.diff(path.time_s) >= 0.0)
    assert path.spring_j[series.phases.index("push-off 1") - 1] == pytest.approx(strongest.spring.energy_j, rel=0.01)
    flight = [index for index, phase in enumerate(series.phases) if phase == "flight 1"][8:]
    energy = (path.kinetic_j + path.potential_j + path.spring_j)[flight]
    assert np.ptp(energy) < 0.01 * energy.mean()
    assert np.ptp(path.potential_j[flight]) > 0.3 * energy.mean()
    assert jumps(strongest, 2, seed=3).hops == series.hops


def test_a_flight_ends_with_its_first_touch_though_none_is_seen_at_a_look() -> None:
    """Contacts at the steps from look to look, while it rises and while it falls: a toe may touch as it leaves."""
    data = SimpleNamespace(ncon=0, time=0.0, xpos=np.zeros((4, 3)), xquat=np.zeros((4, 4)))
    arena = SimpleNamespace(data=data, bodies=dict(zip(BODY_NAMES, range(4), strict=True)), energies_j=(0.0, 0.0, 0.0))
    recorder = Recorder(arena, True, 1, ["push-off 1"])  # type: ignore[arg-type]
    for contacts, upwards in (((1, 0), 1.0), ((1, 0), 1.0), ((0, 0), -1.0), ((1, 0), -1.0)):
        arena.velocity_m_s = np.array([0.0, 0.0, upwards])
        for data.ncon in contacts:
            recorder.watch()
        recorder.look()
    assert recorder.phases[1:] == ["flight 1"] * 3 + ["landing 1"]


def test_the_viewer_shows_recorded_jumps_at_their_places(strongest: Robot) -> None:
    """It ends where the strongest lies, and the cam turns once a jump."""
    series = jumps(strongest, 2, seed=3, record=True)
    shown = series_motion(strongest, series)
    assert list(shown["phases"]) == list(dict.fromkeys(series.phases))
    assert shown["frames"]["body"][-1][:3] == pytest.approx(series.trajectory.position_m[-1, 0], abs=1e-5)  # type: ignore[union-attr]
    assert np.all(np.diff(shown["show_s"]) >= 0.0)
    cams = [shown["cam_rad"][shown["phase"].index(name)] for name in ("winding 1", "winding 2")]
    assert cams[1] - cams[0] == pytest.approx(2.0 * math.pi, abs=0.5)
    x, _z, y = shown["com_m"][-1]
    assert math.hypot(x - shown["com_m"][0][0], y - shown["com_m"][0][2]) == pytest.approx(series.distance_m, abs=0.02)
