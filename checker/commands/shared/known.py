"""Known deviations of an implementation or of logs, as ``--known`` and ``--write-known`` name them."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path

from typing_extensions import TypedDict

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.output import counted, write
from rovercheck.checker.conformance.deviations import Deviation, DeviationScope
from rovercheck.checker.conformance.known import (
    FoundWord,
    KnownCause,
    KnownDeviation,
    KnownDeviations,
    KnownJudgement,
    RecordWord,
    judged,
)
from rovercheck.checker.conformance.known_file import known_in, known_text
from rovercheck.checker.diagnosis.causes import PartChanges
from rovercheck.checker.diagnosis.known_causes import causes_to_keep, changed
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.errors import ModelError

NONE_KNOWN = KnownDeviations()


class KnownRow(TypedDict):
    """A known deviation of the board, and what came of it."""

    id: str
    verdict: RecordWord
    reason: str
    owner: str
    until: str
    """The last day on which it is expected, or never."""


@dataclass(frozen=True)
class KnownBook:
    """The known deviations that were named, and the file to write.

    ``kept`` are those whose reasons are kept in that file: the same, or those already in it.
    """

    boards: Mapping[str, Board]
    charts: str
    known: KnownDeviations = NONE_KNOWN
    kept: KnownDeviations = NONE_KNOWN
    target: Path | None = None
    source: Path | None = None
    written: dict[str, KnownDeviations] = field(default_factory=dict)

    @property
    def used(self) -> bool:
        """Whether anything is to be said of known deviations."""
        return self.source is not None or self.target is not None

    def concerning(self, boards: Iterable[str]) -> None:
        """Raise ``UsageError`` where nothing that is known is about these boards."""
        others = sorted({one.board for one in self.known.deviations})
        if self.source is not None and others and not set(others) & set(boards):
            raise UsageError(
                f"{self.source} knows deviations of {', '.join(others)} alone, and this is about "
                f"{', '.join(boards)}; name another --known."
            )

    def knows(self, board: str, found: Deviation) -> bool:
        """Whether a deviation of a board is known, and not too old to be expected."""
        today = date.today()
        return any(
            one.board == board and one.covers(found) and (one.until is None or one.until >= today)
            for one in self.known.deviations
        )

    def causes(self, board: str) -> list[KnownCause]:
        """The causes of known deviations of a board."""
        return [one for one in self.known.causes if one.board == board]

    def judged(
        self,
        board: str,
        found: Sequence[Deviation],
        shown_by: Callable[[KnownDeviation], bool],
        unexplained: Collection[DeviationScope] = (),
        parts: Sequence[PartChanges] = (),
        on_top: Iterable[Deviation] | None = None,
    ) -> KnownJudgement:
        """The deviations of a board beside the known ones; what is to be written of it is noted.

        ``unexplained``: those that the cause of a known one does not explain; ``parts``: causes found now,
        and ``on_top`` what they leave; ``None``: nothing was followed beside causes.
        """
        known, kept = self.known.deviations, self.kept.deviations
        records = [one for one in {r.id: r for r in (*kept, *known)}.values() if one.board == board]
        would_show = {one.id: shown_by(one) for one in records}
        today = date.today()
        if self.target is not None:
            again = {part.part for part in parts}
            own = [
                one
                for one in judged(board, found, kept, would_show, today).records(board)
                if not (one.scope.on_top and one.scope.part in again)
            ]
            own += [KnownDeviation(one.scope.id(board), board, one.scope) for one in on_top or ()]
            causes = causes_to_keep(board, parts, own, self.kept.causes)
            self.written[board] = KnownDeviations(tuple(own), tuple(causes))
        followed = [one for one in known if on_top is not None or not one.scope.on_top]
        return judged(board, found, followed, would_show, today, unexplained)

    def write(self) -> Iterator[str]:
        """Write the file that was asked for, and say so.  Raises ``UsageError``."""
        if self.target is None:
            return
        every = [one for one in self.kept.deviations if one.board not in self.written]
        causes = [one for one in self.kept.causes if one.board not in self.written]
        for written in self.written.values():
            every += written.deviations
            causes += written.causes
        write(known_text(every, self.charts, causes), self.target)
        yield f"Wrote {counted(len(every), 'known deviation', 'known deviations')} to {self.target}."


def known_book(
    source: Path | None, target: Path | None, boards: Mapping[str, Board], charts: str
) -> KnownBook:
    """What is known, before anything is run.

    Raises ``ModelError`` for a file without meaning or of other charts.
    """
    known = known_in(source, boards, charts) if source is not None else NONE_KNOWN
    for number, cause in enumerate(known.causes, 1):
        try:
            changed(boards[cause.board], cause)
        except ModelError as error:
            raise ModelError(
                f"{source}, cause {number} ({cause.part}): {error} Take this [[cause]] out, and have "
                "--write-known look for another."
            ) from error
    kept = known
    if source is None and target is not None and target.is_file():
        kept = known_in(target, boards, charts)
    return KnownBook(boards, charts, known, kept, target, source)


def known_rows(judgement: KnownJudgement) -> list[KnownRow]:
    """What came of the known deviations, as JSON."""
    return [
        {
            "id": one.id,
            "verdict": word,
            "reason": one.reason,
            "owner": one.owner,
            "until": one.until.isoformat() if one.until else "never",
        }
        for one, word in judgement.known
    ]


NOTES: Mapping[RecordWord, str] = {
    "gone": "gone: what it is about was put to the test, and was as the charts require; take it out",
    "not met": "not met: nothing put it to the test",
}


def known_lines(judgement: KnownJudgement) -> Iterator[str]:
    """Of known deviations what is not as expected, and how many are."""
    words = [word for _, word in judgement.known]
    if seen := words.count("seen"):
        yield f"Known deviations: {seen} of {len(words)} seen."
    for one, word in judgement.known:
        if word in NOTES:
            yield f"Known deviation {one.id} is {NOTES[word]}."
        elif word == "expired":
            assert one.until is not None
            day = one.until.isoformat()
            yield f"Known deviation {one.id} has expired on {day}: it is not known any more."
        elif word == "changed" and one.id in judgement.unexplained:
            yield f"Known deviation {one.id} has changed: what explained it does not explain it any more."
        elif word == "changed":
            yield f"Known deviation {one.id} has changed: another one was met in its place."


def mark(word: FoundWord, id: str) -> str:
    """What is said of a deviation beside its name, if known ones were named."""
    told: dict[FoundWord, str] = {
        "new": "new",
        "known": f"known as {id}",
        "expired": f"known as {id}, expired",
        "changed": f"new shape of {id}",
    }
    return told[word]


__all__ = ["KnownBook", "KnownRow", "known_book", "known_lines", "known_rows", "mark"]
