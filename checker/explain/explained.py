"""A trace with the inputs that force its end, found by a solver and checked by replay."""

from dataclasses import replace

from checker.engines import Progress, quiet
from checker.explain.completions import check
from checker.explain.needed import forcing
from checker.explain.unrolled import Over, never
from checker.results.trace import Trace
from checker.results.verdict import Run
from checker.system.lowered import lowered
from properties.forms import Property
from properties.reduce import reduce
from spec_model.lang.system import System


def unexplained(trace: Trace) -> str:
    """Why no inputs that force the end of a trace are looked for; empty if they are."""
    if trace.loop is not None:
        return "the run has no end that inputs could force: it repeats for ever"
    if trace.trapped is not None:
        return "what is out of reach after a run is no matter of its inputs alone"
    return ""


def explained(
    trace: Trace,
    prop: Property,
    system: System,
    progress: Progress = quiet,
    over: Over = never,
) -> Trace:
    """The trace of a property on a system with the inputs that force its end.

    As it is, if ``unexplained`` says why.  ``over`` tells that the time is over.  Raises ``OutOfTime`` if
    nothing was found by then, and ``ReplayError`` if a run with the needed inputs ends otherwise.
    """
    if unexplained(trace) or not len(trace):
        return trace
    question = reduce(lowered(system), [replace(prop, on=system.name)])
    [goal] = question.goals
    frozen = {v.name: trace.before[v.name] for v in question.system.frozen}
    run = Run(frozen, tuple(tick.inputs for tick in trace.ticks))
    found = forcing(question.system, goal.var, run, progress, over)
    progress("replaying other runs with the same needed inputs")
    check(question.system, goal.var, run, found)
    return replace(trace, needed=found.needed, minimal=found.minimal, smallest=found.smallest)
