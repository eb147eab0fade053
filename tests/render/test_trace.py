"""Traces: the story, and every format."""

import json
import re

import pytest
from jsonschema import validate

from checker.render import trace_json, trace_table, trace_vcd
from checker.render.story import Event, Quiet, false_parts, rows
from tests.render.conformance import Suite
from tests.render.zoo import TRACES, long_trace


class TestStory:
    def test_quiet_ticks_are_one_row(self) -> None:
        first, second, third, quiet, last = rows(long_trace(150))
        assert isinstance(first, Event) and isinstance(second, Event) and isinstance(last, Event)
        assert isinstance(third, Event), "the input falls back"
        assert isinstance(quiet, Quiet)
        assert (quiet.first, quiet.last, quiet.count) == (4, 152, 149)
        assert quiet.what == (
            "ticks 4–152: nothing but timers (Relay.Theirs.duration1: 1 → 150); 149 ticks = 2980 ms"
        )

    def test_every_tick_is_told_once(self) -> None:
        told: list[int] = []
        for row in rows(long_trace(40)):
            told += [row.number] if isinstance(row, Event) else range(row.first, row.last + 1)
        assert told == list(range(1, len(long_trace(40)) + 1))

    def test_only_changes_and_inputs_marked(self) -> None:
        second = list(rows(long_trace()))[1]
        assert isinstance(second, Event)
        assert [(c.name, c.is_input) for c in second.changes] == [
            ("level", True), ("speed", False), ("alarm", False)
        ]  # fmt: skip

    def test_the_end_says_which_part_is_false(self) -> None:
        named, bare = false_parts(long_trace())
        assert (named.name, named.formula, named.values) == (
            "never_critical", "mode == SAFE", (("mode", "CRITICAL"),)
        )  # fmt: skip
        assert bare.name == "" and dict(bare.values) == {"speed": "0 m/s", "alarm": "false"}


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
        assert "▸ Relay: Ours → Theirs (arrow 1)  [level >= 100]" in shown
        assert "False after tick 153: never_critical" in shown

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


class TestJson(TraceSuite):
    NAME = "json"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        validate(json.loads(document), trace_json.SCHEMA)

    def test_values_are_readable_and_raw(self) -> None:
        state = json.loads(self.shown("long"))["states"][1]
        assert state["inputs"]["level"] == {"value": 100, "raw": 100}
        assert state["after"]["speed"] == {"value": "-0.5", "raw": -5}
        assert state["after"]["Relay"] == {"value": "Theirs", "raw": 2}


def waves(document: str) -> dict[str, dict[int, str]]:
    """The values of each wave by time, read from a value change dump."""
    names = {m[1]: m[2] for m in re.finditer(r"\$var \w+ \d+ (\S+) (\S+)", document)}
    found: dict[str, dict[int, str]] = {name: {} for name in names.values()}
    now = 0
    for line in document.partition("$enddefinitions $end")[2].splitlines():
        if line.startswith("#"):
            now = int(line[1:])
        elif match := re.fullmatch(r"[bs](\S*) (\S+)|([01x])(\S+)", line):
            value, key = (match[1], match[2]) if match[2] else (match[3], match[4])
            found[names[key]][now] = value
    return found


class TestVcd(TraceSuite):
    NAME = "vcd"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        assert set(waves(document)) == {"Relay", "level", "speed", "alarm", "mode", "duration1"}

    def test_values_come_back_at_their_times(self) -> None:
        found = waves(trace_vcd.render(long_trace()))
        assert found["Relay"] == {0: "-", 20: "Ours", 40: "Theirs", 153 * 20: "Ours"}
        assert found["alarm"] == {0: "0", 40: "1", 153 * 20: "0"}
        assert int(found["level"][40], 2) == 100

    def test_no_date_so_that_files_stay_the_same(self) -> None:
        assert not re.search(
            r"\$date\s+\S+\s+\$end", trace_vcd.render(long_trace()).replace("$date $end", "")
        )


@pytest.mark.parametrize("quiet", [0, 1, 2])
def test_short_stretches(quiet: int) -> None:
    assert trace_table.render(long_trace(quiet))
