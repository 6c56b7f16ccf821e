"""Every notebook of the examples runs from its first cell to its last, and is kept without results (about 10 s)."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support import needs
from support.pictures import with_plain_figures
from support.places import ROOT
from support.proposals import with_less_work

NOTEBOOKS = sorted((ROOT / "examples").glob("*.ipynb"))


def test_there_are_two() -> None:
    assert [path.stem for path in NOTEBOOKS] == ["first_robot", "search"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_is_kept_without_results(path: Path) -> None:
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    assert all(not cell["outputs"] for cell in cells if cell["cell_type"] == "code")


@pytest.fixture
def shell(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The shell that a notebook's kernel has, in this process, where imports are paid for; nothing of it stays.

    Proposals and plots are made with less work.
    """
    with_less_work(monkeypatch)
    with_plain_figures(monkeypatch)
    module = needs.package("IPython.core.interactiveshell")
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))
    monkeypatch.setattr(sys, "excepthook", sys.excepthook)
    monkeypatch.setattr(sys, "displayhook", sys.displayhook)
    monkeypatch.setitem(sys.modules, "__main__", sys.modules["__main__"])
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.chdir(tmp_path)
    shell = module.InteractiveShell.instance()
    shell.history_manager.enabled = False
    yield shell
    shell.atexit_operations()
    module.InteractiveShell.clear_instance()


@pytest.mark.filterwarnings("error::UserWarning")  # a notebook would show it
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_runs(path: Path, shell: Any, capsys: pytest.CaptureFixture[str]) -> None:
    shown: set[str] = set()
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            done = shell.run_cell("".join(cell["source"]))
            done.raise_error()
            data, _ = shell.display_formatter.format(done.result)
            shown |= set(data)
    assert {"first_robot": "text/html", "search": "image/svg+xml"}[path.stem] in shown
    assert capsys.readouterr().err == ""
