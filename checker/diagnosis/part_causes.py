"""The causes of what one part of a board does otherwise, as they come from where they are looked for."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from hashlib import sha256

from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.diagnosis.attribution import AttributedChange, attributed
from rovercheck.checker.diagnosis.cause_cover import covered
from rovercheck.checker.diagnosis.change import ChangeKind, ChartChange, only_told
from rovercheck.checker.diagnosis.cover import PartCover
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.checker.diagnosis.hypotheses import rewrite_changes, signals_of
from rovercheck.checker.diagnosis.one_change import likeness
from rovercheck.checker.diagnosis.other_inputs import explained_by_inputs, stamps
from rovercheck.checker.diagnosis.variant import WrittenChange, found_change
from rovercheck.spec_model.lang.chart import parts as all_parts
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var

REPAIRS: tuple[ChangeKind, ...] = ("repair",)


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
    other_places: tuple[ChartChange, ...] = ()
    """The same change where the firmware makes it, too, as a limit that two charts have in common."""
    rivals: tuple[ChartChange, ...] = ()
    """Other changes of those tried that explain exactly as much: nothing recorded tells them apart."""

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
class SearchedPart:
    """What was found in a part, with the deviations by their places among all: it may come from elsewhere.

    ``cases``: how often the part deviates in the recordings.
    """

    part: str
    causes: tuple[tuple[DeviationCause, tuple[int, ...]], ...]
    changes: tuple[ChartChange, ...]
    explained: tuple[int, ...]
    cut: CutSearch | None
    cases: int = 0

    def moved(self, places: Sequence[int | None]) -> "SearchedPart":
        """The same with the deviations at other places; ``None``: one is not told any more."""

        def there(some: Iterable[int]) -> tuple[int, ...]:
            return tuple(place for n in some if (place := places[n]) is not None)

        causes = tuple((one, moved) for one, own in self.causes if (moved := there(own)))
        return replace(self, causes=causes, explained=there(self.explained))

    def found(self, deviations: Sequence[Deviation]) -> list[DeviationCause]:
        """The causes, with these deviations."""
        return [replace(one, deviations=tuple(deviations[n] for n in own)) for one, own in self.causes]

    def together(self, deviations: Sequence[Deviation]) -> PartChanges:
        """All changes of the part, with these deviations."""
        return PartChanges(self.part, self.changes, tuple(deviations[n] for n in self.explained))


def searched(
    evidence: Sequence[PartEvidence], deviations: Sequence[Deviation], seconds: float
) -> list[SearchedPart]:
    """The causes of one part that was followed in runs of several columns, first where it deviates most.

    What is explained there is not looked at again.
    """
    found: list[SearchedPart] = []
    for part in by_cases(evidence):
        told = {n for one in found for _, own in one.causes for n in own}
        places = [n for n, d in enumerate(deviations) if d.scope.part == part.name and n not in told]
        one = searched_part(part, deviations, places, seconds)
        found.append(_where_recorded(part, deviations, places, seconds, one))
    return found


def _where_recorded(
    part: PartEvidence, every: Sequence[Deviation], places: Sequence[int], seconds: float, found: SearchedPart
) -> SearchedPart:
    """With what the part may read by mistake that some runs do not record: the others show it.

    Only where something is left without a cause.
    """
    system = part.group.system
    charts = frozenset(one.name for one in all_parts(system.components))
    for name, signal in _recorded_in_some(part).items():
        if len(found.explained) == len(places):
            break
        reads = [c for c in rewrite_changes(system, {name: signal}, charts) if c.new == name]
        runs = [run for run in part.runs if name in run.columns]
        if reads and any(run.wrong.get(part.name) for run in runs):
            tried = [*found.changes, *reads]
            made = searched_part(replace(part, runs=runs), every, places, seconds, tried)
            if len(made.explained) > len(found.explained):
                found = replace(made, cut=found.cut, cases=part.cases)
    return found


def _recorded_in_some(part: PartEvidence) -> dict[str, Var]:
    """Signals that some runs record, and not all."""
    columns = [frozenset(run.columns) for run in part.runs]
    some = frozenset[str]().union(*columns) - frozenset.intersection(*columns)
    return {name: var for name, var in signals_of(part.group.board).items() if name in some}


def by_cases(evidence: Iterable[PartEvidence]) -> list[PartEvidence]:
    """What there is of one part, that in which it deviates most first."""
    return sorted(evidence, key=lambda one: -one.cases)


def searched_part(
    part: PartEvidence,
    every: Sequence[Deviation],
    places: Sequence[int],
    seconds: float,
    only: Sequence[ChartChange] | None = None,
) -> SearchedPart:
    """The causes of what is at some places among all deviations; ``only``: no other changes are tried."""
    own = [every[n] for n in places]
    cover = covered(part, own, seconds, only=only)
    if only is None and _corrects_a_repair(cover):
        other = covered(part, own, max(seconds - cover.seconds, seconds / 2), without=REPAIRS)
        other.seconds += cover.seconds
        if other.left <= cover.left and len(other.changes) <= len(cover.changes):
            cover = other
    late = CutSearch(part.name, cover.tried, cover.of, cover.seconds) if cover.late else None
    explained = frozenset[int]().union(*(own for _, own in cover.changes))
    return SearchedPart(
        part.name,
        tuple((_told(one), tuple(places[n] for n in sorted(own))) for one, own in _causes(part, cover)),
        tuple(replace(change, make=only_told) for change, _ in cover.changes),
        tuple(places[n] for n in sorted(explained)),
        late,
        part.cases,
    )


def _corrects_a_repair(cover: PartCover) -> bool:
    """Whether a change is made in what a repair has put there: two differences may look like these."""
    if not any(change.kind == "repair" for change, _ in cover.changes):
        return False
    board, system = cover.evidence.group.board, cover.evidence.group.system
    for change, _ in cover.changes:
        try:
            found_change(board, system, WrittenChange(*change.key))
        except ModelError:
            return True
    return False


def _told(one: DeviationCause) -> DeviationCause:
    if one.change is None:
        return one
    others, rivals = (
        tuple(replace(change, make=only_told) for change in some) for some in (one.other_places, one.rivals)
    )
    change = replace(one.change, make=only_told)
    return replace(one, change=change, other_places=others, rivals=rivals)


def _causes(part: PartEvidence, cover: PartCover) -> Iterable[tuple[DeviationCause, Iterable[int]]]:
    """The changes of a part, then inputs that are read otherwise, with the places of their deviations."""
    found: dict[object, list[AttributedChange]] = {}
    for a in attributed(cover):
        found.setdefault(likeness(a.change) or a.change.key, []).append(a)
    for same in found.values():
        first, *others = (a.change for a in same)
        beside = all(a.beside for a in same)
        own = frozenset[int]().union(*(a.places for a in same if beside or not a.beside))
        alone = not any(cover.base)
        rivals = cover.rivals.get(first.key, ())
        one = DeviationCause(part.name, first, (), alone, "", 0, 0, beside, tuple(others), rivals)
        yield _counted(one, cover, own), own
    for name, places in explained_by_inputs(cover):
        told = f"{name}, which is computed from {stamps(part)[name]}"
        one = DeviationCause(part.name, None, (), False, told)
        yield _counted(one, cover, places), places


def _counted(cause: DeviationCause, cover: PartCover, places: Iterable[int]) -> DeviationCause:
    """With the runs and the steps in which some deviation of it is met, each once."""
    rows = {row for place in places for row in cover.rows[place]}
    return replace(cause, runs=len({run for run, _ in rows}), ticks=len(rows))


__all__ = [
    "CutSearch", "DeviationCause", "PartChanges", "SearchedPart", "by_cases", "searched", "searched_part",
]  # fmt: skip
