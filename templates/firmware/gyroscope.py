"""The steering wheel with a gyroscope: a turn ends at its angle. An LSM6DSO on two pins, in any attitude.

Before each turn the robot rests for a moment: that tells the gyroscope's offset, and by its accelerometer which way is
up. The rate about that way is summed while the wheel turns, at no other time: it does not know how a jump turned the
robot. Without an answer from the sensor turns go by time.
"""

import math
import struct

import winder

ADDRESS = 0x6B
WHO_AM_I, ANSWER = 0x0F, 0x6C
SETTINGS = ((0x12, 0x44), (0x10, 0x50), (0x11, 0x50))  # whole readings, addresses count up; 208 Hz: 2 g, 250 deg/s
OUTPUTS = 0x22  # six words, low byte first: rates about x, y, z, accelerations
G = 0.061e-3  # of a step of the accelerometer
STARTS_MS, REST_MS, LEAST = 100, 300, 20  # the sensor starts, the robot rests; the fewest readings of that
STILL_DPS, STILL_G = 3.0, 0.2  # how far rates scatter, and the acceleration is from 1 g, of a robot that rests
SEEN = 0.5  # of a turn, after the time that it takes: a wheel that slips more, a blocked one, a sensor that hangs
LONGEST = 2  # times as long as that


class Gyroscope:
    """The sensor on its two wires; what fails to answer reads as None."""

    def __init__(self, numbers):
        from machine import I2C, Pin  # not on a computer

        self.step_dps = numbers.GYRO_DPS
        self.bus = I2C(0, scl=Pin(numbers.PIN_GYRO_CLOCK), sda=Pin(numbers.PIN_GYRO_DATA), freq=400_000)

    def begin(self):
        """Set it up; return whether it is there."""
        try:
            for register, value in SETTINGS:
                self.bus.writeto_mem(ADDRESS, register, bytes((value,)))
            return self.bus.readfrom_mem(ADDRESS, WHO_AM_I, 1)[0] == ANSWER
        except OSError:
            return False

    def read(self):
        """Return rates (deg/s) and accelerations (g) along its three axes."""
        try:
            words = struct.unpack("<6h", self.bus.readfrom_mem(ADDRESS, OUTPUTS, 12))
        except OSError:
            return None
        return [one * self.step_dps for one in words[:3]], [one * G for one in words[3:]]


class Wheel(winder.Wheel):
    """As `winder.Wheel`; `sensor` has `begin` and `read`."""

    def __init__(self, robot_winder, sensor=None):
        super().__init__(robot_winder)
        self.sensor = sensor or Gyroscope(robot_winder.numbers)
        self._rest = None

    def turn(self, now_ms, degrees):
        """Begin with a rest."""
        super().turn(now_ms, degrees)
        if not self.turning:
            return
        self._wanted, self._lasts_ms = abs(degrees), self._until_ms - now_ms
        self._begun_ms = now_ms
        if self.sensor.begin():
            self._begun_ms += STARTS_MS + REST_MS
            self._until_ms = self._begun_ms + LONGEST * self._lasts_ms
            self._rest, self._by_time = [], False
        else:
            self._go_by_time()

    def step(self, now_ms, battery_v=None):
        """Return the shares of PWM of left and right turn, none while it rests."""
        if not self.turning:
            return 0.0, 0.0
        if not self._by_time:
            self._measure(now_ms, self.sensor.read())
        shares = super().step(now_ms, battery_v)
        return (0.0, 0.0) if now_ms < self._begun_ms else shares

    def _measure(self, now_ms, reading):
        """Take a reading, of a robot that rests or turns, and end the turn at its angle."""
        if reading is None:
            self._begun_ms = min(self._begun_ms, now_ms)
            self._go_by_time()
        elif now_ms < self._begun_ms:
            if now_ms >= self._begun_ms - REST_MS:
                self._rest.append(reading)
        elif self._rest is not None:
            self._rests(now_ms)
        else:
            rates, _ = reading
            turned = sum((rates[axis] - self._zero[axis]) * self._up[axis] for axis in range(3))
            self._angle += turned * (now_ms - self._last_ms) / 1000 * (1 if self._left else -1)
            self._last_ms = now_ms
            late = now_ms >= self._begun_ms + self._lasts_ms and self._angle < SEEN * self._wanted
            if self._angle >= self._wanted:
                self._end("turned")
            elif late or now_ms >= self._until_ms:
                self._end("the turn was stopped: the gyroscope saw %d of %d degrees" % (self._angle, self._wanted))

    def _rests(self, now_ms):
        """Find offsets and the way up, or say that the robot moves."""
        rest, self._rest = self._rest, None
        if len(rest) >= LEAST:
            rates, pulls = ([[one[kind][axis] for one in rest] for axis in range(3)] for kind in (0, 1))
            self._zero, pull = [sum(one) / len(rest) for one in rates], [sum(one) / len(rest) for one in pulls]
            size = math.sqrt(sum(one * one for one in pull))
            if max(max(one) - min(one) for one in rates) <= STILL_DPS and abs(size - 1) <= STILL_G:
                self._up, self._angle, self._last_ms = [one / size for one in pull], 0.0, now_ms
                return
        self._end("the turn was stopped: the robot moves; let it rest")

    def _go_by_time(self):
        """Turn by time, as without a gyroscope."""
        self._by_time, self._rest, self._until_ms = True, None, self._begun_ms + self._lasts_ms
        self.said = "the gyroscope does not answer: turning by time"

    def _end(self, words):
        self._until_ms, self.said = 0, words
