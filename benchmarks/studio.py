"""From a slider of the studio to new figures, to the printed robot's figures, and to its new meshes.

CPU times (ms), and under `wall` what a clock on the wall says, more where other programs run. Every slider of
two templates takes one step down. Figures at once are those of the study's masses in the planar engine; then the
printed robot is built and simulated; then the meshes that changed are made and sent to a viser server.
Run `python benchmarks/studio.py [--json] [--steps N]`; needs the extra `studio`, and `fast` for times worth having.
"""

import argparse
import contextlib
import importlib.util
import json
import sys
from time import perf_counter, process_time
from typing import Any

import numpy as np
import viser

from jumpcad.design import PARAMETERS, Design, load_design
from jumpcad.studio.answers import capsule_answer, printed_answer
from jumpcad.studio.stage import StudioStage
from jumpcad.workshop import load_workshop

TEMPLATES = ("kenan-2.0", "best-printable")
STAGES = ("figures", "printed", "meshes")
STEP = 0.01
"""Share by which a slider moves."""


def moved(design: Design, parameter: str, steps: int) -> Design:
    """Return a design with one slider moved down by some steps; both templates have values at upper bounds."""
    return Design(**{**design.model_dump(), parameter: getattr(design, parameter) * (1.0 - STEP * steps)})


def measured(steps: int) -> dict[str, Any]:
    """Return the times (ms) of every step, and how many meshes were sent."""
    server = viser.ViserServer(port=0, verbose=False)
    workshop, rows = load_workshop("default"), []
    for name in TEMPLATES:
        design, stage = load_design(name), StudioStage(server)
        first = printed_answer(design, workshop)
        assert first.robot is not None
        capsule_answer(design)
        stage.show(first.robot)
        for parameter in PARAMETERS:
            for step in range(1, steps + 1):
                rows.append(_step(moved(design, parameter, step), stage, workshop))
    server.stop()
    made = [row for row in rows if row["sent"] is not None]
    return {
        "compiled": importlib.util.find_spec("numba") is not None,
        "steps": len(rows),
        "refused": len(rows) - len(made),
        **{key: _quantiles([row["cpu"][key] for row in made]) for key in STAGES},
        "sent": _quantiles([row["sent"] for row in made]),
        "wall": {key: _quantiles([row["wall"][key] for row in made]) for key in STAGES},
    }


def _step(design: Design, stage: StudioStage, workshop: Any) -> dict[str, Any]:
    """Return CPU and wall time (ms) from a slider to each stage, and how many meshes were sent; None if refused."""
    times = [_clocks()]
    capsule_answer(design)
    times.append(_clocks())
    found = printed_answer(design, workshop)
    words = found.to_markdown()
    times.append(_clocks())
    sent = None
    if found.robot is not None:
        with stage.server.atomic():
            sent = stage.show(found.robot, found.wrong_parts)
        stage.server.flush()
    times.append(_clocks())
    assert words
    since = 1000.0 * (np.array(times[1:]) - times[0])
    return {"sent": sent} | {
        clock: dict(zip(STAGES, column, strict=True))
        for clock, column in zip(("cpu", "wall"), since.T.tolist(), strict=True)
    }


def _clocks() -> tuple[float, float]:
    return process_time(), perf_counter()


def _quantiles(values: list[float]) -> dict[str, float]:
    return {"median": float(np.median(values)), "p90": float(np.quantile(values, 0.9)), "max": max(values)}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--steps", type=int, default=3)
    arguments = parser.parse_args()
    with contextlib.redirect_stdout(sys.stderr):  # the server's banner
        result = measured(arguments.steps)
    if arguments.json:
        print(json.dumps(result, indent=2))
        return
    walls = {f"wall {key}": value for key, value in result.pop("wall").items()}
    for key, value in (result | walls).items():
        shown = ", ".join(f"{name} {one:.4g}" for name, one in value.items()) if isinstance(value, dict) else value
        print(f"{key}: {shown}")


if __name__ == "__main__":
    main()
