"""What the model of the jump leaves out, priced; where the springs' energy goes; what the floor's friction changes.

Leg flexure: the energy that bends the loaded main leg (`leg_flex` of the checks), as if none came back. Air drag: the
flight with drag ½·ρ·cd·A·v², the body's plates across the wind. Springs' internal friction: 5 % of their energy. Gears:
5 % less efficient stages, which costs battery and time, and no jump.
"""

import argparse
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jumpcad.building import build
from jumpcad.checks import check
from jumpcad.design import load_design
from jumpcad.files import template_names
from jumpcad.robot.robot import Robot
from jumpcad.search import save_figure
from jumpcad.search.report.figures import BLUE, GREY, ORANGE, RED, labels, panels
from jumpcad.simulation import Jump, Settings, simulate
from jumpcad.transforms import Array
from jumpcad.workshop import DEFAULT, load_workshop, own_workshop

AIR_KG_M3, DRAG_AREA_M2, GRAVITY_M_S2 = 1.2, 54e-4, 9.81
"""Air at 20 °C; cd·A of the bench review of the printed robot."""
SPRING_FRICTION, GEAR_LOSS = 0.05, 0.05
FRICTIONS = np.round(np.arange(0.3, 1.501, 0.05), 2)
SWEPT = ("kenan-2.0", "best-printable")
STEP_S = 1e-4


@dataclass(frozen=True)
class Priced:
    """What effects take of the range (%), and weaker gears of the battery's energy and the winding time (%)."""

    leg_flex_energy: float
    leg_flex_range: float
    drag_range: float
    spring_friction_range: float
    gears_energy: float
    gears_time: float


def less_range(robot: Robot, efficiency: float, jump: Jump) -> float:
    """Return by how much the range falls (%) when the springs give a share of their energy."""
    weaker = simulate(robot, Settings(spring_efficiency=efficiency), "planar")
    assert jump.ballistic_range_m is not None
    return 100.0 * (1.0 - (weaker.ballistic_range_m or 0.0) / jump.ballistic_range_m)


def drag_loss(jump: Jump) -> float:
    """Return what drag takes of a ballistic flight back to the height of take-off (%)."""
    assert jump.takeoff_speed_m_s is not None
    assert jump.takeoff_angle_deg is not None
    angle = math.radians(jump.takeoff_angle_deg)
    ranges: list[float] = []
    for area in (0.0, DRAG_AREA_M2):
        velocity = jump.takeoff_speed_m_s * np.array([math.cos(angle), math.sin(angle)])
        place = np.zeros(2)
        while place[1] >= 0.0:
            drag = 0.5 * AIR_KG_M3 * area / jump.mass_kg * float(np.hypot(*velocity)) * velocity
            change = STEP_S * (np.array([0.0, -GRAVITY_M_S2]) - drag)
            place = place + STEP_S * (velocity + 0.5 * change)
            velocity = velocity + change
        ranges.append(float(place[0]))
    return 100.0 * (1.0 - ranges[1] / ranges[0])


def priced(name: str, robot: Robot, jump: Jump) -> Priced:
    """Return what the missing effects take of one template's jump."""
    (flex,) = (finding.value for finding in check(robot) if finding.name == "leg_flex")
    assert flex is not None
    workshop = load_workshop("default")
    safety = workshop.safety.model_copy(update={"gear_efficiency": workshop.safety.gear_efficiency - GEAR_LOSS})
    weaker = build(load_design(name), workshop.model_copy(update={"safety": safety})).layout.drive.train
    train = robot.layout.drive.train
    return Priced(
        flex,
        less_range(robot, 1.0 - flex / 100.0, jump),
        drag_loss(jump),
        less_range(robot, 1.0 - SPRING_FRICTION, jump),
        100.0 * (weaker.electrical_j / train.electrical_j - 1.0),
        100.0 * (weaker.winding_s / train.winding_s - 1.0),
    )


def energy_accounts(accounts: Mapping[str, Mapping[str, float]]) -> Figure:
    """Draw where the springs' energy is at take-off, one bar for each robot, as shares of the energy account."""
    figure, (axes,) = panels(1, 6.4, 0.9 + 0.5 * len(accounts))
    left = np.zeros(len(accounts))
    totals = np.array([sum(account.values()) for account in accounts.values()])
    colours = (BLUE, ORANGE, GREY, RED, "#4f9d69", "#8d5fa8", "#6b4a2f")
    for index, name in enumerate(next(iter(accounts.values()))):
        share = np.array([max(account[name], 0.0) for account in accounts.values()]) / totals
        axes.barh(list(accounts), share, left=left, color=colours[index % len(colours)], label=name)
        left += share
    axes.invert_yaxis()
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0), fontsize=8)
    labels(axes, "share of the energy that was loaded into the springs", "")
    return figure


def floor_figure(friction: Sequence[float], jumps: Mapping[str, tuple[Array, Array]]) -> Figure:
    """Draw range and rise (m) of robots over the friction of the floor; NaN where they do not jump."""
    figure, (ranges, rises) = panels(2, 4.2, 3.2)
    for index, (name, (range_m, rise_m)) in enumerate(jumps.items()):
        colour = (BLUE, ORANGE, RED)[index % 3]
        ranges.plot(friction, range_m, ".-", color=colour, label=name)
        rises.plot(friction, rise_m, ".-", color=colour, label=name)
    ranges.legend()
    labels(ranges, "friction of feet on the floor", "range (m)")
    labels(rises, "friction of feet on the floor", "rise of the centre of mass (m)")
    return figure


def computed(folder: Path | None = None) -> dict[str, Any]:
    """Return prices of effects, energy accounts and floors of the templates; draw the last two into a folder."""
    robots = {
        name: build(load_design(name), name=name) for name in template_names("robots") if own_workshop(name) == DEFAULT
    }
    jumps = {name: simulate(robot, Settings(), "planar") for name, robot in robots.items()}
    accounts = {name: jump.energy_account_j or {} for name, jump in jumps.items()}
    floors: dict[str, tuple[Array, Array]] = {}
    for name in SWEPT:
        found = [simulate(robots[name], Settings(ground_friction=float(at)), "planar") for at in FRICTIONS]
        ranges, rises = (
            [jump.ballistic_range_m or np.nan for jump in found],
            [jump.com_rise_m or np.nan for jump in found],
        )
        floors[name] = np.array(ranges), np.array(rises)
    if folder:
        save_figure(energy_accounts(accounts), folder, "energy-account")
        save_figure(floor_figure(FRICTIONS.tolist(), floors), folder, "floor-friction")
    return {
        "effects": {name: vars(priced(name, robot, jumps[name])) for name, robot in robots.items()},
        "accounts_j": accounts,
        "floors": {"friction": FRICTIONS.tolist()}
        | {name: {"range_m": both[0].tolist(), "rise_m": both[1].tolist()} for name, both in floors.items()},
    }


def main() -> None:
    """Compute, print as JSON, and draw where asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plots", type=Path)
    print(json.dumps(computed(parser.parse_args().plots), indent=1))


if __name__ == "__main__":
    main()
