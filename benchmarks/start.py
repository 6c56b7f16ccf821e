"""CPU time of whole commands, from the start of Python to its end (s, least of some processes each).

Run `python benchmarks/start.py [--json] [--rounds N]`. The least is nearest to the work itself: a busy machine adds.
Each command is also given in starts of bare Python and in published simulations, which take turns with the commands.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
from collections import defaultdict
from time import process_time

from jumpcad import load_design, published

COMMANDS = {
    "python_s": ["-c", "pass"],
    "help_s": ["-m", "jumpcad", "--help"],
    "simulate_s": ["-m", "jumpcad", "simulate", "kenan-2.0", "--json"],
    "build_s": ["-m", "jumpcad", "build", "kenan-2.0", "--json", "-o"],
}
WARM = 2
"""Published simulations of a round; the first also warms caches."""


def children_cpu_s() -> float:
    """Return the CPU time of all ended processes that this one has started, with those that they started."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def cpu_s(arguments: list[str]) -> float:
    """Return the CPU time of Python with these arguments; `-o` at their end gets a folder that is removed after."""
    with tempfile.TemporaryDirectory() as folder:
        folders = [f"{folder}/bundle"] if arguments[-1] == "-o" else []
        before = children_cpu_s()
        subprocess.run([sys.executable, *arguments, *folders], check=True, stdout=subprocess.DEVNULL)
        return children_cpu_s() - before


def published_s() -> float:
    """Return the CPU time of one published simulation, the least of `WARM`."""
    design, spent_s = load_design("kenan-2.0"), []
    for _ in range(WARM):
        before = process_time()
        published.simulate(design)
        spent_s.append(process_time() - before)
    return min(spent_s)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    spent_s: dict[str, list[float]] = defaultdict(list)
    for _ in range(arguments.rounds + 1):  # one more: the first may write byte code
        for name, command in COMMANDS.items():
            spent_s[name].append(cpu_s(command))
        spent_s["published_s"].append(published_s())
    found = {name: min(rounds) for name, rounds in spent_s.items()}
    if arguments.json:
        print(json.dumps(found, indent=2))
        return
    for name in COMMANDS:
        starts, simulations = found[name] / found["python_s"], found[name] / found["published_s"]
        print(f"{name:<11}{found[name]:6.3f}, {starts:4.0f} starts of Python, {simulations:5.1f} published simulations")


if __name__ == "__main__":
    main()
