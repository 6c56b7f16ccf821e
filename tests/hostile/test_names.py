"""Odd names of files, odd paths, and options out of all bounds."""

import os
import socket
from pathlib import Path

from support.each import each
from support.sandbox import ANY, Sandbox, lay_odd

from jumpcad.design import load_design

DESIGN = load_design("kenan-2.0").to_toml()
NAMES = {
    "chinese": "机器人",
    "emoji": "🦗🤖",
    "accents": "Ångström-Çelik",
    "combining": "a\u0301\u0301\u0301",
    "right to left": "\u202egnp.toml",
    "nothing wide": "\u200b\ufeff",
    "tab": "a\tb",
    "line": "a\nb",
    "return": "a\rb",
    "colour": "\x1b[31mred",
    "bell": "a\x07",
    "c1": "a\x9b31m",
    "not utf-8": os.fsdecode(b"caf\xe9"),
    "markup": "[bold]x",
    "markup closed": "[/x]",
    "markup in a folder": "[a]",
    "formula": "=1+1",
    "at": "@x",
    "dash": "-rf",
    "two dashes": "--json",
    "percent": "%s%n",
    "braces": "{0}{name}",
    "quotes": "a'b\"c",
    "xml": "<a>&b;",
    "dollar": "$HOME;ls",
    "blank": " ",
    "dots": "...",
    "hidden": ".x",
    "device": "con",
    "template": "kenan-2.0",
    "long": "x" * 240,
    "too long": "x" * 300,
    "backslash": "a\\b",
    "colon": "a:b",
}


@each("case", NAMES)
def test_a_design_may_have_any_name(sandbox: Sandbox, case: str) -> None:
    """What the file system takes is simulated and copied; what it does not take is refused."""
    name = NAMES[case] + ".toml"
    refused = case == "too long"
    if not refused:
        sandbox.write(name, DESIGN)
    exits = (2,) if refused else (0,)
    sandbox.run("simulate", "--capsule", "--json", "--", name, exits=exits)
    sandbox.run("simulate", "--capsule", "--", name, exits=exits)
    sandbox.run("new", "--from", name, "--", "copy.toml", exits=exits, writes=["copy.toml"])
    sandbox.run("new", "--", f"new-{name}", exits=ANY, writes=[f"new-{name}"])


BUILT = ("chinese", "emoji", "combining", "right to left", "tab", "line", "colour", "c1", "not utf-8", "markup closed",
         "formula", "xml", "braces", "blank", "long", "too long")  # fmt: skip
"""Names that go into files of every kind, each of which may stumble over another sign."""


@each("case", BUILT)
def test_a_robot_of_any_name_is_built_or_refused(sandbox: Sandbox, case: str) -> None:
    """Its name goes into file names, XML, tables, and onto its plates."""
    if case != "too long":
        sandbox.write(NAMES[case] + ".toml", DESIGN)
    sandbox.run("build", "--no-pictures", "-o", "robot", "--", NAMES[case] + ".toml", writes=["robot"])


@each("case", ["chinese", "emoji", "markup closed", "not utf-8", "colour", "line", "too long", "dash"])
def test_a_folder_may_have_any_name(sandbox: Sandbox, case: str) -> None:
    name = NAMES[case]
    option = f"--output={name}"
    top = name.split("/")[0]
    sandbox.run("coupon", option, writes=[top])
    sandbox.run("verify", "--", name)


PATHS = {
    "nothing": "",
    "here": ".",
    "above": "..",
    "root": "/",
    "null": "/dev/null",
    "full": "/dev/full",
    "memory": "/proc/self/mem",
    "environment": "/proc/self/environ",
    "descriptor": "/dev/fd/99",
    "home": "~",
    "folder": "thesis",
    "text": "notes.txt",
    "below a file": "notes.txt/x.toml",
    "missing folder": "no/where/x.toml",
    "loop": "loop.toml",
    "dangling": "dangling.toml",
    "link": "link.toml",
    "deep": "a/" * 2000 + "x.toml",
    "long": "x" * 5000 + ".toml",
    "line": "no\nfile.toml",
    "colour": "\x1b[31mno.toml",
    "markup": "[/no].toml",
    "url": "https://127.0.0.1:1/x.toml",
    "socket": "socket.toml",
    "pipe": "pipe.toml",
}
COMMANDS = {
    "simulate": ["simulate", "--capsule", "--", "PATH"],
    "check": ["check", "--", "PATH"],
    "build": ["build", "--no-pictures", "-o", "robot", "--", "PATH"],
    "render": ["render", "-o", "drawn", "--", "PATH"],
    "verify": ["verify", "--", "PATH"],
    "slice": ["slice", "--", "PATH"],
    "study": ["study", "--", "PATH"],
    "measured": ["coupon", "--measured=PATH", "-o", "w.toml"],
    "workshop": ["coupon", "--workshop=PATH", "-o", "gauges"],
    "settings": ["simulate", "kenan-2.0", "--capsule", "--settings=PATH"],
    "around": ["explore", "sweep", "--model", "published", "--points", "2", "--workers", "0", "--around=PATH"],
    "from": ["new", "copy.toml", "--from=PATH"],
}


def lay_paths(sandbox: Sandbox) -> None:
    """Put links, a pipe and a socket where the odd paths lead."""
    lay_odd(sandbox.work / "pipe.toml", "pipe")
    for name, target in {"loop": "loop.toml", "dangling": "nowhere", "link": "../outside/precious.txt"}.items():
        (sandbox.work / f"{name}.toml").symlink_to(target)
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind("socket.toml")


@each("command", COMMANDS)
@each("case", PATHS)
def test_an_odd_path_to_read_is_refused(sandbox: Sandbox, case: str, command: str) -> None:
    lay_paths(sandbox)
    words = [word.replace("PATH", PATHS[case]) for word in COMMANDS[command]]
    # an empty file is a workshop, or settings, that change nothing; an empty option is one that is not given
    bears = case in ("null", "full", "nothing") and command in ("settings", "workshop", "measured", "around", "from")
    sandbox.run(*words, exits=ANY if bears else (2,), writes=["gauges", "w.toml"])


CREATABLE = ("line", "colour", "url", "markup", "nothing", "deep", "missing folder")
"""Names and folders that a command may make, or leave alone."""
CREATED = [("home", "coupon"), ("dangling", "coupon"), ("home", "study"), ("home", "winner")]
MADE = ("~", "no", "a", "https:", "nowhere", "s.db")
SEARCH = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "2", "--workers", "0")
WRITERS = {
    "new": ["new", "--", "PATH"],
    "coupon": ["coupon", "--output=PATH"],
    "measured": ["coupon", "--measured", "readings.toml", "--output=PATH"],
    "trajectory": ["simulate", "kenan-2.0", "--capsule", "--trajectory=PATH"],
    "study": [*SEARCH, "--study=PATH"],
    "winner": [*SEARCH, "--study=s.db", "--output=PATH"],
    "export": ["study", "study.db", "--export=PATH"],
}


@each("command", WRITERS)
@each("case", [case for case in PATHS if case not in ("missing folder", "dangling", "deep", "markup")])
def test_an_odd_path_to_write_is_refused(sandbox: Sandbox, study: Path, case: str, command: str) -> None:
    lay_paths(sandbox)
    sandbox.write("readings.toml", "[gauge.PETG]\naxle_press_mm = 0.1\n")
    words = [word.replace("PATH", PATHS[case]) for word in WRITERS[command]]
    may_be_new = case in CREATABLE or (case, command) in CREATED
    sandbox.run(*words, exits=ANY if may_be_new else (2,), writes=[*filter(None, (PATHS[case],)), "exports", *MADE])
