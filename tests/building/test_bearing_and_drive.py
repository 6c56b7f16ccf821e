"""Settled parts agree with each other: the drive fits its sections, the bearing carries the drive's forces."""

import math
from dataclasses import fields, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from support.built import built
from support.each import each
from support.masses import in_plane
from support.strengths import with_motor_of, with_own
from support.workshops import workshop_with
from threadpoolctl import threadpool_limits

from jumpcad.building import bearing_and_drive as settling
from jumpcad.building.bearing_and_drive import Settled, _require_hub_room, drive_limits, fall_s, solve_bearing_and_drive
from jumpcad.catalogue import load_catalogue
from jumpcad.design import Design, load_design
from jumpcad.dimensions import GAP_MM, SPACER_RADIUS_MM
from jumpcad.drive import DriveLimits, synthesise
from jumpcad.drive.cam_search import synthesise_cam
from jumpcad.drive.release import _kick_limit_nm
from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.planar import reflected_mass
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.sizing import RESERVE, sections
from jumpcad.strength.bearings import allowed_n, bearing_load_n, hub_bearings, hub_width_mm, loaded_forces_n
from jumpcad.strength.growth import Growth
from jumpcad.transforms import turned_about_y
from jumpcad.workshop import Workshop, load_workshop
from jumpcad.workshop.workshop import Role


def careful(factor: float) -> Workshop:
    return workshop_with(safety={"bearing_factor": factor})


def load_n(settled: Settled) -> float:
    assert settled.holes.bearing is not None
    forces = loaded_forces_n(settled.linkage.design, settled.drive)
    return bearing_load_n(forces, settled.sections.thickness_mm, settled.roller.width_mm, settled.holes.bearing)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_settling_again_changes_nothing(name: str, factor: float) -> None:
    """Sections, limits and drive that follow from what was settled are those that were settled."""
    workshop, design = careful(factor), load_design(name)
    settled = solve_bearing_and_drive(design, workshop, Growth())
    sizes = sections(settled.linkage, workshop, hub_width_mm(settled.holes.bearing), Growth())
    assert sizes == settled.sections
    limits = drive_limits(workshop, settled.roller, sizes, settled.holes)
    past_rad = math.radians(3.0 + 3.0)  # the stop, and what its pad may give
    falls_s = fall_s(settled.linkage, springs_on_leg(design), past_rad)
    drive = synthesise(design, replace(limits, fall_s=falls_s))
    assert drive.spring == settled.drive.spring
    assert drive.train == settled.drive.train
    assert drive.cam.profile_mm.tobytes() == settled.drive.cam.profile_mm.tobytes()


def test_a_cam_does_not_depend_on_the_threads_of_the_linear_algebra() -> None:
    """The best one lies on a kink, where sums in another order end elsewhere; found at random, one of a hundred."""
    design = Design.from_vector([167.4201, 0.9483, 0.5257, 1.015, 0.6302, 29.5419, 11.6559, 47.5284])
    outlines = []
    for threads in (1, 2):
        synthesise_cam.cache_clear()
        with threadpool_limits(threads):
            outlines.append(solve_bearing_and_drive(design, load_workshop(), Growth()).drive.cam.profile_mm.tobytes())
    assert outlines[0] == outlines[1]


def test_the_hub_has_the_lightest_bearing_that_bears_it() -> None:
    design, masses = load_design("best-bo"), []
    for factor in (0.4, 0.65, 0.75):  # times the reserves: the strongest of the catalogue bears no more
        workshop = careful(factor)
        settled = solve_bearing_and_drive(design, workshop, Growth())
        assert settled.holes.bearing is not None
        assert load_n(settled) <= allowed_n(settled.holes.bearing, workshop)
        masses.append(settled.holes.bearing.mass_g)
        for lighter in hub_bearings(workshop):
            if lighter is not None and lighter.mass_g < settled.holes.bearing.mass_g:
                forces = loaded_forces_n(design, settled.drive)
                width = settled.sections.thickness_mm
                assert bearing_load_n(forces, width, 4.0, lighter) > allowed_n(lighter, workshop)
    assert masses == sorted(masses)
    assert masses[0] < masses[-1]


def test_where_none_bears_it_the_strongest_stays() -> None:
    workshop = careful(20.0)
    settled = solve_bearing_and_drive(load_design("best-bo"), workshop, Growth())
    assert settled.holes.bearing == hub_bearings(workshop)[-1]
    assert load_n(settled) > allowed_n(settled.holes.bearing, workshop)


def test_a_plain_hub_is_as_thin_as_the_leg() -> None:
    plain = workshop_with(bought={"leg_bearing": ""})
    settled = solve_bearing_and_drive(load_design("kenan-2.0"), plain, Growth(thickness=1.1))
    assert settled.holes.bearing is None
    assert settled.sections.thickness_mm == pytest.approx(1.1 * 6.0)


def test_the_hub_keeps_off_the_spacer_on_the_cams_axle_and_off_the_rollers_screw() -> None:
    """By a wall and a gap, on both sides of its middle; by the thinnest wall beside the screw's hole."""
    settled = solve_bearing_and_drive(load_design("kenan-2.0"), load_workshop(), Growth())
    fits = settled.holes.fits.model_copy(update={"wall_min_mm": 0.9, "wall_mm": 1.7, "press_mm": 0.08})
    holes = replace(settled.holes, fits=fits)
    to_spacer = 16.0 - SPACER_RADIUS_MM - GAP_MM - 2.0 * 1.7 - 0.08
    to_screw = 14.0 - holes.fits.m3_clearance_mm / 2.0 - 0.9 - 0.08
    for axis_mm, lever_mm, free in ((16.0, 100.0, 2.0 * to_spacer), (90.0, 14.0, 2.0 * to_screw)):
        cam = SimpleNamespace(geometry=SimpleNamespace(axis_mm=np.array([0.0, axis_mm]), lever_mm=lever_mm))
        bearings = (holes.bearing.model_copy(update={"outer_mm": free + more}) for more in (-0.01, 0.01))
        beside = replace(settled, drive=SimpleNamespace(cam=cam))
        just, wide = (replace(beside, holes=replace(holes, bearing=one)) for one in bearings)
        _require_hub_room(just)
        with pytest.raises(CannotBuildError, match=rf"diameter; {free:.1f} mm fit") as refused:
            _require_hub_room(wide)
        assert (refused.value.limit, refused.value.margin) == ("leg_bearing", pytest.approx(-0.01))


def test_the_leg_falls_by_springs_with_the_preload_of_the_workshop(monkeypatch: pytest.MonkeyPatch) -> None:
    seen, workshop = [], load_workshop()
    monkeypatch.setattr(settling, "fall_s", lambda *given: seen.append(given) or fall_s(*given))
    solve_bearing_and_drive(
        load_design("kenan-2.0"), workshop.model_copy(update={"spring": preloaded(workshop, 4.0)}), Growth()
    )
    (_, springs, past_rad), *_ = seen
    assert math.degrees(springs.preload_rad) == pytest.approx(4.0)
    assert math.degrees(past_rad) == pytest.approx(workshop.body.stop_deg + 3.0)  # and what the pad gives
    linkage = Linkage(load_design("kenan-2.0"))
    assert fall_s(linkage, springs, past_rad) < fall_s(linkage, replace(springs, preload_rad=0.0), past_rad)


@pytest.mark.parametrize("name", ["kenan-1.0", "best-printable"])
def test_the_typical_body_turns_like_two_halves_on_a_rod(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Half its mass at each end of a rod whose half length is the radius of gyration, here so long that turns count."""
    design, past_rad, halves = load_design(name), math.radians(6.0), []
    monkeypatch.setattr(settling, "TYPICAL_BODY", in_plane(0.08, (4.0, 11.0), 2000.0))
    linkage, springs = Linkage(design), springs_on_leg(design, None, math.radians(4.0))
    wind = design.compression_rad * np.cos((np.arange(400) + 0.5) * math.pi / 800.0)
    for end in (-2000.0, 2000.0):
        for step in (-1e-4, 1e-4):
            pose = linkage.pose(-wind + step)
            halves.append(turned_about_y(np.array([4.0 + end, 11.0]) - pose.ankle_mm, -pose.foot_rad) / 1000.0)
    inertia = 0.04 * sum((((after - before) / 2e-4) ** 2).sum(axis=1) for before, after in (halves[:2], halves[2:]))
    rise = sum(half[:, 1] - half[0, 1] for half in halves) / 4.0
    released = springs.energy_j - springs.stiffness_nm_per_rad * wind * (wind / 2.0 + springs.preload_rad)
    rate = np.sqrt(2.0 * (released - 0.08 * 9.81 * rise) / inertia)
    steps = np.sqrt(design.compression_rad**2 - wind**2) * math.pi / 800.0
    expected = RESERVE * (float((steps / rate).sum()) + past_rad / rate[-1])
    assert fall_s(linkage, springs, past_rad) == pytest.approx(expected, rel=5e-3)


def preloaded(workshop: Workshop, degrees: float) -> Any:
    return workshop.spring.model_copy(update={"preload_deg": degrees})


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"])
def test_no_leg_falls_in_more_time_than_its_drive_gives_it(name: str) -> None:
    """Typical masses and a reserve: at least what the finished robot's own masses need, and at most a fifth more."""
    robot = built(name)
    past_rad = robot.layout.stop.angle_rad
    own_s = reflected_mass(robot.bodies, robot.layout.linkage).push_off_s(robot.spring, past_rad)
    assert 1.0 <= fall_s(robot.layout.linkage, robot.spring, past_rad) / own_s < 1.2


SECTIONS = sections(Linkage(load_design("kenan-2.0")), load_workshop())
ROLLER = load_catalogue().bearings["623"]


def limits(workshop: Workshop) -> DriveLimits:
    return drive_limits(workshop, ROLLER, SECTIONS, HoleSizes.of(workshop, None))


def changed(table: str, **values: Any) -> Workshop:
    workshop = load_workshop()
    return workshop.model_copy(update={table: getattr(workshop, table).model_copy(update=values)})


@each(
    ("table", "key", "value", "of", "names"),
    [
        ("safety", "spring_stress_share", 0.3, "spring", {"stress_share"}),
        ("safety", "motor_stall_share", 0.2, "train", {"stall_share"}),
        ("safety", "motor_torque_max_nm", 0.1, "train", {"torque_max_nm", "blocked_nm"}),
        ("safety", "gear_efficiency", 0.8, "train", {"pair_efficiency"}),
        ("safety", "strength_factor", 5.0, "train", {"stress_mpa"}),
        ("fits", "backlash_circumferential_mm", 0.3, "train", {"backlash_circumferential_mm"}),
        ("fits", "press_mm", 0.15, "train", {"shaft_wall_mm"}),
        ("fits", "wall_mm", 1.4, "train", {"pinion_root_min_mm", "shaft_wall_mm"}),
        ("release", "play_deg", 30.0, "cam", {"play_rad"}),
        ("fits", "sliding_mm", 0.4, "spring", {"mandrel_min_mm", "pin_radius_min_mm"}),
        ("process", "line_width_mm", 0.6, "train", {"tip_min_mm"}),
    ],
)
def test_a_figure_of_the_workshop_is_a_limit(table: str, key: str, value: float, of: str, names: set[str]) -> None:
    before, after = limits(load_workshop()), limits(changed(table, **{key: value}))
    one, other = getattr(before, of), getattr(after, of)
    assert {field.name for field in fields(one) if getattr(one, field.name) != getattr(other, field.name)} == names


@pytest.mark.parametrize(
    ("role", "names"), [("gears", {"stress_mpa", "modulus_mpa", "shakedown_mpa"}), ("links", set()), ("body", set())]
)
def test_teeth_and_cam_are_as_strong_and_stiff_as_what_gears_are_printed_in(role: Role, names: set[str]) -> None:
    """The stress of their teeth, also at the release, and the modulus under the roller; nothing of the drive else."""
    usual, weak = load_workshop(), with_own(load_workshop(), role, 0.5)
    before, after = limits(usual), limits(weak)
    found = {
        field.name: getattr(getattr(after, of), field.name) / getattr(getattr(before, of), field.name)
        for of in ("cam", "train", "spring")
        for field in fields(getattr(before, of))
        if getattr(getattr(before, of), field.name) != getattr(getattr(after, of), field.name)
    }
    assert found == dict.fromkeys(names, pytest.approx(0.5))
    drive = built("kenan-2.0").layout.drive
    kick = _kick_limit_nm(drive, with_motor_of(weak, 1e6)) / _kick_limit_nm(drive, with_motor_of(usual, 1e6))
    assert kick == pytest.approx(0.5 if role == "gears" else 1.0)


def test_springs_that_last_longer_are_stressed_less() -> None:
    """Shigley, table 10-10: 50 % of the tensile strength for a million jumps."""
    assert limits(changed("safety", jumps=1e6)).spring.stress_share == pytest.approx(0.5 / 1.05)


def test_a_thick_lever_or_dog_pushes_the_cam_away() -> None:
    workshop, holes = load_workshop(), HoleSizes.of(load_workshop(), None)
    thick = drive_limits(workshop, ROLLER, replace(SECTIONS, lever_root_mm=20.0, dog_mm=20.0), holes)
    assert thick.dog_mm == 20.0
    usual = limits(workshop)
    assert thick.cam.gap_min_mm == pytest.approx(usual.cam.gap_min_mm + 10.0 - 4.5)
    corner = (20.0 - SECTIONS.dog_mm) / 2.0
    assert thick.cam.core_radius_mm == pytest.approx(usual.cam.core_radius_mm + corner)
    assert thick.train.cam_gear_root_min_mm == pytest.approx(usual.train.cam_gear_root_min_mm + corner)


def test_a_cam_lets_the_leg_swing_to_its_stop_and_into_the_pad() -> None:
    """With a stop two degrees farther past rest, two degrees more."""
    far = changed("body", stop_deg=load_workshop().body.stop_deg + 2.0)
    more = limits(far).cam.overshoot_rad - limits(load_workshop()).cam.overshoot_rad
    assert math.degrees(more) == pytest.approx(2.0)
