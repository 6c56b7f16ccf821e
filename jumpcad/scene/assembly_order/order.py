"""The order of assembly as data, for any robot: for every step the parts, their direction of assembly, the tool.

The pin in the leg that the springs push comes late, through a hole in the left plate: without it they are slack, so
that both plates hold the springs' other pin before anything is loaded, the cam can be turned by hand, and the motor
turns it for the first time without springs.
"""

from jumpcad.scene.assembly_order.plan import (
    CLIP,
    FOOT,
    FRONT,
    HEX_AXLE,
    HEX_M3,
    LEFT,
    LEG,
    LOWER,
    NUT_M3,
    PLIERS,
    PRESS,
    ROBOT,
    STOP,
    TOE_PADS,
    TORX_M2,
    UPPER,
    Move,
    Plan,
    clip_moves,
    pin_moves,
)

SMALL = r"(tape|tie)_(?!(sensor|motor)_leads).*|plug|capacitor|wiring_(?!sensor|switch).*"

SUBASSEMBLIES: tuple[Plan, ...] = (
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
)  # fmt: skip
"""On the bench: what is wired, up to the first power-up; then leg and foot."""

AXLES = r"(leg|front|cam|idler)_axle"

BETWEEN_PLATES: tuple[Plan, ...] = (
    Plan(
        "trays", "Trays into the right plate", ROBOT,
        (
            Move("", brings=LOWER),
            Move("", brings=UPPER),
            Move("tie_motor_leads", way="laid"),
        ),
    ),
    Plan(
        "legs", "Axles, springs and legs", ROBOT,
        (
            Move(f"{AXLES}|spring_pin", retention=("plates", "clips")),
            Move("spring_bushing_right"),
            Move("spring_right(_leg_arm)?"),
            Move("", brings=LEG),
            Move("spring_left(_leg_arm)?"),
            Move("spring_bushing_left"),
            Move("front_spacer_right"),
            Move("", brings=FRONT),
            Move("front_link"),
            Move("front_spacer_left"),
            Move("cam_spacer_right"),
            Move("idler_spacer_right"),
        ),
    ),
    Plan(
        "stop", "Pad of the rest stop", STOP,
        (Move("stop_bar"), Move("stop_pad", "from the leg", "straight")),
    ),
    Plan(
        "cam", "Rest stop, cam and gears", ROBOT,
        (
            Move("", brings=STOP),
            Move("cam"),
            Move("cam_gear"),
            Move("cam_spacer_left"),
            Move("idler"),
        ),
    ),
    Plan(
        "trial", "Trial: left plate on, cam turned by hand", ROBOT,
        (Move("", brings=LEFT, trial=True),),
    ),
    Plan(
        "close", "Pinion; left plate for good", ROBOT,
        (
            Move("motor_pinion", past="motor_shaft", tool=PRESS, reach="from the left"),
            Move("", brings=LEFT),
            Move("standoff_\\d+_screw_left", "from the left", tool=HEX_M3),
            Move(f"{AXLES}|spring_pin", "from the left", tool=HEX_AXLE, retention=("nuts",)),
            Move(f"({AXLES}|spring_pin)_nut", "from the right", past=f"{AXLES}|spring_pin", tool=NUT_M3,
                 reach="from the right"),
            *clip_moves(f"{AXLES}|spring_pin"),
        ),
    ),
)  # fmt: skip
"""Trays, axles, springs, leg, rest stop and gears between the plates, until both are screwed together."""

FIRST_JUMP: tuple[Plan, ...] = (
    Plan(
        "dry", "First winding, without springs", ROBOT, (),
    ),
    Plan(
        "arm", "The springs' pin in the leg", ROBOT,
        (
            Move("leg_spring_pin(_clip_2)?", "from the left", through="body_plate_left"),
            Move("leg_spring_pin_split_pin", "from the front", "bent", past="leg_spring_pin", tool=PLIERS,
                 reach="from the front and below"),
            Move("leg_spring_pin_clip_1", "from the front", "snapped", past="leg_spring_pin|spring_right_leg_arm",
                 tool=CLIP),
        ),
    ),
    Plan(
        "feet", "Foot onto the legs", ROBOT,
        (
            Move("", "from below", brings=FOOT),
            *pin_moves("ankle_pin", "from the right"),
            *pin_moves("front_eye_pin", "from the right"),
            Move("toe_(left|right)", "from outside"),
            Move("toe_(left|right)_screw_.*", "head last", tool=HEX_M3),
            Move(TOE_PADS, "from below"),
        ),
    ),
    Plan(
        "cage", "The cage", ROBOT,
        (
            Move("cage_(bar|hoop)_rear", "into its notch"),
            Move("cage_(bar|hoop)_front", "into its notch"),
            Move("cage_tie_.*|cage_bow", way="laid"),
        ),
    ),
    Plan(
        "jump", "First winding and first jump", ROBOT, (),
    ),
)  # fmt: skip
"""Winding without springs, the springs' pin, the foot, the cage, the first jump."""

ORDER: tuple[Plan, ...] = (*SUBASSEMBLIES, *BETWEEN_PLATES, *FIRST_JUMP)
"""What is done, in this order."""
