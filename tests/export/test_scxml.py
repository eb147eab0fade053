"""Charts that are written as machines of SCXML: by the algorithm of the standard they do the same."""

from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.export.scxml import scxml_of
from rovercheck.checker.scxml.interpret import MachineRunner
from rovercheck.checker.scxml.reader import machine_of
from rovercheck.spec_model.lang.action import Action, assign, send, when
from rovercheck.spec_model.lang.chart import Block, Chart, Junction, State
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var, flag, ite, var
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.transition import Transition, to
from rovercheck.spec_model.rover import systems
from tests.export.scxml_runs import scxml_run, unlike
from tests.export.slx_runs import random_system
from tests.profiles import full

SYSTEMS = 240 if full() else 24
ROWS = 80
MICROSTEPS = 500
"""Of a step at most: more than are read of machines that are checked."""


def differences(system: System, seed: int) -> int:
    """Run a system and its machine; the answer is how many rows were alike.

    Raises ``ModelError`` for a system that is refused.
    """
    machine, steps = scxml_run(system, seed, ROWS)
    runner = MachineRunner(machine_of(machine.text.encode(), "random.scxml"), MICROSTEPS)
    for number, step in enumerate(steps, 1):
        runner.step("tick", carried=step.given)
        found = unlike(machine, step, {one.id for one in runner.active}, runner.data)
        assert not found, f"seed {seed}, step {number}, {step.given}: {found}"
    return len(steps)


@pytest.mark.parametrize("part", range(2))
def test_a_random_system_does_the_same_in_scxml(part: int) -> None:
    alike = 0
    for seed in range(part, SYSTEMS, 2):
        try:
            assert differences(random_system(seed), seed) == ROWS
            alike += 1
        except ModelError as error:
            assert "at once" in str(error) or "in one go" in str(error)
    assert alike * 10 >= SYSTEMS // 2 * 7


@pytest.mark.parametrize("name", ["relay", "obstacles_n", "references", "backward_frozen"])
def test_charts_of_the_rover_do_the_same_in_scxml(name: str) -> None:
    assert differences(systems()[name], 1) == ROWS


def same(system: System) -> bool:
    """Whether a system and its machine do the same in some runs."""
    return {differences(system, seed) for seed in range(6)} == {ROWS}


GO, A, B = flag("go"), var("a", integer(0, 9)), var("b", integer(0, 9))
TELL = send("tell", "Receiver")


def more(data: Var) -> Action:
    return assign(data, ite(data == 9, 0, data + 1))


def sending(place: str, *done: Action) -> System:
    """A region that sends something somewhere, and one that counts its executions, and what it is sent."""
    do, then, entry, during, left = (
        done if one == place else () for one in ("do", "then", "entry", "during", "exit")
    )
    regions = [
        State("Sender", default="Off", states=[
            State("Off", transitions=[to("On", GO, do=do, then=then)]),
            State("On", entry=entry, during=during, exit=left, transitions=[to("Off", ~GO)]),
        ]),
        State("Receiver", default="Idle", states=[
            State("Idle", during=[more(A)], transitions=[to("Told", on="tell")]),
            State("Told", entry=[more(B)], during=[more(A)], transitions=[to("Idle", on="tell")]),
        ]),
    ]  # fmt: skip
    return in_order("Room", Chart("Both", regions, parallel=True))


@pytest.mark.parametrize("place", ["do", "then", "entry", "during", "exit"])
def test_a_receiver_is_executed_in_the_middle_of_actions(place: str) -> None:
    """What follows a send sees what its receiver has done."""
    done = [more(B), TELL, when(B > 4, [TELL, assign(B, 0)]), more(B)]
    assert same(sending(place, *done))


def test_an_event_is_heard_where_it_is_sent_to_and_in_what_lies_there() -> None:
    deep = [
        State("X", transitions=[to("Y", on="tell", do=[more(B)])]),
        State("Y", transitions=[to("X", on="tell")]),
    ]
    receiver = State(
        "Receiver", default="Deep", states=[State("Deep", default="X", states=deep, during=[more(A)])]
    )
    tell: list[Action] = [TELL, when(A > 3, [send("tell", "Deep")]), more(A)]
    sender = State("Sender", default="Off", states=[State("Off", transitions=[to("Off", GO, do=tell)])])
    assert same(in_order("Room", Chart("Both", [sender, receiver], parallel=True)))


@pytest.mark.parametrize(
    ("target", "entry", "default"),
    [
        ("On", [TELL, more(A)], [to("A", B > 3), to("B")]),
        ("On", [TELL, more(A)], [to("B")]),
        ("On.A", [TELL, more(A)], [to("B")]),
        ("On", [more(A)], [to("B", then=[more(A), more(A)])]),
    ],
)
def test_a_composite_that_sends_something_enters_what_is_inside_afterwards(
    target: str, entry: list[Action], default: list[Transition]
) -> None:
    """Its receiver decides which of its states that is."""
    inner = [
        State("A", entry=[more(A)], transitions=[to("B", B > 2)]),
        State("B", entry=[TELL, more(A)], transitions=[to("A", B == 1)]),
    ]
    states = [
        State("Off", transitions=[to(target, GO)]),
        State("On", entry=entry, states=inner, default=default, transitions=[to("Off", ~GO)]),
    ]
    told = State(
        "Receiver", default="Idle", states=[State("Idle", transitions=[to("Idle", on="tell", do=[more(B)])])]
    )
    system = in_order(
        "Room", Chart("Both", [told, State("Sender", states=states, default="Off")], parallel=True)
    )
    assert same(system)


def test_a_send_where_further_states_are_entered_or_left_is_refused() -> None:
    told = State("Receiver", default="Idle", states=[State("Idle", transitions=[to("Idle", on="tell")])])

    def system(entry: Sequence[Action], left: Sequence[Action]) -> System:
        on = State(
            "On", entry=entry, exit=left, states=[State("Only")], default="Only", transitions=[to("On", GO)]
        )
        return in_order(
            "Room", Chart("Both", [State("Sender", states=[on], default="On"), told], parallel=True)
        )

    for where, one in (("entry", system([TELL], [])), ("exit", system([], [TELL]))):
        with pytest.raises(ModelError, match=rf"{where} action of Both\.Sender\.On executes .* in one go"):
            scxml_of(one)


def test_condition_actions_run_before_further_guards_and_exit_actions() -> None:
    """Also where the path then turns out to lead nowhere, so that the next transition is tested."""
    half = Junction("half", [to("B", A > 5, then=[assign(A, 0)]), to("A", (A == 2) & GO)])
    states = [
        State(
            "A",
            exit=[assign(B, A)],
            transitions=[to("half", GO, do=[more(A)]), to("B", A > 0, do=[more(A)])],
        ),
        State("B", during=[more(A)], transitions=[to("A", A == 3, do=[more(A)])]),
    ]
    chart = Chart("C", states, junctions=[half], default="A")
    assert same(in_order("Room", chart))


def test_regions_are_entered_one_after_the_other_where_that_matters() -> None:
    choice = [to("X", B > 3), to("Y")]
    inner = [State("X", entry=[assign(A, 1)]), State("Y", entry=[assign(A, 2)])]
    later = [State("Z", entry=[assign(B, A)], transitions=[to("W", B > 1)]), State("W", entry=[assign(B, 7)])]
    regions = [
        State("First", default=choice, states=inner),
        State("Second", entry=[more(A)], default="Z", states=later),
        State("Third", entry=[more(B)]),
    ]

    def system(off: str, again: str) -> System:
        leaving = [to("Off", ~GO, do=[more(B)]), to(again, B == 2)]
        both = State("Both", states=regions, parallel=True, transitions=leaving)
        return in_order("Room", Chart("C", [State("Off", transitions=[to(off, GO)]), both], default="Off"))

    assert same(system("Both", "Both"))
    for targets in (("Both.Second.W", "Both"), ("Both", "Both.Second.W")):
        with pytest.raises(ModelError, match="Let it lead to Both, and choose inside"):
            scxml_of(system(*targets))


def test_the_machine_shows_the_chart() -> None:
    machine = scxml_of(systems()["relay"])
    root = ElementTree.fromstring(machine.text)
    inside = root.find(".//*[@id='Relay']")
    assert inside is not None
    assert [one.get("id") for one in inside] == ["Relay_not_entered", "B1_actuating", "B2_actuating"]
    assert "<!-- [duration(" in machine.text and machine.states["Relay", ("B1_actuating",)] == "B1_actuating"


def test_numbers_that_ecmascript_has_not_are_refused() -> None:
    far = var("far", integer(0, 1 << 60))
    block = Block("Far", [assign(far, ite(far == 0, 1, 0))])
    with pytest.raises(ModelError, match="more than 53 bits"):
        scxml_of(in_order("Room", block))


def test_the_verb_writes_a_machine(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["export", "--system", "relay", "--format", "scxml", "-o", str(tmp_path)]) == 0
    assert (tmp_path / "relay.scxml").read_text(encoding="utf-8") == scxml_of(systems()["relay"]).text
    assert run(["export", "--system", "relay", "--format", "scxml", "-o", str(tmp_path / "relay.xml")]) == 4
    assert "name a file that ends with .scxml" in capsys.readouterr().err
