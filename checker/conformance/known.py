"""Known deviations: expected and checked on; what of them is seen, gone, changed or expired."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from typing import Literal

from rovercheck.checker.conformance.deviations import Deviation, DeviationScope, ScopedOutput
from rovercheck.checker.conformance.follower import Situation
from rovercheck.checker.conformance.mismatch import shown
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.domain import Domain

FoundWord = Literal["new", "known", "expired", "changed"]
"""Of a deviation that was met: ``changed`` is one in place of a known one that was not."""

RecordWord = Literal["seen", "expired", "gone", "changed", "not met"]
"""Of a known deviation: ``not met`` where nothing put it to the test."""


@dataclass(frozen=True)
class KnownDeviation:
    """A deviation that is expected; ``until`` is the last day on which it is, ``None``: no last one."""

    id: str
    board: str
    scope: DeviationScope
    reason: str = ""
    owner: str = ""
    until: date | None = None

    def covers(self, found: Deviation) -> bool:
        """Whether it is the one that was found."""
        if self.scope == found.scope:
            return True
        late = self.scope.kind == found.kind == "late" and self.scope.on_top == found.scope.on_top
        return late and (self.scope.part, self.scope.outputs) == (found.scope.part, found.scope.outputs)

    def resembles(self, found: Deviation) -> int:
        """How near one comes that is another one: 0 where it is of another part or of other outputs."""
        mine, other = self.scope, found.scope
        same = (mine.part, mine.on_top) == (other.part, other.on_top)
        if not same or not set(mine.outputs) & set(other.outputs):
            return 0
        return 1 + (mine.differences == other.differences) + (mine.charts == other.charts)


@dataclass(frozen=True)
class KnownCause:
    """What explains known deviations of a part, by their ids: changes of it, one on top of the other.

    Each as a variant writes it: kind, chart, at, from, to.
    """

    board: str
    part: str
    changes: tuple[tuple[str, ...], ...]
    deviations: tuple[str, ...]


@dataclass(frozen=True)
class KnownDeviations:
    """All that a file holds."""

    deviations: tuple[KnownDeviation, ...] = ()
    causes: tuple[KnownCause, ...] = ()


@dataclass(frozen=True)
class Judged:
    """What is to be said of a deviation that was met, by the name under which it is or would be known."""

    word: FoundWord
    id: str


@dataclass(frozen=True)
class KnownJudgement:
    """Deviations beside known ones: what is said of each found one by scope, of each known one in order."""

    found: Mapping[DeviationScope, Judged]
    known: Sequence[tuple[KnownDeviation, RecordWord]] = ()
    unexplained: frozenset[str] = frozenset()
    """Those that have changed in that their cause does not explain them any more."""

    def of(self, deviation: Deviation) -> Judged:
        """What is to be said of one that was met."""
        return self.found[deviation.scope]

    @property
    def unknown(self) -> int:
        """How many of those met are not known, or not any more."""
        return sum(one.word != "known" for one in self.found.values())

    def records(self, board: str) -> list[KnownDeviation]:
        """What is known from now on: what was met, and what nothing put to the test."""
        named = {known.id: (known, word) for known, word in self.known}
        kept = [known for known, word in self.known if word in ("seen", "expired", "not met")]
        for scope, one in self.found.items():
            if one.word == "new":
                kept.append(KnownDeviation(one.id, board, scope))
            elif one.word == "changed":
                kept.append(replace(named[one.id][0], id=scope.id(board), scope=scope))
        return kept


def judged(
    board: str,
    found: Sequence[Deviation],
    known: Iterable[KnownDeviation],
    would_show: Mapping[str, bool],
    today: date,
    unexplained: Collection[DeviationScope] = (),
) -> KnownJudgement:
    """Deviations of a board beside the known ones.

    ``would_show``: whether a known one, by its id, would have been seen if it were still there;
    ``unexplained``: those that the cause of a known one does not explain.
    """
    records = [one for one in known if one.board == board]
    words: dict[str, RecordWord] = {}
    of: dict[DeviationScope, Judged] = {}
    for record in records:
        over = record.until is not None and record.until < today
        for one in found:
            if record.covers(one):
                if one.scope in unexplained:
                    of[one.scope], words[record.id] = Judged("changed", record.id), "changed"
                    continue
                of[one.scope] = Judged("expired" if over else "known", record.id)
                words.setdefault(record.id, "expired" if over else "seen")
    for record in records:
        if record.id not in words:
            others = [one for one in found if one.scope not in of and record.resembles(one)]
            nearest = max(others, key=record.resembles, default=None)
            if nearest is not None:
                of[nearest.scope] = Judged("changed", record.id)
                words[record.id] = "changed"
            else:
                words[record.id] = "gone" if would_show.get(record.id) else "not met"
    every = {one.scope: of.get(one.scope, Judged("new", one.scope.id(board))) for one in found}
    otherwise = frozenset(of[scope].id for scope in unexplained if scope in of)
    return KnownJudgement(every, [(record, words[record.id]) for record in records], otherwise)


def shows(board: Board, scope: DeviationScope, met: Iterable[Situation], compared: Iterable[str]) -> bool:
    """Whether what was put to the test, and was as required, would have shown a deviation."""
    if scope.kind in ("frozen", "swapped") or (scope.kind == "late" and not scope.charts):
        return set(scope.outputs) <= set(compared)
    domains = {o.name: o.var.domain for o in board.outputs}
    own = [one for one in met if one[0] == scope.part]
    return all(
        any(_is_that_of(one, told, scope.charts, domains) for one in own) for told in scope.differences
    )


def _is_that_of(
    met: Situation, told: ScopedOutput, charts: Sequence[str], domains: Mapping[str, Domain]
) -> bool:
    """Whether a situation is that in which an output was not as required."""
    _, output, moves, required = met
    name, expected, actual = told
    if output != name or not set(moves) <= set(charts) or (charts and not moves):
        return False
    if required is None or not expected or expected == "a value":
        return True
    if expected.startswith("0x"):
        bits = int(expected, 16) ^ int(actual, 16)
        return int(required) & bits == int(expected, 16)
    return shown(domains[name], required) in expected.split(" or ")
