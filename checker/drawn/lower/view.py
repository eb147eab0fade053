"""A chart as a person sees it: its states, which of them are active, and its labelled transitions."""

import re
from collections.abc import Mapping, Sequence

from rovercheck.checker.drawn.lower.drawing import figure_of
from rovercheck.checker.drawn.parsed import JunctionNode, ParsedChart, StateNode, TransitionNode
from rovercheck.checker.drawn.refused import label_of
from rovercheck.spec_model.lang.chart import Path, State
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.fired_transition import FiredTransition
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.programmed import ProgrammedChart, StepProgram
from rovercheck.spec_model.lang.stateflow.message import LabelText
from rovercheck.spec_model.lang.transition import Junction, Transition

_ODD = re.compile(r"\W+")


class ChartView:
    """The names of what is in a chart: of its states, of the variables that say which is active."""

    def __init__(
        self, chart: ParsedChart, name: str, file: str, starting: Mapping[str, int] | None = None
    ) -> None:
        self.chart, self.name_of_chart, self._file = chart, name, file
        self.paths: dict[int, Path] = {0: ()}
        self._names: dict[int, str] = {}
        self._name_all(chart.root, ())
        self._chart = self.made(StepProgram((), starting=starting or {}))
        self.fired: dict[str, FiredTransition] = {}
        self.tested: dict[str, tuple[str, bool]] = {}
        self.rivals: dict[str, str] = {}
        self.overflows: dict[str, str] = {}
        self.begun = self._chart.entered

    def _name_all(self, node: StateNode, path: Path) -> None:
        used = set[str]()
        for child in node.children:
            name = child.name if child.name not in used else f"{child.name}_{child.ssid}"
            used.add(name)
            self._names[child.ssid], self.paths[child.ssid] = name, (*path, name)
            self._name_all(child, (*path, name))

    def name(self, node: StateNode) -> str:
        """The name of a state among those beside it."""
        return self._names[node.ssid]

    def location(self, node: StateNode) -> Var:
        """The variable that says which child of an exclusive state is active."""
        return self._chart.location(self.paths[node.ssid])

    # --- what fires ----------------------------------------------------------------------------------------

    def marker(self, path: Sequence[TransitionNode], source: StateNode | None, event: str) -> Var:
        """A variable that is assigned where a path is taken."""
        numbers = "-".join(str(one.drawn.ssid) for one in path)
        name = f"{self.name_of_chart}.fired {numbers}{f' {event}' if event else ''}"
        if source is not None:
            name += f" from {source.ssid}"
        if name not in self.fired:
            end = path[-1].target
            target = end.holder if isinstance(end, JunctionNode) else end
            self.fired[name] = FiredTransition(
                self.name_of_chart,
                () if source is None else self.paths[source.ssid],
                self.paths.get(target.ssid, ()) if target is not None else (),
                " → ".join(filter(None, (self.label(one) for one in path))),
                0 if source is None else path[0].drawn.order,
                event or None,
                self.place(path[0].drawn.line, path[0].drawn.ssid),
            )
        return Var(name, boolean, 0, hidden=True)

    def tested_marker(self, one: TransitionNode, valid: bool) -> Var:
        """A variable that is assigned where a transition with a condition is tested, with this outcome."""
        name = f"{self.name_of_chart}.{'valid' if valid else 'not valid'} {one.drawn.ssid}"
        self.tested[name] = str(one), valid
        return Var(name, boolean, 0, hidden=True)

    def rivals_marker(self, one: TransitionNode, other: TransitionNode) -> Var:
        """A variable that is assigned where a transition is valid, and so is one that is tested after it."""
        name = f"{self.name_of_chart}.both {one.drawn.ssid} {other.drawn.ssid}"
        labels = (f"`{label_of(t.drawn)}` (SSID {t.drawn.ssid})" for t in (one, other))
        self.rivals[name] = f"{' and '.join(labels)} from {_start(one)}"
        return Var(name, boolean, 0, hidden=True)

    def overflow_marker(self, what: str) -> Var:
        """A variable that is assigned where an integer is more than its type holds."""
        known = {said: name for name, said in self.overflows.items()}
        name = known.get(what, f"{self.name_of_chart}.overflow {len(known) + 1}")
        self.overflows[name] = what
        return Var(name, boolean, 0, hidden=True)

    @staticmethod
    def junction_name(one: JunctionNode) -> str:
        """The name of a junction, which has none in the drawing."""
        return _junction(one)

    @staticmethod
    def label(one: TransitionNode) -> str:
        """The label of a transition in one line; nothing where it has none."""
        return "" if label_of(one.drawn) == "?" else label_of(one.drawn)

    def place(self, line: int, ssid: int) -> Place:
        """Where an element of the chart stands in the file."""
        element = f" SSID {ssid}" if ssid else ""
        return Place(f"{self._file}, {self.chart.drawn.part}{element}", max(1, line))

    # --- states --------------------------------------------------------------------------------------------

    def made(self, program: StepProgram) -> ProgrammedChart:
        """The chart with its program."""
        root = self.chart.root
        return ProgrammedChart(
            self.name_of_chart, [self._state(child) for child in root.children], program,
            default=[self._transition(one) for one in root.defaults if one.target is not None],
            junctions=self._junctions(root), parallel=root.parallel,
            inner={
                self.paths[node.ssid]: [self._transition(one) for one in node.inner if one.target is not None]
                for node in root.every() if node.inner
            },
            figure=figure_of(self.chart, self.paths, _junction),
            text=f"The chart {self.chart.drawn.path}.", place=self.place(0, 0),
        )  # fmt: skip

    def _state(self, node: StateNode) -> State:
        return State(
            self.name(node), LabelText(self._label(node)),
            states=[self._state(child) for child in node.children],
            transitions=[self._transition(one) for one in node.outer if one.target is not None],
            junctions=self._junctions(node), parallel=node.parallel,
            default=[self._transition(one) for one in node.defaults if one.target is not None],
            place=self.place(node.line, node.ssid),
        )  # fmt: skip

    def _label(self, node: StateNode) -> str:
        """What a state does, as written, without its name."""
        return node.label.removeprefix(node.name).lstrip("/ \n")

    def _junctions(self, node: StateNode) -> list[Junction]:
        return [
            Junction(_junction(one), [self._transition(t) for t in one.outgoing if t.target is not None])
            for one in self.chart.junctions.values()
            if one.holder is node
        ]

    def _transition(self, one: TransitionNode) -> Transition:
        text = self.label(one)
        place = self.place(one.drawn.line, one.drawn.ssid)
        return Transition(self._target(one), label=LabelText(text) if text else None, place=place)

    def _target(self, one: TransitionNode) -> str:
        match one.target:
            case JunctionNode() as junction:
                return ".".join((*self.paths.get(junction.holder.ssid, ()), _junction(junction)))
            case StateNode() as node:
                return ".".join(self.paths[node.ssid])
        raise AssertionError(one)


def _start(one: TransitionNode) -> str:
    """Where a transition begins."""
    match one.source:
        case JunctionNode() as junction:
            return f"junction {junction.ssid} in {junction.holder.path}"
        case StateNode() as state:
            return state.path
    return f"the default of {one.holder.path}"


def _junction(one: JunctionNode) -> str:
    return f"{'History' if one.history else 'Junction'}{one.ssid}"


def plain_name(text: str) -> str:
    """A name of a block as a name of a model: letters, digits and ``_``."""
    return _ODD.sub("_", text.strip()).strip("_") or "Chart"


__all__ = ["ChartView", "plain_name"]
