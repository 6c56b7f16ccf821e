"""On a system with what Windows has alone: the commands work, and every name in a bundle can be a file's."""

import os
import subprocess
import sys
import urllib.request
from pathlib import Path, PureWindowsPath

import pytest
from support import needs
from support.places import ROOT

from jumpcad.bundle.manifest import open_bundle

LIKE_WINDOWS = ROOT / "tests" / "support" / "windows"
COMMANDS = """
build kenan-2.0
simulate kenan-2.0 --engine mujoco --flight --trajectory jump.csv
simulate kenan-2.0 --landing --tries 2
check kenan-2.0
verify exports/kenan-2.0
report exports/kenan-2.0 --force
new my-robot.toml --from kenan-2.0
compare kenan-2.0 my-robot.toml
variants kenan-2.0 --count 2 -o some
optimize ga --model capsule --evaluations 12 --workers 2 --study s.db
optimize ga --model capsule --evaluations 12 --workers 2 --study s.db
optimize --evaluations 8 --workers 2 --study printed.db
study printed.db
report printed.db
study s.db --export s.csv
""".strip().splitlines()


def environment() -> dict[str, str]:
    """Return the variables of such a process: text is in the code page of Western Europe unless it says otherwise."""
    texts = {"PYTHONWARNDEFAULTENCODING": "1", "PYTHONIOENCODING": "cp1252", "PYTHONUNBUFFERED": "1"}
    return {**os.environ, **texts, "PYTHONPATH": str(LIKE_WINDOWS)}


def hidden_from(module: str, code: str) -> str:
    """Return what code prints there, as if it stood in a module."""
    run = f"import sys; exec(compile({code!r}, 'x', 'exec'), {{'__name__': {module!r}}})"
    return subprocess.run([sys.executable, "-c", run], env=environment(), capture_output=True, text=True).stdout.strip()


def test_what_windows_lacks_is_hidden_from_the_package_alone() -> None:
    code = "import os, signal, sys; print(hasattr(os, 'fork'), hasattr(signal, 'SIGKILL'), sys.platform)"
    assert hidden_from("jumpcad.process", code) == "False False win32"
    assert hidden_from("loky.backend", code) == f"True True {sys.platform}"


@pytest.mark.thorough
def test_all_commands_work_without_what_posix_alone_has(tmp_path: Path) -> None:
    for line in COMMANDS:
        command = [sys.executable, "-m", "jumpcad", *line.split()]
        done = subprocess.run(command, cwd=tmp_path, env=environment(), capture_output=True, encoding="cp1252")
        assert (done.returncode, "Traceback" in done.stderr) == (0, False), (line, done.stdout, done.stderr)
    assert not list(tmp_path.glob("*.lock"))


@pytest.mark.thorough
def test_the_studio_opens_without_what_posix_alone_has(tmp_path: Path) -> None:
    needs.package("viser")
    command = [sys.executable, "-m", "jumpcad", "studio", "--port", "8917"]
    with subprocess.Popen(command, cwd=tmp_path, env=environment(), stdout=subprocess.PIPE, text=True) as studio:
        try:
            assert studio.stdout is not None
            address = studio.stdout.readline().split()[0]
            assert urllib.request.urlopen(address, timeout=60).status == 200
        finally:
            studio.terminate()


def test_every_name_in_a_bundle_can_be_a_file_s_on_windows() -> None:
    paths = [PureWindowsPath(name) for name in open_bundle(ROOT / "exports" / "kenan-2.0").files]
    assert len({str(path).lower() for path in paths}) == len(paths)
    for path in paths:
        assert not path.is_reserved(), path
        assert not path.drive, path
        assert not any(part.endswith((".", " ")) or set(part) & set('<>:"|?*') for part in path.parts), path
        assert len(str(path)) < 120, "a folder of a user has room before it within 260 characters"
