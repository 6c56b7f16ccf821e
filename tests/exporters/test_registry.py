"""A bundle has the files of every exporter in the registry, optional ones where they are asked for."""

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.exporters import registry
from jumpcad.exporters.registry import Exporter, chosen


def test_a_bundle_has_no_step_files_and_no_ros_package_unless_they_are_asked_for() -> None:
    usual = [exporter.name for exporter in chosen()]
    assert usual == ["stl", "3mf", "urdf", "mjcf", "sdf", "glb", "dxf"]
    assert {exporter.name for exporter in chosen(["ros2"])} == {*usual, "ros2"}


def test_an_optional_exporter_is_asked_for_and_says_what_it_lacks(monkeypatch: pytest.MonkeyPatch) -> None:
    def lacking() -> None:
        raise JumpcadError("needs a library")

    monkeypatch.setattr(
        registry, "EXPORTERS", (Exporter("a", list), Exporter("b", list, optional=True, require=lacking))
    )
    assert [exporter.name for exporter in chosen()] == ["a"]
    with pytest.raises(JumpcadError, match="needs a library"):
        chosen(["b"])
