"""The unrolling: one copy of the step per tick, in Z3 terms.

The step is built and simplified once and instantiated by substitution, since building formulas
through the Python interface takes longer than solving them.  A value after a tick that is no
constant gets a symbol of its own and an equation; substituting formulas into formulas (a purely
functional unrolling) makes the solver a hundred times slower on counters.
"""

from collections.abc import Iterable, Mapping, Sequence

import z3

from checker.encode.bitvector import Encoder, Term, literal, member, symbol, value, width
from checker.encode.cone import Slice
from checker.verdict import Run
from spec_model.lang.expr import Var


class Unrolling:
    """Ticks asserted in a solver one after the other.

    ``state`` holds the terms of the valuation after the last tick; ``values(name)`` those of a
    variable after each tick so far, the first tick first.
    """

    def __init__(self, part: Slice, watched: Iterable[str]) -> None:
        self._part = part
        self._before = _symbols(part.variables)
        self._inputs = _symbols(part.inputs)
        self._frozen = _symbols(part.frozen)
        self._step = self._instance_of_step()
        self._ticks: list[dict[str, Term]] = []
        self._watched = {name: list[Term]() for name in watched}
        self._state = [literal(v.init, v.sort, width(v.domain)) for v in part.variables]
        # With a logic named, Z3 solves incrementally by its SAT solver (30 times faster on counters).
        self.solver = z3.SolverFor("QF_BV")
        for var in part.frozen:
            self.solver.add(*member(self._frozen[var.name], var.domain))

    def __len__(self) -> int:
        return len(self._ticks)

    def values(self, name: str) -> Sequence[Term]:
        return self._watched[name]

    def tick(self) -> None:
        """Assert one more tick."""
        number = len(self._ticks) + 1
        inputs = {v.name: symbol(v, f"{v.name}@{number}") for v in self._part.inputs}
        pairs = [
            *zip(self._before.values(), self._state, strict=True),
            *zip(self._inputs.values(), inputs.values(), strict=True),
        ]
        *after, assume = z3.simplify(z3.substitute(self._step, *pairs)).children()
        self.solver.add(assume)
        self._state = [
            self._name(v, term, number) for v, term in zip(self._part.variables, after, strict=True)
        ]
        self._ticks.append(inputs)
        for var, term in zip(self._part.variables, self._state, strict=True):
            if var.name in self._watched:
                self._watched[var.name].append(term)

    def run(self, model: z3.ModelRef, ticks: int, rest: Mapping[str, int]) -> Run:
        """The run of the first ticks in a model; ``rest`` gives the inputs and frozen values left out."""
        frozen = {n: value(model.eval(t, True)) for n, t in self._frozen.items()}
        inputs = (
            {n: value(model.eval(t, True)) for n, t in tick.items()} for tick in self._ticks[:ticks]
        )
        return Run(frozen, tuple(inputs))

    def _name(self, var: Var, term: Term, number: int) -> Term:
        if term.num_args() == 0:
            return term
        name = symbol(var, f"{var.name}@{number}")
        self.solver.add(name == term)
        return name

    def _instance_of_step(self) -> Term:
        """One application that holds the next value of every variable and the assumption."""
        part = self._part
        encode = Encoder({**self._before, **self._inputs, **self._frozen})
        after = [encode.number(part.next[v.name], width(v.domain)) for v in part.variables]
        domains = [c for v in part.inputs for c in member(self._inputs[v.name], v.domain)]
        assume = z3.And([*domains, *(encode(e) for e in part.assume)])
        tuple_of = z3.Function("step", *(t.sort() for t in (*after, assume)), z3.BoolSort())
        return z3.simplify(tuple_of(*after, assume))


def _symbols(variables: Sequence[Var]) -> dict[str, Term]:
    return {v.name: symbol(v, v.name) for v in variables}
