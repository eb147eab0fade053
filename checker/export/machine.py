"""Problems over words: the next value of every variable as a formula, for formats that know arithmetic."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.encode.cone import Slice, as_written, cone, folded, straying
from rovercheck.checker.encode.symbolic import SymbolicTransition, transition
from rovercheck.checker.export.problem import LEAVES, Problem
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.expr import Expr, Var, flag
from rovercheck.spec_model.lang.walk import variables


@dataclass(frozen=True)
class ExportMachine:
    """A synchronous machine, cut to the cone of influence of its bad states.

    All formulas speak of ``states`` and ``frozen`` before a tick and of its ``inputs``: ``next`` of every
    state, by name, the conditions ``assume`` (domains not included), and ``bad``, each with its name.
    """

    states: tuple[Var, ...]
    frozen: tuple[Var, ...]
    inputs: tuple[Var, ...]
    next: Mapping[str, Expr]
    assume: tuple[Expr, ...]
    bad: tuple[tuple[str, Expr], ...]

    @property
    def formulas(self) -> tuple[Expr, ...]:
        """Every formula, those of next values first."""
        return (*self.next.values(), *self.assume, *(formula for _, formula in self.bad))


def machine(problem: Problem) -> ExportMachine:
    """The machine of a problem.  Raises ``ModelError`` on a temporal word."""
    whole, goals = demanded(problem)
    part = cone(whole, goals)
    names = _read(part, goals)
    states = tuple(v for v in part.variables if v.name in names)
    following = {v.name: part.next[v.name] for v in states}
    bad = tuple((name, part.next[name]) for name in goals)
    return ExportMachine(
        states, part.frozen, whole.system.inputs, following, (*part.assume, *part.loose), bad
    )


def demanded(problem: Problem) -> tuple[SymbolicTransition, tuple[str, ...]]:
    """The transition of the system of a problem, and the names of its bad states.

    One more of these says that some variable leaves its domain, if that may be.  Of the inputs, those are
    left that matter; assumptions on inputs alone do, also outside the cone of influence: they may forbid
    every tick.
    """
    whole, goals = folded(transition(problem.system)), [b.var for b in problem.bad]
    leaving = list(straying(whole, as_written(problem.system, [g.name for g in goals])).values())
    if leaving:
        goals.append(flag(LEAVES))
        following = {**whole.next, LEAVES: whole.terms.disjunction(leaving)}
        system = replace(whole.system, variables=(*whole.system.variables, goals[-1]))
        whole = replace(whole, next=following, system=system)
    names = tuple(g.name for g in goals)
    part = cone(whole, names)
    free = {v.name for v in part.inputs} | set(variables(*part.loose))
    inputs = tuple(v for v in whole.system.inputs if v.name in free)
    return replace(whole, system=replace(whole.system, inputs=inputs)), names


def _read(part: Slice, goals: Sequence[str]) -> set[str]:
    """What the bad states and the assumption depend on through any number of ticks."""
    read = set(variables(*part.assume))
    todo = [*goals, *read]
    while todo:
        found = set(variables(part.next[name])) if (name := todo.pop()) in part.next else set()
        todo += found - read
        read |= found
    return read


def meaning(var: Var) -> str:
    """What the numbers of a variable stand for: members of an enumeration, or resolution and unit."""
    match var.sort:
        case Bool():
            return ""
        case Num() as num:
            return str(num) if num != Num() else ""
        case enum:
            return ", ".join(f"{v} = {enum.member(v)}" for v in var.domain.values)
