"""A chart as a tree of states with its texts parsed: who is in whom, and which transitions are tried in which
order.  What it means is said elsewhere, twice.
"""

from collections.abc import Mapping, Sequence

from rovercheck.checker.drawn.grammar.actions import ActionStatement
from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.functions import (
    parse_script,
    parse_signature,
)
from rovercheck.checker.drawn.grammar.labels import (
    SectionKind,
    TransitionLabel,
    parse_state_label,
    parse_transition_label,
)
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, Expression
from rovercheck.checker.drawn.machines import machine_notes
from rovercheck.checker.drawn.names import Aliases, BoxNames, Tree
from rovercheck.checker.drawn.records import (
    DrawnChart,
    DrawnContent,
    DrawnData,
    DrawnState,
    DrawnTransition,
    DrawnTruthTable,
)
from rovercheck.checker.drawn.refused import DrawingNote, label_of
from rovercheck.checker.drawn.tree import (
    FunctionNode,
    JunctionNode,
    ParsedChart,
    StateNode,
    TransitionNode,
    output_events,
)
from rovercheck.checker.drawn.truth_tables import actions_of
from rovercheck.spec_model.lang.errors import ModelError

LANGUAGES: Mapping[str, ActionLanguage] = {
    "MATLAB": ActionLanguage.MATLAB, "C": ActionLanguage.C, "C with bit operations": ActionLanguage.C_BITS
}  # fmt: skip


def parsed_chart(chart: DrawnChart) -> ParsedChart:
    """The tree of a chart.  What cannot be parsed is left out, with a note."""
    return _Parser(chart).chart()


class _Parser:
    def __init__(self, chart: DrawnChart) -> None:
        self._chart, self._language = chart, LANGUAGES[chart.language]
        self._states: dict[int, StateNode] = {}
        self._junctions: dict[int, JunctionNode] = {}
        self._transitions: list[TransitionNode] = []
        self._notes: list[DrawingNote] = []
        self._boxes, self._aliases = BoxNames(chart), Aliases({})

    def chart(self) -> ParsedChart:
        """The chart with its texts read; those that cannot be read are noted."""
        root = StateNode(0, self._chart.name, self._chart.path, None, self._chart.parallel)
        self._level(root, self._chart.content)
        for one in self._transitions:
            self._connect(one)
        for node in (root, *self._states.values()):
            node.children.sort(key=lambda child: child.order)
            for some in (node.outer, node.inner, node.defaults):
                some.sort(key=lambda one: one.drawn.order)
        for junction in self._junctions.values():
            junction.outgoing.sort(key=lambda one: one.drawn.order)
        parsed = ParsedChart(
            self._chart, self._language, root, self._states, self._junctions, self._transitions, self._notes
        )
        self._notes += machine_notes(parsed)
        return parsed

    def _level(self, node: StateNode, content: DrawnContent) -> None:
        """What is drawn in a state; a box is a namespace only."""
        node.data = {**node.data, **{one.name: one for one in content.data}}
        node.events = {**node.events, **{one.name: one for one in content.events}}
        for one in content.junctions:
            junction = self._junctions[one.ssid] = JunctionNode(one.ssid, node, one.history)
            if one.history:
                node.history = junction
        for state in content.states:
            if state.kind == "box":
                self._refuse_shared(node, state)
                self._level(node, state.content)
            elif state.kind == "function":
                self._function(node, state)
            elif state.kind != "note":
                self._state(node, state)
        for transition in content.transitions:
            label = self._label(node, transition)
            if label is not None:
                self._transitions.append(TransitionNode(transition, label, node))

    def _named(self, tree: Tree, text: str) -> Tree:
        """The tree of a text with each name as it is outside of boxes and atomic subcharts."""
        return self._aliases.plain(self._boxes.plain(tree, text), text)

    def _refuse_shared(self, node: StateNode, box: DrawnState) -> None:
        """A box has names of its own in Stateflow; here they are those of the level around it."""
        names = {one.name for one in box.content.data} | {one.name for one in box.content.events}
        for name in sorted(names & (node.data.keys() | node.events.keys())):
            text = f"{name} is also a name around it, or in another box: give each its own."
            what = f"the box {box.name}"
            self._notes.append(
                DrawingNote("refused", node.path, what, text, self._chart.part, box.ssid, box.line)
            )

    def _state(self, parent: StateNode, state: DrawnState) -> None:
        path = f"{parent.path}/{state.name}"
        node = StateNode(
            state.ssid,
            state.name,
            path,
            parent,
            state.parallel,
            state.order,
            line=state.line,
            label=state.label,
        )
        parent.children.append(node)
        self._states[state.ssid] = node
        try:
            label = self._named(parse_state_label(state.label, self._language), state.label)
        except GrammarError as error:
            self._note(parent.path, f"the state {state.name}", error, state.ssid, state.line)
        else:
            sections: dict[SectionKind, list[ActionStatement]] = {}
            on_events: list[tuple[Expression, Sequence[ActionStatement]]] = []
            for section in label.sections:
                moore = section.implied and self._chart.machine == "Moore"
                for kind in (SectionKind.STATE,) if moore else section.kinds:
                    if kind is SectionKind.ON:
                        on_events += ((event, section.statements) for event in section.events)
                    else:
                        sections.setdefault(kind, []).extend(section.statements)
            node.sections, node.on_events = sections, on_events
        around, self._aliases = self._aliases, Aliases({**self._aliases.names, **state.names})
        self._level(node, state.content)
        self._aliases = around

    def _label(self, node: StateNode, transition: DrawnTransition) -> TransitionLabel | None:
        try:
            label = parse_transition_label(transition.label, self._language)
            return self._named(label, transition.label)
        except GrammarError as error:
            what = f"the transition `{label_of(transition)}`"
            self._note(node.path, what, error, transition.ssid, transition.line)
            return None

    def _connect(self, one: TransitionNode) -> None:
        ends = []
        for ssid in (one.drawn.source, one.drawn.target):
            end = None if ssid is None else self._states.get(ssid) or self._junctions.get(ssid)
            if ssid is not None and end is None:
                raise ModelError(
                    f"{one}: it joins the element of SSID {ssid}, which is not there. Save the model again."
                )
            ends.append(end)
        one.source, one.target = ends
        self._hold(one)
        match one.source:
            case None:
                one.holder.defaults.append(one)
            case JunctionNode():
                one.source.outgoing.append(one)
            case StateNode():
                (one.source.inner if one.drawn.inner else one.source.outer).append(one)

    @staticmethod
    def _hold(one: TransitionNode) -> None:
        """What holds a transition holds its ends, too: else the nearest state that does."""
        ends = [end.holder if isinstance(end, JunctionNode) else end for end in (one.source, one.target)]
        while not all(end is None or one.holder in end.lineage() for end in ends):
            if one.source is None or one.drawn.inner or one.holder.parent is None:
                place = "default transition" if one.source is None else "inner transition"
                raise ModelError(
                    f"{one}: it leads out of that, as no {place} does. Save the model again in Simulink."
                )
            one.holder = one.holder.parent

    def _function(self, holder: StateNode, state: DrawnState) -> None:
        """A function by its name; its flow chart is a level without states."""
        language = self._language
        kernel = self._chart.kind == "MATLAB function"
        try:
            script = self._named(parse_script(state.script), state.script) if state.script else ()
            signature = script[0].signature if kernel and script else parse_signature(state.label, language)
        except GrammarError as error:
            self._note(holder.path, f"the function {state.name}", error, state.ssid, state.line)
            return
        flow = None
        data = {one.name: one for one in state.content.data}
        if not script:
            flow = StateNode(state.ssid, signature.name, f"{holder.path}/{signature.name}", holder)
            self._level(flow, state.content)
            self._states[state.ssid] = flow
            if state.table is not None and not state.content.transitions:
                try:
                    data |= self._table(flow, state, state.table)
                except GrammarError as error:
                    self._note(holder.path, f"the truth table {state.name}", error, state.ssid, state.line)
                    return
        if signature.name in holder.functions:
            name = signature.name
            what = f"the function {name}"
            text = f"another function beside it, or in a box, is called {name}: give each its own name."
            self._notes.append(
                DrawingNote("refused", holder.path, what, text, self._chart.part, state.ssid, state.line)
            )
        holder.functions[signature.name] = FunctionNode(state, signature, holder, script, flow, data)

    def _table(self, flow: StateNode, state: DrawnState, table: DrawnTruthTable) -> dict[str, DrawnData]:
        """Make a flow chart of a truth table; the answer are the data that its conditions are kept in."""
        made, actions = actions_of(table, self._language)
        first = -1000 * state.ssid
        kept = {n: DrawnData(first - at, n, "temporary", "boolean") for at, n in enumerate(made, 1)}
        flow.data = {**flow.data, **kept}
        drawn = DrawnTransition(state.ssid, None, None, state.name, 1, line=state.line)
        end = JunctionNode(state.ssid, flow, history=False)
        label = TransitionLabel(condition_actions=actions)
        flow.defaults.append(TransitionNode(drawn, label, flow, target=end))
        return kept

    def _note(self, where: str, what: str, error: GrammarError, ssid: int, line: int) -> None:
        text = f"{error}."
        self._notes.append(DrawingNote("refused", where, what, text, self._chart.part, ssid, line))


__all__ = [
    "FunctionNode", "JunctionNode", "ParsedChart", "StateNode", "TransitionNode", "output_events",
    "parsed_chart",
]  # fmt: skip
