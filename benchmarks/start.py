"""CPU and wall time of whole commands, from the start of Python to its end (s, least of some processes each).

Run `python benchmarks/start.py [--json] [--rounds N] [--only NAME ...]`. The least is nearest to the work itself: a
busy machine adds. `optimize`, the default search, takes half a minute. Each command is also given in starts of bare
Python and in published simulations, which take turns with the commands.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
from collections import defaultdict
from time import perf_counter, process_time

from jumpcad import load_design, published

COMMANDS = {
    "python_s": ["-c", "pass"],
    "help_s": ["-m", "jumpcad", "--help"],
    "simulate_s": ["-m", "jumpcad", "simulate", "kenan-2.0", "--json"],
    "build_s": ["-m", "jumpcad", "build", "kenan-2.0", "--json", "-o"],
    "check_s": ["-m", "jumpcad", "check", "best-printable", "--json"],
    "optimize_s": ["-m", "jumpcad", "optimize", "--json"],
}
WARM = 2
"""Published simulations of a round; the first also warms caches."""


def children_cpu_s() -> float:
    """Return the CPU time of all ended processes that this one has started, with those that they started."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def spent_s(arguments: list[str]) -> tuple[float, float]:
    """Return CPU and wall time of Python with these arguments, in a folder that is removed after, also for `-o`."""
    with tempfile.TemporaryDirectory() as folder:
        output = ["bundle"] if arguments[-1] == "-o" else []
        before, start = children_cpu_s(), perf_counter()
        subprocess.run([sys.executable, *arguments, *output], check=True, cwd=folder, capture_output=True)
        return children_cpu_s() - before, perf_counter() - start


def published_s() -> float:
    """Return the CPU time of one published simulation, the least of `WARM`."""
    design, found_s = load_design("kenan-2.0"), []
    for _ in range(WARM):
        before = process_time()
        published.simulate(design)
        found_s.append(process_time() - before)
    return min(found_s)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--only", nargs="+", default=list(COMMANDS), choices=list(COMMANDS))
    arguments = parser.parse_args()
    cpu_s: dict[str, list[float]] = defaultdict(list)
    wall_s: dict[str, list[float]] = defaultdict(list)
    for _ in range(arguments.rounds + 1):  # one more: the first may write byte code
        for name in dict.fromkeys(["python_s", *arguments.only]):
            cpu, wall = spent_s(COMMANDS[name])
            cpu_s[name].append(cpu)
            wall_s[name].append(wall)
        cpu_s["published_s"].append(published_s())
    found = {name: min(rounds) for name, rounds in cpu_s.items()}
    walls = {name: min(rounds) for name, rounds in wall_s.items()}
    if arguments.json:
        print(json.dumps(found | {"wall": walls}, indent=2))
        return
    for name, wall in walls.items():
        starts, simulations = found[name] / found["python_s"], found[name] / found["published_s"]
        print(
            f"{name:<11}{found[name]:6.3f}, {starts:4.0f} starts of Python, {simulations:5.1f} published simulations; "
            f"{wall:.2f} on the wall"
        )


if __name__ == "__main__":
    main()
