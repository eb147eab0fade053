"""Verdicts as GitHub shows them: annotations of the lines of a pull request, and a summary of the job.

Workflow commands are lines that the runner finds in the log of a step.
"""

from collections.abc import Iterator
from hashlib import sha256

from rovercheck.checker.render.ci import CiFinding, CiReport, FindingLevel, counts, explained

MOST = 10
"""Annotations of a kind that GitHub keeps of a step."""
_KINDS = {
    FindingLevel.REJECTED: "error",
    FindingLevel.FAILED: "error",
    FindingLevel.OPEN: "warning",
    FindingLevel.EXPIRED: "warning",
    FindingLevel.KNOWN: "notice",
}
_SIGNS = {FindingLevel.REJECTED: "💥", FindingLevel.FAILED: "❌", FindingLevel.OPEN: "❔"}
BUDGET = 500_000
"""Characters of the runs in a summary, of which GitHub takes 1 MiB in all."""


def annotations(report: CiReport) -> str:
    """One annotation for each verdict that did not simply pass; what exceeds ``MOST`` of a kind is counted.

    What failed is explained in the log, in a group that opens on a click.
    """
    lines: list[str] = []
    for finding in report.worst_first():
        if finding.level in (FindingLevel.REJECTED, FindingLevel.FAILED, FindingLevel.OPEN):
            lines += [f"::group::{_data(finding.headline)}", *_log(explained(finding)), "::endgroup::"]
    for kind in ("error", "warning", "notice"):
        lines += _of_kind(kind, [f for f in report.worst_first() if _KINDS.get(f.level) == kind])
    if not report.complete:
        lines.append(command("error", report.missing, title=f"rovercheck was {report.end}"))
    return "".join(f"{line}\n" for line in lines)


def _of_kind(kind: str, findings: list[CiFinding]) -> Iterator[str]:
    fits = len(findings) <= MOST
    for finding in findings if fits else findings[: MOST - 1]:
        yield annotation(kind, finding)
    if not fits:
        rest = findings[MOST - 1 :]
        names = ", ".join(f.id for f in rest)
        yield command(kind, f"Not shown one by one: {names}", title=f"{len(rest)} more of this kind")


def annotation(kind: str, finding: CiFinding) -> str:
    """An annotation of the line at which the property is written; ``kind`` is error, warning or notice."""
    message = [finding.says, finding.gravity, finding.evidence]
    message += [f"Why: {finding.because}" if finding.because else ""]
    message += [f"Decision: {finding.decision}" if finding.decision else ""]
    message += [f"Show it: {finding.shown_with}"] if finding.trace is not None else []
    place = finding.place
    at = {"file": place.path, "line": str(place.line)} if place is not None else {}
    return command(kind, "\n".join(filter(None, message)), **at, title=finding.headline)


def command(kind: str, message: str, **properties: str) -> str:
    """``::error file=a.py,line=3,title=T::message`` with what has a meaning there escaped."""
    shown = ",".join(f"{name}={_property(value)}" for name, value in properties.items())
    return f"::{kind} {shown}::{_data(message)}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")


def _log(text: str) -> Iterator[str]:
    """Lines of a log in which the runner looks for no command until it meets the token.

    It finds commands behind blanks, and those of its older kind within a line, so that they cannot be
    escaped.  No text holds the token, which is computed from all of it.
    """
    token = sha256(text.encode(errors="replace")).hexdigest()
    yield f"::stop-commands::{token}"
    yield from text.splitlines()
    yield f"::{token}::"


def summary(report: CiReport) -> str:
    """The job's summary in Markdown: counts, what is not as expected, and the runs that show it."""
    lines = ["### rovercheck", "", f"{len(report.findings):,} properties: {counts(report.findings)}."]
    lines += [] if report.complete else ["", f"**{report.missing}**"]
    told = [
        f
        for f in report.worst_first()
        if f.level in (FindingLevel.REJECTED, FindingLevel.FAILED, FindingLevel.OPEN)
    ]
    known = sum(f.level in (FindingLevel.KNOWN, FindingLevel.EXPIRED) for f in report.findings)
    lines += ["", f"{known:,} findings are as expected."] if known else []
    over = [f"{f.id} ({f.accepted.term})" for f in report.worst_first() if f.lapsed and f.accepted]
    lines += ["", f"No longer accepted: {', '.join(map(_cell, over))}."] if over else []
    if not told:
        return "\n".join([*lines, "", "Every verdict is as expected." if report.complete else "", ""])
    lines += ["", "| | Property | Now | Expected | Says |", "|---|---|---|---|---|"]
    for f in told:
        now = "proof rejected" if f.level is FindingLevel.REJECTED else f.word
        cells = [_SIGNS[f.level], *map(_cell, (f.id, now, f.recorded, f.text))]
        lines.append(f"| {' | '.join(cells)} |")
    left = BUDGET
    for finding in told:
        text = explained(finding)
        left -= len(text)
        if left < 0:
            lines += ["", "The other runs are in the log."]
            break
        lines += [
            "",
            f"<details><summary>{_cell(finding.headline)}</summary>",
            "",
            *_block(text),
            "",
            "</details>",
        ]
    return "\n".join([*lines, ""])


def _block(text: str) -> list[str]:
    fence = "```"
    while fence in text:
        fence += "`"
    return [fence, text, fence]


def _cell(text: str) -> str:
    plain = " ".join(text.split()).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return plain.replace("|", "&#124;")
