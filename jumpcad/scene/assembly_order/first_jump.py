"""Stage 3: winding without springs, the springs' pin, the foot, the first jump."""

from jumpcad.scene.assembly_order.plan import CLIP, FOOT, HEX_M3, PLIERS, ROBOT, TOE_PADS, Move, Plan, Words, pin_moves

FIRST_JUMP: tuple[Plan, ...] = (
    Plan(
        "dry", "First winding, without springs", ROBOT, (),
        (
            Words("The springs are slack: the leg has no pin yet that they could push. Hold the robot upright by the "
                  "plates, its leg hanging, plug the battery in, switch on, USB cable in, type `wind`, then `jump`; "
                  "ten times."),
            Words("{off}, unplug the battery."),
        ),
        (),
        (
            Words("It winds in about {dry_s} s and stops by itself, ready. After `jump` the leg falls within "
                  "{release_ms} ms. For {landing_s} s after that `wind` is only answered by the last message, and "
                  "nothing turns: give it again."),
            Words("A motor that runs for {wind_max} s and says `fault` had no signal. `ready` at once, or `fault: "
                  "sensor pressed too early`: a broken lead, or a cam that stands under the sensor. Give `wind`, then "
                  "`jump`: a jump that is counted was the cam, `fault: no release seen in time` is the lead. Mend the "
                  "sensor before the springs are armed.", needs="wiring_resistor_pull_up"),
            Words("A motor that runs for {wind_max} s and says `fault` had no signal: mend the sensor before the "
                  "springs are armed.", lacks="wiring_resistor_pull_up"),
        ),
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
        (
            Words("Lay the robot on its right plate and hold the leg on its stop: its empty hole is then behind the "
                  "hole in the left plate, {pin_hole} mm wide, below the leg's axle.", needs="leg_spring_pin"),
            Words("The slack springs swung backwards while the robot stood upright. Turn them back first: with a small "
                  "screwdriver from the front lift the outer arm of either spring until it lies against the springs' "
                  "other pin from below."),
            Words("Look before you push: both outer arms lie under the springs' other pin, and both inner arms between "
                  "the leg's empty hole and that pin. A thin rod through the hole, held at its edge away from that "
                  "pin, touches no arm. If an inner arm is behind or below the hole, its spring is not yet turned "
                  "back: the pin would stand between its two arms and the springs would not push.",
                  needs="leg_spring_pin"),
            Words("Press a clip into the groove at one end of the pin; that end goes in last.",
                  needs="leg_spring_pin_clip_.*"),
            Words("Drop the pin ({leg_pin}) through that hole and push it with a thin rod through the leg, below the "
                  "inner arms of both springs, until its end stands out beside the right spring's arm: all four arms "
                  "then lie between it and the springs' other pin."),
            Words("An arm may be up to {wider}° wider than ordered and then lies in the pin's way. Push it "
                  "aside with a small screwdriver from the front, towards the springs' other pin: the left spring's "
                  "until the pin is in the leg, then the right one's; {arm_n} N at most. Both plates hold the springs' "
                  "other pin.", lacks="preload"),
            Words("The springs are loaded by {preload}° in this pose: push the arms aside with a small screwdriver "
                  "from the front, towards the springs' other pin, the left spring's until the pin is in the leg, then "
                  "the right one's; {preload_n} N, and {arm_n} N where an arm is {wider}° wider than ordered. "
                  "Both plates hold the springs' other pin.", needs="preload"),
            Words("Turn the pin until its cross hole points forwards, put the split pin through it from the front, "
                  "bend its ends around the pin, the pliers from the front and below, and cut off what stands "
                  "out.", needs="leg_spring_pin_split_pin"),
            Words("Press the second clip into the groove at the pin's right end, from the front; hold an arm that "
                  "touches the pliers aside.",
                  needs="leg_spring_pin_clip_.*"),
        ),
        (
            Words("From now on the springs can be loaded: {energy} J, set free within {push_ms} ms. Keep "
                  "fingers out from between leg and body and away from foot, cam and gears, and your eyes away, "
                  "whenever the battery is plugged in or the leg is off its stop."),
        ),
        (
            Words("The plate does not keep the pin, at rest its hole is open: the pin's head is on the left, its split "
                  "pin bent on the right, and pushed from either side it stays.", needs="leg_spring_pin_split_pin"),
            Words("The plate does not keep the pin, at rest its hole is open: both clips are in their grooves, and "
                  "pushed from either side it stays.", needs="leg_spring_pin_clip_.*"),
            Words("The leg springs back when its end is pulled forward; {foot_n} N there would load it completely, so "
                  "pull no further than you feel it. {near_stop}"),
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
        (
            Words("Set the leg's eye between the lugs where the toes meet and push {ankle_pin} through from the left; "
                  "then the front link's between the lugs of the nose, with {front_pin}."),
            Words("Bend the split pins' ends around the pins and cut off what stands out.",
                  needs="ankle_pin_split_pin"),
            Words("Press the clips into the grooves.", needs="ankle_pin_clip_.*"),
            Words("Screw the toes to the foot's stubs from outside: {torque_plastic} N·m at most, the thread is cut "
                  "into plastic.", needs="toe_left"),
        ),
        checks=(Words("The robot stands on nose and toes; pressed down, it comes up again. {near_stop}"),),
    ),
    Plan(
        "jump", "First winding and first jump", ROBOT, (),
        (
            Words("Wear glasses. Put the robot on a floor that is not slippery, with {far} m free ahead of it and "
                  "{high} m above. Plug the battery in, switch on. {cable} {wind_by}"),
            Words("{jump_by} For {landing_s} s after a jump it ignores everything."),
            Words("{stop_by}"),
        ),
        (
            Words("Wound springs stay loaded when the battery is empty or unplugged. To slacken them, hold the robot "
                  "by its plates, feet away from you and free, and release: `jump`. Never take it apart while the leg "
                  "is off its stop."),
            Words("On the stop, too, the springs are loaded by {preload}°. Before the left plate comes off, take out "
                  "the springs' pin of the leg: clips or split pin off, then push it out to the left with a thin rod, "
                  "the arms held with a small screwdriver ({preload_n} N each) until they lie on nothing.",
                  needs="preload"),
            Words("`fault: sensor pressed too early`: a lead of the sensor is broken, the springs may be partly "
                  "loaded. Nothing in the leg's way, type `wind`, then `jump`, until the leg falls: each turns the cam "
                  "a little. Then mend the lead.", needs="wiring_resistor_pull_up"),
            Words("Springs loaded and board, driver, wires or motor fail: the way out is at the guide's end, under "
                  "Springs loaded, and nothing turns."),
            Words("Battery low while it winds: the springs are partly loaded and cannot be released. Wait a minute and "
                  "give `wind` again. Refused again: {charge_loaded} Then `wind` again, and `jump`."),
        ),
        (
            Words("It winds in about {wind_s} s. Of that, computed: {wind_ma} mA from the battery on average, "
                  "{peak_ma} mA at most, {wind_j} J; do not connect a multimeter for it. As computed it jumps {range} "
                  "mm far and {rise} mm high; what others measured on the bench was 77 to 87 % of the computed energy "
                  "at best, so expect less."),
            Words("Half of that: does a foot slip, does a link rub, is the springs' rate right, does the roller leave "
                  "the cam at once?"),
        ),
    ),
)  # fmt: skip
