"""Faults put into PDR on purpose: each is caught, by the independent checks of its answers or by itself.

A fault is a wrong version of one function.  The systems are those on which the fault matters; without
the fault every one of them is decided rightly.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import pytest

from rovercheck.checker.encode.bits import Circuit, Literal
from rovercheck.checker.engines.pdr import groups, search, seeds
from rovercheck.checker.engines.pdr.cubes import Cube, cube
from rovercheck.checker.engines.pdr.frames import Frames
from rovercheck.checker.engines.pdr.groups import decisions
from rovercheck.checker.engines.pdr.lemmas import Lemma, LemmaStep
from rovercheck.checker.engines.pdr.machine import PdrMachine, machine
from rovercheck.checker.engines.pdr.search import Generaliser, Lifter
from rovercheck.checker.results.verdict import Reached, Unreachable
from rovercheck.checker.search import DepthSearched, GoalReached, GoalsExcluded
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import TRUE, Expr, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests import naive
from tests.engines.test_pdr import justified
from tests.faults import PatchSuite
from tests.toys import filling

PATIENCE = 400
"""Events after which a search that never ends is given up, as a fault that shows."""


def watch() -> TransitionSystem:
    """Two counters in step; a fault is latched and the alarm follows: ``bad`` is never reached."""
    hold = flag("hold")
    a, b, seen = var("a", integer(0, 12)), var("b", integer(0, 12)), flag("seen")
    deep, bad = flag("deep"), flag("bad")
    step = (
        Assign(seen, seen | (a == 5)),
        Assign(a, ite(hold, minimum(a + 1, 12), 0)),
        Assign(b, ite(hold, minimum(b + 1, 12), 0)),
        Assign(deep, (a == 9) & seen),
        Assign(bad, (a > b) | ((a == 9) & ~seen)),
    )
    return TransitionSystem("watch", (hold,), (), (a, b, seen, deep, bad), (), step, TRUE)


def modes() -> TransitionSystem:
    """A frozen mode of two values that steers a counter; a value between would reach ``bad``."""
    mode, go, count = var("mode", chosen([1, 3]), 1), flag("go"), var("count", integer(0, 6))
    far, bad = flag("far"), flag("bad")
    step = (
        If(go, (If((mode == 3) | (count < 3), (Assign(count, minimum(count + 1, 6)),)),)),
        Assign(far, count == 6),
        Assign(bad, (mode == 2) | ((mode == 1) & (count > 3))),
    )
    return TransitionSystem("modes", (go,), (mode,), (count, far, bad), (), step, TRUE)


def guarded() -> TransitionSystem:
    """The assumption keeps an input from what would reach ``bad``."""
    push, count, bad = var("push", integer(0, 3)), var("count", integer(0, 9)), flag("bad")
    reached = flag("reached")
    step = (
        Assign(count, ite(push == 1, minimum(count + 1, 5), ite(push == 3, 7, count))),
        Assign(reached, count == 5),
        Assign(bad, count > 5),
    )
    return TransitionSystem("guarded", (push,), (), (count, reached, bad), (), step, (push < 2) | (count > 5))


SYSTEMS = (watch, modes, guarded, lambda: filling(9))


def wrong() -> Iterator[str]:
    """What is wrong with the answers about the systems: nothing, if the engine is right.

    The search gets two candidates that are wrong, and none that would spare it the work.
    """
    for make in SYSTEMS:
        system = make()
        goals = [v for v in system.variables if v.domain.sort == flag("x").sort and v.name != "seen"]
        shortest = naive.search(system, goals).reached
        answers, events = dict[str, Reached | Unreachable](), 0
        try:
            lies = [system.variables[0] < 3, system.variables[0] <= 5]
            for event in decisions(system, [g.name for g in goals], None, lies):
                events += 1
                match event:
                    case DepthSearched(names, depth):
                        for name in names:
                            if depth >= shortest.get(name, depth + 1):
                                yield f"{name} is said not to be reached within {depth} ticks"
                    case GoalReached(name, run, least):
                        answers[name] = Reached(run, least)
                    case GoalsExcluded(names, because):
                        answers |= dict.fromkeys(names, Unreachable(because))
                if events > PATIENCE:
                    yield f"{system.name} is not decided"
                    break
        except (ArithmeticError, AssertionError) as error:
            yield str(error)
        for name, answer in answers.items():
            if isinstance(answer, Reached):
                if name not in shortest or not naive.replay(system, answer.run)[-1][name]:
                    yield f"the run does not reach {name}"
            elif name in shortest or not justified(system, name, answer.because):
                yield f"{name} is not proved"


@dataclass(frozen=True)
class PdrFault:
    """A wrong version of one function."""

    name: str
    owner: object
    attribute: str
    wrong: Callable[..., object]

    def __str__(self) -> str:
        return self.name

    def __call__(self, patch: pytest.MonkeyPatch) -> None:
        patch.setattr(self.owner, self.attribute, self.wrong)


def _pushed_without_asking(self: search.PdrSearch, lemma: Lemma) -> None:
    self.frames.raise_(lemma, lemma.level + 1)


def _lost_when_pushed(self: search.PdrSearch, lemma: Lemma) -> None:
    """A clause that is dropped at propagation, as if it were implied."""
    self.frames.lemmas[lemma.level].remove(lemma)


def _never_initial(self: Frames, wanted: Cube) -> bool:
    return False


def _without_initiation(self: Generaliser, blocked: Cube, level: int) -> Cube:
    """Literals are dropped as long as the rest is blocked, initial states or not."""
    for literal in blocked.literals:
        part = cube(x for x in blocked.literals if x != literal)
        if self._frames.blocked(part, level - 1) is not None:
            blocked = part
    return blocked


def _too_general(self: Lifter, step: LemmaStep, target: Cube) -> Cube:
    whole = _into(self, step, target)
    return cube(whole.literals[:-1])


def _equal_too_early(self: search.PdrSearch) -> None:
    """The lemmas of the highest frame are taken to be inductive before two frames are equal."""
    _propagate(self)
    self._conclude(self.frames.top)


def _no_assumption(circuit: Circuit, known: Sequence[Literal]) -> PdrMachine:
    made = _machine(circuit, known)
    return replace(made, assume=made.true)


def _no_start(circuit: Circuit, known: Sequence[Literal]) -> PdrMachine:
    made = _machine(circuit, known)
    return replace(made, start=made.true, domains={})


def _unguarded_drop(self: Generaliser, blocked: Cube, level: int) -> Cube:
    """Literals are dropped without asking whether the rest is still blocked."""
    for literal in blocked.literals:
        part = cube(x for x in blocked.literals if x != literal)
        if not self._frames.initial(part):
            blocked = part
    return blocked


def _unproved(circuit: Circuit, candidates: Sequence[Expr]) -> list[seeds.Seed]:
    """Candidates that are believed because they hold before the first tick."""
    houdini = seeds._Houdini(circuit, seeds._blasted(circuit, candidates))
    houdini.drop_initially_false()
    return houdini.left


_into, _propagate, _machine = Lifter.into, search.PdrSearch._propagate, machine


class TestPdr(PatchSuite):
    FAULTS = (
        PdrFault("a clause dropped at propagation", search.PdrSearch, "_try", _lost_when_pushed),
        PdrFault("a clause pushed without asking", search.PdrSearch, "_try", _pushed_without_asking),
        PdrFault("generalisation without the initiation test", Generaliser, "_smallest", _without_initiation),
        PdrFault("initial states overlooked", Frames, "initial", _never_initial),
        PdrFault("generalisation without the induction test", Generaliser, "_smallest", _unguarded_drop),
        PdrFault("lifting that drops a needed literal", Lifter, "into", _too_general),
        PdrFault("a missing assumption", groups, "machine", _no_assumption),
        PdrFault("frozen variables that start anywhere", groups, "machine", _no_start),
        PdrFault("candidates that are not inductive", groups, "proved", _unproved),
        PdrFault("convergence declared a frame early", search.PdrSearch, "_propagate", _equal_too_early),
    )

    def wrong(self) -> Iterator[str]:
        return wrong()
