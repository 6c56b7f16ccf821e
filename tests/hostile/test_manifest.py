"""Bundles from strangers: a manifest's values and paths, files that are links, files that are something else."""

import hashlib
import json
import shutil
from collections.abc import Callable
from pathlib import Path

from support.each import each
from support.mutations import DOCUMENTS, Spoil, accidents, places, spoilt_value
from support.sandbox import ANY, Sandbox

from hostile.conftest import Originals

COMMANDS = ("verify", "simulate", "slice", "build")


def ask(sandbox: Sandbox, command: str, exits: tuple[int, ...]) -> None:
    """Give the bundle `robot` to a command that reads it; `slice` may write into it, `build` beside it."""
    more = ("-o", "again", "--no-pictures") if command == "build" else ()
    writes = {"slice": ("robot",), "build": ("again",)}.get(command, ())
    sandbox.run(command, "robot", *more, "--json", exits=exits, writes=writes)


def with_file(originals: Originals, path: str, digest: str) -> str:
    """Return a manifest that lists one more file."""
    manifest = originals.manifest
    manifest["files"][path] = digest
    return json.dumps(manifest)


@each("number", range(40))
def test_a_strange_value_is_borne_or_refused(sandbox: Sandbox, bundle: Path, originals: Originals, number: int) -> None:
    manifest = originals.manifest
    found = [place for place in places(manifest) if place[0] != "bodies"]
    sandbox.case, text = spoilt_value(manifest, found, number)
    (bundle / "manifest.json").write_text(text)
    for command in ("verify", "simulate", "slice"):
        ask(sandbox, command, ANY)


OUTSIDE = {
    "above": "../../home/.bashrc",
    "above later": "stl/../../../home/.bashrc",
    "absolute": "{home}/.bashrc",
    "through a link": "lnk/.bashrc",
    "up from a link": "lnk/../home/.bashrc",
}
"""Paths at which a user's file lies, listed here with its very sha256."""


@each("command", COMMANDS)
@each("case", OUTSIDE)
def test_no_path_leads_out_of_a_bundle(
    sandbox: Sandbox, bundle: Path, originals: Originals, case: str, command: str
) -> None:
    (bundle / "lnk").symlink_to(sandbox.home)
    digest = hashlib.sha256((sandbox.home / ".bashrc").read_bytes()).hexdigest()
    path = OUTSIDE[case].replace("{home}", str(sandbox.home))
    (bundle / "manifest.json").write_text(with_file(originals, path, digest))
    ask(sandbox, command, {"verify": (1, 2), "slice": (2,)}.get(command, ANY))


LINKS = {
    "bill": ("bom.csv", "home/.bashrc"),
    "guide": ("assembly.md", "home/.bashrc"),
    "design": ("design.toml", "outside/design.toml"),
    "workshop": ("workshop.toml", "outside/workshop.toml"),
    "urdf": ("urdf/kenan-2.0.urdf", "outside/robot.urdf"),
    "folder": ("stl", "outside/stl"),
    "urdf folder": ("urdf", "outside/urdf"),
    "manifest": ("manifest.json", "outside/manifest.json"),
}


@each("command", COMMANDS)
@each("case", LINKS)
def test_a_link_in_a_bundle_is_not_followed_out_of_it(
    sandbox: Sandbox, bundle: Path, originals: Originals, case: str, command: str
) -> None:
    """What stands under the name is moved away and linked to, so that all digests are right."""
    name, target = LINKS[case]
    place = sandbox.root / target
    if place.exists():
        digest = hashlib.sha256(place.read_bytes()).hexdigest()
        (bundle / name).unlink()
        (bundle / "manifest.json").write_text(with_file(originals, name, digest))
    else:
        shutil.move(bundle / name, place)
    (bundle / name).symlink_to(place)
    right = {"verify": ANY if case == "manifest" else (1, 2), "slice": (2,)}.get(command, ANY)
    ask(sandbox, command, right)


@each("name", ["../../report", "/etc/passwd", "a\nb", "\x1b[31m", "[/x]", "=1+1", ""])
@each("key", ["name", "material"])
def test_a_parts_name_is_no_path(sandbox: Sandbox, bundle: Path, originals: Originals, key: str, name: str) -> None:
    manifest = originals.manifest
    manifest["masses"][0][key] = name
    (bundle / "manifest.json").write_text(json.dumps(manifest))
    ask(sandbox, "slice", (2,))


@each("case", [*DOCUMENTS, *accidents(20, 6)])
def test_what_is_no_manifest_is_refused(sandbox: Sandbox, bundle: Path, case: str) -> None:
    spoils: dict[str, Spoil] = DOCUMENTS | accidents(20, 6)
    (bundle / "manifest.json").write_bytes(spoils[case]((bundle / "manifest.json").read_bytes()))
    for command in ("verify", "simulate"):
        ask(sandbox, command, ANY)


def change_design(bundle: Path, text: str) -> None:
    """Put another design in a bundle, listed as its own."""
    manifest = json.loads((bundle / "manifest.json").read_text())
    manifest["files"]["design.toml"] = hashlib.sha256(text.encode()).hexdigest()
    (bundle / "design.toml").write_text(text)
    (bundle / "manifest.json").write_text(json.dumps(manifest))


CONTENTS: dict[str, Callable[[str], str]] = {
    "empty": lambda text: "",
    "nan": lambda text: text.replace("100.0", "nan", 1),
    "control": lambda text: text + '"\\u001b[2J" = 1\n',
    "huge": lambda text: text.replace("100.0", "1e308", 1),
    "noise": lambda text: "\x00\x01",
}


@each("command", ["build", "render", "check"])
@each("case", CONTENTS)
def test_inputs_in_a_bundle_are_as_strange_as_any(sandbox: Sandbox, bundle: Path, case: str, command: str) -> None:
    change_design(bundle, CONTENTS[case]((bundle / "design.toml").read_text()))
    sandbox.run(command, "robot", "--json", exits=(2,))
