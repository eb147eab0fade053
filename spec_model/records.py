"""The ten-interval records of the links of Board 1: forgotten, one by one, or as a window of arrivals."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from rovercheck.spec_model.ambiguity import choose, under
from rovercheck.spec_model.intervals import INTERVALS, Arrivals, from_power_up, interval_record
from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Expr, Var, any_of, const, flag, ite
from rovercheck.spec_model.lang.words import bit, minimum, modulo


def slow_record(name: str, update: Var, *, exact: bool = True, moves: Var | None = None) -> Block:
    """``<name>_slow``: the mean of the last ten closed update intervals exceeds 40 ms.

    The first update after power-up closes no interval (S66), before ten intervals exist the answer
    is no (S34), and the open interval does not count (S35).  With ``exact=False`` the intervals are
    forgotten: at each update from the eleventh on the free input ``<name>_mean_slow`` is the answer,
    which allows every run of the exact record and more.  ``moves``: as in ``Arrivals``.
    """
    if exact:
        record = interval_record(Arrivals(name, update, moves=moves))
        return Block(
            f"{name}.intervals", record, text="Mean of the last ten update intervals [spec Table 2]."
        )
    return Block(
        f"{name}.any_intervals",
        _record_forgotten(Arrivals(name, update, moves=moves)),
        text="Over-approximation: the mean of the last ten intervals is arbitrary.",
    )


def _record_forgotten(arrivals: Arrivals) -> list[Action]:
    updates, slow = arrivals.updates, arrivals.slow
    answer = flag(f"{arrivals.name}_mean_slow")
    enough = choose("S34", {"WAIT10": updates == INTERVALS + 1, "PARTIAL": updates >= 2})
    open_too = choose("S34", {"WAIT10": updates >= INTERVALS, "PARTIAL": updates >= 1})
    one_more = assign(updates, minimum(updates + 1, INTERVALS + 1))
    counted: list[Action] = [one_more]
    if arrivals.moves is not None:
        all_ = minimum(updates + arrivals.moves, INTERVALS + 1)
        further = when(updates >= 1, [assign(updates, all_)], [one_more])
        counted = [when(under("S40", "COUNT-DELTA"), [further], [one_more])]
    at_update = [*counted, when(enough, [assign(slow, answer)])]
    between = when(under("S35", "OPEN") & open_too, [assign(slow, answer)])
    return [from_power_up(updates), when(arrivals.update, at_update, [between])]


def arrival_window(name: str, update: Var, *, moves: Var | None = None) -> Block:
    """The same ``<name>_slow`` from the arrivals of the last 400 ms, exact and with fewer states."""
    return window_of(Arrivals(name, update, moves=moves))


def window_of(arrivals: Arrivals) -> Block:
    """``<name>_slow`` from the arrivals of the last 400 ms.

    The sum of ten successive intervals is the time from the eleventh last update to the last one.
    So the mean exceeds 40 ms iff fewer than ten earlier updates lie within the last 400 ms.  Where an
    update may close several intervals (S36, S40), they are recorded one by one.
    """
    plain = replace(arrivals, moves=None)
    do = _window(plain)
    if arrivals.first_lag is not None:
        do = [when(under("S36", "ARRIVAL"), interval_record(plain), do)]
    if arrivals.moves is not None:
        do = [when(under("S40", "COUNT-DELTA"), interval_record(arrivals), do)]
    return Block(
        f"{arrivals.name}.arrivals",
        do,
        text="Fewer than eleven updates within 400 ms: the mean interval exceeds 40 ms [spec Table 2].",
    )


def _window(arrivals: Arrivals) -> list[Action]:
    name, update, updates = arrivals.name, arrivals.update, arrivals.updates
    window = Var(f"{name}_arrivals", integer(0, 2**20 - 1), 0, "bit i: an update i+1 ticks ago", hidden=True)
    one_more = assign(updates, minimum(updates + 1, INTERVALS + 1))
    arrived = ite(update, const(1), const(0))
    lags = _latest_lags(arrivals)
    at_update = [assign(arrivals.slow, _mean_over(updates, window, lags.in_time)), one_more, *lags.shift]
    # As many intervals end now as there were updates before: the open one counts between updates (S35).
    between = assign(arrivals.slow, _mean_over(updates, window, lags.in_time_now))
    return [
        from_power_up(updates, assign(window, const(1))),
        when(update, at_update, [when(under("S35", "OPEN"), [between])]),
        assign(window, modulo(window * 2 + arrived, 2**20)),
    ]


InTime = Callable[[int], Expr]
"""Whether the n-th last update, if it was seen n times 40 ms ago, came no earlier than that."""


@dataclass(frozen=True)
class _Lags:
    """What the lags of the ten latest updates decide, at an update and between two."""

    in_time: InTime
    in_time_now: InTime
    shift: Sequence[Action]


def _latest_lags(arrivals: Arrivals) -> _Lags:
    if arrivals.lag is None:
        on_the_limit = choose("S37", {"GT": True, "GE": False})
        return _Lags(lambda _: on_the_limit, lambda _: on_the_limit, [])
    domain, lag, now = arrivals.lag.domain, arrivals.lag, const(0, "ms")
    last = [
        Var(f"{arrivals.name}_lag{n}", domain, 0, f"lag of update {n}, the latest first", hidden=True)
        for n in range(1, INTERVALS + 1)
    ]
    shift = [assign(older, newer) for newer, older in zip(last[-2::-1], last[:0:-1], strict=True)]

    def within(end: Expr) -> InTime:
        return lambda n: choose("S37", {"GT": last[n - 1] <= end, "GE": last[n - 1] < end})

    return _Lags(within(lag), within(now), [*shift, assign(last[0], lag)])


def _mean_over(updates: Expr, window: Expr, in_time: InTime) -> Expr:
    """Fewer than n updates in n times 40 ms, for n the number of updates before, ten or more as ten (S34)."""

    def fewer(n: int) -> Expr:
        recent = [bit(window, i) for i in range(2 * n)]
        return _count([*recent[:-1], recent[-1] & in_time(n)]) < n

    ten = (updates >= INTERVALS) & fewer(INTERVALS)
    fewer_yet = [(updates == n) & fewer(n) for n in range(1, INTERVALS)]
    return choose("S34", {"WAIT10": ten, "PARTIAL": any_of(ten, *fewer_yet)})


def _count(conditions: Sequence[Expr]) -> Expr:
    """How many of the conditions are true."""
    ones: list[Expr] = [ite(c, const(1), const(0)) for c in conditions]
    while len(ones) > 1:
        ones = [a + b for a, b in zip(ones[::2], ones[1::2], strict=False)] + ones[len(ones) & ~1 :]
    return ones[0]
