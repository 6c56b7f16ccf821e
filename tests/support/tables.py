"""A small TOML file as a record."""

from typing import Annotated

from pydantic import Field

from jumpcad.files import Record, TomlTable


class Bed(TomlTable):
    """A nested section."""

    width_mm: Annotated[float, Field(gt=0, le=400)]


class Printer(Record):
    """A small file."""

    name: str
    nozzle_mm: Annotated[float, Field(ge=0.1, lt=2)] = 0.4
    bed: Bed
