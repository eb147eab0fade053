"""Localisation: proofs on the few variables that a goal rests on, all others being free.

Within some ticks a goal is out of reach because of some variables.  The system in which these are computed
and all others are free has more runs, and is small.  If another engine proves that it never reaches the goal,
the invariant is one of the system itself, too.  If it finds a run, the system itself is searched as deep as
that run is long: that gives a counterexample, or says which variables are to be kept as well (Kurshan,
Computer-Aided Verification of Coordinating Processes, 1994).
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from rovercheck.checker.engines import Engine, Limits, Progress, engines
from rovercheck.checker.process.isolate import ChildStopped
from rovercheck.checker.results.trace import counted_ticks
from rovercheck.checker.results.verdict import Answer, Inductive, Open, Reached, Unreachable

if TYPE_CHECKING:  # `list engines` reads this file for two lines
    from rovercheck.checker.engines.localisation.orders import Orders
    from rovercheck.spec_model.lang.expr import Var
    from rovercheck.spec_model.lang.system import TransitionSystem

NAME = "localisation"
SUMMARY = "proofs on the few variables that a goal rests on, all others free; other engines do the proving"
PROVERS = ("kinduction", "pdr")
"""Who is asked about the system with cuts: engines whose proof is an invariant."""
SHORTENER = "bmc"
"""Who is asked for a shorter run: all of the system is then searched as deep as that run is long."""
SECONDS = 60
"""What one of them may take at once: what it does not prove by then rests on too much, or on too little."""
FIRST = 2
"""Ticks of which it is asked at first why the goal is out of reach."""


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """``Unreachable`` with an inductive invariant, ``Reached`` by a run, or ``Open`` with the reason."""
    from rovercheck.checker.engines.localisation.orders import Orders

    own, deadline = replace(system, source=None), limits.deadline()
    found: dict[str, Answer] = {}
    with Orders(own, deadline, limits.memory) as orders:
        for goal in goals:
            told = _Told(progress, goal.name, len(goals) - len(found))
            try:
                found[goal.name] = _decided(own, goal, limits.until(deadline), orders, told)
            except ChildStopped as stopped:
                found[goal.name] = Open(str(stopped), 0)
    return found


class _Told:
    """Lines of progress about one goal."""

    def __init__(self, progress: Progress, goal: str, left: int) -> None:
        self._progress, self._left = progress, left

    def __call__(self, line: str) -> None:
        self._progress(f"{NAME}: {line}, {self._left} goal{'s' * (self._left != 1)} open")


def _decided(
    system: "TransitionSystem", goal: "Var", limits: Limits, orders: "Orders", told: _Told
) -> Answer:
    """Refine until a proof of the system with cuts or a run of the system itself is found."""
    from rovercheck.checker.engines.localisation.bounded_search import BoundedHit
    from rovercheck.checker.engines.localisation.cuts import with_cuts

    depth, kept, asked, deadline = FIRST, frozenset[str](), False, limits.deadline()
    while True:
        told(f"why not in {depth} ticks, {len(kept)} variables kept")
        if limits.depth is not None and depth > limits.depth:
            return Open(f"runs of at most {counted_ticks(limits.depth)} do not decide it", 0)
        why = orders.why(goal.name, depth, kept)
        if isinstance(why, BoundedHit):
            return Reached(why.run, shortest=False)
        if asked and why.kept == kept:
            return Open("a run of the system with cuts could be neither followed nor excluded", 0)
        asked, kept = True, why.kept
        answer = _query(with_cuts(system, kept), goal, limits.until(deadline), told, len(kept))
        if not isinstance(answer, Reached) or kept.issuperset(v.name for v in system.variables):
            return answer
        depth = len(answer.run)


def _query(system: "TransitionSystem", goal: "Var", limits: Limits, told: _Told, kept: int) -> Answer:
    """What the provers say of the system with cuts."""
    known: Mapping[str, Engine] = engines()
    reasons: list[str] = []
    deadline = limits.deadline()
    for name in (n for n in PROVERS if n in known):
        left = limits.until(deadline)
        share = replace(left, seconds=SECONDS if left.seconds is None else min(SECONDS, left.seconds))
        told(f"{name} on {kept} variables")
        answer = known[name].check(system, [goal], share, lambda _: None)[goal.name]
        if isinstance(answer, Reached):
            return _shortened(system, goal, answer, limits.until(deadline), known)
        if isinstance(answer, Unreachable) and _carries(answer):
            return answer
        reasons.append(f"{name}: {answer.reason}" if isinstance(answer, Open) else f"{name}: no invariant")
    return Open(f"with {kept} variables kept, " + "; ".join(reasons), 0)


def _shortened(
    system: "TransitionSystem", goal: "Var", answer: Reached, limits: Limits, known: Mapping[str, Engine]
) -> Answer:
    """A shortest run in place of one that is perhaps none."""
    if answer.shortest or SHORTENER not in known:
        return answer
    within = replace(limits, depth=len(answer.run))
    shorter = known[SHORTENER].check(system, [goal], within, lambda _: None)[goal.name]
    return shorter if isinstance(shorter, Reached) else answer


def _carries(answer: Unreachable) -> bool:
    """Whether the proof is one of the system without cuts, too.

    States that differ there need not differ in the variables that are left.
    """
    return isinstance(answer.because, Inductive) and not answer.because.simple
