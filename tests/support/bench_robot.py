"""A simulated motor, cam, sensor and battery, none of which uses the firmware's code.

The cam turns at the motor's speed times the share of PWM. The sensor is pressed over the last 12° before the drop, and
bounces at each change of its state; the leg falls at the drop and lands some time later. The sensor's contact opens
when pressed, so that a broken lead reads as pressed.
"""

import importlib.util
import random
from types import ModuleType, SimpleNamespace

from jumpcad.files import templates_folder

PRESSED_DEG, TURN = 12.0, 360.0
STEP_MS = 2
NUMBERS = SimpleNamespace(
    PWM_CAP=0.9, BATTERY_MIN_V=3.5, BATTERY_EMPTY_V=3.3, BATTERY_SAG_V=0.05, LOW_MS=200, WIND_MIN_MS=900,
    WIND_MAX_MS=4000, RELEASE_MIN_MS=20, RELEASE_MAX_MS=1000, AFTER_RELEASE_MS=60, SETTLE_MS=10,
    LANDING_MS=1500, RAMP_MS=100, REST_MS=2000, BUTTON_DELAY_MS=3000,
    STEER_V=3.3, STEER_MS_PER_DEG=50.0,
)  # fmt: skip


def firmware(name: str = "winder") -> ModuleType:
    """Return a module of the firmware, as the controller loads it."""
    spec = importlib.util.spec_from_file_location(name, templates_folder() / "firmware" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


WINDER = firmware()


class World:
    """A robot on the bench, stepped in time (ms, degrees, V)."""

    def __init__(self, speed_deg_s: float = 180.0, jitter_ms: int = 0, bounce_ms: int = 4, seed: int = 1) -> None:
        self.winder = WINDER.Winder(NUMBERS)
        self.now_ms, self.cam_deg, self.drops, self.power = 0.0, 0.0, 0, 0.0
        self.speed_deg_s, self.jitter_ms, self.bounce_ms = speed_deg_s, jitter_ms, bounce_ms
        self.battery_v: float | None = 4.0
        self.drain_v_s = 0.0
        self.stuck_at_deg: float | None = None
        self.shaken_until_ms = -1.0
        self.dead_switch: bool | None = None
        self.breaks_at_deg: float | None = None
        self.changed_ms, self.was_closed = -1e9, False
        self.powers: list[float] = []
        self.random = random.Random(seed)

    def pressed(self) -> bool:
        """Return the switch as a pin reads it."""
        if self.dead_switch is not None:
            return self.dead_switch
        if self.breaks_at_deg is not None and self.cam_deg >= self.breaks_at_deg:
            return True
        true = self.cam_deg % TURN >= TURN - PRESSED_DEG
        if true != self.was_closed:
            self.was_closed, self.changed_ms = true, self.now_ms
        bouncing = self.now_ms - self.changed_ms < self.bounce_ms or self.now_ms < self.shaken_until_ms
        return self.random.random() < 0.5 if bouncing else true

    def step(self, **commands: bool) -> None:
        """Advance one step of the program."""
        dt = STEP_MS + self.random.uniform(0, self.jitter_ms)
        before = int(self.cam_deg // TURN)
        if self.stuck_at_deg is None or self.cam_deg < self.stuck_at_deg:
            self.cam_deg += self.power * self.speed_deg_s * dt / 1000.0
        self.drops += int(self.cam_deg // TURN) - before
        if self.battery_v is not None and self.power:
            self.battery_v -= self.drain_v_s * dt / 1000.0
        self.now_ms += dt
        self.power = self.winder.step(round(self.now_ms), self.pressed(), self.battery_v, **commands)
        self.powers.append(self.power)

    def until(self, *states: str, limit_s: float = 20.0) -> float:
        """Step until a state is reached, and return how long it took (s)."""
        start = self.now_ms
        while self.winder.state not in states:
            assert self.now_ms - start < 1000.0 * limit_s, f"still {self.winder.state}: {self.winder.said}"
            self.step()
        return (self.now_ms - start) / 1000.0

    def wait(self, seconds: float) -> None:
        """Step for a time."""
        end = self.now_ms + 1000.0 * seconds
        while self.now_ms < end:
            self.step()


def wound(**options: float) -> World:
    world = World(**options)  # type: ignore[arg-type]
    world.step(wind=True)
    world.until(WINDER.READY)
    return world


def jumped() -> World:
    """Return a robot that has just jumped."""
    world = wound()
    world.step(jump=True)
    world.until(WINDER.IDLE)
    return world
