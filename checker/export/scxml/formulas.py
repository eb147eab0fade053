"""Formulas in ECMAScript: numbers are raw values, whole; members of enumerations are named constants."""

from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.export.scxml.names import ScxmlNames
from rovercheck.checker.system.intervals import Interval, intervals
from rovercheck.spec_model.lang.chart import NOWHERE, Chart, Path
from rovercheck.spec_model.lang.domain import Bool, Enum, Num, Sort
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

EXACT = Interval(-(1 << 53) + 1, (1 << 53) - 1)
"""Whole numbers that ECMAScript has, all of them."""
_ATOM = 9
"""How tightly names and calls bind: more than any operator."""


class ScxmlFormulas:
    """Formulas of a system; a formula asks by ``In()`` which states of its charts are active.

    The state whose id is in ``begins`` is active until a chart is executed for the first time.
    """

    def __init__(self, charts: Sequence[Chart], names: ScxmlNames) -> None:
        self.names = names
        self.begins = {c.name: names.beside(c.name, (), "not entered") for c in charts}
        self._levels = {
            chart.location(path).name: (chart, path)
            for chart in charts
            for path, state in chart.states.items()
            if state.states and not state.parallel
        }
        self._entered = {chart.entered.name: chart.name for chart in charts}

    def __call__(self, expr: Expr) -> str:
        """The formula.  Raises ``ModelError`` for numbers that ECMAScript does not have exactly."""
        for one in intervals(expr).values():
            if not one.within(EXACT):
                raise ModelError(
                    f"`{expr}` takes values of more than 53 bits, which ECMAScript does not have exactly; "
                    "export to btor2 or aiger."
                )
        return self._shown(expr, 0)

    def constant(self, value: int, sort: Sort) -> str:
        """A raw value."""
        match sort:
            case Bool():
                return "true" if value else "false"
            case Enum() as enum:
                return self.names.constant(enum, value)
            case Num():
                return str(value)

    def is_active(self, chart: str, path: Path) -> str:
        """Whether a state is active."""
        return f"In('{self.names.states[chart, path]}')"

    def _shown(self, expr: Expr, above: int) -> str:
        """A part of a formula, in parentheses unless it binds more tightly than what is around it."""
        match expr:
            case Const(value, Num()) if value < 0:
                return _within(above, 7, str(value))
            case Const(value, sort):
                return self.constant(value, sort)
            case Var(name) if name in self._levels:
                return _within(above, 0, self._location(*self._levels[name], expr))
            case Var(name) if name in self._entered:
                return _within(above, 0, f"{self._has_begun(name)} ? 1 : 0")
            case Var(name):
                return self.names.data(name)
            case Named(_, body):
                return self._shown(body, above)
            case Apply(Op.EQ | Op.NE as op, (Var() as var, Const(value))) if self._says_where(var):
                return self._place(op, var, value, above)
            case Apply(Op.EQ | Op.NE as op, (Const(value), Var() as var)) if self._says_where(var):
                return self._place(op, var, value, above)
            case Apply(op, args, _):
                return self._applied(op, args, above)
        raise AssertionError(expr)

    def _applied(self, op: Op, args: Sequence[Expr], above: int) -> str:
        level, written = OPERATIONS[op]
        if not isinstance(written, str):
            return _within(above, level, written(self._shown, args))
        if op is Op.MOD and intervals(args[0])[id(args[0])].low < 0:
            divisor = self._shown(args[1], 7)
            return _within(above, level, f"({self._shown(args[0], 6)} % {divisor} + {divisor}) % {divisor}")
        first, *others = args
        compares = level in (3, 4)
        shown = [self._shown(first, 5 if compares else level)]
        shown += [self._shown(one, 5 if compares else level + 1) for one in others]
        return _within(above, level, f" {written} ".join(shown))

    # --- active states -------------------------------------------------------------------------------------

    def _says_where(self, var: Var) -> bool:
        return var.name in self._levels or var.name in self._entered

    def _has_begun(self, name: str) -> str:
        return f"!In('{self.begins[self._entered[name]]}')"

    def _place(self, op: Op, var: Var, value: int, above: int) -> str:
        """Whether a state is active, where a formula asks for it."""
        if var.name in self._entered:
            begun = self._has_begun(var.name)
            return begun if (value == 1) == (op is Op.EQ) else begun.removeprefix("!")
        chart, path = self._levels[var.name]
        member = var.domain.show(value)
        if member != NOWHERE:
            one = self.is_active(chart.name, (*path, member))
            return one if op is Op.EQ else f"!{one}"
        some = " || ".join(self.is_active(chart.name, (*path, s.name)) for s in chart.states[path].states)
        return _within(above, 1, some) if op is Op.NE else f"!({some})"

    def _location(self, chart: Chart, path: Path, var: Var) -> str:
        """The number of the active state of a level, 0 for none."""
        return "".join(
            f"{self.is_active(chart.name, (*path, one.name))} ? {var.domain.raw(one.name)} : "
            for one in chart.states[path].states
        ) + str(var.domain.raw(NOWHERE))


def _within(above: int, level: int, shown: str) -> str:
    return f"({shown})" if above > level else shown


def _call(name: str) -> "tuple[int, _Written]":
    return _ATOM, lambda show, args: f"{name}({', '.join(show(one, 0) for one in args)})"


_Show = Callable[[Expr, int], str]
_Written = Callable[[_Show, Sequence[Expr]], str]
OPERATIONS: Mapping[Op, tuple[int, str | _Written]] = {
    Op.OR: (1, "||"), Op.AND: (2, "&&"), Op.EQ: (3, "=="), Op.NE: (3, "!="),
    Op.LT: (4, "<"), Op.LE: (4, "<="), Op.GT: (4, ">"), Op.GE: (4, ">="),
    Op.ADD: (5, "+"), Op.SUB: (5, "-"), Op.MUL: (6, "*"), Op.SCALE: (6, "*"), Op.MOD: (6, "%"),
    Op.ABS: _call("Math.abs"), Op.MIN: _call("Math.min"), Op.MAX: _call("Math.max"),
    Op.ITE: (0, lambda show, args: f"{show(args[0], 1)} ? {show(args[1], 1)} : {show(args[2], 0)}"),
    Op.NOT: (7, lambda show, args: f"!{show(args[0], 7)}"),
    Op.NEG: (7, lambda show, args: f"-{show(args[0], 8)}"),
    Op.DIV: (_ATOM, lambda show, args: f"Math.floor({show(args[0], 6)} / {show(args[1], 7)})"),
    Op.BIT: (3, lambda show, args: f"Math.floor({show(args[0], 6)} / {1 << _bit(args[1])}) % 2 == 1"),
}  # fmt: skip
"""How tightly each operator binds, and the sign between its operands or how else it is written."""


def _bit(index: Expr) -> int:
    assert isinstance(index, Const)
    return index.value


__all__ = ["EXACT", "ScxmlFormulas"]
