"""What becomes of one mutant: who notices it, or that nobody can, or a run that nobody forbids."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from time import monotonic

from rovercheck.checker.engines import AUTO, Limits, Progress
from rovercheck.checker.mutate.observation import MutantDifference, difference, observable
from rovercheck.checker.mutate.product import Product, at_the_fault, described, product, same
from rovercheck.checker.mutate.step_equality import equal_in_every_step
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Open, Proved, Reached, Run, Unknown, Unreachable, Violated
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.decide import decide
from rovercheck.checker.verify.portfolio import Callbacks, PortfolioQuestion, answers
from rovercheck.checker.verify.portfolio.question import stays
from rovercheck.checker.verify.result import Result, check_domains
from rovercheck.checker.verify.runs.domains import LeavesDomain
from rovercheck.checker.verify.runs.known_runs import confirm, reaching, run_of
from rovercheck.checker.verify.tasks import Task, tasks
from rovercheck.properties.forms import Property, Reachable
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System

DOMAINS, REFUSED = "(leaves a domain)", "(refused)"
"""Who kills a mutant that no property is needed for: the commands refuse such a model whatever is asked."""
EQUAL_STEPS = "every tick takes every state to the same one"
OVERWRITTEN = f"{EQUAL_STEPS}, and the first one overwrites what they begin with"
"""Why a mutant is equivalent that no search is needed for."""
NOT_SEARCHED = "no run that is known kills it"
"""Why a mutant is unknown of which nothing was searched."""
SHARE = 0.5
"""Of the time that is left, what one search may take at most while others wait."""


class Fate(StrEnum):
    """What becomes of a mutant."""

    KILLED = "killed"
    NOTICED = "noticed"
    """Only a recorded finding is gone: the mutant mends something, and nothing else notices it."""
    EQUIVALENT = "equivalent"
    SURVIVOR = "survivor"
    UNKNOWN = "unknown"
    NO_CHART = "not a chart"
    NO_CHANGE = "no change"


@dataclass(frozen=True)
class MutantFate:
    """The fate of a mutant: the killer with the ticks of its run, the proof, or the run that differs.

    ``why`` is the reason of what is unknown, the proof of what is equivalent, or what refuses the mutant.
    ``asked`` counts the properties that were decided, ``open`` those that were not.
    """

    fate: Fate
    killer: str = ""
    on: str = ""
    ticks: int | None = None
    shortest: bool = False
    why: str = ""
    asked: int = 0
    open: int = 0
    difference: MutantDifference | None = None
    run: Run | None = None
    """The run that violates ``killer``, to be tried on other mutants."""


@dataclass(frozen=True)
class MutantCase:
    """A mutant in one system, with the properties to ask and whether each is proved of the original.

    ``sure``: that was found out, and not only read from a record.  ``named`` are the variables that
    properties speak of, ``abroad`` those that parts of other systems read; ``runs`` are known to reach the
    goals of some properties in the original, ``killers`` kill other mutants, ``tries`` may kill this one;
    ``engines`` says what proved a property of the original.
    """

    original: System
    mutant: System
    parts: tuple[str, ...]
    properties: tuple[Property, ...]
    proved: Mapping[str, bool]
    sure: bool = True
    named: frozenset[str] = frozenset()
    abroad: frozenset[str] = frozenset()
    runs: Mapping[str, Run] = field(default_factory=dict)
    killers: Sequence[Run] = ()
    tries: Sequence[Run] = ()
    engines: Mapping[str, str] = field(default_factory=dict)

    def settled(self, prop: Property) -> bool:
        """Whether the verdict on the original rests on a run to the goal, as it then does on the mutant."""
        return self.proved[prop.id] is isinstance(prop.form, Reachable)


def judged(
    cases: Sequence[MutantCase],
    limits: Limits,
    progress: Progress,
    before: MutantFate | None = None,
    *,
    search: bool = True,
) -> MutantFate:
    """The fate of a mutant; the first case is the system in which it is compared with the original.

    With ``before``, what became of it in another system, it is not compared again.  Without ``search`` it is
    unknown where no run that is known and no single query decides it.

    Raises ``ReplayError`` and ``Disagreement``, which are internal errors.
    """
    first = cases[0]
    try:
        for case in cases:
            lower(case.mutant)
    except ModelError as error:
        if before is not None:
            return MutantFate(Fate.KILLED, REFUSED, first.mutant.name, why=str(error).splitlines()[0])
        return MutantFate(Fate.NO_CHART, why=str(error).splitlines()[0])
    if before is None and all(same(lowered(case.original), lowered(case.mutant)) for case in cases):
        return MutantFate(Fate.NO_CHANGE, why="both are lowered to the same step")
    deadline = limits.deadline()
    kills = _KillSearch(cases, limits, deadline, progress)
    try:
        killed = kills.killed_by_runs()
        if killed is not None:
            return killed
        if before is None and equal_in_every_step(lowered(first.original), lowered(first.mutant)):
            begun = [described(lowered(s).variables) for s in (first.original, first.mutant)]
            why = EQUAL_STEPS if begun[0] == begun[1] else OVERWRITTEN
            return MutantFate(Fate.EQUIVALENT, why=why, asked=kills.asked)
        if not search:
            return before or MutantFate(Fate.UNKNOWN, why=NOT_SEARCHED, asked=kills.asked)
        killed = kills.killed()
        if killed is not None:
            return killed
        if before is not None:
            return _still(before, kills)
        return _compared(first, kills, limits.until(deadline), progress)
    except LeavesDomain as error:
        return MutantFate(Fate.KILLED, DOMAINS, kills.on, why=str(error).splitlines()[0])
    except ModelError as error:
        return MutantFate(Fate.KILLED, REFUSED, kills.on, why=str(error).splitlines()[0])


class _KillSearch:
    """Asks properties about a mutant until one notices it."""

    def __init__(
        self, cases: Sequence[MutantCase], limits: Limits, deadline: float | None, progress: Progress
    ) -> None:
        self._cases = cases
        self._limits = limits
        self._deadline = deadline
        self._progress = progress
        self.asked = 0
        self.on = cases[0].mutant.name
        self.gone: MutantFate | None = None
        self.open: list[str] = []
        self._still: dict[str, set[str]] = {}

    def killed_by_runs(self) -> MutantFate | None:
        """The mutant killed by a run that is known, if one does; what runs settle otherwise is kept."""
        for case in self._cases:
            self.on = case.mutant.name
            judged = self._tried(case)
            if judged is not None:
                return judged
        return None

    def killed(self) -> MutantFate | None:
        """The mutant killed by the first property that notices it, of those that no run has settled."""
        for case, task in self._tasks():
            self.on = task.system.name
            for result in self._found(case, task):
                self.asked += not isinstance(result.verdict, Unknown)
                judged = self._judged(case, result)
                if judged is not None and judged.fate is Fate.KILLED:
                    return judged
                self.gone = self.gone or judged
        return None

    def _tried(self, case: MutantCase) -> MutantFate | None:
        by_id = {p.id: p for p in case.properties}
        still = self._still.setdefault(case.mutant.name, set())
        runs = (*case.killers, *case.runs.values(), *case.tries)
        for id, run in reaching(case.mutant, case.properties, runs):
            prop = by_id[id]
            if case.settled(prop):
                still.add(id)
            elif not isinstance(prop.form, Reachable) and self._confirmed(case, prop):
                confirm(case.mutant, prop, run)
                asked, ticks = self.asked + len(still) + 1, len(run)
                return MutantFate(Fate.KILLED, id, case.mutant.name, ticks, asked=asked, run=run)
        self.asked += len(still)
        return None

    def _tasks(self) -> Iterator[tuple[MutantCase, Task]]:
        for case in self._cases:
            self.on = case.mutant.name
            still = self._still[case.mutant.name]
            place = {p.id: number for number, p in enumerate(case.properties) if p.id not in still}
            left = [p for p in case.properties if p.id in place]
            found = tasks(left, {case.mutant.name: case.mutant})
            for task in sorted(found, key=lambda t: min(place[p.id] for p in t.properties)):
                yield case, task

    def _found(self, case: MutantCase, task: Task) -> Iterator[Result]:
        """Each verdict, by the engine that proved it of the original if it decides the mutant, too."""
        by: dict[str, list[Property]] = {}
        for prop in task.properties:
            by.setdefault(case.engines.get(prop.id, AUTO), []).append(prop)
        for engine, properties in by.items():
            left = []
            for result in self._decided(Task(task.system, tuple(properties)), engine):
                if engine != AUTO and isinstance(result.verdict, Unknown):
                    left.append(result.property)
                else:
                    yield result
            if left:
                yield from self._decided(Task(task.system, tuple(left)))

    def _decided(self, task: Task, engine: str = AUTO) -> Iterator[Result]:
        deadline = self._deadline
        if deadline is not None:
            deadline = monotonic() + SHARE * max(0.0, deadline - monotonic())
        limits = self._limits.until(deadline)
        yield from decide(
            task, {task.system.name: task.system}, engine, limits, Callbacks(self._progress), deadline
        )

    def _judged(self, case: MutantCase, result: Result) -> MutantFate | None:
        """What one verdict means: a kill, a finding that is gone, or nothing."""
        prop, verdict = result.property, result.verdict
        if isinstance(verdict, Unknown):
            self.open.append(f"{prop.id}: {verdict.reason}")
            return None
        if isinstance(verdict, Proved) is case.proved[prop.id] or not self._confirmed(case, prop):
            return None
        fate = Fate.KILLED if isinstance(verdict, Violated) else Fate.NOTICED
        run = verdict.because if isinstance(verdict.because, Trace) else None
        ticks, shortest = (None, False) if run is None else (len(run), run.shortest)
        asked, known = self.asked, run_of(verdict)
        return MutantFate(fate, prop.id, case.mutant.name, ticks, shortest, asked=asked, run=known)

    def _confirmed(self, case: MutantCase, prop: Property) -> bool:
        """Whether the verdict on the original is the expected one."""
        if case.sure:
            return True
        [found] = self._decided(Task(case.original, (prop,)))
        if isinstance(found.verdict, Unknown):
            self.open.append(f"{prop.id}: of the original, {found.verdict.reason}")
            return False
        return isinstance(found.verdict, Proved) is case.proved[prop.id]


def _still(before: MutantFate, kills: _KillSearch) -> MutantFate:
    """What a mutant that nothing killed in its own system is after others were looked at."""
    asked, left = before.asked + kills.asked, len(kills.open)
    if before.fate is not Fate.SURVIVOR:
        return replace(before, asked=asked, open=before.open + left)
    if kills.gone is not None:
        return kills.gone
    if not left:
        return replace(before, asked=asked)
    why = f"{left} of {asked + left} properties are not decided; {kills.open[0]}"
    return replace(before, fate=Fate.UNKNOWN, why=why, asked=asked, open=left)


def _compared(case: MutantCase, kills: _KillSearch, limits: Limits, progress: Progress) -> MutantFate:
    """The fate of a mutant that no property kills."""
    original, mutant, deadline = lowered(case.original), lowered(case.mutant), limits.deadline()
    asked, left = kills.asked, len(kills.open)

    def equivalent(why: str) -> MutantFate:
        why += f"; {original.name} has fewer runs" if case.original.under else ""
        return kills.gone or MutantFate(Fate.EQUIVALENT, why=why, asked=asked, open=left)

    seen = observable(case.original, case.named, case.abroad)
    seen |= observable(case.mutant, case.named, case.abroad)
    both = product(original, mutant, seen & {v.name for v in original.variables})
    if both is None:
        return equivalent("no observable variable depends on what is changed")
    never = _never(at_the_fault(original, mutant), _share(limits, deadline), progress)
    if never is not None:
        return equivalent(f"the fault never computes anything else; {never}")
    found = answers(
        PortfolioQuestion(both.system, (both.goal,)), AUTO, limits.until(deadline), Callbacks(progress)
    )
    answer, by = found[both.goal.name]
    if not isinstance(answer, Reached):
        check_domains(both.system, found)
    match answer:
        case Unreachable(because):
            return equivalent(f"{by}: {because.how}")
        case Open(reason, _):
            return kills.gone or MutantFate(Fate.UNKNOWN, why=reason, asked=asked, open=left)
        case Reached(run, shortest):
            apart = difference(original, mutant, both, run, shortest)
            if kills.gone is not None:
                return kills.gone
            if kills.open:
                why = f"{left} of {asked + left} properties are not decided; {kills.open[0]}"
                return MutantFate(Fate.UNKNOWN, why=why, asked=asked, open=left, difference=apart)
            return MutantFate(Fate.SURVIVOR, asked=asked, difference=apart)


def _share(limits: Limits, deadline: float | None) -> Limits:
    return (
        limits if deadline is None else limits.until(monotonic() + SHARE * max(0.0, deadline - monotonic()))
    )


def _never(both: Product | None, limits: Limits, progress: Progress) -> str | None:
    """The proof that the goal of a product is never reached; None if there is none within the limits."""
    if both is None:
        return None
    question = PortfolioQuestion(both.system, (both.goal,))
    found = answers(question, AUTO, limits, Callbacks(progress))
    match found[both.goal.name]:
        case Unreachable(because), by if stays(question, found):
            return f"{by}: {because.how}"
    return None


__all__ = ["Fate", "MutantCase", "MutantFate", "judged"]
