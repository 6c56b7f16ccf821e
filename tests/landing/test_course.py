"""To points and along courses: geometry of the way, the turn of a wheel, and who is refused."""

import math
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from support.commands import exit_code_of

import jumpcad
from jumpcad.cli import going
from jumpcad.errors import JumpcadError
from jumpcad.landing import course
from jumpcad.landing.arena import Arena, Floor
from jumpcad.landing.course import Course, _aside_deg
from jumpcad.landing.obstacles import Obstacle
from jumpcad.landing.series import Hop
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.limits import steers
from jumpcad.settings import Settings
from jumpcad.simulation import simulate

pytest.importorskip("mujoco")
FAR = {"kind": "bar", "at_m": (5.0, 5.0), "height_mm": 20.0}


@pytest.fixture(scope="module")
def robot() -> Robot:
    return jumpcad.build("best-steered")


def test_two_jumps_beside_the_point_end_at_it() -> None:
    for left_m in (0.1, 0.5, 1.3, 1.59):
        angle = math.radians(_aside_deg(left_m, 0.8, 0.1))
        corner = 0.8 * np.array([math.cos(angle), math.sin(angle)])
        assert np.linalg.norm([left_m, 0.0] - corner) == pytest.approx(0.8)
    assert _aside_deg(0.75, 0.8, 0.1) == _aside_deg(3.0, 0.8, 0.1) == 0.0


def test_the_wheel_turns_it_by_the_angle_on_firm_floors_and_either_way(robot: Robot) -> None:
    arena = Arena(robot)
    for floor, angle in ((Floor(), 40.0), (Floor(0.7), -40.0), (Floor(1.4, 0.0005), 20.0)):
        arena.stand_on(floor)
        arena.stand("home")
        arena.wind(1.0)
        arena.step(0.5, quiet=True)
        before = arena.heading_rad
        arena.steer(angle)
        share = math.degrees(arena.heading_rad - before) / angle  # to the right it rocks from toe to toe
        assert (0.9 if angle > 0.0 else 0.8) < share < 1.05, floor
        assert arena.stands


def test_who_jumps_aside_aims_beside_the_point_from_the_third_jump_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """A point that jumps 0.5 m, 20° to the left of where it looks."""
    robot = SimpleNamespace(layout=SimpleNamespace(drive=SimpleNamespace(train=SimpleNamespace(electrical_j=0.0))))
    at = SimpleNamespace(centre_of_mass_m=np.zeros(3), heading_rad=0.0, stands=True, robot=robot)
    at.stand = lambda _pose: None
    at.steer = lambda angle_deg, _watch: vars(at).update(heading_rad=at.heading_rad + math.radians(angle_deg))
    aside_deg = []

    def jump(_arena: object, _rng: object, _recorder: object, turn: Callable[[], None]) -> Hop:
        turn()
        jumps, way = at.heading_rad + math.radians(20.0), np.array([4.0, 0.0]) - at.centre_of_mass_m[:2]
        aside_deg.append(math.degrees(jumps - math.atan2(way[1], way[0])))
        at.centre_of_mass_m = at.centre_of_mass_m + 0.5 * np.array([math.cos(jumps), math.sin(jumps), 0.0])
        return Hop(True, 0.5, 0.3, 0.0, 1.0)

    monkeypatch.setattr(course, "steers", lambda _robot: SimpleNamespace(figures={"turn_energy_j": 0.0}))
    monkeypatch.setattr(course, "hop", jump)
    to, rng = Course(points_m=((4.0, 0.0),)), np.random.default_rng(0)
    trip = course._trip(at, [np.array([4.0, 0.0])], to, rng, SimpleNamespace(on=False), 0.0, 0.5)
    assert trip.arrived
    assert aside_deg[:5] == pytest.approx([20.0, 10.0, 0.0, 0.0, 0.0], abs=2.0)


@pytest.mark.thorough
def test_it_reaches_points_and_its_rows_say_how(robot: Robot) -> None:
    """Each row begins where the last one ended; a try is the same whatever is tried after it."""
    point, turn_j = (-1.6, 1.8), steers(robot).figures["turn_energy_j"] / 90.0
    found, once = jumpcad.go(robot, point, 2), jumpcad.go(robot, point, 1)
    assert found.trips[:1] == once.trips
    assert found.share_arrived == 1.0
    for trip in found.trips:
        *others, last = trip.hops
        assert math.dist(last.place_m, point) == pytest.approx(last.left_m, abs=1e-9)
        assert last.left_m <= 0.35 < min(one.left_m for one in others)
        assert trip.hops[0].turn_deg == pytest.approx(131.6, abs=30.0)  # heading known to 3°, a soft floor lets it slip
        turned = sum(abs(one.turn_deg) for one in trip.hops)
        wound_j = robot.layout.drive.train.electrical_j * len(trip.hops)
        assert trip.energy_j == pytest.approx(wound_j + turned * turn_j)


@pytest.mark.thorough
def test_it_lands_where_its_flight_without_the_wheel_ends(robot: Robot) -> None:
    """It rests on wheel, nose and toe before its release; begun a wheel's depth in the floor it lost a quarter."""
    arena = Arena(robot)
    arena.stand()
    assert arena.lowest_m() == pytest.approx(0.0, abs=2e-4)
    ways = [one.touchdown_m for one in jumpcad.land(robot, 3).tries]
    assert np.median(ways) == pytest.approx(simulate(robot, Settings(), "mujoco").touchdown_distance_m, rel=0.08)


@pytest.mark.thorough
def test_a_wall_stops_it(robot: Robot) -> None:
    wall = Obstacle(kind="wall", at_m=(0.35, 0.0), height_mm=500.0)
    course = Course(points_m=((0.8, 0.0),), obstacles=(wall,))
    first = jumpcad.go(robot, course, 1).trips[0].hops[0]
    assert first.struck == (1,)
    assert first.place_m[0] < 0.35


def test_who_is_refused(robot: Robot) -> None:
    charge = r"2000 m are \d+ jumps of \d\.\d\d m, and a full battery gives \d+: go at most \d+ m"
    with pytest.raises(JumpcadError, match=charge):
        jumpcad.go(robot, Course(points_m=((900.0, 0.0), (0.0, 0.0), (200.0, 0.0))), 1)
    with pytest.raises(JumpcadError, match="heading_noise_deg = -1: must be at least 0"):
        jumpcad.go(robot, heading_noise_deg=-1.0)
    for at_m in ((0.0, 0.0), (-1.0, 0.2)):
        step = Obstacle(kind="step", at_m=at_m, height_mm=100.0)
        with pytest.raises(JumpcadError, match="obstacle 2 stands where the robot does"):
            jumpcad.go(robot, Course(points_m=((1.0, 0.0),), obstacles=(Obstacle(**FAR), step)), 1)


def test_the_jumps_of_a_way_are_counted_in_the_open(robot: Robot) -> None:
    """A wall before its nose, which it turns away from, does not make its jumps shorter."""
    said = []
    for obstacles in ((), (Obstacle(kind="wall", at_m=(0.3, 0.0), height_mm=500.0),)):
        with pytest.raises(JumpcadError, match="a full battery gives") as refused:
            jumpcad.go(robot, Course(points_m=((-900.0, 0.0),), obstacles=obstacles), 1)
        said.append(str(refused.value))
    assert said[0] == said[1]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("points_m = []", "points_m = []: must have at least 1"),
        ("points_m = [[1.0]]", "must have at least 2 values"),
        ("points_m = [[1, 2]]\nwithin = 1", "within: unknown key (did you mean within_m?)"),
        ('points_m = [[1, 2]]\n[[obstacles]]\nkind = "hole"\nat_m = [1, 1]\nheight_mm = 5', "'bar', 'step' or 'wall'"),
        ("points_m = [[1, 2]", "c.toml"),
        ("points_m = [[1, 2], [nan, 0]]", "c.toml: points_m.1.0 = nan: must be a finite number\n"),
    ],
)
def test_a_wrong_course_is_one_line(text: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "c.toml"
    path.write_text(text, encoding="utf-8")
    assert exit_code_of("simulate", "kenan-2.0", "--course", str(path)) == 2
    said = capsys.readouterr()
    assert words in said.err
    assert (said.out, said.err.count("\n")) == ("", 1)


@pytest.mark.thorough
def test_an_interrupt_keeps_the_tries_that_ended(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    trips = jumpcad.landing.course.trips

    def interrupted(*asked: object) -> object:
        yield next(trips(*asked))  # type: ignore[arg-type]
        raise KeyboardInterrupt

    monkeypatch.setattr("jumpcad.landing.course.trips", interrupted)
    found, whole = going.tries_of(robot, (0.9, 0.0), 5, 0, jumpcad.Settings(), 3.0, False)
    assert (len(found), whole) == (1, False)
