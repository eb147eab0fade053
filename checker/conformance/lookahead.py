"""The steps of one part taken ahead, many rows at a time, where state and inputs are known and explain them.

It says nothing that the tracker of the part would not say row by row: where a row is not explained at
once, the tracker takes it.  Measured values are decimals meanwhile, with which Python computes quickly:
exactly, as the context traps what is not.
"""

from collections.abc import Callable, Mapping, Sequence
from decimal import (
    Context,
    Decimal,
    DecimalException,
    DivisionByZero,
    Inexact,
    InvalidOperation,
    localcontext,
)
from fractions import Fraction

from rovercheck.checker.conformance.alike import ValueLikes
from rovercheck.checker.conformance.estimator import differs
from rovercheck.checker.conformance.program import BeliefOutcome, Known, Number, TakenStep
from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.conformance.tracker import Tracker

Column = Sequence[Raw | None]

EXACT = Context(prec=60, traps=[Inexact, InvalidOperation, DivisionByZero])
"""Decimals of up to 60 digits; what would need more is an error."""

FEWEST = 32
"""Rows that are taken ahead where those before ended early; each time twice as many."""

FEW = 8
"""Values of an input in a block up to which it is not asked which are alike."""

MOST_TAKEN = 1 << 20
"""Values in the steps of a part that are remembered, and so many steps at most:"""
MOST_STEPS = 20_000

TRIED, NOT_TRIED = 2_048, 100_000
"""Rows after which it is asked whether steps recur, and for how many rows they are not remembered if not."""


class LookAhead:
    """One part in the rows of a block.  ``first..stop`` are the rows that are taken ahead and explained.

    What is taken comes into the tracker with ``settle``.
    """

    def __init__(self, tracker: Tracker) -> None:
        self.tracker = tracker
        cone = tracker.cone
        self._inputs = frozenset(v.name for v in cone.system.inputs)
        self._taken = cone.ahead
        width = len(cone.system.variables) + len(cone.system.inputs) + len(cone.outputs)
        self._most = min(MOST_STEPS, MOST_TAKEN // max(width, 1))
        self._size, self._missed, self._asked, self._pause = FEWEST, 0, 0, 0
        self._fetch: Callable[[], tuple[Sequence[Column], Sequence[Column]]] = lambda: ((), ())
        self._given: list[Known] | None = None
        self._logged: list[Known] = []
        self._decimals, self._holes, self.owned = True, False, True
        self.first = self.stop = self._settled = 0
        self._steps: list[TakenStep] = []

    def reads(self, names: Mapping[str, object]) -> bool:
        """Whether the part reads one of these."""
        return bool(names) and not self._inputs.isdisjoint(names)

    def begin(self, inputs: Callable[[], Sequence[Column]], outputs: Sequence[Column]) -> None:
        """A block begins, with these columns of the part; those of inputs are made when they are needed."""
        self._fetch = lambda: (inputs(), outputs)
        self._given = None
        self.drop(0)

    def drop(self, row: int) -> None:
        """What was taken ahead is void; the tracker is where the row begins."""
        self.first = self.stop = self._settled = row
        self._steps = []

    def reach(self, row: int, end: int) -> int:
        """Up to which row everything is explained, if that is taken ahead from this row on."""
        if row < self.stop:
            return self.stop
        self.settle(row)
        self.drop(row)
        self.owned = self.tracker.owned and not self.tracker.given_up
        if self.tracker.given_up:
            return end
        if not self.tracker.certain:
            return row
        self._take(row, min(end, row + self._size))
        self._size = self._size * 2 if self.stop == row + self._size else FEWEST
        return self.stop

    def _take(self, row: int, end: int) -> None:
        given, state, steps = self._rows(), self.tracker.state, self._steps
        if None in state:
            return
        if self._decimals:
            state = tuple(map(_quick, state))
        step, explains = self.tracker.cone.quick_step, self._explains
        logged, holes, taken, most = self._logged, self._holes, self._taken, self._most
        remember = self._decimals and self._remembers(end - row)
        missed = 0
        last_wanted: Known = ()
        last_got: Known | None = None
        with localcontext(EXACT):
            for at in range(row, end):
                now = given[at]
                if holes and None in now:
                    break
                one = taken.get((state, now)) if remember else None
                if one is None:
                    try:
                        after, wanted = step(state, now)
                    except (DecimalException, TypeError):
                        break  # the tracker takes the step with fractions
                    one = state, after, wanted
                    if remember:
                        missed += 1
                        if len(taken) >= most:
                            taken.clear()
                        taken[state, now] = one
                wanted, got = one[2], logged[at]
                if wanted != got and not (wanted is last_wanted and got == last_got):
                    if not explains(wanted, got):
                        break
                    last_wanted, last_got = wanted, got
                steps.append(one)
                state = one[1]
        self.stop = row + len(steps)
        self._missed += missed

    def _remembers(self, rows: int) -> bool:
        """Whether steps are looked up: not for a while where they hardly ever recur."""
        if self._pause > 0:
            self._pause -= rows
            return False
        if self._asked > TRIED:
            if self._missed > self._asked // 2:
                self._pause = NOT_TRIED
                self._taken.clear()
            self._asked = self._missed = 0
        self._asked += rows
        return True

    def _explains(self, wanted: Known, got: Known) -> bool:
        rows = zip(wanted, got, self.tracker.apart, strict=True)
        return not any(w != g and differs(w, g, apart) for w, g, apart in rows)

    # --- what was taken ---

    def outputs(self, start: int, end: int) -> list[Known]:
        """What is required in these rows, all of which are taken ahead."""
        if self.tracker.given_up or not self.owned:
            return [self.tracker.required] * (end - start)
        return [one[2] for one in self._steps[start - self.first : end - self.first]]

    def steps(self, start: int, end: int) -> list[TakenStep]:
        """The steps of these rows."""
        return self._steps[start - self.first : end - self.first]

    def settle(self, row: int) -> None:
        """Bring the tracker to where the row begins."""
        if self._settled < row <= self.stop:
            taken = plain_outcome(self._steps[row - 1 - self.first])
            self.tracker.settle(taken, self._logged_raw(row - 1), row - self._settled)
            self._settled = row

    def required(self, row: int) -> None:
        """Let the tracker say what is required in a row that is taken ahead."""
        if self.owned:
            self.tracker.required = self._steps[row - self.first][2]

    def after(self, row: int) -> None:
        """The tracker took the row by itself: what was taken ahead goes on if it came to the same state."""
        if row < self.stop:
            known = tuple(map(_plain, self._steps[row - self.first][1]))
            tracker = self.tracker
            if tracker.certain and tracker.owned == self.owned and tracker.state == known:
                self._settled = row + 1
                return
            self._size = FEWEST
        self.drop(row + 1)

    # --- rows of values ---

    def _rows(self) -> list[Known]:
        """What the part is given, row by row."""
        if self._given is None:
            inputs, outputs = self._fetch()
            likes = self.tracker.cone.likes
            self._holes = any(type(None) in {*map(type, column)} for column in inputs)
            made = [_alike(column, like) for column, like in zip(inputs, likes, strict=True)]
            quick = [_in_decimals(column) for column in (*made, *outputs)]
            self._decimals = not any(Fraction in {*map(type, column)} for column in quick)
            if self._decimals:
                made, outputs = quick[: len(made)], quick[len(made) :]
            self._given = list(zip(*made, strict=True)) if made else [()] * len(outputs[0])
            self._logged = list(zip(*outputs, strict=True))
        return self._given

    def _logged_raw(self, row: int) -> Known:
        return tuple(map(_plain, self._logged[row]))


def _alike(column: Column, like: ValueLikes | None) -> Column:
    """The values of a column, with one in place of all that are alike."""
    if like is None or ({*map(type, column)} == {int} and len({*column}) <= FEW):
        return column
    return _each(column, lambda value: None if value is None else like[value])


def _each(column: Column, made: Callable[[Raw | None], Number]) -> list[Number]:
    """Something made of each value; the same object is asked for once, as a fraction is slow to look up."""
    keys = list(map(id, column))
    found = {key: made(value) for key, value in dict(zip(keys, column, strict=True)).items()}
    return list(map(found.__getitem__, keys))


def _in_decimals(column: Column) -> Sequence[Number]:
    return _each(column, _quick) if Fraction in {*map(type, column)} else column


def _quick(value: Raw | None) -> Number:
    """A fraction as a decimal, if it is one."""
    if not isinstance(value, Fraction):
        return value
    try:
        return EXACT.divide(Decimal(value.numerator), Decimal(value.denominator))
    except DecimalException:
        return value


def plain_outcome(step: TakenStep) -> BeliefOutcome:
    """A step that was taken ahead, without decimals."""
    before, after, outputs = (tuple(map(_plain, known)) for known in step)
    return BeliefOutcome(before, after, outputs)


def _plain(value: Number) -> Raw | None:
    """A decimal as a fraction."""
    if isinstance(value, Decimal):
        return Fraction(value)
    return None if value is None else value
