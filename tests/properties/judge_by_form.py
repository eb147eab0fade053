"""Monitors of logs, form by form, each from its definition: what those in past-time logic must say."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rovercheck.checker.logs.formula import Array, FormulaRows, LogPast, run_lengths, shifted
from rovercheck.properties.forms import (
    Always,
    EntersOnlyIf,
    HoldsAfter,
    HoldsFor,
    LeavesOnlyIf,
    Never,
    Precedes,
    Property,
    Reachable,
    Responds,
    Until,
    formulas,
)
from rovercheck.spec_model.lang.expr import Apply, Expr
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TICK_MS
from rovercheck.spec_model.lang.walk import plain

Truth = Callable[[Expr], Array]


@dataclass
class JudgeByForm:
    """One property on one log: the rows in which it is broken (or reached), and put to the test at all.

    Rows are given in stretches without a gap; ``past`` is what formulas remember of the rows before.
    """

    property: Property
    past: LogPast = field(default_factory=LogPast)
    rows: int = 0
    _waits: int = 0
    _left: int = 0
    _open: bool = False
    _seen: bool = False

    def gap(self) -> None:
        """Steps are missing, or what the property reads: what was before is not known any more."""
        self.past.forget(tuple(formulas(self.property.form)))
        self._waits, self._left, self._open = 0, 0, False
        self.rows = max(self.rows, self.property.from_tick)

    def advance(self, rows: FormulaRows) -> tuple[Array, Array]:
        """Where the property is broken, and where it was put to the test."""
        ticks = np.arange(self.rows + 1, self.rows + rows.count + 1)
        armed = ticks >= self.property.from_tick
        bad, tested = self._form(lambda expr: rows.truth(expr, self.past), armed)
        self.rows += rows.count
        if self.past.blank:
            unsure = min(self.past.blank, rows.count)
            self.past.blank -= unsure
            bad, tested = bad.copy(), tested.copy()
            bad[:unsure] = tested[:unsure] = False
        return bad, tested

    def _form(self, f: Truth, armed: Array) -> tuple[Array, Array]:
        match self.property.form:
            case Always(that):
                return armed & ~f(that), armed & self._antecedent(that, f)
            case Never(that):
                return armed & f(that), armed
            case Reachable(that):
                found = armed & f(that)
                return found, found
            case Responds(trigger, response, within):
                asked = armed & f(trigger)
                return self._responds(asked, f(response), within.ticks(TICK_MS)), asked
            case HoldsAfter(premise, for_, then):
                held = self._run_lengths(armed & f(premise)) > for_.ticks(TICK_MS)
                return held & ~f(then), held
            case HoldsFor(start, that, for_):
                return self._holds_for(f(start), armed, f(that), for_.ticks(TICK_MS))
            case LeavesOnlyIf(leaving, only_if):
                now = f(leaving)
                left = armed & self._shifted(now, 0) & ~now
                return left & ~f(only_if), left
            case EntersOnlyIf(entering, only_if):
                now = f(entering)
                entered = armed & ~self._shifted(now, not self.past.from_start) & now
                return entered & ~f(only_if), entered
            case Precedes(first, then):
                return self._precedes(f(first), armed & f(then))
            case Until(start, holds, release):
                return self._until(armed & f(start), f(holds), f(release))
            case _:
                raise AssertionError("no finite run breaks it")

    def _shifted(self, now: Array, first: int) -> Array:
        found, self.past.memory[id(self)] = shifted(now, self.past.memory.get(id(self), first))
        return found

    def _run_lengths(self, now: Array) -> Array:
        found, self.past.memory[id(self)] = run_lengths(now, self.past.memory.get(id(self), 0))
        return found

    def _antecedent(self, that: Expr, f: Truth) -> Array:
        """Where the premises of an implication are all true; everywhere for what is none."""
        inner = plain(that)
        if not (isinstance(inner, Apply) and inner.op is Op.OR):
            return np.asarray(True)
        negated = [plain(a) for a in inner.args]
        met: Array = np.asarray(True)
        for one in negated:
            if isinstance(one, Apply) and one.op is Op.NOT:
                met = met & ~f(one)
        return met

    def _responds(self, asked: Array, response: Array, within: int) -> Array:
        """Rows in which a trigger has waited too long: from its deadline on until the response."""
        if not within:
            return asked & ~response
        index = np.arange(1, len(asked) + 1)
        answered = np.maximum.accumulate(np.where(response, index, 0))
        waiting = asked & ~response
        first = _first_since(np.where(waiting, index, 0), answered, index)
        carried = np.where(answered == 0, self._waits, 0)
        waits = np.where(carried > 0, carried + index, np.where(first > 0, index - first + 1, 0))
        waits = np.where(response, 0, waits)
        self._waits = int(waits[-1])
        return waits > within

    def _holds_for(self, start: Array, armed: Array, that: Array, ticks: int) -> tuple[Array, Array]:
        before = self._shifted(start, not self.past.from_start)
        begins = armed & start & ~before
        index = np.arange(1, len(start) + 1)
        began = np.maximum.accumulate(np.where(begins, index, 0))
        left = np.where(began > 0, began + ticks + 1 - index, self._left - index)
        self._left = max(int(left[-1]), 0)
        return (left > 0) & ~that, begins

    def _precedes(self, first: Array, then: Array) -> tuple[Array, Array]:
        seen = np.logical_or.accumulate(first) | self._seen
        self._seen = bool(seen[-1])
        known = seen | self.past.from_start
        return then & ~seen & known, then & known

    def _until(self, start: Array, holds: Array, release: Array) -> tuple[Array, Array]:
        index = np.arange(1, len(start) + 1)
        started = np.maximum.accumulate(np.where(start, index, 0))
        released = np.maximum.accumulate(np.where(release, index, 0))
        is_open = (started > released) | ((released == 0) & self._open)
        self._open = bool(is_open[-1])
        return is_open & ~holds, is_open


def _first_since(marks: Array, since: Array, index: Array) -> Array:
    """The first marked row after ``since[i]``, for each row i; 0 for none up to it."""
    marked = marks[marks > 0]
    if not len(marked):
        return np.zeros_like(index)
    place = np.searchsorted(marked, since, side="right")
    found = marked[np.minimum(place, len(marked) - 1)]
    return np.where((place < len(marked)) & (found <= index), found, 0)
