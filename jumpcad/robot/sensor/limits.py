"""The sensor: what its plunger does over a turn of the cam, at the worst of its scatter."""

import math
from collections.abc import Iterator

from jumpcad.findings import Basis, Finding, at_least, at_most, higher, lower
from jumpcad.robot.robot import Robot
from jumpcad.robot.sensor.place import middle_mm

RUN_ON_S = 0.06
"""How long the motor runs on after the sensor has opened (`bundle.firmware`)."""
SCATTER = lower("seats.sensor_axial_mm", note="a better fit on the cam's axle")
TRAVEL = "travel of the plunger: data sheet, templates/hardware/electronics.toml; scatter: judgement"
BASIS = {
    "sensor_press": Basis(
        "operating position - its tolerance - land - seats.sensor_axial_mm ≥ 0 (mm), all from the switch's base", TRAVEL
    ),
    "sensor_overtravel": Basis(
        "operating position - land + seats.sensor_axial_mm ≤ operating position - end of travel (mm)", TRAVEL
    ),
    "sensor_free": Basis("land + groove - seats.sensor_axial_mm - free position ≥ 0 (mm)", TRAVEL),
    "sensor_ready": Basis(
        "drawn angle - scatter - ω·seats.sensor_stop_s ≥ 0 (°); scatter = (seats.sensor_axial_mm + tolerance of the "
        "operating position + seats.sensor_along_mm)/track's radius, ω unloaded cam with a full battery",
        TRAVEL,
    ),
    "sensor_open": Basis(
        f"min(drawn angle - scatter, 360° - lift - drawn angle - scatter - ω·{RUN_ON_S:g} s) ≥ 0 (°), scatter and ω as "
        "in `sensor_ready`",
        f"{TRAVEL}; {RUN_ON_S:g} s: the firmware",
    ),
}


def sensor_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `sensor_press`, `sensor_overtravel`, `sensor_free`, `sensor_ready` and `sensor_open`."""
    sensor = robot.layout.sensor
    if sensor is None:
        return
    travel, axial = sensor.needs.travel, sensor.needs.axial_mm
    land = middle_mm(travel)
    press = travel.operating_mm - travel.operating_tolerance_mm - land - axial
    yield at_least(
        "sensor_press", press, 0.0, "mm",
        f"at ready the land presses the sensor at least {press:.2f} mm beyond where it operates "
        f"({sensor.press_mm:.2f} +- {axial + travel.operating_tolerance_mm:.2f} mm), of 0 mm at least",
        (*SCATTER, "choose a bought.sensor with more overtravel"),
    )  # fmt: skip
    deepest = travel.operating_mm - land + axial
    most = travel.operating_mm - travel.total_mm
    yield at_most(
        "sensor_overtravel", deepest, most, "mm",
        f"the land presses the sensor at most {deepest:.2f} mm beyond its operating position, of {most:.2f} mm",
        (*SCATTER, "choose a bought.sensor with more overtravel"),
    )  # fmt: skip
    free = land + sensor.depth_mm - axial - travel.free_mm
    yield at_least(
        "sensor_free", free, 0.0, "mm",
        f"the groove leaves the sensor's plunger {free:.2f} mm free for the rest of the turn, of 0 mm at least",
        (*SCATTER, "choose a bought.sensor with less travel"),
    )  # fmt: skip
    scatter, stop, drawn = (math.degrees(a) for a in (sensor.scatter_rad, sensor.needs.stop_rad, sensor.ready_rad))
    left = drawn - scatter - stop
    yield at_least(
        "sensor_ready", left, 0.0, "°",
        f"the sensor closes {drawn:.1f} +- {scatter:.1f}° of the cam before the drop; the motor stops in {stop:.1f}°, "
        f"which leaves {left:.1f}°, of 0° at least",
        higher("seats.sensor_reserve_deg"),
    )  # fmt: skip
    speed = robot.layout.drive.train.cam_speed_rad_s
    opens, end = math.degrees(sensor.open_rad), math.degrees(2.0 * math.pi - robot.layout.drive.cam.law.lift_rad)
    last = opens + scatter + math.degrees(speed * RUN_ON_S)
    margin = min(opens - scatter, end - last)
    yield at_least(
        "sensor_open", margin, 0.0, "°",
        f"the sensor opens {opens:.1f} +- {scatter:.1f}° after the drop begins; the motor stands {last:.1f}° after it"
        f" at the latest, before the next lift at {end:.1f}°, which leaves {margin:.1f}°, of 0° at least",
        higher("seats.sensor_reserve_deg") + SCATTER,
    )  # fmt: skip
