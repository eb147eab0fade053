"""Runs of the original, tried on a mutant: what they still reach needs no search."""

from collections.abc import Mapping, Sequence

from checker.lowered import lowered
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


def still_reached(mutant: System, properties: Sequence[Property], runs: Mapping[str, Run]) -> frozenset[str]:
    """The ids of the properties whose verdict a run of the original settles for the mutant, too.

    Each is violated, or reached, by the same inputs.  Nothing is said of the others.
    """
    asked = [p for p in properties if p.id in runs and not isinstance(p.form, Unbounded)]
    question = reduce(lowered(mutant), asked) if asked else None
    found: set[str] = set()
    for prop in asked:
        if prop.id not in found and question is not None:
            found |= _reached(question, runs[prop.id])
    return frozenset(found)


def _reached(question: Question, run: Run) -> set[str]:
    """The properties whose goals a run reaches; none after a tick that the mutant does not have."""
    system, found = question.system, set[str]()
    begins = {v.name: v.init for v in (*system.inputs, *system.frozen)}
    at: Mapping[str, int] = {**begins, **system.init, **run.frozen}
    for tick in run.inputs:
        inputs = {v.name: tick.get(v.name, v.init) for v in system.inputs}
        if not admissible(system, at, inputs):
            break
        after = step(system, at, inputs)
        if not stayed(system, after):
            break
        found |= {goal.property.id for goal in question.goals if after[goal.var.name]}
        at = {n: v for n, v in after.items() if n not in inputs}
    return found


__all__ = ["run_of", "still_reached"]
