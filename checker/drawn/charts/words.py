"""Words of drawn charts about time and change as those of the language, as ``after`` and ``duration``."""

from collections.abc import Callable, Mapping
from fractions import Fraction

from rovercheck.checker.drawn.lower.symbols import NotLowered, folded
from rovercheck.checker.drawn.lower.times import UNITS
from rovercheck.spec_model.lang.domain import Bool, Enum
from rovercheck.spec_model.lang.expr import TRUE, Const, Expr, Temporal, When, any_of
from rovercheck.spec_model.lang.time import Span, ms, ticks

MOST_STEPS = 1_000_000_000
MOST_MEMBERS = 12
"""Members of an enumeration of which each is looked at to see a change."""


class SpanWords:
    """Times as spans of the language.  ``step`` is the length of a step in seconds, if it is known."""

    def __init__(self, step: Fraction | None) -> None:
        self._step = step

    def steps(self, limit: Fraction, unit: str) -> Fraction:
        """A time in steps.  Raises ``NotLowered`` for a unit that is none."""
        if unit == "tick":
            return limit
        if unit not in UNITS:
            raise NotLowered(f"it counts how often {unit} occurs: count it in a datum")
        if self._step is None:
            raise NotLowered("the length of a step is not known, and a time in seconds is asked for")
        return limit * UNITS[unit] / self._step

    def after(self, limit: Fraction, unit: str) -> Expr:
        """Whether the state has been active for so long."""
        count = self._whole(self.steps(limit, unit))
        return TRUE if count <= 0 else Temporal(When.AFTER, None, self._span(count, limit, unit))

    def counted(self, sign: str, limit: Fraction, unit: str, at_least: Callable[[Span], Expr]) -> Expr:
        """A count of steps compared with a number: ``at_least`` says that it is a span, or more."""
        exact = self.steps(limit, unit)

        def from_(count: int, written: Fraction | None) -> Expr:
            return TRUE if count <= 0 else at_least(self._span(count, written, unit))

        whole = self._whole(exact)
        least = from_(whole, limit if exact == whole else None)
        more = from_(int(exact // 1) + 1, None)
        match sign:
            case ">=":
                return least
            case ">":
                return more
            case "<":
                return folded(~least)
            case "<=":
                return folded(~more)
            case "==" | "!=":
                if exact != whole:
                    return folded(~TRUE) if sign == "==" else TRUE
                made = folded(least & folded(~more))
                return made if sign == "==" else folded(~made)
        raise NotLowered(f"a time is compared by {sign}")

    def _whole(self, steps: Fraction) -> int:
        count = -(-steps // 1)
        if count > MOST_STEPS:
            raise NotLowered(f"a time of {count:,} steps")
        return int(count)

    def _span(self, count: int, limit: Fraction | None, unit: str) -> Span:
        """So many steps, as they are written where that is a whole number of milliseconds."""
        if limit is not None and unit in UNITS and self._step is not None:
            written = limit * UNITS[unit] * 1000
            whole = (self._step * 1000).denominator == 1
            if whole and written.denominator == 1 and written == count * self._step * 1000:
                return int(written) * ms
        return count * ticks


def changed(word: str, now: Expr, value: Expr | None) -> Expr:
    """Whether a datum was another one at the start of the step before.  Raises ``NotLowered``."""
    if value is not None:
        same = folded(now == value)
        return _rising(same if word == "hasChangedTo" else folded(~same))
    sort = now.sort
    if isinstance(sort, Bool):
        return any_of(_rising(now), _rising(folded(~now)))
    if isinstance(sort, Enum) and len(sort.members) <= MOST_MEMBERS:
        return any_of(*(_rising(now == Const(raw, sort)) for _, raw in sort.members))
    raise NotLowered(f"whether `{now}` has changed: compare it with a datum that keeps its last value")


def _rising(condition: Expr) -> Expr:
    return Temporal(When.RISING, condition)


EDGES: Mapping[str, Callable[[Expr], Expr]] = {
    "rising": lambda number: _rising(folded(number > 0)),
    "falling": lambda number: _rising(folded(number < 0)),
    "crossing": lambda number: any_of(_rising(folded(number > 0)), _rising(folded(number < 0))),
}
"""Edges of a number through 0."""

__all__ = ["EDGES", "SpanWords", "changed"]
