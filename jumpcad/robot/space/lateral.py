"""The lateral stack: which part occupies which interval of y (mm, y to the left, 0 in the middle of the main leg).

From the leg to the left: roller and cam, the screw head that holds the roller; beyond the spring the cam gear; with two
stages, the first wheel; the left plate. To the right: the spring alone, the motor's body, the right plate. The motor
lies across, its shaft to the left.
"""

from dataclasses import dataclass

from jumpcad.catalogue import Motor
from jumpcad.dimensions import BUSHING_PLAY_MM, GAP_MM, MOTOR_CAP_MM, ROLLER_HEAD_MM, ROLLER_WASHER_MM, TERMINALS_MM
from jumpcad.drive.motor import front_length_mm
from jumpcad.solids.slab import Interval

HEAD_GAP_MM = GAP_MM + 2.0 * BUSHING_PLAY_MM + 0.2
"""From the roller's screw to the cam gear: the play of cam and gear, each half a gap, towards the leg, half of the
leg's, and what is left then; judgement."""
SCREW_GAP_MM = GAP_MM + 2.0 * BUSHING_PLAY_MM
"""From the end of the roller's screw to the right plate: the leg may stand nearer by half of its play; judgement."""


@dataclass(frozen=True)
class Lateral:
    """Intervals of y (mm), each (lower, upper); the roller shares the cam's."""

    leg: Interval
    lug_left: Interval
    lug_right: Interval
    cam: Interval
    roller_screw: Interval
    gears: tuple[Interval, ...]
    motor: Interval
    motor_cap: Interval
    left_plate: Interval
    right_plate: Interval
    spring_left: Interval
    spring_right: Interval

    @property
    def inside(self) -> Interval:
        """Interval between the plates."""
        return self.right_plate[1], self.left_plate[0]

    @property
    def outside(self) -> Interval:
        """Interval over both plates."""
        return self.right_plate[0], self.left_plate[1]

    @property
    def plates_mm(self) -> tuple[float, float]:
        """Middles of the left and of the right plate: the supports of axles."""
        return sum(self.left_plate) / 2.0, sum(self.right_plate) / 2.0


def lateral_stack(
    leg_mm: float, lug_mm: float, roller_width_mm: float, spring_length_mm: float, gear_widths_mm: tuple[float, ...],
    motor: Motor, plate_mm: float, tray_width_mm: float, roller_screw_mm: float, right_mm: float = 0.0,
) -> Lateral:  # fmt: skip
    """Stack everything across the robot, with the loaded coils of springs and the gears from the cam's to the motor's.

    `tray_width_mm` is the least that the electronics need between the plates; `roller_screw_mm` the length of the
    roller's screw below its head, which lies on the roller: its end moves past the right plate, which stands `right_mm`
    further out than it must.
    """
    half = leg_mm / 2.0
    cam = (half + ROLLER_WASHER_MM, half + ROLLER_WASHER_MM + roller_width_mm)
    spring_left = (half + GAP_MM, half + GAP_MM + spring_length_mm)
    y = max(cam[1] + ROLLER_HEAD_MM + HEAD_GAP_MM, spring_left[1] + GAP_MM)
    gears = []
    for width in gear_widths_mm:
        gears.append((y, y + width))
        y += width + GAP_MM
    left = y
    front = gears[-1][0] - GAP_MM - front_length_mm(motor)
    cap = (front, front + MOTOR_CAP_MM)
    body = (front - motor.body_length_mm, front)
    spring_right = (-spring_left[1], -spring_left[0])
    screw = (cam[1] - roller_screw_mm, cam[1])
    beside_leg = min(spring_right[0] - GAP_MM, screw[0] - SCREW_GAP_MM)
    right = min(body[0] - TERMINALS_MM, beside_leg, left - tray_width_mm) - right_mm
    lug = (half + GAP_MM, half + GAP_MM + lug_mm)
    return Lateral(
        leg=(-half, half), lug_left=lug, lug_right=(-lug[1], -lug[0]), cam=cam, roller_screw=screw, gears=tuple(gears),
        motor=body, motor_cap=cap, left_plate=(left, left + plate_mm), right_plate=(right - plate_mm, right),
        spring_left=spring_left, spring_right=spring_right,
    )  # fmt: skip
