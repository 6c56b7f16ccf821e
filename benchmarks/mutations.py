"""Which one-line changes of the package do the nearest tests not see?

    python benchmarks/mutations.py [--seed 1] [--count 30] [--only REGEX] [--mixed] [--files 3] [--whole] [--log FILE]

A mutant is the package with one expression changed: a number × 1.3, ÷ 4 or ± 1, an operator, a function or a truth for
its opposite, a sign or a `not` dropped, one side of a returned sum or product gone; or, with `--mixed`, two arguments
exchanged, one left to its default, or a field taken for another of its class and unit. It is made in a copy of the
checkout, and the tests nearest to its module run there: its namesakes, and those that import it most often. With
`--whole` all tests run for those that these do not see, which takes about eight minutes each.
Left out is what says nothing of the machine: words for people, types, and the modules that draw (`DRAWING`).

A survivor is one of three: equivalent (no result changes), a judgement (another number would do as well), or a hole in
the tests. The exit status is 0; it is a report.
"""

import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from mutants import PACKAGE, Mutant, drawn

ROOT = Path(__file__).parents[1]
LIMIT_S, WHOLE_LIMIT_S = 150.0, 1800.0
"""Time of one mutant's tests, the nearest or all: an endless loop ends here."""


def chosen(root: Path, seed: int, count: int, only: str, mixed: bool) -> list[Mutant]:
    """Return mutants in random order, no two of a line."""
    mutants = list(drawn(root, only, mixed))
    random.Random(seed).shuffle(mutants)
    of_line: dict[tuple[str, int], Mutant] = {}
    for mutant in mutants:
        of_line.setdefault((mutant.path, mutant.line((root / mutant.path).read_bytes())), mutant)
    return list(of_line.values())[:count]


def nearest(root: Path, module: str, files: int) -> list[str]:
    """Return the test files nearest to a module: its namesake, then importers and namesakes, its folder's first.

    Of a module that no test imports, those of its package.
    """
    inner = Path(module).relative_to(PACKAGE)
    stem, folder = inner.parent.name if inner.stem == "__init__" else inner.stem, Path("tests") / inner.parent
    dotted = ".".join(inner.with_suffix("").parts).removesuffix(".__init__")
    package, _, name = f"{PACKAGE}.{dotted}".rpartition(".")
    named = re.compile(rf"\b{re.escape(package)}\.{name}\b|\bfrom {re.escape(package)} import [^\n]*\b{name}\b")
    ranks = {}
    for path in sorted((root / "tests").rglob("test_*.py")):
        file = path.relative_to(root)
        imports = len(named.findall(path.read_text(encoding="utf-8")))
        namesake, beside = file.name == f"test_{stem}.py", file.parent == folder
        if imports or namesake:
            ranks[file.as_posix()] = (not (namesake and beside), not beside, -imports)
    if not ranks and inner.stem != "__init__":
        return nearest(root, Path(module).with_name("__init__.py").as_posix(), files)
    return sorted(ranks, key=lambda file: ranks[file])[:files] or [folder.as_posix()]


def outcome(root: Path, tests: list[str], limit_s: float = LIMIT_S) -> str:
    """Run tests in a copy; return `survived`, `timeout`, or `killed` and the first test that failed."""
    environment = os.environ | {"PYTHONPATH": str(root), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-p", "no:cacheprovider", *tests]
    with subprocess.Popen(
        command, cwd=root, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True
    ) as process:
        try:
            said, _ = process.communicate(timeout=limit_s)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return "timeout"
    failed = re.findall(r"^(?:FAILED|ERROR) (.*?)(?: - .*)?$", said.decode(errors="replace"), re.M)
    if process.returncode == 0 and not failed:
        return "survived"
    return "killed by " + (failed[0] if failed else f"pytest itself, exit status {process.returncode}")


def main() -> None:
    """Make the mutants one after the other, and say of each what became of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    option = parser.add_argument
    option("--seed", type=int, default=1)
    option("--count", type=int, default=30)
    option("--only", default="", metavar="REGEX", help="modules whose path matches")
    option("--mixed", action="store_true", help="mix up arguments, defaults and fields instead")
    option("--files", type=int, default=3, help="test files that run for a module at most")
    option("--whole", action="store_true", help="run all tests for what the nearest do not see")
    option("--log", type=Path, help="write the lines to this file too")
    arguments = parser.parse_args()

    def say(line: str) -> None:
        print(line, flush=True)
        if arguments.log:
            with arguments.log.open("a", encoding="utf-8") as log:
                log.write(line + "\n")

    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "copy"
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".git", ".*_cache", "__pycache__", "build"))
        counts = {"killed": 0, "elsewhere": 0, "timeout": 0, "survived": 0}
        for mutant in chosen(copy, arguments.seed, arguments.count, arguments.only, arguments.mixed):
            path, began = copy / mutant.path, time.monotonic()
            source = path.read_bytes()
            path.write_bytes(mutant.applied(source))
            result = outcome(copy, nearest(copy, mutant.path, arguments.files))
            if arguments.whole and result == "survived":
                result = outcome(copy, ["tests"], WHOLE_LIMIT_S).replace("killed by", "elsewhere killed by")
            path.write_bytes(source)
            counts[result.split()[0]] += 1
            say(f"{mutant.said(source)}  {result}  ({time.monotonic() - began:.0f} s)")
        say(", ".join(f"{count} {what}" for what, count in counts.items() if count))


if __name__ == "__main__":
    main()
