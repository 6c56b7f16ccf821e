"""Two files of one command on one path: refused before any work, whatever way leads there."""

import os
from collections.abc import Callable
from pathlib import Path

from support.each import each
from support.sandbox import Sandbox

from jumpcad.design import load_design

DESIGN = load_design("kenan-2.0").to_toml()
SEARCH = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "2", "--workers", "0")
SWEEP = ("explore", "sweep", "--model", "capsule", "--points", "2", "--workers", "0")
PAIRS = {
    "winner, pictures": (*SEARCH, "--study", "s.db", "-o", "{a}.toml", "--plots", "{b}.toml"),
    "study, pictures": (*SEARCH, "--study", "{a}.db", "-o", "w.toml", "--plots", "{b}.db"),
    "study, winner": (*SEARCH, "--study", "{a}.db", "-o", "{b}.db"),
    "study, prior": (*SEARCH, "--study", "{a}.db", "--from-study", "{b}.db"),
    "winner, settings": (*SEARCH, "--study", "s.db", "-o", "{b}.toml", "--settings", "{a}.toml"),
    "winner, centre": (*SEARCH, "--study", "s.db", "-o", "{b}.toml", "--around", "{a}.toml", "--within", "5"),
    "winner of a study, workshop": (*SEARCH[:3], "printed", "--study", "{b}.db", "--workshop", "{a}.toml"),
    "views, pictures": (*SWEEP, "--study", "{a}.db", "--plots", "{b}.db"),
    "views, settings": (*SWEEP, "--plots", "{b}.toml", "--settings", "{a}.toml"),
    "table, pictures": ("study", "study.db", "--export", "{a}.csv", "--plots", "{b}.csv"),
    "table, study": ("study", "{a}.csv", "--export", "{b}.csv"),
    "table below pictures' file": ("study", "study.db", "--export", "{a}.csv", "--plots", "{b}.csv/p"),
    "bundle, design": ("build", "{a}.toml", "-o", "{b}.toml"),
    "bundle, workshop": ("build", "kenan-2.0", "--workshop", "{a}.toml", "-o", "{b}.toml"),
    "drawings, workshop": ("render", "kenan-2.0", "--workshop", "{a}.toml", "-o", "{b}.toml"),
    "workshop, readings": ("coupon", "--measured", "{a}.toml", "-o", "{b}.toml"),
    "workshop, its base": ("coupon", "--measured", "r.toml", "--workshop", "{a}.toml", "-o", "{b}.toml"),
    "weights, workshop": ("slice", "robot", "--workshop", "{a}.toml", "--write-masses", "{b}.toml"),
    "design, template": ("new", "{b}.toml", "--from", "{a}.toml"),
}  # fmt: skip
READ = {
    "centre": DESIGN,
    "design": DESIGN,
    "template": DESIGN,
    "settings": "",
    "workshop": "",
    "base": "",
    "readings": "",
}
"""What is in a file that is read, by the last word of the pair: all is well but for the paths."""
ENDS = ("toml", "db", "csv")


WAYS: dict[str, Callable[[Path], str]] = {
    "itself": lambda work: "q",
    "through a folder": lambda work: "thesis/../q",
    "absolute": lambda work: str(work / "q"),
    "a link": lambda work: linked(work, Path.symlink_to),
    "a hard link": lambda work: linked(work, Path.hardlink_to),
    "a folder's link": lambda work: os.symlink(".", work / "here") or "here/q",
}


def linked(work: Path, link: Callable[[Path, Path], None]) -> str:
    """Make links to the files that are there; return what they are called."""
    for end in ENDS:
        if (work / f"q.{end}").exists():
            link(work / f"other.{end}", work / f"q.{end}")
    return "other" if list(work.glob("other.*")) else "q"


@each("way", WAYS)
@each("pair", PAIRS)
def test_one_path_is_not_used_twice(sandbox: Sandbox, study: Path, pair: str, way: str) -> None:
    """Not with `--force` either, which allows to replace a file, not to read and write it."""
    content = READ.get(pair.split()[-1])
    if content is not None:
        sandbox.write("q.toml", content)
    sandbox.write("r.toml", "")
    other = WAYS[way](sandbox.work)
    words = [word.format(a="q", b=other) for word in PAIRS[pair]]
    said = sandbox.run(*words, "--force", exits=(2,))
    assert said.out == ""
    assert "itself" in said.err or "lies below" in said.err or "is a file" in said.err or content is None, said.err


def test_other_paths_are_used(sandbox: Sandbox, study: Path) -> None:
    sandbox.run("study", "study.db", "--export", "t.csv", "--plots", "t", exits=(0,), writes=["t.csv", "t"])
    sandbox.run("new", "kenan-2.0.toml", "--from", "kenan-2.0", exits=(0,), writes=["kenan-2.0.toml"])
