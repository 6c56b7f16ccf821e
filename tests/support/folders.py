"""A folder of two files, and what a user added to it."""

import os
from pathlib import Path

from jumpcad.bundle.atomic_write import write_folder


def old(target: Path) -> None:
    """Write a bundle of two files."""
    write_folder(target, "robot", {}, {"a.md": "old", "deep/b.md": "old"}.items())


def add_mine(target: Path) -> None:
    """Add what only a user can have: a file, one between ours, an empty folder, a link to nowhere."""
    (target / "notes.txt").write_text("mine")
    (target / "deep" / "mine.txt").write_text("mine")
    (target / "empty").mkdir()
    (target / "link").symlink_to("nowhere")


def has_mine(target: Path) -> bool:
    """Tell whether what `add_mine` added is there unchanged."""
    kept = [(target / name).read_text() for name in ("notes.txt", "deep/mine.txt")]
    return kept == ["mine", "mine"] and (target / "empty").is_dir() and os.readlink(target / "link") == "nowhere"


def listed(folder: Path) -> list[str]:
    """Return the paths of all that is in a folder, sorted."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))
