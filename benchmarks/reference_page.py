"""A page of the reference in Markdown."""

from collections.abc import Iterable

EXAMPLE = "kenan-2.0"
"""The robot of the examples."""
GENERATED = "<!-- Written by benchmarks/reference.py: change the code, then run it with --write. -->\n"


def page(title: str, words: str, *blocks: str) -> str:
    """Return a page of Markdown."""
    return "\n\n".join([f"# {title}", GENERATED + words, *blocks]).rstrip("\n") + "\n"


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    """Return a table of text."""
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)
