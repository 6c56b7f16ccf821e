"""`jumpcad study`, with the capsule robot."""

import re
from pathlib import Path

from support.searches import QUICK, data, refusal, run


def test_studies_compare_and_export(folder, monkeypatch):
    for seed in (0, 1):
        run("optimize", "ga", *QUICK, "--evaluations", 20, "--seed", seed, "--study", f"{seed}.db")
    assert len(run("study", "0.db", "1.db").strip().splitlines()) == 2
    assert [one["identity"]["seed"] for one in data("study", "0.db", "1.db")["studies"]] == [0, 1]
    run("study", "0.db", "--export", "t.csv")
    rows = (folder / "t.csv").read_text().count("\n") - 1
    assert rows >= 20
    summary = data("study", "0.db")
    assert summary["evaluations"] + summary["other_evaluations"] == rows
    ranks = re.findall(r"^ *(\d+)\. ", run("study", "0.db", "--list", 3), re.M)
    assert ranks == ["1", "2", "3"]
    for option, place in (("--export", "u.csv"), ("--plots", "u")):
        assert "--export and --plots are for one study" in refusal("study", "0.db", "1.db", option, place)
    drawn = []
    monkeypatch.setattr("jumpcad.search.plot_study", lambda store, pics, _: drawn.append(pics) or [pics / "a"])
    assert data("study", "0.db", "--plots", "pics") == summary | {"pictures": ["pics/a"]}
    assert "pictures" not in summary
    assert drawn == [Path("pics")]
