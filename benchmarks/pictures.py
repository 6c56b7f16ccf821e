"""The pictures of README and docs: a jump of Kenan 2.0, three of best-jumper, best-steered around a square, stills.

    python benchmarks/pictures.py [FOLDER [calibration|coupon|front|history|plate|report|sweeps ...]]

`mechanism.svg` is drawn from the lines of the mechanism, `jumps.gif` from the robot's parts, simulated in MuJoCo: both
slow where the robot is fast. Stills that are named are drawn instead, by their commands in docs/index.md (minutes);
`report` needs Chromium. The folder is docs/pictures unless another is named.
"""

import contextlib
import io
import math
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from jumpcad.building import build
from jumpcad.bundle.renders import motion_gif
from jumpcad.bundle.viewer import viewer_data
from jumpcad.cli.commands import run
from jumpcad.design import load_design
from jumpcad.exporters import threemf
from jumpcad.landing.course import Course, go
from jumpcad.landing.series import jumps
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.robot.robot import Robot
from jumpcad.scene.renderer import View, paletted
from jumpcad.simulation import Settings, simulate
from jumpcad.transforms import Array
from jumpcad.workshop import load_workshop, own_workshop

FOLDER = Path(__file__).parents[1] / "docs" / "pictures"
ROBOT, JUMPER, STEERED = "kenan-2.0", "best-jumper", "best-steered"
WIDE, SMALL = (720, 300), (480, 260)
SQUARE = Course(points_m=((1.2, 0.0), (1.2, 1.2), (0.0, 1.2), (0.0, 0.0)))
PX_PER_MM, EDGE_PX = 1.6, 46.0
COLOURS = {BODY: "#4a4f57", MAIN_LEG: "#1f6fb2", FRONT_LINK: "#c8641a", FOOT: "#2f8f4e"}
STILLS = {
    "calibration": ("calibrate kenan-1.0 --plots .", "parameters.png"),
    "coupon": ("coupon -o made", "made/print/plate-1-PETG.3mf"),
    "front": ("optimize pareto --plots .", "pareto.png"),
    "history": ("optimize --plots .", "history.png"),
    "plate": ("build kenan-2.0 --no-pictures -o made", "made/print/plate-1-PLA.3mf"),
    "report": ("report kenan-2.0 -o report.html", "screenshot.png"),
    "sweeps": ("explore sweep --plots .", "sweeps.png"),
}
CHROMIUM = (
    "chromium --headless --no-sandbox --hide-scrollbars --window-size=960,980 --virtual-time-budget=20000 --screenshot"
)
INK, GHOST, CAM = "#22262b", "#9aa1aa", "#d9a441"
WORDS = {
    "winding": "Winding: the cam lifts the roller and winds the springs",
    "drop": "Release: the roller drops off the cam",
    "push-off": "Push-off: the springs extend the legs",
    "flight": "Flight, to the first touchdown",
}


def mechanism_svg(robot: Robot, data: dict[str, Any]) -> str:
    """Return an animated drawing of the columns of a motion, from the right side; browsers play it without a script."""
    times = np.array(data["show_s"])
    clock = f'dur="{times[-1]:g}s" repeatCount="indefinite" keyTimes="{_list(times / times[-1], 4)}"'
    frames = {name: np.array(values) for name, values in data["frames"].items()}
    places = np.concatenate([frame[:, [0, 2]] for frame in frames.values()]) * 1000.0
    reach = robot.design.l_max_mm
    left = PX_PER_MM * (places[:, 0].min() - 0.75 * reach)
    width = PX_PER_MM * (places[:, 0].max() + 0.75 * reach) - left
    height = PX_PER_MM * (places[:, 1].max() + 0.35 * reach) + 2 * EDGE_PX
    at = f"translate({-left:.1f} {height - EDGE_PX:.1f})"
    com = " ".join(
        f"{1000 * PX_PER_MM * x:.1f},{-1000 * PX_PER_MM * z:.1f}"
        for (x, z), phase in zip(data["com_m"], data["phase"], strict=True)
        if phase in ("push-off", "flight")
    )
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
            'font-family="DejaVu Sans, Arial, sans-serif" font-size="15" role="img">',
            "<title>How the mechanism winds, releases and jumps</title>",
            f'<rect width="{width:.0f}" height="{height:.0f}" fill="#ffffff"/>',
            *_captions(data, times, clock),
            *_energy(robot, frames, clock, width),
            f'<g transform="{at}"><line x1="{left:.1f}" y1="2" x2="{left + width:.1f}" y2="2" stroke="{GHOST}"/>',
            f'<polyline points="{com}" fill="none" stroke="#d1495b" stroke-width="1" stroke-dasharray="3 4"/>',
            *(_moving(frames[name], clock, shapes) for name, shapes in _shapes(robot, data, clock).items()),
            "</g></svg>",
            "",
        ]
    )  # fmt: skip


def _shapes(robot: Robot, data: dict[str, Any], clock: str) -> dict[str, str]:
    """Return what moves with each body, in its frame (pixels, y down); the last is drawn on top."""
    design, drive, layout = robot.design, robot.layout.drive, robot.layout
    cam, geometry = drive.cam, drive.cam.geometry
    hub, front = (-design.l1_mm / 2.0, 0.0), (design.l1_mm / 2.0, 0.0)
    turned = complex(*geometry.roller_mm(0.0)) * np.exp(1j * math.radians(design.rest_angle_deg))
    lever = (turned.real, turned.imag)
    outline = " ".join(f"{PX_PER_MM * x:.1f},{-PX_PER_MM * z:.1f}" for x, z in cam.profile_mm)
    axis, stages = layout.cam_axis_mm, drive.train.stages
    turn = _animated("rotate", [[math.degrees(one)] for one in data["cam_rad"]], clock)
    wheels = "".join(
        f'<circle cx="{PX_PER_MM * x:.1f}" cy="{-PX_PER_MM * z:.1f}" r="{PX_PER_MM * wheel.pitch_radius_mm:.1f}" '
        f'fill="none" stroke="{GHOST}" stroke-dasharray="2 2"/>'
        for (x, z), wheel in ((axis, stages[-1].wheel), (layout.motor_mm, stages[0].pinion))
    )
    return {
        FOOT: _bar((0.0, 0.0), (design.l4_mm, 0.0), COLOURS[FOOT], 7)
        + _bar((0.0, 0.0), (float(toe_tip_mm(design)[0]), 0.0), COLOURS[FOOT], 5),
        FRONT_LINK: _bar((0.0, 0.0), (design.l3_mm, 0.0), COLOURS[FRONT_LINK], 6),
        BODY: wheels
        + _bar(hub, front, COLOURS[BODY], 12)
        + f'<g transform="translate({PX_PER_MM * axis[0]:.1f} {-PX_PER_MM * axis[1]:.1f})"><g>{turn}'
        f'<polygon points="{outline}" fill="{CAM}" fill-opacity="0.85" stroke="{INK}"/></g></g>',
        MAIN_LEG: _bar((0.0, 0.0), (design.l2_mm, 0.0), COLOURS[MAIN_LEG], 7)
        + _bar((0.0, 0.0), lever, COLOURS[MAIN_LEG], 4)
        + _circle(lever, geometry.roller_radius_mm, "#ffffff")
        + _spiral(),
    }


def _moving(frames: Array, clock: str, shapes: str) -> str:
    """Return shapes that move with a body: its places and turns about y at the moments."""
    places = [(1000.0 * PX_PER_MM * x, -1000.0 * PX_PER_MM * z) for x, z in frames[:, [0, 2]]]
    turns = np.degrees(np.unwrap(2.0 * np.arctan2(frames[:, 4], frames[:, 6])))
    return (
        f"<g>{_animated('translate', places, clock)}<g>{_animated('rotate', turns[:, None].tolist(), clock)}"
        f"{shapes}</g></g>"
    )


def _animated(kind: str, values: Iterable[Sequence[float]], clock: str) -> str:
    rows = ";".join(" ".join(f"{value:.2f}" for value in row) for row in values)
    return f'<animateTransform attributeName="transform" type="{kind}" values="{rows}" {clock}/>'


def _captions(data: dict[str, Any], times: Array, clock: str) -> Iterable[str]:
    for phase, words in WORDS.items():
        seen = ";".join("1" if one == phase else "0" for one in data["phase"])
        yield (
            f'<text x="20" y="28" fill="{INK}" opacity="0">{words}{data["phases"][phase]}'
            f'<animate attributeName="opacity" calcMode="discrete" values="{seen}" {clock}/></text>'
        )


def _energy(robot: Robot, frames: dict[str, Array], clock: str, width: float) -> Iterable[str]:
    """Yield a bar of the energy in the springs, from the angle between body and main leg."""
    angle = [2.0 * np.arctan2(frames[name][:, 4], frames[name][:, 6]) for name in (MAIN_LEG, BODY)]
    leg = np.unwrap(angle[0] - angle[1])
    loaded = np.clip((leg.max() - leg) / (leg.max() - leg.min()), 0.0, 1.0)
    turn = loaded if abs(loaded[0]) < 0.5 else 1.0 - loaded
    stored = np.array([robot.spring.stored_j(-share * robot.spring.wind_rad) for share in turn])
    long = 180.0 * np.clip(stored / robot.spring.energy_j, 0.0, 1.0)
    yield f'<text x="{width - 400:.0f}" y="54" fill="{INK}" font-size="13">energy in the springs</text>'
    yield f'<rect x="{width - 220:.0f}" y="42" width="180" height="14" fill="none" stroke="{GHOST}"/>'
    yield (
        f'<rect x="{width - 220:.0f}" y="42" width="0" height="14" fill="#d1495b"><animate attributeName="width" '
        f'values="{_list(long, 1)}" {clock}/></rect>'
    )


def _bar(start: Sequence[float], end: Sequence[float], colour: str, thick: float) -> str:
    (x1, z1), (x2, z2) = ((PX_PER_MM * x, -PX_PER_MM * z) for x, z in (start, end))
    line = (
        f'<line x1="{x1:.1f}" y1="{z1:.1f}" x2="{x2:.1f}" y2="{z2:.1f}" stroke="{colour}" stroke-width="{thick}" '
        'stroke-linecap="round"/>'
    )
    return line + _circle(start, 2.2, "#ffffff") + _circle(end, 2.2, "#ffffff")


def _circle(at: Sequence[float], radius_mm: float, fill: str) -> str:
    return (
        f'<circle cx="{PX_PER_MM * at[0]:.1f}" cy="{-PX_PER_MM * at[1]:.1f}" r="{PX_PER_MM * radius_mm:.1f}" '
        f'fill="{fill}" stroke="{INK}"/>'
    )


def _spiral() -> str:
    """Return the springs about the hub."""
    turns = [(6.0 + 0.2 * step, 0.3 * step) for step in range(64)]
    path = " ".join(f"{radius * math.cos(angle):.1f},{radius * math.sin(angle):.1f}" for radius, angle in turns)
    return f'<polyline points="{path}" fill="none" stroke="{INK}" stroke-width="1"/>'


def _list(values: Iterable[float], digits: int) -> str:
    return ";".join(f"{value:.{digits}f}" for value in values)


def still(name: str) -> Image.Image:
    """Return a picture that a command makes, 800 pixels wide at most; of a plate, that in its file, drawn larger."""
    command, made = STILLS[name]
    threemf.PICTURE = (640, 480)
    with tempfile.TemporaryDirectory() as place, contextlib.chdir(place):
        assert run(command.split()) == 0
        if name == "report":
            subprocess.run([*CHROMIUM.split(), Path("report.html").resolve().as_uri()], check=True)
        file = zipfile.Path(made, "Metadata/thumbnail.png") if made.endswith("3mf") else Path(made)
        picture = Image.open(io.BytesIO(file.read_bytes()))
        picture.thumbnail((800, 800), Image.Resampling.LANCZOS)
    return paletted(picture.convert("RGB"))


def main() -> None:
    """Draw them."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else FOLDER).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:]:
        still(name).save(folder / f"{name}.png", optimize=True)
    if sys.argv[2:]:
        return
    robot, jumper = (build(load_design(name), load_workshop(own_workshop(name)), name) for name in (ROBOT, JUMPER))
    settings = Settings(flight="simulated", trajectory=True)
    data = viewer_data(robot, simulate(robot, settings, "planar"))
    (folder / "mechanism.svg").write_text(mechanism_svg(robot, data), encoding="utf-8")
    row = viewer_data(jumper, simulate(jumper, settings, "planar"), jumps(jumper, 3, record=True))
    (folder / "jumps.gif").write_bytes(motion_gif(jumper, row, WIDE, View(yaw_deg=-78.0, pitch_deg=12.0)))
    steered = build(load_design(STEERED), load_workshop(STEERED), STEERED)
    trip = go(steered, SQUARE, 1, record=True).trips[0]
    way = viewer_data(steered, simulate(steered, settings, "planar"), trip)
    (folder / "square.gif").write_bytes(motion_gif(steered, way, SMALL, View(yaw_deg=-62.0, pitch_deg=24.0)))


if __name__ == "__main__":
    main()
