"""What explains the deviations of a part: changes, what they must get past, and what was found so far."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.program import Known
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.checker.diagnosis.pieces import Pieces, Wrong
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.spec_model.lang.system import System

ALIKE = 6
"""Changes that explain the same of which it is asked how many rows they explain behind what is decided."""


@dataclass(frozen=True)
class CoveringChange:
    """A change that contradicts nothing; all rows of what it explains are right with it, and those before.

    ``behind``: how many rows it explains that the part as it is does not decide.
    """

    change: ChartChange
    explains: frozenset[int]
    cases: int
    wrong: Sequence[Wrong]
    system: System
    behind: int = 0

    @property
    def rank(self) -> tuple[float, ...]:
        """The one that explains most comes first, of those the nearest."""
        return (-len(self.explains), -self.behind, -self.cases, *self.change.nearness)


@dataclass(frozen=True)
class Unexplaining:
    """A change with which a witness is right, but no deviation wholly, or something is wrong."""

    change: ChartChange
    bench: TrialBench
    passed: int
    """How many witnesses."""
    places: frozenset[int]
    """Of which deviations."""

    @property
    def rank(self) -> tuple[float, ...]:
        """The one that passes most comes first, of those the nearest."""
        return (-self.passed, *self.change.nearness)


@dataclass(frozen=True)
class Sound:
    """What was found with some changes: sound, if nothing is wrong that was right without them."""

    changes: Sequence[tuple[ChartChange, frozenset[int]]]
    left: frozenset[int]
    base: Sequence[Wrong]
    system: System
    bench: TrialBench
    rows: Mapping[int, Pieces]


@dataclass(frozen=True)
class Witness:
    """A run up to the end of the first case of a deviation, which a change must explain before all is tried.

    ``place`` is that of the deviation.  ``before``: how many rows differ before; ``masked``: the outputs in
    rows with other deviations, without what differs by these.
    """

    place: int
    number: int
    last: int
    before: int
    masked: Mapping[int, Known] = field(default_factory=dict, compare=False)

    @property
    def rank(self) -> tuple[int, int, int]:
        """Those with nothing else before, then the short ones."""
        return (self.before, self.last, self.number)


@dataclass
class PartCover:
    """What explains the deviations of one part: each change with the places of the deviations it explains.

    ``tried`` changes ``of`` those that there are.
    """

    evidence: PartEvidence
    deviations: Sequence[Deviation]
    rows: Mapping[int, "Pieces"] = field(default_factory=dict)
    """Of each deviation, by its place, the rows in which it is met."""
    changes: list[tuple[ChartChange, frozenset[int]]] = field(default_factory=list)
    left: frozenset[int] = frozenset()
    base: Sequence["Wrong"] = ()
    """What is still wrong with all changes, in each run of ``TrialBench``."""
    system: System | None = None
    """The part with all changes."""
    bench: TrialBench | None = None
    """Its recordings, with the stamps as they are taken with all changes."""
    tried: int = 0
    of: int = 0
    seconds: float = 0.0
    late: bool = False
    """Whether the time was over before all was tried."""
    rivals: dict[tuple[str, ...], tuple[ChartChange, ...]] = field(default_factory=dict)
    """Of a change, by its key, others of those tried that explain exactly as much."""


def ranked(good: Sequence[CoveringChange], behind: Callable[[CoveringChange], int]) -> list[CoveringChange]:
    """Changes that explain something, the best first; ``behind`` is asked of some that explain the same."""
    alike: dict[frozenset[int], list[CoveringChange]] = {}
    for one in sorted(good, key=lambda one: one.rank):
        alike.setdefault(one.explains, []).append(one)
    found: list[CoveringChange] = []
    for same in alike.values():
        near = same[:ALIKE] if len(same) > 1 else []
        found += (replace(one, behind=behind(one)) for one in near)
        found += same[len(near) :]
    return sorted(found, key=lambda one: one.rank)


__all__ = ["CoveringChange", "PartCover", "Sound", "Unexplaining", "Witness", "ranked"]
