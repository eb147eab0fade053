"""Explicit search: every reachable valuation is visited, breadth first, by compiled code.

One search decides all goals; the first hit of a goal ends a shortest run.  It stops when every goal
is reached or nothing new appears.
"""

from collections.abc import Mapping, Sequence

from checker.closed import ClosedSet, Place
from checker.encode.counting import counters
from checker.encode.native import Field, NativeSearch, Task, TooWide, layout, shifts
from checker.engine import Limits, Progress, Timers
from checker.engines.explicit.levels import Found, Search
from checker.engines.explicit.lines import LineSearch
from checker.engines.explicit.runs import Runs
from checker.slice import sliced
from checker.verdict import Answer, Exhausted, Open, Reached, Unreachable
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem

NAME = "explicit"
SUMMARY = "breadth-first search of all reachable valuations, compiled to native code"


def check(
    system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """An answer for each goal, by name.

    Raises ``OutsideDomain`` when a tick gives a variable of the valuation a value outside its domain.
    """
    if not goals:
        return {}
    deadline = limits.deadline()
    part = sliced(system, goals)
    try:
        packing = layout((*part.frozen, *part.variables))
        moved = shifts(packing, counters(part)) if limits.timers is Timers.SKIP else ()
        task = Task(part, packing, tuple(goals), moved)
        progress(f"explicit: compiling {len(packing.fields)} variables in {packing.bits} bits")
        native = NativeSearch.compile(task)
    except (TooWide, ValueError) as problem:
        return {g.name: Open(str(problem), 0) for g in goals}
    found = (LineSearch if task.shifts else Search)(native, limits, deadline, progress).run()
    runs = Runs(system, task, found)
    if found.outside is not None:
        raise runs.left_domain(found.outside)
    return {g.name: _answer(found, runs, number, g) for number, g in enumerate(goals)}


def _answer(found: Found, runs: Runs, number: int, goal: Var) -> Answer:
    if found.hits[number] is not None:
        return Reached(runs.to_goal(number, goal))
    if found.stopped:
        return Open(found.stopped, found.depth)
    packing = runs.task.layout
    counted = tuple(f.var.name for f in packing.fields)
    skipped = bool(runs.task.shifts)
    closed = None if skipped else ClosedSet(tuple(map(_place, packing.fields)), found.words)
    return Unreachable(Exhausted(found.states, found.transitions, found.depth, counted, skipped, closed))


def _place(field: Field) -> Place:
    return Place(field.var, field.word, field.shift, field.bits, field.stride)
