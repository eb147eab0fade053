"""What a chart shows, in words and without coordinates: arrows, labels, actions, names explained."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rovercheck.spec_model.lang.action import Action, ActionCall, If, as_calls, call_of, each_action
from rovercheck.spec_model.lang.chart import Chart, Path, State, Transition
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Named
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.walk import nodes


@dataclass(frozen=True)
class ChartArrow:
    """One segment of an arrow between two states or junctions, known by their paths.

    ``order`` is its number among the ``siblings`` segments with the same start, from 1.  A default
    transition starts at ``source``, the composite (or chart) whose default it is.  The name of an inner
    transition has ``^``.
    """

    name: str
    source: Path
    target: Path
    order: int
    siblings: int
    default: bool
    transition: Transition

    @property
    def number(self) -> str:
        """The priority to be written at its start; empty for the only arrow of its source."""
        return str(self.order) if self.siblings > 1 else ""


def arrows(chart: Chart) -> tuple[ChartArrow, ...]:
    """Every segment: default transitions, then those of states and of junctions, in drawing order.

    Raises ``ModelError`` for an arrow to an unknown name.
    """
    found: list[ChartArrow] = []
    for path, state in chart.states.items():
        found += _from(chart, path, path, state.default, default=True)
        found += _from(chart, path, path[:-1], state.transitions)
        found += _from(chart, path, path, chart.inner.get(path, ()), mark="^")
    for path, junction in chart.junctions.items():
        found += _from(chart, path, path[:-1], junction.transitions)
    return tuple(found)


def _from(
    chart: Chart, source: Path, level: Path, transitions: Sequence[Transition], default: bool = False,
    mark: str = "",
) -> Iterable[ChartArrow]:  # fmt: skip
    for order, transition in enumerate(transitions, 1):
        target = chart.resolve(level, transition.target)
        if target is None:
            start = ".".join(source) or chart.name
            raise ModelError(
                f"{chart.name}: transition {order} of {start} goes to {transition.target!r}, "
                "which is unknown."
            )
        name = f"{'.'.join(source)}{'*' if default else mark}#{order}"
        yield ChartArrow(name, source, target, order, len(transitions), default, transition)


def label_parts(arrow: Transition) -> tuple[str, ...]:
    """The parts of a label that may stand on lines of their own: event, guard, actions."""
    if arrow.label is not None:
        return tuple(filter(None, (line.strip() for line in arrow.label.text.splitlines())))
    parts = [arrow.event or "", f"[{text(arrow.guard)}]" if arrow.guard is not None else ""]
    parts.append("{" + "; ".join(map(str, as_calls(arrow.do))) + "}" if arrow.do else "")
    parts.append("/ " + "; ".join(map(str, as_calls(arrow.then))) if arrow.then else "")
    return tuple(filter(None, parts))


def label(arrow: Transition) -> str:
    """``event [guard] {condition action} / transition action`` in one line."""
    return " ".join(label_parts(arrow))


def action_lines(state: State) -> tuple[str, ...]:
    """The actions listed in a state's box; conditionals spread over several lines."""
    if state.label is not None:
        return tuple(line.rstrip() for line in state.label.text.splitlines() if line.strip())
    lines: list[str] = []
    for word, actions in (("entry", state.entry), ("during", state.during), ("exit", state.exit)):
        if actions:
            shown = [line for action in as_calls(actions) for line in _lines(action)]
            lines += [f"{word}: {shown[0]}"] if len(shown) == 1 else [f"{word}:", *("  " + s for s in shown)]
    return tuple(lines)


def _lines(action: Action | ActionCall) -> list[str]:
    if not isinstance(action, If) or len(str(action)) <= 46:
        return [str(action)]
    lines = [f"if {text(action.condition)}"]
    lines += ["  " + line for inner in as_calls(action.then) for line in _lines(inner)]
    match action.otherwise:
        case ():
            return lines
        case (If() as chained,):
            rest = _lines(chained)
            return [*lines, f"else {rest[0]}", *rest[1:]]
        case otherwise:
            return [*lines, "else", *("  " + line for inner in as_calls(otherwise) for line in _lines(inner))]


def explained(chart: Chart) -> dict[str, str]:
    """The names of formulas and of shared actions that the chart shows, with what they stand for."""
    found: dict[str, str] = {}
    for action in each_action(chart.all_actions):
        if call := call_of(action):
            found.setdefault(call.name, "; ".join(map(str, call.actions)))
    for expr in nodes(*chart.expressions):
        if isinstance(expr, Named) and text(expr) != text(expr, unfold=True):
            found.setdefault(expr.name, text(expr, unfold=True))
    return dict(sorted(found.items()))


def identifiers(chart: Chart) -> dict[Path, str]:
    """A short name of letters and digits for the chart, each state and each junction."""
    return {path: f"n{number}" for number, path in enumerate((*chart.states, *chart.junctions))}


def execution_order(chart: Chart, path: Path) -> int:
    """The number of a parallel region among its siblings, from 1; 0 for a state that is exclusive."""
    parent = chart.states[path[:-1]]
    if not parent.parallel:
        return 0
    return 1 + [s.name for s in parent.states].index(path[-1])
