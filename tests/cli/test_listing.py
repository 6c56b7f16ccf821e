"""`jumpcad list`: every name that it gives is taken where it says."""

import json

import pytest
from support.commands import Run


def names(run: Run, kind: str) -> list[str]:
    code, out, err = run("list", kind, "--json")
    assert (code, err) == (0, "")
    rows = json.loads(out)[kind]
    assert all(row["description"] for row in rows)
    return [row["name"] for row in rows]


@pytest.mark.parametrize("kind", ["printers", "materials", "workshops"])
def test_listed_names_are_taken(run: Run, kind: str, tmp_path) -> None:
    for name in names(run, kind):
        option = f"--{kind.removesuffix('s')}"
        code, _, err = run("new", tmp_path / "w.toml", option, name, "--force")
        if name == "PA12":
            assert "strength_in_plane_mpa" in err
        else:
            assert (code, err) == (0, "")


def test_a_template_is_described_in_one_line_of_a_terminal(run: Run) -> None:
    assert len(run("list", "templates")[1].splitlines()) == 1 + len(names(run, "templates"))


def test_an_unknown_kind_is_refused_with_a_hint(run: Run) -> None:
    code, out, err = run("list", "printer")
    assert (code, out) == (2, "")
    assert "did you mean printers?" in err
