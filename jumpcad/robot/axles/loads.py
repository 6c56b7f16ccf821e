"""What loads the axles between the plates, springs loaded (N, mm; x-z in the body's frame, y to the left)."""

from jumpcad.robot.layout import Layout
from jumpcad.strength.axle_beam import AxleBeam, mesh_force_n, on_hub
from jumpcad.transforms import Array

PLAIN_HUB = 1.0 / 3.0
"""Where a hub without bearings bears on its axle, over its width: in the middle of pressures that grow evenly from its
middle to its faces."""
CAM_TURNS, IDLER_TURNS = 1.0, -1.0
"""Senses about +y; see `jumpcad.drive.cam`."""


def axle_beams(layout: Layout, arms_n: tuple[Array, Array], cam_n: Array, front_n: Array) -> dict[str, AxleBeam]:
    """Return the axles and the springs' pin as beams on both plates, by their names.

    Parameters
    ----------
    arms_n
        Forces (2,) of both springs' arms on the leg and on the springs' pin.
    cam_n, front_n
        Forces (2,) of the cam on the lever, and of the front link on its axle.
    """
    lateral, (on_leg, on_pin) = layout.lateral, arms_n
    plates = lateral.plates_mm
    cam, wire = sum(lateral.cam) / 2.0, layout.drive.spring.wire_mm
    inner, outer = lateral.spring_left[0] + wire / 2.0, lateral.spring_left[1] - wire / 2.0
    width, bearing = layout.sections.thickness_mm, layout.hub_bearing
    hub = (width - bearing.width_mm) / 2.0 if bearing else PLAIN_HUB * width
    coils = [(side * end, -force / 2.0) for side in (1.0, -1.0) for end, force in ((inner, on_leg), (outer, on_pin))]
    return {
        "leg_axle": AxleBeam.of(plates, *on_hub(on_leg, hub), *on_hub(cam_n, hub, cam), *coils),
        "front_axle": AxleBeam.of(plates, *on_hub(front_n, PLAIN_HUB * width)),
        "spring_pin": AxleBeam.of(plates, (outer, on_pin / 2.0), (-outer, on_pin / 2.0)),
        **_train_beams(layout, plates, (cam, -cam_n)),
    }


def _train_beams(layout: Layout, plates: tuple[float, float], cam: tuple[float, Array]) -> dict[str, AxleBeam]:
    """Return the axles of cam and idler, which the teeth of their gears push too; `cam` is place and force (2,)."""
    lateral, train = layout.lateral, layout.drive.train
    *_, pair = train.stages
    *_, torque = train.wheel_torques_nm
    driver = layout.motor_mm if layout.idler_mm is None else layout.idler_mm
    on_cam_gear = mesh_force_n(1000.0 * torque, pair, layout.cam_axis_mm, driver, CAM_TURNS)
    gear = sum(lateral.gears[0]) / 2.0
    beams = {"cam_axle": AxleBeam.of(plates, cam, (gear, on_cam_gear))}
    if layout.idler_mm is not None:
        pair, torque, wheel = train.stages[0], train.wheel_torques_nm[0], sum(lateral.gears[1]) / 2.0
        on_wheel = mesh_force_n(1000.0 * torque, pair, layout.idler_mm, layout.motor_mm, IDLER_TURNS)
        beams["idler_axle"] = AxleBeam.of(plates, (gear, -on_cam_gear), (wheel, on_wheel))
    return beams
