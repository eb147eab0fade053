"""``import --json`` of a machine of SCXML or XState (``checker/schemas/import-machine-1.json``)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from typing_extensions import TypedDict

from rovercheck.checker.results.exit_code import Exit
from rovercheck.checker.scxml.records import (
    MachineState,
    MachineTransition,
    StateKind,
    StateMachine,
    ValueKind,
)


@dataclass(frozen=True)
class LoweredMachineReport:
    """Whether a machine can be checked: ``refused`` says why not; ``steps`` are those that were compared."""

    refused: str
    inputs: int = 0
    variables: int = 0
    notes: tuple[str, ...] = ()
    steps: int = 0


class MachineStateRow(TypedDict):
    """A state."""

    id: str
    kind: StateKind
    parent: str | None
    """Null at the top."""
    initial: Sequence[str]
    """Where it begins."""
    line: int


class MachineTransitionRow(TypedDict):
    """A transition, in the order in which those of its source are tried."""

    source: str
    events: Sequence[str]
    """None of an eventless one."""
    condition: str
    targets: Sequence[str]
    internal: bool
    """Whether its source is not left where the targets are in it."""
    line: int


class MachineDocument(TypedDict):
    """What ``rovercheck import --json`` prints of a machine of SCXML or XState."""

    schema: Literal["rovercheck/import-machine/1"]
    exit: Exit
    name: str
    format: str
    """SCXML, or XState with its version."""
    states: Sequence[MachineStateRow]
    transitions: Sequence[MachineTransitionRow]
    data: Mapping[str, bool | int]
    """First values."""
    events: Sequence[str]
    """From outside."""
    event_data: Mapping[str, ValueKind]
    """What events from outside carry, with their kinds."""
    own_events: Sequence[str]
    """That the machine sends itself."""
    guards: Sequence[str]
    """That are inputs."""
    actions: Sequence[str]
    """Of which is seen that they run."""
    step_ms: int
    """Milliseconds of a step without an event; 0 without delays."""
    refused: str
    """Why it cannot be checked; empty if it can."""
    notes: Sequence[str]
    inputs: int
    variables: int
    """Of the system that it is checked as; 0 if it cannot be checked."""
    steps_compared: int
    """In which its own algorithm and the system gave the same."""


def machine_document(machine: StateMachine, report: LoweredMachineReport, code: Exit) -> dict[str, Any]:
    """A machine as JSON; its fields are those of :class:`MachineDocument`."""
    return {
        "schema": "rovercheck/import-machine/1",
        "exit": code,
        "name": machine.name,
        "format": machine.format,
        "states": [_state(one) for one in machine.states],
        "transitions": [_transition(t) for one in machine.states for t in one.transitions],
        "data": dict(machine.data),
        "events": list(machine.offered),
        "event_data": dict(machine.carried),
        "own_events": list(machine.internal),
        "guards": list(machine.guards),
        "actions": list(machine.actions),
        "step_ms": machine.tick,
        "refused": report.refused,
        "notes": list(report.notes),
        "inputs": report.inputs,
        "variables": report.variables,
        "steps_compared": report.steps,
    }


def _state(one: MachineState) -> MachineStateRow:
    parent = one.parent
    above = None if parent is None or parent.parent is None else parent.id
    begun = [] if one.initial is None else [target.id for target in one.initial.targets]
    return MachineStateRow(id=one.id, kind=one.kind, parent=above, initial=begun, line=one.line)


def _transition(one: MachineTransition) -> MachineTransitionRow:
    return MachineTransitionRow(
        source=one.source.id, events=list(one.events), condition=one.written_condition,
        targets=[target.id for target in one.targets], internal=one.internal, line=one.line,
    )  # fmt: skip


__all__ = ["LoweredMachineReport", "MachineDocument", "machine_document"]
