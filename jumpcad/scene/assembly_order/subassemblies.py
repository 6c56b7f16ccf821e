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
    Words,
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
        (
            Words("Press one bearing into either side of the hub, between flat jaws with a sheet of card, pressing "
                  "lightly, until it is flush: push on its outer ring alone.", needs="hub_bearing.*"),
            Words("Open the eye at the leg's lower end with a drill or reamer of {eye_drill} mm, turned by hand, until "
                  "the pin turns in it without rocking."),
            Words("Cut the leg's bar to length, sand its ends, degrease them and the sockets. Glue it with epoxy into "
                  "the sockets of both ends, lying on a flat plate with baking paper on it. A rod through the hub and "
                  "one through the ankle's eye: push or pull until they are apart as under Order and cut, upright to "
                  "the plate and parallel, and let it cure so. Wipe off what comes out at the mouths.",
                  needs="main_leg_bar"),
            Words("Open the leg's hole for the springs' pin too, until its pin goes in under the push of a thumb; the "
                  "pin itself stays out until step {step_arm}.", needs="leg_spring_pin"),
            Words("Washer and roller go on the lever's left side (the lever is the short arm at the hub; it points "
                  "backwards and up when the leg hangs down). Put the screw in from the left and turn the lock nut on "
                  "from the right until the washer has no play: {torque_m3} N·m, hand-tight."),
        ),
        checks=(Words("The roller's outer ring spins freely; the leg turns freely on a piece of its axle."),),
    ),
    Plan(
        "front", "Front link from its bar", FRONT,
        (Move(r"front_link_(\d|bar)", way="laid"),),
        (
            Words("Open both eyes with the drill of {eye_drill} mm, until the pin turns in them without rocking."),
            Words("Cut the bar, sand, degrease and glue it as the leg's, with a rod through either eye, apart as under "
                  "Order and cut, and let it cure."),
        ),
        checks=(Words("Both eyes are parallel: laid on a plate, the link does not rock, and the rods stand upright."),),
    ),
    Plan(
        "foot", "Foot and front link", FOOT,
        (
            Move("foot"),
            Move("nose_pad_.*", "from below"),
            Move(TOE_PADS, "from below", lacks="toe_left"),
        ),
        (
            Words("Degrease the soles with alcohol. Cut the pads to size and press them on for half a minute: under "
                  "either toe's tip, and around both lugs of the nose, from the sole up its round front. Leave them "
                  "for an hour before the first jump.", needs="nose_pad_.*", lacks="printed_nose_pad_.*"),
            Words("Roughen soles and printed pads with emery cloth where they meet, degrease both with alcohol. Glue "
                  "the pads on with a thin coat of super glue, pressed for a minute: under either toe's tip, and "
                  "around both lugs of the nose, from the sole up its round front; those of the nose are bent as they "
                  "were printed. Try them in place without glue first. Leave them for a day before the first jump.",
                  needs="printed_nose_pad_.*"),
            Words("The toes, with their pads, come onto the foot in step {step_feet}, when its pins are in: their "
                  "screws would be in the pins' way.", needs="toe_left"),
            Words("Open the eyes of the front link with the drill of {eye_drill} mm, as the leg's; the holes of the "
                  "foot must let the pins through without force.", lacks="front_link_bar"),
            Words("The holes of the foot must let the pins through without force.", needs="front_link_bar"),
        ),
        checks=(Words("Both pins turn in their eyes and do not rock."),),
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
        (
            Words("Solder the motor's two wires first ({motor_wire} mm each): its terminals are behind the plate's "
                  "window of {window} mm later, and no solder may stand out beyond it. The terminal with the mark is "
                  "motor +. A shaft that stands out of the motor's back is cut off before that (Order and cut): it "
                  "would stand in the window."),
            Words("Screw the standoffs to the right plate, the one with the motor's socket, from outside: "
                  "{torque_plastic} N·m. Then lay it on two strips of wood on the bench, outside down, so that screws, "
                  "slider and wires are free below it: up is the robot's left from now on."),
            Words("Solder the switch's leads to it first, those of the table under Wiring: later there is no room for "
                  "the iron.", needs="switch"),
            Words("Put the switch into its opening, its slider outwards, and turn its two screws in from outside. Ears "
                  "without thread: {nutted_screws} in their place, and an M2 nut behind each ear.", needs="switch"),
            Words("Lead the wires through the window and push the motor into its socket from above, its shaft up, its "
                  "shorter side as the socket's, until its rear stands on the socket's floor. Its front is now level "
                  "with the socket's rim or up to 0.4 mm above it ({clamp} mm as drawn). Higher: solder or a wire is "
                  "on the floor. Lower: the motor is shorter; glue strips of card onto the floor, beside the window."),
            Words("Put the cap on: it lies on the motor, not on the socket. Turn its two screws into the plastic, a "
                  "quarter of a turn each in turns, until the motor has no play along its shaft, and no further: "
                  "{torque_m2} N·m at most. The cap bends a little, a gap below its ears may remain."),
        ),
        checks=(Words("Pushed at its shaft, and at its rear through the window, the motor does not move. Nothing "
                      "touches its shaft."),),
    ),
    Plan(
        "lower", "Lower tray with the battery", LOWER,
        (
            Move("electronics_tray_lower"),
            Move("battery", "from above"),
            Move("strap_battery|tie_balance_lead", way="laid"),
        ),
        (
            Words("Lay the battery on the lower tray, between the two stops at its ends, its leads to the front, over "
                  "the stop. Cut its strap to {strap} mm: once around battery and tray through both slots, and an "
                  "overlap of 20 mm. Close it with the overlap on top of the battery and one layer below the tray, "
                  "where the front link passes it. A piece of adhesive tape under the upper end, 10 to 15 mm of it "
                  "standing out to the front, is what opens it later. Tight enough that it does not slide, not so "
                  "tight that it dents. Gaps to the stops of more than 1 mm are filled with foam tape on the stop. Do "
                  "not plug it in yet. Later it leaves the finished robot to the front: strap open, lifted over the "
                  "stop."),
            Words("Once it fits, take it out again and lay it aside, away from soldering iron and tools, strap and "
                  "tray with it. It is strapped in for good in step {step_trays}."),
            Words("The plug of the balance lead lies ahead of the battery under its cable tie, its open end covered "
                  "with adhesive tape: its pins must touch nothing. The tie is only so tight that the plug slides out "
                  "from under it: to charge, pull it out.",
                  needs="tie_balance_lead"),
        ),
        (
            Words("A lithium battery that is dented, swollen or shorted can burn: do not use it, and keep tools off "
                  "its plug."),
        ),
    ),
    Plan(
        "boards", "Upper tray with the boards", UPPER,
        (
            Move("electronics_tray_upper"),
            Move("controller|driver|regulator", "from above"),
            Move(SMALL, way="laid"),
        ),
        (
            Words("Solder first, with the boards loose: pads may be on a board's underside (BAT+ and BAT- often are) "
                  "or under its tie. First what is soldered by its own legs: bend the legs as soldering.svg shows "
                  "(under Wiring), a piece of heat-shrink tube over each leg, and lay the bodies where the "
                  "picture shows them, on a strip of foam tape."),
            Words("Then solder every wire of the table under Wiring to its boards, the shortest first, and slide "
                  "heat-shrink tube over each joint in the air. The motor's wires go to the driver last: first through "
                  "the right plate's wire hole, from outside to inside, then solder them. The sensor's ends stay free "
                  "until step {step_left}."),
            Words("Cut the foam tape out where a board has wires or legs underneath, so that the board lies flat. Then "
                  "lay every board on its piece, in its place, against the tray's rim where there is one, the "
                  "controller's USB socket to the right, and pull a cable tie over it. The plug gets a tie too, and "
                  "opens forwards; the capacitor, if there is one, gets one as well. Heads of ties lie on top, beside "
                  "what they hold, with their ends cut off; below the tray they would touch the battery's strap. None "
                  "covers a button of the controller. Tie the wires together beside the boards, so that no joint bears "
                  "a pull."),
            Words("Put the firmware on the controller over USB (firmware/README.md) before the battery is plugged in "
                  "for the first time."),
        ),
        (
            Words("{charge_how}"),
            Words("Before the battery is plugged in: switch on, multimeter across the plug's poles, no contact{beep}. "
                  "Plus of plug and battery must agree: makers of batteries do not."),
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
        (
            Words("The mount is closed all round, so the leads go through it first: lead the free ends of the sensor's "
                  "two leads through the plate's wire hole to the outside, then through the mount's window towards the "
                  "plate, and only then solder them to COM and {contact} (table and notes under Wiring).",
                  needs="sensor"),
            Words("Put the sensor into the plate's opening from outside, its plunger through to the "
                  "inside, push the mount along the leads over it, and turn the two screws into the plastic: "
                  "{torque_m2} N·m. Either way round: its plunger is drawn in the middle of its length; where yours "
                  "is not, as it stands nearer to the middle of the opening.",
                  needs="sensor"),
            Words("Then push the sensor from the inside, beside its plunger, home against the mount's floor: the "
                  "opening holds it sideways only. Fix it there with a drop of super glue between its body and the "
                  "opening's edge at either end, away from the plunger, and let that harden.", needs="sensor"),
            Words("Tie the leads at the hole so that the sensor's terminals bear no pull, and hold them flat on the "
                  "plate with a strip of adhesive tape every 20 mm, 5 mm or more below the standoff's hole: straight "
                  "from the mount to the wire hole they could come under the screw's head in step {step_close}. Where "
                  "they cross an opening, a strip of tape over the opening comes first, so that no loop reaches the "
                  "gears; the round hole above the motor's shaft stays free.", needs="sensor"),
        ),
        checks=(Words("Pressed on the inside, the plunger clicks and comes out again. Multimeter between the "
                      "controller's ground and its pin of the sensor, battery unplugged: {free}; pressed, {pressed}. "
                      "The other way round a lead is at the wrong terminal.", needs="sensor"),),
    ),
    Plan(
        "power", "First power-up, on the bench", ROBOT, (),
        (
            Words("Nothing is on the motor's shaft yet. Lay right plate, left plate and both trays side by side as "
                  "wired, switch off, USB cable out; plug the battery in, switch on."),
            Words("Multimeter on volts, the switch on: between {driver_supply} the battery's voltage; keep "
                  "off the plug's poles, they are too near to each other.", needs="driver"),
            Words("Then between the controller's ground and {divider_pin}: {divider_share} of that ({divider_v} V at "
                  "{nominal_v} V). Anything else: the resistors are exchanged, or a leg is not soldered; then nothing "
                  "protects the battery. {off}, unplug the battery, and mend it before you go on.",
                  needs="wiring_resistor_upper"),
            Words("Connect the computer by USB, open the console (firmware/README.md)."),
            Words("Type `state`: the controller answers `idle`. Type `wind`: the motor turns for {wind_max} s at most. "
                  "Press the sensor by hand: the motor stops at once, and `state` says `ready`. Hold it, type `jump` "
                  "and Enter, and let go at once, within {release_ms} ms: the motor stops {after_ms} ms later and the "
                  "count is 1. Held longer it says `fault`: press the sensor, `wind`, and try again."),
            Words("Press and hold the sensor, wait 2 s, type `wind`: the motor must not turn, and the answer is "
                  "`fault` right after a jump, else `ready`. A broken lead reads the same.",
                  needs="wiring_resistor_pull_up"),
            Words("Seen from the robot's left, so onto the shaft, it must turn {motor_turn} (red arrow). If it does "
                  "not, exchange its two wires at the driver."),
            Words("Current. {usb_out}. Switch off; multimeter on its 10 A range, its leads on the switch's two "
                  "terminals by two crocodile clips that do not touch: the current now passes it, and off is to take "
                  "a clip away. Wind, and stop with the sensor. Then take the clips off, switch off, USB cable out, "
                  "and unplug the battery.", needs="read_current"),
        ),
        (
            Words("Something becomes hot or smells: {off_then}, unplug the battery, look for the short. Do not leave "
                  "a connected battery alone."),
        ),
        (
            Words("Battery {battery_v} V at rest, at least {min_v} V."),
            Words("`state` prints the battery's voltage, to {state_off} V of the multimeter's at the plug. Calibrate "
                  "it (firmware/README.md).", needs="wiring_resistor_upper"),
            Words("The shaft alone turns with about {free_rpm} rpm. From the battery come about {boards_ma} mA while "
                  "the motor stands and {free_ma} mA while it turns, {boards_read}; the 10 A range shows "
                  "{boards_a} and {free_a} A, its last digit uncertain. A third more or less is the "
                  "scatter of motors and boards (judgement).", needs="read_current"),
            Words("The shaft alone turns with about {free_rpm} rpm.", lacks="read_current"),
        ),
    ),
)  # fmt: skip
