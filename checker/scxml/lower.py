"""A machine as the program of its step: every turn of the main event loop written out."""

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import pairwise

from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.scxml.actions import ActionWriter
from rovercheck.checker.scxml.past import EntryPlan, domain_of, each_past, plan_of
from rovercheck.checker.scxml.records import (
    MOST_MICROSTEPS,
    MOST_WAITING,
    MachineState,
    MachineTransition,
    SendEvent,
    StateMachine,
    matches,
)
from rovercheck.checker.scxml.view import NONE, MachineView
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var, all_of, any_of
from rovercheck.spec_model.lang.system import Statement


class MachineWriter(ActionWriter):
    """Writes the step of one machine."""

    domain_of = staticmethod(domain_of)
    plan_of = staticmethod(plan_of)

    def __init__(
        self, machine: StateMachine, view: MachineView, data: dict[str, Var], writer: ProgramWriter
    ) -> None:
        super().__init__(machine, view, data, writer)
        temporary = writer.temporary
        self.kept = {t: temporary(f"takes {t.source.id} {t.order} ", boolean) for t in self.transitions}
        self.entered = {
            s: temporary(f"enters {s.id} ", boolean) for s in machine.states if s.kind != "history"
        }
        self.defaults = {s: temporary(f"begins {s.id} ", boolean) for s in machine.states if s.compound}
        self.begins = {s: temporary(f"first {s.id} ", boolean) for s in machine.states if s.kind == "history"}
        self.tried = {t: temporary(f"tries {t.source.id} {t.order} ", boolean) for t in self.transitions}
        self.leaves = {s: temporary(f"leaves {s.id} ", boolean) for s in self.entered}
        self.done = {t: temporary(f"did {t.source.id} {t.order} ", boolean) for t in self.transitions}
        self.chose = {
            (atom, one): temporary(f"{atom.id} takes {one.source.id} {one.order} ", boolean)
            for atom, chain in self._chains(self.transitions) for one in chain
        }  # fmt: skip
        self.domains = {
            t: list(each_past(partial(self.domain_of, t), view.pasts)) for t in self.transitions if t.targets
        }
        self.go = temporary("goes on", boolean)
        self.event = temporary("event", view.events)
        queues = (
            [temporary(name, view.events) for _ in range(MOST_WAITING)] for name in ("internal", "external")
        )
        self.internal, self.external = queues

    @property
    def transitions(self) -> list[MachineTransition]:
        """All transitions, in document order of their sources."""
        return [one for state in self.machine.states if state.kind != "history" for one in state.transitions]

    # --- a step --------------------------------------------------------------------------------------------

    def step(self, event: Var) -> tuple[Statement, ...]:
        """The statements of a step that takes an event."""
        writer, view = self.writer, self.view
        for state, var in self.active.items():
            writer.assign(var, view.was_active(state))
        for one in (*self.internal, *self.external):
            writer.assign(one, self._no_event())
        for datum in self.data.values():  # what nothing else writes is no input
            writer.assign(datum, datum)
        for ran in self.ran.values():
            writer.assign(ran, FALSE)
        ended = writer.temporary("ended", boolean)
        writer.assign(ended, self.ended)
        begun = writer.temporary("begun", boolean)
        writer.assign(begun, view.entered == "yes")
        writer.assign(view.entered, Const(1, view.entered.sort))
        writer.choose(~ended, lambda: self._live(event, begun))
        writer.choose(all_of(self.ended, ~ended), self._leave_all)
        for state, place in view.places.items():
            writer.assign(place, Const(0, place.sort))
            for number, child in enumerate(state.children, start=1):
                writer.choose(self.active[child], partial(writer.assign, place, Const(number, place.sort)))
        return writer.written()

    def _live(self, event: Var, begun: Var) -> None:
        writer = self.writer
        writer.choose(begun, partial(self._pass_time, event), self._begin)
        for name in self.machine.offered:
            writer.choose(event == name, partial(self._push, self.external, name))
        turn = writer.alone(self._turn)
        often = MOST_MICROSTEPS if self._answers_itself else min(MOST_MICROSTEPS, 2 + len(self.machine.sends))
        self._turns(turn, often)

    @property
    def _answers_itself(self) -> bool:
        return bool(self.machine.internal) or any(not one.events for one in self.transitions)

    def _begin(self) -> None:
        initial = self.machine.root.initial
        assert initial is not None
        self._clear_entry()
        self._plans(initial)
        self._enter()

    def _pass_time(self, event: Var) -> None:
        def pass_one() -> None:
            for sent in self.machine.sends:
                if sent.delay:
                    self.writer.choose(self.timers[sent.number] > 0, partial(self._elapse, sent))

        self.writer.choose(event == NONE, pass_one)

    def _elapse(self, sent: SendEvent) -> None:
        timer = self.timers[sent.number]
        self.writer.choose(timer == 1, partial(self._push, self.external, sent.event))
        self.writer.assign(timer, timer - 1)

    def _turns(self, turn: tuple[list[Statement], int], left: int) -> None:
        if not left:
            self._refuse_unsettled()
            return
        self.writer.include(*turn)
        self.writer.choose(self.go, lambda: self._turns(turn, left - 1))

    def _refuse_unsettled(self) -> None:
        eventless = [self._condition(one) for one in self.transitions if not one.events]
        busy = any_of(self.internal[0] != NONE, self.external[0] != NONE, *eventless)
        self.writer.choose(
            busy, lambda: self.writer.fault(f"a step needs more than {MOST_MICROSTEPS} microsteps")
        )

    # --- which transitions ---------------------------------------------------------------------------------

    def _turn(self) -> None:
        writer = self.writer
        writer.assign(self.go, FALSE)
        writer.assign(self.event, self._no_event())
        for var in self.kept.values():
            writer.assign(var, FALSE)
        eventless = [one for one in self.transitions if not one.events]
        if eventless:
            self._select(eventless)
            writer.choose(any_of(*(self.kept[one] for one in eventless)), self._goes_on, self._take_event)
        else:
            self._take_event()
        writer.choose(any_of(*self.kept.values()) if self.kept else FALSE, self._microstep)
        writer.choose(self.ended, partial(writer.assign, self.go, FALSE))

    def _goes_on(self) -> None:
        self.writer.assign(self.go, TRUE)

    def _take_event(self) -> None:
        self.writer.choose(
            self.internal[0] != NONE, partial(self._pop, self.internal),
            lambda: self.writer.choose(self.external[0] != NONE, partial(self._pop, self.external)),
        )  # fmt: skip
        self.writer.choose(self.go, self._answer)

    def _answer(self) -> None:
        self._select([one for one in self.transitions if one.events])

    def _pop(self, queue: Sequence[Var]) -> None:
        self.writer.assign(self.event, queue[0])
        for one, following in pairwise(queue):
            self.writer.assign(one, following)
        self.writer.assign(queue[-1], self._no_event())
        self._goes_on()

    def asks(self, descriptor: str, event: str) -> bool:
        """Whether a descriptor matches the name of an event."""
        return matches(descriptor, event)

    def _condition(self, one: MachineTransition) -> Expr:
        """Whether a transition is enabled by its own source."""
        names = [name for name in self.view.event_names if any(self.asks(d, name) for d in one.events)]
        asked = any_of(*(self.event == name for name in names)) if one.events else TRUE
        guard = TRUE if one.condition is None else self.formula(one.condition)
        return all_of(self.active[one.source], asked, guard)

    def _select(self, wanted: Sequence[MachineTransition]) -> None:
        writer = self.writer
        enabled = {one: writer.temporary("enabled", boolean) for one in wanted}
        for one, var in enabled.items():
            writer.assign(var, self._condition(one))
            writer.assign(self.tried[one], FALSE)
        for atom, chain in self._chains(wanted):
            for place, one in enumerate(chain):
                before = [~enabled[other] for other in chain[:place]]
                chosen = self.chose[atom, one]
                writer.assign(chosen, all_of(self.active[atom], enabled[one], *before))
                self._insert(one, chosen, wanted)

    def _chains(
        self, wanted: Sequence[MachineTransition]
    ) -> Iterator[tuple[MachineState, list[MachineTransition]]]:
        """For each state without children the transitions that it may take, in their order."""
        for atom in self.machine.states:
            if atom.atomic:
                chain = [t for s in (atom, *atom.above()) for t in s.transitions if t in wanted]
                if chain:
                    yield atom, chain

    def _insert(self, one: MachineTransition, chosen: Expr, wanted: Sequence[MachineTransition]) -> None:
        """It is taken, unless one that was chosen before precludes it."""
        writer = self.writer
        rivals = [(other, self._clash(one, other)) for other in wanted if other is not one]
        inner = [(other, clash) for other, clash in rivals if one.source.is_in(other.source)]
        outer = [all_of(self.kept[o], c) for o, c in rivals if not one.source.is_in(o.source)]

        def keep() -> None:
            writer.assign(self.kept[one], TRUE)
            for other, clash in inner:
                writer.choose(clash, partial(writer.assign, self.kept[other], FALSE))

        def choose() -> None:
            writer.assign(self.tried[one], TRUE)
            writer.choose(~any_of(FALSE, *outer), keep)

        writer.choose(all_of(chosen, ~self.tried[one]), choose)

    def _clash(self, one: MachineTransition, other: MachineTransition) -> Expr:
        """Whether two transitions leave the same state: one domain is in the other, or is it."""
        found = [
            all_of(left, right)
            for left, a in self.domains.get(one, ())
            for right, b in self.domains.get(other, ())
            if a is not None and b is not None and (a is b or a.is_in(b) or b.is_in(a))
        ]
        return any_of(FALSE, *found)

    # --- a microstep ---------------------------------------------------------------------------------------

    def _microstep(self) -> None:
        writer = self.writer
        for one, var in self.kept.items():
            marker = self.view.marker(one)
            writer.choose(var, partial(writer.assign, marker, TRUE))
            writer.known.pop(marker.name, None)
        for state, var in self.leaves.items():
            left = [
                all_of(self.kept[one], when)
                for one, cases in self.domains.items() for when, domain in cases
                if domain is not None and state.is_in(domain)
            ]  # fmt: skip
            writer.assign(var, all_of(self.active[state], any_of(FALSE, *left)))
        for state in self.leaves:
            for history in state.histories:
                writer.choose(self.leaves[state], partial(self._remember, history))
        for state in reversed(list(self.leaves)):
            writer.choose(self.leaves[state], partial(self._leave, state))
        self._contents()
        self._clear_entry()
        for one in self.transitions:
            if one.targets:
                writer.choose(self.kept[one], partial(self._plans, one))
        self._enter()

    def _remember(self, history: MachineState) -> None:
        assert history.parent is not None
        writer, flag = self.writer, self.view.begun.get(history)
        if flag is not None:
            writer.assign(flag, TRUE)
        for level, var in self.view.past[history].items():
            writer.assign(var, Const(0, var.sort))
            for number, child in enumerate(level.children, start=1):
                writer.choose(self.active[child], partial(writer.assign, var, Const(number, var.sort)))

    def _leave(self, state: MachineState) -> None:
        self._handlers(state.on_exit)
        self.writer.assign(self.active[state], FALSE)

    def _leave_all(self) -> None:
        for state in reversed(list(self.leaves)):
            self.writer.choose(self.active[state], partial(self._handlers, state.on_exit))
        for timer in self.timers.values():
            self.writer.assign(timer, Const(0, timer.sort))

    def _contents(self) -> None:
        """The content of transitions, in the order in which states without children chose them."""
        for one in self.transitions:
            self.writer.assign(self.done[one], FALSE)
        for atom, chain in self._chains(self.transitions):
            for one in chain:
                if one.actions:
                    due = all_of(self.kept[one], self.chose[atom, one], ~self.done[one])
                    self.writer.choose(due, partial(self._content, one))

    def _content(self, one: MachineTransition) -> None:
        self.writer.assign(self.done[one], TRUE)
        self.run(one.actions)

    # --- entering ------------------------------------------------------------------------------------------

    def _clear_entry(self) -> None:
        for var in (*self.entered.values(), *self.defaults.values(), *self.begins.values()):
            self.writer.assign(var, FALSE)

    def _plans(self, one: MachineTransition) -> None:
        for when, plan in each_past(partial(self.plan_of, one), self.view.pasts):
            self.writer.choose(when, partial(self._plan, plan))

    def _plan(self, plan: EntryPlan) -> None:
        begun = set(plan.begun.values())
        pairs = ((self.entered, plan.states), (self.defaults, plan.defaults), (self.begins, begun))
        for flags, states in pairs:
            for state in sorted(states, key=lambda one: one.number):
                self.writer.assign(flags[state], TRUE)

    def _enter(self) -> None:
        for state in self.entered:
            self.writer.choose(self.entered[state], partial(self._enter_one, state))

    def _enter_one(self, state: MachineState) -> None:
        writer = self.writer
        writer.assign(self.active[state], TRUE)
        self._handlers(state.on_entry)
        if state in self.defaults and state.initial is not None:
            writer.choose(self.defaults[state], partial(self.run, state.initial.actions))
        for history in state.histories:
            if history.initial is not None:
                writer.choose(self.begins[history], partial(self.run, history.initial.actions))
        if state.kind == "final":
            self._complete(state)

    def _complete(self, state: MachineState) -> None:
        """A final state is entered."""
        writer = self.writer
        if state.parent is not None and state.parent.parent is not None:
            self._push(self.internal, f"done.state.{state.parent.id}")
            above = state.parent.parent
            if above.kind == "parallel":
                every = all_of(*(self._is_final(one) for one in above.children))
                writer.choose(every, partial(self._push, self.internal, f"done.state.{above.id}"))

    def _is_final(self, state: MachineState) -> Expr:
        if state.kind == "parallel":
            return all_of(*(self._is_final(one) for one in state.children))
        return any_of(FALSE, *(self.active[one] for one in state.children if one.kind == "final"))

    @property
    def ended(self) -> Expr:
        """Whether the machine has reached a final state of its own."""
        return any_of(FALSE, *(self.active[s] for s in self.machine.root.children if s.kind == "final"))


__all__ = ["MachineWriter"]
