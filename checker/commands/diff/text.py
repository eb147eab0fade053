"""What changed between two revisions, as text and as Markdown for a pull request."""

from collections.abc import Iterator, Sequence

from rovercheck.checker.commands.diff.document import ORDER, DiffDocument, How, VerdictChange
from rovercheck.checker.commands.shared.output import counted, text_width
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.render.trace_markdown import SPECIAL
from rovercheck.checker.results.trace import counted_ticks

HEADINGS: dict[How, str] = {
    "worse": "Worse",
    "gone": "Gone",
    "better": "Better",
    "other run": "Violated or reached as before, by a run of another length",
    "new": "New",
}
SIGNS = {"proved": "✓", "violated": "✗", "unknown": "?", None: "-"}


def text(found: DiffDocument) -> str:
    """For a terminal."""
    lines = [filled(_counts(found), text_width())]
    for line in sections(found["changes"]):
        lines += ["", line] if line.endswith(":") and not line.startswith(" ") else [line]
    if found["run"]:
        lines += ["", "The shortest new run:", "", found["run"]]
    return "\n".join(lines) + "\n"


def sections(found: Sequence[VerdictChange]) -> Iterator[str]:
    """What changed, in lines below a heading for each kind."""
    for how, rows in _by_kind(found):
        yield f"{HEADINGS[how]}:"
        for row in rows:
            yield f"{SIGNS[row['after']]} {row['id']:<21} {_verdicts(row)}"
            yield from (f"    {line}" for line in filled(row["text"], text_width() - 4).splitlines())


def markdown(found: DiffDocument) -> str:
    """For a pull request."""
    lines = [_counts(found).translate(SPECIAL)]
    for how, rows in _by_kind(found["changes"]):
        lines += ["", f"**{HEADINGS[how]}**", "", "| Property | Verdict | It says |", "|---|---|---|"]
        lines += [f"| {row['id']} | {_verdicts(row)} | {row['text'].translate(SPECIAL)} |" for row in rows]
    if found["run"]:
        lines += ["", "<details><summary>The shortest new run</summary>", "", found["run"], "", "</details>"]
    return "\n".join(lines) + "\n"


def _by_kind(found: Sequence[VerdictChange]) -> list[tuple[How, list[VerdictChange]]]:
    kinds = ((how, [one for one in found if one["how"] == how]) for how in ORDER)
    return [(how, rows) for how, rows in kinds if rows]


def _counts(found: DiffDocument) -> str:
    """``From 3f2a1c0 to the working tree: 1 verdict is worse, ...``."""
    said = [_count(rows, how) for how, rows in _by_kind(found["changes"])]
    later = found["after"] or "the working tree"
    same = counted(found["same"], "verdict is", "verdicts are")
    changed = ", ".join(said) if said else "nothing changed"
    return f"From {found['before']} to {later}: {changed}; {same} the same."


def _count(rows: Sequence[VerdictChange], how: How) -> str:
    names: dict[How, tuple[str, str]] = {
        "worse": ("verdict is worse", "verdicts are worse"),
        "gone": ("property is gone", "properties are gone"),
        "better": ("verdict is better", "verdicts are better"),
        "other run": ("run is of another length", "runs are of another length"),
        "new": ("property is new", "properties are new"),
    }
    return counted(len(rows), *names[how])


def _verdicts(row: VerdictChange) -> str:
    """``proved -> violated in 8 ticks``."""
    words = " → ".join(word for word in (row["before"], row["after"]) if word)
    after, before = row["ticks_after"], row["ticks_before"]
    if row["how"] == "other run" and before is not None and after is not None:
        return f"{words.split(' ')[0]}: {counted_ticks(before)} → {counted_ticks(after)}"
    return words + (f" in {counted_ticks(after)}" if after is not None else "")
