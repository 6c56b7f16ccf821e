"""Commands a robot from Python, over its USB cable or by Bluetooth, and prints its answers.

python examples/remote.py wind "turn 30" jump --port /dev/ttyACM0    needs pyserial: pip install pyserial
python examples/remote.py wind "turn 30" jump --name best-steered    needs bleak: pip install bleak

Each command waits for the end of the one before. Stand back: `jump` releases the springs.
"""

import argparse
import asyncio
import time
from importlib import import_module

UART = "6E40000{}-B5A3-F393-E0A9-E50E24DCCA9E"
ENDS = {
    "wind": ("ready", "refused", "fault", "idle: jump"),
    "turn": ("turned", "the turn was", "it turns only", "unknown"),
    "jump": ("idle", "refused", "fault"),
}
"""How the last answer to a command begins; any other command has one answer."""
LANDING_S, PATIENCE_S = 3.5, 60.0


class Cable:
    """A robot at the end of a USB cable."""

    def __init__(self, port: str) -> None:
        self.port = import_module("serial").Serial(port, 115200, timeout=1.0)

    def send(self, line: str) -> None:
        self.port.write(f"{line}\n".encode())

    def receive(self) -> str:
        """Return the next line, or an empty text after a second."""
        return str(self.port.readline().decode().strip())


class Radio:
    """A robot found by its name; the link's loop runs while something is sent or awaited."""

    def __init__(self, name: str) -> None:
        bleak = import_module("bleak")
        self.loop, self.lines, self.rest = asyncio.new_event_loop(), asyncio.Queue[str](), ""
        device = self.loop.run_until_complete(bleak.BleakScanner.find_device_by_name(name, timeout=20.0))
        if device is None:
            raise SystemExit(f"no robot {name} was found: is it on, and within ten metres?")
        self.client = bleak.BleakClient(device)
        self.loop.run_until_complete(self.client.connect())
        self.loop.run_until_complete(self.client.start_notify(UART.format(3), self.take))

    def take(self, _: object, data: bytearray) -> None:
        *lines, self.rest = (self.rest + data.decode()).split("\n")
        for line in lines:
            self.lines.put_nowait(line)

    def send(self, line: str) -> None:
        self.loop.run_until_complete(self.client.write_gatt_char(UART.format(2), f"{line}\n".encode()))

    def receive(self) -> str:
        """Return the next line, or an empty text after a second."""
        try:
            return self.loop.run_until_complete(asyncio.wait_for(self.lines.get(), 1.0))
        except TimeoutError:
            return ""


def carry_out(link: Cable | Radio, command: str) -> bool:
    """Send a command and print the answers up to its end; return whether it was done."""
    link.send(command)
    begun = time.monotonic()
    while time.monotonic() - begun < PATIENCE_S:
        if line := link.receive():
            print(line)
            if line.startswith(ENDS.get(command.split()[0], ("",))):
                return not line.startswith(("fault", "refused", "unknown", "it turns only", "the turn was"))
    print(f"{command}: no answer in {PATIENCE_S:.0f} s")
    return False


def main() -> None:
    """Carry out the commands one after another, until one fails."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("commands", nargs="+")
    parser.add_argument("--port")
    parser.add_argument("--name")
    asked = parser.parse_args()
    if bool(asked.port) == bool(asked.name):
        parser.error("give --port or --name")
    if not all(command.strip() for command in asked.commands):
        parser.error("a command is empty")
    link = Cable(asked.port) if asked.port else Radio(asked.name)
    for command in asked.commands:
        if not carry_out(link, command):
            raise SystemExit(1)
        if command == "jump":
            time.sleep(LANDING_S)


if __name__ == "__main__":
    main()
