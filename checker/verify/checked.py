"""Checked properties: a verdict beside the one that is expected, which every output shows."""

from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from rovercheck.checker.certify.outcome import Rejected
from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.model.kept_invariants import Invariants
from rovercheck.checker.model.kept_runs import KeptRun
from rovercheck.checker.results.exit_code import Exit
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Proved, Unknown, Verdict, Violated
from rovercheck.checker.system.formula_json import Tree
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import TaskEvent, searches
from rovercheck.checker.verify.tasks import Task, tasks
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.verify.certificates import Certification

NO_LIMITS = Limits()


@dataclass(frozen=True)
class SearchSettings:
    """How properties are decided: by which engine, within which limits, by how many searches at a time.

    ``engine`` is the name of one, ``auto`` or ``all``; ``jobs`` is None for one search per processor.
    ``invariants`` of earlier proofs are tried first; ``certifying`` says what to do with proofs.
    """

    engine: str = AUTO
    limits: Limits = NO_LIMITS
    jobs: int | None = None
    invariants: Invariants = field(default_factory=dict)
    certifying: "Certification | None" = None


@dataclass(frozen=True)
class SearchesPlanned:
    """How many searches there will be."""

    searches: int


@dataclass(frozen=True)
class PremiseCase:
    """Whether the case occurs of which a proof speaks (None: not known), and what shows it, in words."""

    occurs: bool | None
    said: str
    kept: KeptRun | None = None


@dataclass(frozen=True)
class CheckedProperty:
    """A result beside the expected verdict; ``variant`` says how the charts differ from those specified.

    ``case``: whether the case occurs that a proof speaks of, ``noticed``: whether a fault is known that it
    notices, each if that was asked.  With ``strict``, a proof of a case that never occurs is not enough, nor
    one that notices no known fault.
    """

    result: Result
    expected: Expected
    variant: str = ""
    case: PremiseCase | None = None
    noticed: bool | None = None
    strict: bool = False

    @property
    def verdict(self) -> Verdict:
        return self.result.verdict

    @property
    def word(self) -> str:
        """The verdict for people; ``proved for a restricted model`` if that has only some of the runs."""
        said = f"{self.verdict.word} for a restricted model" if self.result.in_part else self.verdict.word
        return f"{said}, vacuously" if self.empty else said

    @property
    def empty(self) -> bool:
        """Whether it is a proof of a case that never occurs."""
        return self.case is not None and self.case.occurs is False

    @property
    def idle(self) -> bool:
        """Whether it is a proof that notices no known fault, and the baseline does not say why."""
        return self.noticed is False and not self.expected.no_fault

    @property
    def as_expected(self) -> bool:
        """Same verdict, and for a recorded counterexample the same length."""
        if self.verdict.word != self.expected.verdict:
            return False
        depth = None if self.variant else self.expected.depth
        return depth is None or not isinstance(self.verdict, Violated) or self.length == depth

    @property
    def length(self) -> int | None:
        """The number of ticks of the run that the verdict rests on, if it rests on one."""
        return length(self.verdict)

    @property
    def code(self) -> Exit:
        """The exit code that this property alone leads to."""
        if isinstance(self.result.certificate, Rejected):
            return Exit.INTERNAL
        if self.strict and self.case is not None and not self.case.occurs:
            return Exit.FAILED if self.empty else Exit.INCONCLUSIVE
        if self.strict and self.idle and not self.variant:
            return Exit.INCONCLUSIVE
        if self.as_expected or (self.variant and isinstance(self.verdict, Proved)):
            return Exit.AS_EXPECTED
        return Exit.INCONCLUSIVE if isinstance(self.verdict, Unknown) else Exit.FAILED


def length(verdict: Verdict) -> int | None:
    """The number of ticks of the trace a verdict rests on, if it rests on one."""
    because = None if isinstance(verdict, Unknown) else verdict.because
    return len(because) if isinstance(because, Trace) else None


def worst(found: Sequence[CheckedProperty]) -> Exit:
    """An internal error outweighs a change, and that an inconclusive search."""
    codes = {c.code for c in found}
    for code in (Exit.INTERNAL, Exit.FAILED, Exit.INCONCLUSIVE):
        if code in codes:
            return code
    return Exit.AS_EXPECTED


def events(
    properties: Sequence[Property], systems: Mapping[str, System], search: SearchSettings
) -> Generator[SearchesPlanned | TaskEvent, None, None]:
    """Decide properties, several searches at a time: what these do, and results as they are found.

    Raises what ``searches`` raises.  Closing the generator ends all searches.
    """
    # The largest first, so that no long search is left for the end; those of one system together.
    planned = (replace(t, recorded=on_record(t, search.invariants)) for t in tasks(properties, systems))
    todo = sorted(planned, key=lambda t: (-t.size, t.system.name, t.title))
    yield SearchesPlanned(len(todo))
    with closing(
        searches(todo, systems, search.engine, search.limits, search.jobs, search.certifying)
    ) as heard:
        for one in heard:
            yield limited(one, systems) if isinstance(one, Result) else one


def limited(one: Result, systems: Mapping[str, System]) -> Result:
    """The result with what it is limited to by the system that it is about."""
    system = systems.get(one.system, systems[one.property.on])
    return replace(one, in_part=_in_part(one, system), limited_to=_limited_to(one, system))


def on_record(task: Task, invariants: Invariants) -> tuple[Tree, ...] | None:
    """The conjuncts of all recorded proofs of the properties of a task; None if there is none."""
    known = [invariants[p.id] for p in task.properties if p.id in invariants]
    return tuple(tree for trees in known for tree in trees) if known else None


def _in_part(result: Result, system: System) -> bool:
    """Whether a search of too few runs was exhausted; a run found in it is a run of the rover."""
    verdict = result.verdict
    return system.under and not isinstance(verdict, Unknown) and not isinstance(verdict.because, Trace)


def _limited_to(result: Result, system: System) -> str:
    """What is said of the system beside a proof; a run is one of the rover whatever was left out."""
    verdict = result.verdict
    rests_on_all = not isinstance(verdict, Unknown) and not isinstance(verdict.because, Trace)
    return system.limited_to if rests_on_all else ""
