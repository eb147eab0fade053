"""A story in which the same happens again and again is told once, and says how often it happens."""

import pytest

from rovercheck.checker.render import again as folding
from rovercheck.checker.render.again import RepeatedTicks, folded
from rovercheck.checker.render.story import StoryEvent, rows
from rovercheck.checker.render.trace_markdown import render as markdown
from rovercheck.checker.render.trace_table import render as table
from rovercheck.checker.results.trace import Tick, Trace
from rovercheck.spec_model.lang.expr import flag
from tests.traces import trace_of

BEEP = flag("beep")


def run(beeps: str) -> Trace:
    """A tick for each character: whether it beeps."""
    ticks = tuple(Tick(i, {}, {"beep": int(c == "x")}) for i, c in enumerate(beeps, 1))
    return trace_of("alarm", 20, {"beep": BEEP}, (), {"beep": 0}, ticks)


def test_what_is_repeated_is_told_once() -> None:
    trace = run("." + "x..." * 6 + "x")
    told = list(folded(trace))
    again = told[-2]
    assert isinstance(again, RepeatedTicks)
    assert again.what == "ticks 6–25: ticks 2–5 again, 5 times; 20 ticks = 400 ms"
    assert isinstance(told[-1], StoryEvent) and told[-1].number == 26
    for shown in (table(trace), markdown(trace)):
        assert again.what in " ".join(shown.split())


def test_twice_is_told_twice() -> None:
    trace = run(".x...x..x")
    assert list(folded(trace)) == list(rows(trace))


def test_what_repeats_more_rows_than_can_be_seen_is_told_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    trace = run("." + "xx.x." * 6)
    assert any(isinstance(row, RepeatedTicks) for row in folded(trace))
    monkeypatch.setattr(folding, "LONGEST", 1)
    assert list(folded(trace)) == list(rows(trace))


def test_every_tick_is_told_once_or_said_to_be_a_repetition() -> None:
    for beeps in (".x" * 9, "xx.." * 4 + "x." * 5, "x" + "." * 30, ".x..x..x...x"):
        trace, at = run(beeps), 1
        for row in folded(trace):
            first, last = (row.number, row.number) if isinstance(row, StoryEvent) else (row.first, row.last)
            assert first == at and last >= first
            if isinstance(row, RepeatedTicks):
                assert beeps[first - 1 : last] == beeps[first - 1 - row.period : first - 1] * row.times
            at = last + 1
        assert at == len(beeps) + 1
