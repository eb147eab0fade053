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
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Exhausted, Inductive, Proved, StoredRun, Verdict, Violated
from rovercheck.checker.system.formula_json import Tree
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.certify.certificate import Certificate
    from rovercheck.checker.store.verdicts import StoredVerdict, VerdictStore
    from rovercheck.checker.verify.certificates import Certification
    from rovercheck.checker.verify.portfolio.question import Found, PortfolioQuestion
    from rovercheck.checker.verify.stored import StoredTask

KEPT = 1 << 22
"""Values of a closed set of which a certificate is kept: of a larger one it takes longer than the search."""
_PAUSE = 0.5
"""Seconds between two lines on what a search is doing."""


@dataclass(frozen=True)
class PropertyDecided:
    """What travels of a result: the property by its id, the names under which the store keeps it, and what
    was searched together.

    ``certificate``: of what was kept, how that was certified; ``same_under``: see ``Result``.
    """

    id: str
    verdict: Verdict
    system: str
    names: tuple[str, ...] = ()
    together: tuple[str, ...] = ()
    certificate: Outcome | None = None
    same_under: tuple[str, ...] = ()


@dataclass(frozen=True)
class StaysInDomains:
    """No run of the system of the task leaves a domain."""


@dataclass(frozen=True)
class PropertyCertified:
    """What travels of a certificate: the property by its id, and what came of checking it."""

    id: str
    outcome: Outcome


@dataclass(frozen=True)
class TaskCertificates:
    """The certificates of a task that are to be checked where it was asked for, as a file holds them."""

    data: bytes


class SearchWorker:
    """Decides one task after the other about systems that are sent once."""

    def __init__(
        self,
        systems: Mapping[str, System],
        engine: str | Engine,
        limits: Limits,
        certifying: "Certification | None",
        store: "VerdictStore | None" = None,
        traces: bool = True,
    ) -> None:
        self._systems = systems
        self._engine = engine
        self._limits = limits
        self._certifying = certifying
        self._store = store
        self._traces = traces
        self._expected: dict[str, StoredVerdict] = {}
        """What is kept of properties that are decided anew."""

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
        from rovercheck.checker.verify.stored import StoreContradiction

        try:
            with listening(send, anew=anew), attending(send):
                self._search(send, Task(self._systems[name], properties, recorded))
        except (ModelError, ReplayError) as error:
            send(next(kind for kind in (ModelError, ReplayError) if isinstance(error, kind))(str(error)))
        except (Disagreement, StoreContradiction, Unwritable) as error:
            send(error)
        except Exception as error:  # what is left of the task stays open
            if is_fault(error):
                send(Fault("the search", name, described(error)))
            raise

    def _search(self, send: Send, task: Task) -> None:
        from rovercheck.checker.certify.record import Recorder
        from rovercheck.checker.system.lowering_cache import lowered
        from rovercheck.checker.verify.decide import decide
        from rovercheck.checker.verify.portfolio import Callbacks
        from rovercheck.checker.verify.portfolio.question import stays
        from rovercheck.checker.verify.stored import StoredTask

        recorder = Recorder() if self._certifying is not None else Recorder(most=KEPT)
        results, deadline = list[Result](), self._limits.deadline()
        send(GrantedTime(self._limits.seconds, firm=True))
        send(Stage(f"lowering {task.system.name}"))
        if not any(
            lowered(self._systems[name]).checks for name in (task.system.name, task.system.concrete) if name
        ):
            send(StaysInDomains())

        def answered(question: "PortfolioQuestion", found: "Found") -> None:
            if self._certifying is not None or self._store is not None:
                recorder.answered(question, found)
            if (
                task.system.name == question.system.name
                and not task.system.concrete
                and stays(question, found)
            ):
                send(StaysInDomains())

        stored = None
        if self._store is not None and self._certifying is None:
            stored = StoredTask.of(task, self._systems, self._store, self._traces)
            task = stored.without(self._told(send, stored))
            if not task.properties:
                return
        callbacks = Callbacks(Seldom(send), lambda seconds: send(GrantedTime(seconds)), answered)
        for one in decide(task, self._systems, self._engine, self._limits, callbacks, deadline):
            results.append(replace(one, verdict=_light(one.verdict)))
            send(self._decided(results[-1], task, stored))
        callbacks.on_budget(None)
        if self._certifying is not None:
            self._certify(send, self._certifying, task, results, recorder.made)
        elif stored is not None:
            stored.keep_proofs(task, self._limits, results, recorder.made)

    def _told(self, send: Send, stored: "StoredTask") -> list[str]:
        """Send what is kept of a task; the ids of these properties."""
        assert self._store is not None
        kept = {p.id: one for p in stored.task.properties if (one := stored.kept(p)) is not None}
        shown = {id: one for id, one in kept.items() if isinstance(one.verdict.because, Trace | StoredRun)}
        how: dict[str, Outcome | None] = dict.fromkeys(shown if self._store.recheck else kept)
        if self._store.recheck:
            how |= stored.certified({id: one for id, one in kept.items() if id not in shown}, self._limits)
            self._expected = {id: one for id, one in kept.items() if id not in how}
        for id, outcome in how.items():
            one = kept[id]
            names = self._names(stored, id, one.verdict, one.system)
            same = stored.same_under(id)
            send(PropertyDecided(id, one.verdict, one.system, names, one.together, outcome, same))
        return list(how)

    def _decided(self, one: Result, task: Task, stored: "StoredTask | None") -> PropertyDecided:
        """What travels of a result that was found.  Raises ``StoreContradiction``."""
        from rovercheck.checker.verify.stored import StoreContradiction

        id = one.property.id
        if stored is None:
            return PropertyDecided(id, one.verdict, one.system)
        before = self._expected.get(id)
        if before is not None and {before.verdict.word, one.verdict.word} == {"proved", "violated"}:
            for name in (stored.names[id].question, stored.names[id].slice, stored.names[id].own):
                stored.store.remove(name)
            raise StoreContradiction(
                f"{id} is kept as {before.verdict.word}, and decided anew it is {one.verdict.word}. Do not "
                "rely on either; please report it with the command. What was kept is removed, and with "
                "--no-store nothing kept is used."
            )
        together = tuple(p.id for p in task.properties)
        names = self._names(stored, id, one.verdict, one.system)
        same = stored.same_under(id)
        return PropertyDecided(id, one.verdict, one.system, names, together, same_under=same)

    @staticmethod
    def _names(stored: "StoredTask", id: str, verdict: Verdict, system: str) -> tuple[str, ...]:
        return stored.fitting(id, verdict, about_own=system == stored.task.system.name)

    def _certify(
        self,
        send: Send,
        certifying: "Certification",
        task: Task,
        results: Sequence[Result],
        made: Sequence["Certificate"],
    ) -> None:
        if certifying.sent:
            from rovercheck.checker.certify.file import packed

            send(TaskCertificates(packed(certifying.origin(task, self._limits, results), made)))
            return
        certifying.written(task, self._limits, results, made)
        progress = Seldom(send)
        for id, outcome in certifying.outcomes(
            task, self._systems, self._limits, results, made, progress
        ).items():
            send(PropertyCertified(id, outcome))


class Seldom:
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
