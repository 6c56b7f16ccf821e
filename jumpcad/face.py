"""The face of the package: its version, and public names that load when they are first used."""

import sys

__version__ = "0.1.0"

TYPE_CHECKING = False  # as in `jumpcad`: nothing is imported before the command line is ready for an interrupt
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    Face = tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]


def lazy_exports(package: str, names: dict[str, str]) -> "Face":
    """Return `__getattr__`, `__dir__` and `__all__` of a package whose public names are those of other modules.

    `names` has them by module, with spaces between; those of the package itself are modules in it. Type checkers read
    the imports that stand beside it.
    """
    homes = {name: home for home, row in names.items() for name in row.split()}

    def load(name: str) -> "Any":
        import importlib

        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        if homes[name] == package:
            value = importlib.import_module(f"{package}.{name}")
        else:
            value = getattr(__import__(homes[name], fromlist=[name]), name)
        setattr(sys.modules[package], name, value)
        return value

    return load, lambda: sorted(homes), list(homes)
