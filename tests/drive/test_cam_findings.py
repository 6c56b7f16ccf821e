"""What the findings of a cam say: figures whose difference is the margin."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from support.each import each
from support.limits import default_limits

from jumpcad.drive.cam_findings import LIMITS, SCALES, Limit, _found, missed
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.cam_limits import FIRST_ROWS, measure
from jumpcad.findings import in_words

CAM = default_limits().cam


def shown(checked: Limit, room: float) -> float:
    """Return a margin in the unit of the words."""
    return math.degrees(room) if checked.unit == "rad" else room


@each("checked", LIMITS)
@each("times", [-3.0, 0.0, 3.0])
def test_what_is_found_differs_from_the_limit_by_the_margin(checked: Limit, times: float) -> None:
    room = times * checked.scale
    words = _found(checked.name, room, CAM)
    found, limit = map(float, re.findall(r"-?\d+(?:\.\d+)?", words)[-2:])
    more = found - limit if "at least" in words else limit - found
    assert more == pytest.approx(shown(checked, room), abs=0.51 if checked.unit == "rad" else 0.051)


def test_what_a_cam_misses_is_named_with_how_much_and_what_to_change() -> None:
    """Half a millimetre of undercut, a hub gap with room, and 5° too steep, each with its own remedy."""
    margin = 0.0 * SCALES[FIRST_ROWS] + 1.0
    names = [checked.name for checked in LIMITS]
    margin[names.index("cam_undercut")] = -0.5
    words, ways = missed(CAM, margin)
    assert "least convex radius" in words
    assert words.endswith("(0.5 mm short)")
    assert in_words(ways) == "choose a smaller bought.roller"
    assert "pressure angle" not in words
    margin[names.index("cam_pressure_angle")] = -math.radians(5.0)
    words, ways = missed(CAM, margin)
    assert "(5° short)" in words
    assert "lower compression_ratio or safety.pressure_angle_reserve_deg" in in_words(ways)
    for undercut, worst in ((-0.8, "pressure angle"), (-0.95, "convex radius")):  # 5° are 0.87 of the scale
        margin[names.index("cam_undercut")] = undercut
        words, _ = missed(CAM, margin)
        assert min(("pressure angle", "convex radius"), key=words.index) == worst


@each(
    ("remedy", "law", "limits", "mends"),
    [
        ("lower compression_ratio", {"compression_rad": 0.95}, {}, ("hub", "place")),
        ("lower stiffness_nmm_per_deg", {"stiffness_nm_per_rad": 0.9}, {}, ("contact", "roller_load")),
        ("nmm_per_deg or compression_ratio", {"compression_rad": 0.9}, {}, ("contact", "roller_load")),
        ("a smaller bought.roller", {}, {"roller_radius_mm": 0.9}, ("undercut", "drop", "next_lift")),
        ("a wider bought.roller", {}, {"cam_width_mm": 1.1}, ("contact",)),
        ("a larger bought.roller", {}, {"roller_load_n": 1.1}, ("roller_load",)),
        ("a smaller bought.leg_bearing", {}, {"hub_radius_mm": 0.9}, ("hub",)),
        ("lower body.stop_deg", {}, {"overshoot_rad": 0.9}, ("overshoot",)),
    ],
)  # fmt: skip
def test_what_is_to_be_changed_makes_the_margin_greater(
    remedy: str, law: dict[str, float], limits: dict[str, float], mends: tuple[str, ...]
) -> None:
    """Of one shape, by the change of the law or of the limits that the remedy brings about."""
    before = CamLaw(math.radians(60.0), 1.0, CAM.lift_rad, CAM.ramp_rad)
    laws = before, replace(before, **{key: share * getattr(before, key) for key, share in law.items()})
    others = CAM, replace(CAM, **{key: share * getattr(CAM, key) for key, share in limits.items()})
    rows = [measure(*pair, np.array([[16.0, 17.0, 0.25]]), 181)[1][:, 0] for pair in zip(laws, others, strict=True)]
    less, more = (np.minimum.reduceat(of, FIRST_ROWS) for of in rows)
    for number, checked in enumerate(LIMITS):
        if checked.name.removeprefix("cam_") in mends:
            assert remedy in in_words(checked.ways)
            assert more[number] > less[number], checked.name
