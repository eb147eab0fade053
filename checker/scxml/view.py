"""A machine as a chart that a person sees: its states, which are active, its events, what history keeps."""

import re
from collections.abc import Mapping

from rovercheck.checker.scxml.past import PastVariables
from rovercheck.checker.scxml.records import MachineState, MachineTransition, StateMachine
from rovercheck.spec_model.lang.chart import Path, State
from rovercheck.spec_model.lang.domain import Domain, boolean, enumeration
from rovercheck.spec_model.lang.expr import Const, Expr, Var
from rovercheck.spec_model.lang.fired_transition import FiredTransition
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.programmed import ProgrammedChart, StepProgram
from rovercheck.spec_model.lang.stateflow.message import LabelText
from rovercheck.spec_model.lang.transition import Transition

NONE = "none"
"""The value of an event where there is none."""


class MachineView:
    """The names and variables of what is in a machine."""

    def __init__(self, machine: StateMachine, file: str, carried: Mapping[str, Var]) -> None:
        self.machine, self._file, self.carried = machine, file, carried
        self.paths: dict[MachineState, Path] = {machine.root: ()}
        used: set[str] = set()
        for one in machine.states:
            name = re.sub(r"\W+", "_", one.id)
            name = name if name not in used else f"{name}_{one.number}"
            used.add(name)
            assert one.parent is not None
            self.paths[one] = (*self.paths[one.parent], name)
        self._chart = self.made(StepProgram(()))
        self.entered = self._chart.entered
        levels = [machine.root, *(one for one in machine.states if one.compound)]
        self.places = {one: self._chart.location(self.paths[one]) for one in levels}
        self.event_names = [*machine.offered, *machine.internal]
        self.events: Domain = enumeration(f"events of {machine.name}", [NONE, *self.event_names])
        self.fired: dict[str, FiredTransition] = {}
        self.begun: dict[MachineState, Var] = {}
        self.past: dict[MachineState, dict[MachineState, Var]] = {}
        for one in machine.states:
            if one.kind == "history":
                self._history(one)
        self.pasts = PastVariables(
            self._never, lambda h, level, child: self._is(self.past[h][level], level, child)
        )

    def _history(self, one: MachineState) -> None:
        assert one.parent is not None
        name = f"{self.machine.name}.{one.id}"
        self.begun[one] = Var(f"{name} has a past", boolean, 0, f"whether {one.id} has a past", hidden=True)
        own = [one.parent]
        if one.deep:
            own += [s for s in self.machine.states if s.is_in(one.parent)]
        self.past[one] = {}
        for level in own:
            if level.compound or level is self.machine.root:
                domain = enumeration(
                    f"past of {level.id} in {one.id}", ["-", *(c.id for c in level.children)]
                )
                said = f"what {one.id} remembers of {level.id}"
                self.past[one][level] = Var(f"{name} of {level.id or 'all'}", domain, 0, said)

    def _never(self, one: MachineState) -> Expr:
        return ~self.begun[one]

    @staticmethod
    def _is(var: Var, level: MachineState, child: MachineState) -> Expr:
        return var == Const(level.children.index(child) + 1, var.sort)

    def was_active(self, state: MachineState) -> Expr:
        """Whether a state is active between steps."""
        while state.parent is not None and state.parent.kind == "parallel":
            state = state.parent
        assert state.parent is not None
        return self._is(self.places[state.parent], state.parent, state)

    # --- what fires ----------------------------------------------------------------------------------------

    def marker(self, one: MachineTransition) -> Var:
        """A variable that is assigned where a transition is taken."""
        name = f"{self.machine.name}.fired {one.source.id} {one.order}"
        target = one.targets[0] if one.targets else one.source
        seen = target.parent if target.kind == "history" and target.parent is not None else target
        self.fired[name] = FiredTransition(
            self.machine.name, self.paths[one.source], self.paths[seen], label_of(one), one.order, None,
            self._place(one.line),
        )  # fmt: skip
        return Var(name, boolean, 0, hidden=True)

    def _place(self, line: int) -> Place:
        return Place(self._file, max(1, line))

    def made(self, program: StepProgram) -> ProgrammedChart:
        """The chart with its program."""
        root = self.machine.root
        return ProgrammedChart(
            self.machine.name, [self._state(one) for one in root.children], program,
            default=self._default(root), text=f"The machine {self.machine.name}.",
            place=self._place(root.line),
            final=[self.paths[one] for one in self.machine.states if one.kind == "final"],
            waits=self.machine.tick > 0,
        )  # fmt: skip

    def _default(self, state: MachineState) -> list[Transition]:
        if state.initial is None:
            return []
        return [Transition(self._name(state.initial.targets[0]), place=self._place(state.line))]

    def _state(self, state: MachineState) -> State:
        return State(
            self.paths[state][-1], states=[self._state(one) for one in state.children],
            transitions=[self._transition(one) for one in state.transitions],
            parallel=state.kind == "parallel", default=self._default(state), place=self._place(state.line),
        )  # fmt: skip

    def _transition(self, one: MachineTransition) -> Transition:
        text = label_of(one)
        target = one.targets[0] if one.targets else one.source
        return Transition(
            self._name(target), label=LabelText(text) if text else None, place=self._place(one.line)
        )

    def _name(self, target: MachineState) -> str:
        seen = target.parent if target.kind == "history" and target.parent is not None else target
        return ".".join(self.paths[seen])


def label_of(one: MachineTransition) -> str:
    """A transition in one line, as Stateflow would label it."""
    parts = [" ".join(one.events)]
    parts += [f"[{one.written_condition}]"] if one.written_condition else []
    parts += ["(targetless)"] if not one.targets else []
    parts += [f"(also to {', '.join(s.id for s in one.targets[1:])})"] if one.targets[1:] else []
    return " ".join(filter(None, parts))


__all__ = ["NONE", "MachineView", "label_of"]
