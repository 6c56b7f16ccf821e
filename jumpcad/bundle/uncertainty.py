"""The uncertainty of range and rise for report.html: quantiles, and the sensitivity to each uncertain input."""

from collections.abc import Iterator

from jumpcad.errors import JumpcadError
from jumpcad.plural import counted
from jumpcad.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation import uncertain_jump
from jumpcad.simulation.uncertain import FIGURES, Uncertainty

ENGINE, JUMPS = "planar", 128
"""The engine that every platform has, and the number of jumps, which take two seconds where the engine is not compiled:
the 10 and 90 % quantiles of kenan-2.0's range are within 3 mm of those of 1024 jumps."""
GROUPS = {
    "calibration": "springs' efficiency and friction of the pins",
    "lengths": "lengths of the links, as printed",
    "springs": "rate of the springs, as made",
    "mass": "mass",
    "floor": "friction of the floor",
}


def uncertainty_of(robot: Robot) -> Uncertainty | None:
    """Return the uncertainty of a robot's jump; None where the engine cannot simulate it."""
    try:
        return uncertain_jump(robot, Settings(), ENGINE, samples=JUMPS)
    except JumpcadError:
        return None


def uncertainty(found: Uncertainty) -> Iterator[str]:
    """Yield the section of the page: two ranges with their bars, and a table of first-order shares."""
    yield "<h2>How sure this is</h2>"
    yield (
        f"<p>{counted(found.jumps, 'jump')} by the planar engine, each with other values of what nobody measured: "
        "springs and pins from the priors of a calibration, lengths, spring rates, mass and floor within their "
        "tolerances. The prior of the springs' efficiency is 0.95 in the middle; the figure on top counts on 1. "
        "<code>jumpcad simulate --uncertain</code> does the same with your calibration.</p>"
    )
    if found.jumps_share < 1.0:
        yield f'<p class="warning">It jumps in {100.0 * found.jumps_share:.0f} % of them.</p>'
    yield '<table class="sure"><tr><th>of ten robots</th>'
    yield '<th class="number">one stays below</th><th class="number">half</th><th class="number">nine</th></tr>'
    for figure, word in FIGURES.items():
        cells = "".join(f'<td class="number">{1000.0 * value:.0f} mm</td>' for value in found.quantiles[figure])
        yield f"<tr><td>{word}</td>{cells}</tr>"
    yield "</table>"
    yield "<p>How much of the scatter each of them alone explains:</p>"
    yield '<table class="sure"><tr><th>not known exactly</th><th>of range</th><th>of rise</th></tr>'
    for name, shares in sorted(found.first_order.items(), key=lambda item: -item[1]["ballistic_range_m"]):
        cells = "".join(f"<td>{_bar(shares[figure])}</td>" for figure in FIGURES)
        yield f"<tr><td>{GROUPS[name]}</td>{cells}</tr>"
    yield "</table>"


def _bar(share: float) -> str:
    percent = f"{100.0 * share:.0f}"
    return f'<span class="bar"><span style="width: {percent}%"></span></span> {percent} %'
