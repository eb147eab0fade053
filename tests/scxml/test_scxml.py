"""Machines in SCXML: what is read, what it means by both readings, what is refused, and what is checked."""

from pathlib import Path
from random import Random

import pytest

from rovercheck import check, scxml_model
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.explore.by_hand.next_steps import StepFinder
from rovercheck.checker.results.verdict import Proved
from rovercheck.checker.scxml.interpret import MachineRunner
from rovercheck.checker.scxml.reader import machine_of
from rovercheck.spec_model.lang.errors import ModelError
from tests.scxml.random_machines import differences, inputs, lowered, random_machine

DOOR = Path(__file__).parents[2] / "examples/scxml/door.scxml"
MANY = 12
"""Random machines; `differences` of any number of them is what the slow loop of a developer asks."""


def machine(inside: str, more: str = "") -> str:
    """A machine with some states."""
    return f"<scxml xmlns='http://www.w3.org/2005/07/scxml' datamodel='ecmascript' {more}>{inside}</scxml>"


def active(text: str, *events: str) -> set[str]:
    """The states that are active after the first step and some events."""
    runner = MachineRunner(machine_of(text.encode(), "toy.scxml"))
    for event in ("", *events):
        runner.step(event)
    return {one.id for one in runner.active}


@pytest.mark.parametrize("seed", range(MANY))
def test_both_readings_of_random_machines_agree(seed: int) -> None:
    one = lowered(random_machine(seed))
    assert differences(one, list(inputs(one.machine.offered, Random(seed), 20))) == ""


@pytest.mark.parametrize("seed", range(MANY))
def test_both_readings_of_random_machines_agree_on_what_events_carry(seed: int) -> None:
    one = lowered(random_machine(seed, carrying=True))
    assert differences(one, list(inputs(one.machine.offered, Random(seed), 20))) == ""


def test_most_random_machines_read_what_events_carry() -> None:
    texts = [random_machine(seed, carrying=True) for seed in range(MANY)]
    assert sum("_event.data" in text for text in texts) > MANY // 2


# --- the standard ------------------------------------------------------------------------------------------

REGIONS = machine(
    "<parallel id='p'><transition event='e' target='out'/><state id='r'><state id='a'>"
    "<transition event='e' target='b'/></state><state id='b'/></state>"
    "<state id='q'><state id='c'><transition event='e' target='d'/></state><state id='d'/></state>"
    "</parallel><state id='out'/>"
)


def test_transitions_of_descendants_preempt_those_of_their_ancestors() -> None:
    assert active(REGIONS, "e") == {"p", "r", "b", "q", "d"}
    assert active(REGIONS, "e", "e") == {"out"}


def test_final_states_of_all_regions_are_the_end_of_a_parallel_state() -> None:
    inner = "<state id='{0}1'><transition event='{0}' target='{0}2'/></state><final id='{0}2'/>"
    region = f"<state id='{{0}}'>{inner}</state>"
    text = machine(
        f"<parallel id='p'>{region.format('a')}{region.format('b')}"
        "<transition event='done.state.p' target='end'/></parallel><state id='end'/>"
    )
    assert "p" in active(text, "a") and active(text, "a", "b") == {"end"}


@pytest.mark.parametrize(("kind", "found"), [("shallow", "m"), ("deep", "n")])
def test_a_history_remembers_a_child_or_everything(kind: str, found: str) -> None:
    text = machine(
        f"<state id='s'><history id='h' type='{kind}'><transition target='k'/></history>"
        "<state id='k'><transition event='go' target='n'/></state>"
        "<state id='l'><state id='m'/><state id='n'/></state><transition event='off' target='o'/></state>"
        "<state id='o'><transition event='on' target='h'/></state>"
    )
    assert active(text, "off", "on") == {"s", "k"}
    assert active(text, "go", "off", "on") == {"s", "l", found}


def test_too_many_microsteps_are_told() -> None:
    text = machine(
        "<state id='a'><transition cond='true' target='b'/></state>"
        "<state id='b'><transition cond='true' target='a'/></state>"
    )
    with pytest.raises(DrawnFault, match="more than 12 microsteps"):
        active(text)


def test_a_delay_passes_in_steps_without_an_event() -> None:
    assert scxml_model(DOOR).system.tick_ms == 2000
    text = DOOR.read_text(encoding="utf-8")
    assert "open" in active(text, "button", "limit.open", "button")
    assert "closing" in active(text, "button", "limit.open", "button", "")


# --- what is refused ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("inside", "said"),
    [
        ("<state id='a'>\n<invoke/></state>", "line 2: <invoke>: another machine"),
        ("<state id='a'><onentry>\n<script/></onentry></state>", "line 2: <script>: a script"),
        ("<state id='a'><onentry>\n<foreach/></onentry></state>", "line 2: <foreach>: a loop over data"),
        ("<state id='a'><transition event='e' target='b'/></state>", "which is no state"),
        ("<state id='a'/><state id='a'/>", "the id a a second time"),
        ("<state id='a'><transition cond='1 / 2' target='a'/></state>", "no exact meaning here"),
        ("<state id='a'><transition cond='1 % 0 == 0' target='a'/></state>", "divides by no positive whole"),
        (
            "<state id='a'><transition cond='Math.floor(1.5) == 1' target='a'/></state>",
            "no exact meaning here",
        ),
        (
            "<state id='a'><transition cond='Math.floor(1 + 2) == 1' target='a'/></state>",
            "is not expected there",
        ),
        ("<state id='a'><transition cond='1' target='a'/></state>", "is no boolean value"),
        ("<datamodel><data id='x' expr='1.5'/></datamodel><state id='a'/>", "no exact meaning here"),
        ("<state id='a'><onentry><send event='e' delay='soon'/></onentry></state>", "the delay 'soon'"),
        ("<parallel id='p'/>", "a <parallel> without regions"),
        ("<state id='a'><transition event='e' target='a b'/></state><state id='b'/>", "exclude each other"),
        ("", "a machine without a state"),
    ],
)
def test_what_has_no_meaning_is_told_with_its_line(inside: str, said: str) -> None:
    with pytest.raises(ModelError) as raised:
        machine_of(machine(inside).encode(), "toy.scxml")
    assert said in str(raised.value) and "toy.scxml, line " in str(raised.value)


HOSTILE = [
    b"", b"\0\1\2", b"<scxml", "<scxml>".encode("utf-16"), b"<a/>",
    b'<!DOCTYPE a [<!ENTITY a "ha">]><scxml>&a;</scxml>', b"<scxml>" + b"<state>" * 5000,
    machine("<state id='a'><transition cond='" + "(" * 3000 + "'/></state>").encode(),
    machine("<state id='a'><transition cond='" + "!" * 3000 + "true'/></state>").encode(),
]  # fmt: skip


@pytest.mark.parametrize("number", range(len(HOSTILE)))
def test_hostile_files_are_one_message(
    number: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "hostile.scxml"
    file.write_bytes(HOSTILE[number])
    assert run(["import", str(file)]) == Exit.USAGE
    assert "hostile.scxml, line" in " ".join(capsys.readouterr().err.split())


def test_whatever_is_damaged_there_is_a_machine_or_a_message() -> None:
    refused, random, text = 0, Random(0), DOOR.read_bytes()
    for _ in range(200):
        damaged = bytearray(text)
        for _ in range(random.choice((1, 1, 3))):
            damaged[random.randrange(len(text))] = random.choice(b"<>/=\"' ax0\0\xff")
        try:
            machine_of(bytes(damaged), "door.scxml")
        except ModelError as error:
            refused += 1
            assert "door.scxml" in str(error)
    assert 20 < refused < 200


# --- checking ----------------------------------------------------------------------------------------------


def test_a_machine_is_checked_with_the_properties_beside_it() -> None:
    found = check(str(DOOR))
    assert {one.result.property.id: type(one.result.verdict) for one in found} == {
        "DOOR-1": Proved, "DOOR-2": Proved
    }  # fmt: skip


def test_import_says_what_stands_in_a_machine(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["import", str(DOOR)]) == Exit.AS_EXPECTED
    said = " ".join(capsys.readouterr().out.split())
    assert "Door: SCXML, 6 states, 9 transitions, 1 datum." in said and "It can be checked" in said


def test_a_datum_that_is_computed_needs_a_domain(tmp_path: Path) -> None:
    file = tmp_path / "count.scxml"
    file.write_text(machine(
        "<datamodel><data id='n' expr='0'/></datamodel><state id='a'>"
        "<transition event='e'><assign location='n' expr='n + 1'/></transition></state>"
    ), encoding="utf-8")  # fmt: skip
    with pytest.raises(ModelError, match="no domain is given for n"):
        scxml_model(file)
    (tmp_path / "count.domains.toml").write_text("[domains]\nn = { low = 0, high = 9 }\n", encoding="utf-8")
    assert str(scxml_model(file)["n"]) == "n"


# --- other verbs -------------------------------------------------------------------------------------------


def test_a_machine_is_not_written_for_simulink_without_its_program(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "door.slx"
    line = ["export", "--system", "Door", "--format", "slx", "-o", str(out), "--model", str(DOOR)]
    assert run(line) == Exit.USAGE
    assert "its step is a program" in " ".join(capsys.readouterr().err.split()) and not out.exists()


def test_a_machine_without_transitions_is_read(tmp_path: Path) -> None:
    file = tmp_path / "one.scxml"
    file.write_text(machine("<state id='a'/>"), encoding="utf-8")
    assert "event" not in scxml_model(file).system.inputs  # nothing asks for one


def test_a_machine_with_delays_is_no_implementation_in_steps_of_one_length(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = ["generate-tests", "-o", str(tmp_path / "out"), "--model", str(DOOR)]
    assert run(line) == Exit.USAGE
    assert "Door is a machine with delays: time passes only in" in " ".join(capsys.readouterr().err.split())


def test_next_steps_of_a_machine_are_refused_in_a_message() -> None:
    with pytest.raises(ModelError, match="Door was read from a file, and what it can do next is not listed"):
        StepFinder(scxml_model(DOOR).system)
