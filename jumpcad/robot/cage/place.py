"""The cage that rights the robot: cross bars ahead of and behind the plates, and arcs of rod between them (mm).

A bar and its hoop are a bow and its string, so that nothing pushes on the plates. Every arc is part of a circle: its
ends need no forces, only the moment E·I/R, which sockets bear. Sizes that the workshop leaves open follow from the
height above the ground at which the middle between both axles crouches (docs/decisions/cage.md).
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from jumpcad.catalogue import CageRod
from jumpcad.dimensions import PAD_WALL_MM
from jumpcad.errors import CannotBuildError
from jumpcad.findings import higher, lower
from jumpcad.robot.layout import Layout, moving_obstacles
from jumpcad.robot.space.room import EVERYWHERE, Obstacle, clearance
from jumpcad.transforms import Array, ByValue, chained, direction, pose_at
from jumpcad.workshop import Workshop

SOCKET_MM, SOCKET_WALL_MM = 12.0, 1.6
"""Depth of the sockets that hold a rod's ends, eight diameters of 1.5 mm, and their wall; judgement."""
BAR_MM = 3.0
"""Thickness of the cross bars, as they lie on the bed; judgement."""
LAP_MM = 3.0
"""Depth of the notches in bar and horn, half of the lap joint; judgement."""
LAP_HEIGHT_MM, LAP_WALL_MM = 9.0, 4.0
"""Height of a bar at the plates, and its length beyond them; judgement: 6 mm are left above the notch."""
HORN_MM, HORN_HIGHER, HORN_MORE = (5.0, 7.0, 13.0), 2.1, 0.35
"""Height of a horn at its bar, at plates without thickness, and at most; how much higher at the plates, and thicker
inwards between them, for a millimetre of plate. It bends evenly in a fall, sideways and upwards (`cage_side`,
`cage_ahead`); a higher one would break a thin plate beside its notch. Judgement."""
HORN_SIZE_MM, HORN_BELOW_MM = (10.6, 10.5), 3.75
"""A horn's end around the notch, across and along the bar's plane; that end's middle below the bar's."""
SWAY_MM = 0.7
"""How much wider a bar's notches are at its faces than in the middle, on either side: horns that bend sideways turn in
them by 20°, and bear three times the energy of horns that the bar clamps."""
END_MM = 2.5
"""How far a bar's round ends reach beyond its sockets: they meet the floor before the rod breaks. Elastica between bars
that bend, R 106 mm: 2.2 % of strain at 16.3 mm of sag; a bare socket meets the floor at 18.4 mm."""
POST_MM = 15.0
"""Least height of a bow's socket over the middle of its bar: its depth and a floor; judgement."""
CLEAR_MM = 4.0
"""Between cage and what moves, as laid out; judgement: rods bend, and printed bars lean in their notches."""
MOST_AHEAD_MM, MOST_RADIUS_MM = 60.0, 130.0
"""From the plates to the front bar, and of hoops, at most where they are found; judgement: longer horns break, and
wider hoops of glass fibre 1.5 mm give too much."""
STEP_MM, HIGHEST_MM = 0.5, 60.0
"""Steps in which room for a bar is looked for, and how far up."""
PIECES = 24
"""Straight pieces of an arc, in shapes that are seen and collide."""


@dataclass(frozen=True)
class Proportions:
    """Sizes over the crouching height, but `ahead` over the reach of the foot's nose beyond the plates, and angles."""

    behind: float
    height: float
    ahead: float
    rear: float
    front: float
    lean_deg: float
    arc_deg: float


HOOPS = Proportions(0.75, 0.9, 1.0, 2.55, 2.85, 24.0, 271.0)
WITH_BOW = Proportions(0.52, 0.75, 0.97, 2.1, 2.15, 30.0, 251.0)
"""Two hoops, and two with a bow: the lightest that righted three robots, by stable poses (docs/decisions/cage.md)."""


@dataclass(frozen=True, eq=False)
class CageBar(ByValue):
    """A cross bar: its frame in the body's, its half length between its sockets' middles, and their tilt outwards.

    In its frame x runs along the bar to the left, y up in the hoop's leaning plane, z forwards from its middle.
    `post_mm` is the height of the bow's mouth over it, 0 without a bow; `ahead` is 1 for the front bar, else -1.
    """

    name: str
    T_body_bar: Array
    half_mm: float
    tilt_rad: float
    post_mm: float
    ahead: int

    @property
    def place_mm(self) -> Array:
        """Its middle (2,), x and z in the body's frame."""
        return np.asarray(self.T_body_bar[[0, 2], 3])

    @property
    def up(self) -> Array:
        """Its plane's upward direction (2,), x and z in the body's frame."""
        return np.asarray(self.T_body_bar[[0, 2], 1])

    @property
    def horn_end_mm(self) -> Array:
        """Middle (2,) of its horns' ends, x and z in the body's frame."""
        return self.place_mm - HORN_BELOW_MM * self.up

    def reach_mm(self, socket_mm: float) -> float:
        """Half of its length, from round end to round end, with sockets of a width."""
        corner = SOCKET_MM * math.cos(self.tilt_rad) + socket_mm * math.sin(self.tilt_rad)
        return self.half_mm + corner / 2.0 + END_MM


@dataclass(frozen=True, eq=False)
class CageArc(ByValue):
    """A rod bent to an arc of a circle, with straight ends in its sockets.

    In its frame (4, 4) the circle's centre is the origin, y points to the arc's crest, and z along the circle's axis.
    """

    name: str
    T_body_arc: Array
    radius_mm: float
    angle_rad: float

    @property
    def length_mm(self) -> float:
        """Length to which the rod is cut."""
        return self.radius_mm * self.angle_rad + 2.0 * SOCKET_MM

    @property
    def line_mm(self) -> Array:
        """Points (n, 2) from end to end in its frame, straight in the sockets."""
        turn = np.linspace(-self.angle_rad / 2.0, self.angle_rad / 2.0, PIECES + 1)
        arc = self.radius_mm * np.column_stack([np.sin(turn), np.cos(turn)])
        ends = SOCKET_MM * np.column_stack([np.cos(turn[[0, -1]]), -np.sin(turn[[0, -1]])])
        return np.vstack([arc[0] - ends[0], arc, arc[-1] + ends[1]])

    @property
    def points_mm(self) -> Array:
        """The same points (n, 3) in the body's frame."""
        flat, T = self.line_mm, self.T_body_arc
        return np.asarray(flat[:, :1] * T[:3, 0] + flat[:, 1:] * T[:3, 1]) + T[:3, 3]


@dataclass(frozen=True, eq=False)
class Cage(ByValue):
    """Both bars, the rear one first, and the arcs: two hoops, and the bow if there is one.

    `bar_mm` is the height of the bars, and `socket_mm` the outside of the sockets, which lie on one bed. The rear
    horns' tips are wider by `rear_tip_mm`, ahead of their bar.
    """

    rod: CageRod
    bar_mm: float
    socket_mm: float
    rear_tip_mm: float
    bars: tuple[CageBar, CageBar]
    arcs: tuple[CageArc, ...]

    @property
    def tightest_mm(self) -> float:
        """Radius of the arc that is bent most."""
        return min(arc.radius_mm for arc in self.arcs)


def hoop_mm(cage: Cage, bar: CageBar, arc: CageArc) -> tuple[float, float]:
    """Return how wide a bent hoop is outside, and how high over its bar's lower edge, in the hoop's plane."""
    half = arc.radius_mm * math.sin(min(arc.angle_rad, math.pi) / 2.0)
    centre = float((arc.T_body_arc[:3, 3] - bar.T_body_bar[:3, 3]) @ bar.T_body_bar[:3, 1])
    return 2.0 * half + cage.rod.diameter_mm, centre + arc.radius_mm + (cage.rod.diameter_mm + cage.bar_mm) / 2.0


def cage_place(layout: Layout, workshop: Workshop) -> Cage | None:
    """Return a layout with the cage of its workshop, if that has one."""
    rod, table = workshop.cage_rod, workshop.cage
    if rod is None:
        return None
    up, origin = ground(layout)
    crouch, usual = float(-origin @ up), WITH_BOW if table.bow else HOOPS
    lean, angle = (math.radians(value) for value in (table.lean_deg or usual.lean_deg, table.arc_deg or usual.arc_deg))
    socket = rod.diameter_mm + 2.0 * (workshop.fits.drawn.lying_mm + SOCKET_WALL_MM)
    level = (socket - BAR_MM) / 2.0  # of a rod, forwards of its bar's middle plane
    rear_end, front_end = plate_ends_mm(layout)
    nose = float(layout.linkage.pose(layout.linkage.travel_rad[0]).front_eye_mm[0, 0]) + layout.sections.ground_mm
    beyond = min(usual.ahead * max(0.0, nose - front_end), MOST_AHEAD_MM)
    behind, ahead = table.rear_behind_mm or usual.behind * crouch, table.front_ahead_mm or beyond
    radii = (
        table.rear_radius_mm or min(usual.rear * crouch, MOST_RADIUS_MM),
        table.front_radius_mm or min(usual.front * crouch, MOST_RADIUS_MM),
    )
    rear_x, front_x = round(rear_end - behind, 1), round(front_end + ahead, 1)
    lowest = HORN_BELOW_MM + HORN_SIZE_MM[1] / 2.0 + CLEAR_MM
    rear_low, front_low = (
        origin[1] + ((origin[0] - x) * up[0] + height) / up[1]
        for x, height in ((rear_x, usual.height * crouch), (front_x, lowest))
    )
    moving = moving_obstacles(layout)
    bars, arcs = [], []
    ends = (("rear", rear_x, radii[0], rear_low, -1), ("front", front_x, radii[1], front_low, 1))
    for name, x, radius, low, sign in ends:
        place = np.array([x, _bar_height(layout, moving, name, x, float(low), sign * lean)])
        bar, arc = _hoop(layout, name, sign, place, round(radius, 1), angle, sign * lean, level)
        bars.append(bar)
        arcs.append(arc)
    rear, front = bars
    if table.bow:
        rear, front, bow = _bow(rear, front, lean, level)
        arcs.append(bow)
    return Cage(rod, table.bar_mm, socket, table.rear_tip_mm, (rear, front), tuple(arcs))


def horn_mm(layout: Layout) -> tuple[float, float]:
    """Return the height of a horn at the plates, and how much thicker than these it is."""
    plate = float(np.ptp(layout.lateral.left_plate))
    return min(HORN_MM[1] + HORN_HIGHER * plate, HORN_MM[2]), HORN_MORE * plate


def plate_ends_mm(layout: Layout) -> tuple[float, float]:
    """Return where the body plates end behind and ahead (x): around the axles, and beside the trays."""
    axles = np.array([place[0] for place in layout.axles.values()])
    pad = layout.axle_mm / 2.0 + PAD_WALL_MM
    return float(axles.min()) - pad, max(float(axles.max()) + pad, layout.tray_mm[0] + layout.electronics.half_mm[0])


def ground(layout: Layout) -> tuple[Array, Array]:
    """Return upward direction (2,) and a point (2,) of the ground in the body's frame, with loaded springs."""
    pose = layout.linkage.pose(layout.linkage.travel_rad[0])
    up = direction(pose.foot_rad[0] - math.pi / 2.0)
    return up, pose.ankle_mm[0] - layout.sections.ground_mm * up


def _bar_height(
    layout: Layout, moving: list[Obstacle], name: str, x_mm: float, low_mm: float, lean_rad: float
) -> float:
    """Return the least height of a bar's middle at x, from a height on, at which bar and horns clear what moves."""
    heights = np.arange(low_mm, low_mm + HIGHEST_MM, STEP_MM)
    places = np.column_stack([np.full_like(heights, x_mm), heights])
    bar = (BAR_MM / 2.0, LAP_HEIGHT_MM / 2.0)
    free = clearance(moving, places, bar, -lean_rad, EVERYWHERE, within_mm=CLEAR_MM)
    # behind the ankle toes reach past the plates; ahead of it the foot lies between them
    width = layout.toe_half_width_mm if name == "rear" else layout.ankle_face_mm
    beside = [replace(one, y_mm=(-width, width)) if one.name == "foot" else one for one in moving]
    down = HORN_BELOW_MM * np.array([math.sin(lean_rad), math.cos(lean_rad)])
    horn = HORN_SIZE_MM[0] / 2.0, HORN_SIZE_MM[1] / 2.0
    for plate in (layout.lateral.left_plate, layout.lateral.right_plate):
        free = np.minimum(free, clearance(beside, places - down, horn, -lean_rad, plate, within_mm=CLEAR_MM))
    if not (free >= CLEAR_MM).any():
        raise CannotBuildError(
            f"cage_bar_{name} finds no room over what moves, {x_mm:.0f} mm from the body's middle: change "
            f"cage.{'rear_behind_mm' if name == 'rear' else 'front_ahead_mm'}, or leave it 0",
            "cage_clear", float(free.max()) - CLEAR_MM,
        )  # fmt: skip
    return round(float(heights[np.argmax(free >= CLEAR_MM)]), 1)


def _hoop(
    layout: Layout, name: str, ahead: int, place: Array, radius: float, angle: float, lean: float, level: float
) -> tuple[CageBar, CageArc]:
    """Return a bar at a place and its hoop, in a plane that leans forwards by an angle."""
    tilt = math.pi - angle / 2.0
    half = radius * math.sin(angle / 2.0) - SOCKET_MM / 2.0 * math.cos(tilt)
    needed = (layout.lateral.outside[1] - layout.lateral.outside[0]) / 2.0 + LAP_WALL_MM + SOCKET_MM
    if half < needed:
        key = f"cage.{name}_radius_mm"
        raise CannotBuildError(
            f"{key} = {radius:g}: cage_bar_{name} reaches {half:.0f} mm to either side, and {needed:.0f} mm are needed "
            f"beyond the plates",
            "cage_clear", half - needed, ways=higher(key) + lower("cage.arc_deg"),
        )  # fmt: skip
    sin, cos = math.sin(lean), math.cos(lean)
    rotation = np.array([[0.0, sin, cos], [1.0, 0.0, 0.0], [0.0, cos, -sin]])
    middle = sum(layout.lateral.outside) / 2.0
    T_body_bar = pose_at(rotation, (place[0], middle, place[1]))
    centre = SOCKET_MM / 2.0 * math.sin(tilt) - radius * math.cos(angle / 2.0)
    T_body_arc = chained(T_body_bar, pose_at(np.eye(3), (0.0, centre, level)))
    hoop = CageArc(f"cage_hoop_{name}", T_body_arc, radius, angle)
    return CageBar(f"cage_bar_{name}", T_body_bar, half, tilt, 0.0, ahead), hoop


def _bow(rear: CageBar, front: CageBar, lean: float, level: float) -> tuple[CageBar, CageBar, CageArc]:
    """Return both bars with posts, and the bow between: it leaves them in their planes, its ends level in the body."""
    rise = (front.place_mm[1] - rear.place_mm[1] - 2.0 * level * math.sin(lean)) / math.cos(lean)
    posts = (POST_MM + max(rise, 0.0), POST_MM + max(-rise, 0.0))
    ends = [
        bar.T_body_bar[:3, 3] + post * bar.T_body_bar[:3, 1] + level * bar.T_body_bar[:3, 2]
        for bar, post in zip((rear, front), posts, strict=True)
    ]
    chord = float(ends[1][0] - ends[0][0])
    radius = chord / 2.0 / math.cos(lean)
    centre = (ends[0] + ends[1]) / 2.0 + np.array([0.0, 0.0, radius * math.sin(lean)])
    rotation = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    bow = CageArc("cage_bow", pose_at(rotation, centre), radius, math.pi + 2.0 * lean)
    return replace(rear, post_mm=posts[0]), replace(front, post_mm=posts[1]), bow
