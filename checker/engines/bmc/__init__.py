"""Bounded model checking: is there a run of 1, 2, ... ticks that reaches a goal?  Finds, never proves.

The step is unrolled over bit-vectors and Z3 searches; runs come shortest first.
"""

from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from typing import TYPE_CHECKING

from checker.engines import Limits, Progress
from checker.engines.bmc.events import BmcBound, BmcFound, BmcUndefined, Event
from checker.process.isolate import ChildStopped, Send, messages
from checker.results.trace import counted_ticks
from checker.results.verdict import Answer, Open, Reached

if TYPE_CHECKING:  # `list engines` reads this file for two lines
    from spec_model.lang.expr import Var
    from spec_model.lang.system import TransitionSystem

NAME = "bmc"
SUMMARY = "shortest runs by unrolling the step over bit-vectors (Z3); a bounded search, never a proof"
DEPTH = 300
"""Ticks searched when the limits name no depth; the answer says so."""


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """Shortest runs to the goals; ``Open`` with the depth searched for those not reached."""
    depth = DEPTH if limits.depth is None else limits.depth
    names = tuple(g.name for g in goals)
    found: dict[str, Answer] = {}
    deep = dict.fromkeys(names, 0)
    reason = ""
    job = (replace(system, source=None), names, depth)
    try:
        with closing(messages(_work, *job, seconds=limits.seconds, memory=limits.memory)) as events:
            for event in events:
                _note(event, found, deep)
                progress(_line(deep, found))
    except ChildStopped as stopped:
        reason = str(stopped)
    done = _searched(limits.depth)
    return {n: found.get(n) or Open(done if deep[n] >= depth else reason, deep[n]) for n in names}


def _searched(wanted: int | None) -> str:
    """What is said of a goal when all ticks were searched; a depth that nobody asked for is named as ours."""
    if wanted is None:
        return f"no run of at most {DEPTH} ticks reaches it, and no other depth was asked for"
    return f"no run of at most {counted_ticks(wanted)} reaches it"


def _note(event: Event | None, found: dict[str, Answer], deep: dict[str, int]) -> None:
    """Take down what an event says; None only shows that time has passed."""
    match event:
        case BmcFound(goal, run):
            found[goal] = Reached(run, shortest=True)
        case BmcUndefined(goals, variables, depth):
            names = ", ".join(variables)
            found |= dict.fromkeys(goals, Open(f"{names} may leave its domain in tick {depth + 1}", depth))
        case BmcBound(goals, depth):
            deep |= dict.fromkeys(goals, depth)


def _line(deep: Mapping[str, int], found: Mapping[str, Answer]) -> str:
    left = [depth for name, depth in deep.items() if name not in found]
    depth = min(left or deep.values(), default=0)
    text = f"{NAME}: depth {depth}, {len(left)} goal{'s' * (len(left) != 1)} open"
    return text + (f", {len(found)} decided" if found else "")


def _work(send: Send, system: "TransitionSystem", goals: tuple[str, ...], depth: int) -> None:
    """In the child: Z3 is loaded here only."""
    from checker.engines.bmc.search import search

    for event in search(system, goals, depth):
        send(event)
