"""The inputs of a system for values that are free, one for each time that a step computes such a value."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from rovercheck.checker.drawn.free import numbered
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Component, Enabled
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.programmed import ProgrammedBlock, ProgrammedChart
from rovercheck.spec_model.lang.system import Note, Program

Counts = Mapping[str, int]


@dataclass
class FreeInputs:
    """Gives each computation of a free value an input of its own.

    Values that no step computes both of, as on the two sides of a choice, share one.  ``values`` are the
    variables that stand for what is free, by name; each is read only where it is assigned, alone.
    ``made`` are all inputs, by name, with the name of what each is a value of.
    """

    values: Mapping[str, Var]
    made: dict[str, tuple[Var, str]] = field(default_factory=dict)
    _counts: Counts = field(default_factory=dict)

    def components(self, components: Iterable[Component]) -> tuple[Component, ...]:
        """Components in the order in which they are executed, with inputs of their own."""
        return tuple(map(self._component, components)) if self.values else tuple(components)

    def _component(self, one: Component) -> Component:
        match one:
            case Enabled():
                inside = self.components(one.components)
                return Enabled(one.by, *inside, name=one.name, place=one.place)
            case ProgrammedBlock():
                return one.with_marked(self._statements(one.marked))
            case Block():
                do = self._all(one.do)
                return Block(one.name, do, text=one.text, temporaries=one.temporaries, place=one.place)
            case ProgrammedChart():
                made = self._statements(one.program.statements)
                return one.with_program(replace(one.program, statements=made))
        return one

    def _statements(self, statements: Program) -> Program:
        return tuple(a for a in self._all(statements) if isinstance(a, Assign | If))

    def _all(self, actions: Sequence[Action]) -> tuple[Action, ...]:
        made, self._counts = self._numbered(actions, self._counts)
        return made

    def _numbered(self, actions: Sequence[Action], counts: Counts) -> tuple[tuple[Action, ...], Counts]:
        made: list[Action] = []
        for one in actions:
            if isinstance(one, If):
                then, first = self._numbered(one.then, counts)
                otherwise, second = self._numbered(one.otherwise, counts)
                counts = {name: max(first.get(name, 0), second.get(name, 0)) for name in {*first, *second}}
                one = replace(one, then=then, otherwise=otherwise)
            elif isinstance(one, Assign) and isinstance(one.value, Var) and one.value.name in self.values:
                name = one.value.name
                counts = {**counts, name: counts.get(name, 0) + 1}
                own = numbered(name, counts[name])
                self.made[own] = replace(self.values[name], name=own), name
                one = Assign(one.var, self.made[own][0])
            made.append(one)
        return tuple(made), counts


def free_note(name: str) -> Note:
    """What is to be known of a value that is free."""
    return Note(
        f"{name} is a free input: wherever it is computed it has any value of its domain, whatever it is "
        "computed from. A proof holds for each of these; a run may have one that the model does not give.",
        brief=f"for all values of {name}",
        of_runs=f"{name} may have a value that the model does not give",
    )


__all__ = ["FreeInputs", "free_note"]
