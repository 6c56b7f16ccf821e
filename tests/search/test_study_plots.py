"""The pictures of a study."""

from xml.etree import ElementTree

import pytest
from support.bumps import REST, studied

from jumpcad.search.figures import PICTURES
from jumpcad.search.space import Space
from jumpcad.search.study_plots import plot_study


@pytest.mark.parametrize(
    ("fixed", "method", "names"),
    [
        ([*REST, "rest_angle_deg=50"], "bo", {"history", "slices", "acquisition-first", "acquisition"}),
        (REST, "nsga2", {"history", "slices", "parallel", "pareto"}),
    ],
)
def test_a_study_has_its_pictures_and_they_repeat(tmp_path, fixed, method, names):
    with studied(tmp_path / "s.db", Space.parse(fix=fixed), method) as store:
        first = plot_study(store, tmp_path / "a")
        again = plot_study(store, tmp_path / "b")
    assert {path.stem for path in first} == names <= set(PICTURES)
    assert all(ElementTree.parse(one).getroot().tag.endswith("svg") for one in first)
    assert [one.read_bytes() for one in again] == [one.read_bytes() for one in first]
