"""The labels of a chart that are written as text, read with the names that the chart knows."""

from collections.abc import Sequence
from dataclasses import replace

from rovercheck.spec_model.lang.chart import Chart, Path, State
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.stateflow.message import Extent, LabelError, LabelText, UnknownName
from rovercheck.spec_model.lang.stateflow.names import LabelNames, names_of
from rovercheck.spec_model.lang.stateflow.statements import errors_of, state_of, transition_of
from rovercheck.spec_model.lang.transition import Junction, Transition


def with_labels_read(chart: Chart) -> tuple[State, tuple[str, ...]]:
    """The outermost level with formulas and actions in place of texts, and what is wrong with the texts.

    A text that has no meaning stays.  The faults have their places.
    """
    reader = _Reader(chart)
    try:
        names_of(chart, (), chart.data)
        return reader.state((), chart.root), reader.every_fault()
    except ModelError as error:
        where = f"{chart.place}: " if chart.place else ""
        return chart.root, (f"{where}Chart {chart.name!r}: {error}",)


class _Reader:
    """Reads one chart."""

    def __init__(self, chart: Chart) -> None:
        self.chart, self.faults = chart, list[str]()
        self.unknown = dict[str, tuple[LabelText, str, UnknownName]]()
        self._names: dict[Path, LabelNames] = {}

    def names(self, path: Path) -> LabelNames:
        """The names in a state."""
        if path not in self._names:
            self._names[path] = names_of(self.chart, path, self.chart.data)
        return self._names[path]

    def state(self, path: Path, state: State) -> State:
        """A state with everything in it read."""
        if not state.labelled:
            return state
        inside = replace(
            state,
            states=tuple(self.state((*path, child.name), child) for child in state.states),
            junctions=tuple(
                Junction(j.name, self.transitions(path, j.transitions, j.name)) for j in state.junctions
            ),
            default=self.transitions(path, state.default, f"default of {state.name}"),
            transitions=self.transitions(path, state.transitions, state.name),
        )
        return self._with_actions(path, inside)

    def _with_actions(self, path: Path, state: State) -> State:
        label = state.label
        if label is None:
            return state
        try:
            parts = state_of(label.text, self.names(path))
        except (LabelError, RecursionError) as error:
            self._fault(label, f"{self.chart.name}, actions of {state.name}", error)
            return state
        return replace(state, label=None, entry=parts.entry, during=parts.during, exit=parts.exit)

    def transitions(self, path: Path, drawn: Sequence[Transition], source: str) -> tuple[Transition, ...]:
        """Transitions with their labels read."""
        return tuple(self._transition(path, one, number, source) for number, one in enumerate(drawn, 1))

    def _transition(self, path: Path, drawn: Transition, number: int, source: str) -> Transition:
        label = drawn.label if isinstance(drawn, Transition) else None
        if label is None:
            return drawn
        try:
            parts = transition_of(label.text, self.names(path))
        except (LabelError, RecursionError) as error:
            self._fault(label, f"{self.chart.name}, transition {number} of {source}", error)
            return drawn
        return replace(drawn, label=None, event=parts.event, guard=parts.guard, do=parts.do, then=parts.then)

    def _fault(self, label: LabelText, of: str, error: LabelError | RecursionError) -> None:
        if isinstance(error, RecursionError):
            said = "this is nested too deeply to be read; name parts of it with named()."
            error = LabelError(said, Extent(0, len(label.text)))
        for one in errors_of(error):
            if isinstance(one, UnknownName) and not self.chart.data:
                self.unknown.setdefault(one.name, (label, of, one))
            else:
                self.faults.append(label.fault(of, one))

    def every_fault(self) -> tuple[str, ...]:
        """All faults, each once; of a chart without data its unknown names together, at the first of them."""
        if self.unknown:
            label, of, first = next(iter(self.unknown.values()))
            names = ", ".join(self.unknown)
            said = f"the chart has no data, and its labels use {names}. Write data=[{names}] in Chart(...)."
            self.faults.insert(0, label.fault(of, LabelError(said, first.at)))
        return tuple(dict.fromkeys(self.faults))
