"""`study --watch`, which follows a running search."""

import threading
import time
from dataclasses import replace

from support.hills import SMALL, Hill
from support.searches import refusal, run
from support.studies import IDENTITY, trials

from jumpcad.cli import study as command
from jumpcad.search.study.database import is_written
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import run_study
from jumpcad.search.study.store import StudyStore


def test_designs_of_the_search_and_around_the_best_are_counted_apart(tmp_path, capsys):
    """Of a search that has ended there is one line, with the best score of what it proposed."""
    searched = trials(12)
    around = [replace(trial, phase="robust", score=99.0) for trial in trials(5, step=1)]
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append(searched + around)
        store.remember("stages", [{"method": "ga", "evaluations": 20, "initial": 0}])
    command._watch(tmp_path / "s.db")
    best = max(trial.score for trial in searched if trial.score is not None)
    assert capsys.readouterr().out == f"12 of 20 designs, best {best:.4f} body lengths, 5 around the best\n"


def test_it_follows_a_search_until_it_ends(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(command, "WATCH_S", 0.05)
    path = tmp_path / "s.db"

    def search():
        with local_pool(0) as pool:
            run_study(Request(SMALL, Hill(pause_s=0.02), method="ga", evaluations=60), path, pool)

    running = threading.Thread(target=search)
    running.start()
    while not is_written(path) or path.stat().st_size == 0:
        time.sleep(0.01)
    time.sleep(0.3)
    text = run("study", path, "--watch")
    running.join()
    lines = [line for line in text.splitlines() if " of 45 designs, best " in line]
    counts = [int(line.split()[0]) for line in lines]
    assert counts == sorted(counts)
    assert len(set(lines)) == len(lines)
    assert (len(counts) > 1, counts[-1]) == (True, 45)
    assert "around the best" in lines[-1]
    assert not is_written(path)
    assert f"{path}: ga on the hill robot, fitness" in text  # the study itself follows


def test_it_looks_again_after_a_while_and_says_only_what_is_new(tmp_path, monkeypatch, capsys):
    """Also what came while it found that nobody writes any more."""
    path, waited = tmp_path / "s.db", []
    later = [[], [], trials(2, step=1), []]
    with StudyStore.write(path, IDENTITY) as store:
        store.append(trials(3))

    def running(_):
        if more := later.pop(0):
            with StudyStore.write(path, IDENTITY) as store:
                store.append(more)
        return bool(later)

    monkeypatch.setattr("jumpcad.search.study.database.is_written", running)
    monkeypatch.setattr(command.time, "sleep", waited.append)
    command._watch(path)
    lines = capsys.readouterr().out.splitlines()
    assert [line.partition(",")[0] for line in lines] == ["3 designs", "5 designs"]
    assert waited == [command.WATCH_S] * 3


def test_it_is_for_one_study_and_for_people(folder):
    assert "--watch is for one study" in refusal("study", "a.db", "b.db", "--watch")
    assert "--watch is for one study" in refusal("study", "a.db", "--watch", "--json")
