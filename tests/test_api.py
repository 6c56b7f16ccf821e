"""Public functions that take a robot take a design too."""

import pytest

import jumpcad


@pytest.mark.parametrize("name", ["simulate", "check"])
def test_a_design_is_built_where_a_robot_is_taken(name):
    design = jumpcad.load_design("kenan-2.0")
    function = getattr(jumpcad, name)
    assert repr(function(design)) == repr(function(jumpcad.build(design)))
