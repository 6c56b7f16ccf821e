"""The structure of the package in figures: packages, layers, imports in cycles, files that an addition touches.

    python benchmarks/structure.py [CHECKOUT]

Run it in two checkouts to compare them. Loose modules of `jumpcad` count as packages. Packages that import each other
in a cycle share a layer, and a package's layer is one above the highest that it imports. What an addition touches is
counted on a present one of its kind: the modules that name it.
"""

import ast
import re
import statistics
import sys
from collections import defaultdict
from pathlib import Path

PACKAGE = "jumpcad"
ADDITIONS = {
    "a printed part (spring bushing)": r"spring_bushing",
    "an exporter (DXF)": r"exporters\.dxf|write_dxfs?\b",
    "a check that grows a section (toe_landing)": r"\btoe_landing\b",
    "a search method (nsga2)": r"\bnsga2\b",
    "an engine (MuJoCo)": r"simulation\.mujoco|MujocoEngine|\"mujoco\"",
}
"""Kind of addition, and the pattern of a present one's name in the code."""


def modules(root: Path) -> dict[str, Path]:
    """Return every module of the package by its dotted name."""
    found = {}
    for path in sorted((root / PACKAGE).rglob("*.py")):
        parts = path.relative_to(root).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def imports(path: Path, known: dict[str, Path]) -> set[str]:
    """Return the modules of the package that a module names, for types too."""
    named = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == PACKAGE:
            full = [f"{node.module}.{alias.name}" for alias in node.names]
            named |= {name if name in known else node.module for name in full}
        elif isinstance(node, ast.Import):
            named |= {alias.name for alias in node.names if alias.name.split(".")[0] == PACKAGE}
    return named


def package_of(module: str) -> str:
    """Return the package or loose module that a module belongs to."""
    return module.split(".")[1] if "." in module else PACKAGE


def cycles(graph: dict[str, set[str]]) -> list[set[str]]:
    """Return the strongly connected components, those first that others import (Tarjan 1972)."""
    order: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[set[str]] = []

    def visit(node: str) -> None:
        order[node] = low[node] = len(order)
        stack.append(node)
        for other in sorted(graph[node]):
            if other not in order:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], order[other])
        if low[node] == order[node]:
            cycle = set(stack[stack.index(node) :])
            del stack[stack.index(node) :]
            found.append(cycle)

    for node in sorted(graph):
        if node not in order:
            visit(node)
    return found


def figures(root: Path) -> dict[str, object]:
    """Return the figures of a checkout, by what they count."""
    known = modules(root)
    graph: dict[str, set[str]] = defaultdict(set)
    edges = defaultdict(int)
    for name, path in known.items():
        here = package_of(name)
        if here in (PACKAGE, "__main__"):
            continue
        graph[here] |= set()
        for there in {package_of(other) for other in imports(path, known)} - {here, PACKAGE}:
            graph[here].add(there)
            edges[here, there] += 1
    layer: dict[str, int] = {}
    cyclic = 0
    for cycle in cycles(graph):
        below = {other for one in cycle for other in graph[one]} - cycle
        for one in cycle:
            layer[one] = 1 + max((layer[other] for other in below), default=0)
        inside = {edge: count for edge, count in edges.items() if set(edge) <= cycle}
        cyclic += sum(min(count, inside.get((b, a), count)) for (a, b), count in inside.items() if a < b)
    lines = {name: len(path.read_text(encoding="utf-8").splitlines()) for name, path in known.items()}
    loose = [name for name, path in known.items() if path.parent.name == PACKAGE and path.stem != "__init__"]
    text = {path: path.read_text(encoding="utf-8") for path in known.values()}
    return {
        "modules": len(known),
        "lines, median": statistics.median(lines.values()),
        "modules over 300 lines": sum(count > 300 for count in lines.values()),
        "packages and loose modules": len(graph),
        "layers": max(layer.values()),
        "imports in cycles": cyclic,
        "loose modules": len(loose),
        "guards of a missing plan or workshop": sum(
            len(re.findall(r"(?:plan|workshop|parts) is (?:not )?None|assert (?:robot\.)?plan", body))
            for body in text.values()
        ),
    } | {
        f"files that {kind} touches": sum(bool(re.search(pattern, body)) for body in text.values())
        for kind, pattern in ADDITIONS.items()
    }


def main() -> None:
    """Print the figures of a checkout, this one unless another is named."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1]
    for what, value in figures(root).items():
        print(f"{what:<62}{value:>6}")


if __name__ == "__main__":
    main()
