"""Growth of memory over many evaluations in one process; the target is less than 0.1 kB for each.

Run `python benchmarks/memory.py [--json] [--evaluations N]`. The first part warms up (libraries, allocator, the
engine's own pools), the growth is that of a straight line through the rest.
"""

import argparse
import json
import os
from itertools import cycle, islice
from pathlib import Path

import numpy as np

from jumpcad.design import load_design
from jumpcad.files import template_names
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.simulation import load_settings, simulate
from jumpcad.simulation.bullet import RESET_EVERY

WARM_UP = 4 * RESET_EVERY


def resident_kb() -> float:
    """Return the memory that this process holds (kB)."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1024.0


def growth_kb(evaluations: int) -> tuple[float, float]:
    """Return growth per evaluation and in all (kB), read at the end of every period of the engine's renewal."""
    settings = load_settings("screening")
    robots = [capsule_robot(load_design(name)) for name in template_names("robots")]
    counts, sizes = [], []
    for count, robot in enumerate(islice(cycle(robots), WARM_UP + evaluations), start=1):
        simulate(robot, settings)
        if count >= WARM_UP and count % RESET_EVERY == 0:
            counts.append(count)
            sizes.append(resident_kb())
    return float(np.polyfit(counts, sizes, 1)[0]), sizes[-1] - sizes[0]


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--evaluations", type=int, default=20_000)
    arguments = parser.parse_args()
    per_evaluation, total = growth_kb(arguments.evaluations)
    if arguments.json:
        result = {"evaluations": arguments.evaluations, "kb_per_evaluation": per_evaluation, "kb_in_all": total}
        print(json.dumps(result, indent=2))
    else:
        print(f"{arguments.evaluations} evaluations: {per_evaluation:+.4f} kB each, {total:+.0f} kB in all")


if __name__ == "__main__":
    main()
