"""Where something stands already: what a user made or changed is kept, or the command refuses and names it."""

import shutil
from collections.abc import Callable
from dataclasses import dataclass

from support.each import each
from support.sandbox import ANY, Sandbox

from hostile.conftest import Originals

BUILD = ("build", "kenan-2.0", "--no-pictures", "-o")
COUPON = ("coupon", "-o")
SEARCH = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "4", "--workers", "0")
JUMP = ("simulate", "kenan-2.0", "--capsule", "--trajectory")


@dataclass(frozen=True)
class Case:
    """What lies there, the command, the right exit codes, where it may write, and what stays as it is even there."""

    lay: Callable[[Sandbox, Originals], object]
    command: tuple[str, ...]
    exits: tuple[int, ...] = (2,)
    writes: tuple[str, ...] = ()
    keeps: tuple[str, ...] = ()


def files(**texts: str) -> Callable[[Sandbox, Originals], object]:
    """Lay files; `__` stands for a slash and `_0` for a dot."""
    return lambda sandbox, _: [
        sandbox.write(name.replace("__", "/").replace("_0", "."), text) for name, text in texts.items()
    ]


def bundle(name: str = "there", kind: str = "bundle", **texts: str) -> Callable[[Sandbox, Originals], object]:
    """Lay a bundle of a robot, or a coupon, with files that a user added to it or edited."""

    def lay(sandbox: Sandbox, originals: Originals) -> None:
        shutil.copytree(getattr(originals, kind), sandbox.work / name)
        files(**texts)(sandbox, originals)

    return lay


def link(name: str, target: str, also: Callable[[Sandbox, Originals], object] = files()) -> Callable[..., object]:
    """Lay a link, in place of what is there, and more before it."""

    def lay(sandbox: Sandbox, originals: Originals) -> None:
        also(sandbox, originals)
        place = sandbox.work / name
        if place.is_dir():
            shutil.rmtree(place)
        place.unlink(missing_ok=True)
        place.symlink_to(target)

    return lay


def linked_bundle(sandbox: Sandbox, originals: Originals) -> None:
    shutil.copytree(originals.bundle, sandbox.root / "elsewhere")
    (sandbox.work / "there").symlink_to("../elsewhere")


def study(sandbox: Sandbox, originals: Originals) -> None:
    shutil.copy(originals.study, sandbox.work / "study.db")


def nothing(sandbox: Sandbox, originals: Originals) -> None:
    pass


EDITED = bundle(there__assembly_0md="my remarks\n")
ADDED = bundle(there__notes_0txt="mine\n", there__stl__mine_0stl="solid\n", there__photos__a_0png="x")
CASES = {
    "a file": Case(files(there="x"), (*BUILD, "there")),
    "a file above": Case(files(there="x"), (*BUILD, "there/robot")),
    "a folder of files": Case(files(there__a_0txt="x"), (*BUILD, "there")),
    "the current folder": Case(files(manifest_0json='{"name": "PWA"}', src__thesis_0md="x"), (*BUILD, ".")),
    "the home folder": Case(nothing, (*BUILD, "../home")),
    "an empty folder": Case(lambda s, o: (s.work / "there").mkdir(), (*BUILD, "there"), (0,), ("there",)),
    "a link to a user's folder": Case(link("there", "../outside/folder"), (*BUILD, "there")),
    "a link to a file": Case(link("there", "../outside/precious.txt"), (*BUILD, "there")),
    "a link to nothing": Case(link("there", "../outside/new"), (*BUILD, "there"), ANY, ("../outside/new",)),
    "a link to itself": Case(link("there", "there"), (*BUILD, "there")),
    "a link to a bundle": Case(linked_bundle, (*BUILD, "there"), (0, 2), ("../elsewhere",)),
    "a device": Case(nothing, (*BUILD, "/dev/null")),
    "what is in a user's folder": Case(nothing, (*BUILD, "thesis/robot"), (0,), ("thesis/robot",)),
    "a bundle": Case(bundle(), (*BUILD, "there"), (0,), ("there",)),
    "a bundle with a user's files": Case(
        ADDED, (*BUILD, "there"), (0,), ("there",), ("there/notes.txt", "there/stl/mine.stl", "there/photos")
    ),
    "a bundle with an edited guide": Case(EDITED, (*BUILD, "there")),
    "a coupon with readings": Case(
        bundle(kind="coupon", there__readings_0toml="[gauge.PETG]\naxle_press_mm = 0.1\n"), (*COUPON, "there")
    ),
    "a coupon for a robot": Case(bundle(kind="coupon"), (*BUILD, "there")),
    "a bundle whose meshes lie outside": Case(
        link("there/stl", "../../outside/folder", bundle()), (*BUILD, "there"), ANY, ("there",)
    ),
    "drawings over a user's": Case(files(there__rest_0png="my photo"), ("render", "kenan-2.0", "-o", "there")),
    "drawings into a user's folder": Case(
        files(there__a_0txt="x"), ("render", "kenan-2.0", "-o", "there"), ANY, ("there",), ("there/a.txt",)
    ),
    "drawings into the current folder": Case(files(rest_0png="my photo"), ("render", "kenan-2.0", "-o", ".")),
    "drawings into a file": Case(nothing, ("render", "kenan-2.0", "-o", "notes.txt")),
    "a trajectory over a user's table": Case(files(t_0csv="my measurements\n"), (*JUMP, "t.csv")),
    "a trajectory over a user's settings": Case(nothing, (*JUMP, "../home/.config/settings.json")),
    "a trajectory through a link": Case(link("t.csv", "../outside/precious.txt"), (*JUMP, "t.csv"), ANY, ("t.csv",)),
    "a trajectory over its own URDF's loop": Case(
        bundle(), ("simulate", "there", "--trajectory", "there/urdf/kenan-2.0.loop.json")
    ),
    "a design over another": Case(files(r_0toml="x = 1\n"), ("new", "r.toml")),
    "a design through a link to nothing": Case(link("r.toml", "../outside/new.toml"), ("new", "r.toml")),
    "a workshop over another": Case(
        files(w_0toml="x = 1\n", r_0toml="[gauge.PETG]\naxle_press_mm = 0.1\n"),
        ("coupon", "--measured", "r.toml", "-o", "w.toml"),
    ),
    "a study that is a text": Case(nothing, (*SEARCH, "--study", "notes.txt")),
    "a study of another search": Case(study, (*SEARCH, "--seed", "77", "--study", "study.db")),
    "a winner over a user's design": Case(files(s_0toml="c_coef = 1\n"), (*SEARCH, "--study", "s.db")),
    "a winner over a user's text": Case(nothing, (*SEARCH, "--study", "s.db", "-o", "notes.txt")),
    "a winner over a link": Case(
        link("w.toml", "../outside/precious.txt"), (*SEARCH, "--study", "s.db", "-o", "w.toml")
    ),
    "a table over a user's": Case(
        lambda s, o: (study(s, o), s.write("t.csv", "mine\n")), ("study", "study.db", "--export", "t.csv")
    ),
    "a table through a link to nothing": Case(
        lambda s, o: (study(s, o), (s.work / "t.csv").symlink_to("../outside/new.csv")),
        ("study", "study.db", "--export", "t.csv"),
    ),
    "pictures into a file": Case(study, ("study", "study.db", "--plots", "notes.txt")),
    "pictures over a user's": Case(
        lambda s, o: (study(s, o), s.write("there/progress.png", "mine"), s.write("there/history.png", "mine")),
        ("study", "study.db", "--plots", "there"),
        ANY,
        ("there",),
        ("there/progress.png", "there/history.png"),
    ),
    "an exploration of a user's study": Case(
        study, ("explore", "sweep", "--model", "capsule", "--points", "2", "--workers", "0", "--study", "study.db")
    ),
    "an exploration of a text": Case(
        nothing, ("explore", "sweep", "--model", "capsule", "--points", "2", "--workers", "0", "--study", "notes.txt")
    ),
    "weights over a user's file": Case(
        bundle(w_0toml="x = 1\n"), ("slice", "there", "--write-masses", "w.toml")
    ),
}  # fmt: skip


@each("case", CASES)
def test_what_a_user_has_is_kept(sandbox: Sandbox, originals: Originals, case: str) -> None:
    one = CASES[case]
    one.lay(sandbox, originals)
    sandbox.run(*one.command, exits=one.exits, writes=one.writes, keeps=one.keeps)
