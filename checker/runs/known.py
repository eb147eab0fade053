"""Runs that are known, tried on a mutant: what they reach needs no search."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from checker.lowered import lowered
from checker.runs.compiled import Compiled
from checker.runs.domains import stayed
from checker.trace import Trace
from checker.verdict import Proved, Run, Verdict, Violated
from properties.forms import Property, Unbounded
from properties.reduce import Question, reduce
from spec_model.lang.evaluate import admissible, step
from spec_model.lang.system import System


def run_of(verdict: Verdict) -> Run | None:
    """The run that a verdict rests on, if it is a finite one."""
    match verdict:
        case Proved(Trace() as trace) | Violated(Trace() as trace) if trace.loop is None:
            return Run({n: trace.before[n] for n in trace.frozen}, tuple(tick.inputs for tick in trace.ticks))
    return None


def reached(mutant: System, properties: Sequence[Property], runs: Sequence[Run]) -> dict[str, Run]:
    """Of the properties that some of the runs violate, or reach, on the mutant: the run up to there, by id.

    A run is tried only while there is something left to be found.  Nothing is said of the other properties.
    """
    return dict(reaching(mutant, properties, runs))


def reaching(
    mutant: System, properties: Sequence[Property], runs: Iterable[Run]
) -> Iterator[tuple[str, Run]]:
    """What ``reached`` says, each as soon as it is found; of properties about runs of any length nothing."""
    asked = [p for p in properties if not isinstance(p.form, Unbounded)]
    if not asked:
        return
    question, found = reduce(lowered(mutant), asked), set[str]()
    goals = tuple(goal.var for goal in question.goals)
    ids = {goal.var.name: goal.property.id for goal in question.goals}
    compiled = Compiled(question.system, goals)
    for run in runs:
        for name, ticks in compiled.first(run.frozen, run.inputs).items():
            if ids[name] not in found:
                found.add(ids[name])
                yield ids[name], Run(run.frozen, run.inputs[:ticks])
        if len(found) == len(asked):
            return


def _reached(question: Question, run: Run) -> dict[str, int]:
    """The properties whose goals a run reaches, after how many ticks; none after one that is impossible."""
    system, found = question.system, dict[str, int]()
    begins = {v.name: v.init for v in (*system.inputs, *system.frozen)}
    at: Mapping[str, int] = {**begins, **system.init, **run.frozen}
    if any(at[v.name] not in v.domain for v in system.frozen):
        return found
    for number, tick in enumerate(run.inputs, start=1):
        inputs = {v.name: tick.get(v.name, v.init) for v in system.inputs}
        if not admissible(system, at, inputs):
            break
        after = step(system, at, inputs)
        if not stayed(system, after):
            break
        for goal in question.goals:
            if after[goal.var.name]:
                found.setdefault(goal.property.id, number)
        at = {n: v for n, v in after.items() if n not in inputs}
    return found


__all__ = ["reached", "reaching", "run_of"]
