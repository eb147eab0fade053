"""What the algorithm of the standard (appendix D) says where others read it differently."""

from pathlib import Path
from random import Random

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.scxml.interpret import MachineRunner
from rovercheck.checker.scxml.reader import machine_of
from rovercheck.checker.scxml.system import lowered_machine
from rovercheck.spec_model.lang.domain import integer
from tests.scxml.random_machines import differences, inputs, random_machine

SPACE = "xmlns='http://www.w3.org/2005/07/scxml' datamodel='ecmascript'"
COUNT = "<assign location='x' expr='x + {}'/>"


def counted(inside: str) -> str:
    """A machine with a counter."""
    return f"<scxml {SPACE}><datamodel><data id='x' expr='0'/></datamodel>{inside}</scxml>"


def ran(text: str, *events: str) -> MachineRunner:
    """A machine after some events, by the algorithm of the standard; the system agrees."""
    machine = machine_of(text.encode(), "toy.scxml")
    assert differences(lowered_machine(machine, "toy.scxml", {"x": integer(0, 9)}), ("", *events)) == ""
    runner = MachineRunner(machine)
    for event in ("", *events):
        runner.step(event)
    return runner


@pytest.mark.parametrize(
    ("seed", "steps", "active"),
    [
        (258, 10, "s1"),
        # two regions want to leave everything: the first in the document does, though entered last
        (274, 4, "s3 s4 s5 s11"),
    ],
)
def test_transitions_are_chosen_in_document_order(seed: int, steps: int, active: str) -> None:
    machine = machine_of(random_machine(seed, timed=False).encode(), "random.scxml")
    runner = MachineRunner(machine)
    for event in ["", *filter(None, inputs(machine.offered, Random(seed), 15))][:steps]:
        runner.step(event)
    assert {one.id for one in runner.active} == set(active.split())


def test_a_state_that_a_history_enters_again_is_active_once() -> None:
    inner = (
        f"<state id='in'><onentry>{COUNT.format(1)}</onentry><state id='a'><transition event='b' target='b'/>"
        "</state><state id='b'><transition event='back' target='h'/></state></state>"
    )
    text = counted(
        f"<state id='p'><history id='h' type='deep'><transition target='a'/></history>{inner}"
        "<transition event='off' target='out'/></state>"
        "<state id='out'><transition event='on' target='h'/></state>"
    )
    again = ran(text, "off", "on", "b", "back")  # from b to a, which leaves b only, and enters in
    assert [one.id for one in again.active].count("in") == 1 and again.data["x"] == 3
    assert {one.id for one in ran(text, "off", "on", "b", "back", "off").active} == {"out"}


def test_of_two_histories_without_a_past_the_content_of_the_last_is_executed() -> None:
    histories = "".join(
        f"<history id='{one}'><transition target='{region}'>{COUNT.format(number)}</transition></history>"
        for one, region, number in (("h", "a", 1), ("g", "b", 2))
    )
    text = counted(
        "<state id='z'><transition event='go' target='h g'/></state>"
        f"<parallel id='p'>{histories}<state id='a'/><state id='b'/></parallel>"
    )
    assert ran(text, "go").data == {"x": 2}


@pytest.mark.parametrize(
    ("expr", "value"),
    [
        ("9 + (x - 5) % 3", 7),  # a remainder has the sign of what is divided
        ("9 + Math.floor((x - 7) / 4)", 7),  # rounded down
        ("(x + 7) % 4", 3),
        ("Math.floor(x * 2 / 3) % 2", 0),
        ("Math.min(Math.max(x - 3, 2), Math.abs(x - 5))", 2),
    ],
)
def test_functions_and_divisions_that_are_exact(expr: str, value: int) -> None:
    text = counted(
        f"<state id='a'><transition event='e'><assign location='x' expr='{expr}'/></transition></state>"
    )
    assert ran(text, "e").data == {"x": value}


def test_lint_does_not_miss_a_way_out_of_a_final_state(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "end.scxml"
    inside = "<state id='a'><transition event='e' target='b'/><transition event='f' target='trap'/></state>"
    file.write_text(f"<scxml {SPACE}>{inside}<final id='b'/><state id='trap'/></scxml>", encoding="utf-8")
    run(["lint", "--model", str(file)])
    said = " ".join(capsys.readouterr().out.split())
    assert "state trap is never left" in said and "state b is never left" not in said
