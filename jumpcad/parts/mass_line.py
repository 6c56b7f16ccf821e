"""What a bundle says of the mass of a part."""

from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field, StrictFloat, StrictInt

from jumpcad.files.records import Text


@dataclass(frozen=True)
class MassLine:
    """Mass of one piece, how many of it the robot has, and where the mass comes from.

    `kind` is `printed`, `pad` (printed of a soft material) or `bought`.
    """

    kind: Literal["printed", "pad", "bought"]
    name: Text
    quantity: Annotated[StrictInt, Field(ge=1)]
    material: Text
    mass_kg: Annotated[StrictFloat, Field(ge=0.0)]
    source: Text
