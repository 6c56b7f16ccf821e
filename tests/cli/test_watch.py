"""`study --watch`, which follows a running search."""

import threading
import time

from support.hills import SMALL, Hill
from support.searches import refusal, run

from jumpcad.cli import study as command
from jumpcad.search.study.database import is_written
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import run_study


def test_it_follows_a_search_until_it_ends(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(command, "WATCH_S", 0.05)
    path = tmp_path / "s.db"

    def search():
        with local_pool(0) as pool:
            run_study(Request(SMALL, Hill(pause_s=0.02), method="ga", evaluations=60), path, pool)

    running = threading.Thread(target=search)
    running.start()
    while running.is_alive() and not (is_written(path) and path.stat().st_size):
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


def test_it_is_for_one_study_and_for_people(folder):
    assert "--watch is for one study" in refusal("study", "a.db", "b.db", "--watch")
    assert "--watch is for one study" in refusal("study", "a.db", "--watch", "--json")
