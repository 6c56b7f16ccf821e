"""The bundle: one folder with everything to print, buy, assemble and simulate a robot.

The same robot gives the same bytes.
"""

from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from jumpcad.building.bom import bill_of_materials, mass_facts, write_bom
from jumpcad.bundle import facts
from jumpcad.bundle.atomic_write import require_place, write_folder
from jumpcad.bundle.drawings.spring_sheet import spring_dxfs, spring_sheets
from jumpcad.bundle.drawings.wiring import drawings_of
from jumpcad.bundle.firmware import firmware_files
from jumpcad.bundle.guide.markdown import write_guide, write_page
from jumpcad.bundle.limits import limits_of
from jumpcad.bundle.manifest import DESIGN, WORKSHOP, Bundle
from jumpcad.bundle.motion import jump_motion
from jumpcad.bundle.page import write_report
from jumpcad.bundle.renders import all_pictures, renders
from jumpcad.bundle.weigh_sheet import weigh_sheet
from jumpcad.collision.hulls import share_on_feet
from jumpcad.coupon.contents import coupon_files, coupon_masses, coupon_pieces
from jumpcad.errors import CannotBuildError
from jumpcad.exporters.glb import animated, write_glb
from jumpcad.exporters.registry import Exporter, Files, chosen
from jumpcad.findings import errors
from jumpcad.landing.course import Trip
from jumpcad.landing.series import Series
from jumpcad.robot.electronics.limits import electronics_findings
from jumpcad.robot.robot import Robot, require_name
from jumpcad.simulation import Jump, headline
from jumpcad.simulation.uncertain import uncertainty_of
from jumpcad.workshop import Workshop, varied


def export(
    robot: Robot, folder: str | Path, pictures: bool = True, step: bool = False, force: bool = False,
    ros2: bool = False,
) -> Bundle:  # fmt: skip
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
        part.solid  # noqa: B018  # made once, for files and pictures
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
    files |= {**shown, **guide, "assembly.html": write_page(guide, robot.name, {**shown, **svgs})}
    shown_glb = glb if pictures and isinstance(glb, bytes) else None
    files["report.html"] = write_report(robot, seen, jump, shown_glb, tuple(files), sure)
    return files.items()


def report_page(
    robot: Robot, files: Iterable[str] = (), series: Series | Trip | None = None, steps: Sequence[str] = ()
) -> str:
    """Return report.html alone, with links to `files` relative to it.

    It shows recorded jumps in a row, and what the next `steps` of the design are worth, if given.
    """
    jump, sure = headline(robot, True), uncertainty_of(robot)
    return write_report(robot, renders(robot), jump, write_glb(robot), files, sure, series, steps)


def _facts(robot: Robot, jump: Jump) -> dict[str, Any]:
    """Return the manifest's entries about the robot."""
    bill, ground = bill_of_materials(robot), robot.workshop.ground
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
        "ground": {"friction": ground.foot_friction, "pad": ground.pad, "surface": ground.surface},
    }


def export_coupon(workshop: Workshop, folder: str | Path, force: bool = False) -> Bundle:
    """Write the coupon of a workshop."""
    require_place(folder)
    made = coupon_pieces(workshop)
    files = ((WORKSHOP, workshop.to_toml()), *coupon_files(workshop, made))
    return write_folder(folder, "coupon", coupon_masses(made, workshop), files, force)
