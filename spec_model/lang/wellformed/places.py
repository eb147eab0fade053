"""Where something is written in a chart: the transitions with the states they leave, and the actions."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache

from rovercheck.spec_model.lang.action import Action, each_action
from rovercheck.spec_model.lang.action import If as Conditional
from rovercheck.spec_model.lang.chart import Chart, Path, Transition
from rovercheck.spec_model.lang.expr import Expr


def name_of(path: Path) -> str:
    """A state as messages name it."""
    return path[-1] if path else "the chart"


def parallel_name(path: Path) -> str:
    """A parallel composite as messages name it."""
    return f"the parallel {path[-1] if path else 'chart'}"


def transition_names(
    transitions: Sequence[Transition], path: Path, default: bool = False
) -> list[tuple[str, Transition]]:
    """Each transition with the words that point at it; ``path`` is its state, junction or composite."""
    if default and len(transitions) == 1:
        return [(f"the default transition of {name_of(path)}", transitions[0])]
    of = f"the default transitions of {name_of(path)}" if default else name_of(path)
    return [
        (f"transition {number} of {of}", transition) for number, transition in enumerate(transitions, start=1)
    ]


@dataclass(frozen=True)
class Leg:
    """A segment on some path from a state, or on the default path of a composite.

    ``end`` is the state or junction it goes to; a junction shared by several states yields a leg
    for each of them.
    """

    source: Path
    default: bool
    where: str
    segment: Transition
    end: Path
    complete: bool


@lru_cache(maxsize=8)
def legs(chart: Chart) -> tuple[Leg, ...]:
    """Every segment with every state or composite from which a path reaches it."""
    found: list[Leg] = []
    for path, state in chart.states.items():
        found += _legs(chart, path, True, path, transition_names(state.default, path, default=True))
        found += _legs(chart, path, False, path[:-1], transition_names(state.transitions, path))
    return tuple(found)


def _legs(
    chart: Chart, source: Path, default: bool, level: Path, first: Sequence[tuple[str, Transition]]
) -> Iterator[Leg]:
    seen: set[Path] = set()
    todo = [(level, name, segment) for name, segment in first]
    while todo:
        at, name, segment = todo.pop(0)
        end = chart.resolve(at, segment.target)
        assert end is not None, "targets were checked before"
        junction = chart.junctions.get(end)
        yield Leg(source, default, name, segment, end, junction is None)
        if junction is not None and end not in seen:
            seen.add(end)
            todo += [(end[:-1], n, s) for n, s in transition_names(junction.transitions, end)]


class ActionKind(StrEnum):
    """Where actions stand."""

    ENTRY = "entry action"
    DURING = "during action"
    EXIT = "exit action"
    CONDITION = "condition action"
    TRANSITION = "transition action"


@dataclass(frozen=True)
class ActionPlace:
    """Actions of a state, or of a segment of a path that leaves it."""

    owner: Path
    kind: ActionKind
    where: str
    actions: tuple[Action, ...]
    default: bool = False


@lru_cache(maxsize=8)
def places(chart: Chart) -> tuple[ActionPlace, ...]:
    """Every list of actions that is not empty, with the state that it belongs to."""
    return tuple(_places(chart))


def _places(chart: Chart) -> Iterator[ActionPlace]:
    for path, state in chart.states.items():
        of = name_of(path)
        kinds = {ActionKind.ENTRY: state.entry, ActionKind.DURING: state.during, ActionKind.EXIT: state.exit}
        for kind, actions in kinds.items():
            if actions:
                yield ActionPlace(path, kind, f"the {kind} of {of}", actions)
    for leg in legs(chart):
        for kind, actions in (
            (ActionKind.CONDITION, leg.segment.do),
            (ActionKind.TRANSITION, leg.segment.then),
        ):
            if actions:
                yield ActionPlace(leg.source, kind, f"the {kind} of {leg.where}", actions, leg.default)


def conditions(actions: Sequence[Action]) -> Iterator[Expr]:
    """The conditions of the conditional actions, nested ones too."""
    for action in each_action(actions):
        if isinstance(action, Conditional):
            yield action.condition


def common_composite(source: Path, target: Path) -> Path:
    """The innermost composite with both ends of a transition properly inside it."""
    most = max(min(len(source), len(target)) - 1, 0)
    if source[:most] == target[:most]:  # nearly always, and at once also where states lie deep
        return source[:most]
    return source[: next(depth for depth in range(most) if source[depth] != target[depth])]
