"""What steps of 19 to 21 ms break in the model, they break in the executable supervisors too."""

from collections.abc import Mapping

import pytest

from rovercheck.checker.adapters.firmware import places
from rovercheck.checker.adapters.python_calls import Instance
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.compare.beside import differs, rerun
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.abstraction.board import in_steps_of
from rovercheck.spec_model.abstraction.signals import units
from rovercheck.spec_model.rover import systems
from tests.logs.recorded import FIRMWARE

SHOWN: Mapping[str, tuple[str, str, str]] = {
    "PB1-43d": ("board1", "rx_status", "rx_status"),
    "PB1-44a": ("board1", "give_b2_actuation", "give_b2_actuation"),
    "PB1-46a": ("board1", "current_action", "current_action"),
    "PB2-58a": ("board2", "autorized_to_send_command", "autorized_to_send_command"),
    "PB2-59a": ("board2", "B2.current_action", "current_action"),
    "PB2-60i": ("board2", "B2.rx_status", "rx_status"),
    "PB2-60k": ("board2", "b1_sup_status", "b1_sup_status"),
    "PB2-60m": ("board2", "B2.rx_status", "rx_status"),
    "PB2-61a": ("board2", "B2Decision", "B2Dec"),
    "PB2-61c": ("board2", "B2Decision", "B2Dec"),
}
"""By the violated property: the board, and what shows the violation in the model and in its supervisor."""


def test_every_violation_by_jitter_is_replayed() -> None:
    jittered = [p for p in catalogue().values() if systems()[p.on].elapsed is not None]
    assert {p.id for p in jittered if expected(p.id).verdict == "violated"} == set(SHOWN)


def run_of(id: str) -> Trace:
    (result,) = results([catalogue()[id]], systems())
    assert isinstance(result.verdict, Violated)
    assert isinstance(result.verdict.because, Trace)
    return result.verdict.because


def given(board: Board, trace: Trace) -> list[Mapping[str, bool | int | float]]:
    """The measurements and stamps of the run, step by step."""
    system = systems()[trace.system.name]
    return list(board.run(in_steps_of(board, system, {**t.inputs, **t.after}) for t in trace.ticks))


@pytest.mark.parametrize("id", SHOWN)
def test_a_violation_by_jitter_is_one_of_the_supervisor(id: str) -> None:
    name, in_model, in_supervisor = SHOWN[id]
    board, trace = boards()[name], run_of(id)
    inputs = given(board, trace)
    assert [int(i["now_ms"]) for i in inputs] == list(trace.ends)
    firmware = Instance(FIRMWARE[name], places(board))
    did = [firmware.step(one) for one in inputs]
    required = [step.expected for step in rerun(board, inputs)]
    assert not any(differs(one, other, set()) for one, other in zip(required, did, strict=True))
    domain = trace.system.variables[in_model].domain
    shown = [units(domain, tick.after[in_model]) for tick in trace.ticks]
    assert [one[in_supervisor] for one in did] == shown
