"""Design and workshop files with comments: they read back as what they were made of, and differ where that differs."""

import tomllib
from pathlib import Path

import pytest

from jumpcad.cli.commented import commented_design, commented_workshop
from jumpcad.design import PARAMETERS, PRINTED_BOUNDS, load_design
from jumpcad.workshop import Workshop, load_workshop, varied

DEFAULT = load_workshop("default")


def read_back(text: str, folder: Path) -> Workshop:
    path = folder / "mine.toml"
    path.write_text(text, encoding="utf-8")
    return load_workshop(path)


def own_parts() -> Workshop:
    data = DEFAULT.model_dump(exclude_none=True)
    battery = DEFAULT.catalogue.batteries["lipo-1s-300"].model_dump(exclude_none=True) | {"mass_g": 9.5}
    printer = data["printer"] | {"nozzle_mm": 0.5}
    bought = data["bought"] | {"battery": "my cell", "kit": "", "pins": {"motor": "D3"}}
    return Workshop(**data | {"batteries": {"my cell": battery}, "printer": printer, "bought": bought})


SHOPS = {
    "varied": varied(DEFAULT, {"body.plate_mm": 2.0, "process.infill": 0.3, "bought.kit": "strong-2s"}),
    "own": own_parts(),
}  # fmt: skip


@pytest.mark.parametrize("name", SHOPS)
def test_a_workshop_s_file_is_read_back_as_the_workshop(name: str, tmp_path: Path) -> None:
    text = commented_workshop(SHOPS[name], "here")
    assert text.startswith("# A workshop, copied from here: ")
    assert read_back(text, tmp_path).model_dump() == SHOPS[name].model_dump()
    tomllib.loads(text)


def test_a_design_s_numbers_stand_with_what_they_do_and_their_searched_range() -> None:
    design = load_design("best-bo")
    text = commented_design(design, "best-bo", "frog.toml")
    assert list(tomllib.loads(text).values()) == design.to_vector()
    assert "jumpcad simulate frog.toml" in text
    lines = [line for line in text.splitlines() if " = " in line]
    assert [line.split(" = ")[0] for line in lines] == list(PARAMETERS)
    for line, bounds in zip(lines, PRINTED_BOUNDS.values(), strict=True):
        assert line.endswith(f"# searches go through {bounds.lower:g} to {bounds.upper:g}")
    assert len({line.index("#") for line in lines}) == 1  # one below the other
