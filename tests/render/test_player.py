"""The player of a trace: its steps, what is active in each, and the page that holds it."""

import json
import random
import re
from collections.abc import Mapping, Sequence
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest

from rovercheck.checker.render import player, trace_play
from rovercheck.checker.render.drawing.activity import active, followed
from rovercheck.checker.render.drawing.labels import arrows
from rovercheck.checker.render.page import page
from rovercheck.checker.render.player.steps import script, shown_charts
from rovercheck.checker.render.statechart_svg import inline
from rovercheck.checker.results.trace import Needed, TakenTransition, Tick, Trace
from rovercheck.spec_model.lang.action import assign, send
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.interpret import FiredTransition, Interpreter
from rovercheck.spec_model.lang.system import System, charts_of
from rovercheck.spec_model.rover import systems
from tests.render.conformance import Suite
from tests.render.exits_zoo import TRACES, lasso
from tests.render.zoo import CHARTS, alarm, level, relay
from tests.traces import changed, trace_of

lamp = Chart("Lamp", [
    State("Sensor", default="Dark", states=[
        State("Dark", transitions=[to("seen", when=level > 100)]),
        State("Bright", transitions=[to("Dark", when=level < 50, do=[send("off", "Light")])]),
    ], junctions=[Junction("seen", [to("Bright", when=level < 300, do=[send("on", "Light")])])]),
    State("Light", default="Off", states=[
        State("Off", transitions=[to("On", on="on")]),
        State("On", default="Low", entry=[assign(alarm, True)], exit=[assign(alarm, False)], states=[
            State("Low", transitions=[to("High", when=level > 200)]), State("High"),
        ], transitions=[to("Off", on="off")]),
    ]),
], parallel=True, text="A lamp that <shines> & signals.")  # fmt: skip

TOY = System("lamp", (lamp, relay))


def fired(made: Sequence[FiredTransition]) -> tuple[TakenTransition, ...]:
    return tuple(
        TakenTransition(f.chart, ".".join(f.source), ".".join(f.target), f.label, f.order, f.event)
        for f in made
    )


def run(system: System, inputs: Sequence[Mapping[str, int]]) -> Trace:
    """What the interpreter of the charts makes of some inputs."""
    interpreter = Interpreter(system)
    variables = {**system.written, **system.inputs, **{v.name: v for v in system.frozen}}
    places = {v.name: v for c in system.charts for v in (*c.locations, c.entered)}
    before, ticks = interpreter.valuation(), []
    for number, given in enumerate(inputs, 1):
        made = fired(interpreter.step(given))
        after = {n: v for n, v in interpreter.valuation().items() if n not in given}
        ticks.append(Tick(number, given, after, made))
    known = frozenset(variables | places)
    return trace_of(
        system.name, system.tick_ms, {**variables, **places}, tuple(system.inputs), before, tuple(ticks),
        (~alarm,), known, frozenset(c.name for c in system.charts), id="TOY-2", text="It stays dark.",
        statecharts={c.name: c for c in system.charts},
    )  # fmt: skip


def shining() -> Trace:
    """Dark for two ticks, then bright, then brighter."""
    return run(TOY, [{"level": raw} for raw in (0, 0, 150, 250)])


class TestSteps:
    def test_transitions_of_a_tick_are_steps_in_their_order(self) -> None:
        played = script(shining())
        told = [(s.event, s.first, s.last) for s in played.steps]
        start, lit = played.events[0], played.events[1]
        assert [a.target for a in lit.transitions][:3] == ["Light.On", "Light.On.Low", "Sensor.Bright"]
        assert told[:4] == [(None, 0, 0), (0, 0, len(start.transitions)), (1, 0, 2), (1, 2, 3)]

    def test_in_between_the_transitions_taken_count(self) -> None:
        nested, bright = (s for s in script(shining()).steps if s.event == 1 and s.first in (0, 2))
        assert ("Sensor", "Dark") in nested.states["Lamp"] and ("Light", "On", "Low") in nested.states["Lamp"]
        assert ("Sensor", "Bright") in bright.states["Lamp"]

    def test_nothing_is_active_before_the_first_tick(self) -> None:
        assert not any(script(shining()).steps[0].states.values())

    def test_only_charts_that_matter(self) -> None:
        trace = shining()
        some = changed(trace, charts=frozenset({"Relay"}))
        assert [c.name for c in shown_charts(some)] == ["Relay"]
        assert [c.name for c in shown_charts(some, everything=True)] == ["Lamp", "Relay"]


@pytest.mark.parametrize("name", ["obstacles", "board1", "lamp"])
def test_transitions_lead_to_the_states_of_the_valuation(name: str) -> None:
    """What is followed along the transitions of a tick is what the locations say after it."""
    system = TOY if name == "lamp" else systems()[name]
    chance = random.Random(name)
    inputs = [{n: chance.choice(list(v.domain.values)) for n, v in system.inputs.items()} for _ in range(60)]
    trace = run(system, inputs)
    charts = {c.name: c for c in system.charts}
    at = {c: active(chart, trace.before) for c, chart in charts.items()}
    moved = 0
    for tick in trace.ticks:
        for transition in tick.transitions:
            at[transition.chart] = followed(charts[transition.chart], at[transition.chart], transition)
            moved += 1
        for c, chart in charts.items():
            assert at[c] == active(chart, tick.after), (c, tick)
    assert moved > 20


class Reader(HTMLParser):
    """The start tags of a page."""

    def __init__(self, document: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.feed(document)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))


def data(document: str) -> dict[str, object]:
    [block] = re.findall(r'<script type="application/json" class="player-data">(.*?)</script>', document)
    found: dict[str, object] = json.loads(block)
    return found


class TestPlay(Suite):
    KIND = "trace"
    NAME = "play"
    ZOO = {**TRACES, "shining": shining()}  # noqa: RUF012

    def parse(self, document: str) -> None:
        tags = Reader(document).tags
        assert not [t for t in tags if any(name.startswith("on") or name in ("href", "src") for name in t[1])]
        assert not [t for t in tags if "id" in t[1]], "several players may share a page"
        assert sum(tag == "section" for tag, _ in tags) == 1
        found = data(document)
        steps, events = found["steps"], found["events"]
        assert isinstance(steps, list) and isinstance(events, list)
        assert {s["event"] for s in steps} == {None, *range(len(events))}

    def test_every_transition_told_is_drawn(self) -> None:
        document = self.shown("shining")
        drawn = {a["data-arrow"] for _, a in Reader(document).tags if "data-arrow" in a}
        events = data(document)["events"]
        assert isinstance(events, list)
        told = [transition for event in events for transition in event["transitions"]]
        assert told and all(
            transition["drawn"] and drawn.issuperset(transition["drawn"]) for transition in told
        )
        through = next(a for a in told if "Sensor.Bright" in a["way"])
        assert through["drawn"] == ["Sensor.Dark#1", "Sensor.seen#1"]

    def test_text_of_the_model_stays_text(self) -> None:
        document = self.shown("odd")
        assert "<b>&\n" not in document and "&lt;b&gt;" in document

    def test_a_run_without_charts_says_so(self) -> None:
        assert "no chart to play on" in self.shown("empty")

    def test_what_the_end_needs_and_where_it_returns(self) -> None:
        trace = shining()
        needed = changed(trace, needed=(Needed(3, "level", frozenset({150, 151})),))
        found = data(trace_play.render(needed))
        assert '"forced":["level = 150 or 151"]' in json.dumps(found, separators=(",", ":"))
        again = data(trace_play.render(lasso()))
        assert again["loop"] == 2 and again["again"] and "Loop: back to tick 2" in str(again["end"])


def test_players_share_pictures_and_scripts() -> None:
    trace = shining()
    parts = [
        player.part(trace, pictures=False),
        player.part(trace, pictures=False),
        player.gallery([trace] * 2),
    ]
    document = page("Two", parts)
    tags = Reader(document).tags
    assert [a["data-picture"] for t, a in tags if t == "template"] == [player.key(lamp), player.key(relay)]
    assert sum(tag == "svg" for tag, _ in tags) == 2
    assert sum(tag == "script" and "type" not in a for tag, a in tags) == 4


@pytest.mark.parametrize("chart", {**CHARTS, **charts_of(systems())}.values(), ids=lambda c: c.name)
def test_pictures_name_their_parts(chart: Chart) -> None:
    root = ElementTree.fromstring(inline(chart))
    states = [e.get("data-state", "") for e in root.iter() if e.get("data-state")]
    assert sorted(states) == sorted(".".join(path) for path in chart.states if path)
    assert {e.get("data-arrow") for e in root.iter() if e.get("data-arrow")} == {
        a.name for a in arrows(chart)
    }
    assert not [e for e in root.iter() if e.get("id")]
    assert not list(root.iter("{http://www.w3.org/2000/svg}style")), "the page brings the style"
