"""`jumpcad report`: the page of a bundle and of a template, and what it refuses."""

import shutil
from pathlib import Path

import pytest
from support.commands import Run


def test_the_page_of_a_bundle_takes_its_place_and_is_in_the_manifest(run: Run, bundle: Path, tmp_path: Path) -> None:
    copy = shutil.copytree(bundle, tmp_path / "kenan-2.0")
    code, out, _ = run("report", copy)
    assert (code, out.strip()) == (0, str(copy / "report.html"))
    assert 'id="viewer-glb"' in (copy / "report.html").read_text()  # built without pictures it had none
    assert run("verify", copy)[0] == 0


def test_the_page_of_a_template_is_a_file_of_its_own(run: Run, tmp_path: Path) -> None:
    code, out, _ = run("report", "kenan-2.0")
    assert (code, out) == (0, "kenan-2.0-report.html\n")
    page = (tmp_path / "kenan-2.0-report.html").read_text()
    assert "It jumps" in page
    assert "href=" not in page  # there is nothing beside it to link to


@pytest.mark.parametrize(("target", "said"), [("page.txt", ".html"), ("no/page.html", "no")])
def test_a_page_in_a_wrong_place_is_refused_before_the_work(run: Run, tmp_path: Path, target: str, said: str) -> None:
    code, out, err = run("report", "kenan-2.0", "-o", target)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert said in err
    assert not list(tmp_path.iterdir())


def test_a_users_page_is_not_replaced(run: Run, tmp_path: Path) -> None:
    (tmp_path / "kenan-2.0-report.html").write_text("mine")
    code, _, err = run("report", "kenan-2.0")
    assert code == 2
    assert "--force" in err
    assert (tmp_path / "kenan-2.0-report.html").read_text() == "mine"
