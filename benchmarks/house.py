"""Draw what packages import, in an older tree and in this one: benchmarks/house.py TREE docs/pictures/house.png."""

import re
import sys
import tomllib
from collections import Counter
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from PIL import Image
from structure import imports, modules_in

THINGS = {"cage": "C0", "stop": "C1", "sensor": "C2", "foot|toes|pads": "C3", "leg|links|leg_bars?": "C4"}
FEWEST, INK = 4, "#30506b"


def draw(axes: Axes, root: Path, title: str) -> None:
    """Draw packages above those that they import, what all use below, and a mark for each file named after a thing."""
    texts = {name: path.read_text("utf-8") for name, path in modules_in(root / "jumpcad").items()}
    of = {name: name.split(".")[1] for name in texts if "." in name}
    rules = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]["contracts"][0]
    order = [name for layer in reversed(rules["layers"]) for name in layer.split(" | ")]
    base, upper = order[: order.index("mechanism") + 1], order[order.index("mechanism") + 1 :]
    pairs = Counter((of[one], of[low]) for one in of for low in imports(one, texts[one], texts) if of.get(low) in upper)
    row = {name: -1.2 - i // 6 for i, name in enumerate(base)}
    for name in upper:
        row[name] = 1.0 + max((row[low] for high, low in pairs if high == name != low), default=-1.0)
    shown = {pair: number for pair, number in sorted(pairs.items()) if number >= FEWEST and pair[0] != pair[1]}
    place = {name: 0.86 * (i % 6) - 2.15 for i, name in enumerate(base)} | spread(upper, row, shown)
    for (high, low), number in shown.items():
        style = {"arrowstyle": "-|>", "lw": number / 8, "color": INK, "alpha": 0.6, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (place[low], row[low] + 0.3), (place[high], row[high] - 0.3), arrowprops=style)
    for name in order:
        ours = [one for one in of if of[one] == name]
        text = f"{name}\n{sum(texts[one].count(chr(10)) for one in ours):,}"
        box = {"boxstyle": "round,pad=0.2", "fc": "white" if name in upper else "#e8e8e8", "ec": INK}
        axes.text(place[name], row[name], text, ha="center", va="center", fontsize=8, bbox=box)
        marks = [THINGS[kind] for one in ours for kind in THINGS if re.search(rf"\.({kind})(\.|$)", one)]
        along = place[name] + 0.07 * (np.arange(len(marks)) - (len(marks) - 1) / 2)
        axes.scatter(along, np.full(len(marks), row[name] - 0.37), 22, marks, ec="w", zorder=4)
    axes.set(xlim=(-2.6, 2.6), ylim=(min(row.values()) - 0.5, max(row.values()) + 0.5), title=title)
    axes.axis("off")


def spread(names: list[str], row: dict[str, float], arrows: dict[tuple[str, str], int]) -> dict[str, float]:
    """Return where in its row each package stands, such that few arrows run behind others; sought at random."""
    rng, y, weight = np.random.default_rng(0), np.array([row[name] for name in names]), np.array([*arrows.values()])
    high, low = np.array([[names.index(name) for name in pair] for pair in arrows]).T
    share = (y[high][:, None] - y) / (y[high] - y[low])[:, None]
    best, least = np.zeros(len(names)), np.inf
    for _ in range(50000):
        x = np.where(rng.random(len(names)) < 1.5 / len(names), rng.integers(-4, 5, len(names)) * 0.55, best)
        hidden = np.abs(x[high][:, None] + share * (x[low] - x[high])[:, None] - x) < 0.42
        cost = weight @ ((hidden & (share > 0) & (share < 1)).sum(1) + 0.1 * np.abs(x[high] - x[low]))
        cost += 1e3 * ((np.abs(x[:, None] - x) < 0.9) & (y[:, None] == y)).sum()
        best, least = (x, cost) if cost <= least else (best, least)
    return dict(zip(names, best, strict=True))


if __name__ == "__main__":
    figure, (before, now) = plt.subplots(1, 2, figsize=(14, 11), layout="constrained")
    draw(before, Path(sys.argv[1]), "before")
    draw(now, Path(__file__).parents[1], "now")
    for place, (kind, colour) in enumerate(THINGS.items()):
        before.annotate(f"● {kind.split('|')[0]}", (0.0, 0.98 - 0.02 * place), xycoords="axes fraction", color=colour)
    figure.savefig(sys.argv[2], dpi=90)
    Image.open(sys.argv[2]).quantize(128, Image.Quantize.FASTOCTREE).save(sys.argv[2], optimize=True)
