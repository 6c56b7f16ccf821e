"""Which one-line changes of the package do the nearest tests not see?

    python benchmarks/mutations.py [--seed 1] [--count 30] [--only REGEX] [--files 3] [--whole] [--log FILE]

A mutant is the package with one expression changed: a number × 1.3, ÷ 4 or ± 1, an operator, a function or a truth for
its opposite, a sign or a `not` dropped, one side of a returned sum or product gone. It is made in a copy of the
checkout, and the tests nearest to its module run there: its namesakes, and those that import it most often. With
`--whole` all tests run for those that these do not see, which takes about eight minutes each.
Left out is what says nothing of the machine: words for people, types, and the modules that draw (`DRAWING`).

A survivor is one of three: equivalent (no result changes), a judgement (another number would do as well), or a hole in
the tests. The exit status is 0; it is a report.
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
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGE = "jumpcad"
LIMIT_S, WHOLE_LIMIT_S = 150.0, 1800.0
"""Time of one mutant's tests, the nearest or all: an endless loop ends here."""

DRAWING = re.compile(
    r"bundle/(lead_drawing|page|renders|spring_sheet|step_pictures|viewer)|calibration/plots|cli/progress|notebook|"
    r"scene/(floor|labels|parameters|raster|renderer|shading|step_views|visuals)|scene/assembly_order/|"
    r"search/(page_axes|page_text|plots|side_view|study_\w+)|studio/(player|stage)"
)
"""Modules whose numbers are the look of pictures and pages."""
LOOKS = re.compile(r"colou?r|_px$|font|dpi|style|title|help|digits", re.I)
"""Names whose values are the look of something."""
UNSAID = {"strict", "frozen", "slots", "check", "indent", "stacklevel", "kw_only"}
"""Keyword arguments without a bearing on results."""

SWAPS: dict[type[ast.AST], tuple[str, str]] = {
    ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"), ast.FloorDiv: ("//", "*"),
    ast.Mod: ("%", "*"), ast.Lt: ("<", ">"), ast.LtE: ("<=", ">="), ast.Gt: (">", "<"), ast.GtE: (">=", "<="),
    ast.Eq: ("==", "!="), ast.NotEq: ("!=", "=="), ast.In: ("in", "not in"), ast.Is: ("is", "is not"),
    ast.And: ("and", "or"), ast.Or: ("or", "and"),
}  # fmt: skip
PAIRS = [
    ("min", "max"), ("sin", "cos"), ("any", "all"), ("floor", "ceil"), ("minimum", "maximum"), ("argmin", "argmax"),
    ("radians", "degrees"), ("nanmin", "nanmax"), ("append", "remove"),
]  # fmt: skip
NAMES = dict(PAIRS) | {right: left for left, right in PAIRS}


@dataclass(frozen=True)
class Mutant:
    """Bytes `start` to `end` of a file, and what takes their place."""

    path: str
    start: int
    end: int
    text: str

    def applied(self, source: bytes) -> bytes:
        """Return the file's new content."""
        return source[: self.start] + self.text.encode() + source[self.end :]

    def line(self, source: bytes) -> int:
        """Return the number of the line where it begins."""
        return source[: self.start].count(b"\n") + 1

    def said(self, source: bytes) -> str:
        """Return place, line before and line after."""
        number = self.line(source)
        before, after = (text.decode().splitlines()[number - 1].strip() for text in (source, self.applied(source)))
        return f"{self.path}:{number}  {before}  →  {after}"


class Finder:
    """Finds the mutants of one file."""

    def __init__(self, path: str, source: bytes) -> None:
        self.path, self.source = path, source
        self.starts = [0]
        for line in source.splitlines(keepends=True):
            self.starts.append(self.starts[-1] + len(line))

    def _begin(self, node: ast.AST) -> int:
        return self.starts[node.lineno - 1] + node.col_offset

    def _end(self, node: ast.AST) -> int:
        return self.starts[node.end_lineno - 1] + node.end_col_offset

    def _text(self, node: ast.AST) -> str:
        return self.source[self._begin(node) : self._end(node)].decode()

    def _instead(self, node: ast.AST, text: str) -> Mutant:
        return Mutant(self.path, self._begin(node), self._end(node), text)

    def below(self, node: ast.AST) -> Iterator[Mutant]:
        """Yield the mutants of a node and of those in it, without what says nothing."""
        if isinstance(node, ast.JoinedStr | ast.Raise | ast.Assert | ast.Import | ast.ImportFrom):
            return
        if isinstance(node, ast.FunctionDef) and re.fullmatch(r"__(repr|str)__|_repr_\w+_", node.name):
            return
        if isinstance(node, ast.keyword) and node.arg and (node.arg in UNSAID or LOOKS.search(node.arg)):
            return
        if isinstance(node, ast.Assign) and LOOKS.search(self._text(node.targets[0])):
            return
        yield from self._own(node)
        for name, value in ast.iter_fields(node):
            if name not in ("annotation", "returns", "decorator_list"):
                for one in value if isinstance(value, list) else [value]:
                    if isinstance(one, ast.AST):
                        yield from self.below(one)

    def _own(self, node: ast.AST) -> Iterator[Mutant]:
        """Yield the mutants of a node itself."""
        match node:
            case ast.Constant(value=bool()):
                yield self._instead(node, str(not node.value))
            case ast.Constant(value=int()):
                yield from (
                    self._instead(node, str(node.value + step)) for step in ((1,) if node.value == 0 else (1, -1))
                )
            case ast.Constant(value=float()):
                texts = ("1.0",) if node.value == 0.0 else (f"({node.value!r} * 1.3)", f"({node.value!r} / 4.0)")
                yield from (self._instead(node, text) for text in texts)
            case ast.UnaryOp(op=ast.USub() | ast.Not()):
                yield self._instead(node, self._text(node.operand))
            case ast.BinOp():
                if not (joins(node.left) or joins(node.right)):
                    yield from self._swapped(node.op, node.left, node.right)
            case ast.BoolOp():
                yield from self._swapped(node.op, node.values[0], node.values[1])
            case ast.Compare(ops=[op]):
                yield from self._swapped(op, node.left, node.comparators[0])
            case ast.Name(id=name) | ast.Attribute(attr=name) if name in NAMES:
                yield Mutant(self.path, self._end(node) - len(name), self._end(node), NAMES[name])
            case ast.Return(value=ast.BinOp(left=left, right=right)):
                yield from (self._instead(node.value, self._text(side)) for side in (left, right))

    def _swapped(self, op: ast.AST, left: ast.expr, right: ast.expr) -> Iterator[Mutant]:
        """Yield the mutant with another operator between two expressions."""
        if type(op) in SWAPS:
            old, new = SWAPS[type(op)]
            between = self.source[self._end(left) : self._begin(right)]
            if old.encode() in between:
                start = self._end(left) + between.index(old.encode())
                yield Mutant(self.path, start, start + len(old), new)


def joins(side: ast.expr) -> bool:
    """Return whether one side of an operator is text or a list: another operator would only be an error."""
    return isinstance(side, ast.JoinedStr | ast.List | ast.Tuple) or isinstance(getattr(side, "value", None), str)


def drawn(root: Path, only: str) -> Iterator[Mutant]:
    """Yield every mutant of the modules whose path matches."""
    for path in sorted((root / PACKAGE).rglob("*.py")):
        name = path.relative_to(root).as_posix()
        if re.search(only, name) and not DRAWING.match(name.removeprefix(f"{PACKAGE}/")):
            source = path.read_bytes()
            yield from Finder(name, source).below(ast.parse(source))


def chosen(root: Path, seed: int, count: int, only: str) -> list[Mutant]:
    """Return mutants in random order, no two of a line."""
    mutants = list(drawn(root, only))
    random.Random(seed).shuffle(mutants)
    of_line: dict[tuple[str, int], Mutant] = {}
    for mutant in mutants:
        of_line.setdefault((mutant.path, mutant.line((root / mutant.path).read_bytes())), mutant)
    return list(of_line.values())[:count]


def nearest(root: Path, module: str, files: int) -> list[str]:
    """Return the test files nearest to a module: its namesake, then importers and namesakes, its folder's first."""
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
        for mutant in chosen(copy, arguments.seed, arguments.count, arguments.only):
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
