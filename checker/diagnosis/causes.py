"""Deviations grouped by cause: those that one change of the charts explains, or that evidence joins."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from rovercheck.checker.conformance.deviations import Deviation, DeviationScope
from rovercheck.checker.conformance.recording import Recording
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.evidence import Evidence, EvidenceCollector, PartEvidence
from rovercheck.checker.diagnosis.met_elsewhere import FollowedPart, explained_elsewhere
from rovercheck.checker.diagnosis.one_change import likeness
from rovercheck.checker.diagnosis.part_causes import (
    CutSearch,
    DeviationCause,
    PartChanges,
    SearchedPart,
    by_cases,
    searched,
)
from rovercheck.checker.diagnosis.same_reading import read_alike
from rovercheck.checker.process.beside import beside
from rovercheck.checker.process.pool import cores
from rovercheck.spec_model.abstraction import Board


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
    unfit: tuple[str, ...] = ()
    """Parts that do something else than the causes explain in runs that were chosen for these."""
    search: "CauseSearch | None" = None
    """What they come from."""

    @property
    def searched(self) -> bool:
        """Whether some cause was found."""
        return any(one.change is not None or one.input for one in self.causes)


@dataclass(frozen=True)
class CauseSearch:
    """What was found in each part, of these deviations, before the parts were compared with one another."""

    deviations: Sequence[Deviation]
    parts: Sequence[FollowedPart]

    def kept(
        self, deviations: Sequence[Deviation], names: Collection[str]
    ) -> Mapping[str, list[FollowedPart]]:
        """What was found in some parts, of all deviations that there are now."""
        places = {one.scope: place for place, one in enumerate(deviations)}
        moved = [places.get(one.scope) for one in self.deviations]
        kept: dict[str, list[FollowedPart]] = {}
        for evidence, part in self.parts:
            if part.part in names:
                kept.setdefault(part.part, []).append((evidence, part.moved(moved)))
        return kept

    def but_for(self, before: "CauseSearch", told: Collection[DeviationScope]) -> "CauseSearch":
        """This one, with what was found before of parts in which that explains more of what is told."""
        here, there = ({name: one.of(name) for name in self.names} for one in (self, before))
        lost = [n for n in self.names if len(there[n] & set(told)) > len(here[n] & set(told))]
        if not lost:
            return self
        kept = before.kept(self.deviations, lost)
        rest = [pair for pair in self.parts if pair[1].part not in kept]
        return CauseSearch(self.deviations, [*rest, *(pair for some in kept.values() for pair in some)])

    @property
    def names(self) -> list[str]:
        return list(dict.fromkeys(part.part for _, part in self.parts))

    def of(self, name: str) -> set[DeviationScope]:
        """What is explained of a part."""
        own = (part.explained for _, part in self.parts if part.part == name)
        return {self.deviations[n].scope for some in own for n in some}


def by_itself(deviations: Iterable[Deviation]) -> CauseGroups:
    """Every deviation as one of its own."""
    return CauseGroups(tuple(map(_alone, deviations)))


def followed(
    board: Board,
    runs: Sequence[Recording],
    progress: Callable[[str], None] = lambda _: None,
    collector: EvidenceCollector | None = None,
) -> Evidence:
    """What runs say of the parts of a board; a ``collector`` has followed the first of them already.

    Raises what reading the blocks of a run raises.
    """
    collector = collector or EvidenceCollector(board)
    for number, run in enumerate(runs[collector.runs :], collector.runs + 1):
        progress(f"following deviating run {number} of {len(runs)}")
        collector.add(run)
    return collector.evidence()


def cause_groups(
    evidence: Evidence,
    deviations: Sequence[Deviation],
    parts: Iterable[str],
    seconds: float,
    progress: Callable[[str], None] = lambda _: None,
    at_once: int = 0,
    before: CauseSearch | None = None,
) -> CauseGroups:
    """The deviations that are met in the evidence by cause, in the order of the first of each.

    Causes are looked for in ``parts``, for so many ``seconds`` of the processor in each, ``at_once`` in so
    many: as a rule as many as there are processors.  What was found ``before`` in other parts is kept.
    """
    names = set(parts)
    kept = {} if before is None else before.kept(deviations, {p.part for _, p in before.parts} - names)
    wanted: dict[str, list[PartEvidence]] = {}
    for one in evidence.parts:
        if one.name in names:
            wanted.setdefault(one.name, []).append(one)
    works = [partial(searched, some, deviations, seconds) for some in wanted.values()]
    done: dict[int, list[SearchedPart]] = {}
    said = f"looking for causes in {len(works)} part{'s' * (len(works) != 1)}"
    if works:
        progress(said)
    for number, found in beside(works, at_once or cores()):
        done[number] = found
        progress(f"{said}, {len(done)} of them searched")
    pairs = [
        pair
        for number, some in enumerate(wanted.values())
        for pair in zip(by_cases(some), done[number], strict=True)
    ]
    pairs += [pair for some in kept.values() for pair in some]
    order = {one.name: place for place, one in enumerate(evidence.parts)}
    pairs.sort(key=lambda pair: order.get(pair[0].name, len(order)))
    if works:
        progress(f"{said}, all of them searched; comparing what was found in several")
    every = explained_elsewhere(evidence.board, pairs, deviations, seconds, at_once or cores())
    every = read_alike(evidence, every, deviations)
    cut = [one.cut for one in every if one.cut is not None]
    causes = list(together(cause for one in every for cause in one.found(deviations)))
    told = {id(d) for one in causes for d in one.deviations}
    causes += [_alone(d) for d in deviations if id(d) not in told]
    places = {id(d): place for place, d in enumerate(deviations)}
    inorder = sorted(causes, key=lambda c: places[id(c.first)])
    changes = tuple(one.together(deviations) for one in every)
    return CauseGroups(tuple(inorder), tuple(cut), parts=changes, search=CauseSearch(deviations, pairs))


def together(causes: Iterable[DeviationCause]) -> Iterator[DeviationCause]:
    """One change once, with all parts, places and kinds of runs that show it."""
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
            other_places=_other_places(every[0], (first, *more)),
            rivals=_in_all(every),
            alone=all(one.alone for one in every),
            runs=max(sum(one.runs for one in same) for same in parts),
            ticks=max(sum(one.ticks for one in same) for same in parts),
        )


def _same(one: DeviationCause) -> object:
    """What two causes have in common that are one: the stamp that is taken otherwise, or the change."""
    if one.change is None:
        return id(one)
    return one.change.reading or likeness(one.change) or one.change.key


def _in_all(same: Sequence[DeviationCause]) -> tuple[ChartChange, ...]:
    """What explains as much in all parts: each may rule out what another one leaves open."""
    keys = [{change.key for change in one.rivals} for one in same]
    return tuple(change for change in same[0].rivals if all(change.key in own for own in keys))


def _other_places(told: DeviationCause, same: Iterable[DeviationCause]) -> tuple[ChartChange, ...]:
    """Where the change that is told is made, too; a stamp is taken otherwise in one place."""
    if told.change is None or told.change.reading is not None:
        return ()
    changes = (c for one in same for c in (one.change, *one.other_places) if c is not None)
    found = {change.key: change for change in changes}
    return tuple(change for key, change in found.items() if key != told.change.key)


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
    "CauseGroups", "CauseSearch", "CutSearch", "DeviationCause", "PartChanges", "by_itself",
    "cause_groups", "followed", "split", "together",
]  # fmt: skip
