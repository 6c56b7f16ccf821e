"""Which one-line changes of the package do the tests not see?

    python benchmarks/mutations.py [--seed 1] [--count 30] [--only REGEX] [--whole]

A mutant is a copy of the checkout in which one expression is changed: a number × 1.3, an operator or a function for its
opposite, a sign or a `not` dropped. The quick tests of its module's folder and those that import the module run there;
with `--whole` all quick tests run for those that these do not see. A survivor is one of three: equivalent (no
result changes), a judgement (another number would do as well), or a hole in the tests.
"""

import argparse
import ast
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
LIMIT_S, WHOLE_LIMIT_S = 150.0, 900.0
"""Time of one mutant's tests, the nearest or all: an endless loop ends here."""
OPPOSITES = {
    ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"), ast.Lt: ("<", ">"),
    ast.LtE: ("<=", ">="), ast.Gt: (">", "<"), ast.GtE: (">=", "<="), ast.Eq: ("==", "!="), ast.NotEq: ("!=", "=="),
    ast.And: ("and", "or"), ast.Or: ("or", "and"),
}  # fmt: skip
PAIRS = [("min", "max"), ("sin", "cos"), ("any", "all"), ("floor", "ceil"), ("minimum", "maximum")]
NAMES = dict(PAIRS) | {right: left for left, right in PAIRS}


@dataclass(frozen=True)
class Mutant:
    """Bytes `start` to `end` of a file, and what takes their place."""

    path: str
    line: int
    start: int
    end: int
    text: str

    def applied(self, source: bytes) -> bytes:
        """Return the file's new content."""
        return source[: self.start] + self.text.encode() + source[self.end :]


def mutants(path: str, source: bytes) -> Iterator[Mutant]:
    """Yield the mutants of a file, without those in messages."""
    starts = [0]
    for line in source.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))

    def span(node: ast.expr) -> tuple[int, int]:
        return starts[node.lineno - 1] + node.col_offset, starts[node.end_lineno - 1] + node.end_col_offset

    def swapped(node: ast.expr, op: ast.AST, left: ast.expr, right: ast.expr) -> Iterator[Mutant]:
        old, new = OPPOSITES.get(type(op), ("", ""))
        begin, end = span(left)[1], span(right)[0]
        if old and old.encode() in source[begin:end]:
            start = begin + source[begin:end].index(old.encode())
            yield Mutant(path, node.lineno, start, start + len(old), new)

    def below(node: ast.AST) -> Iterator[Mutant]:
        if isinstance(node, ast.JoinedStr | ast.Raise | ast.Assert):
            return
        match node:
            case ast.Constant(value=float(value)):
                yield Mutant(path, node.lineno, *span(node), f"({value!r} * 1.3)" if value else "1.0")
            case ast.UnaryOp(op=ast.USub() | ast.Not(), operand=operand):
                start, end = span(operand)
                yield Mutant(path, node.lineno, *span(node), source[start:end].decode())
            case ast.BinOp(op=op, left=left, right=right) | ast.Compare(ops=[op], left=left, comparators=[right]):
                yield from swapped(node, op, left, right)
            case ast.BoolOp(op=op, values=[left, right, *_]):
                yield from swapped(node, op, left, right)
            case ast.Name(id=name) | ast.Attribute(attr=name) if name in NAMES:
                end = span(node)[1]
                yield Mutant(path, node.end_lineno, end - len(name), end, NAMES[name])
        for field, value in ast.iter_fields(node):
            if field not in ("annotation", "returns", "decorator_list"):
                for one in value if isinstance(value, list) else [value]:
                    if isinstance(one, ast.AST):
                        yield from below(one)

    yield from below(ast.parse(source))


def nearest(root: Path, module: str) -> list[str]:
    """Return the tests of a module's folder, and the files that import the module."""
    inner = Path(module).relative_to("jumpcad")
    dotted = ".".join(Path(module).with_suffix("").parts)
    importers = [path for path in (root / "tests").rglob("test_*.py") if dotted in path.read_text(encoding="utf-8")]
    folder = root / "tests" / inner.parent
    beside = [folder] if len(inner.parts) > 1 and folder.is_dir() else []
    return sorted({path.relative_to(root).as_posix() for path in (*beside, *importers)}) or ["tests"]


def outcome(root: Path, tests: list[str], limit_s: float) -> str:
    """Run tests in a copy; return `survived`, or what failed."""
    environment = os.environ | {"PYTHONPATH": str(root), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-p", "no:cacheprovider", *tests]
    with subprocess.Popen(
        command, cwd=root, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True
    ) as process:
        try:
            said, _ = process.communicate(timeout=limit_s)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            return "timeout"
    failed = re.search(r"^(?:FAILED|ERROR) (.*?)(?: - .*)?$", said.decode(errors="replace"), re.M)
    if process.returncode == 0:
        return "survived"
    return f"killed by {failed[1] if failed else f'pytest itself, exit status {process.returncode}'}"


def main() -> None:
    """Make the mutants one after the other, and say of each what became of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--only", default="", metavar="REGEX", help="modules whose path matches")
    parser.add_argument("--whole", action="store_true", help="run all quick tests for what the nearest do not see")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "copy"
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".git", ".venv", ".*_cache", "__pycache__", "build"))
        paths = [path.relative_to(copy).as_posix() for path in sorted((copy / "jumpcad").rglob("*.py"))]
        found = [
            one for path in paths if re.search(options.only, path) for one in mutants(path, (copy / path).read_bytes())
        ]
        random.Random(options.seed).shuffle(found)
        for mutant in found[: options.count]:
            path = copy / mutant.path
            source = path.read_bytes()
            path.write_bytes(mutant.applied(source))
            result = outcome(copy, nearest(copy, mutant.path), LIMIT_S)
            if options.whole and result == "survived":
                result = outcome(copy, ["tests"], WHOLE_LIMIT_S)
            before, after = (
                text.decode().splitlines()[mutant.line - 1].strip() for text in (source, path.read_bytes())
            )
            path.write_bytes(source)
            print(f"{mutant.path}:{mutant.line}  {before}  →  {after}  {result}", flush=True)


if __name__ == "__main__":
    main()
