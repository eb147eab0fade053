"""Symbolic search: sets of states as binary decision diagrams, breadth first, until nothing is new.

Burch, Clarke, McMillan, Dill, Hwang, *Symbolic model checking: 10^20 states and beyond*, LICS 1990.
"""

from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from time import monotonic
from typing import TYPE_CHECKING

from checker.engines import Limits, Progress
from checker.engines.bdd.events import BddBound, BddClosed, BddFound, BddStuck, Event
from checker.process.isolate import ChildStopped, Send, messages
from checker.results.trace import counted_ticks
from checker.results.verdict import Answer, Open, Reached, Unreachable

if TYPE_CHECKING:  # `list engines` reads this file for two lines
    from spec_model.lang.expr import Var
    from spec_model.lang.system import TransitionSystem

NAME = "bdd"
SUMMARY = "all reachable states as binary decision diagrams (OxiDD); proofs and shortest runs"

_NODE = 48
"""Bytes of a node: 36 as measured (children, count, place in the table), the rest for what Python holds."""
_STACKS = 2 << 30
"""Bytes of address space that the library reserves for the stacks of its threads, and Python's own."""


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """Shortest runs to the goals, or the closed set of states that shows that there is none."""
    names = tuple(g.name for g in goals)
    known = _Known(dict.fromkeys(names, 0))
    job = (replace(system, source=None), names, limits.depth, limits.memory // _NODE)
    reason = f"the depth limit of {counted_ticks(limits.depth or 0)}"
    try:
        with closing(messages(_work, *job, seconds=limits.seconds, memory=limits.memory + _STACKS)) as events:
            for event in events:
                known.note(event)
                progress(known.line())
    except ChildStopped as stopped:
        reason = str(stopped)
    return {n: known.answers.get(n) or Open(reason, known.deep[n]) for n in names}


@dataclass
class _Known:
    """What the events add up to: answers, and ticks in which a goal is known not to be reached."""

    deep: dict[str, int]
    answers: dict[str, Answer] = field(default_factory=dict)
    _last: BddBound = field(default=BddBound((), 0, 0, 0))
    _start: float = field(default_factory=monotonic)

    def note(self, event: Event | None) -> None:
        """Take down what an event says; None only shows that time has passed."""
        match event:
            case BddFound(goal, run):
                self.answers[goal] = Reached(run, shortest=True)
            case BddClosed(goals, because):
                self.answers |= dict.fromkeys(goals, Unreachable(because))
            case BddStuck(goals, reason):
                self.answers |= {g: Open(reason, self.deep[g]) for g in goals}
            case BddBound(goals, depth):
                self.deep |= dict.fromkeys(goals, depth)
                self._last = event

    def line(self) -> str:
        """``bdd: depth 34, 1.2e+09 states (3e+08/s), 20,310 nodes, 2 goals open``."""
        at, left = self._last, len(self.deep) - len(self.answers)
        rate = at.states / max(1e-3, monotonic() - self._start)
        counts = f"{at.states:.3g} states ({rate:.2g}/s), {at.nodes:,} nodes"
        return f"bdd: depth {at.depth}, {counts}, {left} goal{'s' * (left != 1)} open"


def _work(
    send: Send, system: "TransitionSystem", names: tuple[str, ...], most: int | None, nodes: int
) -> None:
    """In the child: send the events of the search."""
    from checker.engines.bdd.search import search

    for event in search(system, names, most, nodes):
        send(event)
