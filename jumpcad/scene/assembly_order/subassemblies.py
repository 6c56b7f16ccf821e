"""Stage 1, on the bench: leg, foot, right plate with motor, trays, left plate; first power-up."""

from jumpcad.scene.assembly_order.plan import (
    FOOT,
    FRONT,
    HEX_M3,
    LEFT,
    LEG,
    LOWER,
    NUT_M3,
    ROBOT,
    TOE_PADS,
    TORX_M2,
    UPPER,
    Move,
    Plan,
)

SMALL = r"(tape|tie)_(?!(sensor|motor)_leads).*|plug|capacitor|wiring_(?!sensor|switch).*"

SUBASSEMBLIES: tuple[Plan, ...] = (
    Plan(
        "leg", "Main leg", LEG,
        (
            Move("main_leg"),
            Move("main_leg_bar|main_leg_end", way="laid"),
            Move("hub_bearing_1", "from the right"),
            Move("hub_bearing_2", "from the left"),
            Move("roller_washer"),
            Move("roller"),
            Move("roller_screw", "from the left", tool=HEX_M3),
            Move("roller_nut", "from the right", past="roller_screw", tool=NUT_M3, reach="from the right"),
        ),
    ),
    Plan(
        "front", "Front link from its bar", FRONT,
        (Move(r"front_link_(\d|bar)", way="laid"),),
    ),
    Plan(
        "foot", "Foot and front link", FOOT,
        (
            Move("foot"),
            Move("nose_pad_.*", "from below"),
            Move(TOE_PADS, "from below", lacks="toe_left"),
        ),
    ),
    Plan(
        "motor", "Motor, standoffs, right plate", ROBOT,
        (
            Move("body_plate_right"),
            Move("standoff_\\d+"),
            Move("standoff_\\d+_screw_right", "from the right", tool=HEX_M3),
            Move("switch"),
            Move("switch_screw_\\d+", "head last", tool=TORX_M2),
            Move("motor|motor_shaft"),
            Move("motor_cap"),
            Move("cap_screw_.*", "from the left", tool=TORX_M2),
        ),
    ),
    Plan(
        "lower", "Lower tray with the battery", LOWER,
        (
            Move("electronics_tray_lower"),
            Move("battery", "from above"),
            Move("strap_battery|tie_balance_lead", way="laid"),
        ),
    ),
    Plan(
        "boards", "Upper tray with the boards", UPPER,
        (
            Move("electronics_tray_upper"),
            Move("controller|driver|regulator", "from above"),
            Move(SMALL, way="laid"),
        ),
    ),
    Plan(
        "left", "Left plate with the sensor", LEFT,
        (
            Move("body_plate_left"),
            Move("sensor", "from the left"),
            Move("sensor_mount", "from the left"),
            Move("sensor_screw_\\d+", "head last", tool=TORX_M2),
            Move("tie_sensor_leads", way="laid"),
        ),
    ),
    Plan(
        "power", "First power-up, on the bench", ROBOT, (),
    ),
)  # fmt: skip
