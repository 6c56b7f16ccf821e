"""Turns that a gyroscope ends, on a simulated robot and with a pretended sensor."""

import math
import struct
import sys
from collections.abc import Iterator
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.bench_robot import NUMBERS, WINDER, firmware, wound
from support.each import each

ADDRESS, WHO_AM_I, GYRO_250_DPS, G_2 = 0x6B, 0x6C, 0.00875, 0.000061  # LSM6DSO: data sheet, tables 2, 3 and 19
STILL, FLAT = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)


class Sensor:
    """An LSM6DSO on a robot: registers, and rates of a body in any attitude with offset, scale and noise (deg/s)."""

    def __init__(self, attitude_deg=FLAT, offset_dps=STILL, scale=1.0, noise_dps=0.1) -> None:
        self.turn = Rotation.from_euler("xyz", attitude_deg, degrees=True)
        self.offset, self.scale, self.noise = np.array(offset_dps), scale, noise_dps
        self.rng, self.rate_dps, self.shaken_dps = np.random.default_rng(1), 0.0, 0.0
        self.registers: dict[int, int] = {}
        self.answers, self.hangs = True, False
        self.last = bytes(12)

    def writeto_mem(self, address: int, register: int, data: bytes) -> None:
        self._require(address)
        self.registers[register] = data[0]

    def readfrom_mem(self, address: int, register: int, count: int) -> bytes:
        self._require(address)
        if (register, count) == (0x0F, 1):
            return bytes([WHO_AM_I])
        assert (register, count) == (0x22, 12)
        assert self.registers == {0x12: 0x44, 0x10: 0x50, 0x11: 0x50}
        if not self.hangs:
            spin = self.turn.inv().apply((self.shaken_dps * self.rng.standard_normal(), 0.0, self.rate_dps))
            rates = self.scale * spin + self.offset + self.noise * self.rng.standard_normal(3)
            words = [*rates / GYRO_250_DPS, *self.turn.inv().apply((0.0, 0.0, 1.0)) / G_2]
            self.last = struct.pack("<6h", *np.round(words).astype(int))
        return self.last

    def _require(self, address: int) -> None:
        if address != ADDRESS or not self.answers:
            raise OSError(19, "ENODEV")


@pytest.fixture
def gyroscope(monkeypatch: pytest.MonkeyPatch) -> Iterator[ModuleType]:
    monkeypatch.setitem(sys.modules, "winder", WINDER)
    return firmware("gyroscope")


def turned(
    module: ModuleType, sensor: Sensor, degrees: int, floor: float = 1.0, dies_ms: float = math.inf
) -> tuple[float, float, list[str]]:
    """Turn on a floor that lets a share of the motion through; return angle, the motor's time, what was said."""
    world = wound()
    machine = SimpleNamespace(I2C=lambda *_, **__: sensor, Pin=lambda number: number)
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "machine", machine)
        numbers = SimpleNamespace(**vars(NUMBERS), GYRO_DPS=GYRO_250_DPS, PIN_GYRO_DATA=8, PIN_GYRO_CLOCK=2)
        wheel = module.Wheel(SimpleNamespace(numbers=numbers))
    wheel.winder = world.winder
    wheel.turn(round(world.now_ms), degrees)
    angle, on_ms, said, begun = 0.0, 0.0, [wheel.said], world.now_ms
    while wheel.turning:
        before = world.now_ms
        world.step()
        sensor.answers = sensor.answers and world.now_ms - begun < dies_ms
        left, right = wheel.step(round(world.now_ms), world.battery_v)
        mean_v = (2.0 * max(left, right) - 1.0) * (world.battery_v or 0.0) if left or right else 0.0
        speed_dps = 1000.0 / NUMBERS.STEER_MS_PER_DEG * mean_v / NUMBERS.STEER_V
        sensor.rate_dps = floor * math.copysign(speed_dps, left - right)
        angle += sensor.rate_dps * (world.now_ms - before) / 1000.0
        on_ms += (world.now_ms - before) * bool(left or right)
        said.append(wheel.said)
        assert world.now_ms - begun < 30_000.0
    assert wheel.step(round(world.now_ms), world.battery_v) == (0.0, 0.0)
    return angle, on_ms, said


@each("attitude_deg", [FLAT, (0.0, 35.0, 0.0), (180.0, 0.0, 0.0), (-70.0, 20.0, 110.0)])
@each("degrees", [30, -90, 180])
@each("floor", [1.0, 0.6])
def test_a_turn_ends_at_its_angle_whatever_offset_attitude_and_floor(
    gyroscope: ModuleType, attitude_deg: tuple[float, ...], degrees: int, floor: float
) -> None:
    sensor = Sensor(attitude_deg, (3.0, -2.0, 5.0))
    angle, on_ms, said = turned(gyroscope, sensor, degrees, floor)
    assert angle == pytest.approx(degrees, abs=1.0)
    assert on_ms == pytest.approx(abs(degrees) * NUMBERS.STEER_MS_PER_DEG / floor, rel=0.05)
    assert said[-1] == "turned"


@each("scale", [0.9, 1.1])
def test_a_scale_that_is_a_tenth_off_makes_turns_a_tenth_off(gyroscope: ModuleType, scale: float) -> None:
    angle, *_ = turned(gyroscope, Sensor(offset_dps=(1.0, 1.0, -1.0), scale=scale), 90)
    assert angle == pytest.approx(90.0 / scale, abs=1.5)


@each("fault", ["hangs", "blocked", "backwards"])
def test_a_turn_that_is_not_seen_ends_after_its_time(gyroscope: ModuleType, fault: str) -> None:
    """A sensor that gives one reading for ever, a blocked wheel, and a motor whose wires are swapped."""
    sensor = Sensor(offset_dps=(0.0, 0.0, 4.0))
    sensor.hangs, sensor.last = fault == "hangs", struct.pack("<6h", 0, 0, 300, 0, 0, 16393)
    _, on_ms, said = turned(gyroscope, sensor, 60, {"hangs": 1.0, "blocked": 0.0, "backwards": -1.0}[fault])
    assert on_ms == pytest.approx(60.0 * NUMBERS.STEER_MS_PER_DEG, abs=10.0)
    assert "the gyroscope saw" in said[-1]
    assert "of 60 degrees" in said[-1]


@each("dies_ms", [0.0, 200.0, 1500.0])
def test_without_an_answer_a_turn_goes_by_time(gyroscope: ModuleType, dies_ms: float) -> None:
    """Missing, pulled off while the robot rests, and while it turns."""
    sensor = Sensor()
    sensor.answers = dies_ms > 0.0
    angle, on_ms, said = turned(gyroscope, sensor, -60, dies_ms=dies_ms)
    assert on_ms == pytest.approx(60.0 * NUMBERS.STEER_MS_PER_DEG, abs=10.0)
    assert angle == pytest.approx(-60.0, abs=0.3)
    assert any("does not answer: turning by time" in one for one in said)


def test_a_robot_that_moves_does_not_begin_to_turn(gyroscope: ModuleType) -> None:
    sensor = Sensor()
    sensor.shaken_dps = 20.0
    _, on_ms, said = turned(gyroscope, sensor, 60)
    assert on_ms == 0.0
    assert "let it rest" in said[-1]
