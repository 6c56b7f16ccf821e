"""Stage 3: winding without springs, the springs' pin, the foot, the first jump."""

from jumpcad.scene.assembly_order.plan import CLIP, FOOT, HEX_M3, PLIERS, ROBOT, TOE_PADS, Move, Plan, pin_moves

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
        "jump", "First winding and first jump", ROBOT, (),
    ),
)  # fmt: skip
