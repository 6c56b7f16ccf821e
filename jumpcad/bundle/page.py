"""report.html: a page on one robot, without network: verdict, motion in 3-D, limits, energy, printing, parts.

Its text and HTML, which is well-formed XML too, are in `templates/report`. The same robot and jump give the same bytes.
"""

import base64
import math
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Annotated, Any, Literal
from urllib.parse import quote

from pydantic import Field

from jumpcad.building.bom import bill_of_materials, euros
from jumpcad.bundle.limits import limit_values, limits_of, with_verdict
from jumpcad.bundle.renders import RENDERS
from jumpcad.bundle.viewer import viewer_values
from jumpcad.design import Design, load_design
from jumpcad.dimensions import unit_of_key
from jumpcad.exporters.xml import allowed
from jumpcad.face import __version__
from jumpcad.files import Record, TomlTable, find_template, template_names
from jumpcad.files.records import Name
from jumpcad.files.templates import fill, templates_folder
from jumpcad.findings import errors
from jumpcad.landing.course import Trip
from jumpcad.landing.series import Series
from jumpcad.robot.robot import Robot
from jumpcad.simulation.jump import ACCOUNT, Jump
from jumpcad.simulation.published_robots import efficiency_band
from jumpcad.simulation.uncertain import FIGURES, Uncertainty


class Beside(TomlTable):
    """A measurement under one reading (m, J), quantiles of its prediction, and the share of predictions below it."""

    what: Literal["distance", "height", "battery"]
    reading: Literal["centre-of-mass", "first-touchdown", "resting-place", "rise", "absolute", "battery"]
    measured: float
    predicted: Annotated[tuple[float, float, float], Field(strict=False)]
    below_share: float


class Compared(Record):
    """A measured robot (`design`), predicted by a calibration on another."""

    design: Name
    calibrated_on: Name
    rows: Annotated[tuple[Beside, ...], Field(strict=False, min_length=1)]

    @property
    def outside(self) -> list[str]:
        """The quantities that no interval of eight in ten predictions holds, under whatever reading."""
        within = {row.what for row in self.rows if row.predicted[0] <= row.measured <= row.predicted[-1]}
        return [what for what in dict.fromkeys(row.what for row in self.rows) if what not in within]


def compared_of(design: Design) -> Compared | None:
    """Return what was predicted and measured of a design that is one of the study's prototypes."""
    for name in template_names("compared"):
        if load_design(name) == design:
            return Compared.from_toml(find_template("compared", name))
    return None


def write_report(
    robot: Robot, pictures: Mapping[str, bytes], jump: Jump, glb: bytes | None = None, files: Iterable[str] = (),
    sure: Uncertainty | None = None, series: Series | Trip | None = None, steps: Sequence[str] = (),
) -> str:  # fmt: skip
    """Return the page; the jump has its trajectory if the page shows the motion.

    PNG files of `RENDERS` become part of the page. Without the robot's GLB file there is no 3-D view. `files` are paths
    in the bundle to which it links; recorded jumps in a row are shown instead of the one jump. `steps` say what more
    of each of the tightest limits is worth, a line each.
    """
    values = {
        "jump": jump, "broken": errors(jump.findings), "energy_words": ACCOUNT, "band": efficiency_band(),
        "sure": sure if jump.verdict == "jump" else None,
        "sure_figures": FIGURES, "beside": compared_of(robot.design),
        "pictures": {title: base64.b64encode(png).decode() for title in RENDERS if (png := pictures.get(title))},
        "viewer": None if glb is None else viewer_values(robot, jump, glb, series), "series": series,
        "steps": steps,
        "style": (templates_folder() / "report" / "style.css").read_text(encoding="ascii"), "version": __version__,
        "robot": robot, "train": robot.layout.drive.train, "spring_deg": math.degrees(robot.spring.wind_rad),
        "parameters": type(robot.design).model_fields, "unit_of_key": unit_of_key, "bill": bill_of_materials(robot),
        "euros": euros,
    }  # fmt: skip
    values |= file_values(files) | limit_values(with_verdict(limits_of(robot), jump))
    return allowed(fill("report/report.html.j2", values))


def file_values(files: Iterable[str]) -> dict[str, Any]:
    """Return the files to which the page links, also by folder, and how a link to one is written."""
    folders: dict[str, list[str]] = {}
    for path in (files := tuple(files)):
        folders.setdefault(path.rpartition("/")[0], []).append(path)
    plates = [path for path in files if path.startswith("print/") and path.endswith(".3mf")]
    return {"files": files, "folders": folders, "plates": plates, "link": _link}


def _link(path: str) -> str:
    return f'<a href="{escape(quote(path))}">{escape(path.rpartition("/")[2])}</a>'
