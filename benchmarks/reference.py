"""The reference pages of the documentation, and the drawing of the eight parameters, written from the code.

    python benchmarks/reference.py [--write]

Without `--write` it compares the pages in `docs/` with what the program gives, and exits with 1 if they differ. It
builds one robot with its files and checks the templates (some ten seconds).
"""

import sys
from pathlib import Path

from reference_checks import check_glossary
from reference_commands import commands
from reference_figures import figures
from reference_files import files_and_json
from reference_workshop import workshop_keys

DOCS = Path(__file__).parents[1] / "docs"
PAGES = {
    "reference/commands.md": commands,
    "reference/workshop.md": workshop_keys,
    "reference/checks.md": check_glossary,
    "reference/figures.md": figures,
    "reference/files.md": files_and_json,
}
"""Every file that this program writes, under `docs`, and what returns its content."""


def main(arguments: list[str] | None = None) -> int:
    """Compare or write all pages; return the exit code."""
    write = "--write" in (sys.argv[1:] if arguments is None else arguments)
    stale = []
    for name, content in PAGES.items():
        path, text = DOCS / name, content()
        if write:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        elif not path.is_file() or path.read_text(encoding="utf-8") != text:
            stale.append(f"docs/{name}: not what the program gives; run python benchmarks/reference.py --write")
    print("\n".join(stale) or "every reference page is what the program gives")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
