"""A robot's name is that of its files: it is refused before anything is built."""

import pytest

import jumpcad
from jumpcad.errors import JumpcadError


@pytest.mark.parametrize("name", ["/", "..", "a/b", "a\nb", "\x1b[31m", "a.", "x" * 5000, "\ud800", " frog"])
def test_what_cannot_name_files_is_refused_at_once_in_one_line(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("jumpcad.building.growth.assembled", None)  # not reached
    with pytest.raises(JumpcadError, match="names files") as caught:
        jumpcad.build(jumpcad.load_design("kenan-2.0"), name=name)
    assert str(caught.value).isprintable()
