"""Deviations grouped by cause: those that one change of the charts explains, or that evidence joins."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from hashlib import sha256

from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.recording import Recording
from rovercheck.checker.diagnosis.attribution import attributed
from rovercheck.checker.diagnosis.cause_cover import covered
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.cover import PartCover
from rovercheck.checker.diagnosis.evidence import Evidence, EvidenceCollector, PartEvidence
from rovercheck.checker.diagnosis.other_inputs import explained_by_inputs, stamps
from rovercheck.spec_model.abstraction import Board


@dataclass(frozen=True)
class DeviationCause:
    """Deviations of one cause, those that were met in most runs first.

    Each is in no other cause, unless it takes two together: ``beside`` says that of all of these another
    change is the cause, too, and more.  ``change`` explains them; a stamp that is taken
    otherwise may show in several parts, and they are deviations of all of these.  Where it is ``None``, other
    values of an ``input`` do, told with the stamp that the implementation computes it from; where that is
    empty, too, nothing does.  ``alone``: whether the changes found in the part explain everything that it
    does otherwise.  ``runs`` and ``ticks`` are those in which some of them is met in one part.
    """

    part: str
    change: ChartChange | None
    deviations: tuple[Deviation, ...]
    alone: bool = False
    input: str = ""
    runs: int = 0
    ticks: int = 0
    beside: bool = False

    @property
    def first(self) -> Deviation:
        """The one that is told in full."""
        return self.deviations[0]

    @property
    def parts(self) -> tuple[str, ...]:
        """The parts that deviate."""
        return tuple(dict.fromkeys((self.part, *(d.scope.part for d in self.deviations))))

    def id(self, board: str) -> str:
        """A short name: that of the change, or of the first deviation."""
        if self.change is None:
            return self.first.scope.id(board)
        digest = sha256(repr((board, *self.change.key)).encode()).hexdigest()[:6]
        return f"{board}-{self.change.chart}-{digest}"


@dataclass(frozen=True)
class CutSearch:
    """A part of which not all changes were tried in the time: ``tried`` ``of`` those met until then."""

    part: str
    tried: int
    of: int
    seconds: float


@dataclass(frozen=True)
class PartChanges:
    """All changes that were found of a part, one on top of the other, and what they explain together."""

    part: str
    changes: tuple[ChartChange, ...]
    deviations: tuple[Deviation, ...]


@dataclass(frozen=True)
class CauseGroups:
    """All deviations of a board, each under one cause.

    ``cut``: searches that the time ended; ``left_out``: runs that deviate and were not looked at; ``parts``:
    those in which causes were looked for.
    """

    causes: tuple[DeviationCause, ...] = ()
    cut: tuple[CutSearch, ...] = ()
    left_out: int = 0
    parts: tuple[PartChanges, ...] = ()

    @property
    def searched(self) -> bool:
        """Whether some cause was found."""
        return any(one.change is not None or one.input for one in self.causes)


def by_itself(deviations: Iterable[Deviation]) -> CauseGroups:
    """Every deviation as one of its own."""
    return CauseGroups(tuple(map(_alone, deviations)))


def followed(
    board: Board, runs: Sequence[Recording], progress: Callable[[str], None] = lambda _: None
) -> Evidence:
    """What runs say of the parts of a board.  Raises what reading the blocks of a run raises."""
    collector = EvidenceCollector(board)
    for number, run in enumerate(runs, 1):
        progress(f"following deviating run {number} of {len(runs)}")
        collector.add(run)
    return collector.evidence()


def cause_groups(
    evidence: Evidence,
    deviations: Sequence[Deviation],
    parts: Iterable[str],
    seconds: float,
    progress: Callable[[str], None] = lambda _: None,
) -> CauseGroups:
    """The deviations that are met in the evidence by cause, in the order of the first of each.

    Causes are looked for in ``parts``, for so many ``seconds`` of the processor in each.
    """
    names = set(parts)
    found: dict[str, list[DeviationCause]] = {}
    cut: list[CutSearch] = []
    changes: list[PartChanges] = []
    wanted = [one for one in evidence.parts if one.name in names]
    for number, part in enumerate(wanted, 1):
        progress(f"looking for causes in {part.name}, part {number} of {len(wanted)}")
        told = {id(d) for causes in found.values() for c in causes for d in c.deviations}
        own = [d for d in deviations if d.scope.part == part.name and id(d) not in told]
        cover = covered(part, own, seconds)
        if cover.late:
            cut.append(CutSearch(part.name, cover.tried, cover.of, cover.seconds))
        found.setdefault(part.name, []).extend(_of_part(part, cover))
        explained = frozenset[int]().union(*(places for _, places in cover.changes))
        made = tuple(change for change, _ in cover.changes)
        changes.append(PartChanges(part.name, made, _at(cover, explained)))
    causes = list(_together(one for some in found.values() for one in some))
    told = {id(d) for one in causes for d in one.deviations}
    causes += [_alone(d) for d in deviations if id(d) not in told]
    places = {id(d): place for place, d in enumerate(deviations)}
    inorder = sorted(causes, key=lambda c: places[id(c.first)])
    return CauseGroups(tuple(inorder), tuple(cut), parts=tuple(changes))


def _of_part(part: PartEvidence, cover: PartCover) -> list[DeviationCause]:
    """The causes of a part: its changes, then inputs that are read otherwise."""
    found = [
        DeviationCause(part.name, a.change, _at(cover, a.places), not any(cover.base), beside=a.beside)
        for a in attributed(cover)
    ]
    for name, places in explained_by_inputs(cover):
        told = f"{name}, which is computed from {stamps(part)[name]}"
        found.append(DeviationCause(part.name, None, _at(cover, places), False, told))
    keys = {id(one): set(cover.rows[n]) for n, one in enumerate(cover.deviations)}
    return [_counted(one, keys) for one in found]


def _together(causes: Iterable[DeviationCause]) -> Iterator[DeviationCause]:
    """One change once, with all parts and all kinds of runs that show it."""
    found: dict[object, list[DeviationCause]] = {}
    for one in causes:
        found.setdefault(_same(one), []).append(one)
    for first, *more in found.values():
        every = [one for one in (first, *more) if not one.beside] or [first]
        deviations = dict((id(d), d) for one in every for d in one.deviations)
        # a part that is there twice was followed in runs of other columns
        parts = [[one for one in every if one.part == name] for name in {one.part for one in every}]
        yield replace(
            every[0],
            deviations=tuple(deviations.values()),
            alone=all(one.alone for one in every),
            runs=max(sum(one.runs for one in same) for same in parts),
            ticks=max(sum(one.ticks for one in same) for same in parts),
        )


def _same(one: DeviationCause) -> object:
    """What two causes have in common that are one: the stamp that is taken otherwise, or the change."""
    if one.change is None:
        return id(one)
    return one.change.key if one.change.reading is None else one.change.reading


def _at(cover: PartCover, places: Iterable[int]) -> tuple[Deviation, ...]:
    return tuple(cover.deviations[n] for n in sorted(places))


def _counted(cause: DeviationCause, keys: Mapping[int, set[tuple[int, int]]]) -> DeviationCause:
    """With the runs and the steps in which some deviation of it is met, each once."""
    rows = set[tuple[int, int]]().union(*(keys[id(one)] for one in cause.deviations))
    return replace(cause, runs=len({run for run, _ in rows}), ticks=len(rows))


def _alone(one: Deviation) -> DeviationCause:
    return DeviationCause(one.scope.part, None, (one,), runs=one.runs, ticks=one.count)


def split(
    causes: Iterable[DeviationCause], apart: Callable[[Deviation], object]
) -> tuple[DeviationCause, ...]:
    """The causes with deviations that are to be told apart, such as known ones, in groups of their own."""
    found: list[DeviationCause] = []
    for cause in causes:
        groups: dict[object, list[Deviation]] = {}
        for one in cause.deviations:
            groups.setdefault(apart(one), []).append(one)
        if len(groups) == 1:
            found.append(cause)
            continue
        for group in groups.values():
            runs, ticks = max(d.runs for d in group), max(d.count for d in group)
            found.append(replace(cause, deviations=tuple(group), runs=runs, ticks=ticks))
    return tuple(found)


__all__ = [
    "CauseGroups", "CutSearch", "DeviationCause", "PartChanges", "by_itself", "cause_groups", "followed",
    "split",
]  # fmt: skip
