"""The eight numbers of a jumping robot, what follows from them alone, and the workshop that a template brings.

Symbols are those of the published study: the body carries the main leg (link a, length l2) at the back and the front
link (link c, l3) at the front; foot link d (l4) joins their ends; two toes (link e, l5) reach backwards from the
ankle. At rest the legs are parallel, the foot is flat and the body is tilted by beta.
"""

import math
import numbers
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, ClassVar, NamedTuple, Self

from pydantic import Field

from jumpcad.arguments import check_arguments
from jumpcad.dimensions import unit_of_key
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.files import Record, find_template, read_toml, template_names, to_toml
from jumpcad.files.complaints import described
from jumpcad.findings import higher, nearer_to_1

DEFAULT = "default"
"""The workshop of designs that have none of their own."""


class Design(Record):
    """Eight parameters of a Kovac-type jumper, each within what is physically meaningful.

    A search uses narrower limits, `PRINTED_BOUNDS` or the study's `SEARCH_BOUNDS`.
    """

    workshop_name: ClassVar[str] = DEFAULT
    """The workshop in which it is built unless another is given; a template that has its own brings it. Copies keep it,
    and it is none of the values by which designs are compared and written."""
    carrying_link_mm: Annotated[float, Field(ge=20, le=400, description="length of the main leg, l2")]
    c_coef: Annotated[float, Field(ge=0.3, le=3, description="front link over main leg, l3 / l2")]
    d_coef: Annotated[float, Field(ge=0.1, le=3, description="foot link over main leg, l4 / l2")]
    e_coef: Annotated[float, Field(ge=0.1, le=3, description="toe over main leg, l5 / l2")]
    compression_ratio: Annotated[float, Field(ge=0.01, le=0.99, description="loaded part of the angle to a flat leg")]
    rest_angle_deg: Annotated[float, Field(ge=5, le=90, description="angle between body and legs at rest")]
    stiffness_nmm_per_deg: Annotated[float, Field(ge=0.1, le=200, description="of both springs together")]
    ground_link_angle_deg: Annotated[float, Field(ge=1, le=89, description="each toe from the foot's centre line")]

    def __repr__(self) -> str:
        return f"<Design {', '.join(f'{name}={value:.5g}' for name, value in self.model_dump().items())}>"

    def _repr_html_(self) -> str:
        """Return the parameters with their units and meanings as a table, for a notebook."""
        rows = "".join(
            f"<tr><th>{name}</th><td>{f'{value:.5g} {unit_of_key(name)}'.strip()}</td>"
            f"<td>{type(self).model_fields[name].description}</td></tr>"
            for name, value in self.model_dump().items()
        )
        return f"<table><caption>design</caption>{rows}</table>"

    @classmethod
    def from_vector(cls, vector: Sequence[float]) -> Self:
        """Make a design from 8 floats in the order of `PARAMETERS`.

        Raises
        ------
        JumpcadError
            If it is not such a sequence, or a value is out of range.
        """
        wanted = f"give {len(PARAMETERS)} numbers, in the order of {', '.join(PARAMETERS)}"
        try:
            values = list(vector)
        except TypeError:
            raise JumpcadError(f"{described(vector)} is no design vector: {wanted}") from None
        if len(values) != len(PARAMETERS):
            raise JumpcadError(f"a design vector has {len(PARAMETERS)} values, not {len(values)}: {wanted}")
        if wrong := [value for value in values if not isinstance(value, numbers.Real)]:
            raise JumpcadError(f"{described(wrong[0])} in a design vector is no number: {wanted}")
        plain = [value if isinstance(value, int) else float(value) for value in values]  # float() fails for huge ints
        return cls(**dict(zip(PARAMETERS, plain, strict=True)))

    def revalidated(self) -> Self:
        """Return the same design, validated again; see `Record.revalidated`."""
        return super().revalidated()._built_in(self.workshop_name)

    def _built_in(self, workshop: str) -> Self:
        self.__dict__["workshop_name"] = workshop  # pydantic compares, hashes and writes fields alone
        return self

    def to_vector(self) -> list[float]:
        """Return the 8 parameters as floats, in the order of `PARAMETERS`."""
        return [float(getattr(self, name)) for name in PARAMETERS]

    def to_toml(self) -> str:
        """Return the design as a TOML document."""
        return to_toml(dict(zip(PARAMETERS, self.to_vector(), strict=True)))

    @property
    def l2_mm(self) -> float:
        """Main leg, back pivot to ankle (mm)."""
        return self.carrying_link_mm

    @property
    def l3_mm(self) -> float:
        """Front link, front pivot to front eye (mm)."""
        return self.c_coef * self.carrying_link_mm

    @property
    def l4_mm(self) -> float:
        """Foot, ankle to front eye (mm)."""
        return self.d_coef * self.carrying_link_mm

    @property
    def l5_mm(self) -> float:
        """Each toe, ankle to tip (mm)."""
        return self.e_coef * self.carrying_link_mm

    @property
    def links_mm(self) -> tuple[float, float, float, float]:
        """Lengths of main leg, front link, foot and toes (mm)."""
        return self.l2_mm, self.l3_mm, self.l4_mm, self.l5_mm

    @property
    def l_max_mm(self) -> float:
        """Longest link, by which the fitness divides: max(l2, l3, l5) (mm)."""
        return max(self.l2_mm, self.l3_mm, self.l5_mm)

    @property
    def assembly_margin_mm(self) -> float:
        """Margin by which an assembled pose exists, with parallel legs, a flat foot and l1 > 0 (mm).

        The foot must span the legs' difference in height at rest, and their difference in length when they lie flat.
        """
        surplus = self.l3_mm - self.l2_mm
        return self.l4_mm - max(abs(surplus) * math.sin(math.radians(self.rest_angle_deg)), surplus)

    @property
    def beta_rad(self) -> float:
        """Tilt of the body at rest, nose up (rad).

        Raises
        ------
        CannotBuildError
            If no assembled pose exists.
        """
        missing = -self.assembly_margin_mm
        if missing >= 0:
            raise CannotBuildError(
                f"no assembled pose: for legs of {self.l2_mm:g} and {self.l3_mm:g} mm the foot l4 = {self.l4_mm:.1f} "
                f"mm must be more than {self.l4_mm + missing:.1f} mm, with c_coef = {self.c_coef:g}, "
                f"d_coef = {self.d_coef:g}",
                ways=nearer_to_1("c_coef") + higher("d_coef"),
            )
        rise = (self.l3_mm - self.l2_mm) * math.sin(math.radians(self.rest_angle_deg))
        return math.asin(rise / self.l4_mm)

    @property
    def l1_mm(self) -> float:
        """Distance between the two body pivots, l4·sin(rest - beta)/sin(rest) (mm)."""
        rest = math.radians(self.rest_angle_deg)
        return self.l4_mm * math.sin(rest - self.beta_rad) / math.sin(rest)

    @property
    def compression_rad(self) -> float:
        """Angle by which the springs are loaded before release, ratio·(rest + beta) (rad)."""
        return self.compression_ratio * (math.radians(self.rest_angle_deg) + self.beta_rad)

    @property
    def stiffness_nm_per_rad(self) -> float:
        """Stiffness of both springs together (N·m/rad)."""
        return self.stiffness_nmm_per_deg * 180.0 / math.pi / 1000.0

    @property
    def spring_energy_j(self) -> float:
        """Energy of the loaded springs, ½·k·δ² (J)."""
        return 0.5 * self.stiffness_nm_per_rad * self.compression_rad**2

    @property
    def peak_spring_torque_nm(self) -> float:
        """Torque of both springs together at full compression, k·δ (N·m)."""
        return self.stiffness_nm_per_rad * self.compression_rad


PARAMETERS: tuple[str, ...] = tuple(Design.model_fields)


def limits_of(parameter: str) -> tuple[float, float]:
    """Return the least and the greatest value that a design can have in a parameter."""
    limits = Design.model_fields[parameter].metadata
    lower = next(limit.ge for limit in limits if hasattr(limit, "ge"))
    upper = next(limit.le for limit in limits if hasattr(limit, "le"))
    return float(lower), float(upper)


class Bounds(NamedTuple):
    """Lower and upper limit of one searched parameter, in the parameter's own unit."""

    lower: float
    upper: float


SEARCH_BOUNDS: dict[str, Bounds] = {
    "carrying_link_mm": Bounds(100.0, 200.0),
    "c_coef": Bounds(0.8, 1.2),
    "d_coef": Bounds(0.5, 0.9),
    "e_coef": Bounds(0.6, 1.4),
    "compression_ratio": Bounds(0.1, 0.8),
    "rest_angle_deg": Bounds(20.0, 70.0),
    "stiffness_nmm_per_deg": Bounds(5.0, 30.0),
    "ground_link_angle_deg": Bounds(10.0, 80.0),
}
"""The ranges that the published study searched (both prototypes lie outside it, with a rest angle of 88.2°)."""

PRINTED_BOUNDS: dict[str, Bounds] = {
    "carrying_link_mm": Bounds(20.0, 250.0),  # below 34: 12 of 126; above 250: none of 171, the bed ends
    "c_coef": Bounds(0.5, 1.5),  # below 0.53: 8 of 103; above 1.4: 3 of 230, the foot cannot span the difference
    "d_coef": Bounds(0.2, 1.6),  # below 0.2: none of 244, the same; above 1.5: 8 of 59
    "e_coef": Bounds(0.3, 2.2),  # below 0.33: 7 of 90; above 2: 7 of 99
    "compression_ratio": Bounds(0.05, 0.98),  # below 0.08: 1 of 57, too weak; above 0.95: 4 of 45, at 1 legs lie flat
    "rest_angle_deg": Bounds(15.0, 90.0),  # below 16: none of 150, too weak; above 88: 1 of 46, a design's own end
    "stiffness_nmm_per_deg": Bounds(2.0, 120.0),  # below 4: 1 of 131, too weak; above 110: 3 of 272, no room for them
    "ground_link_angle_deg": Bounds(1.0, 89.0),  # below 4: 2 of 46, above 86: 3 of 60; both are a design's own ends
}
"""The ranges of a search of the printed robot: as wide as anything can be built. Limits end a design, not these: beside
each stands how many of 2,000 random designs, in wider ranges and the default workshop, kept all limits near its ends,
and what rejected most of the others where few did."""


def own_workshop(design: str) -> str:
    """Return the name of the workshop that a design is built in unless another is asked for.

    That of a shipped design is the shipped workshop of its name, if there is one; else `DEFAULT`.
    """
    own = design in template_names("robots") and design in template_names("workshops")
    return design if own else DEFAULT


@check_arguments
def load_design(name_or_path: str | Path) -> Design:
    """Return the design of a template (`kenan-2.0`), which knows its own workshop if it has one, or of a TOML file.

    Raises
    ------
    JumpcadError
        If there is no such file, or a key is missing, unknown or out of range.
    """
    path = find_template("robots", name_or_path)
    if (data := read_toml(path)[0]) and not data.keys() & Design.model_fields.keys():
        raise JumpcadError(
            f"{path}: is no design, for it has none of its keys, {', '.join(Design.model_fields)}: a workshop is given "
            "with --workshop, and a robot of bodies to jumpcad simulate alone"
        )
    return Design.from_toml(path)._built_in(own_workshop(str(name_or_path)))
