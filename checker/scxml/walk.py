"""What stands in a machine: its actions, its conditions, and what they read of events."""

from collections.abc import Iterator, Sequence

from rovercheck.checker.scxml.records import (
    AssignDatum,
    Choose,
    EventDatum,
    Executable,
    Operation,
    ScxmlExpression,
    StateMachine,
)


def every_action(machine: StateMachine) -> Iterator[Executable]:
    """All actions of a machine."""
    for state in (machine.root, *machine.states):
        for handler in (*state.on_entry, *state.on_exit):
            yield from each_action(handler)
        for one in (*state.transitions, *([state.initial] if state.initial else [])):
            yield from each_action(one.actions)


def every_condition(machine: StateMachine) -> Iterator[ScxmlExpression]:
    """All conditions of a machine, of transitions and of branches."""
    for state in machine.states:
        yield from (one.condition for one in state.transitions if one.condition is not None)
    for action in every_action(machine):
        if isinstance(action, Choose):
            yield from (condition for condition, _ in action.branches if condition is not None)


def each_action(actions: Sequence[Executable]) -> Iterator[Executable]:
    """Actions, and those of their branches."""
    for one in actions:
        yield one
        if isinstance(one, Choose):
            for _, inner in one.branches:
                yield from each_action(inner)


def event_data(actions: Sequence[Executable], *conditions: ScxmlExpression | None) -> Iterator[EventDatum]:
    """What actions and conditions read of the event of a step."""
    for condition in conditions:
        if condition is not None:
            yield from _read(condition)
    for one in each_action(actions):
        match one:
            case AssignDatum(_, value):
                yield from _read(value)
            case Choose(branches):
                yield from event_data((), *(condition for condition, _ in branches))


def _read(expression: ScxmlExpression) -> Iterator[EventDatum]:
    match expression:
        case EventDatum():
            yield expression
        case Operation(_, operands):
            for one in operands:
                yield from _read(one)


__all__ = ["each_action", "event_data", "every_action", "every_condition"]
