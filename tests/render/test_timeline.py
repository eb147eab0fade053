"""The timeline of a trace: what its lanes show, where ticks are, and the pictures made of it."""

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from fractions import Fraction
from html.parser import HTMLParser
from itertools import pairwise

import pytest

from rovercheck.checker.render import trace_html, trace_svg
from rovercheck.checker.render.lanes import Tone
from rovercheck.checker.render.periods import RepeatedTicks
from rovercheck.checker.render.timeline import story_part, timeline
from rovercheck.checker.render.timeline.axis import fit, labelled
from rovercheck.checker.render.timeline.drawing import place
from rovercheck.checker.render.timeline.limits import thresholds, time_limits
from rovercheck.checker.render.timeline.model import Lane, LaneGroup, LaneKind, NeededTicks, Timeline
from rovercheck.checker.render.timeline.runs import outside
from rovercheck.checker.render.timeline.shapes import fitting
from rovercheck.checker.render.timeline.tones import tone
from rovercheck.checker.results.trace import Needed, Tick, Trace
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import fixed, integer
from rovercheck.spec_model.lang.expr import Var, const, flag, var
from rovercheck.spec_model.lang.words import absolute, named, once
from tests.render.conformance import Suite
from tests.render.zoo import TRACES, level, long_trace, relay, short_trace
from tests.traces import changed, trace_of

SVG = "{http://www.w3.org/2000/svg}"


def drawn(quiet: int = 150) -> Trace:
    """The long toy with its chart, so that the limits of the chart are known."""
    return changed(
        long_trace(quiet),
        id="TOY-1",
        text="It is <never> & ever critical.",
        statecharts={"Relay": relay},
        needed=(Needed(2, "level", frozenset({100})),),
    )


def counted(values: list[int], domain: int = 300) -> Trace:
    """One number over time."""
    number = var("n", integer(0, domain, "ms"))
    ticks = tuple(Tick(i, {}, {"n": v}) for i, v in enumerate(values, 1))
    return trace_of("count", 20, {"n": number}, (), {"n": 0}, ticks)


def lane(shown: Timeline, name: str) -> Lane:
    return next(one for one in shown.lanes if one.name == name)


class TestLanes:
    def test_every_tick_of_every_lane_shows_the_value_of_the_trace(self) -> None:
        trace = drawn()
        for one in timeline(trace).lanes:
            if one.kind is LaneKind.TRUTH:
                continue
            for tick in trace.ticks:
                [run] = [run for run in one.runs if run.first <= tick.number <= run.last]
                raw = {**tick.after, **tick.inputs}[one.name]
                share = Fraction(tick.number - run.first, max(1, run.last - run.first))
                resolution = Fraction(1, 10) if one.name == "speed" else 1
                assert run.low + (run.high - run.low) * share == raw * resolution or one.kind is LaneKind.BAND
                if one.kind is LaneKind.BAND:
                    assert run.label.split()[0] == trace.show(one.name, raw)

    def test_a_steady_count_is_one_run(self) -> None:
        [run] = lane(timeline(counted([20, 40, 60, 80])), "n").runs
        assert (run.label, run.until, int(run.low), int(run.high)) == ("20 ms", "80 ms", 20, 80)

    def test_what_only_looks_steady_is_not(self) -> None:
        runs = lane(timeline(counted([5, 6, 5, 6, 6, 9])), "n").runs
        assert [(r.first, r.last, int(r.low), int(r.high)) for r in runs] == [
            (1, 1, 5, 5), (2, 2, 6, 6), (3, 3, 5, 5), (4, 5, 6, 6), (6, 6, 9, 9)
        ]  # fmt: skip

    def test_a_number_that_never_changes_is_a_line_only_beside_its_limits(self) -> None:
        still = changed(counted([7, 7, 7]), false_parts=(var("n", integer(0, 300, "ms")) != 7,))
        assert lane(timeline(still), "n").kind is LaneKind.BAND
        compared = changed(still, false_parts=(var("n", integer(0, 300, "ms")) > 9,))
        assert lane(timeline(compared), "n").kind is LaneKind.LINE

    def test_needed_inputs_come_first_and_are_marked(self) -> None:
        shown = timeline(drawn())
        assert shown.lanes[0].name == "level" and shown.lanes[0].needed == (NeededTicks(2, 2, "level = 100"),)
        assert shown.cause.startswith("Determined by tick 2: level = 100. Whatever the other inputs are,")
        assert timeline(long_trace()).cause == ""

    def test_a_timer_is_a_ramp_of_times_up_to_its_span(self) -> None:
        timer = lane(timeline(drawn()), "Relay.Theirs.duration1")
        assert timer.kind is LaneKind.RAMP and timer.group is LaneGroup.CHARTS
        assert [(int(limit.value), limit.label) for limit in timer.limits] == [(150, "3 s")]
        assert [(run.label, run.until) for run in timer.runs] == [
            ("0 ms", ""), ("20 ms", "3 s"), ("0 ms", "")
        ]  # fmt: skip

    def test_transitions_are_marked_where_the_state_changes(self) -> None:
        shots = lane(timeline(drawn()), "Relay").shots
        assert [shot.tick for shot in shots] == [1, 2, 153]
        assert shots[1].text == "Ours → Theirs (transition 1) [level >= 100]"

    def test_the_property_lane_is_its_truth(self) -> None:
        never, bare = timeline(drawn()).of(LaneGroup.PROPERTY)
        assert [(r.first, r.last, r.label) for r in never.runs] == [(1, 152, "true"), (153, 153, "false")]
        assert [r.label for r in bare.runs] == ["false", "true", "false"]

    def test_what_never_changes_is_told_once(self) -> None:
        still = flag("still")
        trace = drawn(5)
        ticks = tuple(replace(t, after={**t.after, "still": 1}) for t in trace.ticks)
        shown = timeline(changed(trace, ticks=ticks, variables={**trace.system.variables, "still": still}))
        assert ("still", "true") in shown.constant
        assert "still" not in [one.name for one in shown.lanes]

    def test_only_what_the_property_depends_on(self) -> None:
        trace = changed(drawn(), relevant=frozenset({"level", "mode"}), charts=frozenset({"Relay"}))
        names = [one.name for one in timeline(trace).lanes if one.group is not LaneGroup.PROPERTY]
        assert names == ["level", "mode"]
        assert "Relay" in [one.name for one in timeline(trace, everything=True).lanes]


class TestLimits:
    def test_constants_beside_a_variable_on_either_side(self) -> None:
        found = thresholds([(level >= 100) | (const(7) > level), named("n", level == 3)])
        assert [limit.value for limit in found["level"]] == [3, 7, 100]

    def test_in_the_unit_and_resolution_of_the_variable(self) -> None:
        speed = Var("speed", fixed(-1, 1, "0.1", "m/s"), 0)
        [limit] = thresholds([speed > const("0.25", "m/s")])["speed"]
        assert (limit.value, limit.label) == (Fraction(1, 4), "0.25 m/s")

    def test_those_of_function_blocks_too(self) -> None:
        block = Block("Near", [when(level <= 42, [assign(flag("near"), True)])])
        shown = timeline(changed(long_trace(), components=(block,)))
        assert [limit.label for limit in lane(shown, "level").limits] == ["42"]

    def test_an_absolute_value_has_two(self) -> None:
        angle = var("angle", integer(-180, 180, "deg"))
        assert [limit.value for limit in thresholds([absolute(angle) < 45])["angle"]] == [-45, 45]

    @pytest.mark.parametrize(("top", "limits"), [(151, [150]), (3001, [3000]), (78, [])])
    def test_a_span_in_the_steps_of_its_counter(self, top: int, limits: list[int]) -> None:
        trace = drawn()
        counter = var("Relay.Theirs.duration1", integer(0, top))
        found = time_limits(changed(trace, variables={**trace.system.variables, counter.name: counter}))
        assert [int(limit.value) for limit in found.get(counter.name, ())] == limits


@pytest.mark.parametrize(
    ("value", "meaning"),
    [
        ("SUP_CRITICAL", Tone.CRITICAL),
        ("Rx_DEG", Tone.DEGRADED),
        ("BATT_OK", Tone.OK),
        ("RoverSafeState", Tone.OK),
        ("NotOKButFailed", Tone.CRITICAL),
        ("degree", Tone.FIRST),
        ("true", Tone.ACTION),
        ("false", Tone.IDLE),
        ("-", Tone.IDLE),
    ],
)
def test_tones(value: str, meaning: Tone) -> None:
    assert tone(value) is meaning


class TestAxis:
    @pytest.mark.parametrize("quiet", [3, 100, 150, 400, 5000])
    def test_ticks_follow_each_other(self, quiet: int) -> None:
        shown = timeline(drawn(quiet))
        axis = fit(shown)
        assert len(axis.edges) == len(drawn(quiet)) + 1
        assert all(a < b for a, b in pairwise(axis.edges))
        assert axis.width <= 961

    def test_short_runs_are_to_scale(self) -> None:
        axis = fit(timeline(drawn(100)))
        steps = {round(b - a, 1) for a, b in pairwise(axis.edges)}
        assert len(steps) <= 2 and max(steps) - min(steps) < 0.11 and axis.breaks == ()

    def test_long_quiet_stretches_are_shortened_and_that_is_said(self) -> None:
        assert fit(timeline(drawn(400))).breaks == ((4, 402),)
        picture = trace_svg.render(drawn(400))
        assert "Not to scale: 399 of 403 ticks" in picture and "399 ticks" in picture
        assert "To scale: every tick is 20 ms" in trace_svg.render(drawn(100))

    def test_the_start_of_a_loop_stays_visible(self) -> None:
        axis = fit(timeline(replace(drawn(400), loop=200)))
        assert axis.breaks == ((4, 200), (201, 402))

    @pytest.mark.parametrize("quiet", [0, 10, 150, 400])
    def test_labels_do_not_overlap(self, quiet: int) -> None:
        shown = timeline(drawn(quiet))
        axis = fit(shown)
        ticks = labelled(shown, axis)
        assert ticks[0] == 1 and ticks[-1] == len(drawn(quiet))
        assert all(axis.middle(b) - axis.middle(a) > 12 for a, b in pairwise(ticks))

    def test_events_without_pause_make_the_picture_wider(self) -> None:
        unlike = [5 * (k.bit_count() % 2) for k in range(900)]
        axis = fit(timeline(counted(unlike, 5)))
        assert axis.breaks == () and axis.width == 2700

    def test_ticks_that_repeat_others_are_a_box_with_their_numbers_and_times(self) -> None:
        trace = counted([0, *[0] * 5, *([9, 5, 0] * 1000)], 9)
        shown = timeline(trace)
        axis = fit(shown)
        [fold] = axis.folds
        assert (fold.period, fold.times) == (3, 998) and axis.width <= 961
        words = [e.text for e in ET.fromstring(trace_svg.render(trace)).iter(f"{SVG}text")]
        assert {"× 998 more", f"{fold.first}–{fold.last}", f"{fold.ms[0]}–{fold.ms[1]}"} <= {*words}
        assert "ticks 7–9 again" in words
        assert len(ET.fromstring(trace_svg.render(trace)).findall(f".//{SVG}path")) < 60

    @pytest.mark.parametrize("cut", [(2, 5), (1, 6), (3, 3), (5, 9)])
    def test_what_lies_in_a_box_is_not_drawn_and_the_rest_as_before(self, cut: tuple[int, int]) -> None:
        whole = lane(timeline(counted([0, 2, 4, 6, 8, 10, 3, 3, 7, 7])), "n")
        fold = RepeatedTicks(*cut, 1, cut[1] - cut[0] + 1, (0, 0))
        left = {
            tick: run.low + (run.high - run.low) * Fraction(tick - run.first, max(1, run.last - run.first))
            for run in outside(whole, [fold]).runs
            for tick in range(run.first, run.last + 1)
        }
        kept = [tick for tick in range(1, 11) if not cut[0] <= tick <= cut[1]]
        assert left == {tick: [0, 2, 4, 6, 8, 10, 3, 3, 7, 7][tick - 1] for tick in kept}


def test_lanes_do_not_overlap() -> None:
    shown = timeline(drawn())
    rows = place(shown, fit(shown)).rows
    assert all(a.top + a.tall <= b.top for a, b in pairwise(rows))


def test_labels_are_cut_to_their_room() -> None:
    assert fitting("CRITICAL", 100) == "CRITICAL"
    assert re.fullmatch(r"CRIT.*…", fitting("CRITICAL_AND_LONGER", 60))
    assert fitting("CRITICAL", 10) == ""


ZOO = {
    **TRACES,
    "drawn": drawn(),
    "labelled": drawn(10),
    "shortened": drawn(400),
    "loop": replace(drawn(400), loop=200),
    "witness": changed(short_trace(), false_parts=()),
}


class TestSvg(Suite):
    KIND = "trace"
    NAME = "svg"
    ZOO = ZOO

    def parse(self, document: str) -> ET.Element:
        root = ET.fromstring(document)
        width, height = (float(root.get(side, "")) for side in ("width", "height"))
        assert 900 <= width <= 1300 and height > 100
        return root

    def test_the_end_is_marked_in_words(self) -> None:
        words = " ".join(self.parse(self.shown("drawn")).itertext())
        assert "✗ False since tick 153: never_critical: mode == SAFE" in words
        assert "TOY-1" in words and "It is <never> & ever critical." in words

    def test_colours_are_never_alone(self) -> None:
        root = self.parse(self.shown("labelled"))
        classes = {e.get("class") for e in root.iter() if e.get("class")}
        assert {"tl-is-critical", "tl-fail", "tl-limit", "tl-needed", "tl-shot"} <= classes
        story_part = [e.text for e in root.iter(f"{SVG}text")]
        assert {"Ours", "Theirs", "false", "3 s", "critical, or false part of the property"} <= set(
            story_part
        )

    def test_a_loop_repeats(self) -> None:
        assert "repeats for ever" in self.shown("loop")
        assert "false here" not in self.shown("loop") and "false here" in self.shown("drawn")


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.names: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.names.append(tag)
        if tag not in ("meta", "input", "br", "wbr", "link", "hr", "img"):
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: object) -> None:
        self.names.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


class TestHtml(Suite):
    KIND = "trace"
    NAME = "html"
    ZOO = ZOO

    def parse(self, document: str) -> list[str]:
        reader = _Reader()
        reader.feed(document)
        assert reader.open == []
        return reader.names

    def test_what_comes_from_a_model_is_escaped(self) -> None:
        page = self.shown("drawn")
        assert "It is &lt;never&gt; &amp; ever critical." in page and "<never>" not in page

    def test_all_that_a_reader_wants(self) -> None:
        names = self.parse(self.shown("drawn"))
        assert {"svg", "table", "output", "button"} <= set(names)
        assert "Cause: the inputs" in self.shown("drawn") and "Cause: the inputs" not in self.shown("long")

    def test_thousands_of_ticks_stay_small(self) -> None:
        assert len(trace_html.render(drawn(5000))) < 2 * len(trace_html.render(drawn(50)))


class TestNeeds:
    def test_ticks_in_a_row_are_marked_once(self) -> None:
        same = tuple(Needed(k, "level", frozenset({0})) for k in (3, 4, 6))
        shown = lane(timeline(changed(drawn(), needed=same)), "level")
        assert shown.needed == (NeededTicks(3, 4, "level = 0"), NeededTicks(6, 6, "level = 0"))

    def test_reasons_are_told_by_tick(self) -> None:
        page = story_part(drawn()).body
        assert "<li>tick 2 (40 ms): <code>level = 100</code></li>" in page
        assert (
            "Not minimised" in page and "Not minimised" not in story_part(changed(drawn(), minimal=True)).body
        )

    def test_not_examined_is_not_nothing(self) -> None:
        assert "Cause: the inputs" not in story_part(long_trace()).body
        assert "whatever its inputs" in story_part(changed(drawn(), needed=())).body

    def test_many_states_entered_at_once_are_told_in_a_line(self) -> None:
        first, *rest = drawn().ticks
        [enters, *_] = [t for t in first.transitions if not t.order]
        fires = replace(enters, order=2)
        for count, folded in ((6, 0), (7, 1)):
            tick = replace(first, transitions=(fires, *[enters] * count))
            page = str(story_part(replace(drawn(), ticks=(tick, *rest))).body)
            assert page.count("told-starts") == folded
            assert page.count("default →") == count and page.count("(transition 2)") == 1
            if folded:
                assert "7 states are entered by default transitions" in page
                assert "(transition 2)" not in page.partition("<details")[2].partition("</details>")[0]


class TestTruths:
    def test_known_truths_are_taken(self) -> None:
        trace = drawn(1)
        part = trace.property.false_parts[0]
        known = changed(trace, parts=(part,), truths=((False, True, True, False),))
        shown = next(one for one in timeline(known).of(LaneGroup.PROPERTY) if one.name == "never_critical")
        assert [run.label for run in shown.runs] == ["false", "true", "false"]

    def test_a_part_about_the_past_is_known_at_the_end(self) -> None:
        trace = changed(drawn(1), false_parts=(once(level > 300),))
        [shown] = timeline(trace).of(LaneGroup.PROPERTY)
        assert [(run.first, run.label) for run in shown.runs] == [(4, "false")]
