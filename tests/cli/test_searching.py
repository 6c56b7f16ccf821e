"""Options that all searches share, with the capsule robot."""

import os

import pytest
from support.hills import SMALL, Hill
from support.searches import NARROW, QUICK, refusal, run

from jumpcad.cli.searching import Tally, require_plots, watching
from jumpcad.errors import JumpcadError
from jumpcad.search.report.figures import PICTURES
from jumpcad.search.study.trial import Trial


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["optimize", "--evaluations", "0"], "evaluations = 0 must be at least 1"),
        (["optimize", "gaa"], "did you mean ga"),
        (["optimize", "--model", "capsul"], "did you mean capsule"),
        (["optimize", "--fix", "stifness_nmm_per_deg=9"], "did you mean stiffness_nmm_per_deg"),
        (["optimize", "--bound", "c_coef=1.2:0.8"], "empty range"),
        (["optimize", "--workers", "-1"], "workers = -1"),
        (["optimize", "--workers", "1", "--dask", "tcp://x"], "exclude each other"),
        (["optimize", "--engine", "ode"], "'ode' is not an engine; there are pybullet"),
        (["optimize", "--settings", "defalt"], "default"),
        (["optimize", "--around", "nobody"], "neither a TOML file nor one of"),
        (["optimize", "--from-study", "none.db"], "no such study file"),
        (["optimize", "-o", "mine.toml"], "exists already; choose another name, or replace it with --force"),
        (["optimize", "--study", "mine.toml"], "a study file must end in .db"),
        (["optimize", "--study", ":memory:"], "a study file must end in .db"),
        (["optimize", "--study", "."], "is a directory"),
        (["explore", "sweep", "--study", "mine.toml"], "a study file must end in .db"),
        (["optimize", "--study", "nowhere/s.db"], "there is no folder nowhere"),
        (["optimize", "--study", "folder.db"], "is a directory"),
        (["optimize", "--study", "dangling.db", "-o", "aim.toml"], "is no file"),
        (["optimize", "-o", "nowhere/best.toml"], "there is no folder nowhere"),
        (["optimize", "-o", "best.db"], "must end in .toml"),
        (["optimize", "--plots", "mine.toml"], "'mine.toml' is a file"),
        (["optimize", "--plots", "pictures"], "pictures/history.svg: exists already"),
        (["explore", "sweep", "--plots", "pictures"], "pictures/sweeps.svg: exists already"),
        (["study", "none.db"], "no such study file"),
    ],
)
def test_wrong_requests_are_one_line_and_leave_no_study(folder, arguments, message):
    (folder / "mine.toml").write_text("# my own\n" * 100)
    os.symlink("aim.toml", "dangling.db")
    (folder / "folder.db").mkdir()
    (folder / "pictures").mkdir()
    (folder / "pictures" / ("history.svg" if arguments[0] == "optimize" else "sweeps.svg")).write_text("mine")
    before = sorted(folder.rglob("*"))
    if arguments[0] == "optimize" and "--model" not in arguments:
        arguments = [*arguments, "--model", "capsule", *(["-o", "other.toml"] if "-o" not in arguments else [])]
    assert message in refusal(*arguments)
    assert (folder / "mine.toml").read_text() == "# my own\n" * 100
    assert sorted(folder.rglob("*")) == before


@pytest.mark.thorough
def test_a_winner_that_somebody_edited_is_kept(folder):
    plots = ["--plots", "pics"]
    search = ["optimize", "ga", *QUICK, *NARROW, "--evaluations", 10, "--study", "s.db", "-o", "best.toml"]
    run(*search, *plots)
    run(*search, *plots, "--evaluations", 12)  # what jumpcad wrote itself is written again
    winner = (folder / "best.toml").read_text()
    mine = winner.replace("c_coef = ", "c_coef = 1.0 # my own; it was ")
    (folder / "best.toml").write_text(mine)
    assert "best.toml: exists already" in refusal(*search, "--evaluations", 12)
    assert (folder / "best.toml").read_text() == mine
    run(*search, "--evaluations", 12, "--force")
    assert (folder / "best.toml").read_text() == winner
    (folder / "pics" / "history.svg").write_text("<svg/>")
    assert "history.svg: exists already" in refusal("study", "s.db", "--plots", "pics")
    assert (folder / "pics" / "history.svg").read_text() == "<svg/>"


@pytest.mark.parametrize("name", [f"{name}{end}" for name in PICTURES for end in (".svg", ".png")])
def test_no_picture_of_one_s_own_is_replaced_unless_it_is_forced(tmp_path, name):
    require_plots(tmp_path / "new", False)
    require_plots(None, False)
    (tmp_path / name).write_bytes(b"mine")
    with pytest.raises(JumpcadError, match=f"{name}: exists already"):
        require_plots(tmp_path, False)
    require_plots(tmp_path, True)
    with pytest.raises(JumpcadError, match="is there already and is no folder"):
        require_plots(tmp_path / name, True)


DESIGN = SMALL.to_design([0.2, 0.2, 0.2])


def trial(number, score=5.0, phase="bo"):
    return Trial(phase, number, 0, DESIGN, Hill()(DESIGN), score, "m", 0.1)


def test_a_quiet_search_says_nothing(capfd):
    with watching(3, quiet=True) as watch:
        watch(trial(0), True)
    assert capfd.readouterr() == ("", "")


def test_a_line_says_what_is_done_and_the_best_of_the_search():
    """What is read from the study counts too, but not for the rate; neighbours of the best are no better ones."""
    tally = Tally(40)
    assert tally.add(trial(1, 5.0), False) == "bo: 1 of 40 evaluations, best 5, 0/s"
    line = tally.add(trial(2, 4.0, "pick"), True)
    assert line.startswith("robust pick: 2 of 40 evaluations, best 5, ")
    assert line.endswith(" left")
