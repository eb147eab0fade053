"""Searches in child processes: tasks go out, verdicts come back as they are found."""

import os
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from time import monotonic
from typing import TYPE_CHECKING

from rovercheck.checker.cache.listeners import CachedCodeUse, CacheRefused, listening
from rovercheck.checker.cache.places import VARIABLE, chosen
from rovercheck.checker.certify.outcome import Outcome, Undecided
from rovercheck.checker.engines import Engine, Limits, Stage
from rovercheck.checker.process.faults import Fault, described, is_fault, report
from rovercheck.checker.process.faults import listening as attending
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import GrantedTime, Order, Pool, PoolEvent
from rovercheck.checker.results.verdict import Exhausted, Inductive, Proved, Unknown, Verdict, Violated
from rovercheck.checker.system.formula_json import Tree
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.certify.certificate import Certificate
    from rovercheck.checker.verify.certificates import Certification
    from rovercheck.checker.verify.portfolio.question import Found, PortfolioQuestion

SLACK = 2 << 30
"""Bytes of address space that a child needs besides what an engine may store: code, libraries, formulas."""
_PAUSE = 0.5


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
class _Decided:
    """What travels of a result: the property by its id."""

    id: str
    verdict: Verdict
    system: str


@dataclass(frozen=True)
class _Stays:
    """No run of the system of the task leaves a domain."""


@dataclass(frozen=True)
class _Certified:
    """What travels of a certificate: the property by its id, and what came of checking it."""

    id: str
    outcome: Outcome


@dataclass(frozen=True)
class MachineWarning:
    """What the user should know of the machine: no verdict is other for it."""

    text: str


TaskEvent = SearchActivity | SearchEnd | MachineWarning | Result


def cores() -> int:
    """The processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def searches(
    todo: Sequence[Task],
    systems: Mapping[str, System],
    engine: str | Engine,
    limits: Limits,
    jobs: int | None = None,
    certifying: "Certification | None" = None,
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
    needed = _needed(todo, systems)
    pool = Pool(jobs or cores(), _Deciding, (needed, engine, limits, certifying), limits.memory + SLACK)
    orders = [Order((task.system.name, task.properties, task.recorded), task.system.name) for task in todo]
    waiting = certifying is not None and certifying.again
    returns = [_Returns(task, waiting, limits.seconds) for task in todo]
    gates = {name: _Gate(sum(t.system.name == name for t in todo)) for name in needed}
    warned: set[str] = set()
    with closing(pool.run(orders, lambda number: returns[number].again())) as events:
        try:
            for event in events:
                back = returns[event.number]
                for one in _passed(gates, back.task.system.name, back.on_event(event)):
                    if isinstance(one, MachineWarning) and one.text in warned:
                        continue
                    if isinstance(one, MachineWarning):
                        warned.add(one.text)
                    yield one
        except BaseException as error:
            if not isinstance(error, GeneratorExit | ModelError):  # nothing that is said of the model
                yield from (one for gate in gates.values() for one in gate.held)
            raise


def _passed(
    gates: Mapping[str, "_Gate"], asked: str, events: Iterable["TaskEvent | _Stays"]
) -> Iterator[TaskEvent]:
    """What passes the gate of the system that was asked about, and of the one that a verdict is about."""
    for one in gates[asked].passed(events):
        if isinstance(one, Result) and one.system != asked and one.system in gates:
            yield from gates[one.system].passed([one])
        else:
            yield one


class _Gate:
    """Holds back what is proved of a system until no search of it can find that it leaves a domain."""

    def __init__(self, searches: int) -> None:
        self.held: list[Result] = []
        self._left = searches
        self._open = False

    def passed(self, events: Iterable[TaskEvent | _Stays]) -> Iterator[TaskEvent]:
        """What may go on of what is events, and what is no longer held back after it."""
        for one in events:
            match one:
                case Result(verdict=Proved()) if not self._open:
                    self.held.append(one)
                case _Stays():
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

    def __init__(self, task: Task, waiting: bool, seconds: float | None) -> None:
        self.task = task
        self._waiting = waiting
        self._seconds = seconds
        self._doing = ""
        self._left = {p.id: p for p in task.properties}
        self._held: dict[str, Result] = {}
        self._reported: dict[str, str] = {}
        self._taken = False
        self._anew = False

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

    def on_event(self, event: PoolEvent) -> Iterator[TaskEvent | _Stays]:
        """What an event brings.  Raises the error that is one."""
        if event.done:
            return self.rest(event)
        if event.failure:
            return iter([MachineWarning(_crashed(self.task, event.failure))])
        return self.on_message(event.message)

    def on_message(self, message: object) -> Iterator[TaskEvent | _Stays]:
        """What a message brings.  Raises the error that is one."""
        match message:
            case Exception() as error:
                raise error
            case str(line):
                self._doing = line
                yield SearchActivity(self.task, line)
            case _Stays():
                yield message
            case Fault():
                report(message)
            case CachedCodeUse():
                self._taken = True
            case CacheRefused(why):
                yield MachineWarning(f"Compiled searches are compiled every time: there is no cache. {why}")
            case _Certified(id, outcome) if id in self._held:
                yield self._report(replace(self._held.pop(id), certificate=outcome))
            case _Decided(id, verdict) if id in self._reported:
                self._same(id, verdict)
            case _Decided(id, verdict, system):
                result = Result(self._left.pop(id), verdict, system)
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


# --- in a child -------------------------------------------------------------------------------------
# What decides is imported here only: the parent hands out tasks, and is ready at once.


class _Deciding:
    """Decides one task after the other about systems that are sent once."""

    def __init__(
        self,
        systems: Mapping[str, System],
        engine: str | Engine,
        limits: Limits,
        certifying: "Certification | None",
    ) -> None:
        self._systems = systems
        self._engine = engine
        self._limits = limits
        self._certifying = certifying

    def __call__(
        self,
        send: Send,
        name: str,
        properties: tuple[Property, ...],
        recorded: tuple[Tree, ...] | None = None,
        anew: bool = False,
    ) -> None:
        from rovercheck.checker.certify.file import Unwritable
        from rovercheck.checker.verify.portfolio import Disagreement
        from rovercheck.checker.verify.runs.replay import ReplayError

        try:
            with listening(send, anew=anew), attending(send):
                self._search(send, Task(self._systems[name], properties, recorded))
        except (ModelError, ReplayError) as error:
            send(next(kind for kind in (ModelError, ReplayError) if isinstance(error, kind))(str(error)))
        except (Disagreement, Unwritable) as error:
            send(error)
        except Exception as error:  # what is left of the task stays open
            if is_fault(error):
                send(Fault("the search", name, described(error)))
            raise

    def _search(self, send: Send, task: Task) -> None:
        from rovercheck.checker.certify.record import Recorder
        from rovercheck.checker.verify.decide import decide
        from rovercheck.checker.verify.portfolio import Callbacks
        from rovercheck.checker.verify.portfolio.question import stays

        recorder, results, deadline = Recorder(), list[Result](), self._limits.deadline()
        send(GrantedTime(self._limits.seconds, firm=True))
        send(Stage(f"lowering {task.system.name}"))
        if not any(
            lowered(self._systems[name]).checks for name in (task.system.name, task.system.concrete) if name
        ):
            send(_Stays())

        def answered(question: "PortfolioQuestion", found: "Found") -> None:
            if self._certifying is not None:
                recorder.answered(question, found)
            if (
                task.system.name == question.system.name
                and not task.system.concrete
                and stays(question, found)
            ):
                send(_Stays())

        callbacks = Callbacks(_Calm(send), lambda seconds: send(GrantedTime(seconds)), answered)
        for one in decide(
            task, self._systems, self._engine, self._limits, callbacks.progress, callbacks, deadline
        ):
            results.append(replace(one, verdict=_light(one.verdict)))
            send(_Decided(one.property.id, results[-1].verdict, one.system))
        callbacks.on_budget(None)
        if self._certifying is not None:
            self._certify(send, self._certifying, task, results, recorder.made)

    def _certify(
        self,
        send: Send,
        certifying: "Certification",
        task: Task,
        results: Sequence[Result],
        made: Sequence["Certificate"],
    ) -> None:
        certifying.written(task, self._limits, results, made)
        progress = _Calm(send)
        for id, outcome in certifying.outcomes(
            task, self._systems, self._limits, results, made, progress
        ).items():
            send(_Certified(id, outcome))


class _Calm:
    """A progress that passes on a line now and then."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._last = float("-inf")

    def __call__(self, line: str) -> None:
        if isinstance(line, Stage) or monotonic() - self._last >= _PAUSE:
            self._last = monotonic()
            self._send(line)


def _light(verdict: Verdict) -> Verdict:
    """The verdict without the states that an exhausted search kept."""
    if isinstance(verdict, Proved | Violated) and isinstance(verdict.because, Exhausted | Inductive):
        from rovercheck.checker.verify.portfolio.question import light_evidence

        return replace(verdict, because=light_evidence(verdict.because))
    return verdict
