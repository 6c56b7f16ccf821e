"""The equations of the release against closed forms; whole releases in test_release.py."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import integrate
from support.built import built

from jumpcad.drive import rolling
from jumpcad.drive.corner import Corner, roll_over
from jumpcad.drive.rolling import ReleaseParts, _Release, roll

WIND_RAD = 0.6


def parts(**other: float) -> ReleaseParts:
    return replace(built("best-ga").release.parts[1], friction_mm=0.0, **other)


def arc(slope: float, span_rad: float = 0.5) -> Corner:
    """Return a corner on which the roller's wind angle falls evenly by the cam's angle, 20 mm from the leg's pivot."""
    cam, even = np.linspace(0.0, span_rad, 401), np.ones(401)
    return Corner(cam, WIND_RAD - slope * cam, -slope * even, 0.0 * even, 20.0 * even)


@pytest.mark.parametrize(("turned_rad", "cam_rad_s"), [(0.1, 8.0), (0.2, 8.0), (0.4, 8.0), (0.05, 0.4)])
def test_the_leg_swings_on_its_lever_as_a_mass_on_springs(turned_rad: float, cam_rad_s: float) -> None:
    """On a level corner about where springs, weight and lever balance, with the root of (k + K)/I as frequency.

    However slowly the motor turns the cam.
    """
    given = parts(cam_rad_s=cam_rad_s)
    release = _Release(arc(0.0), given)
    begin, release.rate = release.wind, 0.02
    stop = round(turned_rad / release.step)
    release._push_to(stop)
    inertia, _, weight = (float(one) for one in given.leg.at(np.array(WIND_RAD)))
    spring, held = given.spring, given.held_nm_per_rad
    torque = spring.stiffness_nm_per_rad * (begin + spring.preload_rad) + weight
    assert held * (WIND_RAD - begin) == pytest.approx(torque), "in balance"
    frequency = math.sqrt((held + spring.stiffness_nm_per_rad) / inertia)
    phase = frequency * turned_rad / cam_rad_s
    assert release.at == stop
    assert release.speed == pytest.approx(cam_rad_s)
    assert release.wind - begin == pytest.approx(0.02 / frequency * math.sin(phase), abs=0.05 * 0.02 / frequency)
    assert release.rate == pytest.approx(0.02 * math.cos(phase), abs=0.05 * 0.02)


def test_the_corner_turns_the_levers_torque_by_its_slope() -> None:
    """A leg as heavy as a rock stands still: the lever's energy becomes that of cam and roller, at a ratio of 0.2."""
    given = parts(cam_rad_s=0.01)
    release = _Release(arc(0.2, 0.01), given)
    release.leg_inertia = 1e9 * release.leg_inertia
    begin = release.wind
    release._push_to(300)
    held, moved = given.held_nm_per_rad, 0.2 * 300 * release.step
    bent = 0.5 * held * ((WIND_RAD - begin) ** 2 - (WIND_RAD - moved - begin) ** 2)
    assert release.wind == pytest.approx(begin, abs=1e-6)
    assert release.at == 300
    assert 0.5 * (given.cam_kg_m2 + given.roller_kg_m2 * 0.2**2) * release.speed**2 == pytest.approx(bent, rel=0.03)


@pytest.mark.parametrize("speed", [10.0, 50.0, 90.0])
def test_the_roller_leaves_a_corner_that_falls_away_too_fast(speed: float) -> None:
    """Cam and roller as one mass whose ratio grows, in Lagrange's equation, until the contact's force is nothing."""
    given = parts(cam_rad_s=speed, roller_kg_m2=5e-7, cam_kg_m2=2e-7)
    cam = np.linspace(0.0, 0.01, 801)
    falls = 100.0
    corner = Corner(cam, WIND_RAD - falls * cam**2 / 2.0, -falls * cam, -falls + 0.0 * cam, 20.0 + 0.0 * cam)
    release = _Release(corner, given)
    release.leg_inertia = 1e9 * release.leg_inertia
    begin = release.wind
    release._push_to(800)

    def moving(_: float, state: np.ndarray) -> tuple[float, float]:
        angle, rate = state
        torque = given.held_nm_per_rad * (WIND_RAD - falls * angle**2 / 2.0 - begin)
        inertia = given.cam_kg_m2 + given.roller_kg_m2 * (falls * angle) ** 2
        return rate, (falls * angle * torque - given.roller_kg_m2 * falls**2 * angle * rate**2) / inertia

    def pressed(_: float, state: np.ndarray) -> float:
        angle, rate = state
        torque = given.held_nm_per_rad * (WIND_RAD - falls * angle**2 / 2.0 - begin)
        return torque - given.roller_kg_m2 * falls * (rate**2 + angle * moving(_, state)[1])

    pressed.terminal = True  # type: ignore[attr-defined]
    exact = integrate.solve_ivp(moving, (0.0, 1.0), (0.0, speed), events=pressed, rtol=1e-9, atol=1e-12)
    assert not release.touches
    assert cam[release.at] == pytest.approx(exact.y[0, -1], abs=2.0 * release.step)
    assert release.speed == pytest.approx(exact.y[1, -1], rel=0.02)


@pytest.mark.parametrize("falls", [0.0, 100.0])
def test_a_corner_is_the_same_however_many_parts_it_is_followed_in(falls: float) -> None:
    """A level one to its end, and one that falls away until the roller leaves it; no stop behind the cam moves it."""
    cam = np.linspace(0.0, 0.01, 801)
    corner = Corner(cam, WIND_RAD - falls * cam**2 / 2.0, -falls * cam, -falls + 0.0 * cam, 20.0 + 0.0 * cam)
    found = []
    for stops in ((800,), (100, 101, 60, 300, 800)):
        release = _Release(corner, parts(cam_rad_s=50.0, roller_kg_m2=5e-7, cam_kg_m2=2e-7))
        for stop in stops:
            release._push_to(stop)
        found.append((release.at, release.touches, release.speed, release.wind, release.rate))
    assert found[1] == pytest.approx(found[0], rel=1e-12)
    assert (found[0][0] == 800) == found[0][1] == (falls == 0.0)


def test_what_the_corner_pushes_turns_the_rotor_too() -> None:
    """The lever's torque at the corner's slope turns cam, gear and rotor alike; each has its share of it."""
    given = parts(cam_rad_s=0.5)
    release = _Release(arc(0.2, 0.001), given)
    release.leg_inertia = 1e9 * release.leg_inertia
    release.inertia = given.cam_kg_m2 + given.gear_kg_m2 + given.rotor_kg_m2
    torque = given.held_nm_per_rad * (WIND_RAD - release.wind)
    release._push_to(10)
    assert release.kick_nm == pytest.approx(0.2 * torque * given.rotor_kg_m2 / release.inertia, rel=1e-3)
    alone = _Release(arc(0.2, 0.001), given)
    alone._push_to(10)
    assert alone.kick_nm == 0.0


@pytest.mark.parametrize("with_rotor", [False, True])
def test_the_corner_pushes_the_rollers_mass_until_the_rotor_turns_too(with_rotor: bool) -> None:
    """Cam and gear alone have no kick, and the roller's own mass at the corner's slope beside them."""
    given = parts(cam_rad_s=0.5, roller_kg_m2=built("best-ga").release.parts[1].gear_kg_m2 / 4.0)
    release = _Release(arc(0.2, 0.001), given)
    release.leg_inertia = 1e9 * release.leg_inertia
    release.inertia = given.cam_kg_m2 + given.gear_kg_m2 + (1e-7 if with_rotor else 0.0)
    torque = given.held_nm_per_rad * (WIND_RAD - release.wind)
    release._push_to(10)
    moved = release.inertia + (0.0 if with_rotor else 0.2**2 * given.roller_kg_m2)
    work = 0.2 * torque * 10 * release.step
    assert 0.5 * moved * (release.speed**2 - 0.5**2) == pytest.approx(work, rel=1e-2)
    assert (release.kick_nm > 0.0) == with_rotor


def test_masses_that_join_keep_their_momentum_and_wind_up_what_is_between_them() -> None:
    """What they lose in speed is in the train's spring at its largest torque: T²/(2·k)."""
    given = parts(cam_rad_s=1.0)
    release = _Release(arc(0.2), given)
    release.speed = 3.0
    first, second = given.cam_kg_m2, 2.5 * given.cam_kg_m2
    torque = release._join(second)
    assert release.inertia == pytest.approx(first + second)
    assert release.inertia * release.speed == pytest.approx(first * 3.0)
    lost = 0.5 * first * 3.0**2 - 0.5 * release.inertia * release.speed**2
    assert torque**2 / (2.0 * given.train_nm_per_rad) == pytest.approx(lost)


@pytest.mark.parametrize("slope", [0.2, -0.3])
def test_at_first_the_leg_goes_on_as_the_lift_turns_it(slope: float) -> None:
    """By the corner's slope where it begins, at the motor's speed; the lever is bent as in balance."""
    given = parts(cam_rad_s=3.0)
    rounded = arc(-slope)
    release = _Release(replace(rounded, slope=rounded.slope - 2.0 * rounded.cam_rad), given)
    assert release.rate == pytest.approx(3.0 * slope)
    assert release.wind == given.held_rad(WIND_RAD)
    assert (release.speed, release.inertia) == (3.0, given.cam_kg_m2)


def test_a_play_is_counted_from_where_the_corner_first_drives_the_cam() -> None:
    cam = np.linspace(0.0, 0.5, 401)
    slope = np.where(cam < 0.1, 0.2, -0.2)  # the leg rises at first
    corner = Corner(cam, WIND_RAD + np.cumsum(slope) * cam[1], slope, 0.0 * cam, 20.0 + 0.0 * cam)
    release = _Release(corner, parts())
    assert cam[release.first] == pytest.approx(0.1, abs=release.step)
    assert cam[release._index(0.15)] == pytest.approx(cam[release.first] + 0.15, abs=release.step)
    assert release._index(3.0) == 400
    lagging = _Release(corner, replace(parts(), friction_mm=0.3 * 20.0))
    assert lagging.first == lagging.last == 400, "with friction above its slope no corner drives"


def test_the_cam_has_run_ahead_by_an_angle_at_the_first_index_at_or_beyond_it() -> None:
    release = _Release(arc(0.3), parts())
    for share in (0.0, 0.1, 1.0, 1.9, 17.5):
        steps = release._index(share * release.step) - release.first
        assert steps - 1 < share <= steps
    assert release._index(1.0) == release.last


def test_what_is_kept_is_the_springs_energy_and_the_legs_own() -> None:
    """With the leg's moment of inertia where the roller leaves."""
    robot = built("best-ga")
    given = robot.release.parts[1]
    corner = roll_over(robot.layout.drive.cam.geometry)
    rolled = roll(corner, given, float(corner.wind_rad.max()))
    inertia = float(given.leg.at(np.array(rolled.wind_rad))[0])
    swing = 0.5 * inertia * rolled.wind_rad_s**2
    assert rolled.kept_j == pytest.approx(given.spring.stored_j(-rolled.wind_rad) + swing)
    release = _Release(corner, given)
    release.run()
    assert release.blow_nm != release.kick_nm
    assert (rolled.blow_nm, rolled.kick_nm) == (release.blow_nm, release.kick_nm)
    assert (rolled.wind_rad, rolled.wind_rad_s) == (release.wind, release.rate)
    assert rolled.held_j == given.spring.stored_j(-given.held_rad(float(corner.wind_rad.max())))


@pytest.mark.parametrize(
    ("play_rad", "backlash_rad", "stops_rad", "pushed"),
    [(0.1, 0.05, [0.1, 0.15], True), (0.1, 9.0, [0.1, 0.5], False), (0.0, 0.05, [0.05], True), (0.0, 9.0, [0.5], True)],
)
def test_gear_and_rotor_join_where_play_and_backlash_end(
    monkeypatch: pytest.MonkeyPatch, play_rad: float, backlash_rad: float, stops_rad: list[float], pushed: bool
) -> None:
    """On a corner of 0.5 rad; whom a rigid key pushes, or the corner still, is what it meets at the rotor."""
    given = parts(play_rad=play_rad, backlash_rad=backlash_rad)
    release, stops, ends = _Release(arc(0.1), given), [], []
    monkeypatch.setattr(rolling, "largest_torques_nm", lambda *_: (0.5, 0.25))
    monkeypatch.setattr(release, "_push_to", stops.append)
    monkeypatch.setattr(release, "_push_off", ends.append)
    monkeypatch.setattr(release, "_join", lambda inertia: 2.0)
    release.run()
    assert [release.corner.cam_rad[stop] for stop in stops] == pytest.approx(stops_rad, abs=1.01 * release.step)
    assert ends == (stops[-1:] if pushed else [])
    assert release.kick_nm == (2.0 if pushed else 0.25)
    assert release.blow_nm == (0.5 if play_rad else 0.0)
    assert release.inertia == given.cam_kg_m2 + (0.0 if play_rad else given.gear_kg_m2)


@pytest.mark.parametrize("below", [False, True])
def test_a_leg_that_falls_to_the_corner_has_what_the_springs_and_itself_had(below: bool) -> None:
    """It is bent by nothing then; a leg that is already below the corner's place bends its lever by what it is."""
    release = _Release(arc(0.2), parts())
    at, rate = 250, -1.5
    here = float(release.corner.wind_rad[at])
    release.wind, release.rate, release.touches = here - 0.01 if below else here + 0.05, rate, False
    begin, spring = release.wind, release.parts.spring
    release._fall_to(at)
    lost = spring.stored_j(-begin) - spring.stored_j(-here)
    assert (release.at, release.touches) == (at, True)
    assert release.wind == min(begin, here)
    assert release.rate == pytest.approx(-math.sqrt(max(rate**2 + 2.0 * lost / float(release.leg_inertia[at]), 0.0)))
    assert (lost < 0.0) == below
