"""The fit coupon's folder: a bundle like a robot's, with a manifest and the workshop for which it was made."""

from pathlib import Path

from jumpcad.bundle.atomic_write import require_place, write_folder
from jumpcad.bundle.inputs import WORKSHOP
from jumpcad.bundle.manifest import Bundle
from jumpcad.coupon.contents import coupon_files, coupon_masses, coupon_pieces
from jumpcad.workshop import Workshop


def export_coupon(workshop: Workshop, folder: str | Path, force: bool = False) -> Bundle:
    """Write the coupon of a workshop."""
    require_place(folder)
    made = coupon_pieces(workshop)
    files = ((WORKSHOP, workshop.to_toml()), *coupon_files(workshop, made))
    return write_folder(folder, "coupon", coupon_masses(made, workshop), files, force)
