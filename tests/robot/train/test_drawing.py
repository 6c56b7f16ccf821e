"""Gears and cam measured on the placed meshes: caliper, pins, a turn through a pitch, and the roller on the cam."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import shapely
import trimesh
from scipy.optimize import brentq
from shapely import affinity
from support.built import built, cut, geared, hole_centres, in_body, placed, region

from jumpcad.building.assembly import layout_of
from jumpcad.design import load_design
from jumpcad.mechanism.model import MAIN_LEG
from jumpcad.parts.part import Drawing
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Robot
from jumpcad.robot.train.drawing import _track, gears
from jumpcad.workshop import load_workshop

ALPHA = math.radians(20)
BACKLASH_MM = 0.15
ROLLER_RADIUS_MM = 5.0
"""A 623 bearing's outer ring."""


def involute(angle: float) -> float:
    return math.tan(angle) - angle


def robots() -> dict[str, Robot]:
    return {"one pair": built("kenan-2.0"), "two pairs": geared()}


GEARS = [
    ("one pair", "motor_pinion"), ("one pair", "cam_gear"),
    ("two pairs", "motor_pinion"), ("two pairs", "cam_gear"), ("two pairs", "idler wheel"),
    ("two pairs", "idler pinion"),
]  # fmt: skip


class Measured:
    """One toothed wheel of a robot: its section about its own axis, as a polygon, and what it ought to be."""

    def __init__(self, robot: Robot, name: str) -> None:
        stages, lateral, layout = robot.layout.drive.train.stages, robot.layout.lateral, robot.layout
        first, last = stages[0], stages[-1]
        self.spec, y, self.axis = {
            "motor_pinion": (first.pinion, lateral.gears[-1], layout.motor_mm),
            "cam_gear": (last.wheel, lateral.gears[0], layout.cam_axis_mm),
            "idler wheel": (first.wheel, lateral.gears[-1], layout.idler_mm),
            "idler pinion": (last.pinion, lateral.gears[0], layout.idler_mm),
        }[name]
        mesh = placed(robot, name.split()[0])
        area = region(cut(mesh, sum(y) / 2.0) - self.axis)
        self.outline = shapely.Polygon(area.exterior)
        self.points = np.array(area.exterior.coords)[:-1]
        around = np.linspace(-math.pi, math.pi, 200 * self.teeth, endpoint=False)
        angles, radii = np.arctan2(*self.points.T[::-1]), np.hypot(*self.points.T)
        radius = np.interp(around, np.sort(angles), radii[np.argsort(angles)], period=2 * math.pi)
        self.phase = float(np.angle((radius * np.exp(1j * self.teeth * around)).sum())) / self.teeth

    @property
    def teeth(self) -> int:
        return self.spec.teeth

    def upright(self) -> np.ndarray:
        """Return the outline's points turned so that a tooth's middle lies on +x."""
        cos, sin = math.cos(self.phase), math.sin(self.phase)
        return self.points @ np.array([[cos, -sin], [sin, cos]])

    def caliper_mm(self, teeth: int) -> float:
        """Return what parallel jaws over some teeth read; the jaws are at right angles to their middle's direction."""
        points, pitch = self.upright(), 2 * math.pi / self.teeth
        middle = (teeth - 1) * pitch / 2
        across = np.array([-math.sin(middle), math.cos(middle)])
        points = points[np.hypot(*points.T) > self.spec.form_radius_mm]  # jaws touch flanks, not fillets
        angles = np.arctan2(*points.T[::-1])

        def of_tooth(number: int) -> np.ndarray:
            away = (angles - number * pitch + math.pi) % (2 * math.pi) - math.pi
            return points[np.abs(away) < 0.45 * pitch] @ across

        return float(of_tooth(teeth - 1).max() - of_tooth(0).min())

    def over_pins_mm(self, pin: float) -> float:
        """Return the size over two pins that lie in opposite gaps."""
        spun = affinity.rotate(self.outline, -self.phase, origin=(0, 0), use_radians=True)
        bisector = math.pi / self.teeth

        def centre(angle: float) -> np.ndarray:
            along = np.array([math.cos(angle), math.sin(angle)])
            low, high = self.spec.pitch_radius_mm, self.spec.tip_radius_mm + pin
            reach = brentq(lambda r: spun.exterior.distance(shapely.Point(r * along)) - pin / 2, low, high)
            return reach * along

        opposite = bisector + self.teeth // 2 * 2 * math.pi / self.teeth
        return float(np.linalg.norm(centre(bisector) - centre(opposite))) + pin


@pytest.fixture(scope="module", params=GEARS, ids=lambda pair: f"{pair[1]}, {pair[0]}")
def wheel(request: pytest.FixtureRequest) -> Measured:
    return Measured(robots()[request.param[0]], request.param[1])


def span_teeth(wheel: Measured) -> int:
    """Return over how many teeth a caliper touches near the pitch circle (handbooks: z·20°/180° + 0.5)."""
    return max(2, round(wheel.teeth / 9 + 0.5 + wheel.spec.shift))


def test_span_over_teeth_is_the_textbooks(wheel: Measured) -> None:
    """DIN 3960 / ISO 21771: W = m·cos(a)·((k - 0.5)·pi + z·inv(a)) + 2·x·m·sin(a), less the backlash's share."""
    k, m, x = span_teeth(wheel), wheel.spec.module_mm, wheel.spec.shift
    span = m * math.cos(ALPHA) * ((k - 0.5) * math.pi + wheel.teeth * involute(ALPHA)) + 2 * x * m * math.sin(ALPHA)
    assert wheel.caliper_mm(k) == pytest.approx(span - BACKLASH_MM / 2 * math.cos(ALPHA), abs=0.006)


def test_size_over_pins_is_the_textbooks(wheel: Measured) -> None:
    """ISO 21771, 4.6: the pins' middles lie where inv(a_K) = inv(a) + d/d_b - half the gap's angle at the pitch."""
    z, m, x = wheel.teeth, wheel.spec.module_mm, wheel.spec.shift
    pin = 1.728 * m
    thickness = m * (math.pi / 2 + 2 * x * math.tan(ALPHA)) - BACKLASH_MM / 2
    base = m * z * math.cos(ALPHA)
    value = involute(ALPHA) + pin / base - (math.pi * m - thickness) / (m * z)
    angle = brentq(lambda a: involute(a) - value, 1e-3, 1.3)
    odd = math.cos(math.pi / (2 * z)) if z % 2 else 1.0
    assert wheel.over_pins_mm(pin) == pytest.approx(base / math.cos(angle) * odd + pin, abs=0.02)


def roller_gap(robot: Robot) -> Callable[[float, float], float]:
    """Return the distance of roller and cam at a cam angle and a winding angle, from meshes (mm)."""
    layout = robot.layout
    profile = region(cut(placed(robot, "cam"), sum(layout.lateral.cam) / 2.0) - layout.cam_axis_mm)
    profile = shapely.Polygon(profile.exterior)
    holes = hole_centres(cut(placed(robot, "main_leg"), 2.5))
    roller = min((np.array(centre) for centre in holes), key=lambda centre: centre[0])

    def gap(cam_rad: float, wind_rad: float) -> float:
        # a positive turn about +y carries z to x: clockwise where x points right and z up
        turned = affinity.rotate(profile, -cam_rad, (0, 0), use_radians=True)
        centre = shapely.Point(in_body(robot, MAIN_LEG, wind_rad, roller) - layout.cam_axis_mm)
        outside = turned.exterior.distance(centre)
        return (-outside if turned.contains(centre) else outside) - ROLLER_RADIUS_MM

    return gap


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_roller_touches_the_cam_at_every_winding_angle(name: str) -> None:
    robot = built(name)
    gap = roller_gap(robot)
    cam, wound = robot.layout.drive.cam, robot.design.compression_rad
    for turn in np.linspace(0.0, cam.law.lift_rad, 40):
        assert gap(turn, float(cam.wind_rad(turn))) == pytest.approx(0.0, abs=0.01)
    assert float(cam.wind_rad(cam.law.lift_rad)) == pytest.approx(wound, rel=1e-12)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_rolling_on_the_cam_winds_with_constant_torque(name: str) -> None:
    """With the roller on the cam, the springs' energy grows linearly with the cam's turn after the ramp."""
    robot = built(name)
    gap = roller_gap(robot)
    law, wound = robot.layout.drive.cam.law, robot.design.compression_rad
    turns = np.linspace(law.ramp_rad * 1.2, law.lift_rad * 0.99, 25)
    winds = np.array([brentq(lambda w, t=t: gap(t, w), 0.02 * wound, 1.05 * wound) for t in turns])
    energy = 0.5 * robot.spring.stiffness_nm_per_rad * winds**2
    slope, start = np.polyfit(turns, energy, 1)
    np.testing.assert_allclose(energy, slope * turns + start, atol=2e-3 * robot.spring.energy_j)
    # all of the springs' energy is put in over the lift, the ramp counting half
    assert slope == pytest.approx(robot.spring.energy_j / (law.lift_rad - law.ramp_rad / 2), rel=3e-3)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_roller_falls_free_of_the_cam(name: str) -> None:
    robot = built(name)
    gap = roller_gap(robot)
    cam, wound = robot.layout.drive.cam, robot.design.compression_rad
    start = float(cam.wind_rad(cam.geometry.free_rad - 1e-9))
    for wind in np.linspace(min(start, wound), -math.radians(4.9), 30):
        assert gap(cam.geometry.free_rad, float(wind)) > 0.3


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_cam_gear_fits_onto_the_jaws_in_one_position_only(name: str) -> None:
    """Turned in steps of 1° against each other, on sections of the meshes: free over the play, and nowhere else."""
    robot = built(name)
    y = sum(robot.layout.lateral.gears[0]) / 2.0
    jaws, gear = (region(cut(placed(robot, part), y) - robot.layout.cam_axis_mm) for part in ("cam", "cam_gear"))
    assert len(jaws.geoms) == 2
    # clockwise, as the cam runs ahead of its gear
    shared = [affinity.rotate(jaws, -turn, (0, 0)).intersection(gear).area for turn in range(360)]
    free = [turn for turn, area in enumerate(shared) if area < 0.05]
    assert free == list(range(math.floor(math.degrees(robot.layout.drive.dog.play_rad)) + 1))
    assert min(area for turn, area in enumerate(shared) if 90 < turn < 270) > 1.0


def with_wheel(teeth: int) -> tuple[Layout, Drawing]:
    """kenan-2.0 with another number of teeth on its cam gear: the layout, and the gear as it prints."""
    layout = layout_of(load_design("kenan-2.0"), load_workshop())
    (stage,) = layout.drive.train.stages
    train = replace(layout.drive.train, stages=(replace(stage, wheel=replace(stage.wheel, teeth=teeth)),))
    changed = replace(layout, drive=replace(layout.drive, train=train))
    return changed, next(made for made in gears(changed, load_workshop()) if made.name == "cam_gear")


@pytest.mark.parametrize("teeth", [30, 34, 38, 42, 46, 60])
def test_web_holes_can_be_printed_and_leave_the_sensors_track_a_wall(teeth: int) -> None:
    """Measured under the groove: every hole takes a pin of 1.9 mm, and none comes nearer than 1.6 mm to the groove."""
    layout, gear = with_wheel(teeth)
    sensor = layout.sensor
    assert sensor is not None
    section = trimesh.intersections.mesh_plane(gear.mesh, [0.0, 0.0, 1.0], [0.0, 0.0, 1.0])[:, :, :2]
    holes = [shapely.Polygon(hole) for hole in region(section).interiors]
    webs = [hole for hole in holes if hole.distance(shapely.Point(0.0, 0.0)) > layout.drive.dog.outer_mm / 2.0 + 1.0]
    assert len(webs) == (6 if teeth > 40 else 0)
    for hole in webs:
        corners = np.hypot(*np.array(hole.exterior.coords).T)
        assert not hole.buffer(-0.95).is_empty
        assert corners.min() > sensor.radius_mm + sensor.half_width_mm + 1.59


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo", "two pairs"])
def test_the_sensors_land_rises_in_layers_from_the_bottom_of_its_groove_to_the_gears_face(name: str) -> None:
    layout = (geared() if name == "two pairs" else built(name)).layout
    if name == "two pairs":  # the first pair may be thinner than the cam gear's
        cam, (y0, y1) = layout.lateral.gears
        layout = replace(layout, lateral=replace(layout.lateral, gears=(cam, (y0, y1 - 1.0))))
    sensor, (low, face) = layout.sensor, layout.lateral.gears[0]
    assert sensor is not None
    track = _track(layout, sensor)
    assert np.ptp(track.radii_mm) == pytest.approx(2.0 * sensor.half_width_mm)
    assert np.mean(track.radii_mm) == pytest.approx(sensor.radius_mm)
    levels = [step[:2] for step in track.steps]
    assert levels[0][0] == pytest.approx(face - low - sensor.depth_mm)
    assert levels[-1][1] == pytest.approx(face - low)
    assert [top for _, top in levels[:-1]] == pytest.approx([bottom for bottom, _ in levels[1:]])
    assert [top - bottom for bottom, top in levels] == pytest.approx([sensor.needs.layer_mm] * len(levels))
    # both ramps rise at 45°, a layer's step as wide as they are in its middle; where the switch operates they are as
    # far from the drop as `ready_rad` and `open_rad` say
    above = [(bottom + top) / 2.0 - levels[0][0] - (sensor.depth_mm - sensor.press_mm) for bottom, top in levels]
    drop = sensor.direction_rad + layout.drive.cam.law.lift_rad
    begins, ends = zip(*(step[2:] for step in track.steps), strict=True)
    assert begins == pytest.approx([drop - sensor.ready_rad + high / sensor.radius_mm for high in above])
    assert ends == pytest.approx([drop + sensor.open_rad - high / sensor.radius_mm for high in above])
