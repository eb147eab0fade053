"""Charts as they are drawn: states in states, junctions, transitions with guards, actions and priorities.

A ``Chart`` is a tree of ``State``s.  A state with ``states`` is composite: exclusive (OR) by
default, parallel (AND) with ``parallel=True``.  Transitions are listed in priority order, first tested
first; a transition ends on a state or on a junction, whose own transitions are again in priority order.
A ``Block`` is a function block: actions run once in every step, with no states.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from rovercheck.spec_model.lang.action import Action, expressions, reads, writes
from rovercheck.spec_model.lang.domain import Domain, Enum, enumeration
from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean, several
from rovercheck.spec_model.lang.expr import Const, Expr, Var, any_of
from rovercheck.spec_model.lang.figure import ChartFigure
from rovercheck.spec_model.lang.place import Place, here
from rovercheck.spec_model.lang.stateflow.message import LabelText, label_text
from rovercheck.spec_model.lang.transition import Default, Junction, Transition, default_of, to
from rovercheck.spec_model.lang.walk import variables

__all__ = [
    "NOWHERE", "Block", "Chart", "Component", "Default", "Enabled", "Junction", "Path", "State", "Transition",
    "parts", "to",
]  # fmt: skip

Path = tuple[str, ...]
"""Names from the chart's outermost level down to a state; the chart itself is the empty path."""

_DEEPEST = 900
"""Levels of states that can be read."""

NOWHERE = "-"
"""The location of an exclusive level none of whose states is active."""


@dataclass(frozen=True)
class State:
    """A state and what is inside it.

    ``default`` is the default transition of an exclusive composite: a state's name, a transition, or
    several transitions in priority order.  Junctions belong to the composite they are drawn in.  ``label`` is
    a text with the actions, ``"entry: x = 1; exit: x = 0"``, until a chart reads it.  ``place`` is where it
    is written, unless given the line that makes it.
    """

    name: str
    entry: tuple[Action, ...]
    during: tuple[Action, ...]
    exit: tuple[Action, ...]
    states: tuple["State", ...]
    transitions: tuple[Transition, ...]
    junctions: tuple[Junction, ...]
    default: Default
    parallel: bool
    label: LabelText | None
    place: Place | None = field(compare=False, repr=False)

    def __init__(
        self,
        name: str,
        label: str | LabelText | None = None,
        *,
        entry: Sequence[Action] = (),
        during: Sequence[Action] = (),
        exit: Sequence[Action] = (),
        states: Sequence["State"] = (),
        transitions: Sequence[Transition] = (),
        junctions: Sequence[Junction] = (),
        default: str | Transition | Sequence[Transition] | None = None,
        parallel: bool = False,
        place: Place | None = None,
    ) -> None:
        place = place or here()
        of = f"State {name!r}"
        lists: dict[str, Sequence[object]] = dict(
            entry=entry, during=during, exit=exit, states=states, transitions=transitions, junctions=junctions
        )
        fields = dict(name=name, default=default_of(of, default, place), parallel=parallel, place=place)
        fields["label"] = label_text(label) if isinstance(label, str) else label
        for attribute, value in (*fields.items(), *((n, several(of, n, v)) for n, v in lists.items())):
            object.__setattr__(self, attribute, value)
        if label is not None and (self.entry or self.during or self.exit):
            raise ModelError(
                f"{of} has a text and entry=, during= or exit= beside it; write all in the text."
            )
        segments = [*self.default, *self.transitions, *(t for j in self.junctions for t in j.transitions)]
        texts = any(isinstance(s, Transition) and s.label is not None for s in segments)
        inside = any(isinstance(s, State) and s.labelled for s in self.states)
        self.__dict__["_labelled"] = texts or inside or label is not None

    @property
    def labelled(self) -> bool:
        """Whether something in it is a text that no chart has read."""
        return bool(self.__dict__["_labelled"])

    def walk(self, path: Path = ()) -> Iterator[tuple[Path, "State"]]:
        """This state and every state below it, with paths, parents first, in execution order.

        Raises ``RecursionError`` for more levels than what lowers and draws charts can follow.
        """
        todo: list[tuple[Path, State]] = [(path, self)]
        while todo:
            path, state = todo.pop()
            if len(path) > _DEEPEST:
                raise RecursionError("states are nested too deeply")
            yield path, state
            todo += [((*path, child.name), child) for child in reversed(state.states)]


class Chart:
    """A chart: its name and its outermost level.

    ``door.active("Open", "Opening")`` is the condition that one of these states is active, for properties
    and for the guards of other charts; a name that several states have is written ``"Cabin.Open"``.
    ``text`` says in one line what it does and where it comes from.  ``local_to`` lists data whose
    value means something only while one of the named states is active: on leaving them it returns
    to its initial value (Stateflow: data scoped to a state).  ``data`` are what labels written as text may
    name beside what the formulas of the chart use: variables, named formulas, arrays, functions, charts,
    enumerations.
    """

    def __init__(
        self,
        name: str,
        states: Sequence[State],
        *,
        default: str | Transition | Sequence[Transition] | None = None,
        junctions: Sequence[Junction] = (),
        parallel: bool = False,
        text: str = "",
        local_to: Sequence[tuple[Var, Sequence[str]]] = (),
        data: Sequence[object] = (),
        place: Place | None = None,
    ) -> None:
        self.name = name
        self.text = text
        self.local_to = _local(name, local_to)
        self.root = State(
            name, states=states, junctions=junctions, default=default, parallel=parallel, place=place
        )
        self.data, self.label_faults = several(f"Chart {name!r}", "data", data), tuple[str, ...]()
        if self.root.labelled or self.data:
            from rovercheck.spec_model.lang.stateflow.chart import with_labels_read  # which reads charts

            self.root, self.label_faults = with_labels_read(self)
            self.__dict__ = {name: self.__dict__[name] for name in self._written}

    _written: tuple[str, ...] = ("name", "text", "local_to", "root", "data", "label_faults")

    def __getstate__(self) -> dict[str, object]:
        return self.__dict__ | {"data": ()}  # functions stay where they are written

    def with_local_data(self, local_to: Sequence[tuple[Var, Sequence[str]]]) -> "Chart":
        """The chart with other data that mean something only in some states."""
        return self._with(self.root, local_to)

    def with_root(self, root: State) -> "Chart":
        """The chart with another outermost level."""
        return self._with(root, self.local_to)

    def _with(self, level: State, local_to: Sequence[tuple[Var, Sequence[str]]]) -> "Chart":
        return Chart(
            self.name, level.states, default=level.default, junctions=level.junctions,
            parallel=level.parallel, text=self.text, local_to=local_to, data=self.data, place=level.place,
        )  # fmt: skip

    @property
    def place(self) -> Place | None:
        """Where the chart is written."""
        return self.root.place

    @property
    def inner(self) -> Mapping[Path, Sequence[Transition]]:
        """Transitions that are drawn inside the state that they leave, which only imported charts have."""
        return {}

    @property
    def figure(self) -> ChartFigure | None:
        """Where things stand in the drawing of an imported chart."""
        return None

    @cached_property
    def states(self) -> dict[Path, State]:
        """Every state by path, parents first, in execution order; the empty path is the chart."""
        return dict(self.root.walk())

    @cached_property
    def junctions(self) -> dict[Path, Junction]:
        """Every junction by path."""
        return {(*path, j.name): j for path, state in self.states.items() for j in state.junctions}

    def path(self, name: str) -> Path:
        """The path of a state given by name, or dotted from any level when the name is not unique.

        Raises ``ModelError`` for an unknown or ambiguous name.
        """
        if not isinstance(name, str):
            raise ModelError(f"{self.name} has no state {brief(name)}; write its name.")
        wanted = tuple(name.split("."))
        if wanted in self.states:
            return wanted
        found = [p for p in self._by_name.get(wanted[-1], ()) if p[-len(wanted) :] == wanted]
        found = [p for p in found if p in self.states]
        if not found and len(wanted) > 1 and wanted[0] == self.name:  # as traces and messages write it
            return self.path(".".join(wanted[1:]))
        if len(found) == 1:
            return found[0]
        if not found:
            names = [".".join(p) for p in self.states if p] + [p[-1] for p in self.states if p]
            raise ModelError(f"{self.name} has no state {name!r}. {did_you_mean(name, names)}")
        options = ", ".join(".".join(p) for p in found)
        raise ModelError(f"{self.name} has {len(found)} states named {name!r}; write one of: {options}.")

    def resolve(self, level: Path, name: str) -> Path | None:
        """What a transition drawn at ``level`` means by ``name``: the nearest match, looking outward."""
        wanted = tuple(name.split("."))
        for depth in range(len(level), -1, -1):
            candidate = (*level[:depth], *wanted)
            if candidate in self.states or candidate in self.junctions:
                return candidate
        found = [p for p in self._by_name.get(wanted[-1], ()) if p[-len(wanted) :] == wanted]
        return found[0] if len(found) == 1 else None

    @cached_property
    def _by_name(self) -> dict[str, list[Path]]:
        """The states, then the junctions, that have a name of their own, by that name."""
        found: dict[str, list[Path]] = {}
        for path in filter(None, (*self.states, *self.junctions)):
            found.setdefault(path[-1], []).append(path)
        return found

    def location(self, path: Path = ()) -> Var:
        """The variable that says which state of an exclusive composite is active."""
        if path not in self._places:
            names = [NOWHERE, *(s.name for s in self.states[path].states)]
            name = ".".join((self.name, *path))
            members = tuple((member, number) for number, member in enumerate(names))
            domain = Domain(Enum(f"states of {name}", members), range(len(names)))  # names are judged later
            self._places[path] = Var(name, domain, 0, f"active state of {name}")
        return self._places[path]

    @cached_property
    def _places(self) -> dict[Path, Var]:
        """The location variables that were asked for."""
        return {}

    @cached_property
    def entered(self) -> Var:
        """True once the chart has had its first execution (rule G2)."""
        return Var(f"{self.name}.entered", enumeration("Entered", ["no", "yes"]), 0)

    @cached_property
    def locations(self) -> tuple[Var, ...]:
        """The location variables of every exclusive composite, in execution order."""
        return tuple(self.location(p) for p, s in self.states.items() if s.states and not s.parallel)

    def active(self, *names: str) -> Expr:
        """The condition that one of the named states is active."""
        if not names:
            raise ModelError(f"active() names no state of {self.name}; write the name of one at least.")
        return any_of(*(self.active_path(self.path(name)) for name in names))

    def active_path(self, path: Path) -> Expr:
        """The condition that the state at ``path`` is active; for the chart itself, that it was entered."""
        while path:
            parent = path[:-1]
            if not self.states[parent].parallel:
                place = self.location(parent)
                return place == Const(place.domain.raw(path[-1]), place.sort)
            path = parent
        if self.root.parallel:
            return self.entered == "yes"
        return self.location() != NOWHERE

    @cached_property
    def written(self) -> dict[str, Var]:
        """Data the chart writes, by name (locations and timers not included)."""
        return writes(self.all_actions) | {data.name: data for data, _ in self.local_to}

    @cached_property
    def read(self) -> dict[str, Var]:
        """Data the chart reads, by name."""
        return reads(self.all_actions) | variables(*self.guards)

    @cached_property
    def all_actions(self) -> tuple[Action, ...]:
        """Every action of the chart, in drawing order."""
        found: list[Action] = []
        for state in self.states.values():
            found += [*state.entry, *state.during, *state.exit]
        for transition in self.transitions:
            found += [*transition.do, *transition.then]
        return tuple(found)

    @cached_property
    def transitions(self) -> tuple[Transition, ...]:
        """Every segment of the chart, default transitions included."""
        found = [t for s in self.states.values() for t in (*s.default, *s.transitions)]
        return tuple(found + [t for j in self.junctions.values() for t in j.transitions])

    @property
    def guards(self) -> list[Expr]:
        return [t.guard for t in self.transitions if t.guard is not None]

    @property
    def expressions(self) -> list[Expr]:
        """Every guard and every expression in an action."""
        return [*self.guards, *expressions(self.all_actions)]

    def __repr__(self) -> str:
        return f"Chart({self.name!r})"


def _local(
    chart: str, local_to: Sequence[tuple[Var, Sequence[str]]]
) -> tuple[tuple[Var, tuple[str, ...]], ...]:
    of, found = f"Chart {chart!r}", list[tuple[Var, tuple[str, ...]]]()
    for pair in several(of, "local_to", local_to):
        if not isinstance(pair, tuple | list) or len(pair) != 2 or not isinstance(pair[0], Var):
            raise ModelError(
                f"{of}: local_to holds {brief(pair)}; write pairs, (variable, [names of states])."
            )
        found.append((pair[0], several(of, "the states of local_to", pair[1])))
    return tuple(found)


class Block:
    """A function block: its actions run once in every step in which it is executed.

    ``temporaries`` are written before they are read in every step, and are no part of a state.
    """

    def __init__(
        self,
        name: str,
        do: Sequence[Action],
        *,
        text: str = "",
        temporaries: Sequence[Var] = (),
        place: Place | None = None,
    ) -> None:
        self.name = name
        self.text = text
        self.do = several(f"Block {name!r}", "do", do)
        self.temporaries = tuple(temporaries)
        self.place = place or here()

    @cached_property
    def written(self) -> dict[str, Var]:
        return self._lasting(writes(self.do))

    @cached_property
    def read(self) -> dict[str, Var]:
        return self._lasting(reads(self.do))

    def _lasting(self, found: dict[str, Var]) -> dict[str, Var]:
        for one in self.temporaries:
            found.pop(one.name, None)
        return found

    def __repr__(self) -> str:
        return f"Block({self.name!r})"


class Enabled:
    """A subsystem that executes in a step iff ``by`` is true then; else everything in it is frozen (G12).

    ``name`` says whose it is, where that matters to a reader: that of a board.
    """

    def __init__(
        self, by: Expr, *components: "Component", name: str = "", place: Place | None = None
    ) -> None:
        self.by = by
        self.components = components
        self.name = name
        self.place = place or here()

    def __repr__(self) -> str:
        return f"Enabled({self.by}, {', '.join(map(repr, self.components))})"


Component = Chart | Block | Enabled


def parts(components: Sequence[Component]) -> Iterator[Chart | Block]:
    """The charts and blocks in execution order, those of enabled subsystems too."""
    for component in components:
        if isinstance(component, Enabled):
            yield from parts(component.components)
        else:
            yield component
