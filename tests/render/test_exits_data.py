"""Exits for other programs that hold data: waves, tables, states; each is read by a reader of that format."""

import csv
import json
import math
import signal
from importlib import import_module
from io import BytesIO, StringIO
from typing import Any

import pytest
from jsonschema import validate
from vcd.reader import TokenKind, tokenize

from rovercheck.checker.render import renderers, trace_csv, trace_gtkw, trace_itf, trace_json, trace_vcd
from rovercheck.checker.render.waves import waves
from rovercheck.checker.results.trace import Tick, Trace
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.expr import var
from tests.render.conformance import Suite
from tests.render.exits_zoo import TRACES, huge, lasso, needed, odd, witness
from tests.render.zoo import long_trace
from tests.schemas import published
from tests.traces import changed, trace_of


def _reader() -> Any:
    """The class of vcdvcd, whose import would let a closed pipe end this process: that is undone."""
    on_closed_pipe = signal.getsignal(signal.SIGPIPE)
    found = import_module("vcdvcd").VCDVCD
    signal.signal(signal.SIGPIPE, on_closed_pipe)
    return found


VCDVCD = _reader()

SHOWN = [
    (changed(witness(), violated=False, shortest=True), (False, True)),
    (changed(long_trace(1), violated=True, shortest=True), (True, True)),
    (lasso(), (True, False)),
    (witness(), (None, False)),
]
"""Runs, and whether each breaks a property (None: not known) and is a shortest one."""


class TraceSuite(Suite):
    KIND = "trace"
    ZOO = TRACES


def dumped(document: str) -> dict[str, dict[int, Any]]:
    """The values of each wave by time, as a reader of value change dumps finds them."""
    found: dict[str, dict[int, Any]] = {}
    names: dict[str, str] = {}
    scopes: list[str] = []
    now = 0
    for token in tokenize(BytesIO(document.encode())):
        data: Any = token.data
        match token.kind:
            case TokenKind.SCOPE:
                scopes.append(data.ident)
            case TokenKind.UPSCOPE:
                scopes.pop()
            case TokenKind.VAR:
                names[data.id_code] = name = ".".join([*scopes, data.reference])
                found[name] = {}
            case TokenKind.CHANGE_TIME:
                now = data
            case TokenKind.CHANGE_SCALAR | TokenKind.CHANGE_REAL | TokenKind.CHANGE_STRING:
                found[names[data.id_code]][now] = data.value
    return found


class TestVcd(TraceSuite):
    NAME = "vcd"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        ours, theirs = dumped(document), VCDVCD(vcd_string=document)
        assert ours.keys() & {"property.violated", "property.reached"}
        assert ours.keys() == set(theirs.signals)
        for name, values in ours.items():  # the second reader passes texts over
            if theirs[name].tv:
                other = {time: float(v) for time, v in theirs[name].tv if v != "x"}
                assert repr({time: float(v) for time, v in values.items() if v != "x"}) == repr(other)

    def test_values_come_back_at_their_times(self) -> None:
        found = dumped(trace_vcd.render(long_trace()))
        assert found["charts.Relay"] == {0: "-", 20: "Ours", 40: "Theirs", 153 * 20: "Ours"}
        assert found["values.alarm"] == {0: "0", 40: "1", 153 * 20: "0"}
        assert found["inputs.level"][40] == 100 and math.isnan(found["inputs.level"][0])
        assert found["values.speed"][40] == -0.5, "in its unit"
        assert found["timers.Relay.Theirs.duration1"][80] == 2

    def test_the_end_is_marked(self) -> None:
        assert dumped(trace_vcd.render(long_trace()))["property.violated"] == {0: "0", 153 * 20: "1"}
        assert dumped(trace_vcd.render(witness()))["property.reached"] == {0: "0", 4 * 20: "1"}
        assert dumped(trace_vcd.render(lasso()))["property.repeats"] == {0: "0", 60: "1"}

    def test_odd_names_are_told_apart(self) -> None:
        found = dumped(trace_vcd.render(odd()))
        assert {n for n in found if "previous" in n} == {"values.previous_x_3", "values.previous_x_3_2"}
        assert set(found["values.Atze.Ort"].values()) == {"so_la", "$end"}

    def test_no_date_so_that_files_stay_the_same(self) -> None:
        assert "$date" not in trace_vcd.render(long_trace()).replace("$date $end", "")


class TestGtkw(TraceSuite):
    NAME = "gtkw"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        assert document.startswith('[dumpfile] "')
        open_groups: list[str] = []
        for line in document.splitlines():
            if line.startswith("-") and line != "-":
                open_groups.append(line) if open_groups[-1:] != [line] else open_groups.pop()
        assert open_groups == []

    @pytest.mark.parametrize("name", TRACES)
    def test_shows_every_wave_of_the_dump_once(self, name: str) -> None:
        shown = [w for w in self.shown(name).splitlines() if w[:1] not in "[@-*" and "." in w]
        assert sorted(shown) == sorted(dumped(trace_vcd.render(TRACES[name])))

    def test_markers_stand_at_the_end_and_at_the_loop(self) -> None:
        [marks] = [line.split() for line in self.shown("lasso").splitlines() if line.startswith("*")]
        assert marks[1:3] == ["120", "60"]

    def test_what_the_property_does_not_depend_on_is_closed(self) -> None:
        shown = trace_gtkw.render(changed(long_trace(1), relevant=frozenset({"Relay", "level"})), "a b.vcd")
        assert '[dumpfile] "a b.vcd"' in shown
        kept, rest = shown.split("-not of the property\n", 1)
        assert "charts.Relay" in kept and "values.alarm" in rest


class TestCsv(TraceSuite):
    NAME = "csv"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        names, *table = list(csv.reader(StringIO(document)))
        assert names[:2] == ["tick", "time_ms"] and names[-1] == "arrows"
        assert {len(row) for row in table} == {len(names)}
        assert [int(row[0]) for row in table] == list(range(len(table)))

    def test_one_row_per_tick_in_units(self) -> None:
        rows = list(csv.DictReader(StringIO(trace_csv.render(long_trace(2)))))
        assert [r["time_ms"] for r in rows] == ["0", "20", "40", "60", "80", "100"]
        assert (rows[0]["level"], rows[2]["level"], rows[2]["speed"], rows[2]["alarm"]) == (
            "", "100", "-0.5", "true"
        )  # fmt: skip
        assert rows[2]["arrows"] == "Relay: Ours -> Theirs (transition 1) [level >= 100]"

    def test_nothing_in_it_is_a_formula_of_a_spreadsheet(self) -> None:
        """A variable called ``=HYPERLINK(...)`` was one; numbers stay numbers, ``-`` stays no state."""
        mode = var("=HYPERLINK(1)", enumeration("Mode", {"+off": 0, "-": 1}))
        level, other = var("@level", integer(-5, 5)), var("-x", integer(0, 1))
        own = {v.name: v for v in (mode, level, other)}
        trace = trace_of(
            "t", 20, own, (), {mode.name: 0, level.name: -5, other.name: 0},
            (Tick(1, {}, {mode.name: 1, level.name: 5, other.name: 1}, ()),), (), frozenset(), frozenset(),
        )  # fmt: skip
        names, *rows = csv.reader(StringIO(trace_csv.render(trace)))
        assert names[2:5] == ["'=HYPERLINK(1)", "'@level", "'-x"]
        assert [row[2:5] for row in rows] == [["'+off", "-5", "0"], ["-", "5", "1"]]

    def test_no_two_columns_have_one_name(self) -> None:
        own = {n: var(n, integer(0, 1)) for n in ("tick", "tick_", "time_ms", "arrows", "'=1", "=1")}
        held = dict.fromkeys(own, 0)
        trace = trace_of("t", 20, own, (), held, (Tick(1, {}, held, ()),), (), frozenset(), frozenset())
        names, *_ = csv.reader(StringIO(trace_csv.render(trace)))
        assert names == [
            "tick", "time_ms", "tick__", "tick_", "time_ms_", "arrows_", "''=1", "'=1", "arrows"
        ]  # fmt: skip


class TestItf(TraceSuite):
    NAME = "itf"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        found = json.loads(document)
        validate(found, trace_itf.SCHEMA)
        assert all(state.keys() == {"#meta", *found["vars"], *found["params"]} for state in found["states"])
        assert [state["#meta"]["index"] for state in found["states"]] == list(range(len(found["states"])))

    def test_values(self) -> None:
        states = json.loads(trace_itf.render(long_trace()))["states"]
        assert states[2]["level"] == {"#bigint": "100"} and states[2]["speed"] == {"#bigint": "-5"}
        assert states[2]["Relay"] == "Theirs" and states[2]["alarm"] is True
        assert "#unserializable" in states[0]["level"], "an input has no value before the first tick"

    def test_a_loop_goes_on_with_the_tick_after_the_one_it_is_back_at(self) -> None:
        found = json.loads(trace_itf.render(lasso()))
        assert found["loop"] == 3 < len(found["states"])

    @pytest.mark.parametrize(("trace", "shows"), SHOWN)
    def test_says_what_it_shows(self, trace: Trace, shows: tuple[bool | None, bool]) -> None:
        about = json.loads(trace_itf.render(trace))["#meta"]
        assert (about["violated"], about["shortest"]) == shows


class TestJson(TraceSuite):
    NAME = "json"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        validate(json.loads(document), published("trace-3"))

    def test_values_are_readable_and_raw(self) -> None:
        state = json.loads(self.shown("long"))["states"][1]
        assert state["inputs"]["level"] == {"value": 100, "raw": 100}
        assert state["after"]["speed"] == {"value": "-0.5", "raw": -5}
        assert state["after"]["Relay"] == {"value": "Theirs", "raw": 2}

    @pytest.mark.parametrize(("trace", "shows"), SHOWN)
    def test_says_what_it_shows(self, trace: Trace, shows: tuple[bool | None, bool]) -> None:
        about = json.loads(trace_json.render(trace))["#meta"]
        assert (about["violated"], about["shortest"]) == shows

    def test_where_it_is_written_and_what_was_needed(self) -> None:
        found = json.loads(trace_json.render(needed()))
        assert found["#meta"]["place"] == {"file": "models/relay & co.py", "line": 7}
        assert found["states"][1]["fired"][0]["place"]["line"] == 11
        values = [{"value": 100, "raw": 100}, {"value": 101, "raw": 101}]
        assert found["needed"] == [{"tick": 2, "input": "level", "values": values}]


def test_every_wave_has_one_path() -> None:
    for trace in TRACES.values():
        paths = [wave.path for wave in waves(trace)]
        assert len(set(paths)) == len(paths)


@pytest.mark.parametrize("name", ["vcd", "gtkw", "csv", "itf", "json"])
def test_a_run_of_5_000_ticks(name: str) -> None:
    shown = renderers("trace")[name].render(huge())
    assert isinstance(shown, str)
    last = {
        "vcd": "#100000",
        "gtkw": " 100000 -1",
        "csv": "\n5000,100000,",
        "itf": '"index": 5000',
        "json": '"tick": 5000',
    }
    assert last[name] in shown
