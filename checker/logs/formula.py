"""Formulas over many rows at once, also those about the past, which remember where the rows before ended."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.system import arrays
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.evaluate import operate as on_values
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var, When
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.system import TICK_MS
from rovercheck.spec_model.lang.walk import nodes, variables

Array = NDArray[Any]
"""A value for each row: booleans, or raw numbers."""

FOREVER = 1 << 62
ROUNDING = 1e-4
"""Raw units by which outputs of 32-bit floats, and their differences, may be off."""


PastWord = Callable[..., tuple[Array, Any]]
"""The values of a word in each row, from those of its arguments and its state before; its state after."""


@dataclass
class LogPast:
    """What formulas about the past remember between the rows of one stretch of a log.

    After a gap nothing is remembered: ``blank`` rows, counted from the next one, cannot be judged.
    """

    memory: dict[int, Any] = field(default_factory=dict)
    from_start: bool = True
    blank: int = 0
    about: dict[int, bool] = field(default_factory=dict)
    after_gap: int | None = None

    def speaks_in(self, expr: Expr) -> bool:
        """Whether the formula is one about the past."""
        if id(expr) not in self.about:
            self.about[id(expr)] = any(isinstance(node, Temporal) for node in nodes(expr))
        return self.about[id(expr)]

    def forget(self, formulas: tuple[Expr, ...]) -> None:
        """A gap: what was before the next row is not known."""
        self.memory.clear()
        self.from_start = False
        if self.after_gap is None:
            self.after_gap = max((_blank(node) for node in nodes(*formulas)), default=0)
        self.blank = self.after_gap


def _blank(node: Expr) -> int:
    """The rows after a gap in which a formula about the past is not known."""
    match node:
        case Temporal(When.PREVIOUS | When.RISING):
            return 1
        case Temporal(When.HELD, _, span) if span is not None:
            return span.ticks(TICK_MS)
        case Temporal():
            return FOREVER
    return 0


@dataclass
class FormulaRows:
    """Successive rows: a column for each variable, and what was computed of them.

    ``rounded``: variables that the firmware computed with floats, so that their values are not exact.
    """

    columns: Mapping[str, Array]
    count: int
    rounded: frozenset[str] = frozenset()
    known: dict[tuple[int, int], Array] = field(default_factory=dict)

    def value(self, expr: Expr, past: LogPast) -> Array:
        """The formula in every row; each is computed once, one about the past once for each past."""
        key = (id(past) if past.speaks_in(expr) else 0, id(expr))
        if key not in self.known:
            self.known[key] = self._compute(expr, past)
        return self.known[key]

    def truth(self, expr: Expr, past: LogPast) -> Array:
        """The truth of a formula in every row."""
        found = np.broadcast_to(self.value(expr, past), (self.count,))
        return found if found.dtype == np.bool_ else found != 0

    def _compute(self, expr: Expr, past: LogPast) -> Array:
        match expr:
            case Const(value, sort):
                return np.asarray(bool(value) if isinstance(sort, Bool) else float(value))
            case Var(name, domain):
                column = self.columns[name]
                return column != 0 if isinstance(domain.sort, Bool) else column
            case Named(_, body):
                return self.value(body, past)
            case Apply(op, args, _):
                values = [self.value(a, past) for a in args]
                if op in COMPARISONS and self.rounded and not self.rounded.isdisjoint(variables(expr)):
                    return compared(op, *values)
                return np.asarray(OPERATIONS[op](*values))
            case Temporal(_, arg) if arg is not None:
                return self._temporal(expr, arg, past)
        raise AssertionError(f"{expr} belongs to a chart")

    def _temporal(self, word: Temporal, arg: Expr, past: LogPast) -> Array:
        now = np.broadcast_to(self.value(arg, past), (self.count,))
        match word.when:
            case When.PREVIOUS:
                return self._remembered(shifted, now, word, past, _initial(arg) if past.from_start else 0)
            case When.RISING:
                return now & ~self._remembered(shifted, now, word, past, 1)
            case When.HELD:
                assert word.span is not None
                return self._remembered(run_lengths, now, word, past, 0) > word.span.ticks(TICK_MS)
            case _:
                return self._remembered(seen, now, word, past, False)

    def _remembered(self, of: PastWord, now: Array, word: Temporal, past: LogPast, first: Any) -> Array:
        found, past.memory[id(word)] = of(now, past.memory.get(id(word), first))
        return found


def _initial(expr: Expr) -> int:
    """The value of a formula before the first tick, as ``properties.reduce`` has it."""
    match expr:
        case Const(value, _):
            return value
        case Var(init=init):
            return init
        case Named(_, body):
            return _initial(body)
        case Apply(op, args, _):
            return on_values(op, *map(_initial, args))
        case Temporal(When.PREVIOUS, arg) if arg is not None:
            return _initial(arg)
    return 0


def shifted(now: Array, before: Any) -> tuple[Array, Any]:
    """The value of the row before."""
    found = np.empty_like(now)
    found[0], found[1:] = before, now[:-1]
    return found, now[-1]


def run_lengths(now: Array, before: int) -> tuple[Array, int]:
    """For how many rows up to each one, this one included, it has been true without a break."""
    index = np.arange(1, len(now) + 1)
    broken = np.maximum.accumulate(np.where(now, 0, index))
    found = np.where(now, index - broken + np.where(broken == 0, before, 0), 0)
    return found, int(found[-1])


def seen(now: Array, before: bool) -> tuple[Array, bool]:
    """Whether it is or was true."""
    found = np.logical_or.accumulate(now) | before
    return found, bool(found[-1])


def compared(op: Op, left: Array, right: Array) -> Array:
    """A comparison in which values that differ by rounding alone are equal."""
    apart = left.astype(np.float64) - right.astype(np.float64)
    return np.asarray(OPERATIONS[op](np.where(abs(apart) < ROUNDING, 0.0, apart), 0.0))


def _bit(values: Array, index: Array) -> Array:
    with np.errstate(invalid="ignore"):  # of a value that is not known nobody asks for the result
        return np.asarray((values.astype(np.int64) >> index.astype(np.int64)) & 1 != 0)


OPERATIONS: Mapping[Op, Callable[..., Any]] = {**arrays.OPERATIONS, Op.BIT: _bit}
"""Every operator on columns, in which numbers are 64-bit floats."""
