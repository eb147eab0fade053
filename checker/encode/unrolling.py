"""The unrolling: one copy of the step per tick, in Z3 terms.

The step is built and simplified once and instantiated by substitution, since building formulas
through the Python interface takes longer than solving them.  A value after a tick that is no
constant gets a symbol of its own and an equation; substituting formulas into formulas (a purely
functional unrolling) makes the solver a hundred times slower on counters.
"""

from collections.abc import Mapping, Sequence

import z3

from rovercheck.checker.encode.bitvector import Encoder, Term, member, symbol, value, width
from rovercheck.checker.encode.bitvector import literal as constant
from rovercheck.checker.encode.cone import Slice
from rovercheck.checker.results.verdict import Run
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem


class Unrolling:
    """Ticks asserted in a solver one after the other.

    ``events`` are conditions on the state before a tick and its inputs.  ``anywhere`` starts not
    from the initial state but from any within the domains.
    """

    def __init__(self, part: Slice, events: Sequence[Expr] = (), *, anywhere: bool = False) -> None:
        self._part = part
        self._before = _symbols(part.variables)
        self._inputs = _symbols(part.inputs)
        self._frozen = _symbols(part.frozen)
        self._step = self._whole_step(events)
        self._ticks: list[dict[str, Term]] = []
        self._after: list[dict[str, Term]] = []
        self._events: list[Sequence[Term]] = []
        # With the logic named, Z3 solves by its incremental SAT solver: 30 times faster on counters.
        self.solver = z3.SolverFor("QF_BV")
        for var in part.frozen:
            self.solver.add(*member(self._frozen[var.name], var.domain))
        self._state = [self._start(var, anywhere) for var in part.variables]
        self._first = {v.name: t for v, t in zip(part.variables, self._state, strict=True)}

    def __len__(self) -> int:
        """The number of ticks so far."""
        return len(self._ticks)

    def after(self, tick: int, name: str) -> Term:
        """A variable after a tick; the first tick is 1."""
        return self._after[tick - 1][name]

    def valuation(self, tick: int) -> dict[str, Term]:
        """The variables after a tick, 0 for before the first one, and the frozen variables."""
        state = self._after[tick - 1] if tick else self._first
        return {**state, **self._frozen}

    def inputs(self, tick: int) -> Mapping[str, Term]:
        """The inputs of a tick."""
        return self._ticks[tick - 1]

    def events(self, tick: int) -> Sequence[Term]:
        """The conditions given, in a tick."""
        return self._events[tick - 1]

    def tick(self) -> None:
        """Assert one more tick."""
        number = len(self) + 1
        inputs = {v.name: symbol(v, f"{v.name}@{number}") for v in self._part.inputs}
        pairs = [
            *zip(self._before.values(), self._state, strict=True),
            *zip(self._inputs.values(), inputs.values(), strict=True),
        ]
        assume, *rest = z3.simplify(z3.substitute(self._step, *pairs)).children()
        self.solver.add(assume)
        count = len(self._part.variables)
        named = zip(self._part.variables, rest[:count], strict=True)
        self._state = [self._name(var, term, number) for var, term in named]
        self._ticks.append(inputs)
        self._after.append({v.name: t for v, t in zip(self._part.variables, self._state, strict=True)})
        self._events.append(rest[count:])

    def run(self, model: z3.ModelRef, ticks: int) -> Run:
        """The first ticks of a model, as far as inputs and frozen variables are in the slice."""

        def of(terms: dict[str, Term]) -> dict[str, int]:
            return {name: value(model.eval(term, True)) for name, term in terms.items()}

        return Run(of(self._frozen), tuple(of(tick) for tick in self._ticks[:ticks]))

    def _start(self, var: Var, anywhere: bool) -> Term:
        if not anywhere:
            return constant(var.init, var.sort, width(var.domain))
        term = symbol(var, f"{var.name}@0")
        self.solver.add(*member(term, var.domain))
        return term

    def _name(self, var: Var, term: Term, number: int) -> Term:
        if term.num_args() == 0:
            return term
        name = symbol(var, f"{var.name}@{number}")
        self.solver.add(name == term)
        return name

    def _whole_step(self, events: Sequence[Expr]) -> Term:
        """One application that holds the assumption, the next value of every variable and the events."""
        part = self._part
        encode = Encoder({**self._before, **self._inputs, **self._frozen})
        after = [encode.number(part.next[v.name], width(v.domain)) for v in part.variables]
        domains = [c for v in part.inputs for c in member(self._inputs[v.name], v.domain)]
        assume = z3.And([*domains, *(encode(e) for e in part.assume)])
        arguments = [assume, *after, *(encode(e) for e in events)]
        together = z3.Function("step", *(a.sort() for a in arguments), z3.BoolSort())
        return z3.simplify(together(*arguments))


def model_of(
    conditions: Sequence[Expr], variables: Sequence[Var], patience: int | None = None
) -> dict[str, int] | None:
    """Values of the variables, within their domains, that satisfy the conditions; None if there are none.

    Raises ``ArithmeticError`` when Z3 gives up, at the latest after ``patience`` of its steps.
    """
    symbols = _symbols(variables)
    encode, solver = Encoder(symbols), z3.SolverFor("QF_BV")
    if patience is not None:
        solver.set("rlimit", patience)
    solver.add(*map(encode, conditions))
    solver.add(*(m for v in variables for m in member(symbols[v.name], v.domain)))
    if not satisfiable(solver):
        return None
    model = solver.model()
    return {name: value(model.eval(term, True)) for name, term in symbols.items()}


def satisfiable(solver: z3.Solver, *assumptions: Term) -> bool:
    """Whether there is a model.  Raises ``ArithmeticError`` when Z3 gives up."""
    answer = solver.check(*assumptions)
    if answer == z3.unknown:
        raise ArithmeticError(f"Z3 gave up: {solver.reason_unknown()}")
    return bool(answer == z3.sat)


def _symbols(variables: Sequence[Var]) -> dict[str, Term]:
    return {v.name: symbol(v, v.name) for v in variables}


class Outside:
    """Inputs and frozen variables outside a slice, with values that the assumption allows.

    ``possible`` is false when there are none: then the system has no run at all.
    """

    def __init__(self, system: TransitionSystem, part: Slice) -> None:
        inside = {v.name for v in part.inputs}
        inputs = model_of(part.loose, [v for v in system.inputs if v.name not in inside])
        self.possible = inputs is not None
        self._inputs = inputs or {}
        self._frozen = {v.name: v.init for v in system.frozen}

    def complete(self, run: Run) -> Run:
        """The run with values for what the slice left out."""
        ticks = tuple({**self._inputs, **tick} for tick in run.inputs)
        return Run({**self._frozen, **run.frozen}, ticks)


def steps_taken(solver: z3.Solver) -> int:
    """The steps that Z3 has counted so far: work that does not depend on the machine."""
    counts = solver.statistics()
    return int(counts.get_key_value("rlimit count")) if "rlimit count" in counts.keys() else 0  # noqa: SIM118


def literal(unrolling: Unrolling, term: Term) -> Term:
    """A fresh literal that implies the term in the solver of the unrolling."""
    fresh = z3.FreshBool("literal")
    unrolling.solver.add(z3.Implies(fresh, term))
    return fresh
