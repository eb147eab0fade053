"""Explicit search: every reachable valuation is visited, breadth first, by compiled code.

One search decides all goals; the first hit of a goal ends a shortest run.  It stops when every goal
is reached or nothing new appears.
"""

from collections.abc import Mapping, Sequence

from checker.encode.counting import counters
from checker.encode.native import NativeSearch, Task, TooWide, layout, shifts
from checker.encode.paths import path_program
from checker.engine import Limits, Progress, Timers
from checker.engines.explicit.levels import Found, Search
from checker.engines.explicit.lines import LineSearch
from checker.engines.explicit.runs import Runs
from checker.partition import partitions
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
    cells = partitions(part)
    try:
        packing = layout((*part.frozen, *part.variables))
        moved = shifts(packing, counters(part)) if limits.timers is Timers.SKIP else ()
        task = Task(part, packing, path_program(part, cells), tuple(goals), moved)
        progress(f"explicit: compiling {len(packing.fields)} variables in {packing.bits} bits")
        native = NativeSearch.compile(task)
    except (TooWide, ValueError) as problem:
        return {g.name: Open(str(problem), 0) for g in goals}
    found = (LineSearch if task.shifts else Search)(native, limits, deadline, progress).run()
    runs = Runs(system, task, cells, found)
    if found.outside is not None:
        raise runs.left_domain(found.outside)
    return {g.name: _answer(found, runs, number, g) for number, g in enumerate(goals)}


def _answer(found: Found, runs: Runs, number: int, goal: Var) -> Answer:
    if found.hits[number] is not None:
        return Reached(runs.to_goal(number, goal))
    if found.stopped:
        return Open(found.stopped, found.depth)
    counted = tuple(f.var.name for f in runs.task.layout.fields)
    return Unreachable(
        Exhausted(found.states, found.transitions, found.depth, counted, bool(runs.task.shifts))
    )
