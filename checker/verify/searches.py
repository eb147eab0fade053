"""Searches in child processes: tasks go out, verdicts come back as they are found."""

from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from rovercheck.checker.cache.listeners import CachedCodeUse, CacheRefused, first, unheard
from rovercheck.checker.cache.places import VARIABLE, chosen
from rovercheck.checker.certify.outcome import Rejected, Undecided
from rovercheck.checker.engines import AUTO, Engine, Limits, Stage
from rovercheck.checker.model.kept_invariants import Invariants
from rovercheck.checker.process.faults import Fault, report
from rovercheck.checker.process.pool import Cluster, Jobs, Order, Pool, PoolEvent, cores
from rovercheck.checker.results.verdict import Proved, StoredRun, Unknown, Verdict
from rovercheck.checker.system.formula_json import Tree
from rovercheck.checker.verify.result import Result, limited
from rovercheck.checker.verify.search_worker import (
    PropertyCertified,
    PropertyDecided,
    SearchWorker,
    StaysInDomains,
    TaskCertificates,
)
from rovercheck.checker.verify.tasks import Task, tasks
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.store.verdicts import VerdictStore
    from rovercheck.checker.verify.certificates import Certification
    from rovercheck.checker.verify.sent_certificates import CertificateWorker

NO_LIMITS = Limits()
SLACK = 2 << 30
"""Bytes of address space that a child needs besides what an engine may store: code, libraries, formulas."""


@dataclass(frozen=True)
class SearchSettings:
    """How properties are decided: by which engine, within which limits, by how many searches at a time.

    ``engine`` is the name of one, ``auto`` or ``all``; ``jobs`` is None for one search per processor here.
    ``invariants`` of earlier proofs are tried first; ``certifying`` says what to do with proofs.  What is in
    the ``store`` is not decided again, and what is decided is kept there.  With ``traces``, a run that is
    kept is replayed; else a ``StoredRun`` stands for it.
    """

    engine: str | Engine = AUTO
    limits: Limits = NO_LIMITS
    jobs: Jobs | None = None
    invariants: Invariants = field(default_factory=dict)
    certifying: "Certification | None" = None
    store: "VerdictStore | None" = None
    traces: bool = True


@dataclass(frozen=True)
class SearchesPlanned:
    """The titles of the searches there will be."""

    titles: tuple[str, ...]


@dataclass(frozen=True)
class SearchActivity:
    """One line on what the search of a task is doing."""

    task: Task
    line: str


@dataclass(frozen=True)
class SearchEnd:
    """The search of a task is over."""

    task: Task


@dataclass(frozen=True)
class MachineWarning:
    """What the user should know of the machine: no verdict is other for it."""

    text: str


TaskEvent = SearchActivity | SearchEnd | MachineWarning | Result


def events(
    properties: Sequence[Property], systems: Mapping[str, System], search: SearchSettings
) -> Generator[SearchesPlanned | TaskEvent, None, None]:
    """Decide properties, several searches at a time: what these do, and results as they are found.

    Raises what ``searches`` raises.  Closing the generator ends all searches.
    """
    known = dict(stored(properties, systems, search))
    left = [p for p in properties if p.id not in known]
    # The largest first, so that no long search is left for the end; those of one system together.
    planned = (replace(t, recorded=on_record(t, search.invariants)) for t in tasks(left, systems))
    todo = sorted(planned, key=lambda t: (-t.size, t.system.name, t.title))
    yield SearchesPlanned(tuple(task.title for task in todo))
    yield from (limited(one, systems) for one in known.values())
    with closing(searches(todo, systems, search)) as heard:
        for one in heard:
            yield limited(one, systems) if isinstance(one, Result) else one


def stored(
    properties: Sequence[Property], systems: Mapping[str, System], search: SearchSettings
) -> Iterator[tuple[str, Result]]:
    """What is kept of the very same questions, by id, where it need not be replayed or certified."""
    if search.store is None or search.store.recheck or search.certifying is not None:
        return
    for prop in properties:
        if prop.on not in systems:
            return  # which is said where it is asked
        name = search.store.question(prop, systems)
        kept = search.store.read(name)
        if name is None or kept is None or not kept.fits(prop, systems):
            continue
        if not (search.traces and isinstance(kept.verdict.because, StoredRun)):
            yield prop.id, Result(prop, kept.verdict, kept.system, same_under=(name,))


def searches(
    todo: Sequence[Task],
    systems: Mapping[str, System],
    search: SearchSettings,
) -> Generator[TaskEvent, None, None]:
    """Search the tasks in order, as many at once as there are ``jobs`` (by default processors).

    A child that dies, or that does not stop within a time limit, makes what it had not yet decided unknown,
    with the reason.  If it crashes after it took compiled code from the cache, all of the task is first
    searched once more with code compiled anew.  Raises what ``decide`` raises, and ``Unwritable``.  Internal
    errors in a child are reported to who listens (``checker.process.faults``), or raised where nobody does.
    Closing the generator ends all children.

    A proof waits until it is known that its system leaves no domain, or not found out by any of its searches:
    nothing is proved of a system that is then refused.
    """
    needed, limits, certifying = _needed(todo, systems), search.limits, search.certifying
    here, there = None, certifying
    if certifying is not None and isinstance(search.jobs, Cluster):
        from rovercheck.checker.verify.sent_certificates import CertificateWorker

        here, there = CertificateWorker(needed, limits, certifying), replace(certifying, sent=True)
    settings = needed, search.engine, limits, there, search.store, search.traces
    pool = Pool(search.jobs or cores(), SearchWorker, settings, limits.memory + SLACK)
    orders = [Order((task.system.name, task.properties, task.recorded), task.system.name) for task in todo]
    waiting = certifying is not None and certifying.again
    returns = [_Returns(task, waiting, limits.seconds, here) for task in todo]
    asked = {prop.id: one for one in returns for prop in one.task.properties}
    gates = {name: _Gate(sum(t.system.name == name for t in todo)) for name in needed}
    keep = _Keeping(search.store, systems, gates)
    with closing(pool.run(orders, lambda number: returns[number].again())) as events:
        try:
            for event in events:
                back = returns[event.number]
                if event.failure and not event.done:  # code that crashed may have said what is not so
                    keep.forget(back.task.properties, back.kept)
                for one in _passed(gates, back.task.system.name, back.on_event(event)):
                    if isinstance(one, Result) and isinstance(search.jobs, Cluster):
                        from rovercheck.checker.verify.stored import shown_here

                        one = shown_here(one, systems)
                    if isinstance(one, Result):
                        keep(one, *asked[one.property.id].kept.get(one.property.id, ((), ())))
                        keep.flush()
                    yield one
                keep.flush()
            yield from map(_not_kept, unheard())
        except BaseException as error:
            if not isinstance(error, GeneratorExit | ModelError):  # nothing that is said of the model
                yield from (one for gate in gates.values() for one in gate.held)
            raise


def _passed(
    gates: Mapping[str, "_Gate"], asked: str, events: Iterable["TaskEvent | StaysInDomains"]
) -> Iterator[TaskEvent]:
    """What passes the gate of the system that was asked about, and of the one that a verdict is about."""
    for one in gates[asked].passed(events):
        if isinstance(one, Result) and one.system != asked and one.system in gates:
            yield from gates[one.system].passed([one])
        else:
            yield one


@dataclass
class _Keeping:
    """Keeps what was decided, once nothing can take it back.

    Nothing at all of a system that leaves a domain, nor a proof whose certificate was rejected.
    """

    store: "VerdictStore | None"
    systems: Mapping[str, System]
    gates: Mapping[str, "_Gate"]
    _waiting: list[tuple[Result, Sequence[str], Sequence[str]]] = field(default_factory=list)

    def __call__(self, one: Result, names: Sequence[str], together: Sequence[str]) -> None:
        if self.store is not None and not isinstance(one.certificate, Rejected):
            named = names or filter(None, [self.store.question(one.property, self.systems)])
            self._waiting.append((one, tuple(named), together))

    def flush(self) -> None:
        """Write what need not wait any longer."""
        waiting, self._waiting = self._waiting, []
        for one, names, together in waiting:
            if not all(self.gates[name].open for name in (one.property.on, one.system) if name in self.gates):
                self._waiting.append((one, names, together))
            elif self.store is not None:
                self.store.write_under(names, one.verdict, one.system, together)

    def forget(
        self, properties: Sequence[Property], known: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]]
    ) -> None:
        """Keep nothing of what was said of some properties."""
        ids = {p.id for p in properties}
        self._waiting = [row for row in self._waiting if row[0].property.id not in ids]
        if self.store is not None:
            for prop in (p for p in properties if p.id in known):
                for name in (self.store.question(prop, self.systems), *known[prop.id][0]):
                    self.store.remove(name)


class _Gate:
    """Holds back what is proved of a system until no search of it can find that it leaves a domain."""

    def __init__(self, searches: int) -> None:
        self.held: list[Result] = []
        self._left = searches
        self._open = False

    @property
    def open(self) -> bool:
        """Whether no search can find any more that the system leaves a domain."""
        return self._open or not self._left

    def passed(self, events: Iterable[TaskEvent | StaysInDomains]) -> Iterator[TaskEvent]:
        """What may go on of what is events, and what is no longer held back after it."""
        for one in events:
            match one:
                case Result(verdict=Proved()) if not self._open:
                    self.held.append(one)
                case StaysInDomains():
                    yield from self._opened()
                case _:
                    yield one
            if isinstance(one, SearchEnd):
                self._left -= 1
        if not self._left:
            yield from self._opened()

    def _opened(self) -> Iterator[Result]:
        self._open, held, self.held = True, self.held, []
        yield from held


class _Returns:
    """What comes back of one task: verdicts wait for their certificates, if these are checked."""

    def __init__(
        self, task: Task, waiting: bool, seconds: float | None, certify: "CertificateWorker | None" = None
    ) -> None:
        self.task = task
        self._certify = certify
        self._waiting = waiting
        self._seconds = seconds
        self._doing = ""
        self._left = {p.id: p for p in task.properties}
        self._held: dict[str, Result] = {}
        self._reported: dict[str, str] = {}
        self._taken = False
        self._anew = False
        self._results: list[Result] = []
        self.kept: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {}
        """By property the names under which the store keeps it, and what was searched together."""

    def again(self) -> Order | None:
        """What to do after a crash: search with code compiled anew; None if that was not the cause.

        All of the task, since certificates of what was told went with the child, and since code that crashed
        may have said what is not so before.
        """
        if self._anew or not self._taken:
            return None
        self._left = {p.id: p for p in self.task.properties if p.id not in self._reported}
        self._anew, self._held = True, {}
        asked = self.task.system.name, self.task.properties, self.task.recorded, True
        return Order(asked, self.task.system.name)

    def on_event(self, event: PoolEvent) -> Iterator[TaskEvent | StaysInDomains]:
        """What an event brings.  Raises the error that is one."""
        if event.done:
            return self.rest(event)
        if event.failure:
            return iter([MachineWarning(_crashed(self.task, event.failure))])
        return self.on_message(event.message)

    def on_message(self, message: object) -> Iterator[TaskEvent | StaysInDomains]:
        """What a message brings.  Raises the error that is one."""
        match message:
            case Exception() as error:
                raise error
            case str(line):
                self._doing = line
                yield SearchActivity(self.task, line)
            case StaysInDomains():
                yield message
            case Fault():
                report(message)
            case CachedCodeUse():
                self._taken = True
            case CacheRefused(why):
                if first(message):
                    yield _not_kept(why)
            case TaskCertificates() if self._certify is not None:
                from rovercheck.checker.verify.sent_certificates import certified_here

                for one in certified_here(self._certify, message, self.task, self._results):
                    yield from self.on_message(one)
            case PropertyCertified(id, outcome) if id in self._held:
                yield self._report(replace(self._held.pop(id), certificate=outcome))
            case PropertyDecided(id, verdict) if id in self._reported:
                self._same(id, verdict)
            case PropertyDecided(id, verdict, system, names, together, certificate, same):
                self.kept[id] = names, together
                asked = self._left.pop(id)
                result = Result(asked, verdict, system, certificate=certificate, same_under=same)
                self._results.append(result)
                if self._waiting and self._certified(verdict):
                    self._held[id] = result
                else:
                    yield self._report(result)

    def _report(self, result: Result) -> Result:
        self._reported[result.property.id] = result.verdict.word
        return result

    def _same(self, id: str, verdict: Verdict) -> None:
        """What was told before a crash must be so after it."""
        if {self._reported[id], verdict.word} == {"proved", "violated"}:
            raise AssertionError(
                f"{id} was {self._reported[id]}, said a search that then crashed over code from the cache "
                f"{chosen()}; with code compiled anew it is {verdict.word}. Delete the files *.o there."
            )

    @staticmethod
    def _certified(verdict: Verdict) -> bool:
        from rovercheck.checker.certify.record import rests_on_answers

        return rests_on_answers(verdict)

    def rest(self, end: PoolEvent) -> Iterator[TaskEvent]:
        """What is left of a search that is over."""
        reason = end.failure or "the search ended without a word on it"
        if end.late and self._seconds is not None and self._doing:
            reason = f"time: {self._seconds:g} s ended {_while(self._doing)}"
        elif end.failure and self._anew:
            reason = f"{end.failure}, with code compiled anew after a crash with code from the cache"
        yield from (replace(r, certificate=Undecided(reason)) for r in self._held.values())
        yield from (Result(p, Unknown(reason, 0, "none"), p.on) for p in self._left.values())
        yield SearchEnd(self.task)


def _not_kept(why: str) -> MachineWarning:
    return MachineWarning(f"Nothing is kept for the next time, neither verdicts nor compiled searches. {why}")


def _crashed(task: Task, failure: str) -> str:
    return (
        f"{task.title}: {failure} after it took compiled code from the cache {chosen()}. That code is "
        "removed, and the search is done once more with code compiled anew. If this happens again, delete "
        f"the files *.o in that folder, which is always safe; with {VARIABLE}= (empty) there is no cache."
    )


def _while(line: str) -> str:
    """``while lowering Door``, ``while compiling 9 variables (explicit)``, ``after bdd: depth 3``."""
    if not isinstance(line, Stage):
        return f"after {line}"
    engine, _, rest = line.rpartition(": ")
    return f"while {rest}" + (f" ({engine})" if engine else "")


def _needed(todo: Sequence[Task], systems: Mapping[str, System]) -> dict[str, System]:
    """The systems of the tasks, and those on which their runs are reproduced."""
    found = {task.system.name: task.system for task in todo}
    for name in [s.concrete for s in found.values() if s.concrete]:
        found.setdefault(name, systems[name])
    return found


def on_record(task: Task, invariants: Invariants) -> tuple[Tree, ...] | None:
    """The conjuncts of all recorded proofs of the properties of a task; None if there is none."""
    known = [invariants[p.id] for p in task.properties if p.id in invariants]
    return tuple(tree for trees in known for tree in trees) if known else None
