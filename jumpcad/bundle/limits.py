"""The limits of a robot as bars of use, the violated ones first, for report.html."""

from collections.abc import Iterable, Iterator, Sequence
from html import escape

from jumpcad.exporters.xml import allowed
from jumpcad.findings import SHOWN_AS, Finding

SHOWN = 3
"""How many limits are named at the top of the page."""
WIDEST = 1.25
"""Use at which a bar has its full length; longer bars are cut off."""
AT_LIMIT = 5e-4
"""Largest difference of a use from 1, or of a margin from 0, that is shown as "at the limit", where sizing ends.

A margin of exactly 0 is that of a condition that holds or does not, and is not shown so.
"""


def limits(findings: Sequence[Finding]) -> Iterator[str]:
    """Yield the section of limits: violated ones, those with a use from the highest on, then the others."""
    violated = sum(finding.severity != "info" for finding in findings)
    yield "<h2>Limits</h2>"
    yield (
        f"<p>{violated} of {len(findings)} are violated. A bar shows how much of a limit is used; "
        "the mark is the limit. "
    )
    yield "<code>jumpcad check</code> also looks at printability, and at interference over the whole motion.</p>"
    near = [finding for finding in ordered(findings) if _near(finding)]
    far = [finding for finding in ordered(findings) if not _near(finding)]
    yield from _table(near)
    if far:
        yield f"<details><summary>{len(far)} more hold: less than half used, or a condition that is met</summary>"
        yield from _table(far)
        yield "</details>"


def _near(finding: Finding) -> bool:
    """Tell whether a limit is shown without asking: violated, used by half or more, or just reached."""
    used = _used(finding) == "at the limit" if finding.use is None else finding.use >= 0.5
    return finding.severity != "info" or used


def _table(findings: Iterable[Finding]) -> Iterator[str]:
    yield '<table class="limits"><tr><th>limit</th><th>use</th><th>found</th></tr>'
    for finding in findings:
        yield f'<tr class="{finding.severity}"><td>{escape(finding.name)}</td><td>{_bar(finding)}</td>'
        yield f"<td>{escape(allowed(_words(finding)))}</td></tr>"
    yield "</table>"


def tightest(findings: Sequence[Finding]) -> Iterator[str]:
    """Yield the list of violated limits and those of the highest use, `SHOWN` at most."""
    nearest = [finding for finding in ordered(findings) if finding.severity != "info" or finding.use is not None]
    yield "<p>Tightest limits:</p><ul>"
    for finding in nearest[:SHOWN]:
        yield f'<li class="{finding.severity}">{escape(finding.name)}, {_used(finding)}: '
        yield f"{escape(allowed(_words(finding)))}</li>"
    yield "</ul>"


def ordered(findings: Iterable[Finding]) -> list[Finding]:
    """Return errors, warnings and the rest, each with the highest use first."""
    order = ("error", "warning", "info")
    return sorted(findings, key=lambda one: (order.index(one.severity), -(one.use if one.use is not None else -1.0)))


def _words(finding: Finding) -> str:
    if finding.severity == "info":
        return finding.message
    return f"{finding.severity}: {finding.message}: {finding.remedy}"


def _used(finding: Finding) -> str:
    """Return how much of a limit is used, in words."""
    if finding.use is None:
        if 0.0 < abs(finding.margin) < AT_LIMIT:
            return "at the limit"
        if finding.margin == 0.0 and not finding.unit:
            return "holds" if finding.severity == "info" else "does not hold"
        unit, factor = SHOWN_AS.get(finding.unit, (finding.unit, 1.0))
        return f"margin {factor * finding.margin:.3g} {unit}".strip()
    return "at the limit" if abs(finding.use - 1.0) < AT_LIMIT else f"{100.0 * finding.use:.0f} % used"


def _bar(finding: Finding) -> str:
    if finding.use is None:
        return escape(_used(finding))
    width = 100.0 * min(finding.use, WIDEST) / WIDEST
    return f'<span class="bar"><span style="width: {width:.1f}%"></span></span> {escape(_used(finding))}'
