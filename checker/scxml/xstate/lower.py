"""A machine of XState as the program of its step."""

from collections.abc import Sequence
from functools import partial

from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.scxml.lower import MachineWriter
from rovercheck.checker.scxml.records import (
    MOST_MICROSTEPS,
    MachineState,
    MachineTransition,
    SendEvent,
    StateMachine,
)
from rovercheck.checker.scxml.view import NONE, MachineView
from rovercheck.checker.scxml.xstate.plan import xstate_domain_of, xstate_plan_of
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var, all_of, any_of


class XstateWriter(MachineWriter):
    """Writes the step of one machine of XState."""

    domain_of = staticmethod(xstate_domain_of)
    plan_of = staticmethod(xstate_plan_of)

    def __init__(
        self, machine: StateMachine, view: MachineView, data: dict[str, Var], writer: ProgramWriter
    ) -> None:
        super().__init__(machine, view, data, writer)
        temporary = writer.temporary
        self.eventless = [one for one in self.transitions if not one.events]
        self.may = temporary("asks eventless", boolean)
        self.quiet = temporary("takes eventless", boolean)
        self.changed = temporary("changes data", boolean)
        self.moved = temporary("changes states", boolean)
        self.picked = {t: temporary(f"picks {t.source.id} {t.order} ", boolean) for t in self.transitions}
        self.picks = {s: temporary(f"picks in {s.id} ", boolean) for s in self.entered}
        self.due = {
            one.number: temporary(f"due {one.number} ", boolean) for one in machine.sends if one.delay
        }
        self.begins_now = False

    def _live(self, event: Var, begun: Var) -> None:
        for due in self.due.values():
            self.writer.assign(due, FALSE)
        if self.eventless:
            self.writer.assign(self.may, ~begun)
        super()._live(event, begun)

    def _begin(self) -> None:
        self.begins_now = True
        super()._begin()
        self.begins_now = False

    # --- time ----------------------------------------------------------------------------------------------

    def _elapse(self, sent: SendEvent) -> None:
        timer = self.timers[sent.number]
        self.writer.choose(timer == 1, partial(self.writer.assign, self.due[sent.number], TRUE))
        self.writer.assign(timer, timer - 1)

    def cancel(self, sent: SendEvent) -> None:
        """What is delayed does not come, also if it is due already."""
        super().cancel(sent)
        self.writer.assign(self.due[sent.number], FALSE)

    # --- a turn --------------------------------------------------------------------------------------------

    def _turn(self) -> None:
        writer = self.writer
        writer.assign(self.go, FALSE)
        writer.assign(self.event, self._no_event())
        for var in self.kept.values():
            writer.assign(var, FALSE)
        if self.eventless:
            writer.assign(self.changed, FALSE)
            writer.assign(self.moved, FALSE)
            writer.choose(self.may, partial(self._select, self.eventless))
            writer.assign(self.quiet, any_of(*(self.kept[one] for one in self.eventless)))
            writer.choose(self.quiet, self._goes_on, self._take_event)
        else:
            self._take_event()
        writer.choose(any_of(FALSE, *self.kept.values()), self._microstep)
        if self.eventless:
            again = partial(writer.assign, self.may, self._again())
            writer.choose(self.quiet, again)
        writer.choose(self.ended, partial(writer.assign, self.go, FALSE))

    def _again(self) -> Expr:
        """Whether eventless transitions are asked again after one of them."""
        return any_of(self.changed, self.moved)

    def _take_event(self) -> None:
        chosen = self._take_due(list(self.machine.sends))
        for queue in (self.external, self.internal):
            chosen = partial(self.writer.choose, queue[0] != NONE, partial(self._pop, queue), chosen)
        chosen()
        self.writer.choose(self.go, self._answer)

    def _take_due(self, sends: Sequence[SendEvent]) -> "partial[None]":
        chosen = partial(self._nothing)
        for sent in reversed([one for one in sends if one.delay]):
            chosen = partial(self.writer.choose, self.due[sent.number], partial(self._fire, sent), chosen)
        return chosen

    def _nothing(self) -> None:
        """There is no event."""

    def _fire(self, sent: SendEvent) -> None:
        self.writer.assign(self.due[sent.number], FALSE)
        if sent.event in self.view.event_names:
            self.writer.assign(self.event, Const(self.view.events.raw(sent.event), self.event.sort))
        self._goes_on()

    def _answer(self) -> None:
        super()._answer()
        if self.eventless:
            self.writer.assign(self.may, TRUE)

    @property
    def _answers_itself(self) -> bool:
        delays = {one.event for one in self.machine.sends if one.delay}
        return bool(self.eventless) or any(one not in delays for one in self.machine.internal)

    def _refuse_unsettled(self) -> None:
        eventless = [all_of(self.may, self._condition(one)) for one in self.eventless]
        busy = any_of(self.internal[0] != NONE, self.external[0] != NONE, *self.due.values(), *eventless)
        self.writer.choose(
            busy, lambda: self.writer.fault(f"a step needs more than {MOST_MICROSTEPS} microsteps")
        )

    # --- which transitions ---------------------------------------------------------------------------------

    def asks(self, descriptor: str, event: str) -> bool:
        """Whether a descriptor matches the name of an event: itself, ``*``, or ``a.*``."""
        stem = descriptor.removesuffix(".*")
        if stem != descriptor:
            return event == stem or event.startswith(f"{stem}.")
        return descriptor in ("*", event)

    def _select(self, wanted: Sequence[MachineTransition]) -> None:
        if not wanted or not self._hierarchical(wanted):
            super()._select(wanted)
            return
        writer = self.writer
        enabled = {one: writer.temporary("enabled", boolean) for one in wanted}
        for one, var in enabled.items():
            writer.assign(var, self._condition(one))
            writer.assign(self.tried[one], FALSE)
        for state in reversed(list(self.picks)):
            below = any_of(FALSE, *(self.picks[child] for child in state.children))
            own = [one for one in state.transitions if one in enabled]
            for place, one in enumerate(own):
                before = [~enabled[other] for other in own[:place]]
                writer.assign(self.picked[one], all_of(enabled[one], ~below, *before))
            writer.assign(self.picks[state], any_of(below, *(enabled[one] for one in own)))
        for one in wanted:
            self._insert(one, self.picked[one], wanted)

    def _hierarchical(self, wanted: Sequence[MachineTransition]) -> bool:
        """Whether what is around a state with a transition is not asked."""
        return bool(wanted[0].events)

    def _clash(self, one: MachineTransition, other: MachineTransition) -> Expr:
        """Whether two transitions leave the same state: something is in both domains."""
        found = []
        for left, a in self.domains.get(one, ()):
            for right, b in self.domains.get(other, ()):
                if a is None or b is None:
                    continue
                inner = a if a is b or a.is_in(b) else b if b.is_in(a) else None
                if inner is not None and inner.children:
                    found.append(all_of(left, right))
        return any_of(FALSE, *found)

    # --- a microstep ---------------------------------------------------------------------------------------

    def set_datum(self, name: str, value: Expr) -> None:
        """Give a datum a value, and remember that one was given."""
        super().set_datum(name, value)
        if self.eventless:
            self.writer.assign(self.changed, TRUE)

    def _contents(self) -> None:
        for one in self.transitions:
            if one.actions:
                self.writer.choose(self.kept[one], partial(self.run, one.actions))

    def _enter(self) -> None:
        if self.eventless and not self.begins_now:
            found = [
                all_of(self.leaves[s], ~self.entered[s])
                | all_of(self.entered[s], ~self.active[s], ~self.leaves[s])
                for s in self.entered
            ]  # fmt: skip
            found += [self.leaves[s] for s in self.leaves if s.histories]
            self.writer.assign(self.moved, any_of(*found))
        super()._enter()

    def _complete(self, state: MachineState) -> None:
        parent = state.parent
        assert parent is not None and parent.parent is not None
        if parent.kind == "state":
            self._push(self.internal, f"{self.machine.done}{parent.known_as}")
        around, every = parent if parent.kind == "parallel" else parent.parent, all_of()
        while around.kind == "parallel":
            every = all_of(every, self._is_final(around))
            self.writer.choose(
                every, partial(self._push, self.internal, f"{self.machine.done}{around.known_as}")
            )
            assert around.parent is not None
            around = around.parent

    def _is_final(self, state: MachineState) -> Expr:
        if state.kind == "final":
            return self.active[state]
        return super()._is_final(state)

    @property
    def ended(self) -> Expr:
        """Whether the machine is done."""
        return self._is_final(self.machine.root.children[0])


__all__ = ["XstateWriter"]
