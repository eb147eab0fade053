"""One tick from a known state: all that is left of it are formulas over its inputs, which a solver decides.

The step is executed symbolically with the state as constants, so that most of it folds away: of the whole
rover, what its transitions depend on in one tick is a few formulas of at most five inputs each.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

import z3

from rovercheck.checker.encode.bitvector import Encoder, member, symbol, value
from rovercheck.checker.encode.symbolic import SymbolicTransition, transition
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.evaluate import OPERATIONS, evaluate
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables


class ChosenValues:
    """Values of all that is open in a tick, and what formulas come to with them, each part of them once.

    The reference is ``evaluate``, which goes through what formulas share again and again.
    """

    def __init__(self, values: Mapping[str, int]) -> None:
        self.values = values
        self._known: dict[int, int] = {}
        self._held: list[Expr] = []  # what is known by its id must stay

    def of(self, expr: Expr) -> int:
        """The raw value of a formula."""
        if isinstance(expr, Var):
            return self.values[expr.name]
        if isinstance(expr, Const):
            return expr.value
        known = self._known.get(id(expr))
        if known is None:
            known = self._known[id(expr)] = self._applied(expr)
            self._held.append(expr)
        return known

    def _applied(self, expr: Expr) -> int:
        if not isinstance(expr, Apply):
            return evaluate(expr, self.values)
        op, args = expr.op, expr.args
        if op is _AND:
            return int(all(self.of(arg) for arg in args))
        if op is _OR:
            return int(any(self.of(arg) for arg in args))
        if op is _ITE:
            return self.of(args[1] if self.of(args[0]) else args[2])
        return OPERATIONS[op](*[self.of(arg) for arg in args])


_AND, _OR, _ITE = Op.AND, Op.OR, Op.ITE  # an attribute of an enumeration costs as much as the operation


class OneTick:
    """The tick after ``state`` (raw values by name), in which the variables ``open`` are still to be chosen.

    ``open`` are the inputs of the system, before the first tick its frozen variables too.
    """

    def __init__(self, system: TransitionSystem, state: Mapping[str, int], open: Sequence[Var]) -> None:
        self.open = {v.name: v for v in open}
        known = {
            v.name: state.get(v.name, v.init)
            for v in (*system.variables, *system.frozen)
            if v.name not in self.open
        }
        self._tick: SymbolicTransition = transition(system, known=known)
        self._about = [(part, frozenset(variables(part))) for part in self._tick.assume]

    def after(self, name: str) -> Expr:
        """The value of a variable after the tick, as a formula over what is open."""
        return self._tick.next[name]

    def is_open(self, name: str) -> bool:
        """Whether the value of a variable after the tick may depend on what is open."""
        return not isinstance(self._tick.next[name], Const)

    @property
    def assumed(self) -> tuple[Expr, ...]:
        """What is assumed of what is open, as conjuncts."""
        return self._tick.assume

    def admits(self, chosen: Mapping[str, int], about: str = "") -> bool:
        """Whether values of all that is open are admissible; only what is assumed ``about`` one, if given."""
        at = ChosenValues(chosen)
        return all(at.of(part) for part, names in self._about if not about or about in names)

    @cached_property
    def _solver(self) -> "z3.Solver":
        solver = z3.Solver()
        for name, var in self.open.items():
            solver.add(*member(self._symbols[name], var.domain))
        solver.add(*(self._encoder(part) for part in self._tick.assume))
        return solver

    @cached_property
    def _symbols(self) -> dict[str, object]:
        return {name: symbol(var, name) for name, var in self.open.items()}

    @cached_property
    def _encoder(self) -> Encoder:
        return Encoder(self._symbols)

    def choices(
        self, of: Sequence[Expr], under: Sequence[Expr], standing: Mapping[str, int]
    ) -> Iterator[dict[str, int]]:
        """Admissible values of all that is open, one for each combination of values that formulas can have.

        Only values that make ``under`` true.  The first are those that stand, where they do; what a solver
        left undecided stands, too.
        """
        solver = self._solver
        solver.push()
        try:
            solver.add(*(self._encoder(formula) for formula in under))
            stands = self._meets(standing, under)
            while stands or self._satisfiable(solver):
                found = dict(standing) if stands else self._values(solver.model(), standing, under)
                yield found
                if not of:
                    return
                at = ChosenValues(found)
                others = [Apply(Op.NE, (f, Const(at.of(f), f.sort)), Bool()) for f in of]
                solver.add(z3.Or([self._encoder(other) for other in others]))
                stands = False
        finally:
            solver.pop()

    @staticmethod
    def _satisfiable(solver: "z3.Solver") -> bool:
        answer = solver.check()
        assert answer != z3.unknown, f"formulas over bits are decided: {solver.reason_unknown()}"
        return bool(answer == z3.sat)

    def _meets(self, chosen: Mapping[str, int], under: Sequence[Expr]) -> bool:
        at = ChosenValues(chosen)
        met = (at.of(formula) for formula in under)
        return self.admits(chosen) and all(met)

    def _values(
        self, model: "z3.ModelRef", standing: Mapping[str, int], under: Sequence[Expr]
    ) -> dict[str, int]:
        """The values of a model, those that it leaves open as they stand if that will do."""
        told = {name: model[term] for name, term in self._symbols.items()}
        found = {**standing, **{name: value(term) for name, term in told.items() if term is not None}}
        if self._meets(found, under):
            return found
        return {n: value(model.eval(s, model_completion=True)) for n, s in self._symbols.items()}

    def nearest(
        self, chosen: Mapping[str, int], standing: Mapping[str, int], kept: Sequence[tuple[Expr, int]]
    ) -> dict[str, int]:
        """Values like ``chosen`` of which as few as can be differ from those that stand.

        The formulas of ``kept`` keep these values; no single change can be taken back (another set of changes
        may be smaller).  A number that has to change becomes its initial value, or an end of its domain, if
        that will do.
        """
        now = dict(chosen)
        needed = [(formula, wanted, frozenset(variables(formula))) for formula, wanted in kept]

        def fine(name: str) -> bool:
            at = ChosenValues(now)
            met = (at.of(formula) == wanted for formula, wanted, names in needed if name in names)
            return self.admits(now, name) and all(met)

        def plainer(name: str) -> bool:
            var, before = self.open[name], now[name]
            for tried in (standing[name], *(() if name in tidied else (var.init, *_ends(var)))):
                now[name] = tried
                if tried in var.domain and fine(name):
                    tidied.add(name)
                    return bool(tried != before)
            now[name] = before
            return False

        tidied: set[str] = set()
        while any([plainer(name) for name in chosen if now[name] != standing[name]]):
            pass
        return now


def _ends(var: Var) -> tuple[int, int]:
    return var.domain.low, var.domain.high
