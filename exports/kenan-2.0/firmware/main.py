"""Runs the robot: reads sensor, button, battery and serial commands, and turns the motor as `winder` returns.

From the first turn of the motor on a hardware watchdog restarts the board, motor off, if the program hangs.

Commands over USB and Bluetooth, one a line: `wind`, `jump`, `go 10`, `stop`, `state`, and with a steering wheel
`turn 30`, in degrees, left positive. A link by Bluetooth that is lost counts as `stop`. The button on the board winds,
and then releases after a delay, in which you step back. While it winds a press stops the motor, and during the delay
it takes the jump back; it also ends jumps in a row, and a turn.
"""

import select
import sys
import time

import robot
from machine import ADC, PWM, WDT, WDT_RESET, Pin, reset_cause
from winder import FAULT, READY, REFUSED, WINDING, Row, Wheel, Winder

try:
    import bluetooth
except ImportError:  # a chip without
    bluetooth = None

STEP_MS = 2
LONGEST = 20  # characters of a line that are kept
NUMBERED = {"go": (1, 9999), "turn": (-180, 180)}  # jumps in a row; degrees
KEPT = 20  # lines that wait for the motor to stand
SAMPLES = 8  # readings of the battery that are averaged: one alone scatters
STEERS = robot.PIN_STEER_LEFT is not None
COMMANDS = ("wind", "jump", "go", "stop", "state") + (("turn",) if STEERS else ())
UART = "6E40000%d-B5A3-F393-E0A9-E50E24DCCA9E"  # Nordic's service for text: 1, written 2, read 3
CONNECTED, LEFT, WRITTEN = 1, 2, 3  # events of MicroPython's bluetooth
ADVERTISED_US = 250_000
PACKET = 20  # bytes that every receiver takes at once


class Board:
    """The pins of the controller."""

    def __init__(self):
        self.motor = PWM(Pin(robot.PIN_MOTOR), freq=robot.PWM_HZ, duty_u16=0)
        self.sleep = None if robot.PIN_SLEEP is None else Pin(robot.PIN_SLEEP, Pin.OUT, value=0)
        self.ready = Pin(robot.PIN_READY, Pin.IN, Pin.PULL_UP)
        self.button = None if robot.PIN_BUTTON is None else Pin(robot.PIN_BUTTON, Pin.IN, Pin.PULL_UP)
        self.battery = None
        if robot.PIN_BATTERY is not None:
            self.battery = ADC(Pin(robot.PIN_BATTERY), atten=ADC.ATTN_11DB)
        pins = (robot.PIN_STEER_LEFT, robot.PIN_STEER_RIGHT) if STEERS else ()
        self.wheel = [PWM(Pin(pin), freq=robot.PWM_HZ, duty_u16=0) for pin in pins]
        self.turning = False
        self.watchdog = None  # none before the motor turns: it cannot be ended, and files are copied without it

    def feed(self):
        """Tell the watchdog that the program runs."""
        if self.watchdog is not None:
            self.watchdog.feed()

    def turn(self, share, wheel=(0.0, 0.0)):
        """Give the motor, and the wheel's to the left or right, a share of PWM; at 0 the driver sleeps."""
        self.turning = share > 0.0 or max(wheel) > 0.0
        if self.turning and self.watchdog is None:
            self.watchdog = WDT(timeout=robot.WATCHDOG_MS)
        if self.sleep is not None:
            self.sleep.value(1 if self.turning else 0)
        self.motor.duty_u16(int(65535 * share))
        for number, pin in enumerate(self.wheel):
            pin.duty_u16(int(65535 * wheel[number]))

    def battery_v(self):
        """Return the battery's voltage, or None where it is not measured."""
        if self.battery is None:
            return None
        return sum(self.battery.read_uv() for _ in range(SAMPLES)) / SAMPLES * 1e-6 * robot.BATTERY_DIVIDER


class Button:
    """A push button, debounced; each press counts once."""

    def __init__(self):
        self.was_down_ms = 0

    def pressed(self, now_ms, down):
        """Return whether it has just been down for 30 ms."""
        before = self.was_down_ms
        self.was_down_ms = before + STEP_MS if down else 0
        return before < 30 <= self.was_down_ms


def usb():
    """Return a function that takes at most one byte of what was typed."""
    poll = select.poll()
    poll.register(sys.stdin, select.POLLIN)
    return lambda: sys.stdin.buffer.read(1) if poll.poll(0) else b""


class Radio:
    """The board's Bluetooth: bytes that come, as of a serial cable, and lines that go to all who listen."""

    def __init__(self):
        self.ble, self.links = bluetooth.BLE(), set()
        self.come, self.rest = [], b""  # events come between any two steps of the program: they only append
        self.ble.active(True)
        self.ble.irq(self.event)
        notify, write = bluetooth.FLAG_NOTIFY, bluetooth.FLAG_WRITE | bluetooth.FLAG_WRITE_NO_RESPONSE
        service, written, read = (bluetooth.UUID(UART % number) for number in (1, 2, 3))
        ((self.read, self.written),) = self.ble.gatts_register_services(
            ((service, ((read, notify), (written, write))),)
        )
        self.ble.gatts_set_buffer(self.written, 10 * PACKET, True)
        self.advertise()

    def advertise(self):
        """Be found by name; the flags say that it has no classic Bluetooth."""
        name = robot.NAME.encode()[:26]
        self.ble.gap_advertise(ADVERTISED_US, b"\x02\x01\x06" + bytes((len(name) + 1, 9)) + name)

    def event(self, number, data):
        """Take what MicroPython tells."""
        if number == CONNECTED:
            self.links.add(data[0])
        elif number == LEFT:
            self.links.discard(data[0])
            self.come.append(b"\nstop\n")
            self.advertise()
        elif number == WRITTEN and len(self.come) < KEPT:
            self.come.append(self.ble.gatts_read(self.written) + b"\n")  # some apps send a line without its end

    def byte(self):
        """Take at most one byte."""
        if not self.rest and self.come:
            self.rest = self.come.pop(0)
        byte, self.rest = self.rest[:1], self.rest[1:]
        return byte

    def write(self, line):
        """Send a line."""
        data = line.encode() + b"\n"
        for link in list(self.links):
            try:
                for at in range(0, len(data), PACKET):
                    self.ble.gatts_notify(link, self.read, data[at : at + PACKET])
            except OSError:  # it has just left, or does not listen
                pass


class Console:
    """Commands, taken byte by byte: waiting for the end of a line would stop the loop with the motor on."""

    def __init__(self, take):
        self.take = take
        self.typed = ""

    def command(self):
        """Take at most one byte; return the line that it ends, or an empty text."""
        byte = self.take()
        if not byte:
            return ""
        if byte in (b"\r", b"\n"):
            line, self.typed = self.typed.strip(), ""
            return line
        self.typed = self.typed[:-1] if byte in (b"\b", b"\x7f") else (self.typed + chr(byte[0]))[-LONGEST:]
        return ""


class Output:
    """Lines for all who listen, written only while the motor stands: a computer that does not read may block."""

    def __init__(self, radio):
        self.lines = []
        self.radio = radio

    def say(self, line):
        """Keep a line; of many the last."""
        self.lines.append(line)
        if len(self.lines) > KEPT:
            self.lines.pop(0)

    def write(self):
        """Write what was kept."""
        while self.lines:
            line = self.lines.pop(0)
            print(line)
            if self.radio:
                self.radio.write(line)


def split(line):
    """Return a command and the number behind it; 0 without one, and no command where it is none."""
    word, _, number = line.partition(" ")
    if word not in NUMBERED:
        return line, 0
    least, most = NUMBERED[word]
    digits = number[1:] if number[:1] in ("-", "+") else number
    return (word, int(number)) if digits.isdigit() and least <= int(number) <= most else (word + "?", 0)


def run():
    """Run until interrupted; the motor is off afterwards in every case."""
    board, winder, button = Board(), Winder(robot), Button()
    radio = Radio() if bluetooth and robot.BLUETOOTH else None
    output, consoles = Output(radio), [Console(usb())] + ([Console(radio.byte)] if radio else [])
    row, wheel = Row(winder), Wheel(winder)
    told, release_at = "", None
    if reset_cause() == WDT_RESET:
        output.say("the program hung and was restarted")
    now, last = 0, time.ticks_ms()
    try:
        while True:
            board.feed()
            ticks = time.ticks_ms()
            now += time.ticks_diff(ticks, last)
            last = ticks
            word, number = split(next(filter(None, (console.command() for console in consoles)), ""))
            down = board.button is not None and not board.button.value()
            pressed = button.pressed(now, down)
            if word != "go":
                pass
            elif number > 1 and not robot.RIGHTS_ITSELF:
                output.say("it does not roll onto its feet: set it on them, and give go 1")
            elif winder.state in (REFUSED, FAULT):
                output.say("no jumps in a row after that: first look at the robot, and wind")
            else:
                row.begin(number, now)
                output.say("%d jumps in a row; stop or the button ends it" % number)
            ended = row.left and (pressed or word in ("stop", "wind", "jump", "turn"))
            if pressed or word in ("stop", "wind", "jump", "go"):
                pressed = pressed and not wheel.turning  # it ends the turn, and nothing begins
                wheel.stop()
            if ended:
                row.end()
                pressed = pressed and winder.state == WINDING  # it ends the row, and nothing begins
            if ended and winder.state == READY and word != "jump":
                output.say("no jump; the springs stay loaded")
            elif pressed and release_at is not None:
                release_at = None
                output.say("no jump; the springs stay loaded")
            elif pressed and winder.state == READY:
                release_at = now + robot.BUTTON_DELAY_MS
                output.say("jump in %d s" % (robot.BUTTON_DELAY_MS // 1000))
            due = release_at is not None and now >= release_at
            if winder.state != READY or due or word in ("stop", "turn"):
                release_at = None
            again, hop = row.commands(now)
            volts = board.battery_v()
            share = winder.step(
                now,
                board.ready.value() == robot.READY_LEVEL,
                volts,
                wind=word == "wind" or again or (pressed and winder.state != READY),
                jump=word == "jump" or hop or due,
                stop=word == "stop" or (pressed and winder.state == WINDING),
            )
            if word == "turn" and STEERS:
                wheel.turn(now, number)
            shares = wheel.step(now, volts)
            if share == max(shares) == 0.0:
                board.turn(0.0)
            if wheel.said:
                output.say(wheel.said)
                wheel.said = ""
            if word and word not in COMMANDS:
                asked = word[:-1]  # without the question mark of `split`
                known = asked in NUMBERED and asked in COMMANDS
                limits = "%s takes %d to %d; " % ((asked,) + NUMBERED[asked]) if known else ""
                output.say("unknown command; %sthere are: %s" % (limits, ", ".join(COMMANDS)))
            elif word or winder.said != told:  # each command is answered, also one that does nothing in this state
                told = winder.said
                battery = "" if volts is None else "; battery %.2f V" % volts
                output.say("%s: %s; %d jumps%s" % (winder.state, told, winder.jumps, battery))
            if not board.turning:
                output.write()
            if share > 0.0 or max(shares) > 0.0:
                board.turn(share, shares)
            time.sleep_ms(STEP_MS)
    finally:
        board.turn(0.0)


run()
