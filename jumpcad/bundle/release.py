"""The manifest's entries about the release: results, and the inputs that an independent simulation needs."""

import math
from typing import Any

from jumpcad.drive.release import Release
from jumpcad.drive.rolling import ReleaseParts


def release_facts(release: Release) -> dict[str, Any]:
    """Return plain data: angles in degrees, torques at the gear motor's output or, if named so, at the cam.

    `energy_ratio` and `energy_ratio_rounded` (with the workshop's corner radius) neglect the bending of the lever;
    simulated jumps start with `energy_ratio_with_bending`. Torques are the largest of both corners and of the two
    motors in `assumed`, which are at the ends of the workshop's ranges; the second one is computed at low speed too.
    """
    return {
        "energy_ratio": round(release.energy_ratio, 6),
        "energy_ratio_rounded": round(release.rounded_ratio, 6),
        "energy_ratio_with_bending": round(release.off.energy_ratio, 6),
        "bending_ratio": round(release.bending_ratio, 6),
        "leg_deg": round(math.degrees(release.off.leg_rad), 6),
        "leg_rad_s": round(release.off.leg_rad_s, 6),
        "kick_nm": round(release.kick_nm, 6),
        "kick_limit_nm": round(release.kick_limit_nm, 6),
        "blow_at_cam_nm": round(release.blow_nm, 6),
        "gear_ratio": round(release.gear_ratio, 9),
        "push_off_s": round(release.push_off_s, 6),
        "free_play_deg": round(math.degrees(release.free_play_rad), 6),
        "roll_over_deg": round(math.degrees(release.roll_over_rad), 6),
        "window_deg": [round(math.degrees(angle), 6) for angle in release.window_rad],
        "assumed": [_assumed(parts) for parts in release.parts],
    }


def _assumed(parts: ReleaseParts) -> dict[str, float]:
    """Return inertias, stiffnesses and clearances of a release, referred to the cam, with nine significant digits."""
    values = {
        "cam_kg_m2": parts.cam_kg_m2,
        "gear_kg_m2": parts.gear_kg_m2,
        "rotor_kg_m2": parts.rotor_kg_m2,
        "backlash_deg": math.degrees(parts.backlash_rad),
        "cam_rad_s": parts.cam_rad_s,
        "rebound": parts.rebound,
        "friction_mm": parts.friction_mm,
        "train_nm_per_rad": parts.train_nm_per_rad,
        "lever_nm_per_rad": parts.lever_nm_per_rad,
        "contact_nm_per_rad": parts.contact_nm_per_rad,
        "roller_kg_m2": parts.roller_kg_m2,
    }
    return {name: float(f"{value:.9g}") for name, value in values.items()}
