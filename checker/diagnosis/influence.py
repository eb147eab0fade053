"""Which outputs of a part a change may concern: others, of other data and regions, it explains by chance.

A graph of what each datum is computed from and under which conditions; the regions of a parallel chart are
apart, unless they send each other events.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property

from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.spec_model.abstraction import Output
from rovercheck.spec_model.lang.action import Action, Assign, If, Send, each_action
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, State, parts
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import structure, variables

EVERYWHERE = "everywhere"
_OF_STATE = re.compile(r"(?:arrow|default|state)/([^./ ]+)")
_OF_DATA = re.compile(r"(?:signal/|data/|everywhere )([^/ ]+)")


class ChangeInfluence:
    """What the changes of a system may make otherwise, of these outputs.

    That an output is not compared any more, as it has no meaning then, explains nothing that it did.
    """

    def __init__(self, system: System, outputs: Sequence[Output]) -> None:
        self._system = system
        self._outputs = {o.name: o.var.name for o in outputs}
        self._written: dict[str, dict[str, list[object]]] = {}
        self._into: dict[str, set[str]] = {}
        self._controls: dict[str, dict[str, str]] = {}
        """Of each chart or block the nodes of its regions: the control of what is done in them."""
        self._known: dict[tuple[str, ...], frozenset[str]] = {}
        self._components(system.components, [])

    def outputs(self, change: ChartChange) -> frozenset[str]:
        """The names of the outputs that may be otherwise with a change."""
        key: tuple[str, ...] = (change.kind, change.chart, change.at)
        if change.kind == "shared" or change.at == EVERYWHERE:
            key = (*key, change.old, change.new if change.kind in ("shared", "exchanged") else "")
        if key not in self._known:
            self._known[key] = self._reached(self._starts(change))
        return self._known[key]

    def of_data(self, name: str) -> frozenset[str]:
        """The names of the outputs that may be otherwise with other values of a datum."""
        return self._reached([name])

    # --- the graph ---

    def _components(self, components: Iterable[Component], conditions: list[Expr]) -> None:
        for component in components:
            if isinstance(component, Enabled):
                self._components(component.components, [*conditions, component.by])
                continue
            if isinstance(component, Block):
                controls = {"": f"{component.name}!"}
                self._actions(component.do, controls[""], [])
            else:
                controls = self._chart(component)
            self._controls[component.name] = controls
            for control in controls.values():
                self._edges(conditions, control)

    def _chart(self, chart: Chart) -> dict[str, str]:
        sends = any(isinstance(a, Send) for _, s in chart.root.walk() for a in each_action(list(_acts(s))))
        apart = chart.root.parallel and not sends
        names = [state.name for state in chart.root.states] if apart else []
        controls = {"": f"{chart.name}!", **{name: f"{chart.name}!{name}" for name in names}}
        for name in names:
            self._edge(controls[""], controls[name])
        for path, state in chart.root.walk():
            control = controls.get(path[0] if path else "", controls[""])
            self._edges(_guards(state), control)
            self._actions(list(_acts(state)), control, [])
        for place in chart.locations:
            region = place.name.removeprefix(f"{chart.name}.").partition(".")[0]
            self._edge(controls.get(region, controls[""]), place.name)
        for name in (chart.entered.name, *(data.name for data, _ in chart.local_to)):
            for control in controls.values():
                self._edge(control, name)
        return controls

    def _actions(self, actions: Sequence[Action], control: str, conditions: list[Expr]) -> None:
        for action in actions:
            if isinstance(action, Assign):
                self._edges([action.value, *conditions], action.var.name)
                self._edge(control, action.var.name)
            elif isinstance(action, If):
                inside = [*conditions, action.condition]
                self._actions(action.then, control, inside)
                self._actions(action.otherwise, control, inside)

    def _edges(self, read: Iterable[Expr], written: str) -> None:
        for name in variables(*read):
            self._edge(name, written)

    def _edge(self, read: str, written: str) -> None:
        self._into.setdefault(read, set()).add(written)

    # --- where a change is ---

    def _starts(self, change: ChartChange) -> Iterable[str]:
        controls = self._controls.get(change.chart)
        if controls is None or change.kind in ("interpretation", "repair", "order"):
            return self._nodes
        if change.inputs:
            return change.inputs
        if change.at.startswith("regions"):
            return [controls[name] for name in (change.old, change.new) if name in controls]
        if change.kind == "shared":
            return [n for n in self._nodes if n.startswith((change.old, change.new))]
        if change.at == EVERYWHERE and len(controls) > 1:
            return self._rewritten(change, controls)
        if found := _OF_DATA.match(change.at):
            return [found[1]]
        if found := _OF_STATE.match(change.at):
            return [controls.get(found[1], controls[""])]
        return self._nodes if change.at.startswith("order/") else [controls[""]]

    def _rewritten(self, change: ChartChange, controls: Mapping[str, str]) -> list[str]:
        """The regions of a chart in which something is written otherwise with a change."""
        try:
            new = _regions(change.make(), change.chart)
        except (ModelError, AssertionError, ValueError):
            return [controls[""]]
        old = self._written.setdefault(change.chart, _regions(self._system, change.chart))
        names = [name for name in {*old, *new} if old.get(name) != new.get(name)]
        return [controls.get(name, controls[""]) for name in names] or [controls[""]]

    @cached_property
    def _nodes(self) -> frozenset[str]:
        return frozenset(self._into).union(*self._into.values())

    def _reached(self, starts: Iterable[str]) -> frozenset[str]:
        found, todo = set[str](), list(starts)
        while todo:
            node = todo.pop()
            if node not in found:
                found.add(node)
                todo += self._into.get(node, ())
        return frozenset(name for name, var in self._outputs.items() if var in found)


def _regions(system: System, chart: str) -> dict[str, list[object]]:
    """What is written in each region of a chart."""
    found: dict[str, list[object]] = {}
    for part in parts(system.components):
        if isinstance(part, Chart) and part.name == chart:
            for path, state in part.root.walk():
                own = found.setdefault(path[0] if path else "", [])
                own += [*map(structure, _guards(state)), *_shapes(list(_acts(state)))]
    return found


def _shapes(actions: Sequence[Action]) -> Iterator[object]:
    for action in each_action(actions):
        match action:
            case Assign(var, value):
                yield var.name, structure(value)
            case If(condition):
                yield structure(condition)
            case _:
                yield str(action)


def _guards(state: State) -> Iterator[Expr]:
    segments = (*state.transitions, *state.default, *(t for j in state.junctions for t in j.transitions))
    yield from (segment.guard for segment in segments if segment.guard is not None)


def _acts(state: State) -> Iterator[Action]:
    """The actions of a state and of the transitions that are drawn from it and in it."""
    yield from (*state.entry, *state.during, *state.exit)
    for segment in (*state.transitions, *state.default, *(t for j in state.junctions for t in j.transitions)):
        yield from (*segment.do, *segment.then)


__all__ = ["ChangeInfluence"]
