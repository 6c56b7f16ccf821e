"""How the package is built: lines, circles, what a run touches, where a thing is (python benchmarks/structure.py)."""

import argparse
import ast
import cProfile
import pstats
import re
from collections.abc import Callable
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import jumpcad

PACKAGE = Path(jumpcad.__file__).parent
FIVE_BAR = re.compile(r"\b(main_leg|front_link|l[1-5]_mm|five_bar|carrying_link|[cde]_coef|ankle)\b")
"""What only a room of the legs, the mechanism and the drive need to know."""


def main() -> None:
    """Print the measures, one a line."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    modules = modules_in(PACKAGE)
    texts = {name: path.read_text(encoding="utf-8") for name, path in modules.items()}
    print(f"lines {sum(text.count(chr(10)) for text in texts.values())}, modules {len(modules)}")
    print(f"loose modules at the top {sum(name.count('.') == 1 for name in modules if _is_file(modules[name]))}")
    print(f"circles of imports {len(_circles(texts))}")
    print(f"modules that name the five-bar's links {sum(bool(FIVE_BAR.search(text)) for text in texts.values())}")
    for room in sorted(path.parent.name for path in PACKAGE.glob("robot/*/thing.py")):
        there = [name for name in modules if name.startswith(f"jumpcad.robot.{room}.")]
        beside = [one for one in modules if re.search(rf"\.{room}$", one) and not one.startswith("jumpcad.robot")]
        print(f"{room}: {len(there)} files in its folder, elsewhere {', '.join(beside) or 'none'}")
    design = jumpcad.load_design("best-printable")
    _touched("build of kenan-2.0", lambda: jumpcad.build("kenan-2.0"))
    _touched("evaluate of best-printable", lambda: jumpcad.evaluate(design))


def modules_in(package: Path) -> dict[str, Path]:
    """Return a package's modules by name."""
    paths = [path for path in sorted(package.rglob("*.py")) if "templates" not in path.parts]
    names = [".".join(path.relative_to(package.parent).with_suffix("").parts) for path in paths]
    return {name.removesuffix(".__init__"): path for name, path in zip(names, paths, strict=True)}


def _is_file(path: Path) -> bool:
    return path.name not in ("__init__.py", "__main__.py")


def _circles(texts: dict[str, str]) -> list[list[str]]:
    """Return circles of imports, types included, each taken away at one arrow to find the next."""
    graph = {name: imports(name, text, texts) for name, text in texts.items()}
    found: list[list[str]] = []
    while True:
        try:
            TopologicalSorter(graph).prepare()
        except CycleError as circle:
            found.append(circle.args[1])
            graph[circle.args[1][1]].discard(circle.args[1][0])
        else:
            return found


def imports(name: str, text: str, known: dict[str, str]) -> set[str]:
    """Return the known modules that a module's text imports, anywhere in it."""
    nodes = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.ImportFrom) and node.module]
    names = {f"{node.module}.{one.name}": node.module or "" for node in nodes for one in node.names}
    return {full if full in known else module for full, module in names.items()} & known.keys() - {name}


def _touched(what: str, run: Callable[[], object]) -> None:
    """Print how many files a run goes through, at first and once more, and calls from one of them into another."""
    for when in ("first", "again"):
        profile = cProfile.Profile()
        profile.runcall(run)
        stats = pstats.Stats(profile).stats  # type: ignore[attr-defined]
        ours = {key for key in stats if key[0].startswith(str(PACKAGE)) and key[2] != "<module>"}
        callers = {key: {one: count for one, count in stats[key][4].items() if one in ours} for key in ours}
        across = sum(count[0] for key in ours for one, count in callers[key].items() if one[0] != key[0])
        print(f"{what}, {when}: {len({key[0] for key in ours})} files, {across} calls from one into another")


if __name__ == "__main__":
    main()
