"""The message sequence as an SVG picture: lifelines, messages, notes, quiet stretches, the end."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from xml.sax.saxutils import escape

from rovercheck.checker.render.drawing.svg import document, tag, text
from rovercheck.checker.render.drawing.svg import lines as paragraph
from rovercheck.checker.render.drawing.text import LINE, SIZE, width, wrap
from rovercheck.checker.render.durations import duration
from rovercheck.checker.render.reasons import determined_by
from rovercheck.checker.render.sequence.steps import (
    Message,
    MessageSequence,
    Pause,
    SequenceNote,
    SequenceStep,
)
from rovercheck.checker.render.story import Repeats, ending, false_parts, heading
from rovercheck.checker.results.trace import Trace

LEFT, MARGIN = 84, 16
"""Pixels left of the first lifeline's column, for the time, and at the edges."""
WIDE = 1160
"""Pixels that all columns have together if they can."""
LEAST, MOST = 170, 340
"""Pixels of a column."""
LETTER = 6.4
"""Pixels of an average letter."""
TOLD = 6
"""Lines of a message or note that are shown; the others are counted, and told in its tooltip."""
GAP = 9
STYLE = (
    ".title{font-size:15px;font-weight:bold}.sentence{font-size:13px}.soft{fill:#4f5768}text{fill:#1d2433}"
    ".head{fill:#eef1f7;stroke:#1d2433}.name{font-weight:bold}.life{stroke:#8a90a0;fill:none}"
    ".pause{stroke:#8a90a0;fill:none;stroke-dasharray:2 5}.row{stroke:#dfe3ec;fill:none}"
    ".arrow{stroke:#1f4e9c;stroke-width:1.6;fill:none}.tip{fill:#1f4e9c}.lost{stroke-dasharray:5 3}"
    ".cross{stroke:#a3122b;stroke-width:2;fill:none}.note{fill:#fffdf3;stroke:#8a90a0}"
    ".halo{paint-order:stroke;stroke:#ffffff;stroke-width:4px;stroke-linejoin:round}"
    ".gap{fill:#ffffff}.loop{fill:none;stroke:#5b4b9c;stroke-width:1.5}.tab{fill:#ece9f6;stroke:#5b4b9c}"
    ".end{fill:#fbeaec;stroke:#a3122b;stroke-width:1.5}.wrong{fill:#a3122b;font-weight:bold}"
)


@dataclass(frozen=True)
class SequenceColumns:
    """Where lifelines are across the picture."""

    names: tuple[str, ...]
    apart: int

    def x(self, name: str) -> int:
        return LEFT + self.apart // 2 + self.apart * self.names.index(name)

    @property
    def right(self) -> int:
        return LEFT + self.apart * len(self.names)


Piece = tuple[list[str], int]
"""Drawn elements, and the y below them."""


def picture(trace: Trace, sequence: MessageSequence) -> str:
    """The SVG document."""
    count = len(sequence.lifelines)
    columns = SequenceColumns(sequence.lifelines, max(LEAST, min(MOST, WIDE // count)))
    wide = max(columns.right, 560) + MARGIN
    titles, y = _titles(trace, wide)
    heads, y = _heads(columns, y)
    start = y
    body: list[str] = []
    pauses: list[tuple[int, int]] = []
    loop = 0
    for step in sequence.steps:
        match step:
            case SequenceStep():
                drawn, y = _step(columns, step, y)
            case Pause():
                drawn, below = _pause(columns, step, trace.ms(step.last) - trace.ms(step.first - 1), y)
                pauses.append((y, below))
                y = below
            case Repeats():
                loop, drawn, y = y + 6, [], y + 28
        body += drawn
    body += _loop(columns, loop, y) if loop else []
    lines = [line for name in columns.names for line in _lifeline(columns.x(name), start, y, pauses)]
    end, bottom = _end(trace, sequence, columns, y)
    name = f"{trace.property.id or trace.system.name}: messages"
    return document(wide, bottom + 12, STYLE, name, [*titles, *lines, *heads, *body, *end])


def _titles(trace: Trace, wide: int) -> Piece:
    shown = [(trace.property.id, "title", 15)] if trace.property.id else []
    shown += [(line, "sentence", 13) for line in wrap(trace.property.text, round(wide / 8))]
    shown.append((heading(trace), "soft" if shown else "title", 12 if shown else 15))
    drawn, y = [], 8
    for line, class_, size in shown:
        y += size + 4
        drawn.append(text(MARGIN, y, line, class_))
    return drawn, y + 14


def _heads(columns: SequenceColumns, y: int) -> Piece:
    """The names of the lifelines in boxes."""
    names = [_broken(name, columns.apart - 30, bold=True) for name in columns.names]
    tall = LINE * max(map(len, names)) + 12
    drawn = []
    for name, lines in zip(columns.names, names, strict=True):
        wide = max(width(line, bold=True) for line in lines) + 16
        x = columns.x(name)
        drawn.append(tag("rect", x=x - wide // 2, y=y, width=wide, height=tall, rx=3, class_="head"))
        drawn += _middle(x, y + 6 + (tall - 12 - LINE * len(lines)) // 2, lines, "name")
    return drawn, y + tall


def _broken(line: str, room: int, indent: str = "", bold: bool = False) -> list[str]:
    """A line in lines that fit, broken after spaces, underscores and dots."""
    found, start = [""], 0
    for letter in line:
        if width(found[-1] + letter, bold=bold) > room and found[-1].strip():
            space, any_ = found[-1].rfind(" "), max(found[-1].rfind(sign) for sign in "_. ")
            cut = (space if space > len(found[-1]) // 2 else any_) + 1
            cut = cut if cut > start else len(found[-1])
            found[-1:] = [found[-1][:cut].rstrip(), indent + found[-1][cut:]]
            start = len(indent)
        found[-1] += letter
    return found


def _middle(x: int, y: int, lines: Sequence[str], class_: str) -> list[str]:
    return [text(x, y + LINE * i + SIZE, line, class_, text_anchor="middle") for i, line in enumerate(lines)]


def _lifeline(x: int, start: int, end: int, pauses: Sequence[tuple[int, int]]) -> Iterator[str]:
    """Solid where ticks are shown, dotted where they are left out."""
    at = start
    for above, below in pauses:
        yield tag("path", d=f"M{x} {at}V{above}", class_="life")
        yield tag("path", d=f"M{x} {above}V{below}", class_="pause")
        at = below
    yield tag("path", d=f"M{x} {at}V{end}", class_="life")


def _step(columns: SequenceColumns, step: SequenceStep, y: int) -> Piece:
    y += 6
    drawn = [
        tag("path", d=f"M{MARGIN} {y}H{columns.right}", class_="row"),
        text(MARGIN, y + 15, f"tick {step.number}", "name"),
        text(MARGIN, y + 29, f"{step.ms} ms", "soft"),
    ]
    top, y = y, y + 4
    for kind, items in groupby(step.items, key=type):
        if kind is SequenceNote:
            more, y = _notes(columns, [item for item in items if isinstance(item, SequenceNote)], y)
            drawn += more
        else:
            for item in items:
                assert isinstance(item, Message)
                more, y = _message(columns, item, y)
                drawn += more
    return drawn, max(y, top + 34)


def _notes(columns: SequenceColumns, notes: Sequence[SequenceNote], y: int) -> Piece:
    """Notes that follow each other, side by side where they have room."""
    drawn: list[str] = []
    taken, bottom = 0, y
    for note in notes:
        lines = _clipped(note.told, columns.apart - 16)
        half = max(width(line) for line in lines) // 2 + 6
        x = columns.x(note.lifeline)
        if x - half < taken:
            y, taken = bottom, 0
        drawn.append(_note(note, lines, x - half, 2 * half, y))
        taken, bottom = x + half + 4, max(bottom, y + LINE * len(lines) + 6 + GAP)
    return drawn, bottom


def _clipped(lines: Sequence[str], room: int) -> list[str]:
    """The lines of a label, wrapped; those that are too many are counted."""
    shown = [part for line in lines[:TOLD] for part in _broken(line, room, "   ")]
    rest = len(lines) - TOLD
    return [*shown, f"… and {rest} more"] if rest > 0 else shown


def _message(columns: SequenceColumns, message: Message, y: int) -> Piece:
    start, ends = columns.x(message.sender), [columns.x(name) for name in message.receivers]
    nearest = min(ends, key=lambda x: abs(x - start))
    lines = _clipped(message.told, abs(nearest - start) - 20)
    at = y + LINE * len(lines) + 8
    left = min(start, nearest) + 9
    drawn = [text(left, y + 4 + LINE * i + SIZE, line, "halo") for i, line in enumerate(lines)]
    for far in {min(*ends, start), max(*ends, start)} - {start}:
        drawn += _lost(start, far, at) if message.lost else _line(start, far, at, ends)
    drawn.append(tag("circle", cx=start, cy=at, r=2.5, class_="tip"))
    whole = f"{message.sender} to {', '.join(message.receivers)}: {'; '.join(message.told)}"
    return [tag("g", tag("title", escape(whole)) + "".join(drawn))], at + GAP


def _line(start: int, far: int, y: int, ends: Sequence[int]) -> list[str]:
    """A line to the farthest receiver on one side, with a tip at each on the way."""
    side = 1 if far > start else -1
    drawn = [tag("path", d=f"M{start} {y}H{far - 2 * side}", class_="arrow")]
    for x in ends:
        if (x - start) * side > 0:
            drawn.append(tag("path", d=f"M{x} {y}l{-9 * side} -4v8z", class_="tip"))
    return drawn


def _lost(start: int, far: int, y: int) -> list[str]:
    """A line that ends on the way in a cross: what came before comes no more."""
    x = start + (far - start) * 3 // 5
    cross = f"M{x - 5} {y - 5}l10 10m0 -10l-10 10"
    return [
        tag("path", d=f"M{start} {y}H{x}", class_="arrow lost"),
        tag("path", d=cross, class_="cross"),
    ]


def _note(note: SequenceNote, lines: Sequence[str], x: int, wide: int, y: int) -> str:
    box = tag("rect", x=x, y=y + 4, width=wide, height=LINE * len(lines) + 6, rx=7, class_="note")
    told = [text(x + 6, y + 6 + LINE * i + SIZE, line) for i, line in enumerate(lines)]
    title = tag("title", escape(f"{note.lifeline}: {'; '.join(note.told)}"))
    return tag("g", title + box + "".join(told))


def _pause(columns: SequenceColumns, pause: Pause, ms: int, y: int) -> Piece:
    """How many ticks are left out here."""
    span = f"ticks {pause.first}–{pause.last}" if pause.last > pause.first else f"tick {pause.first}"
    told = f"{span}: {pause.why} ({duration(ms)})"
    x, wide = (LEFT + columns.right) // 2, width(told) + 16
    box = tag("rect", x=x - wide // 2, y=y + 12, width=wide, height=18, class_="gap")
    return [box, *_middle(x, y + 13, [told], "soft")], y + 40


def _loop(columns: SequenceColumns, top: int, bottom: int) -> list[str]:
    """The frame around what repeats."""
    frame = tag("rect", x=LEFT - 4, y=top, width=columns.right - LEFT + 4, height=bottom - top, class_="loop")
    tab = tag("path", d=f"M{LEFT - 4} {top}h104v12l-7 7h-97z", class_="tab")
    return [frame, tab, text(LEFT + 3, top + 14, "loop, for ever", "name")]


def _end(trace: Trace, sequence: MessageSequence, columns: SequenceColumns, y: int) -> Piece:
    """What is false at the end, or what repeats or is out of reach, across all lifelines."""
    letters = round((columns.right - MARGIN) / LETTER) - 6
    lines: list[tuple[str, str]] = []
    for part in false_parts(trace):
        values = ", ".join(f"{name} = {shown}" for name, shown in part.values)
        told = f"✗ {part.verdict}: {part.name or part.formula}"
        lines += [
            (line, "wrong") for line in wrap(f"{told}   ({values})" if values else told, letters, "   ")
        ]
    because = f"Why: {trace.property.because}" if trace.property.because else ""
    lines += [(line, "") for line in wrap(because, letters)]
    lines += [(line, "") for line in (*wrap(determined_by(trace), letters), *wrap(ending(trace), letters))]
    lines = lines or [(f"Tick {len(trace)} shows it.", "")]
    tall, class_ = LINE * len(lines) + 12, "end" if trace.property.false_parts else "head"
    box = tag("rect", x=MARGIN, y=y + 4, width=columns.right - MARGIN, height=tall, class_=class_)
    shown = [text(MARGIN + 8, y + 9 + LINE * i + SIZE, line, kind) for i, (line, kind) in enumerate(lines)]
    told = f"Not drawn, as they only start: {', '.join(sequence.idle)}" if sequence.idle else ""
    below = paragraph(MARGIN, y + 10 + tall, wrap(told, letters), "soft")
    return [box, *shown, *below], y + 10 + tall + LINE * len(below)
