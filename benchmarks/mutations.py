"""Which one-line changes of the package do the quick tests not see?

    python benchmarks/mutations.py [--seed 7] [--count 30] [--only REGEX]

In a copy of the checkout one expression is changed: a decimal number × 1.1 or × 0.9, an operator of arithmetic or a
comparison for its opposite, or a sign is dropped. The tests of the module's package run there, and all quick tests if
these see nothing. A survivor is one of three: equivalent (no result changes), a judgement (another number would do as
well), or a hole in the tests.
"""

import argparse
import ast
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
LIMIT = "20m"
"""Time of one run of tests: an endless loop ends here, with exit status 124."""
OPPOSITES = {
    ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"), ast.Lt: ("<", ">="),
    ast.LtE: ("<=", ">"), ast.Gt: (">", "<="), ast.GtE: (">=", "<"), ast.Eq: ("==", "!="), ast.NotEq: ("!=", "=="),
}  # fmt: skip
SKIPPED = ast.JoinedStr, ast.Raise, ast.Assert
"""What makes messages."""


def mutants(source: bytes) -> Iterator[tuple[int, bytes]]:
    """Yield the line number of each mutant of a file, and its source."""
    starts = [0]
    for line in source.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))

    def span(node: ast.expr) -> tuple[int, int]:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return starts[node.lineno - 1] + node.col_offset, starts[node.end_lineno - 1] + node.end_col_offset

    def replaced(start: int, end: int, text: str) -> tuple[int, bytes]:
        return source[:start].count(b"\n") + 1, source[:start] + text.encode() + source[end:]

    def below(node: ast.AST) -> Iterator[tuple[int, bytes]]:
        match node:
            case ast.Constant(value=float(value)):
                if value:
                    yield replaced(*span(node), f"({(0.9, 1.1)[node.lineno % 2]} * {value!r})")
            case ast.UnaryOp(op=ast.USub()):
                yield replaced(span(node)[0], span(node)[0] + 1, "")
            case ast.BinOp(op=op, left=left) | ast.Compare(ops=[op], left=left):
                old, new = OPPOSITES.get(type(op), ("", ""))
                start = source.index(old.encode(), span(left)[1])
                if old:
                    yield replaced(start, start + len(old), new)
        for name, value in ast.iter_fields(node):
            for one in value if isinstance(value, list) else [value]:
                if isinstance(one, ast.AST) and not isinstance(one, SKIPPED) and name not in ("annotation", "returns"):
                    yield from below(one)

    yield from below(ast.parse(source))


def killer(root: Path, *tests: str) -> str | None:
    """Run tests in a copy; return the one that fails."""
    command = ["timeout", LIMIT, sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests]
    environment = os.environ | {"PYTHONPATH": str(root)}
    run = subprocess.run(command, cwd=root, env=environment, capture_output=True, text=True, check=False)
    failed = re.search(r"^(?:FAILED|ERROR) (.*?)(?: - .*)?$", run.stdout, re.M)
    return None if run.returncode == 0 else failed[1] if failed else f"exit status {run.returncode}"


def main() -> None:
    """Make the mutants one after the other, and say of each what became of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--only", default="", metavar="REGEX", help="modules whose path matches")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder) / "copy"
        shutil.copytree(ROOT, root, ignore=shutil.ignore_patterns(".git", ".venv", ".*_cache", "__pycache__", "build"))
        paths = [path for path in sorted((root / "jumpcad").rglob("*.py")) if re.search(options.only, str(path))]
        found = [(path, *one) for path in paths for one in mutants(path.read_bytes())]
        random.Random(options.seed).shuffle(found)
        for path, number, changed in found[: options.count]:
            source, tests = path.read_bytes(), root / "tests" / path.relative_to(root / "jumpcad").parts[0]
            path.write_bytes(changed)
            seen = (killer(root, "-n", "0", str(tests)) if tests.is_dir() else None) or killer(root, "-n", "2")
            path.write_bytes(source)
            before, after = (text.decode().splitlines()[number - 1].strip() for text in (source, changed))
            result = f"killed by {seen}" if seen else "survived"
            print(f"{path.relative_to(root)}:{number}  {before}  →  {after}  {result}", flush=True)


if __name__ == "__main__":
    main()
