"""Runs the robot: reads sensor, button, battery and serial commands, and turns the motor as `winder` returns.

From the first turn of the motor on a hardware watchdog restarts the board, motor off, if the program hangs.

Commands over USB, one a line: `wind`, `jump`, `go 10`, `stop`, `state`. The button on the board winds, and then
releases after a delay, in which you step back. While it winds a press stops the motor, and during the delay it takes
the jump back; it also ends jumps in a row.
"""

import select
import sys
import time

import robot
from machine import ADC, PWM, WDT, WDT_RESET, Pin, reset_cause
from winder import FAULT, READY, REFUSED, WINDING, Row, Winder

STEP_MS = 2
LONGEST = 20  # characters of a line that are kept
MOST = 9999  # jumps in a row
KEPT = 20  # lines that wait for the motor to stand
SAMPLES = 8  # readings of the battery that are averaged: one alone scatters
COMMANDS = ("wind", "jump", "go", "stop", "state")


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
        self.turning = False
        self.watchdog = None  # none before the motor turns: it cannot be ended, and files are copied without it

    def feed(self):
        """Tell the watchdog that the program runs."""
        if self.watchdog is not None:
            self.watchdog.feed()

    def turn(self, share):
        """Give the motor a share of PWM; at 0 the driver sleeps."""
        if share > 0.0 and self.watchdog is None:
            self.watchdog = WDT(timeout=robot.WATCHDOG_MS)
        self.turning = share > 0.0
        if self.sleep is not None:
            self.sleep.value(1 if share > 0.0 else 0)
        self.motor.duty_u16(int(65535 * share))

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


class Console:
    """Commands over USB, taken byte by byte: waiting for the end of a line would stop the loop with the motor on."""

    def __init__(self):
        self.poll = select.poll()
        self.poll.register(sys.stdin, select.POLLIN)
        self.typed = ""

    def command(self):
        """Take at most one byte; return the line that it ends, or an empty text."""
        byte = sys.stdin.buffer.read(1) if self.poll.poll(0) else b""
        if not byte:
            return ""
        if byte in (b"\r", b"\n"):
            line, self.typed = self.typed.strip(), ""
            return line
        self.typed = self.typed[:-1] if byte in (b"\b", b"\x7f") else (self.typed + chr(byte[0]))[-LONGEST:]
        return ""


class Output:
    """Lines for the console, written only while the motor stands: a computer that does not read them may block."""

    def __init__(self):
        self.lines = []

    def say(self, line):
        """Keep a line; of many the last."""
        self.lines.append(line)
        if len(self.lines) > KEPT:
            self.lines.pop(0)

    def write(self):
        """Write what was kept."""
        while self.lines:
            print(self.lines.pop(0))


def split(line):
    """Return a command and the number behind it; 0 without one, and no command where it is none."""
    word, _, number = line.partition(" ")
    if word != "go":
        return line, 0
    return ("go", int(number)) if number.isdigit() and 0 < int(number) <= MOST else ("go?", 0)


def run():
    """Run until interrupted; the motor is off afterwards in every case."""
    board, winder, button, console, output = Board(), Winder(robot), Button(), Console(), Output()
    row = Row(winder)
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
            word, number = split(console.command())
            down = board.button is not None and not board.button.value()
            pressed = button.pressed(now, down)
            if number > 1 and not robot.RIGHTS_ITSELF:
                output.say("it does not roll onto its feet: set it on them, and give go 1")
            elif number and winder.state in (REFUSED, FAULT):
                output.say("no jumps in a row after that: first look at the robot, and wind")
            elif number:
                row.begin(number, now)
                output.say("%d jumps in a row; stop or the button ends it" % number)
            ended = row.left and (pressed or word in ("stop", "wind", "jump"))
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
            if winder.state != READY or due or word == "stop":
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
            if share == 0.0:
                board.turn(0.0)
            if word and word not in COMMANDS:
                output.say("unknown command; there are: %s" % ", ".join(COMMANDS))
            elif word or winder.said != told:  # each command is answered, also one that does nothing in this state
                told = winder.said
                battery = "" if volts is None else "; battery %.2f V" % volts
                output.say("%s: %s; %d jumps%s" % (winder.state, told, winder.jumps, battery))
            if not board.turning:
                output.write()
            if share > 0.0:
                board.turn(share)
            time.sleep_ms(STEP_MS)
    finally:
        board.turn(0.0)


run()
