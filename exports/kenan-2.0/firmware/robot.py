"""Numbers of one robot, computed by jumpcad: motor n20-298-mp."""

PIN_MOTOR = 5  # GPIO numbers
PIN_SLEEP = 6
PIN_READY = 7
READY_LEVEL = 1  # of the sensor's pin at the ready position: 1 with a contact that opens there (NC)
PIN_BATTERY = 3  # None: not measured
PIN_BUTTON = 9  # on the board; None: serial commands alone
PWM_HZ = 20000
PWM_CAP = 1.0  # largest share of PWM: keeps gearbox and winding within their limits on a full battery
BATTERY_DIVIDER = 2.0  # battery's voltage over that at its pin; to calibrate it, see README.md
BATTERY_MIN_V = 3.5  # below this, at rest, it does not begin to wind
BATTERY_EMPTY_V = 3.3  # below this, at rest, it does not finish either what was begun
BATTERY_SAG_V = 0.017  # by this below the last, while it winds, it stops: the least voltage that the boards are checked for
LOW_MS = 200  # when it is so low for so long
WIND_MIN_MS = 1200  # right after a jump the sensor is not believed before this
WIND_MAX_MS = 6000  # a blocked motor is off after this at the latest
RELEASE_MIN_MS = 20  # a sensor that is free sooner was knocked: the cam cannot have dropped yet
RELEASE_MAX_MS = 700  # as above, from the ready position over the drop
READY_DEG = 16.5  # cam angle before the drop at which the sensor is pressed; for information
AFTER_RELEASE_MS = 60  # motor runs on after the sensor is free
SETTLE_MS = 10  # a switch counts after this
LANDING_MS = 1500  # ignored after a jump
REST_MS = 2000  # between landing, winding and release of jumps in a row
BUTTON_DELAY_MS = 3000  # to step back
RIGHTS_ITSELF = False  # by its cage; without one it jumps once, and is set on its feet again
RAMP_MS = 100
WATCHDOG_MS = 1000  # a program that hangs for so long is restarted, motor off
