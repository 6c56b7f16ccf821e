"""When the motor turns: the logic of the firmware, without hardware.

`Winder.step` takes the time (ms) and the states of the pins, and returns the motor's share of PWM, 0 to 1. It runs
under MicroPython and CPython. The cam has one drop per turn: the sensor is pressed shortly before the drop (ready)
and free after it. A broken lead of a contact that opens when pressed reads as pressed: the motor stops.
"""

IDLE, WINDING, READY, RELEASING, REFUSED, FAULT = "idle", "winding", "ready", "releasing", "refused", "fault"


class Debounced:
    """A switch whose state counts once it has been constant for a time (ms)."""

    def __init__(self, settle_ms, pressed=False):
        self.settle_ms = settle_ms
        self.pressed = pressed
        self._raw, self._since_ms = pressed, 0

    def see(self, now_ms, pressed):
        """Take a reading and return the settled state."""
        if pressed != self._raw:
            self._raw, self._since_ms = pressed, now_ms
        if now_ms - self._since_ms >= self.settle_ms:
            self.pressed = self._raw
        return self.pressed


class Winder:
    """The state of one robot.

    `numbers` is the module `robot`, or anything with its names. `said` is what happened last, in words; `jumps` counts
    releases.
    """

    def __init__(self, numbers):
        self.numbers = numbers
        self.state = IDLE
        self.said = "just started: what the springs hold is not known"
        self.jumps = 0
        self._sensor = Debounced(numbers.SETTLE_MS)
        self._since_ms = 0
        self._low_since_ms = None
        self._freed_ms = None
        self._landed_ms = 0
        self._released = False  # the springs are slack: the last that turned the cam was a release that was seen
        self._begun = False  # winding was begun and no release was seen since: the springs may be partly loaded

    def step(self, now_ms, pressed, battery_v=None, wind=False, jump=False, stop=False):
        """Return the motor's share of PWM.

        `pressed` is the sensor as read, `battery_v` the battery's voltage or None where it is not measured, `wind`,
        `jump` and `stop` are commands of this step.
        """
        numbers = self.numbers
        elapsed = now_ms - self._since_ms
        settled = self._sensor.see(now_ms, pressed)
        if stop:
            self._released = False
            return self._enter(IDLE, now_ms, "stopped; the springs may be loaded")
        if self.state == WINDING:
            if self.is_low(now_ms, battery_v):
                return self._enter(
                    REFUSED, now_ms, "battery low, the springs may be loaded: wait and wind again, or charge it"
                )
            if settled:
                return self._at_ready(now_ms, elapsed)
            if elapsed > numbers.WIND_MAX_MS:
                return self._enter(FAULT, now_ms, "not wound in time: blocked, slipping, or no sensor; motor off")
            return self._power(elapsed)
        if self.state == RELEASING:
            return self._releasing(now_ms, elapsed, pressed)
        if self.state == READY:
            if not settled:  # knocked, crept past the land, or released by a blow
                return self._enter(FAULT, now_ms, "the sensor let go: the springs may be loaded; wind again")
            if jump:  # even on a low battery: a robot is safer with its springs unloaded
                self._freed_ms = None
                return self._enter(RELEASING, now_ms, "releasing")
            return 0.0
        if wind and now_ms >= self._landed_ms:
            return self._begin(now_ms, settled, battery_v)
        return 0.0

    def rests_ms(self, now_ms):
        """Return how long the robot has been left alone, in this state and since its last landing."""
        return now_ms - max(self._since_ms, self._landed_ms)

    def _begin(self, now_ms, settled, battery_v):
        """Start to wind from rest; springs that are loaded already can be released on a low battery too."""
        if settled:  # the springs are loaded already
            return self._at_ready(now_ms, 0)
        if self._refuses(battery_v):
            return self._enter(REFUSED, now_ms, "battery low: charge it")
        self._low_since_ms = None
        self._begun = True
        return self._enter(WINDING, now_ms, "winding")

    def _at_ready(self, now_ms, elapsed):
        """Stop at the sensor; right after a release it cannot be pressed before most of a turn is done.

        Said once: what is wound with a broken lead is released by `wind` and `jump`, as often as needed.
        """
        too_early = self._released and elapsed < self.numbers.WIND_MIN_MS
        self._released = False
        if too_early:
            return self._enter(FAULT, now_ms, "sensor pressed too early: broken lead? the springs may be loaded")
        return self._enter(READY, now_ms, "ready: keep away from the leg")

    def _releasing(self, now_ms, elapsed, pressed):
        """Turn the cam past the drop: the sensor is free, and the motor stops a little after that.

        The first free reading counts at once: the leg swings back within milliseconds; a bounce restarts the time.
        A sensor that is free sooner than the cam can have passed its land was knocked: that is no release.
        """
        numbers = self.numbers
        if pressed:
            self._freed_ms = None
        elif self._freed_ms is None:
            self._freed_ms = now_ms
        if self._freed_ms is not None and now_ms - self._freed_ms >= numbers.AFTER_RELEASE_MS:
            if self._freed_ms - self._since_ms < numbers.RELEASE_MIN_MS:
                return self._enter(FAULT, now_ms, "the sensor let go too early: the springs may be loaded; wind again")
            self.jumps += 1
            self._released, self._begun = True, False
            self._landed_ms = now_ms + numbers.LANDING_MS  # before that the landing may close switch and button
            return self._enter(IDLE, now_ms, "jump %d" % self.jumps)
        if elapsed > numbers.RELEASE_MAX_MS:
            return self._enter(
                FAULT, now_ms, "no release seen in time: blocked, or a lead of the sensor broken; motor off"
            )
        return self._power(elapsed)

    def _power(self, elapsed):
        """Return the share of PWM some time after the start (ms): a ramp, since a sudden start lowers the voltage."""
        numbers = self.numbers
        return numbers.PWM_CAP * min(1.0, 0.3 + 0.7 * elapsed / numbers.RAMP_MS)

    def _refuses(self, battery_v):
        """Tell whether the battery at rest is too low; what was begun is finished with less than what begins needs."""
        least_v = self.numbers.BATTERY_EMPTY_V if self._begun else self.numbers.BATTERY_MIN_V
        return battery_v is not None and battery_v < least_v

    def is_low(self, now_ms, battery_v):
        """Tell whether the loaded battery has been low for a while."""
        if battery_v is None or battery_v >= self.numbers.BATTERY_EMPTY_V - self.numbers.BATTERY_SAG_V:
            self._low_since_ms = None
            return False
        if self._low_since_ms is None:
            self._low_since_ms = now_ms
        return now_ms - self._low_since_ms >= self.numbers.LOW_MS

    def _enter(self, state, now_ms, words):
        self.state, self.said, self._since_ms = state, words, now_ms
        return self._power(0) if state in (WINDING, RELEASING) else 0.0


class Row:
    """Jumps in a row: winds wherever the robot lies, waits until it rests, releases.

    The row ends after its last jump, with `end`, and where the winder refuses or sees a fault: a low battery, a blocked
    motor. `left` counts the jumps that are to come.
    """

    def __init__(self, winder):
        self.winder = winder
        self.left = 0
        self._jumps = 0
        self._wait_ms = 0
        self._begun_ms = 0

    def begin(self, count, now_ms=0):
        """Begin a row of jumps; the first one waits as long as the button's, to step back, also where it is wound."""
        self.left, self._jumps, self._begun_ms = count, self.winder.jumps, now_ms
        self._wait_ms = self.winder.numbers.BUTTON_DELAY_MS

    def end(self):
        """End the row; what is wound stays wound."""
        self.left = 0

    def commands(self, now_ms):
        """Return whether to wind and whether to jump now."""
        winder, numbers = self.winder, self.winder.numbers
        if self.left and winder.jumps > self._jumps:
            self.left -= winder.jumps - self._jumps
            self._jumps, self._wait_ms = winder.jumps, numbers.REST_MS
        if not self.left or winder.state in (REFUSED, FAULT):
            self.left = 0
            return False, False
        rests_ms = min(winder.rests_ms(now_ms), now_ms - self._begun_ms)
        rested = rests_ms >= (self._wait_ms if winder.state == READY else numbers.REST_MS)
        return winder.state == IDLE and (rested or not winder.jumps), winder.state == READY and rested


class Wheel:
    """The steering wheel: it turns the robot by an angle, by time, while it is wound and nothing else moves.

    A turn ends with its time, on `stop`, on a low battery, and with the state `ready`: then motor and springs have
    other things to do. So does that of a blocked wheel, after 180 degrees' time at most. `said` is what happened last.
    """

    def __init__(self, winder):
        self.winder = winder
        self.said = ""
        self._left = True
        self._until_ms = 0

    @property
    def turning(self):
        """Whether it turns."""
        return self._until_ms > 0

    def turn(self, now_ms, degrees):
        """Begin to turn by so many degrees, to the left where positive, or say why not."""
        numbers = self.winder.numbers
        if self.winder.state != READY:
            self.said = "it turns only while it is wound: wind first"
            return
        self._left = degrees > 0
        self.winder.is_low(now_ms, None)  # what was low before does not count
        last = abs(degrees) * numbers.STEER_MS_PER_DEG
        self._until_ms = now_ms + int(last)
        self.said = "turning by %d degrees, %.1f s" % (degrees, last / 1000)

    def stop(self):
        """Stop, and let it be said."""
        if self.turning:
            self._until_ms, self.said = 0, "the turn was stopped"

    def step(self, now_ms, battery_v=None):
        """Return the shares of PWM of left and right turn; the motor gets the same voltage from any battery.

        In the pauses of PWM the current flows on against the battery: the mean voltage is 2*share - 1 of it.
        """
        if not self.turning:
            return 0.0, 0.0
        numbers = self.winder.numbers
        if self.winder.state != READY or self.winder.is_low(now_ms, battery_v):
            self.stop()
        elif now_ms >= self._until_ms:
            self._until_ms, self.said = 0, "turned"
        if not self.turning:
            return 0.0, 0.0
        share = min(1.0, 0.5 + 0.5 * numbers.STEER_V / (battery_v or numbers.BATTERY_MIN_V))
        return (share, 0.0) if self._left else (0.0, share)
