"""A trace as a Markdown page for reports: the same story as the terminal table."""

from xml.sax.saxutils import escape

from rovercheck.checker.render.periods import RepeatedTicks, folded
from rovercheck.checker.render.reasons import cause, meaning, reasons
from rovercheck.checker.render.story import (
    OMITTED,
    Quiet,
    Repeats,
    Row,
    StoryEvent,
    conjuncts,
    ending,
    heading,
    standstill,
    start_of,
    start_values,
)
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Trace

FORMAT = Format("markdown", "trace", ".md", "Markdown table with the same rows as the terminal table")

SPECIAL = str.maketrans({c: f"\\{c}" for c in "\\`*_{}[]<>|#"})


def render(trace: Trace) -> str:
    """The page's part about one run, without a heading of its own."""
    because = trace.property.because
    lines = [f"**Why:** {_plain(because)}", ""] if because else []
    lines += [_plain(heading(trace)) + ".", ""]
    if chosen := start_values(trace):
        lines += ["Fixed for the whole run: " + ", ".join(_code(f"{n} = {v}") for n, v in chosen) + ".", ""]
    lines += ["| Tick | ms | Inputs | Changes | Transitions that fired |", "|---:|---:|---|---|---|"]
    lines += [_row(trace, row) for row in folded(trace)]
    lines += ["", f"**{_plain(last)}**"] if (last := ending(trace)) else []
    lines += ["", OMITTED]
    for part in conjuncts(trace):
        lines += ["", f"**{part.verdict}:** {_code(part.name or part.formula)}"]
        if part.true:
            continue
        lines += ["", f"which stands for {_code(part.formula)}"] if part.name else []
        lines += ["", "with " + ", ".join(_code(f"{n} = {v}") for n, v in part.values)] if part.values else []
    if said := reasons_table(trace):
        lines += ["", *([f"**{cause(trace)}**", ""] if trace.needed() else []), *said]
    return "\n".join([*lines, ""])


def reasons_table(trace: Trace) -> list[str]:
    """The inputs that determine the end as a table, and what that means; none if not examined."""
    if not (said := meaning(trace)):
        return []
    rows = [f"| {r.when} | {r.ms} | {_code(r.what)} |" for r in reasons(trace, regular=True)]
    return [*(["| Ticks | ms | Input |", "|---|---:|---|", *rows, ""] if rows else []), _plain(said)]


def _row(trace: Trace, row: Row | RepeatedTicks) -> str:
    match row:
        case StoryEvent():
            return _event(trace, row)
        case Quiet() | RepeatedTicks():
            return f"| … | | | *{_plain(row.what)}* | |"
        case Repeats():
            return f"| ↻ | | | **{_plain(row.what)}** | |"


def _event(trace: Trace, event: StoryEvent) -> str:
    inputs = [_code(str(c)) + (" needed" if c.needed else "") for c in event.changes if c.is_input]
    others = [_code(str(c)) for c in event.changes if not c.is_input]
    others += [f"*{said}*"] if (said := standstill(trace, event)) else []
    transitions = [
        f"{_plain(a.chart)}: {_plain(start_of(a))}" + (f"<br>{_code(a.label)}" if a.label else "")
        for a in event.transitions
    ]
    cells = [str(event.number), str(event.ms), *("<br>".join(c) for c in (inputs, others, transitions))]
    return "| " + " | ".join(cells) + " |"


def _code(shown: str) -> str:
    """Inline code in a table cell: a bar would end the cell even here, a backtick the code."""
    return f"<code>{escape(shown).replace('|', '&#124;')}</code>"


def _plain(shown: str) -> str:
    return shown.translate(SPECIAL)
