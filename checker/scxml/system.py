"""A machine as a system: its event an input, its data in their domains."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rovercheck.checker.drawn.lower.program import ProgramWriter, TooManyStatements
from rovercheck.checker.scxml.lower import MachineWriter
from rovercheck.checker.scxml.records import AssignDatum, Constant, StateMachine, carried_name
from rovercheck.checker.scxml.view import NONE, MachineView
from rovercheck.checker.scxml.walk import every_action
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

    ``carried`` are inputs, what the event carries; ``guards`` are inputs, and ``ran`` flags of the last step,
    of what is known by name only.
    """

    machine: StateMachine
    system: System
    event: Var
    data: Mapping[str, Var]
    carried: Mapping[str, Var]
    view: MachineView
    guards: Mapping[str, Var]
    ran: Mapping[str, Var]


def lowered_machine(machine: StateMachine, file: str, domains: Mapping[str, Domain]) -> LoweredMachine:
    """The system of a machine.  Raises ``ModelError`` for data without a domain, and too long a step."""
    data = {name: _datum(machine, name, first, domains) for name, first in machine.data.items()}
    carried = {name: _carried(machine, name, domains) for name in machine.carried}
    view, writer = MachineView(machine, file, carried), ProgramWriter(machine.name)
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
    return LoweredMachine(machine, system, event, data, carried, view, written.guards, written.ran)


def _notes(machine: StateMachine) -> Iterator[str]:
    if machine.tick:
        yield (
            f"A step without an event lets {machine.tick} ms pass; steps with an event take no time, and are "
            "counted all the same where a length of time is told."
        )
    if machine.carried:
        yield f"Each event from outside carries {', '.join(machine.carried)} where that is read."
    own = sorted({one.event for one in machine.sends} | set(machine.internal))
    own = [one for one in own if not one.startswith(("done.", "xstate."))]
    if own:
        yield f"Events that the machine sends itself come from nowhere else: {', '.join(own)}."


def _datum(machine: StateMachine, name: str, first: bool | int, domains: Mapping[str, Domain]) -> Var:
    domain = domains.get(name) or _domain(machine, name, first)
    return Var(name, domain, domain.raw(first), f"datum of {machine.name}")


def _carried(machine: StateMachine, name: str, domains: Mapping[str, Domain]) -> Var:
    own, said = carried_name(name), f"what the event of a step carries as {name}"
    if machine.carried[name] == "boolean":
        return Var(own, boolean, 0, said)
    if own not in domains:
        raise ModelError(
            f'no domain is given for {own}, which events carry. Write "{own}" = {{ low = 0, high = 9 }} '
            "below [domains] in the file NAME.domains.toml beside the machine"
        )
    return Var(own, domains[own], domains[own].low, said)


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


__all__ = ["LoweredMachine", "lowered_machine"]
