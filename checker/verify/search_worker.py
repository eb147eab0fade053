"""The searches of one child process: it decides tasks and sends each verdict as soon as it is known.

What decides is imported on the first task only: the parent knows this module as well, hands out the tasks and
is ready at once.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from time import monotonic
from typing import TYPE_CHECKING

from rovercheck.checker.cache.listeners import listening
from rovercheck.checker.certify.outcome import Outcome
from rovercheck.checker.engines import Engine, Limits, Stage
from rovercheck.checker.process.faults import Fault, described, is_fault
from rovercheck.checker.process.faults import listening as attending
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import GrantedTime
from rovercheck.checker.results.verdict import Exhausted, Inductive, Proved, Verdict, Violated
from rovercheck.checker.system.formula_json import Tree
from rovercheck.checker.system.initial import require_initial_tick
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.certify.certificate import Certificate
    from rovercheck.checker.store.verdicts import VerdictStore
    from rovercheck.checker.verify.certificates import Certification
    from rovercheck.checker.verify.portfolio.question import Found, PortfolioQuestion

_PAUSE = 0.5
"""Seconds between two lines on what a search is doing."""


@dataclass(frozen=True)
class PropertyDecided:
    """What travels of a result: the property by its id, and under which slice the store keeps it."""

    id: str
    verdict: Verdict
    system: str
    slice: str | None = None


@dataclass(frozen=True)
class StaysInDomains:
    """No run of the system of the task leaves a domain."""


@dataclass(frozen=True)
class PropertyCertified:
    """What travels of a certificate: the property by its id, and what came of checking it."""

    id: str
    outcome: Outcome


class SearchWorker:
    """Decides one task after the other about systems that are sent once."""

    def __init__(
        self,
        systems: Mapping[str, System],
        engine: str | Engine,
        limits: Limits,
        certifying: "Certification | None",
        store: "VerdictStore | None" = None,
    ) -> None:
        self._systems = systems
        self._engine = engine
        self._limits = limits
        self._certifying = certifying
        self._store = store

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
            send(StaysInDomains())

        def answered(question: "PortfolioQuestion", found: "Found") -> None:
            if self._certifying is not None:
                recorder.answered(question, found)
            if (
                task.system.name == question.system.name
                and not task.system.concrete
                and stays(question, found)
            ):
                send(StaysInDomains())

        slices = self._slices(task)
        task = self._not_stored(send, task, slices)
        if not task.properties:
            return
        callbacks = Callbacks(_Calm(send), lambda seconds: send(GrantedTime(seconds)), answered)
        for one in decide(task, self._systems, self._engine, self._limits, callbacks, deadline):
            results.append(replace(one, verdict=_light(one.verdict)))
            id = one.property.id
            send(PropertyDecided(id, results[-1].verdict, one.system, slices.get(id)))
        callbacks.on_budget(None)
        if self._certifying is not None:
            self._certify(send, self._certifying, task, results, recorder.made)

    def _slices(self, task: Task) -> dict[str, str | None]:
        """Under which names the store keeps what depends on the same slices, by property."""
        if self._store is None:
            return {}
        require_initial_tick(lowered(task.system))
        return {p.id: self._store.slice(p, self._systems) for p in task.properties}

    def _not_stored(self, send: Send, task: Task, slices: Mapping[str, str | None]) -> Task:
        """What is left of a task after what is in the store; its runs are replayed."""
        if self._store is None or self._certifying is not None:
            return task
        from rovercheck.checker.verify.runs.stored import replayed

        left = []
        for prop in task.properties:
            for name in (self._store.question(prop, self._systems), slices[prop.id]):
                kept = self._store.read(name)
                verdict = None if kept is None else replayed(kept, prop, self._systems)
                if kept is not None and verdict is not None:
                    send(PropertyDecided(prop.id, verdict, kept.system, slices[prop.id]))
                    break
                if kept is not None:
                    self._store.remove(name)
            else:
                left.append(prop)
        return replace(task, properties=tuple(left))

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
            send(PropertyCertified(id, outcome))


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
