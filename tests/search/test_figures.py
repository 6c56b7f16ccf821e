"""Figures as files."""

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.search.figures import panels, save_figure


def test_an_unwritable_folder_is_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(JumpcadError, match="cannot be written"):
        save_figure(panels(1)[0], tmp_path / "file", "x")
