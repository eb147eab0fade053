"""A drawn chart as a chart of the language: the same states, junctions and transitions, in the same order."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property

from rovercheck.checker.drawn.charts.paths import (
    DEAD_END,
    behind_border,
    end_of,
    ends_in_state,
    is_dead_end,
    paths_from,
    refuse_dead_ends,
    refuse_other_scopes,
)
from rovercheck.checker.drawn.charts.texts import ChartTexts
from rovercheck.checker.drawn.charts.tidy import tidied
from rovercheck.checker.drawn.grammar.labels import SectionKind
from rovercheck.checker.drawn.grammar.syntax import Expression, Member, Name
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.parsed import JunctionNode, StateNode, TransitionNode
from rovercheck.spec_model.lang.action import Action, Assign, Send, each_action
from rovercheck.spec_model.lang.chart import NOWHERE, Chart, Path, State
from rovercheck.spec_model.lang.domain import enumeration
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var, all_of
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.transition import Junction, Transition
from rovercheck.spec_model.lang.walk import variables


@dataclass
class ChartLabels:
    """What the engineer has written: the labels of states by path, and of transitions by their places."""

    states: dict[Path, str] = field(default_factory=dict)
    transitions: dict[Place, str] = field(default_factory=dict)


class ChartBuilder:
    """Makes one chart of its ``texts``."""

    def __init__(self, texts: ChartTexts) -> None:
        self.texts, self.drawn = texts, texts.chart
        self.view = texts.view
        self.labels = ChartLabels()
        self._history: dict[int, Var] = {}

    def chart(self) -> Chart:
        """The chart.  Raises ``NotLowered`` for what the language has no words for."""
        self._refuse()
        for node in self.drawn.root.every():
            if node.history is not None and node.children and not node.parallel:
                self._history[node.ssid] = self._last(node)
        root = self._state(self.drawn.root)
        text = f"The chart {self.drawn.drawn.path}."
        return Chart(
            self.view.name_of_chart, root.states, default=root.default, junctions=root.junctions,
            parallel=root.parallel, text=text, place=self.view.place(0, 0),
        )  # fmt: skip

    def _refuse(self) -> None:
        drawn, root = self.drawn.drawn, self.drawn.root
        if drawn.machine == "Moore":
            raise NotLowered(f"{drawn.path} is a Moore chart: make it a classic one")
        if drawn.at_initialization:
            raise NotLowered(
                f"{drawn.path} is entered before the first step: let it be entered in its first step"
            )
        refuse_other_scopes(self.drawn)
        functions = (one for node in root.every() for one in node.functions.values())
        for one in functions:
            if one.drawn.function == "Simulink":
                raise NotLowered(
                    f"{drawn.path} has the Simulink function {one.signature.name} (SSID {one.drawn.ssid}): "
                    "write it as a MATLAB function"
                )
        for node in root.every():
            refuse_dead_ends(node.outer)
            refuse_dead_ends(node.defaults)
            if node.on_events:
                raise NotLowered(
                    f"the state {node.path} (SSID {node.ssid}) has actions on an event or a time, for which "
                    "there is no section: draw a transition"
                )

    # --- states --------------------------------------------------------------------------------------------

    def _state(self, node: StateNode) -> State:
        path = self.view.paths[node.ssid]
        with self._told_of(node):
            entry, during, exits = (
                self.texts.actions(node.sections.get(kind, ()), node)
                for kind in (SectionKind.ENTRY, SectionKind.DURING, SectionKind.EXIT)
            )
            during += self._flow(node)
            exits += self._remembered(node)
        if node.label.strip() and node.parent is not None:
            self.labels.states[path] = node.label
        first = self._inner_of(node.parent) if node.parent is not None else []
        default = [] if node.parallel else [*self._by_history(node), *self._transitions(node.defaults, node)]
        return State(
            self.view.name(node) if path else self.view.name_of_chart,
            entry=entry, during=during, exit=exits, parallel=node.parallel, default=default,
            states=[self._state(child) for child in node.children],
            transitions=[*first, *self._transitions(node.outer, node)], junctions=self._junctions(node),
            place=self.view.place(node.line, node.ssid),
        )  # fmt: skip

    def _junctions(self, node: StateNode) -> list[Junction]:
        found = []
        for one in self.drawn.junctions.values():
            if one.holder is not node or one.history or not self._is_met(one):
                continue
            source = self._source_of(one) or node
            leaving = self._transitions(one.outgoing, source)
            found.append(Junction(self.view.junction_name(one), leaving or [self._dead_end(node, source)]))
        return found

    def _dead_end(self, node: StateNode, source: StateNode) -> Transition:
        """What leads on from a junction that nothing leaves: a transition that is never taken."""
        by_default = source in node.lineage()
        end = node.children[0] if by_default and node.children else source
        return Transition(".".join(self.view.paths[end.ssid]), guard=FALSE)

    def _source_of(self, junction: JunctionNode) -> StateNode | None:
        """A state from which a path leads through a junction."""
        seen, waiting = set[int](), [junction]
        while waiting:
            one = waiting.pop()
            seen.add(one.ssid)
            for incoming in self.drawn.transitions:
                if incoming.target is one:
                    if isinstance(incoming.source, JunctionNode):
                        waiting += [incoming.source] if incoming.source.ssid not in seen else []
                    else:
                        return incoming.source or incoming.holder
        return None

    def _is_met(self, junction: JunctionNode) -> bool:
        """Whether a path of states, not of functions or flow charts in states, leads through a junction."""
        return any(one.target is junction and id(one) not in self._flows for one in self.drawn.transitions)

    # --- history -------------------------------------------------------------------------------------------

    def _last(self, node: StateNode) -> Var:
        """The child that was left last: the language has no history, and a variable does the same."""
        path = ".".join((self.view.name_of_chart, *self.view.paths[node.ssid]))
        members = [NOWHERE, *(self.view.name(child) for child in node.children)]
        return Var(
            f"{path}.last",
            enumeration(f"last of {path}", members),
            0,
            f"history of {path}: its state left last",
        )

    def _by_history(self, node: StateNode) -> list[Transition]:
        last = self._history.get(node.ssid)
        if last is None:
            return []
        return [
            Transition(
                self.view.name(one), guard=last == Const(last.domain.raw(self.view.name(one)), last.sort)
            )
            for one in node.children
        ]

    def _remembered(self, node: StateNode) -> tuple[Action, ...]:
        last = self._history.get(node.parent.ssid) if node.parent is not None else None
        if last is None:
            return ()
        return (Assign(last, Const(last.domain.raw(self.view.name(node)), last.sort)),)

    # --- inner transitions ---------------------------------------------------------------------------------

    @cached_property
    def _flows(self) -> set[int]:
        """The inner transitions that only act, and lead to no state."""
        found = set[int]()
        for node in self.drawn.root.every():
            if node.inner and not any(ends_in_state(path) for path in paths_from(node.inner)):
                found |= {id(one) for path in paths_from(node.inner) for one in path}
        return found

    def _flow(self, node: StateNode) -> tuple[Action, ...]:
        """A flow chart in a state: it is run after its during actions."""
        if not node.inner or id(node.inner[0]) not in self._flows:
            return ()
        return self.texts.flow(node)

    def _inner_of(self, node: StateNode) -> list[Transition]:
        """The inner transitions of the state around, which come before those of each state in it."""
        if not node.inner or id(node.inner[0]) in self._flows:
            return []
        refuse_dead_ends(node.inner)
        if node.parallel:
            raise NotLowered(f"{node.inner[0]}: it leads from the border of {node.path} into regions")
        for path in paths_from(node.inner):
            target = end_of(path) if ends_in_state(path) else None
            inside = target is not None and node in list(target.lineage())[1:]
            drawn_inside = all(node in list(one.holder.lineage()) for one in path)
            if target is not None and not (inside and drawn_inside):
                raise NotLowered(
                    f"{path[-1]}: an inner transition that leads to {target.path}, which is not inside "
                    f"{node.path}: draw it to a state in it"
                )
        return list(self._transitions(node.inner, node, timeless=True))

    # --- transitions ---------------------------------------------------------------------------------------

    def _transitions(
        self, drawn: Sequence[TransitionNode], source: StateNode, timeless: bool = False
    ) -> list[Transition]:
        """The transitions; those behind a dead end are tested where its condition does not hold only."""
        found, excluded = list[Transition](), list[Expr]()
        made = [list(self._transition(one, source, timeless)) for one in drawn]
        for number, (one, some) in enumerate(zip(drawn, made, strict=True)):
            for each in some:
                guards = [*excluded, *([] if each.guard is None else [each.guard])]
                found.append(replace(each, guard=all_of(*guards)) if excluded else each)
            if is_dead_end(one) and number + 1 < len(drawn):
                later = [t for other in drawn[number + 1 :] for t in self._behind(other, source)]
                excluded.append(self._unless(one, some, later))
        return found

    def _behind(self, one: TransitionNode, source: StateNode) -> Iterator[Transition]:
        """What may still be tested from a transition on."""
        yield from (
            made for path in paths_from([one]) for each in path for made in self._transition(each, source)
        )

    @staticmethod
    def _unless(one: TransitionNode, made: Sequence[Transition], later: Sequence[Transition]) -> Expr:
        """That a path has not ended at a dead end, which can be asked for as long as nothing has changed."""
        [dead] = made if len(made) == 1 else [None]
        if dead is None or dead.guard is None or dead.event is not None:
            raise NotLowered(f"{one}: {DEAD_END}")
        actions = [action for each in (dead, *later) for action in each_action(each.do)]
        changed = {action.var.name for action in actions if isinstance(action, Assign)}
        if any(isinstance(action, Send) for action in actions) or variables(dead.guard).keys() & changed:
            raise NotLowered(f"{one}: {DEAD_END}")
        return tidied(~dead.guard)

    def _transition(
        self, one: TransitionNode, source: StateNode, timeless: bool = False
    ) -> Iterator[Transition]:
        if one.target is None:
            if one.label.condition_actions:
                raise NotLowered(f"{one}: it leads nowhere, and has an action")
            return
        with self._told(one):
            label = one.label
            guard = None if label.guard is None else self.texts.guard(label.guard, source)
            do = self.texts.actions(label.condition_actions, source)
            then = self.texts.actions(label.transition_actions, source)
            if timeless and guard is not None:
                self.texts.refuse_times(guard)
            place = self.view.place(one.drawn.line, one.drawn.ssid)
            if one.drawn.label.strip():
                self.labels.transitions[place] = one.drawn.label
            for event, condition in self._events(label.events, source):
                if timeless and condition is not None:
                    self.texts.refuse_times(condition)
                whole = [part for part in (condition, guard) if part is not None]
                both = all_of(*whole) if whole else None
                if isinstance(both, Const) and both.value:
                    both = None
                yield Transition(self._target(one), both, event, do, then, place=place)

    def _events(
        self, events: Sequence[Expression], source: StateNode
    ) -> Iterator[tuple[str | None, Expr | None]]:
        """The event of a transition, or the time that stands in its place; of several one after the other."""
        if not events:
            yield None, None
        for event in events:
            match event:
                case Name(name) | Member(_, name):
                    yield (None, None) if name == self.texts.event else (name, None)
                case _:
                    found = self.texts.word_of(event, source)
                    yield None, None if found is TRUE else found

    def _target(self, one: TransitionNode) -> str:
        match one.target:
            case JunctionNode() as junction if not junction.history:
                return ".".join((*self.view.paths[junction.holder.ssid], self.view.junction_name(junction)))
            case JunctionNode() as junction:
                return ".".join(self.view.paths[junction.holder.ssid])
            case StateNode() as node:
                return ".".join(self.view.paths[(behind_border(one) or node).ssid])
        raise AssertionError(one)

    @contextmanager
    def _told(self, one: TransitionNode) -> Iterator[None]:
        """What has no words is told with its transition."""
        try:
            yield
        except NotLowered as error:
            raise NotLowered(str(error) if "(SSID" in str(error) else f"{one}: {error}") from error

    @contextmanager
    def _told_of(self, node: StateNode) -> Iterator[None]:
        try:
            yield
        except NotLowered as error:
            where = f"the state {node.path} (SSID {node.ssid})"
            raise NotLowered(str(error) if "(SSID" in str(error) else f"{where}: {error}") from error


__all__ = ["ChartBuilder", "ChartLabels"]
