"""Charts as they are written in Python: states in states, transitions in their order, labels as texts."""

from collections.abc import Iterator, Sequence

from rovercheck.checker.drawn.charts.chart import ChartLabels
from rovercheck.checker.export.source.formulas import FormulaSource
from rovercheck.checker.export.source.labels import LabelWriter, WrittenLabel, is_silent
from rovercheck.checker.export.source.layout import (
    Call,
    Commented,
    Keyword,
    Lines,
    Source,
    call,
    listed,
    quoted,
)
from rovercheck.spec_model.lang.action import Action, expressions
from rovercheck.spec_model.lang.chart import Chart, Path, State
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.stateflow.names import LabelNames
from rovercheck.spec_model.lang.transition import Transition


class ChartSource:
    """Writes one chart.  ``data`` are what its labels may name: words of Python, and what each stands for."""

    def __init__(
        self, chart: Chart, labels: ChartLabels, formulas: FormulaSource, data: Sequence[tuple[str, object]]
    ) -> None:
        self._chart, self._labels, self._formulas, self._data = chart, labels, formulas, data
        names = LabelNames(own=chart)
        for _, one in data:
            names.add(one)
        self._writer = LabelWriter(chart, names)
        self._texts = False

    def written(self) -> Source:
        """The call that makes it.  Raises ``ModelError`` for what has no words, with its place."""
        root = self._chart.root
        states = listed([self._state((one.name,), one) for one in root.states])
        more = list(self._inside((), root))
        if self._texts and self._data:
            more.append(Keyword("data", listed([name for name, _ in self._data])))
        text = Keyword("text", quoted(self._chart.text))
        return call(self._word("Chart"), quoted(self._chart.name), states, *more, text)

    def _word(self, name: str) -> str:
        return self._formulas.word(name)

    def _inside(self, path: Path, state: State) -> Iterator[Source]:
        """What a chart and a state with states have: junctions, default transitions, regions."""
        if state.junctions:
            made = [
                call(self._word("Junction"), quoted(one.name), self._transitions(path, one.transitions))
                for one in state.junctions
            ]
            yield Keyword("junctions", listed(made))
        if state.default:
            first, *others = state.default
            if is_silent(first) and not others and not self._drawn(first):
                yield Keyword("default", quoted(self._target(path, first)))
            else:
                yield Keyword("default", self._transitions(path, state.default))
        if state.parallel:
            yield Keyword("parallel", "True")

    def _state(self, path: Path, state: State) -> Source:
        parts: list[Source] = [quoted(state.name)]
        label = self._writer.state(state, _without_name(self._labels.states.get(path, ""), state.name))
        comment: tuple[str, ...] = ()
        if label is None:
            self._refuse_places(f"the state {'.'.join(path)}", (state.entry, state.during, state.exit))
            for name in ("entry", "during", "exit"):
                if actions := getattr(state, name):
                    parts.append(Keyword(name, self._formulas.actions(actions)))
            comment = tuple(self._labels.states.get(path, "").splitlines()[1:])
        else:
            parts += self._label(label)
            comment = label.comment
        if state.states:
            inner = [self._state((*path, one.name), one) for one in state.states]
            parts.append(Keyword("states", listed(inner)))
        parts += self._inside(path, state)
        if state.transitions:
            parts.append(Keyword("transitions", self._transitions(path[:-1], state.transitions)))
        made = Call(self._word("State"), tuple(parts))
        return Commented(comment, made) if comment else made

    def _label(self, label: WrittenLabel) -> list[Source]:
        if not label.lines:
            return []
        self._texts = True
        return [quoted(label.lines[0]) if len(label.lines) == 1 else Lines(label.lines)]

    def _drawn(self, one: Transition) -> str:
        return self._labels.transitions.get(one.place, "") if one.place is not None else ""

    def _transitions(self, level: Path, some: Sequence[Transition]) -> Call:
        return listed([self._transition(level, one) for one in some])

    def _transition(self, level: Path, one: Transition) -> Source:
        parts: list[Source] = [quoted(self._target(level, one))]
        drawn = self._drawn(one)
        label = self._writer.transition(one, drawn)
        comment: tuple[str, ...]
        if label is None:
            self._refuse_places(f"the transition `{' '.join(drawn.split())}`", (one.do, one.then), one)
            comment = tuple(line.strip() for line in drawn.strip().splitlines())
            if one.guard is not None:
                parts.append(Keyword("when", self._formulas.formula(one.guard)))
            if one.event is not None:
                parts.append(Keyword("on", quoted(one.event)))
            for name in ("do", "then"):
                if actions := getattr(one, name):
                    parts.append(Keyword(name, self._formulas.actions(actions)))
        else:
            parts += self._label(label)
            comment = label.comment
        made = Call(self._word("to"), tuple(parts))
        return Commented(comment, made) if comment else made

    def _target(self, level: Path, one: Transition) -> str:
        """The end of a transition by as few names as will do where it is drawn."""
        path = self._chart.resolve(level, one.target)
        if path is None:
            raise ModelError(f"{one.place}: {self._chart.name} has several ends of the name {one.target}")
        for start in range(len(path) - 1, 0, -1):
            short = ".".join(path[start:])
            if self._chart.resolve(level, short) == path:
                return short
        return ".".join(path)

    def _refuse_places(
        self, what: str, actions: Sequence[Sequence[Action]], transition: Transition | None = None
    ) -> None:
        formulas = [one for some in actions for one in expressions(some)]
        if transition is not None and transition.guard is not None:
            formulas.append(transition.guard)
        if self._writer.asks_for_states(*formulas):
            raise ModelError(
                f"{self._chart.name}, {what}: it asks which states are active in a formula that no label of "
                "a chart says; ask for it in a condition of its own"
            )


def _without_name(label: str, name: str) -> str:
    """The label of a state without its first words, which are its name."""
    return label.strip().removeprefix(name).lstrip("/ \n")


__all__ = ["ChartSource"]
