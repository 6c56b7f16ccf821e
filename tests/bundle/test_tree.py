"""What lies in a folder is listed without following a link, and a path that leads out of it is found."""

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest

from jumpcad.bundle.tree import above, few, is_safe, shown, tree, trouble
from jumpcad.errors import JumpcadError


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a file in a folder, a pipe, and links to a file and a folder outside."""
    inside, outside = tmp_path / "inside", tmp_path / "outside"
    for place in (inside / "a", outside):
        place.mkdir(parents=True)
        (place / "file").write_text("x")
    os.mkfifo(inside / "pipe")
    (inside / "link").symlink_to("../outside/file")
    (inside / "deep").symlink_to("../outside")
    return inside


def test_a_folder_is_listed_before_its_files_and_links_are_not_followed(folder: Path) -> None:
    found = tree(folder)
    assert sorted(found) == ["a", "a/file", "deep", "link", "pipe"]
    assert list(found).index("a") < list(found).index("a/file")
    assert stat.S_ISLNK(found["deep"].st_mode)
    assert stat.S_ISFIFO(found["pipe"].st_mode)


@pytest.mark.parametrize(
    ("path", "reason"),
    [
        ("a/file", ""), ("a", "not a plain file"), ("pipe", "not a plain file"), ("link", "a link"),
        ("deep/file", "behind a link"), ("none", "missing"), ("a/file/none", "missing"),
    ],
)  # fmt: skip
def test_trouble_is_why_a_path_is_no_plain_file_below_the_folder(folder: Path, path: str, reason: str) -> None:
    assert trouble(folder, path) == reason


@pytest.mark.parametrize("path", ["a", "a/b.txt", "pictures/my own.png", "机器人/ä"])
def test_paths_below_a_folder_are_safe(path: str) -> None:
    assert is_safe(path)


@pytest.mark.parametrize("path", ["", "/a", "a//b", "a/", ".", "..", "a/../b", "C:a", "a\\b", "a\nb", "\x1b[2J"])
def test_paths_that_lead_out_on_any_system_or_steer_a_terminal_are_not_safe(path: str) -> None:
    assert not is_safe(path)


def test_the_folders_above_a_path_begin_with_the_outermost() -> None:
    assert above("a/b/c.txt") == ["a", "a/b"]
    assert above("c.txt") == []


def test_of_many_paths_three_are_named_and_the_others_counted() -> None:
    assert few(["a", "b", "c"]) == "a, b, c"
    assert few(["a", "b\n", "c", "d", "e"]) == "a, b\\n, c and 2 more"
    assert shown("Käfer.txt") == "Käfer.txt"


@pytest.mark.parametrize("away", ["a", "a/file", "link"])
def test_what_lies_on_another_disk_is_refused_be_it_folder_file_or_link(
    folder: Path, away: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It could not be moved away with the rest in one step."""

    class Entry:
        def __init__(self, entry: os.DirEntry[str]) -> None:
            self.name, self._entry = entry.name, entry

        def stat(self, *, follow_symlinks: bool) -> os.stat_result:
            assert not follow_symlinks
            found = list(self._entry.stat(follow_symlinks=False))
            if Path(self._entry.path) == folder / away:
                found[2] += 1  # st_dev
            return os.stat_result(found)

    @contextmanager
    def scandir(place: Path) -> Iterator[list[Entry]]:
        with os.scandir(place) as entries:
            yield [Entry(entry) for entry in entries]

    monkeypatch.setattr("jumpcad.bundle.tree.os", SimpleNamespace(scandir=scandir))
    with pytest.raises(JumpcadError, match=f"{away} lies on another disk"):
        tree(folder)
