"""The record of the last ten intervals between updates as Table 2 words it: in ms, one by one.

An update is seen by the first step after it, ``lag`` ms later, so that an interval is the difference of
two stamps whether or not these lie on the grid of the steps.  ``any_mean`` forgets the intervals but for
one fact: when all of them lie on one side of 40 ms, so does their mean.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rovercheck.spec_model.ambiguity import choose, under
from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.domain import fixed, integer
from rovercheck.spec_model.lang.expr import Expr, Var, any_of, const, flag, ite, var
from rovercheck.spec_model.lang.system import TICK_MS
from rovercheck.spec_model.lang.words import minimum

INTERVALS = 10
"""The moving mean is over the last ten intervals [spec Table 2]."""

LIMIT = 40
"""ms that the mean must not exceed."""

LONG = INTERVALS * LIMIT + 1
"""ms; stands for every longer interval, with which no mean of ten is at most 40 ms."""

MOST_LAG = TICK_MS - 1
"""ms from an arrival to the step that sees it, at most: one on the edge counts for the later tick."""

STEP = const(TICK_MS, "ms")
"""The length of a step, where it is constant."""

MOST_MOVES = 3
"""By how much a heartbeat may move between two steps (S40)."""

Close = Callable[[Expr], Sequence[Action]]
"""What to do with an interval, in ms, that an update closes."""


@dataclass(frozen=True)
class Arrivals:
    """The updates of one time stamp, as one step sees them.

    Without a ``lag`` they come at the instants of the steps.  ``first_lag`` is the lag of another update
    before the latest within the same tick, which is there iff it is greater than ``lag`` (S36).  ``moves``
    is by how much the counter moved (S40).  ``step`` is how long the step has lasted.
    """

    name: str
    update: Var
    lag: Var | None = None
    first_lag: Var | None = None
    moves: Var | None = None
    step: Expr = STEP

    @property
    def most_lag(self) -> int:
        """ms from an arrival to the step that sees it, at most."""
        return MOST_LAG if self.lag is None else self.lag.domain.high

    @property
    def updates(self) -> Var:
        """Updates so far, the eleventh and all later ones as 11: eleven make ten intervals."""
        return var(f"{self.name}_updates", integer(0, INTERVALS + 1), doc="updates so far", hidden=True)

    @property
    def slow(self) -> Var:
        """The answer."""
        return flag(f"{self.name}_slow")


def over(mean_of: int, total: Expr) -> Expr:
    """Whether the mean of so many intervals exceeds 40 ms (S37)."""
    return choose("S37", {"GT": total > mean_of * LIMIT, "GE": total >= mean_of * LIMIT})


def from_power_up(updates: Var, *also: Action) -> Action:
    """Before the first step: the power-up counts as an update, where it begins an interval (S66)."""
    counted = flag(f"{updates.name}_from_power_up", "the power-up has been counted as an update")
    return when(under("S66", "COUNT") & ~counted, [assign(counted, True), assign(updates, const(1)), *also])


def interval_record(arrivals: Arrivals) -> list[Action]:
    """``<name>_slow``, exactly, from the intervals one by one (S34 to S37, S40, S66)."""
    share = arrivals.moves is not None
    unit = fixed(0, LONG, "1/6" if share else 1, "ms")
    kind = "share" if share else "interval"
    last = [
        var(f"{arrivals.name}_{kind}{i}", unit, doc=f"{kind} {i}, the latest first") for i in range(1, 11)
    ]
    shift = [assign(older, newer) for newer, older in zip(last[-2::-1], last[:0:-1], strict=True)]
    gap, updates = _gap(arrivals, LONG), arrivals.updates

    def close(interval: Expr) -> list[Action]:
        return [*shift, assign(last[0], minimum(interval, const(LONG, "ms")))]

    def recorded(number: int) -> Expr:
        return updates == number + 1

    def open_too(number: int) -> Expr:
        return updates >= number if number == INTERVALS else updates == number

    at_update = assign(arrivals.slow, _mean_over(last, recorded))
    # In a step without an update the open interval is the latest of the ten (S35).
    between = when(under("S35", "OPEN"), [assign(arrivals.slow, _mean_over([gap, *last[:-1]], open_too))])
    return [
        from_power_up(updates),
        *_grow(gap, arrivals.step),
        when(arrivals.update, [*_closing(arrivals, gap, close), at_update], [between]),
    ]


def _mean_over(intervals: Sequence[Expr], there_are: Callable[[int], Expr]) -> Expr:
    """The mean of the last ten intervals exceeds 40 ms; before there are ten, no or that of all (S34)."""
    totals = [intervals[0]]
    for interval in intervals[1:]:
        totals.append(totals[-1] + interval)
    means = [there_are(n) & over(n, total) for n, total in enumerate(totals, start=1)]
    return choose("S34", {"WAIT10": means[-1], "PARTIAL": any_of(*means)})


def any_mean(arrivals: Arrivals, answer: Var) -> list[Action]:
    """``<name>_slow`` from the free input ``answer``, except when all intervals lie on one side of 40 ms.

    It allows every run of the exact record and more.
    """
    name, updates, slow = arrivals.name, arrivals.updates, arrivals.slow
    alike = var(f"{name}_alike", integer(0, INTERVALS), doc="latest intervals on one side of 40 ms")
    long = flag(f"{name}_long", "the latest interval exceeds 40 ms")
    gap = _gap(arrivals, LIMIT + 1)

    def close(interval: Expr) -> list[Action]:
        as_before = over(1, interval) == long
        return [
            assign(alike, ite(as_before, minimum(alike + 1, INTERVALS), const(1))),
            assign(long, over(1, interval)),
        ]

    enough = choose("S34", {"WAIT10": updates == INTERVALS + 1, "PARTIAL": updates >= 2})
    open_too = choose("S34", {"WAIT10": updates >= INTERVALS, "PARTIAL": updates >= 1})
    mean = ite(alike == updates - 1, long, answer)
    between = when(under("S35", "OPEN"), [assign(slow, open_too & answer)])
    return [
        from_power_up(updates),
        *_grow(gap, arrivals.step),
        when(arrivals.update, [*_closing(arrivals, gap, close), assign(slow, enough & mean)], [between]),
    ]


def _gap(arrivals: Arrivals, long: int) -> Var:
    """The open interval; it stops growing where each of its shares is ``long`` at every lag."""
    if arrivals.moves is None:
        return var(
            f"{arrivals.name}_gap",
            integer(0, long + arrivals.most_lag, "ms"),
            doc="ms since the latest update",
        )
    most = MOST_MOVES * long + arrivals.most_lag
    return var(f"{arrivals.name}_span", integer(0, most, "ms"), doc="ms since the latest update")


def _grow(gap: Var, step: Expr) -> list[Action]:
    return [assign(gap, minimum(gap + step, const(gap.domain.high, "ms")))]


def _closing(arrivals: Arrivals, gap: Var, close: Close) -> list[Action]:
    """The intervals that the updates of a tick close, the earlier one first where each counts (S36)."""
    if arrivals.lag is None:
        return _received(arrivals, gap, const(0, "ms"), close)
    latest = _received(arrivals, gap, arrivals.lag, close)
    if arrivals.first_lag is None:
        return latest
    another = under("S36", "ARRIVAL") & (arrivals.first_lag > arrivals.lag)
    return [when(another, _received(arrivals, gap, arrivals.first_lag, close)), *latest]


def _received(arrivals: Arrivals, gap: Var, lag: Expr, close: Close) -> list[Action]:
    interval, updates = gap - lag, arrivals.updates
    one_more = assign(updates, minimum(updates + 1, INTERVALS + 1))
    if arrivals.moves is None:
        return [when(updates >= 1, close(interval)), one_more, assign(gap, lag)]
    # A counter that moved by three has closed three intervals, each a third of the time (S40).
    moves = arrivals.moves
    share = ite(moves == 1, interval, ite(moves == 2, interval / 2, interval / 3))
    each = [when(moves >= i, [*close(share), one_more]) for i in range(1, MOST_MOVES + 1)]
    return [when(updates >= 1, each, [one_more]), assign(gap, lag)]
