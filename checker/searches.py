"""Searches in child processes: tasks go out, verdicts come back as they are found."""

import os
from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from time import monotonic

from checker.certify.certificate import Certificate
from checker.certify.file import Unwritable
from checker.certify.outcome import Outcome, Undecided
from checker.certify.record import Recorder, rests_on_answers
from checker.certifying import Certifying
from checker.decide import Disagreement, Task, decide
from checker.engine import Engine, Limits
from checker.isolate import Send
from checker.pool import Granted, Order, Pool
from checker.portfolio import Told
from checker.portfolio.question import light_evidence
from checker.result import Result
from checker.runs.replay import ReplayError
from checker.verdict import Exhausted, Inductive, Proved, Unknown, Verdict, Violated
from properties.forms import Property
from spec_model.lang.errors import ModelError
from spec_model.lang.system import System

SLACK = 2 << 30
"""Bytes of address space that a child needs besides what an engine may store: code, libraries, formulas."""
_PAUSE = 0.5


@dataclass(frozen=True)
class Doing:
    """One line on what the search of a task is doing."""

    task: Task
    line: str


@dataclass(frozen=True)
class Over:
    """The search of a task is over."""

    task: Task


@dataclass(frozen=True)
class _Decided:
    """What travels of a result: the property by its id."""

    id: str
    verdict: Verdict
    system: str


@dataclass(frozen=True)
class _Certified:
    """What travels of a certificate: the property by its id, and what came of checking it."""

    id: str
    outcome: Outcome


Heard = Doing | Over | Result


def cores() -> int:
    """The processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def searches(
    todo: Sequence[Task],
    systems: Mapping[str, System],
    engine: str | Engine,
    limits: Limits,
    jobs: int | None = None,
    certifying: Certifying | None = None,
) -> Generator[Heard, None, None]:
    """Search the tasks in order, as many at once as there are ``jobs`` (by default processors).

    A child that dies, or that does not stop within a time limit, makes what it had not yet decided
    unknown, with the reason.  Raises what ``decide`` raises, and ``Unwritable``.  Closing the generator ends
    all children.
    """
    needed = _needed(todo, systems)
    pool = Pool(jobs or cores(), _Deciding, (needed, engine, limits, certifying), limits.memory + SLACK)
    orders = [Order((task.system.name, task.properties), task.system.name) for task in todo]
    returns = [_Returns(task, certifying is not None and certifying.again) for task in todo]
    with closing(pool.run(orders)) as events:
        for event in events:
            back = returns[event.number]
            yield from back.hear(event.message)
            if event.done:
                yield from back.rest(event.failure)


class _Returns:
    """What comes back of one task: verdicts wait for their certificates, if these are checked."""

    def __init__(self, task: Task, waiting: bool) -> None:
        self._task = task
        self._waiting = waiting
        self._left = {p.id: p for p in task.properties}
        self._held: dict[str, Result] = {}

    def hear(self, message: object) -> Iterator[Heard]:
        """What a message brings.  Raises the error that is one."""
        match message:
            case Exception() as error:
                raise error
            case str(line):
                yield Doing(self._task, line)
            case _Certified(id, outcome):
                yield replace(self._held.pop(id), certificate=outcome)
            case _Decided(id, verdict, system):
                result = Result(self._left.pop(id), verdict, system)
                if self._waiting and rests_on_answers(verdict):
                    self._held[id] = result
                else:
                    yield result

    def rest(self, failure: str | None) -> Iterator[Heard]:
        """What is left of a search that is over."""
        reason = failure or "the search ended without a word on it"
        yield from (replace(r, certificate=Undecided(reason)) for r in self._held.values())
        yield from (Result(p, Unknown(reason, 0, "none"), p.on) for p in self._left.values())
        yield Over(self._task)


def _needed(todo: Sequence[Task], systems: Mapping[str, System]) -> dict[str, System]:
    """The systems of the tasks, and those on which their runs are reproduced."""
    found = {task.system.name: task.system for task in todo}
    for name in [s.concrete for s in found.values() if s.concrete]:
        found.setdefault(name, systems[name])
    return found


# --- in a child -------------------------------------------------------------------------------------


class _Deciding:
    """Decides one task after the other about systems that are sent once."""

    def __init__(
        self,
        systems: Mapping[str, System],
        engine: str | Engine,
        limits: Limits,
        certifying: Certifying | None,
    ) -> None:
        self._systems = systems
        self._engine = engine
        self._limits = limits
        self._certifying = certifying

    def __call__(self, send: Send, name: str, properties: tuple[Property, ...]) -> None:
        try:
            self._search(send, Task(self._systems[name], properties))
        except (ModelError, ReplayError) as error:
            send(next(kind for kind in (ModelError, ReplayError) if isinstance(error, kind))(str(error)))
        except (Disagreement, Unwritable) as error:
            send(error)

    def _search(self, send: Send, task: Task) -> None:
        recorder, results = Recorder(), list[Result]()
        told = Told(_Calm(send), lambda seconds: send(Granted(seconds)))
        if self._certifying is not None:
            told = replace(told, answered=recorder.answered)
        for one in decide(task, self._systems, self._engine, self._limits, told.progress, told):
            results.append(replace(one, verdict=_light(one.verdict)))
            send(_Decided(one.property.id, results[-1].verdict, one.system))
        told.granted(None)
        if self._certifying is not None:
            self._certify(send, self._certifying, task, results, recorder.made)

    def _certify(
        self,
        send: Send,
        certifying: Certifying,
        task: Task,
        results: Sequence[Result],
        made: Sequence[Certificate],
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
        if monotonic() - self._last >= _PAUSE:
            self._last = monotonic()
            self._send(line)


def _light(verdict: Verdict) -> Verdict:
    """The verdict without the valuations that an exhausted search kept."""
    if isinstance(verdict, Proved | Violated) and isinstance(verdict.because, Exhausted | Inductive):
        return replace(verdict, because=light_evidence(verdict.because))
    return verdict
