"""What an earlier search found, in the place of a new one: runs replayed, and on request proofs certified."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from rovercheck.checker.certify.certificate import Certificate
from rovercheck.checker.certify.check import CheckEffort, CheckMethod, check
from rovercheck.checker.certify.file import CertificateFile, CertificateOrigin, packed, unpacked
from rovercheck.checker.certify.outcome import Accepted
from rovercheck.checker.certify.reader import CertificateReader
from rovercheck.checker.certify.record import rests_on_answers
from rovercheck.checker.certify.terms import Malformed
from rovercheck.checker.engines import Limits
from rovercheck.checker.extras import CERTIFICATES
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Run, StoredRun, Unknown, Verdict
from rovercheck.checker.store.verdict_json import Definite
from rovercheck.checker.store.verdicts import StoredNames, StoredVerdict, VerdictStore
from rovercheck.checker.system.initial import require_initial_tick
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.decide import decide
from rovercheck.checker.verify.liveness.loops import loop_query, repeated
from rovercheck.checker.verify.portfolio.question import PortfolioQuestion
from rovercheck.checker.verify.portfolio.shape import shape
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.runs.known_runs import SHORT, reaching, run_in
from rovercheck.checker.verify.runs.replay import ReplayError, ends, followed, replay
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.forms import Property, Unbounded
from rovercheck.properties.reduce import Question, reduce
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import System, TransitionSystem

SECONDS = 60
"""For each certificate that is checked once more: what takes longer is decided anew."""


class StoreContradiction(Exception):
    """What is kept and what is found anew cannot both be so: an internal error, or a forged entry."""


@dataclass(frozen=True)
class StoredTask:
    """A task, and what is kept of its properties, under their names."""

    task: Task
    systems: Mapping[str, System]
    store: VerdictStore
    names: Mapping[str, StoredNames]
    traces: bool = True
    as_written: set[str] = field(default_factory=set)
    """Properties of which the verdict is kept for the systems as they are written."""

    @staticmethod
    def of(
        task: Task, systems: Mapping[str, System], store: VerdictStore, traces: bool = True
    ) -> "StoredTask":
        """Raises ``ModelError`` for a system that has no run or is not well formed."""
        require_initial_tick(lowered(task.system))
        names = {p.id: StoredNames(store, p, systems) for p in task.properties}
        return StoredTask(task, systems, store, names, traces)

    def kept(self, prop: Property) -> StoredVerdict | None:
        """The verdict that is kept, its run replayed; what cannot be replayed is kept no longer.

        Where no ``traces`` are asked for, a run of the very same slices stands as it is kept.  Where nothing
        is kept of these, an earlier run that the property's system still has, if it still shows the same.
        """
        names = self.names[prop.id]
        found = self._under(names.question, prop)
        if found is not None:
            self.as_written.add(prop.id)
            return found
        return self._under(names.slice, prop) or self._under(names.own, prop) or self._before(prop)

    def _under(self, name: str | None, prop: Property) -> StoredVerdict | None:
        found = self.store.read(name)
        fits = found is not None and found.fits(prop, self.systems)
        if found is not None and fits and not (self.traces or self.store.recheck):
            return found
        verdict = replayed(found, prop, self.systems) if found is not None and fits else None
        if found is not None and verdict is not None:
            return replace(found, verdict=verdict)
        if found is not None:
            self.store.remove(name)
        return None

    def fitting(self, id: str, found: Verdict, about_own: bool) -> tuple[str, ...]:
        """The names to keep a verdict under; ``about_own``: it is about the property's own system."""
        question = self.names[id].question
        if id in self.as_written and question is not None:
            return (question,)  # it is under the others too
        return self.names[id].fitting(found, about_own)

    def same_under(self, id: str) -> tuple[str, ...]:
        """The names that stand for all that a property can see of its systems."""
        names = self.names[id]
        both = (names.question,) if id in self.as_written else (names.question, names.slice)
        return tuple(name for name in both if name is not None)

    def _before(self, prop: Property) -> StoredVerdict | None:
        """The earlier run, up to where it reaches the goal; whether there is a shorter one is not known."""
        found = self.store.read(self.names[prop.id].before)
        if found is None or not found.fits(prop, self.systems):
            return None
        if not isinstance(found.verdict.because, StoredRun) or self._soon_asked_for_domains:
            return None
        known = self._as_far_as_needed(found.verdict.because, prop, self.systems[found.system])
        if known is None:
            return None
        earlier = replace(found, verdict=replace(found.verdict, because=known), together=())
        if isinstance(prop.form, Unbounded) or self.traces or self.store.recheck:
            verdict = replayed(earlier, prop, self.systems)
            return None if verdict is None else replace(earlier, verdict=verdict)
        return earlier

    @staticmethod
    def _as_far_as_needed(kept: StoredRun, prop: Property, system: System) -> StoredRun | None:
        """The run up to where it reaches the goal, if it does; one without end as it is."""
        if isinstance(prop.form, Unbounded):
            return replace(kept, shortest=False)
        asked = replace(prop, on=system.name)
        try:
            question = reduce(lowered(system), [asked])
            run, [goal] = _fitted(kept.run, question.system), question.goals
            if len(run) > SHORT:
                run = dict(reaching(system, [asked], [run]))[prop.id]
            ticks, last = followed(question.system, run, goal.var.name, until=goal.var.name)
        except (ModelError, ReplayError, KeyError):
            return None
        if not ticks or not last[goal.var.name]:
            return None
        timed = question.system.elapsed is not None
        total = ends(question.system, ticks)[-1] if timed else len(ticks) * system.tick_ms
        return StoredRun(Run(run.frozen, run.inputs[: len(ticks)]), total, shortest=False)

    @cached_property
    def _soon_asked_for_domains(self) -> bool:
        """Whether a search would soon find out if a system leaves a domain: then that is told, and no run."""
        concrete = self.task.system.concrete
        asked = [lowered(one) for one in (self.task.system, *([self.systems[concrete]] if concrete else []))]
        return any(one.checks and shape(PortfolioQuestion(one, ())).enumerable for one in asked)

    def without(self, done: Sequence[str]) -> Task:
        """What is left of the task."""
        return replace(self.task, properties=tuple(p for p in self.task.properties if p.id not in done))

    def keep_proofs(
        self, task: Task, limits: Limits, results: Sequence[Result], made: Sequence[Certificate]
    ) -> None:
        """Keep the certificates of what a search has proved."""
        proved = tuple(r.property.id for r in results if rests_on_answers(r.verdict))
        if proved and made:
            origin = CertificateOrigin(
                task.system.name, tuple(p.id for p in task.properties), proved, {}, timers=limits.timers.value
            )
            self.store.write_proof(self._proof(task.properties), packed(origin, made))

    def certified(self, kept: Mapping[str, StoredVerdict], limits: Limits) -> Iterator[tuple[str, Accepted]]:
        """Those of the proofs that are kept which their certificates show, by id, with who showed it."""
        by_id = {p.id: p for p in self.task.properties}
        for together in dict.fromkeys(one.together for one in kept.values()):
            asked = tuple(by_id[id] for id in together if id in by_id)
            reader = self._reader(asked) if len(asked) == len(together) else None
            if reader is None:
                continue
            for one in decide(Task(self.task.system, asked), self.systems, reader, limits):
                before = kept.get(one.property.id)
                shown = one.verdict.engine == reader.NAME
                if shown and before is not None and before.verdict.word == one.verdict.word:
                    yield one.property.id, Accepted(reader.ways)

    def _reader(self, together: Sequence[Property]) -> CertificateReader | None:
        whole = self.store.read_proof(self._proof(together))
        if whole is None:
            return None
        try:
            found: CertificateFile = unpacked(whole)
        except Malformed:
            return None
        effort = _effort()
        return CertificateReader(found.certificates, lambda one, system: check(one, system, effort))

    def _proof(self, together: Sequence[Property]) -> str | None:
        return self.store.about("proof", self.task.system, *together)


def _effort() -> CheckEffort:
    """Without the solver all states are tried, where that can be done."""
    by = CheckMethod.BOTH if CERTIFICATES.installed else CheckMethod.ENUMERATION
    return CheckEffort(by, SECONDS)


def replayed(kept: StoredVerdict, prop: Property, systems: Mapping[str, System]) -> Definite | None:
    """The verdict that is kept, its run replayed; None where the run does not show it."""
    because = kept.verdict.because
    if not isinstance(because, StoredRun):
        return kept.verdict
    if kept.system not in systems:
        return None
    try:
        question = reduce(lowered(systems[kept.system]), [replace(prop, on=kept.system)])
        trace = _shown(question, because)
    except (ReplayError, ModelError, KeyError):
        return None
    return replace(kept.verdict, because=replace(trace, shortest=because.shortest))


def _shown(question: Question, kept: StoredRun) -> Trace:
    """The trace of a run, which is repeated where it is one without end.

    Raises ``ReplayError`` where it shows nothing, or shows more than a run can: that no way leads back.
    """
    [goal] = question.goals
    run = _fitted(kept.run, question.system)
    if not isinstance(goal.property.form, Unbounded):
        return replay(question.system, goal, run)
    if kept.loop is None or kept.trapped is not None:
        raise ReplayError(f"{goal.property.id}: no loop is kept.")
    return repeated(loop_query(question, goal), run, kept.loop)


def _fitted(run: Run, system: TransitionSystem) -> Run:
    """The run with a value for each input and frozen variable of a system, and for no other.

    What lies beside the slice may have changed: a value that is missing, or is none any more, is the initial
    one.
    """

    def values(variables: Sequence[Var], given: Mapping[str, int]) -> dict[str, int]:
        return {v.name: raw if (raw := given.get(v.name, v.init)) in v.domain else v.init for v in variables}

    inputs = tuple(values(system.inputs, given) for given in run.inputs)
    return Run(values(system.frozen, run.frozen), inputs)


def again(result: Result, systems: Mapping[str, System]) -> Result:
    """The result with its run replayed, where that can be done."""
    if isinstance(result.verdict, Unknown):
        return result
    verdict = replayed(StoredVerdict(result.verdict, result.system), result.property, systems)
    return result if verdict is None else replace(result, verdict=verdict)


class StrangeRun(Exception):
    """A run that came from another machine does not show here what it is said to show."""


def shown_here(one: Result, systems: Mapping[str, System]) -> Result:
    """A result from elsewhere, the run that it may rest on replayed.  Raises ``StrangeRun`` if that fails."""
    verdict = one.verdict
    if isinstance(verdict, Unknown) or not isinstance(verdict.because, Trace | StoredRun):
        return one
    run = verdict.because
    if run.trapped is not None:  # a run shows the way into a trap, and not that none leads out
        return one
    kept = run if isinstance(run, StoredRun) else StoredRun(run_in(run), 0, run.loop, shortest=run.shortest)
    found = replayed(StoredVerdict(replace(verdict, because=kept), one.system), one.property, systems)
    if found is None:
        raise StrangeRun(
            f"{one.property.id}: the run that a worker of the cluster found does not show here that it is "
            f"{verdict.word}. Do not rely on the verdicts of that cluster."
        )
    return one if run is kept else replace(one, verdict=found)
