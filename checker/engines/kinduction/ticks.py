"""What the parts of this engine share: ticks that leave no domain, and counterexamples made general."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import z3

from rovercheck.checker.encode.bitvector import Encoder, Term, value
from rovercheck.checker.encode.cone import Slice
from rovercheck.checker.encode.invariants import TemplateCube
from rovercheck.checker.encode.unrolling import Unrolling
from rovercheck.spec_model.lang.expr import Expr


class GaveUp(Exception):
    """The solver took more steps than one query may."""


@dataclass(frozen=True)
class Scope:
    """A slice and the conditions under which a tick takes one of its variables out of its domain."""

    part: Slice
    escapes: tuple[Expr, ...] = ()


class Ticks(Unrolling):
    """Ticks from any state, none of which takes a variable out of its domain.

    That there are no others is shown apart, see ``excluded``.
    """

    def __init__(self, scope: Scope, patience: int, *, anywhere: bool = True) -> None:
        super().__init__(scope.part, scope.escapes, anywhere=anywhere)
        self._part = scope.part
        self._marks = 0
        self.solver.set("rlimit", patience)

    def tick(self) -> None:
        super().tick()
        self.solver.add(*(z3.Not(e) for e in self.events(len(self))))

    def mark(self, term: Term) -> Term:
        """A fresh literal that implies the term."""
        self._marks += 1
        fresh = z3.Bool(f"assumed@{self._marks}")
        self.solver.add(z3.Implies(fresh, term))
        return fresh

    def assumed(self, conjuncts: Iterable[Expr]) -> dict[str, Expr]:
        """Literals, by name, each of which implies a conjunct before the first tick."""
        encode = Encoder(self.valuation(0))
        return {str(self.mark(encode(c))): c for c in conjuncts}

    def sat(self, *assumptions: Term) -> bool:
        """Whether there is a model.  Raises ``GaveUp``."""
        answer = self.solver.check(*assumptions)
        if answer == z3.unknown:
            raise GaveUp(self.solver.reason_unknown())
        return bool(answer == z3.sat)

    def core(self, literals: Mapping[str, Expr]) -> list[str]:
        """The literals among those given that the last query, which had no model, rests on."""
        return [str(c) for c in self.solver.unsat_core() if str(c) in literals]

    def start_and_inputs(self) -> "StartAndInputs":
        """The first state in the model and the inputs of every tick."""
        model = self.solver.model()
        given = tuple(values(model, self.inputs(t + 1)) for t in range(len(self)))
        return StartAndInputs(values(model, self.valuation(0)), given)

    def cube(self, found: "StartAndInputs", reached: Term) -> TemplateCube:
        """The first state found, and those of its variables that make the term true."""
        given = [
            _equal(self.inputs(tick)[name], raw)
            for tick, at in enumerate(found.inputs, 1)
            for name, raw in at.items()
        ]
        first = self.valuation(0)
        named = {str(self.mark(_equal(first[n], raw))): n for n, raw in found.start.items()}
        query = self.mark(z3.And(z3.Not(reached), *given))
        if self.sat(query, *map(z3.Bool, named)):
            raise ArithmeticError("Z3 gave a model that is none")
        names = {named[str(c)] for c in self.solver.unsat_core() if str(c) in named}
        return TemplateCube(found.start, frozenset(names))


@dataclass(frozen=True)
class StartAndInputs:
    """What determines the ticks of a model: the first state, frozen values too, and the inputs."""

    start: Mapping[str, int]
    inputs: tuple[Mapping[str, int], ...]


def values(model: z3.ModelRef, terms: Mapping[str, Term]) -> dict[str, int]:
    """The raw values of terms in a model."""
    return {name: value(model.eval(term, True)) for name, term in terms.items()}


def _equal(term: Term, raw: int) -> Term:
    return (term if raw else z3.Not(term)) if z3.is_bool(term) else term == raw


def excluded(scope: Scope, invariant: Sequence[Expr], patience: int) -> tuple[Expr, ...] | None:
    """The conjuncts that keep every tick within the domains; None when they do not, or Z3 gives up."""
    unrolling = Unrolling(scope.part, scope.escapes, anywhere=True)
    unrolling.solver.set("rlimit", patience)
    unrolling.tick()
    encode = Encoder(unrolling.valuation(0))
    literals = {f"conjunct@{i}": c for i, c in enumerate(invariant)}
    for name, conjunct in literals.items():
        unrolling.solver.add(z3.Implies(z3.Bool(name), encode(conjunct)))
    unrolling.solver.add(z3.Or(list(unrolling.events(1))))
    if unrolling.solver.check(*map(z3.Bool, literals)) != z3.unsat:
        return None
    names = {str(c) for c in unrolling.solver.unsat_core()}
    return tuple(c for name, c in literals.items() if name in names)
