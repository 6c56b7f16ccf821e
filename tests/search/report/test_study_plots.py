"""The pictures of a study."""

from dataclasses import replace
from xml.etree import ElementTree

import pytest
from support.bumps import REST, studied
from support.studies import trials

from jumpcad.search.report.figures import PICTURES
from jumpcad.search.report.study_plots import _moments, plot_study
from jumpcad.search.space import Space

pytestmark = pytest.mark.usefixtures("quick_proposals")


def pictures(store, folder, names):
    """Return the pictures of a study by their files' names; those that it must have are there."""
    drawn = plot_study(store, folder)
    assert {path.stem for path in drawn} == names <= set(PICTURES)
    assert all(ElementTree.parse(one).getroot().tag.endswith("svg") for one in drawn)
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.thorough
def test_a_study_has_its_pictures(tmp_path):
    """Of the method that has all kinds."""
    names = {"history", "slices", "parallel", "pareto", "acquisition-first", "acquisition"}
    with studied(tmp_path / "s.db", Space.parse(fix=REST), "pareto") as store:
        pictures(store, tmp_path / "a", names)


@pytest.mark.thorough
def test_one_free_parameter_has_no_parallel_lines_and_no_front_without_one_and_they_repeat(tmp_path):
    with studied(tmp_path / "s.db", Space.parse(fix=[*REST, "rest_angle_deg=50"])) as store:
        names = {"history", "slices", "acquisition-first", "acquisition"}
        assert pictures(store, tmp_path / "a", names) == pictures(store, tmp_path / "b", names)


def test_the_first_picture_has_what_was_known_before_it_and_the_last_one_every_design():
    """Of five designs the third and the fourth were proposed; what others look at is none of it."""
    proposed = [{}, {}, {"theta": {}}, {"theta": {}}, {}]
    found = [replace(one, phase="bo", proposal=note) for one, note in zip(trials(5), proposed, strict=True)]
    assert _moments(found) == [("acquisition-first", 2, 2), ("acquisition", 3, 5)]
    assert _moments(found[:2]) == _moments([replace(one, phase="robust") for one in found]) == []
