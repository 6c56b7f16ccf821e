"""Design and workshop of a bundle are read from its own files alone."""

from pathlib import Path

import pytest

from jumpcad.bundle.atomic_write import write_folder
from jumpcad.bundle.inputs import kept_design, kept_workshop
from jumpcad.bundle.manifest import open_bundle
from jumpcad.errors import JumpcadError
from jumpcad.workshop import load_workshop


def test_the_inputs_of_a_bundle_lie_in_it(tmp_path: Path) -> None:
    whole = load_workshop("default").to_toml()
    folder = write_folder(tmp_path / "b", "frog", {}, [("workshop.toml", whole), ("design.toml", "")]).folder
    assert kept_workshop(open_bundle(folder)) == load_workshop("default")
    (tmp_path / "secret.toml").write_text("x = 1")
    for line in (f'base = "{tmp_path}/secret.toml"', 'base = "../secret.toml"', 'printer = "../secret.toml"'):
        (folder / "workshop.toml").write_text(line)
        with pytest.raises(JumpcadError, match="a bundle's workshop is complete and names no other file"):
            kept_workshop(open_bundle(folder))
    (folder / "design.toml").unlink()
    (folder / "design.toml").symlink_to("../secret.toml")
    with pytest.raises(JumpcadError, match=r"design\.toml: a link"):
        kept_design(open_bundle(folder))
