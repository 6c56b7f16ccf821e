"""`jumpcad simulate --landing` and `--jumps`: how the robot lands, rights itself and jumps again."""

from typing import TYPE_CHECKING

import numpy as np

from jumpcad.cli.output import print_json, print_text

if TYPE_CHECKING:
    from jumpcad.landing.series import Series
    from jumpcad.robot import Robot
    from jumpcad.settings import Settings


def report_landing(
    robot: "Robot", heading: dict[str, str], settings: "Settings", tries: int, seed: int, as_json: bool
) -> None:
    """Let a robot land a number of times, and print where it rests, on what, and whether winding rights it."""
    from jumpcad.landing.landing import land
    from jumpcad.scene.stable_poses import share_on_feet

    found, static = land(robot, tries, seed, settings), share_on_feet(robot)
    if as_json:
        print_json(heading | {"landing": found.to_dict() | {"share_on_feet_static": static}})
        return
    names = {"touches down at": "touchdown_m", "rests at": "rest_m"}
    distances = {
        label: np.quantile([getattr(one, name) for one in found.tries], [0.0, 0.5, 1.0])
        for label, name in names.items()
    }
    print_text(
        "landing", design=heading["design"], tries=tries, distances=distances, found=found, static=static,
        stop_mm=robot.workshop.safety.landing_stop_mm,
    )  # fmt: skip


def report_jumps(
    robot: "Robot", heading: dict[str, str], settings: "Settings", count: int, seed: int, as_json: bool,
    record: bool = False,
) -> "Series":  # fmt: skip
    """Let a robot jump a number of times in a row, print a line each and the sums, and return the series."""
    from jumpcad.landing.series import jumps

    series = jumps(robot, count, seed, settings, record)
    if as_json:
        print_json(heading | {"series": series.to_dict()})
    else:
        print_text("jumps", design=heading["design"], count=count, series=series)
    return series
