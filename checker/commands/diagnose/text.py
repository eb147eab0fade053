"""Causes for people: a paragraph for each part that deviates, the conforming logs in a line."""

from collections.abc import Iterator, Mapping, Sequence
from textwrap import fill

from rovercheck.checker.commands.shared.output import counted, text_width
from rovercheck.checker.conformance.mismatch import LogMismatch
from rovercheck.checker.diagnosis.change import KINDS, place_text
from rovercheck.checker.diagnosis.result import BoardDiagnosis, DiagnosedPart
from rovercheck.checker.diagnosis.sentences import explained, inputs_told, like
from rovercheck.checker.io.printable import one_line

MOST_NAMES = 8
MOST_PAIRS = 4


def page(found: Sequence[BoardDiagnosis], unread: Mapping[str, str], ended: Mapping[str, str]) -> str:
    """All that was found."""
    parts = [line for board in found for line in _board(board)]
    parts += [_lines("", f"{one_line(name)}: not read: {why}", 0, 2) for name, why in unread.items()]
    parts += [
        _lines("", f"{one_line(name)}: told up to what cannot be read: {why}", 0, 2)
        for name, why in ended.items()
    ]
    return "\n".join(parts)


def _lines(label: str, text: str, indent: int = 5, hang: int = 16) -> str:
    """A label and a text that is folded beside it."""
    start = " " * indent + label
    first = start.ljust(hang) if len(start) < hang else start + " "
    return fill(
        text, text_width(), initial_indent=first if label else " " * indent,
        subsequent_indent=" " * hang, break_long_words=False,
    )  # fmt: skip


def _names(names: Sequence[str]) -> str:
    shown = ", ".join(one_line(n) for n in names[:MOST_NAMES])
    return f"{shown} and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else shown


def _board(found: BoardDiagnosis) -> Iterator[str]:
    logs = counted(len(found.runs), "recording", "recordings")
    if not found.parts:
        yield f"{found.board.name}, {logs}: no deviation from the charts."
    else:
        changes = counted(sum(len(one.changes) for one in found.causes), "cause", "causes")
        some = sum(p.cause is None and p.partial is not None for p in found.parts)
        without = sum(p.told is None for p in found.parts)
        rest = f"; {counted(some, 'part', 'parts')} explained in part" if some else ""
        rest += f"; {counted(without, 'part', 'parts')} without" if without else ""
        yield f"{found.board.name}, {logs}: {changes} found{rest}."
    for number, part in enumerate(found.parts, 1):
        yield ""
        yield from _part(number, part)
    if found.conforming and found.parts:
        yield ""
        yield _lines("", f"No deviation in {_names(found.conforming)}.", 0, 2)
    if found.undecided:
        yield _lines("", f"Not wholly decided: {_names(found.undecided)}.", 0, 2)


def _part(number: int, part: DiagnosedPart) -> Iterator[str]:
    yield _lines(f"{number:>3}.", f"{explained(part)}.", 0, 5)
    for change in part.told.changes if part.told is not None else ():
        yield _lines("change", _change(change.kind, change.at, change.old, change.new))
        if change.note:
            yield _lines("", change.note, 16)
    yield _lines("in", _names(part.runs))
    yield from _evidence(part)
    for rival in part.rivals:
        text = " and ".join(map(like, rival.cause.changes))
        yield _lines("or", f"{text}: explains as many")
        if rival.run is None:
            yield _lines("", "no run was found that tells the two apart", 16)
        else:
            run = rival.run
            yield _lines(
                "",
                f"decides: {inputs_told(run)}: {run.output} is {run.one} by the first, {run.other} by this",
                16,
            )
    if part.more_rivals:
        more = counted(part.more_rivals, "change", "changes")
        yield _lines("", f"and {more} more that explain as many", 16)
    if part.prediction is not None:
        run = part.prediction
        told = f"{inputs_told(run)}: {run.output} is {run.other}, where the charts require {run.one}"
        yield _lines("predicts", told)
    if not part.complete:
        yield _lines(
            "time",
            f"not all candidates tried: {part.tried:,} of {part.of:,}; --seconds gives them longer",
        )


def _change(kind: str, at: str, old: str, new: str) -> str:
    if kind in ("interpretation", "repair"):
        return f"{KINDS[kind]}: {old} → {new}"
    return f"{KINDS[kind]} {place_text(at)}: {old} → {new}"


def _evidence(part: DiagnosedPart) -> Iterator[str]:
    """The first case of the first recording; of a part without a cause some more."""
    cases: list[tuple[str, LogMismatch]] = []
    for evidence in part.evidence:
        for run in evidence.deviating:
            cases += [(run.run.name, case.mismatch) for case in run.cases(evidence.name)]
    most = 1 if part.cause is not None else MOST_PAIRS
    for name, mismatch in cases[:most]:
        first = mismatch.differences[0]
        expected, logged = first.values()
        yield _lines(
            "case",
            f"{one_line(name)}, tick {mismatch.tick}, line {mismatch.line}: {first.output.name} is {logged}, "
            f"expected {' or '.join(expected)}",
        )
        if part.cause is None:
            if mismatch.moves:
                yield _lines("", f"charts: {'; '.join(mismatch.moves)}", 16)
            read = ", ".join(f"{n} = {v}" for n, v in mismatch.inputs.items())
            yield _lines("", f"inputs: {read or 'none'}", 16)
