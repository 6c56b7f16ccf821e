"""`jumpcad report`: the page of a bundle and of a template, and what it refuses."""

import shutil
from pathlib import Path

import pytest
from support.commands import Run
from support.searches import QUICK

from jumpcad.errors import JumpcadError


@pytest.mark.thorough
def test_the_page_of_a_bundle_takes_its_place_and_is_in_the_manifest(run: Run, bundle: Path, tmp_path: Path) -> None:
    copy = shutil.copytree(bundle, tmp_path / "kenan-2.0")
    code, out, _ = run("report", copy)
    assert (code, out.strip()) == (0, str(copy / "report.html"))
    assert 'id="viewer-glb"' in (copy / "report.html").read_text()  # built without pictures it had none
    assert run("verify", copy)[0] == 0


def test_an_edited_page_of_a_bundle_is_not_replaced(
    run: Run, bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is refused before the robot is built and drawn."""

    def built(*_: object) -> None:
        raise JumpcadError("begun")

    monkeypatch.setattr("jumpcad.cli.report.printed_robot", built)
    copy = shutil.copytree(bundle, tmp_path / "kenan-2.0")
    page = copy / "report.html"
    page.write_text(page.read_text() + "mine" if page.exists() else "mine")
    code, _, err = run("report", copy)
    assert (code, err.count("\n")) == (2, 1)
    assert "report.html" in err
    assert "--force" in err
    assert run("report", copy, "--force")[2] == "jumpcad: begun\n"


@pytest.mark.parametrize(("name", "more"), [("kenan-2.0-report.html", ()), ("own.html", ("-o", "own.html"))])
def test_a_users_page_is_not_replaced(run: Run, tmp_path: Path, name: str, more: tuple[str, ...]) -> None:
    (tmp_path / name).write_text("mine")
    code, _, err = run("report", "kenan-2.0", *more)
    assert code == 2
    assert "--force" in err
    assert (tmp_path / name).read_text() == "mine"


def test_the_page_of_a_study_is_a_file_of_its_own_and_is_renewed(run: Run, tmp_path: Path) -> None:
    assert run("optimize", "ga", *QUICK, "--evaluations", 30, "--study", "s.db")[0] == 0
    code, out, _ = run("report", "s.db")
    assert (code, out) == (0, "s-report.html\n")
    page = (tmp_path / "s-report.html").read_text()
    assert "What was asked" in page
    assert "too_weak" in page or "0 of" in page
    assert run("report", "s.db")[0] == 0  # nobody has changed it
    (tmp_path / "s-report.html").write_text(page + "mine")
    code, _, err = run("report", "s.db")
    assert (code, err.count("\n")) == (2, 1)
    assert "--force" in err
