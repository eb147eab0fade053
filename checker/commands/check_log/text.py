"""What was found in logs, for people: a page about one log, a table of many."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from textwrap import fill, shorten

from rovercheck.checker.commands.check_log.campaign import LogCampaign
from rovercheck.checker.commands.check_log.causes import LOGS, not_searched
from rovercheck.checker.commands.shared.cause_text import also, says, untold
from rovercheck.checker.commands.shared.deviation_text import headline
from rovercheck.checker.commands.shared.known import known_lines, mark
from rovercheck.checker.commands.shared.output import counted, text_width
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.io.printable import one_line
from rovercheck.checker.logs import LogError, LogResult, as_on_record
from rovercheck.checker.logs.invalid import Invalid
from rovercheck.checker.logs.monitors import LogVerdict

KINDS = {
    "value": "",
    "late": "one tick late",
    "frozen": "stay while the charts go on",
    "swapped": "swapped: each holds what is required of the other",
}
MOST_PAIRS = 6
MOST_NAMES = 40
"""Columns without meaning that are named unless everything is asked for."""


@dataclass(frozen=True)
class LogFault:
    """A log on which rovercheck itself failed, and what is said of that."""

    message: str


Outcome = LogResult | LogError | LogFault
"""What came of one of many logs."""


def page(found: LogResult, verbose: bool, charts: str = "", campaign: LogCampaign | None = None) -> str:
    """All about one log; ``charts``: how the charts differ from those specified, in words."""
    parts = (
        _head(found, charts, verbose),
        _cells(found.invalid),
        _properties(found, verbose),
        _behaviour(found, campaign),
        _causes(campaign),
        _known(campaign),
    )
    return "\n\n".join(text for part in parts if (text := "\n".join(part)))


def _lines(label: str, text: str, indent: int = 2, hang: int = 15) -> str:
    """A label and a text that is folded beside it."""
    start = " " * indent + label
    first = start.ljust(hang) if len(start) < hang else start + " "
    return fill(
        text, text_width(), initial_indent=first, subsequent_indent=" " * hang, break_long_words=False
    )


# --- the log ---------------------------------------------------------------------------------------


def _some(names: Sequence[str], most: int) -> str:
    """The names, or the first of them and how many more there are."""
    more = len(names) - most if most else 0
    shown = ", ".join(one_line(name) for name in (names[:most] if more > 0 else names))
    return f"{shown} and {more:,} more; --verbose names them" if more > 0 else shown


def _head(found: LogResult, charts: str, verbose: bool) -> Iterator[str]:
    start = "from power-up" if found.start == "power-up" else "from some tick on"
    ticks = counted(found.ticks, "tick", "ticks")
    yield f"{one_line(found.name)}: {found.layout.board} {start}, {ticks} = {found.seconds:g} s"
    if charts:
        yield _lines("charts", charts)
    if found.behaviour.inferred:
        yield _lines("inferred", ", ".join(found.behaviour.inferred))
    if found.layout.ignored:
        yield _lines("ignored", _some(found.layout.ignored, MOST_NAMES if not verbose else 0))
    if found.missing:
        where = ", ".join(f"{g.steps} before line {g.line} (tick {g.tick})" for g in found.gaps)
        rest = ", ..." if found.missing > sum(g.steps for g in found.gaps) else ""
        yield _lines("missing", f"{counted(found.missing, 'step', 'steps')}: {where}{rest}")
    if found.ended:
        yield _lines("ended", f"{one_line(found.ended)} What comes before it is judged, the rest is not.")


def _cells(invalid: Invalid) -> Iterator[str]:
    """The cells without meaning, those with the same text together."""
    if not invalid:
        return
    number = counted(invalid.count, "cell", "cells")
    yield fill(f"Cells: {number} without meaning, taken as not logged.", text_width())
    for cell in invalid.cells:
        where = f"line {cell.line}" if cell.tick is None else f"tick {cell.tick}, line {cell.line}"
        rows = f"; {counted(cell.count, 'row', 'rows')} up to line {cell.last_line}" if cell.count > 1 else ""
        yield _lines(f"✗ {cell.name}:", cell.because, hang=6)
        yield _lines("", f"{where}{rows}", hang=6)
    for column, count in invalid.others.items():
        yield _lines(f"✗ {column}:", f"{counted(count, 'cell', 'cells')} more, with other values", hang=6)


# --- properties ------------------------------------------------------------------------------------


def _properties(found: LogResult, verbose: bool) -> Iterator[str]:
    words = Counter(v.word for v in found.verdicts)
    known = sum(v.word == "violated" and as_on_record(v) for v in found.verdicts)
    parts = [f"{number} {word}" for word, number in words.most_common()]
    yield fill(
        f"Properties: {counted(len(found.verdicts), 'monitor', 'monitors')}: {', '.join(parts)}.",
        text_width(),
    )
    for verdict in found.unexpected:
        yield from _verdict(verdict, "✗")
    if known and not verbose:
        ids = ", ".join(v.prop.id for v in found.verdicts if v.word == "violated" and as_on_record(v))
        yield _lines("known findings", ids, hang=18)
    for verdict in found.verdicts if verbose else ():
        if verdict not in found.unexpected:
            yield from _verdict(verdict, "·" if not verdict.count else "▸")
    yield from _unmonitored(found, verbose)


def _verdict(verdict: LogVerdict, mark: str) -> Iterator[str]:
    yield fill(
        f"{verdict.prop.id}: {verdict.prop.text}",
        text_width(),
        initial_indent=f"  {mark} ",
        subsequent_indent="      ",
    )
    yield _lines("", _outcome(verdict), hang=6)
    if verdict.first is not None and verdict.word == "violated":
        if verdict.first.parts:
            yield _lines("", f"false: {'; '.join(verdict.first.parts)}", hang=6)
        yield _lines("", ", ".join(f"{n} = {v}" for n, v in verdict.first.values.items()), hang=6)


def _outcome(verdict: LogVerdict) -> str:
    if verdict.first is None:
        return {"satisfied": "satisfied on this log", "never triggered": "never triggered: says nothing"}.get(
            verdict.word, verdict.word
        )
    where = f"tick {verdict.first.tick}, line {verdict.first.line}"
    record = "a known finding" if as_on_record(verdict) else "not expected: it should hold in every run"
    if verdict.word == "reached":
        return f"reached at {where}" + ("" if as_on_record(verdict) else ", expected to be out of reach")
    return f"violated at {where}, in {counted(verdict.count, 'tick', 'ticks')}; {record}"


def _unmonitored(found: LogResult, verbose: bool) -> Iterator[str]:
    if found.choice.missing:
        names = Counter(name for one in found.choice.missing for name in one.missing)
        number = counted(len(found.choice.missing), "property", "properties")
        columns = ", ".join(name for name, _ in names.most_common())
        yield _lines("not monitorable", f"{number}, for want of columns: {columns}", hang=18)
    if verbose:
        for one in (*found.choice.missing, *found.choice.untold):
            why = one.because or f"missing: {', '.join(one.missing)}"
            yield _lines(one.property.id, why, indent=4, hang=22)


# --- behaviour -------------------------------------------------------------------------------------


def _behaviour(found: LogResult, campaign: LogCampaign | None) -> Iterator[str]:
    behaviour = found.behaviour
    compared = counted(len(behaviour.compared), "output", "outputs")
    if behaviour.deviations:
        number = counted(len(behaviour.deviations), "distinct deviation", "distinct deviations")
        yield f"Behaviour: {number} from the charts, of {compared} compared."
    elif behaviour.undecided:
        yield f"Behaviour: no deviation found, but not all was decided ({compared} compared)."
    else:
        yield f"Behaviour: a run of the charts, of {compared} compared."
    for place, one in enumerate(behaviour.deviations, 1):
        judged = campaign.of(found, one) if campaign is not None and campaign.book.used else None
        yield from _deviation(place, one, f" ({mark(judged.word, judged.id)})" if judged else "")
    if behaviour.left_out:
        names = ", ".join(behaviour.left_out)
        yield _lines("not compared", f"{names}: computed from inputs that are not logged", hang=18)
    for open_ in behaviour.undecided:
        yield _lines("?", f"{open_.part}: unknown from tick {open_.tick} on: {open_.because}", hang=5)


def _deviation(number: int, one: Deviation, known: str) -> Iterator[str]:
    kind = f" {KINDS[one.kind]}" if KINDS[one.kind] else ""
    yield fill(
        f"{', '.join(one.outputs)}{kind}{known}",
        text_width(),
        initial_indent=f"{number:>3}. ",
        subsequent_indent="     ",
    )
    yield _lines("when", _when(one), indent=5, hang=14)
    for difference in one.differences[:MOST_PAIRS]:
        expected, logged = difference.values()
        name = f"{difference.output.name}: " if len(one.differences) > 1 else ""
        yield _lines("expected", f"{name}{' or '.join(expected)}; logged {logged}", indent=5, hang=14)
    if len(one.differences) > MOST_PAIRS:
        yield _lines("", f"and {len(one.differences) - MOST_PAIRS} more pairs of values", hang=14)
    if one.kind in ("value", "late"):
        if one.first.decided_by not in ("", *one.outputs):
            yield _lines("part", one.first.decided_by, indent=5, hang=14)
        if one.first.moves:
            yield _lines("charts", "; ".join(one.first.moves), indent=5, hang=14)
        inputs = ", ".join(f"{name} = {value}" for name, value in one.first.inputs.items())
        yield _lines("inputs", inputs or "none", indent=5, hang=14)


def _when(one: Deviation) -> str:
    start = f"tick {one.first.tick}, line {one.first.line}"
    if one.count == 1:
        return f"{start}, once"
    return (
        f"{start}; in {one.count:,} ticks up to tick {one.last}, begun {counted(one.times, 'time', 'times')}"
    )


# --- many logs -------------------------------------------------------------------------------------


def summary(found: Mapping[str, Outcome], charts: str = "", campaign: LogCampaign | None = None) -> str:
    """A line for each log, what is wrong with those that could not be read, then the deviations of all."""
    found = {one_line(name): one for name, one in found.items()}
    width = min(max(map(len, found)), 24)
    rows: list[tuple[str, ...]] = [
        ("log", "board", "ticks", "violated", "known", "deviations", "unknown", "cells")
    ]
    rows += [_row(name, one, width) for name, one in found.items() if isinstance(one, LogResult)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    gap = "  " if sum(widths) + 2 * (len(widths) - 1) <= text_width() else " "
    lines = [_aligned(row, widths, gap) for row in rows] if len(rows) > 1 else []
    for name, one in found.items():
        if isinstance(one, LogError):
            lines.append(_lines("", f"{name}: not read: {one}", indent=0, hang=0))
        elif isinstance(one, LogResult) and one.ended:
            lines.append(
                _lines("", f"{name}: judged up to what cannot be read: {one.ended}", indent=0, hang=0)
            )
        elif isinstance(one, LogFault):
            lines.append(_lines("", f"{name}: not judged: {one.message}", indent=0, hang=0))
    head = [_lines("charts", charts, indent=0, hang=8)] if charts else []
    over_all = [line for part in (_over_all(campaign), _known(campaign)) for line in part]
    between = [""] if over_all else []
    return "\n".join([*head, *lines, *between, *over_all, "", _total(list(found.values()))])


def _over_all(campaign: LogCampaign | None) -> Iterator[str]:
    """Each deviation once, what explains most first."""
    if campaign is None or not any(campaign.deviations.values()):
        return
    yield "Deviations over all logs:"
    number = 0
    for board in campaign.deviations:
        of_board = sum(log.layout.board == board for log in campaign.logs)
        groups = campaign.groups(board)
        for cause in groups.causes:
            one = cause.first
            number += 1
            judged = campaign.judgements[board].of(one)
            known = f" ({mark(judged.word, judged.id)})" if campaign.book.used else ""
            yield _lines(f"{number}.", f"{board}, {headline(one)}{known}", indent=2, hang=6)
            when = (
                f"in {one.runs} of {counted(of_board, 'log', 'logs')}, {counted(one.count, 'tick', 'ticks')}"
            )
            first = f"first in tick {one.first.tick} of {one_line(one.origin)}"
            yield _lines("", f"{when}; {first}", hang=6)
            for move in one.scope.charts:
                yield _lines("", move, hang=8)
            if told := says(cause):
                yield _lines("", f"cause: {told}.", hang=6)
            if told := untold(cause, LOGS[1]):
                yield _lines("", f"or: {told}.", hang=6)
            for other in cause.deviations[1:]:
                yield _lines("", f"also: {also(other, cause, LOGS)}", hang=8)
        yield from (_lines("", line, indent=0, hang=0) for line in not_searched(groups))


def _causes(campaign: LogCampaign | None) -> Iterator[str]:
    """Of one log what explains its deviations, where that was looked for."""
    for groups in campaign.causes.values() if campaign is not None else ():
        yield "Causes:"
        for cause in groups.causes:
            ways = counted(len(cause.deviations), "deviation", "deviations")
            told = f"{says(cause)}: {ways}" if says(cause) else f"{headline(cause.first)}: nothing found"
            yield _lines("-", told, indent=2, hang=4)
        yield from (_lines("", line, indent=2, hang=4) for line in not_searched(groups))


def _known(campaign: LogCampaign | None) -> Iterator[str]:
    """What came of known deviations, besides being there."""
    for judgement in campaign.judgements.values() if campaign is not None else ():
        for line in known_lines(judgement):
            yield _lines("", line, indent=0, hang=0)


def _row(name: str, one: LogResult, width: int) -> tuple[str, ...]:
    known = sum(v.word == "violated" and as_on_record(v) for v in one.verdicts)
    return (
        shorten(name, width, placeholder="…") if " " in name else name[:width],
        one.layout.board,
        f"{one.ticks:,}",
        str(len(one.unexpected)),
        str(known),
        str(len(one.behaviour.deviations)),
        str(len(one.behaviour.undecided)),
        f"{one.invalid.count:,}",
    )


def _aligned(row: Sequence[str], widths: Sequence[int], gap: str) -> str:
    cells = [row[0].ljust(widths[0]), row[1].ljust(widths[1])]
    return gap.join([*cells, *(c.rjust(w) for c, w in zip(row[2:], widths[2:], strict=True))])


def _total(found: Sequence[Outcome]) -> str:
    results = [r for r in found if isinstance(r, LogResult)]
    bad = sum(r.deviates for r in results)
    parts = [f"{bad} with deviations or unexpected violations" if bad else "none deviates"]
    if holes := sum(bool(r.invalid) for r in results):
        parts.append(f"{holes} with cells without meaning")
    if still := sum(bool(r.behaviour.undecided) for r in results):
        parts.append(f"{still} not wholly decided")
    if unread := sum(isinstance(one, LogError) for one in found):
        parts.append(f"{unread} not read")
    if faults := sum(isinstance(one, LogFault) for one in found):
        parts.append(f"{faults} not judged for an internal error")
    return f"{counted(len(found), 'log', 'logs')}: {', '.join(parts)}."
