"""Figures as files."""

import pytest
from PIL import Image

from jumpcad.errors import JumpcadError
from jumpcad.files.outputs import require_free
from jumpcad.search.report.figures import labels, panels, save_figure


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


@pytest.mark.parametrize(
    ("count", "rows", "columns"), [(1, 1, 1), (3, 1, 3), (4, 1, 4), (5, 2, 4), (8, 2, 4), (9, 3, 4)]
)
def test_panels_fill_rows_of_four_and_none_is_empty(count: int, rows: int, columns: int) -> None:
    """Each 3 by 2 inches here."""
    figure, axes = panels(count, 3.0, 2.0)
    assert len(axes) == count
    assert figure.get_size_inches().tolist() == [3.0 * columns, 2.0 * rows]
    places = {(one.get_subplotspec().rowspan.start, one.get_subplotspec().colspan.start) for one in axes}
    assert places == {divmod(index, columns) for index in range(count)}


def test_axes_and_panels_are_named_each_by_its_own_words() -> None:
    _, (named, plain) = panels(2)
    labels(named, "rest angle (°)", "range (m)", "one")
    labels(plain, "mass (g)", "rise (m)")
    assert [(one.get_xlabel(), one.get_ylabel(), one.get_title()) for one in (named, plain)] == [
        ("rest angle (°)", "range (m)", "one"), ("mass (g)", "rise (m)", ""),
    ]  # fmt: skip
