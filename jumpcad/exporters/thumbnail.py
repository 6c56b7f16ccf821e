"""The thumbnail of a print plate for file managers and slicers: its parts on the bed."""

import io
from collections.abc import Sequence

import numpy as np
import trimesh

from jumpcad.printing.plates import PrintPlate
from jumpcad.scene.camera import View
from jumpcad.scene.renderer import Renderer
from jumpcad.scene.visuals import PRINTED_COLOURS, Colour
from jumpcad.transforms import in_metres

SIZE = (256, 256)
VIEW = View(yaw_deg=-70.0, pitch_deg=48.0)
BED_MM = 1.0
BED: Colour = (0.80, 0.81, 0.83)


def thumbnail(plate: PrintPlate, bed_mm: Sequence[float]) -> bytes:
    """Return the PNG file of a plate on a bed (mm); the same plate gives the same bytes."""
    width, depth = bed_mm[:2]
    bed = trimesh.creation.box((width, depth, BED_MM))
    bed.apply_translation((width / 2.0, depth / 2.0, -BED_MM / 2.0))
    things = [(bed, BED), *((placed.part.look, PRINTED_COLOURS["links"]) for placed in plate.items)]
    poses = [np.eye(4), *(in_metres(placed.T_bed_part) for placed in plate.items)]
    stream = io.BytesIO()
    Renderer(things).picture(poses, SIZE, VIEW, bed.vertices / 1000.0).save(stream, "PNG")
    return stream.getvalue()
