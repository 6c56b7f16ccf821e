"""Stage 2: trays, axles, springs, leg, rest stop and gears between the plates, until both are screwed together."""

from jumpcad.scene.assembly_order.plan import (
    FRONT,
    HEX_AXLE,
    HEX_M3,
    LEFT,
    LEG,
    LOWER,
    NUT_M3,
    PRESS,
    ROBOT,
    STOP,
    UPPER,
    Move,
    Plan,
    clip_moves,
)

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
