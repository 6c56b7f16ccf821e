"""CPU time of starting: bare Python, and `jumpcad --help` (s, least of some processes each).

Run `python benchmarks/start.py [--json] [--rounds N]`. The least is nearest to the work itself: a busy machine adds.
"""

import argparse
import json
import resource
import subprocess
import sys

COMMANDS = {"python_s": ["-c", "pass"], "help_s": ["-m", "jumpcad", "--help"]}


def children_cpu_s() -> float:
    """Return the CPU time of all ended processes that this one has started, with those that they started."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def cpu_s(arguments: list[str]) -> float:
    """Return the CPU time of Python with these arguments."""
    before = children_cpu_s()
    subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL)
    return children_cpu_s() - before


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    found = {
        name: min(cpu_s(command) for _ in range(arguments.rounds + 1))  # one more: the first may write byte code
        for name, command in COMMANDS.items()
    }
    if arguments.json:
        print(json.dumps(found, indent=2))
        return
    print(f"python {found['python_s']:.3f} s, jumpcad --help {found['help_s']:.3f} s")


if __name__ == "__main__":
    main()
