"""A story in which the same happens period after period is told once, and says how often."""

import json
from collections.abc import Sequence
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.render.ci import of_trace
from rovercheck.checker.render.ci.sarif import document
from rovercheck.checker.render.periods import RepeatedTicks, folded, periods
from rovercheck.checker.render.repetitions import Repetition, repetitions
from rovercheck.checker.render.story import StoryEvent, rows, values_at
from rovercheck.checker.render.trace_markdown import render as markdown
from rovercheck.checker.render.trace_table import render as table
from rovercheck.checker.results.trace import TakenTransition, Tick, Trace, TracedSystem
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.runs.replay import followed
from rovercheck.spec_model import rover
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.expr import flag, var
from tests.traces import changed, trace_of

BEEP, COUNT = flag("beep"), var("count", integer(0, 10_000, "ms"))


def run(beeps: str, counts: Sequence[int] = (), **more: object) -> Trace:
    """A tick for each character: whether it beeps; and what is counted."""
    counted = counts or [0] * len(beeps)
    ticks = tuple(
        Tick(i, {}, {"beep": int(c == "x"), "count": n})
        for i, (c, n) in enumerate(zip(beeps, counted, strict=True), 1)
    )
    before = {"beep": 0, "count": counted[0]}
    return changed(trace_of("alarm", 20, {"beep": BEEP, "count": COUNT}, (), before, ticks), **more)


def naive(items: Sequence[int]) -> list[Repetition]:
    """Every period tried at every place: what the definition says."""
    found: dict[tuple[int, int], int] = {}
    for period in range(1, len(items) // 2 + 1):
        same = [items[i] == items[i + period] for i in range(len(items) - period)]
        edges = [i for i in range(len(same) + 1) if (i and same[i - 1]) != (i < len(same) and same[i])]
        for start, end in zip(edges[::2], edges[1::2], strict=True):
            if end - start >= period:
                found.setdefault((start, end + period), period)
    return sorted(Repetition(*ends, period) for ends, period in found.items())


@given(st.lists(st.integers(0, 2), max_size=40))
def test_repetitions_are_those_of_the_definition(items: list[int]) -> None:
    found = repetitions(items)
    assert list(found) == naive(items)
    assert len(found) <= len(items), "the runs theorem"


@given(st.lists(st.integers(0, 3), min_size=1, max_size=6), st.integers(2, 9))
def test_powers_of_a_word_have_a_period_no_longer_than_it(word: list[int], times: int) -> None:
    items = word * times
    whole = [one for one in repetitions(items) if (one.start, one.end) == (0, len(items))]
    assert len(whole) == 1 and len(word) % whole[0].period == 0


def test_what_is_repeated_is_told_once() -> None:
    trace = run("." + "x..." * 6 + "x")
    told = list(folded(trace))
    again = told[-2]
    assert isinstance(again, RepeatedTicks)
    assert again.what == "ticks 6–25, 100–500 ms: ticks 2–5 again, 5 times; 20 ticks = 400 ms"
    assert isinstance(told[-1], StoryEvent) and told[-1].number == 26
    for shown in (table(trace), markdown(trace)):
        assert again.what in " ".join(shown.split())


def test_numbers_that_go_on_from_period_to_period_are_told() -> None:
    counts = [0, *(7 * (i // 4) + i for i in range(24)), 50]
    [again] = periods(run("." + "x..." * 6 + "x", counts))
    assert again.what.endswith("; count: 11 ms → 55 ms") and again.times == 4
    uneven = [*counts[:15], *(n + 1 for n in counts[15:])]
    assert all(row.last < 15 or row.first > 15 for row in periods(run("." + "x..." * 6 + "x", uneven)))


def test_states_that_go_on_are_no_period() -> None:
    """A location counted up is another state each time, not the same one again."""
    place = var("place", enumeration("Place", list("abcdefgh")))
    ticks = tuple(Tick(i, {}, {"place": i - 1}) for i in range(1, 9))
    trace = trace_of("walk", 20, {"place": place}, (), {"place": 0}, ticks)
    assert periods(trace) == ()


def test_another_transition_is_no_repetition() -> None:
    fired = TakenTransition("Bell", "Off", "On", "", 1)
    trace = run("." + "x..." * 6 + "x")
    assert periods(trace)
    odd = tuple(
        Tick(t.number, t.inputs, t.after, (fired,) if t.number in (10, 18) else ()) for t in trace.ticks
    )
    assert not any(row.first - row.period <= 10 <= row.last for row in periods(changed(trace, ticks=odd)))


def test_twice_is_told_twice() -> None:
    trace = run(".x...x..x")
    assert list(folded(trace)) == list(rows(trace))


def test_the_first_tick_the_last_and_the_loop_are_told() -> None:
    for loop in (None, 0, 7, 13, 24):
        for row in periods(run("x..." * 12, loop=loop)):
            assert 1 < row.first - row.period and row.last < 48
            assert loop is None or not row.first - row.period <= loop < row.last


def test_a_period_within_a_period_is_folded_too() -> None:
    trace = run("." + ("xx.x" + ".x" * 12 + "...") * 5 + "x")
    kinds = sorted(row.period for row in periods(trace))
    assert kinds == [2, 31] and len(list(folded(trace))) < 16


@given(
    st.lists(
        st.tuples(st.text("x.", min_size=1, max_size=5), st.integers(1, 6), st.integers(0, 2)), max_size=5
    ),
    st.one_of(st.none(), st.integers(0, 40)),
)
def test_every_tick_is_told_once_or_said_to_be_a_repetition(
    parts: list[tuple[str, int, int]], loop: int | None
) -> None:
    beeps = "." + "".join(word * times for word, times, _ in parts)
    pace = [0, *(step for word, times, step in parts for _ in range(len(word) * times))]
    counts = [sum(pace[: i + 1]) for i in range(len(pace))]
    trace = run(beeps, counts, loop=loop if loop is not None and loop < len(beeps) else None)
    at, expected = values_at(trace), 1
    for row in folded(trace):
        if not hasattr(row, "first") and not isinstance(row, StoryEvent):
            continue
        first, last = (row.number, row.number) if isinstance(row, StoryEvent) else (row.first, row.last)
        if type(row).__name__ == "Repeats":
            continue
        assert first == expected and last >= first
        expected = last + 1
        if isinstance(row, RepeatedTicks):
            assert row.count == row.times * row.period and row.times >= 2
            moves = [{n: at[i][n] - at[i - row.period][n] for n in at[i]} for i in range(first, last + 1)]
            assert all(a["count"] == b["count"] for a, b in pairwise(moves))
            assert all(move["beep"] == 0 for move in moves)
            assert {c.name for c in row.progress} == {n for n in at[0] if at[last][n] != at[first - 1][n]}
    assert expected == len(beeps) + 1


def silent(ticks: int) -> Trace:
    """The monitor of the IMU of Board 2, which after three ticks gets no more data."""
    system = lowered(rover.systems()["monitors_2_IMU_exact"])
    given = tuple({"imu_update": int(i < 3)} for i in range(ticks))
    done, _ = followed(system, Run({}, given), "silence")
    return Trace(TracedSystem.of(system), dict(system.init), done)


def test_a_minute_of_the_rover_is_told_on_a_screen() -> None:
    trace = silent(3003)
    told = table(trace)
    assert "ticks 67–2978, 1320–59560 ms: ticks 15–66 again, 56 times" in " ".join(told.split())
    assert len(told.splitlines()) < 30
    [result] = document(of_trace(trace), witnesses=True)["runs"][0]["results"]
    assert "56 times" in json.dumps(result, ensure_ascii=False)


def test_a_long_run_is_read_at_once() -> None:
    """Nothing here takes time in the square of the ticks: 20,000 of them, no two neighbours alike."""
    beeps = "." + "".join("x" * (i % 7) + "." * (i % 11) for i in range(2_500))
    assert len(list(folded(run(beeps)))) < 2 * 4 * 77, "a period of 77 pairs, and less than another one"
