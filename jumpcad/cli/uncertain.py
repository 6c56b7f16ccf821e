"""`jumpcad simulate --uncertain`: quantiles of one jump, and its sensitivity to each uncertain input."""

from typing import TYPE_CHECKING, Any

from jumpcad.cli.output import status
from jumpcad.plural import counted

if TYPE_CHECKING:
    from jumpcad.robot import Robot
    from jumpcad.settings import Settings


def uncertain(robot: "Robot", settings: "Settings", engine: str, seed: int) -> dict[str, Any]:
    """Return quantiles and first-order indices of a printed robot's jump as plain data."""
    from jumpcad.simulation import uncertain_jump

    with status("simulating samples of the uncertain inputs …"):
        return uncertain_jump(robot, settings, engine, seed).to_dict()


def uncertain_lines(found: dict[str, Any]) -> list[str]:
    """Return the result as lines of text."""
    from jumpcad.simulation.uncertain import FIGURES

    source = "the calibration's draws" if found["calibrated"] else "the priors of a calibration: none was given"
    lines = [f"uncertainty ({counted(found['jumps'], 'jump')}, {source}), quantiles 10…50…90 %:"]
    for name, label in FIGURES.items():
        shown = "…".join(f"{1000.0 * value:.0f}" for value in found["quantiles"][name])
        lines.append(f"  {label:<36}{shown} mm")
    if found["jumps_share"] < 1.0:
        lines.append(f"  {'jumps at all':<36}{100.0 * found['jumps_share']:.0f} %")
    lines.append("first-order indices: share of the variance of range, of rise")
    order = sorted(found["first_order"].items(), key=lambda item: -item[1]["ballistic_range_m"])
    lines += [f"  {name:<36}{of['ballistic_range_m']:.2f}, {of['com_rise_m']:.2f}" for name, of in order]
    return lines
