"""Property directed reachability: proves by an inductive invariant, or finds a run, bit by bit.

Works on the circuit of a system with an incremental SAT solver, without unrolling (Bradley, VMCAI 2011).
"""

from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from typing import TYPE_CHECKING

from checker.engines import Limits, Progress
from checker.engines.pdr.events import Event, PdrAnswer, PdrBound, PdrUndefined
from checker.process.isolate import ChildStopped, Send, messages
from checker.results.trace import counted_ticks
from checker.results.verdict import Answer, Open

if TYPE_CHECKING:  # `list engines` reads this file for two lines
    from spec_model.lang.expr import Var
    from spec_model.lang.system import TransitionSystem

NAME = "pdr"
SUMMARY = "proofs by inductive invariants over bits, and runs, not always the shortest (IC3 over MiniSat)"


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """Invariants and runs; ``Open`` with the ticks known to be free of a goal where neither was found.

    Bounded by ``limits.depth``, the search may still find a proof, or a run that is longer.
    """
    names = tuple(g.name for g in goals)
    state = _State(names)
    reason = _none(limits.depth or 0)
    job = (replace(system, source=None), names, limits.depth)
    try:
        with closing(messages(_work, *job, seconds=limits.seconds, memory=limits.memory)) as events:
            for event in events:
                state.note(event)
                progress(state.line())
    except ChildStopped as stopped:
        reason = str(stopped)
    return {n: state.found.get(n) or _open(state.deep[n], limits.depth, reason) for n in names}


def _open(deep: int, wanted: int | None, reason: str) -> Open:
    if wanted is not None and deep >= wanted:
        return Open(_none(wanted), deep)
    return Open(reason, deep)


def _none(ticks: int) -> str:
    return f"no run of at most {counted_ticks(ticks)} reaches it"


class _State:
    """What the child has said so far."""

    def __init__(self, goals: Sequence[str]) -> None:
        self.found: dict[str, Answer] = {}
        self.deep = dict.fromkeys(goals, 0)
        self._lemmas = 0

    def note(self, event: Event | None) -> None:
        """Take down what an event says; None only shows that time has passed."""
        match event:
            case PdrAnswer(goal, answer):
                self.found[goal] = answer
            case PdrUndefined(goals, variables, tick):
                names = ", ".join(variables)
                self.found |= dict.fromkeys(goals, Open(f"{names} may leave its domain in tick {tick}", 0))
            case PdrBound(goal, depth, lemmas):
                self.deep[goal], self._lemmas = depth, lemmas

    def line(self) -> str:
        """``pdr: depth 12, 2 goals open, 1 decided, 340 lemmas``."""
        left = [depth for name, depth in self.deep.items() if name not in self.found]
        depth = min(left or self.deep.values(), default=0)
        decided = f", {len(self.found)} decided" if self.found else ""
        return (
            f"{NAME}: depth {depth}, {len(left)} goal{'s' * (len(left) != 1)} open{decided}, "
            f"{self._lemmas:,} lemmas"
        )


def _work(send: Send, system: "TransitionSystem", goals: tuple[str, ...], depth: int | None) -> None:
    """In the child: the solver is loaded here only."""
    from checker.engines.pdr.groups import decisions

    for event in decisions(system, goals, depth):
        send(event)
