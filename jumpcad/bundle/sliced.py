"""Mass and printing time of a bundle's parts and plates by PrusaSlicer, compared with the printed-mass model."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
from manifold3d import Manifold, Mesh64

from jumpcad.building.bom import SlicedPlate, bill_of_facts, write_bom
from jumpcad.bundle.atomic_write import change_files
from jumpcad.bundle.guide.markdown import with_bill
from jumpcad.bundle.manifest import WORKSHOP, Bundle, few, kept_workshop, open_bundle, verify
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.printing.prusaslicer import Sliced, slice_model, slicer_version
from jumpcad.solids.moments import mesh_moments
from jumpcad.solids.outline import Region
from jumpcad.solids.slab import CrossSections
from jumpcad.transforms import Array
from jumpcad.workshop import Material, Workshop

STRAIGHT_MM = 1e-4
"""Corners nearer than this to a straight line are dropped: they come from the triangles of a flat wall."""
SMALLEST_MM2 = 1e-2
"""Cross-sections that differ by less are the same: STL files hold 32-bit floats."""
BOM, ORDER = "bom.csv", "order.md"
PLATE = re.compile(r"print/(plate-\d+-(.+))\.3mf")
LARGEST_MM = 2000.0
"""Largest coordinate that is accepted in a part's file; a changed file may have any."""


@dataclass(frozen=True)
class SlicedPart:
    """A printed part: grams of one copy as sliced and as modelled from the same STL file, seconds to print it alone."""

    name: str
    material: str
    quantity: int
    grams: float
    modelled_grams: float
    time_s: float

    @property
    def difference(self) -> float:
        """Modelled less sliced mass, over the sliced one."""
        return self.modelled_grams / self.grams - 1.0


@dataclass(frozen=True)
class SlicedBundle:
    """A bundle's parts and plates as sliced by PrusaSlicer with the settings of a workshop.

    `billed` is true if the times belong in the bundle's bill of materials: it has one, and its own workshop was used.
    `ignored` maps each setting that the slicer did not accept to the requested and the used value.
    """

    bundle: Bundle
    version: str
    workshop: Workshop
    billed: bool
    parts: tuple[SlicedPart, ...]
    plates: tuple[SlicedPlate, ...]
    ignored: dict[str, tuple[str, str]]

    @property
    def left_out(self) -> tuple[str, ...]:
        """Files of plates that are not sliced: printed pads, of no material of the workshop."""
        plates = (path for path in self.bundle.files if path.startswith("print/") and path.endswith(".3mf"))
        return tuple(path for path in plates if not PLATE.fullmatch(path))

    @property
    def weighed(self) -> Workshop:
        """The workshop with the sliced grams as the weighed masses of its parts, to 1 mg."""
        grams = self.workshop.mass.weighed_g | {part.name: round(part.grams, 3) for part in self.parts}
        mass = self.workshop.mass.model_copy(update={"weighed_g": grams})
        return self.workshop.model_copy(update={"mass": mass})


def slice_bundle(
    folder: str | Path, workshop: Workshop | None = None, tell: Callable[[str], None] = lambda name: None
) -> SlicedBundle:
    """Slice every part and every plate of a bundle, with a workshop's print settings: by default the bundle's own.

    `tell` is called with the name of each part and plate before it is sliced.
    """
    if wrong := verify(folder):
        raise JumpcadError(f"{folder} is not as it was built: {few(wrong)}; build it again with jumpcad build")
    bundle = open_bundle(folder)
    printed = [line for line in bundle.manifest.get("masses", ()) if line["kind"] == "printed"]
    if not printed or WORKSHOP not in bundle.files:
        raise JumpcadError(f"{folder}: has no printed parts to slice")
    version = slicer_version()
    built_in = kept_workshop(bundle)
    workshop = workshop or built_in
    for name in (*(line["material"] for line in printed), *(plate[2] for plate in _plates(bundle))):
        if name not in workshop.materials:
            known = ", ".join(workshop.materials)
            raise JumpcadError(f"the bundle has parts of {name}, but the workshop only {known}: build it with that")
    ignored: dict[str, tuple[str, str]] = {}
    parts, plates = [], []
    for line in printed:
        tell(line["name"])
        stl, material = bundle.file(f"stl/{line['name']}.stl"), workshop.materials[line["material"]]
        sliced = slice_model(stl, workshop.printer, workshop.process, material)
        ignored |= sliced.ignored
        modelled = _modelled_grams(stl, workshop, material)
        parts.append(
            SlicedPart(line["name"], line["material"], line["quantity"], _grams(stl, sliced), modelled, sliced.time_s)
        )
    for path, name, material_name in _plates(bundle):
        tell(name)
        sliced = slice_model(path, workshop.printer, workshop.process, workshop.materials[material_name])
        ignored |= sliced.ignored
        plates.append(SlicedPlate(name, material_name, _grams(path, sliced), sliced.time_s))
    billed = workshop == built_in and {BOM, ORDER} <= set(bundle.files)
    return SlicedBundle(bundle, version, workshop, billed, tuple(parts), tuple(plates), ignored)


def write_times(found: SlicedBundle) -> Bundle:
    """Write the printing times into a bundle's bill of materials and order.md, and return the changed bundle."""
    bundle = found.bundle
    bill = bill_of_facts(bundle.manifest["masses"], found.workshop, bundle.manifest.get("used_up", ()))
    bill = bill.sliced({part.name: part.time_s for part in found.parts}, found.plates)
    try:
        order = bundle.file(ORDER).read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise JumpcadError(f"{bundle.folder}: {ORDER}: not a text file in UTF-8") from None
    changes = {BOM: write_bom(bill), ORDER: with_bill(order, bill)}
    return change_files(bundle, changes, {"PrusaSlicer": found.version})


def _plates(bundle: Bundle) -> Iterator[tuple[Path, str, str]]:
    """Yield file, name and material of each plate."""
    for path in bundle.files:
        if found := PLATE.fullmatch(path):
            yield bundle.file(path), found[1], found[2]


def _grams(model: Path, sliced: Sliced) -> float:
    """Return the sliced mass (g); raise `CannotBuildError` if it is zero."""
    if not sliced.grams > 0.0:
        raise CannotBuildError(f"{model.name}: the slicer found nothing to print: every wall is thinner than a line")
    return sliced.grams


def _modelled_grams(stl: Path, workshop: Workshop, material: Material) -> float:
    """Return the mass of an STL file by the printed-mass model (g)."""
    mass = mass_properties(_StlPart(stl), material.density_g_cm3, workshop.process, workshop.printer.nozzle_mm)
    return 1000.0 * mass.mass_kg


class _StlPart:
    """An STL file with the interface of the mass model's shapes (mm)."""

    def __init__(self, stl: Path) -> None:
        with np.errstate(all="ignore"):  # from coordinates that are rejected below
            mesh = trimesh.load_mesh(stl, process=False)
        if not np.all(np.abs(mesh.vertices) <= LARGEST_MM):  # also false for NaN
            raise JumpcadError(f"{stl}: reaches further than {LARGEST_MM:g} mm, so it is no part; build it again")
        mesh.process()
        corners = np.asarray(mesh.vertices, dtype=float)
        self._solid = Manifold(Mesh64(corners, mesh.faces.astype(np.uint64)))
        if self._solid.is_empty():
            raise JumpcadError(f"{stl}: is no closed solid; build it again")

    @property
    def bounds_mm(self) -> Array:
        """Lower and upper corner of the bounding box, (2, 3)."""
        return np.array(self._solid.bounding_box()).reshape(2, 3)

    @property
    def moments(self) -> Array:
        """Volume moments (10,)."""
        return mesh_moments(self._solid)

    def sections_at(self, heights_mm: Array) -> CrossSections:
        """Return the cross-sections at heights (n,); neighbours that differ by less than `SMALLEST_MM2` are one."""
        regions: list[Region] = []
        which = []
        for height in heights_mm:
            region = self._solid.slice(float(height)).simplify(STRAIGHT_MM)
            if not regions or (region - regions[-1]).area() + (regions[-1] - region).area() >= SMALLEST_MM2:
                regions.append(region)
            which.append(len(regions) - 1)
        return CrossSections(regions, np.array(which), np.zeros(len(which)))
