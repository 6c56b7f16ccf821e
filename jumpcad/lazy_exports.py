"""The face of a package: public names that load when they are first used."""

import sys

TYPE_CHECKING = False  # as in `jumpcad`: nothing is imported before the command line is ready for an interrupt
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any


def lazy_exports(package: str) -> "tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]":
    """Return `__getattr__`, `__dir__` and the public names of a package.

    They stand once, as its `__init__` imports them for type checkers: a line `from HOME import NAME as NAME` for each.
    """
    face: Any = sys.modules[package]
    lines = (line.split() for line in face.__spec__.loader.get_source(package).splitlines())
    homes = {words[5]: words[1] for words in lines if words[:1] == ["from"] and words[4:5] == ["as"]}

    def load(name: str) -> "Any":
        import importlib

        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        if homes[name] == package:
            value = importlib.import_module(f"{package}.{name}")
        else:
            value = getattr(__import__(homes[name], fromlist=[name]), name)
        setattr(face, name, value)
        return value

    return load, lambda: list(face.__all__), list(homes)
