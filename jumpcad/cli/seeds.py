"""`jumpcad optimize --seeds`: the same search with many seeds, and methods against each other."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from statistics import median
from typing import Annotated, Any

from jumpcad import search
from jumpcad.cli.output import console, table
from jumpcad.cli.subjects import Text, option
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError, without_controls
from jumpcad.search.methods import FRONTS

SEEDS = "A search with each of these seeds: 0:10 for 0 to 9. Methods are compared."
SeedsOption = Annotated[Text, option(SEEDS, "FIRST:END")]
MOST_SEEDS = 1000


def seeds_of(text: str | None, methods: Sequence[str], seed_given: bool) -> range | None:
    """Return the seeds that are asked for; None for one search."""
    if text is None:
        if len(methods) > 1:
            raise JumpcadError(f"{' '.join(methods)}: methods are compared by several searches; add --seeds 0:5")
        return None
    if seed_given:
        raise JumpcadError(f"seeds = {text} and --seed exclude each other: leave out one")
    found = re.fullmatch(r"(\d{1,10}):(\d{1,10})", text, re.ASCII)
    seeds = range(*map(int, found.groups())) if found else range(0)
    if not 0 < len(seeds) <= MOST_SEEDS or seeds[-1] >= 2**32:
        raise JumpcadError(f"seeds = {text!r} must be FIRST:END, 1 to {MOST_SEEDS} seeds: 0:10 for seeds 0 to 9")
    for method in methods:
        if methods.count(method) > 1 or method in FRONTS:
            raise JumpcadError(f"{method}: --seeds takes each method once, and no front, as that has no best score")
    return seeds


def study_files(requests: Sequence["search.Request"], study: Path | None) -> list[Path]:
    """Return a study file for each search: the usual name, or that of `study` with the method if there are several."""
    several, files = len({one.method for one in requests}) > 1, []
    for one in requests:
        base = study or Path(replace(one, seed=0).default_name())
        method = f"-{one.method.replace('+', '-')}" if study and several else ""
        files.append(base.with_stem(f"{base.stem}{method}-seed{one.seed}"))
    return files


def most_robust(results: Sequence["search.Result"]) -> int:
    """Return which search has the best winner: of those whose neighbours were tried, by what these reach."""

    def merit(one: "search.Result") -> tuple[bool, bool, float]:
        if one.winner is None or not one.candidates:
            return False, one.winner is not None, one.score if one.winner else 0.0
        return True, not one.candidates[0].fails, one.candidates[0].robust_score

    return max(range(len(results)), key=lambda index: merit(results[index]))


def seeds_facts(results: Sequence["search.Result"], paths: Sequence[Path]) -> dict[str, Any]:
    """Return plain data for JSON: the figures of each search, and of each method.

    A search without a jump is the worst: a median or a least score that falls on it is not finite.
    """
    searches: list[dict[str, Any]] = []
    scores: dict[str, list[float]] = {}
    for one, path in zip(results, paths, strict=True):
        best, winner, request = one.best, one.winner, one.request
        scores.setdefault(request.method, []).append(-math.inf if best is None or best.score is None else best.score)
        searches.append({
            "method": request.method, "seed": request.seed, "searched": len(one.trials),
            "best": best and best.score, "winner": winner and winner.score,
            "robust_score": one.candidates[0].robust_score if one.candidates else None, "study": str(path),
        })  # fmt: skip
    first = max(scores, key=lambda method: median(scores[method]))
    methods = [
        {"method": method, "searches": len(found), "median": median(found), **_interval(found), "best": max(found),
         "least": min(found), "spread": max(found) - min(found),
         "p": None if method == first else _same(found, scores[first], len(scores) - 1)}
        for method, found in scores.items()
    ]  # fmt: skip
    return {"searches": searches, "methods": methods}


def _interval(scores: Sequence[float]) -> dict[str, float | None]:
    """Return the 95 % confidence interval of the median, whatever the scores' distribution; none of under 6 scores.

    By order statistics: at least 95 of 100 such intervals hold the median of all seeds.
    """
    from scipy.stats import quantile_test

    found = quantile_test(scores).confidence_interval(0.95)
    low, high = (None if math.isnan(one) else float(one) for one in (found.low, found.high))
    return {"median_from": low, "median_to": None if low is None else high}


def _same(scores: Sequence[float], others: Sequence[float], comparisons: int) -> float:
    """Return the probability that two equal methods differ so much in rank (Mann, Whitney), times the comparisons."""
    from scipy.stats import mannwhitneyu

    return min(1.0, comparisons * float(mannwhitneyu(scores, others).pvalue))


def print_seeds(facts: Mapping[str, Any], chosen: int, objective: str) -> None:
    """Print a table of all searches, one of the methods, and whose winner is the best."""
    each = table("method", ">seed", ">designs", ">best", ">winner", ">neighbours", "study", wraps="study")
    whole = table("method", ">searches", ">median", ">from", ">to", ">best", ">least", ">p")
    for row in facts["searches"]:
        each.add_row(*map(_cell, row.values()))
    for row in facts["methods"]:
        p = "–" if row["p"] is None else f"{row['p']:.2g}"
        whole.add_row(*(_cell(value) for name, value in row.items() if name not in ("spread", "p")), p)
    print(f"\n{objective}: best of each search, its winner, what nine of ten of the winner's neighbours reach")
    console().print(each, "", whole, sep="\n")
    seeds = facts["methods"][0]["searches"]
    least = "" if seeds >= 6 else "; it takes 6"
    print(f"from, to: 95 % confidence interval of the median, by {counted(seeds, 'seed')}{least}")
    if len(facts["methods"]) > 1:
        print(
            f"p: chance that a method as good as the one with the highest median falls so far behind it with {seeds} "
            "seeds each (Mann–Whitney rank test, two-sided, times the comparisons); below 0.05 it is probably worse"
        )
    best = facts["searches"][chosen]
    if best["winner"] is not None:
        print(f"\nthe most robust winner is that of {best['method']} with seed {best['seed']}:")


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else "none"
    return "none" if value is None else without_controls(str(value))
