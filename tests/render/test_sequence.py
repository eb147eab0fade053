"""Message sequences: who talks to whom, and the picture."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest

from rovercheck.checker.render import trace_sequence
from rovercheck.checker.render.sequence.flow import ENVIRONMENT, flow
from rovercheck.checker.render.sequence.steps import Message, SequenceNote, SequenceStep, message_sequence
from rovercheck.checker.results.trace import TakenTransition, Tick, Trace
from rovercheck.spec_model.composition.fine_systems import SYSTEMS as FINE
from rovercheck.spec_model.composition.systems import SYSTEMS as COMPOSED
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.edit import in_system
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.expr import TRUE, flag, var
from rovercheck.spec_model.lang.specialise import Specialiser
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.words import minimum
from tests.render.conformance import Suite
from tests.render.zoo import TRACES
from tests.traces import changed, trace_of

press, wanted, sent, came, heard = map(flag, ("press", "wanted", "sent", "came", "heard"))
passes, open_ = flag("passes"), flag("open")
age = var("age", integer(0, 200, "ms"))

panel = Chart(
    "Panel",
    [
        State("Idle", transitions=[to("Asked", when=press, do=[assign(wanted, True)])]),
        State("Asked", transitions=[to("Idle", when=~press, do=[assign(wanted, False)])]),
    ],
    default="Idle",
)
door = Chart(
    "Door",
    [
        State("Shut", transitions=[to("Open", when=heard & came & (age < 120), do=[assign(open_, True)])]),
        State("Open"),
    ],
    default="Shut",
)
receive = Block(
    "Line.receive",
    [when(passes, [assign(heard, sent), assign(came, True)], [assign(came, False)])],
)
clock = Block("Clock", [when(came, [assign(age, 0)], [assign(age, minimum(age + 20, 200))])])
send = Block("Line.send", [assign(sent, wanted)])
lamp = Block("Lamp", [assign(flag("lit"), open_)])

BOARDS: tuple[Component, ...] = (
    receive, clock, Enabled(TRUE, panel, name="Front"), Enabled(TRUE, door, name="Back"), lamp, send
)  # fmt: skip
ALONE: tuple[Component, ...] = (
    receive, clock, Enabled(TRUE, panel), door, lamp, send
)  # fmt: skip
DATA = (press, passes, wanted, sent, came, heard, open_, age, flag("lit"))
VARIABLES = {v.name: v for v in (*DATA, *panel.locations, *door.locations)}


def trace(components: tuple[Component, ...] = BOARDS, quiet: int = 3) -> Trace:
    """The button is pressed in tick 2, the frame comes in tick 3, and then no more."""
    at = {v.name: 0 for v in (wanted, sent, came, heard, open_, age)} | {"lit": 0, "Panel": 0, "Door": 0}
    steps: list[tuple[dict[str, int], dict[str, int], tuple[TakenTransition, ...]]] = [
        ({"press": 0, "passes": 0}, {"Panel": 1, "Door": 1, "age": 20},
         (TakenTransition("Panel", "", "Idle", "", 0), TakenTransition("Door", "", "Shut", "", 0))),
        ({"press": 1, "passes": 0}, {"Panel": 2, "wanted": 1, "sent": 1, "age": 40},
         (TakenTransition("Panel", "Idle", "Asked", "[press]", 1),)),
        ({"press": 1, "passes": 1}, {"heard": 1, "came": 1, "age": 0, "open": 1, "lit": 1, "Door": 2},
         (TakenTransition("Door", "Shut", "Open", "[heard]", 1),)),
        ({"press": 1, "passes": 0}, {"came": 0, "age": 20}, ()),
        *(({"press": 1, "passes": 0}, {"age": 40 + 20 * i}, ()) for i in range(quiet)),
        ({"press": 0, "passes": 0}, {"Panel": 1, "wanted": 0, "sent": 0, "age": 200},
         (TakenTransition("Panel", "Asked", "Idle", "[!press]", 1),)),
    ]  # fmt: skip
    ticks = []
    for number, (inputs, differ, transitions) in enumerate(steps, 1):
        at = at | differ
        ticks.append(Tick(number, inputs, at, transitions))
    before = dict.fromkeys(at, 0)
    charts = {"Panel": panel, "Door": door}
    return trace_of(
        "door", 20, VARIABLES, ("press", "passes"), before, tuple(ticks), (~open_ | wanted,),
        statecharts=charts, components=components,
    )  # fmt: skip


def messages(shown: Trace) -> list[tuple[int, Message]]:
    steps = [s for s in message_sequence(shown).steps if isinstance(s, SequenceStep)]
    return [(s.number, item) for s in steps for item in s.items if isinstance(item, Message)]


class TestFlow:
    def test_named_subsystems_are_the_lifelines(self) -> None:
        assert flow(trace()).lifelines == (ENVIRONMENT, "Front", "Back", "Lamp")
        assert flow(trace(ALONE)).lifelines == (ENVIRONMENT, "Panel", "Door", "Lamp")

    def test_a_carrier_hands_on_what_its_content_comes_from(self) -> None:
        between = flow(trace())
        assert between.origins("heard") == {"Front"}
        assert between.origins("came") == {"Front"}, "a flag set beside the content"
        assert between.origins("press") == {ENVIRONMENT}

    def test_an_age_counts_for_itself(self) -> None:
        between = flow(trace())
        assert between.counts("age") and not between.counts("heard")

    def test_both_boards_of_the_rover(self) -> None:
        rover = COMPOSED["rover"]
        between = flow(_of(rover))
        assert between.lifelines == (ENVIRONMENT, "Board 1", "Board 2", "RelayAndDriver")
        assert between.origins("cmd") == between.origins("rx_update") == {"Board 2"}
        assert between.origins("B2.wheel_speed_rpm_FL") == {"Board 1"}
        assert between.origins("d1") == {ENVIRONMENT}

    def test_a_subsystem_keeps_its_name_when_the_system_changes(self) -> None:
        system = in_order("door", *BOARDS)
        changed = in_system(system, "Panel", lambda part: part)
        for made in (changed, free_timers(changed), Specialiser({"press": TRUE}).system(system)):
            assert flow(_of(made)).lifelines[1:3] == ("Front", "Back")

    def test_a_chain_through_both_boards(self) -> None:
        chain = FINE["handover_fine"]
        between = flow(_of(chain))
        assert {"Board 1", "Board 2"} <= set(between.lifelines)
        assert between.origins("b1_requests_switch") == {"Board 1"}


def _of(system: System) -> Trace:
    """A run without ticks, for what a system says of who talks to whom."""
    return trace_of(system.name, 20, {}, tuple(system.inputs), {}, (), components=system.components)


class TestMessages:
    def test_values_cross_when_they_change(self) -> None:
        told = [(n, m.sender, m.receivers, m.told) for n, m in messages(trace())]
        assert (2, ENVIRONMENT, ("Front",), ("press = true",)) in told
        assert (3, "Front", ("Back",), ("came = true", "heard = true", "age = 0 ms")) in told
        assert (3, "Back", ("Lamp",), ("open = true",)) in told

    def test_what_comes_no_more_is_lost(self) -> None:
        [lost] = [m for n, m in messages(trace()) if n == 4]
        assert lost.lost and lost.told == ("came = false",)

    def test_an_age_that_rises_is_no_message(self) -> None:
        told = [line for _, message in messages(trace()) for line in message.told]
        assert [line for line in told if line.startswith("age")] == ["age = 0 ms"]

    def test_quiet_ticks_are_left_out_and_counted(self) -> None:
        quiet = [s for s in message_sequence(trace(quiet=7)).steps if not isinstance(s, SequenceStep)]
        assert quiet and "nothing but timers" in trace_sequence.render(trace(quiet=7))

    def test_states_are_notes_on_their_lifeline(self) -> None:
        first = message_sequence(trace()).steps[0]
        assert isinstance(first, SequenceStep)
        assert SequenceNote("Front", ("Panel: default → Idle",)) in first.items
        alone = message_sequence(trace(ALONE)).steps[0]
        assert isinstance(alone, SequenceStep) and SequenceNote("Panel", ("default → Idle",)) in alone.items

    def test_who_only_starts_is_named_and_not_drawn(self) -> None:
        idle = Chart("Spare", [State("Off")], default="Off")
        first = trace().ticks[0]
        started = replace(first, transitions=(*first.transitions, TakenTransition("Spare", "", "Off", "", 0)))
        shown = changed(trace(), components=(*ALONE, idle), ticks=(started, *trace().ticks[1:]))
        sequence = message_sequence(shown)
        assert sequence.idle == ("Spare",) and "Spare" not in sequence.lifelines
        assert "Not drawn, as they only start: Spare" in trace_sequence.render(shown)

    def test_nobody_talks(self) -> None:
        silent = changed(trace(), components=(), statecharts={})
        with pytest.raises(ModelError, match="Use the format svg"):
            message_sequence(silent)


ZOO = {**TRACES, "boards": trace(), "charts": trace(ALONE), "loop": replace(trace(), loop=4)}


class TestSequence(Suite):
    KIND = "trace"
    NAME = "sequence"
    ZOO = ZOO
    REFUSED = frozenset(TRACES)

    def parse(self, document: str) -> ET.Element:
        root = ET.fromstring(document)
        wide = float(root.get("width", ""))
        assert all(float(e.get("x", 0)) < wide for e in root.iter())
        return root

    def test_the_violation_ends_it(self) -> None:
        words = "".join(self.parse(self.shown("boards")).itertext())
        assert "✗ False since tick 8: !open || wanted" in words

    def test_a_loop_is_framed(self) -> None:
        assert "loop, for ever" in self.shown("loop")
