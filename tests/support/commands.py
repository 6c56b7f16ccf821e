"""Commands as tests call them."""

from collections.abc import Callable

Run = Callable[..., tuple[int, str, str]]
"""`run("new", "frog.toml")` returns exit code, standard output and standard error."""
