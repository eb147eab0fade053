"""Runs that are known, tried on a mutant: what they reach needs no search."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Proved, Run, StoredRun, Verdict, Violated
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.runs.domains import stayed
from rovercheck.properties.forms import Property, Unbounded
from rovercheck.properties.reduce import Question, reduce
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.system import System

SHORT = 200
"""Ticks that the reference semantics goes through while a step is compiled."""


def run_of(verdict: Verdict) -> Run | None:
    """The run that a verdict rests on, if it is a finite one."""
    match verdict:
        case Proved(Trace() as trace) | Violated(Trace() as trace) if trace.loop is None:
            return run_in(trace)
        case Proved(StoredRun(run, loop=None)) | Violated(StoredRun(run, loop=None)):
            return run
    return None


def run_in(trace: Trace) -> Run:
    """The run of a trace, as it is replayed."""
    return Run({n: trace.before[n] for n in trace.system.frozen}, tuple(tick.inputs for tick in trace.ticks))


def reached(mutant: System, properties: Sequence[Property], runs: Sequence[Run]) -> dict[str, Run]:
    """Of the properties that some of the runs violate, or reach, on the mutant: the run up to there, by id.

    A run is tried only while there is something left to be found.  Nothing is said of the other properties.
    What is found is confirmed by the reference semantics.
    """
    found, by_id = dict(reaching(mutant, properties, runs)), {p.id: p for p in properties}
    for id, run in found.items():
        confirm(mutant, by_id[id], run)
    return found


def reaching(
    mutant: System, properties: Sequence[Property], runs: Iterable[Run]
) -> Iterator[tuple[str, Run]]:
    """What ``reached`` says, each as soon as it is found; of properties about runs of any length nothing.

    Runs are gone through as compiled Python; ``confirm`` asks the reference semantics.
    """
    asked = [p for p in properties if not isinstance(p.form, Unbounded)]
    if not asked:
        return
    question, found = reduce(lowered(mutant), asked), set[str]()
    first = _first(question)
    for run in runs:
        for id, ticks in first(run).items():
            if id not in found:
                found.add(id)
                yield id, Run(run.frozen, run.inputs[:ticks])
        if len(found) == len(asked):
            return


def reached_by(run: Run, system: System, prop: Property, *, confirmed: bool = True) -> Run | None:
    """The run up to where the property is violated, or reached; None where that does not happen in it.

    A short one is gone through by the reference semantics, which is quicker than compiling the system.  A
    long one is gone through as compiled Python, and what that says is ``confirmed`` by the reference.
    """
    if len(run) > SHORT:
        way = reached if confirmed else reaching
        return dict(way(system, [prop], [run])).get(prop.id)
    ticks = _reached(reduce(lowered(system), [prop]), run).get(prop.id)
    return None if ticks is None else Run(run.frozen, run.inputs[:ticks])


def confirm(system: System, prop: Property, run: Run) -> None:
    """Raises ``AssertionError``, an internal error, unless the property is violated, or reached, after the
    run by the reference semantics, and not before."""
    if _reached(reduce(lowered(system), [prop]), run).get(prop.id) != len(run):
        raise AssertionError(f"{prop.id}: a run of {len(run)} ticks reaches it only as compiled")


def _first(question: Question) -> Callable[[Run], dict[str, int]]:
    """What says of a run the properties whose goals it reaches, and after how many ticks."""
    from rovercheck.checker.verify.runs.compiled_step import (  # not before there is a run to go through
        CompiledStep,
        TooDeep,
    )

    try:
        compiled = CompiledStep(question.system, [goal.var for goal in question.goals])
    except TooDeep:
        return lambda run: _reached(question, run)
    ids = {goal.var.name: goal.property.id for goal in question.goals}
    return lambda run: {ids[n]: ticks for n, ticks in compiled.first(run.frozen, run.inputs).items()}


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
        if len(found) == len(question.goals):
            break
        at = {n: v for n, v in after.items() if n not in inputs}
    return found


__all__ = ["confirm", "reached", "reached_by", "reaching", "run_in", "run_of"]
