"""The page of all commands."""

import re
from typing import Any

import typer
from reference_page import page, table

from jumpcad.cli.commands import app


def commands() -> str:
    """Return the page of all commands with arguments and options, as their help has them."""
    found = typer.main.get_command(app).commands  # type: ignore[attr-defined]
    words = "What `jumpcad COMMAND --help` says. Exit codes and common rules: [Command line](../commands.md)."
    return page("Commands", words, *(_command(name, command) for name, command in found.items()))


def _command(name: str, command: Any) -> str:
    rows = [
        (" ".join(f"`{word}`" for word in _words(one)), one.help or "", _default(one))
        for one in command.params
        if one.name != "help" and not getattr(one, "hidden", False)
    ]
    arguments = [_words(one)[0] for one in command.params if one.param_type_name == "argument"]
    usage = " ".join(["jumpcad", name, *arguments, "[OPTIONS]"])
    paragraphs = re.sub(r"[ \t]*\n[ \t]*", "\n", command.help.strip())
    example = [re.sub("jumpcad .*", r"`\g<0>`", command.epilog)] if command.epilog else []
    return "\n\n".join(
        [f"## jumpcad {name}", f"```text\n{usage}\n```", paragraphs, *example, table(("", "meaning", "default"), rows)]
    )


def _words(parameter: Any) -> list[str]:
    """Return the names of an option with the word for its value, or that of an argument."""
    value = parameter.metavar or parameter.name.upper()
    if parameter.param_type_name == "argument":
        return [value]
    names = [*parameter.opts, *parameter.secondary_opts]
    return names if parameter.is_flag else [*names[:-1], f"{names[-1]} {value}"]


def _default(parameter: Any) -> str:
    shown = getattr(parameter, "show_default", None)
    if isinstance(shown, str):
        return shown
    default = parameter.default
    if callable(default) or default is None or default is False or default == () or parameter.required:
        return "required" if parameter.required else ""
    return f"`{default}`"
