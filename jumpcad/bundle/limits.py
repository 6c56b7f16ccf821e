"""The limits of a robot as bars of use in one order, the violated ones first, for report.html."""

from collections.abc import Iterable, Iterator, Sequence
from html import escape

from jumpcad.checks import COSTLY
from jumpcad.exporters.xml import allowed
from jumpcad.findings import SHOWN_AS, Finding, errors

SHOWN = 3
"""How many limits are named at the top of the page."""
JUST = "at the limit"
WIDEST = 1.25
"""Use at which a bar has its full length; longer bars are cut off."""
AT_LIMIT = 5e-4
"""Largest difference of a use from 1, or of a margin from 0, that is shown as "at the limit", where sizing ends.

A margin of exactly 0 is that of a condition that holds or does not, and is not shown so.
"""


def limits(findings: Sequence[Finding]) -> Iterator[str]:
    """Yield the section of limits: violated ones, those kept by their use from the highest on, those without a share.

    What is kept and used by less than half stands behind a heading that opens.
    """
    violated, kept, without = _groups(findings)
    yield '<h2 id="limits">Limits</h2>'
    yield (
        f"<p>{len(violated)} of {len(findings)} are violated. A bar shows how much of a limit is used; "
        "the mark is the limit. "
    )
    yield f"<code>jumpcad check</code> also looks at {COSTLY}.</p>"
    yield from _table([*violated, *(finding for finding in kept if _use(finding) >= 0.5)])
    if far := [finding for finding in kept if _use(finding) < 0.5]:
        yield f"<details><summary>{len(far)} more are kept, less than half used</summary>"
        yield from _table(far)
        yield "</details>"
    if without:
        yield f"<details{_open(without)}><summary>{len(without)} more are kept and have no share</summary>"
        yield from _table(without)
        yield "</details>"


def verdict_on(findings: Sequence[Finding]) -> tuple[list[str], list[str]]:
    """Return what the top of the page says of limits: a sentence on the violated ones, and a list of the first."""
    violated, kept, _ = _groups(findings)
    if not violated:
        more = f"<code>jumpcad check</code> also looks at {COSTLY}"
        return [], [f"<p>All {len(findings)} limits are kept; {more}. The tightest:</p>", *_list(kept)]
    forbids = bool(errors(violated))
    more = f"The worst of {len(violated)} violated limits" if len(violated) > SHOWN else "Violated"
    return (
        [f'<p class="{"error" if forbids else "warning"}">{violation(findings)}.</p>'],
        [f'<p>{more}; <a href="#limits">Limits</a> says what to change:</p>', *_list(violated)],
    )


def violation(findings: Sequence[Finding]) -> str:
    """Return how many limits are violated, and whether to build the robot; empty where none is."""
    violated = [finding for finding in findings if finding.severity != "info"]
    if not violated:
        return ""
    are = "is" if len(violated) == 1 else "are"
    means = "do not build it as it is" if errors(violated) else "it can be built, but read the warnings first"
    return f"{len(violated)} of its {len(findings)} limits {are} violated: {means}"


def _list(findings: Sequence[Finding]) -> Iterator[str]:
    yield "<ul>"
    for finding in findings[:SHOWN]:
        yield f'<li><b class="{finding.severity}">{escape(finding.name)}</b>, {escape(used(finding))}: '
        yield f"{escape(allowed(finding.message))}</li>"
    yield "</ul>"


def _groups(findings: Iterable[Finding]) -> tuple[list[Finding], list[Finding], list[Finding]]:
    """Return what is violated, what is kept and has a use, and what is kept and has none, each `ordered`."""
    every = ordered(findings)
    kept = [finding for finding in every if finding.severity == "info"]
    return (
        [finding for finding in every if finding.severity != "info"],
        [finding for finding in kept if finding.use is not None],
        [finding for finding in kept if finding.use is None],
    )


def ordered(findings: Iterable[Finding]) -> list[Finding]:
    """Return the violated limits, then the others; each from the highest use on, then what has no use."""
    return sorted(findings, key=lambda one: (one.severity == "info", one.use is None, -_use(one), used(one) != JUST))


def _use(finding: Finding) -> float:
    return finding.use or 0.0


def _open(findings: Iterable[Finding]) -> str:
    """Return the attribute that shows a group at once: where one of it is just kept."""
    return ' open="open"' if any(used(finding) == JUST for finding in findings) else ""


def _table(findings: Sequence[Finding]) -> Iterator[str]:
    if not findings:
        return
    yield '<table class="limits"><tr><th>limit</th><th>use</th><th>found</th></tr>'
    for finding in findings:
        yield f'<tr class="{finding.severity}"><td>{escape(finding.name)}</td><td>{_bar(finding)}</td>'
        yield f"<td>{_words(finding)}</td></tr>"
    yield "</table>"


def _words(finding: Finding) -> str:
    """Return what was found, as HTML; of a violated limit also what to change."""
    message, remedy = escape(allowed(finding.message)), escape(allowed(finding.remedy))
    return message if finding.severity == "info" else f"{finding.severity}: {message}<br />What to change: {remedy}"


def used(finding: Finding) -> str:
    """Return how much of a limit is used, in words; the margin of one without a share."""
    if finding.use is None:
        if 0.0 < abs(finding.margin) < AT_LIMIT:
            return JUST
        if finding.margin == 0.0 and not finding.unit:
            return "holds" if finding.severity == "info" else "does not hold"
        unit, factor = SHOWN_AS.get(finding.unit, (finding.unit, 1.0))
        return f"margin {factor * finding.margin:.3g} {unit}".strip()
    return JUST if abs(finding.use - 1.0) < AT_LIMIT else f"{100.0 * finding.use:.0f} % used"


def _bar(finding: Finding) -> str:
    """Return the use as a bar and in words; where there is none, what is known, and why there is no share."""
    if finding.use is None:
        return f"{escape(used(finding))}<br /><small>{_why_no_share(finding)}</small>"
    width = 100.0 * min(finding.use, WIDEST) / WIDEST
    return f'<span class="bar"><span style="width: {width:.1f}%"></span></span> {escape(used(finding))}'


def _why_no_share(finding: Finding) -> str:
    if finding.margin == 0.0 and not finding.unit:
        return "no share: a condition, kept or not"
    if finding.value is None or finding.limit is None:
        return "no share: given as a margin"
    return "no share: the limit is 0" if finding.limit == 0.0 else "no share of a figure below 0"
