"""The bundle: one folder with everything to print, buy, assemble and simulate a robot.

The same robot gives the same bytes.
"""

from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from jumpcad.building.bom import bill_of_materials, mass_facts, write_bom
from jumpcad.bundle import facts
from jumpcad.bundle.atomic_write import require_place, write_folder
from jumpcad.bundle.drawings.spring_dxf import spring_dxfs
from jumpcad.bundle.drawings.spring_sheet import spring_sheets
from jumpcad.bundle.drawings.wiring import drawings_of
from jumpcad.bundle.firmware import firmware_files
from jumpcad.bundle.guide.markdown import write_guide
from jumpcad.bundle.guide.page import write_page
from jumpcad.bundle.inputs import DESIGN, WORKSHOP
from jumpcad.bundle.limits import limits_of
from jumpcad.bundle.manifest import Bundle
from jumpcad.bundle.motion import jump_motion
from jumpcad.bundle.page import write_report
from jumpcad.bundle.renders import RENDERS, all_pictures, renders
from jumpcad.bundle.weigh_sheet import weigh_sheet
from jumpcad.collision.stable_poses import share_on_feet
from jumpcad.coupon.contents import coupon_files, coupon_pieces
from jumpcad.errors import CannotBuildError
from jumpcad.exporters.animation import animated
from jumpcad.exporters.glb import write_glb
from jumpcad.exporters.registry import Exporter, Files, chosen
from jumpcad.findings import errors
from jumpcad.landing.course import Trip
from jumpcad.landing.series import Series
from jumpcad.robot.electronics.limits import electronics_findings
from jumpcad.robot.robot import Robot, require_name
from jumpcad.simulation import Jump, headline
from jumpcad.simulation.uncertain import Uncertainty, uncertainty_of
from jumpcad.workshop import varied


def export(
    robot: Robot,
    folder: str | Path,
    pictures: bool = True,
    step: bool = False,
    force: bool = False,
    ros2: bool = False,
) -> Bundle:
    """Write a robot's bundle.

    Parameters
    ----------
    robot
        With its parts, from `build`.
    folder
        Is made, with its parents; may be empty or hold an older bundle of the robot, whose files are replaced; files
        that a user added stay.
    pictures
        Whether to draw the robot, to animate its jump in the GLB file, and to say how sure touchdown and rise are
        in the report; half of the time.
    step
        Whether to write STEP files too; needs the extra `step`.
    force
        Whether to replace another bundle too, and files that a user edited, or added under a path of the bundle.
    ros2
        Whether to write a ROS 2 description package too.

    Raises
    ------
    JumpcadError
        If the robot's name is no file name, the folder holds anything else, a user's file would be lost, the folder
        cannot be written, or the extra for STEP is not installed.
    CannotBuildError
        If a part's file is not one closed solid, or the electrical parts do not fit together.
    """
    require_name(robot.name)
    require_place(folder)
    if wrong := errors(electronics_findings(robot)):
        raise CannotBuildError(wrong[0].message, ways=wrong[0].ways)
    exporters = chosen([name for name, wanted in (("step", step), ("ros2", ros2)) if wanted])
    jump = headline(robot, pictures)
    return write_folder(folder, robot.name, _facts(robot, jump), contents(robot, exporters, pictures, jump), force)


def contents(robot: Robot, exporters: Iterable[Exporter], pictures: bool, jump: Jump) -> Files:
    """Return path and content of every file of a bundle, except its manifest."""
    for part in robot.parts:
        part.drawing.solid  # noqa: B018  # made once, for files and pictures
    with ThreadPoolExecutor(1) as beside:  # most of drawing is arithmetic, during which Python goes on here
        drawn = beside.submit(all_pictures, robot) if pictures else None
        files: dict[str, str | bytes] = {DESIGN: robot.design.to_toml(), WORKSHOP: robot.workshop.to_toml()}
        for exporter in exporters:
            files |= dict(exporter.files(robot))
        limits_of(robot)  # for guide and report; as long as the faults of the files above are remembered
        shop = varied(robot.workshop, {"bought.leg_bearing": getattr(robot.layout.hub_bearing, "name", "")})
        made = coupon_pieces(shop)
        files |= {f"coupon/{path}": content for path, content in coupon_files(shop, made, pictures)}
        files["bom.csv"] = write_bom(bill_of_materials(robot))
        files["weigh.csv"] = weigh_sheet(robot)
        files |= {**dict(firmware_files(robot)), **dict(spring_sheets(robot)), **dict(spring_dxfs(robot))}
        motion, sure = (jump_motion(robot), uncertainty_of(robot)) if pictures else (None, None)
        seen = drawn.result() if drawn else {}
    scene = next((path for path in files if path.endswith(".glb")), "")
    glb = files.get(scene)
    if isinstance(glb, bytes) and motion is not None:
        files[scene] = glb = animated(glb, motion)
    files |= {path: text for path, text in drawings_of(robot).items() if text}
    shown = {f"pictures/{picture}.png": png for picture, png in seen.items()}
    guide = write_guide(robot, list(seen))
    svgs = {path: str(text).encode() for path, text in files.items() if path.endswith(".svg")}
    page = write_page(guide, robot.name, {**shown, **svgs})
    files |= {**shown, **guide, "assembly.html": page}
    files["report.html"] = _page(robot, jump, seen, glb if pictures and isinstance(glb, bytes) else None, files, sure)
    return files.items()


def report_page(robot: Robot, files: Iterable[str] = (), series: Series | Trip | None = None) -> str:
    """Return report.html alone, with links to `files` relative to it; it shows recorded jumps in a row if given."""
    return _page(robot, headline(robot, True), renders(robot), write_glb(robot), files, uncertainty_of(robot), series)


def _page(
    robot: Robot,
    jump: Jump,
    seen: Mapping[str, bytes],
    glb: bytes | None,
    files: Iterable[str],
    sure: Uncertainty | None,
    series: Series | Trip | None = None,
) -> str:
    pictures = {name: seen[name] for name in RENDERS if name in seen}
    return write_report(robot, pictures, jump, glb, tuple(files), sure if jump.verdict == "jump" else None, series)


def _facts(robot: Robot, jump: Jump) -> dict[str, Any]:
    """Return the manifest's entries about the robot."""
    bill = bill_of_materials(robot)
    return {
        "mass_kg": robot.mass_kg,
        "masses": mass_facts(bill.items),
        "used_up": list(bill.used),
        "bodies": {
            name: {
                "mass_kg": body.mass_kg,
                "com_m": body.com_m.tolist(),
                "inertia_kg_m2": body.inertia_kg_m2.tolist(),
            }
            for name, body in robot.bodies.items()
        },
        "drive": {"springs": facts.spring_facts(robot), "release": facts.release_facts(robot.release)},
        "electronics": facts.electronics_facts(robot),
        "stop": facts.stop_facts(robot),
        "joints": facts.joint_facts(robot),
        "cage": facts.cage_facts(robot),
        "flight": facts.flight_facts(jump),
        "rights_itself": {"static": round(share_on_feet(robot), 3)},
        "ground": {
            "friction": robot.workshop.ground.foot_friction,
            "pad": robot.workshop.ground.pad,
            "surface": robot.workshop.ground.surface,
        },
    }
