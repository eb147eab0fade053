"""A machine as a system: its event an input, its data in their domains."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.drawn.lower.program import ProgramWriter, TooManyStatements
from rovercheck.checker.scxml.lower import MachineWriter
from rovercheck.checker.scxml.records import (
    AssignDatum,
    Choose,
    Constant,
    Executable,
    ScxmlExpression,
    StateMachine,
)
from rovercheck.checker.scxml.view import NONE, MachineView
from rovercheck.checker.scxml.xstate.lower import XstateWriter
from rovercheck.checker.scxml.xstate.lower_4 import Xstate4Writer
from rovercheck.spec_model.lang.domain import Domain, boolean, chosen, enumeration
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.programmed import StepProgram
from rovercheck.spec_model.lang.system import System, in_order

_WRITERS = {("scxml", 5): MachineWriter, ("xstate", 5): XstateWriter, ("xstate", 4): Xstate4Writer}


@dataclass(frozen=True)
class LoweredMachine:
    """A machine as a system.  ``event`` is its input, ``data`` its data by name.

    ``guards`` are inputs, and ``ran`` flags of the last step, of what is known by name only.
    """

    machine: StateMachine
    system: System
    event: Var
    data: Mapping[str, Var]
    view: MachineView
    guards: Mapping[str, Var]
    ran: Mapping[str, Var]


def lowered_machine(machine: StateMachine, file: str, domains: Mapping[str, Domain]) -> LoweredMachine:
    """The system of a machine.  Raises ``ModelError`` for data without a domain, and too long a step."""
    data = {name: _datum(machine, name, first, domains) for name, first in machine.data.items()}
    view, writer = MachineView(machine, file), ProgramWriter(machine.name)
    event = Var("event", enumeration("Event", [NONE, *machine.offered]), 0, "the event of a step, or none")
    written = _WRITERS[machine.rules, machine.version](machine, view, data, writer)
    try:
        statements = written.step(event)
    except TooManyStatements as error:
        raise ModelError(f"{error}.") from error
    program = StepProgram(statements, tuple(writer.temporaries.values()), fired=dict(view.fired))
    system = in_order(
        machine.name, view.made(program), text=f"The machine {machine.name}, read from {file}.",
        notes=[*_notes(machine), *machine.notes], tick_ms=machine.tick or 1,
    )  # fmt: skip
    return LoweredMachine(machine, system, event, data, view, written.guards, written.ran)


def _notes(machine: StateMachine) -> Iterator[str]:
    if machine.tick:
        yield (
            f"A step without an event lets {machine.tick} ms pass; steps with an event take no time, and are "
            "counted all the same where a length of time is told."
        )
    own = sorted({one.event for one in machine.sends} | set(machine.internal))
    own = [one for one in own if not one.startswith(("done.", "xstate."))]
    if own:
        yield f"Events that the machine sends itself come from nowhere else: {', '.join(own)}."


def _datum(machine: StateMachine, name: str, first: bool | int, domains: Mapping[str, Domain]) -> Var:
    domain = domains.get(name) or _domain(machine, name, first)
    return Var(name, domain, domain.raw(first), f"datum of {machine.name}")


def _domain(machine: StateMachine, name: str, first: bool | int) -> Domain:
    if isinstance(first, bool):
        return boolean
    values = {first}
    for one in every_action(machine):
        if isinstance(one, AssignDatum) and one.name == name:
            if not isinstance(one.value, Constant):
                raise ModelError(
                    f"no domain is given for {name}, which is computed. Write {name} = {{ low = 0, high = 9 "
                    "} below [domains] in the file NAME.domains.toml beside the machine"
                )
            values.add(int(one.value.value))
    return chosen(values)


def every_action(machine: StateMachine) -> Iterator[Executable]:
    """All actions of a machine."""
    for state in (machine.root, *machine.states):
        for handler in (*state.on_entry, *state.on_exit):
            yield from _each(handler)
        for one in (*state.transitions, *([state.initial] if state.initial else [])):
            yield from _each(one.actions)


def every_condition(machine: StateMachine) -> Iterator[ScxmlExpression]:
    """All conditions of a machine, of transitions and of branches."""
    for state in machine.states:
        yield from (one.condition for one in state.transitions if one.condition is not None)
    for action in every_action(machine):
        if isinstance(action, Choose):
            yield from (condition for condition, _ in action.branches if condition is not None)


def _each(actions: Sequence[Executable]) -> Iterator[Executable]:
    for one in actions:
        yield one
        if isinstance(one, Choose):
            for _, inner in one.branches:
                yield from _each(inner)


__all__ = ["LoweredMachine", "every_action", "every_condition", "lowered_machine"]
