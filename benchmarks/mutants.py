"""One-line changes of the package, as `mutations.py` tries them: those of one expression, and mix-ups.

A mix-up takes what a reader may take for what is meant: two arguments for each other, a default in place of what was
passed, another field of the same class and unit. Where both have the same value in all tests, none sees it.
"""

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

PACKAGE = "jumpcad"

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


class Mixer(Finder):
    """Finds the mix-ups of one file.

    Parameters
    ----------
    alike
        For each field of a class its like; see `fields_alike`.
    """

    def __init__(self, path: str, source: bytes, alike: dict[str, set[str]]) -> None:
        super().__init__(path, source)
        self.alike = alike

    def _own(self, node: ast.AST) -> Iterator[Mutant]:
        match node:
            case ast.Call(args=arguments, keywords=keywords):
                for left, right in pairwise(arguments):
                    named = all(isinstance(side, ast.Name | ast.Attribute) for side in (left, right))
                    if named and self._text(left) != self._text(right):
                        yield self._exchanged(left, right)
                yield from (self._without(node, keyword) for keyword in keywords if keyword.arg not in {None, *UNSAID})
            case ast.Attribute(attr=name, ctx=ast.Load()):
                for other in sorted(self.alike.get(name, ())):
                    yield Mutant(self.path, self._end(node) - len(name), self._end(node), other)

    def _exchanged(self, left: ast.expr, right: ast.expr) -> Mutant:
        between = self.source[self._end(left) : self._begin(right)].decode()
        text = self._text(right) + between + self._text(left)
        return Mutant(self.path, self._begin(left), self._end(right), text)

    def _without(self, call: ast.Call, keyword: ast.keyword) -> Mutant:
        """Return the mutant without an argument, and without the comma after it or before it."""
        start, end = self._begin(keyword), self._end(keyword)
        after = re.match(rb"\s*,\s*", self.source[end : self._end(call)])
        if after is not None:
            return Mutant(self.path, start, end + after.end(), "")
        before = re.search(rb",\s*$", self.source[self._end(call.func) : start])
        return Mutant(self.path, start - (len(before[0]) if before else 0), end, "")


def drawn(root: Path, only: str, mixed: bool) -> Iterator[Mutant]:
    """Yield every mutant, or every mix-up, of the modules whose path matches."""
    alike = fields_alike(root)
    for path in sorted((root / PACKAGE).rglob("*.py")):
        name = path.relative_to(root).as_posix()
        if re.search(only, name) and not DRAWING.match(name.removeprefix(f"{PACKAGE}/")):
            source = path.read_bytes()
            finder = Mixer(name, source, alike) if mixed else Finder(name, source)
            yield from finder.below(ast.parse(source))


def fields_alike(root: Path) -> dict[str, set[str]]:
    """Return for each field of the package's classes those of its type and unit in all classes that have it."""
    alike: dict[str, set[str]] = {}
    for path in (root / PACKAGE).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_bytes())):
            if isinstance(node, ast.ClassDef):
                groups = defaultdict(list)
                for one in node.body:
                    if isinstance(one, ast.AnnAssign) and isinstance(one.target, ast.Name):
                        unit = one.target.id.rpartition("_")[2] if "_" in one.target.id else ""
                        groups[ast.unparse(one.annotation), unit].append(one.target.id)
                for names in groups.values():
                    for name in names:
                        beside = set(names) - {name}
                        alike[name] = alike.get(name, beside) & beside
    return alike
