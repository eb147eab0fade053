"""Executable content of a machine as statements."""

from collections.abc import Sequence
from functools import partial

from rovercheck.checker.scxml.formulas import FormulaWriter
from rovercheck.checker.scxml.records import (
    MOST_WAITING,
    AssignDatum,
    CancelEvent,
    Choose,
    Executable,
    NamedAction,
    RaiseEvent,
    ScxmlExpression,
    SendEvent,
)
from rovercheck.checker.scxml.view import NONE
from rovercheck.spec_model.lang.expr import TRUE, Const, Expr, Var


class ActionWriter(FormulaWriter):
    """Writes what a machine does: events into queues, data, delays."""

    internal: Sequence[Var]
    """The queue of events that a machine raises, the first in front."""
    external: Sequence[Var]
    """That of events from outside, and of those that it sends."""

    def _handlers(self, handlers: Sequence[Sequence[Executable]]) -> None:
        for one in handlers:
            self.run(one)

    def run(self, actions: Sequence[Executable]) -> None:
        """Write actions one after the other."""
        for one in actions:
            match one:
                case RaiseEvent(event):
                    self._push(self.internal, event)
                case SendEvent(delay=0):
                    self._push(self.external, one.event)
                case SendEvent():
                    self._send(one)
                case CancelEvent(id):
                    for sent in self.machine.sends:
                        if sent.id == id and sent.delay:
                            self.cancel(sent)
                case NamedAction(name):
                    self.writer.assign(self.ran[name], TRUE)
                case AssignDatum(name, value):
                    self.set_datum(name, self.formula(value))
                case Choose(branches):
                    self._branches(branches)

    def cancel(self, sent: SendEvent) -> None:
        """What is delayed does not come."""
        timer = self.timers[sent.number]
        self.writer.assign(timer, Const(0, timer.sort))

    def set_datum(self, name: str, value: Expr) -> None:
        """Give a datum a value."""
        self.writer.assign(self.data[name], value)

    def _branches(self, branches: Sequence[tuple[ScxmlExpression | None, tuple[Executable, ...]]]) -> None:
        if branches:
            (condition, actions), *others = branches
            when = TRUE if condition is None else self.formula(condition)
            self.writer.choose(when, partial(self.run, actions), partial(self._branches, others))

    def _send(self, one: SendEvent) -> None:
        timer = self.timers[one.number]
        again = f"{one.event} is sent again (line {one.line}) before its delay is over"
        self.writer.choose(timer > 0, partial(self.writer.fault, again))
        self.writer.assign(timer, Const(one.delay // self.machine.tick, timer.sort))

    def _push(self, queue: Sequence[Var], event: str) -> None:
        if event not in self.view.event_names:
            return
        if not queue:
            self.writer.fault(f"more than {MOST_WAITING} events wait at once")
            return
        first, *others = queue
        value = Const(self.view.events.raw(event), first.sort)
        self.writer.choose(
            first == NONE, partial(self.writer.assign, first, value), partial(self._push, others, event)
        )

    def _no_event(self) -> Const:
        return Const(0, self.view.events.sort)


__all__ = ["ActionWriter"]
