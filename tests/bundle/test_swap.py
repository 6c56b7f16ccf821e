"""Two folders are exchanged, or nothing is done."""

from pathlib import Path

from jumpcad.bundle.swap import exchanged


def test_what_is_not_there_changes_places_with_nothing(tmp_path: Path) -> None:
    (tmp_path / "one").mkdir()
    assert not exchanged(tmp_path / "one", tmp_path / "nothing")
    assert [path.name for path in tmp_path.iterdir()] == ["one"]


def test_two_folders_change_places_or_stay(tmp_path: Path) -> None:
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        (tmp_path / name / name).write_text("")
    inside = ["other", "one"] if exchanged(tmp_path / "one", tmp_path / "other") else ["one", "other"]
    assert [path.name for folder in ("one", "other") for path in (tmp_path / folder).iterdir()] == inside
