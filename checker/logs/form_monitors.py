"""The forms of properties as monitors of a log, many rows at a time: past-time logic on columns.

After a gap nothing is known of the rows before.  A truth value then has bounds, as in Kleene's logic: whether
it is true whatever was before, and whether it can be.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from typing import Any

import numpy as np

from rovercheck.checker.logs.formula import (
    FOREVER,
    Array,
    FormulaRows,
    LogPast,
    PastWord,
    run_lengths,
    seen,
    shifted,
)
from rovercheck.properties.forms import Always, Property, Unbounded, formulas
from rovercheck.properties.pasttime import Bounded
from rovercheck.spec_model.lang.expr import Apply, Expr
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TICK_MS
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.walk import plain


@dataclass(frozen=True)
class Bounds:
    """A truth value in each row: where it must be true, and where it may be; one array where all is known."""

    must: Array
    may: Array

    @property
    def known(self) -> bool:
        return self.must is self.may

    def __and__(self, other: "Bounds") -> "Bounds":
        return self._joined(np.logical_and, other)

    def __or__(self, other: "Bounds") -> "Bounds":
        return self._joined(np.logical_or, other)

    def __invert__(self) -> "Bounds":
        return sure(~self.must) if self.known else Bounds(~self.may, ~self.must)

    def _joined(self, join: Callable[[Array, Array], Array], other: "Bounds") -> "Bounds":
        must = join(self.must, other.must)
        return sure(must) if self.known and other.known else Bounds(must, join(self.may, other.may))


def sure(values: Array) -> Bounds:
    return Bounds(values, values)


@dataclass
class Judge:
    """One property on one log: the rows in which it is broken (or reached), and put to the test at all.

    Rows are given in stretches without a gap; ``past`` is what formulas remember of the rows before,
    ``states`` what the words of the form do, by word and place: the least and the most that can be.
    """

    property: Property
    past: LogPast = field(default_factory=LogPast)
    rows: int = 0
    states: dict[tuple[str, int], tuple[Any, Any]] = field(default_factory=dict)

    def gap(self) -> None:
        """Steps are missing, or what the property reads: what was before is not known any more."""
        self.past.forget(tuple(formulas(self.property.form)))
        # What was true once still was.
        self.states = {key: (low, True) for key, (low, _) in self.states.items() if key[0] == ONCE}
        self.rows = max(self.rows, self.property.from_tick)

    def advance(self, rows: FormulaRows) -> tuple[Array, Array]:
        """Where the property is broken, and where it was put to the test."""
        ticks = np.arange(self.rows + 1, self.rows + rows.count + 1)
        form, past = self.property.form, RowsPast(self, rows, sure(ticks >= self.property.from_tick))
        assert isinstance(form, Bounded), "no finite run breaks it"
        tested, bad = (truth.must for truth in form.monitor(past))
        if isinstance(form, Always):
            tested = tested & _antecedent(form.that, past)
        self.rows += rows.count
        if self.past.blank:
            unsure = min(self.past.blank, rows.count)
            self.past.blank -= unsure
            bad, tested = bad.copy(), tested.copy()
            bad[:unsure] = tested[:unsure] = False
        return bad, tested


def _antecedent(that: Expr, past: "RowsPast") -> Array:
    """Where the premises of an implication are all true; everywhere for what is none."""
    inner = plain(that)
    parts = inner.args if isinstance(inner, Apply) and inner.op is Op.OR else ()
    met: Array = np.asarray(True)
    for one in map(plain, parts):
        if isinstance(one, Apply) and one.op is Op.NOT:
            met = met & ~past(one).must
    return met


# --- the words of the past -----------------------------------------------------------------------

ONCE = "once"


class RowsPast:
    """Past-time logic on some rows of a log."""

    def __init__(self, judge: Judge, rows: FormulaRows, armed: Bounds) -> None:
        self._judge, self._rows, self.armed = judge, rows, armed
        self._places = count()

    def __call__(self, formula: Expr, /) -> Bounds:
        return sure(self._rows.truth(formula, self._judge.past))

    def previous(self, that: Bounds, /) -> Bounds:
        return self._word("previous", shifted, (False, True), (that.must,), (that.may,))

    def once(self, that: Bounds, /) -> Bounds:
        return self._word(ONCE, seen, (False, True), (that.must,), (that.may,))

    def held(self, that: Bounds, for_: Span, /) -> Bounds:
        return self._word("held", _longer(run_lengths, for_), (0, FOREVER), (that.must,), (that.may,))

    def within(self, that: Bounds, for_: Span, /) -> Bounds:
        ticks = for_.ticks(TICK_MS)
        return self._word("within", _within(ticks), (0, ticks + 1), (that.must,), (that.may,))

    def since(self, start: Bounds, release: Bounds, /) -> Bounds:
        lower, upper = (start.must, release.may), (start.may, release.must)
        return self._word("since", _since, (False, True), lower, upper)

    def overdue(self, trigger: Bounds, response: Bounds, within: Span, /) -> Bounds:
        if not within.ticks(TICK_MS):
            return trigger & ~response
        lower, upper = (trigger.must, response.may), (trigger.may, response.must)
        return self._word("overdue", _longer(_waits, within), (0, FOREVER), lower, upper)

    def _word(
        self,
        name: str,
        word: PastWord,
        before: tuple[Any, Any],
        lower: tuple[Array, ...],
        upper: tuple[Array, ...],
    ) -> Bounds:
        """Bounds of a word; ``before`` are the least and the most that its state can be after a gap."""
        key, (least, most) = (name, next(self._places)), before
        low, high = self._judge.states.get(key, (least, least if self._judge.past.from_start else most))
        must, after = word(*lower, low)
        if low == high and all(a is b for a, b in zip(lower, upper, strict=True)):
            self._judge.states[key] = after, after
            return sure(must)
        may, at_most = word(*upper, high)
        self._judge.states[key] = after, at_most
        return Bounds(must, may)


def _longer(word: PastWord, span: Span) -> PastWord:
    """Whether what the word counts is more than the ticks of the span."""
    ticks = span.ticks(TICK_MS)

    def longer(*args: Any) -> tuple[Array, int]:
        length, after = word(*args)
        return length > ticks, after

    return longer


def _within(ticks: int) -> PastWord:
    def within(now: Array, before: int) -> tuple[Array, int]:
        index = np.arange(1, len(now) + 1)
        last = np.maximum.accumulate(np.where(now, index, 0))
        left = np.where(last > 0, last + ticks + 1 - index, before - index)
        return left > 0, max(int(left[-1]), 0)

    return within


def _since(start: Array, release: Array, before: bool) -> tuple[Array, bool]:
    index = np.arange(1, len(start) + 1)
    started = np.maximum.accumulate(np.where(start, index, 0))
    released = np.maximum.accumulate(np.where(release, index, 0))
    is_open = (started > released) | ((released == 0) & before)
    return is_open, bool(is_open[-1])


def _waits(asked: Array, response: Array, before: int) -> tuple[Array, int]:
    """For how many rows a trigger has waited for a response, its own included."""
    index = np.arange(1, len(asked) + 1)
    answered = np.maximum.accumulate(np.where(response, index, 0))
    first = _first_since(np.where(asked & ~response, index, 0), answered, index)
    carried = np.where(answered == 0, before, 0)
    waits = np.where(carried > 0, carried + index, np.where(first > 0, index - first + 1, 0))
    waits = np.where(response, 0, waits)
    return waits, int(waits[-1])


def _first_since(marks: Array, since: Array, index: Array) -> Array:
    """The first marked row after ``since[i]``, for each row i; 0 for none up to it."""
    marked = marks[marks > 0]
    if not len(marked):
        return np.zeros_like(index)
    place = np.searchsorted(marked, since, side="right")
    found = marked[np.minimum(place, len(marked) - 1)]
    return np.where((place < len(marked)) & (found <= index), found, 0)


def finite(prop: Property) -> bool:
    """Whether a finite run can break the property."""
    return not isinstance(prop.form, Unbounded)
