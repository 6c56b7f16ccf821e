"""What a name or a path on the command line stands for."""

from pathlib import Path

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.files import find_template, template_names, templates_folder


def test_templates_are_found_by_name_and_files_by_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert {"best-bo", "best-ga", "kenan-1.0", "kenan-2.0"} <= set(template_names("robots"))
    assert find_template("robots", "kenan-2.0") == templates_folder() / "robots/kenan-2.0.toml"
    assert find_template("robots", tmp_path / "mine.toml") == tmp_path / "mine.toml"
    assert find_template("robots", "not-there/mine") == Path("not-there/mine")  # whoever reads it says what lacks
    monkeypatch.chdir(tmp_path)
    (tmp_path / "kenan").mkdir()
    for wrong in ("kenan-3.0", "x" * 300, "kenan"):  # a folder is no design
        with pytest.raises(JumpcadError, match="neither a TOML file nor one of the robots best-bo"):
            find_template("robots", wrong)


@pytest.mark.parametrize("installed", [True, False])
def test_templates_lie_in_an_installed_package_or_beside_it_in_a_source_tree(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, installed: bool
) -> None:
    """Also where both are there: a wheel brings its own."""
    package, beside = tmp_path / "jumpcad", tmp_path / "templates"
    for folder in (beside, package / "templates" if installed else package):
        folder.mkdir(parents=True)
    monkeypatch.setattr("importlib.resources.files", lambda name: tmp_path / name)
    assert templates_folder.__wrapped__() == (package / "templates" if installed else beside)


def test_a_bare_name_is_the_template_whatever_lies_in_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("kenan-2.0", "mine"):
        (tmp_path / name).write_text("")
    assert find_template("robots", "kenan-2.0") == templates_folder() / "robots/kenan-2.0.toml"
    assert find_template("robots", "./kenan-2.0") == Path("kenan-2.0")
    assert find_template("robots", "mine") == Path("mine")


def test_a_name_that_is_nearly_a_templates_is_told_which() -> None:
    with pytest.raises(JumpcadError, match=r"^'kenan-20' is neither .*, kenan-2\.0 \(did you mean kenan-2\.0\?\)$"):
        find_template("robots", "kenan-20")
