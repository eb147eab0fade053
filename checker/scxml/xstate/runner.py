"""The interpreter of a machine, by the rules that it is written for."""

from rovercheck.checker.scxml.interpret import MachineRunner
from rovercheck.checker.scxml.records import StateMachine
from rovercheck.checker.scxml.xstate.interpret import XstateRunner
from rovercheck.checker.scxml.xstate.interpret_4 import Xstate4Runner


def runner_of(machine: StateMachine) -> MachineRunner:
    """A machine before its first step."""
    if machine.rules == "scxml":
        return MachineRunner(machine)
    return XstateRunner(machine) if machine.version == 5 else Xstate4Runner(machine)


__all__ = ["runner_of"]
