"""Traces: the story, and every format."""

import re
from collections.abc import Iterable
from dataclasses import replace

import pytest

from rovercheck.checker.render import trace_markdown, trace_table
from rovercheck.checker.render.reasons import cause, meaning, reasons
from rovercheck.checker.render.story import Quiet, StoryEvent, conjuncts, false_parts, rows
from rovercheck.checker.results.trace import Needed, Trace
from tests.render.conformance import Suite
from tests.render.zoo import TRACES, long_trace
from tests.traces import changed


class TestStory:
    def test_quiet_ticks_are_one_row(self) -> None:
        first, second, third, quiet, last = rows(long_trace(150))
        assert (
            isinstance(first, StoryEvent) and isinstance(second, StoryEvent) and isinstance(last, StoryEvent)
        )
        assert isinstance(third, StoryEvent), "the input falls back"
        assert isinstance(quiet, Quiet)
        assert (quiet.first, quiet.last, quiet.count) == (4, 152, 149)
        assert quiet.what == (
            "ticks 4–152: nothing but timers (Relay.Theirs.duration1: 1 → 150); 149 ticks = 2.98 s"
        )

    def test_every_tick_is_told_once(self) -> None:
        told: list[int] = []
        for row in rows(long_trace(40)):
            told += [row.number] if isinstance(row, StoryEvent) else range(row.first, row.last + 1)
        assert told == list(range(1, len(long_trace(40)) + 1))

    def test_only_changes_and_inputs_marked(self) -> None:
        second = list(rows(long_trace()))[1]
        assert isinstance(second, StoryEvent)
        assert [(c.name, c.is_input) for c in second.changes] == [
            ("level", True), ("speed", False), ("alarm", False)
        ]  # fmt: skip

    def test_names_that_are_no_identifiers_are_told_unless_they_are_of_the_property(self) -> None:
        """A name with a hyphen was left out: the frames that arrive (``B2-B1.arrives``) were never shown."""
        trace = long_trace()
        plain, own = trace.system.variables["speed"], "P.waiting"
        wide = {
            **trace.system.variables,
            "A-B.speed": plain,
            own: replace(plain, hidden=True),
            trace.property.id: plain,
        }
        ticks = [
            replace(t, after={**t.after, **dict.fromkeys(("A-B.speed", own, trace.property.id), n % 2)})
            for n, t in enumerate(trace.ticks)
        ]
        seen = {c.name for e in rows(changed(trace, variables=wide, ticks=tuple(ticks)))
                   if isinstance(e, StoryEvent) for c in e.changes}  # fmt: skip
        assert "A-B.speed" in seen and not seen & {own, trace.property.id}

    def test_a_last_tick_without_a_change_breaks_the_property(self) -> None:
        trace = long_trace()
        still = replace(trace.ticks[-1], number=len(trace) + 1, transitions=())
        longer = replace(trace, ticks=(*trace.ticks, still))
        said = "nothing changes, which breaks the property"
        assert said in trace_table.render(longer) and said in trace_markdown.render(longer)

    def test_the_end_says_which_part_is_false(self) -> None:
        named, bare = false_parts(long_trace())
        assert (named.name, named.formula, named.values) == (
            "never_critical", "mode == SAFE", (("mode", "CRITICAL"),)
        )  # fmt: skip
        assert bare.name == "" and dict(bare.values) == {"speed": "0 m/s", "alarm": "false"}


def explained(*needed: Needed, minimal: bool = True, smallest: bool = False) -> Trace:
    return changed(long_trace(2), needed=needed, minimal=minimal, smallest=smallest)


LOW, HIGH = frozenset(range(5)), frozenset(range(100, 301))


class TestReasons:
    def test_neighbouring_ticks_are_one_line(self) -> None:
        found = reasons(explained(*(Needed(k, "level", LOW) for k in (3, 4, 5)), Needed(2, "level", HIGH)))
        assert [(r.when, r.ms, r.what) for r in found] == [
            ("tick 2", "40 ms", "level >= 100"), ("ticks 3–5", "60–100 ms", "level <= 4")
        ]  # fmt: skip

    def test_ticks_at_one_distance_are_one_line_on_request(self) -> None:
        trace = explained(*(Needed(k, "level", LOW) for k in (1, 3, 5)))
        assert [r.when for r in reasons(trace)] == ["tick 1", "tick 3", "tick 5"]
        assert [r.when for r in reasons(trace, regular=True)] == ["ticks 1, 3, ... 5"]

    @pytest.mark.parametrize(
        ("values", "what"),
        [
            ({7}, "level = 7"),
            (range(3, 10), "level in 3..9"),
            ([3, 4, 9], "level in {3..4, 9}"),
            (set(range(301)) - {8}, "level != 8"),
        ],
    )
    def test_values_in_few_words(self, values: Iterable[int], what: str) -> None:
        assert [r.what for r in reasons(explained(Needed(1, "level", frozenset(values))))] == [what]

    def test_what_is_said_of_them(self) -> None:
        assert meaning(long_trace()) == ""
        assert "whatever its inputs" in meaning(explained())
        some = Needed(1, "level", LOW)
        assert meaning(explained(some)).endswith("The set is minimal.")
        assert meaning(explained(some, smallest=True)).endswith("The set is minimal and smallest.")
        assert cause(explained(some)) == "Cause: the inputs that determine the violation"
        assert "Not minimised" in meaning(explained(some, minimal=False))

    def test_needed_inputs_are_marked(self) -> None:
        trace = explained(Needed(2, "level", HIGH))
        table = trace_table.render(trace)
        assert re.search(r"^ +2 +40 +in\* level: 0 → 100$", table, re.M)
        assert re.search(r"^in\* tick 2 +40 ms +level >= 100$", table, re.M)
        assert "<code>level: 0 → 100</code> needed" in trace_markdown.render(trace)
        assert "| tick 2 | 40 ms | <code>level &gt;= 100</code> |" in trace_markdown.render(trace)


class TestConjuncts:
    def test_each_says_since_when(self) -> None:
        trace = long_trace(2)
        truths = ((True, True, False, False, False), (False, True, True, True, True))
        trace = changed(
            trace, parts=trace.property.false_parts, truths=truths, false_parts=trace.property.false_parts[:1]
        )
        assert [c.verdict for c in conjuncts(trace)] == ["False since tick 3", "True since tick 2"]
        assert [c.since for c in false_parts(trace)] == [3]
        table = trace_table.render(trace)
        assert "False since tick 3: never_critical" in table and "True since tick 2: speed > 0" in table

    def test_what_never_changed_is_so_since_the_first_tick(self) -> None:
        trace = long_trace(2)
        trace = changed(trace, parts=trace.property.false_parts, truths=((False,) * 5,) * 2)
        assert {c.since for c in conjuncts(trace)} == {1}


class TraceSuite(Suite):
    KIND = "trace"
    ZOO = TRACES


class TestTable(TraceSuite):
    NAME = "table"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        assert max(map(len, document.splitlines())) <= 80
        assert "\x1b" not in document

    def test_reads_like_a_log(self) -> None:
        shown = self.shown("long")
        assert re.search(r"^ +2 +40 +in  level: 0 → 100$", shown, re.M)
        assert "▸ Relay: Ours → Theirs (transition 1)  [level >= 100]" in shown
        assert "False since tick 153: never_critical" in shown

    def test_colour_on_request(self) -> None:
        assert "\x1b[" in trace_table.render(long_trace(), color=True)


class TestMarkdown(TraceSuite):
    NAME = "markdown"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        widths = {line.count("|") for line in document.splitlines() if line.startswith("|")}
        assert widths == {6}

    def test_text_is_escaped(self) -> None:
        assert "<code>[duration(level &lt; 5) &gt; 3 s]</code>" in self.shown("long")


@pytest.mark.parametrize("quiet", [0, 1, 2])
def test_short_stretches(quiet: int) -> None:
    assert trace_table.render(long_trace(quiet))
