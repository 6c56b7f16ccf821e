"""Figures as files."""

import pytest
from PIL import Image

from jumpcad.errors import JumpcadError
from jumpcad.files.outputs import require_free
from jumpcad.search.report.figures import panels, save_figure


def test_an_unwritable_folder_is_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(JumpcadError, match="cannot be written"):
        save_figure(panels(1)[0], tmp_path / "file", "x")


def test_a_figure_is_there_as_svg_and_png_and_repeats(tmp_path):
    for folder in ("a", "b"):
        path = save_figure(panels(1)[0], tmp_path / folder, "x")
        assert path.name == "x.svg"
        require_free(path)
        require_free(path.with_suffix(".png"))
    for name in ("x.svg", "x.png"):
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    assert Image.open(tmp_path / "a" / "x.png").width > 400
