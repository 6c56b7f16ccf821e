"""The command line as a function."""

from pathlib import Path

import pytest
from support.commands import Run, exit_code_of


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    """Run `jumpcad ARGUMENTS` in an empty folder; return exit code, standard output and standard error."""
    monkeypatch.chdir(tmp_path)

    def call(*arguments: str) -> tuple[int, str, str]:
        code = exit_code_of(*arguments)
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return call
