"""`jumpcad simulate --landing` and `--jumps`: how the robot lands, rights itself and jumps again."""

from typing import TYPE_CHECKING, Any

import numpy as np

from jumpcad.cli.output import escaped, print_json

if TYPE_CHECKING:
    from jumpcad.robot import Robot
    from jumpcad.settings import Settings


def report_landing(
    robot: "Robot", heading: dict[str, str], settings: "Settings", tries: int, seed: int, as_json: bool
) -> None:
    """Let a robot land a number of times, and print where it rests, on what, and whether winding rights it."""
    from jumpcad.landing.landing import land
    from jumpcad.landing.stable_poses import share_on_feet

    found, static = land(robot, tries, seed, settings), share_on_feet(robot)
    if as_json:
        print_json(heading | {"landing": found.to_dict() | {"share_on_feet_static": static}})
        return
    print(escaped(f"{heading['design']}, {tries} landings in MuJoCo: attitude, spin and floor scatter"))
    for label, name in (("touches down at", "touchdown_m"), ("rests at", "rest_m")):
        low, middle, high = np.quantile([getattr(one, name) for one in found.tries], [0.0, 0.5, 1.0])
        print(f"  {label:<36}{middle:.2f} m ({low:.2f} to {high:.2f})")
    print(f"  {'rests on':<36}{', '.join(f'{side} {count}' for side, count in found.rests_on.items())}")
    print(f"  {'stands on its feet':<36}{found.share_on_feet * tries:.0f} of {tries}")
    print(f"  {'stands once it is wound again':<36}{found.share_righted * tries:.0f} of {tries}")
    print(f"  {'stable poses of the wound robot':<36}on its feet from {100.0 * static:.0f} % of all attitudes")


def report_jumps(
    robot: "Robot", heading: dict[str, str], settings: "Settings", count: int, seed: int, as_json: bool
) -> None:
    """Let a robot jump a number of times in a row, and print a line each and the sums."""
    from jumpcad.landing.series import jumps

    series = jumps(robot, count, seed, settings)
    if as_json:
        print_json(heading | {"series": series.to_dict()})
        return
    print(escaped(f"{heading['design']}, {count} jumps in a row in MuJoCo"))
    print("  jump  on its feet   way (m)  height (m)  heading (°)")
    for number, hop in enumerate(series.hops, start=1):
        stood = "yes" if hop.stood else "no"
        print(f"  {number:>4}  {stood:<11}{hop.way_m:>10.2f}{hop.height_m:>12.2f}{hop.heading_deg:>13.0f}")
    rows: dict[str, Any] = {
        "began on its feet": f"{series.stood} of {count}",
        "way in all": f"{series.way_m:.2f} m, {series.distance_m:.2f} m from where it began",
        "heading drift": f"{series.heading_drift_deg:.0f}° a jump",
        "time of a jump": f"{series.seconds_per_jump:.1f} s",
        "energy of a jump (electrical)": f"{series.electrical_j:.2f} J",
        "jumps per charge": f"{series.jumps_per_charge}",
        "metres per charge": f"{series.metres_per_charge:.0f} m",
        "cost of transport": f"{series.cost_of_transport:.1f}",
    }
    for label, text in rows.items():
        print(f"  {label:<36}{text}")
