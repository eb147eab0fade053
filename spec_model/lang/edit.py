"""Edits of charts: variants that say only where they differ, for repairs and for faults put in by hand."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from rovercheck.spec_model.lang.action import Action, Assign, If, assign, kept
from rovercheck.spec_model.lang.chart import (
    Block,
    Chart,
    Component,
    Enabled,
    Junction,
    Path,
    State,
    Transition,
)
from rovercheck.spec_model.lang.domain import Num, Number, exact
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var, When
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.time import Span

__all__ = [
    "also", "begin", "constant", "drop", "edit_at", "edit_junction", "edit_state", "edit_transition",
    "edit_transitions", "entry", "everywhere", "guard", "in_actions", "in_block", "in_expressions",
    "in_system", "instead", "operator", "swap", "timer",
]  # fmt: skip


def edit_state(chart: Chart, name: str, change: Callable[[State], State]) -> Chart:
    """The chart with one state changed; ``name`` as in ``Chart.path``."""
    return edit_at(chart, chart.path(name), change)


def edit_at(chart: Chart, path: Path, change: Callable[[State], State]) -> Chart:
    """The chart with one state changed, by its path; the empty path is the outermost level."""
    return chart.with_root(_down(chart.root, path, change))


def _down(state: State, path: tuple[str, ...], change: Callable[[State], State]) -> State:
    if not path:
        return change(state)
    children = [_down(s, path[1:], change) if s.name == path[0] else s for s in state.states]
    return replace(state, states=tuple(children))


def edit_junction(chart: Chart, name: str, change: Callable[[Junction], Junction]) -> Chart:
    """The chart with one junction changed, wherever it is drawn; ``"Waiting_S1.J0"`` in that state only."""
    wanted = tuple(name.split("."))

    def walk(path: Path, state: State) -> State:
        return replace(
            state,
            states=tuple(walk((*path, s.name), s) for s in state.states),
            junctions=tuple(change(j) if _ends((*path, j.name), wanted) else j for j in state.junctions),
        )

    if not _is_junction(chart, name):
        raise ModelError(f"{chart.name} has no junction {name!r}; name a junction that is drawn in it.")
    return chart.with_root(walk((), chart.root))


def _is_junction(chart: Chart, name: str) -> bool:
    return any(_ends(path, tuple(name.split("."))) for path in chart.junctions)


def _ends(path: Path, wanted: Path) -> bool:
    return path[-len(wanted) :] == wanted


def edit_transitions(
    chart: Chart, name: str, change: Callable[[list[Transition]], list[Transition]]
) -> Chart:
    """The chart with the transitions of a state or junction changed."""
    if _is_junction(chart, name):
        return edit_junction(chart, name, lambda j: Junction(j.name, change(list(j.transitions))))
    return edit_state(chart, name, lambda s: replace(s, transitions=tuple(change(list(s.transitions)))))


def also(chart: Chart, name: str, *more: Transition, first: bool = False) -> Chart:
    """More transitions of a state or junction, tested after those drawn, or before them (``first``)."""
    return edit_transitions(chart, name, lambda found: [*more, *found] if first else [*found, *more])


def begin(chart: Chart, default: Sequence[Transition], junctions: Sequence[Junction] = ()) -> Chart:
    """Other default transitions of the outermost level, with junctions that they lead to."""
    root = chart.root
    return chart.with_root(replace(root, default=tuple(default), junctions=(*root.junctions, *junctions)))


def swap(chart: Chart, name: str, first: int = 1, second: int = 2) -> Chart:
    """Two priorities exchanged (1 is tested first)."""

    def exchanged(found: list[Transition]) -> list[Transition]:
        found[first - 1], found[second - 1] = found[second - 1], found[first - 1]
        return found

    return edit_transitions(chart, name, exchanged)


def edit_transition(chart: Chart, name: str, order: int, change: Callable[[Transition], Transition]) -> Chart:
    """One transition changed, by its priority."""
    return edit_transitions(
        chart, name, lambda found: [change(t) if i == order else t for i, t in enumerate(found, 1)]
    )


def drop(chart: Chart, name: str, order: int) -> Chart:
    """One transition removed."""
    return edit_transitions(chart, name, lambda found: [t for i, t in enumerate(found, 1) if i != order])


def guard(chart: Chart, name: str, order: int, change: Callable[[Expr], Expr]) -> Chart:
    """The guard of one transition changed."""

    def changed(segment: Transition) -> Transition:
        if segment.guard is None:
            raise ModelError(f"{chart.name}: transition {order} of {name} has no guard to change.")
        return replace(segment, guard=change(segment.guard))

    return edit_transition(chart, name, order, changed)


def everywhere(expr: Expr, change: Callable[[Expr], Expr]) -> Expr:
    """Every node replaced, innermost first; names stay."""
    match expr:
        case Apply(op, args, sort):
            return change(Apply(op, tuple(everywhere(a, change) for a in args), sort))
        case Named(name, body):
            return Named(name, everywhere(body, change))
        case Temporal(word, arg, span, strict):
            return change(Temporal(word, None if arg is None else everywhere(arg, change), span, strict))
        case _:
            return change(expr)


def instead(name: str, change: Callable[[Expr], Expr]) -> Callable[[Expr], Expr]:
    """Every variable or named formula of that name changed."""

    def walk(expr: Expr) -> Expr:
        match expr:
            case Named(found, body):
                return change(expr) if found == name else Named(found, walk(body))
            case Var(found):
                return change(expr) if found == name else expr
            case Apply(op, args, sort):
                return Apply(op, tuple(walk(a) for a in args), sort)
            case Temporal(word, arg, span, strict):
                return Temporal(word, None if arg is None else walk(arg), span, strict)
            case _:
                return expr

    return walk


def constant(old: Number, new: Number) -> Callable[[Expr], Expr]:
    """Every constant ``old`` becomes ``new``, where the resolution allows it."""

    def change(expr: Expr) -> Expr:
        if not (isinstance(expr, Const) and isinstance(expr.sort, Num)):
            return expr
        if expr.value * expr.sort.resolution != exact(old):
            return expr
        raw = exact(new) / expr.sort.resolution
        if raw.denominator != 1:
            raise ModelError(f"{new} is no multiple of {expr.sort.resolution}, the steps of {expr}.")
        return Const(int(raw), expr.sort)

    return lambda expr: everywhere(expr, change)


def operator(old: Op, new: Op) -> Callable[[Expr], Expr]:
    """Every operator ``old`` becomes ``new``."""

    def change(expr: Expr) -> Expr:
        return Apply(new, expr.args, expr.sort) if isinstance(expr, Apply) and expr.op is old else expr

    return lambda expr: everywhere(expr, change)


def timer(span: Span | None = None, strict: bool | None = None) -> Callable[[Expr], Expr]:
    """Another time, or ``>`` against ``>=``, on a timer."""

    def change(expr: Expr) -> Expr:
        if isinstance(expr, Temporal) and expr.when in (When.AFTER, When.DURATION, When.HELD):
            return replace(
                expr,
                span=expr.span if span is None else span,
                strict=expr.strict if strict is None else strict,
            )
        return expr

    return lambda expr: everywhere(expr, change)


def in_expressions(chart: Chart, change: Callable[[Expr], Expr]) -> Chart:
    """A change made in every guard and action of the chart."""
    return _everything(chart, change, lambda actions: _acts(actions, change))


def in_actions(chart: Chart, change: Callable[[Action], Action]) -> Chart:
    """A change made in every action of the chart; what is inside a conditional is left to the change."""
    return _everything(chart, lambda guard: guard, lambda actions: tuple(map(change, actions)))


def _everything(
    chart: Chart,
    guarded: Callable[[Expr], Expr],
    acts: Callable[[tuple[Action, ...]], tuple[Action, ...]],
) -> Chart:
    def transition(segment: Transition) -> Transition:
        changed = None if segment.guard is None else guarded(segment.guard)
        return replace(segment, guard=changed, do=acts(segment.do), then=acts(segment.then))

    def walk(state: State) -> State:
        return replace(
            state,
            entry=acts(state.entry), during=acts(state.during), exit=acts(state.exit),
            states=tuple(walk(s) for s in state.states),
            transitions=tuple(map(transition, state.transitions)),
            default=tuple(map(transition, state.default)),
            junctions=tuple(Junction(j.name, list(map(transition, j.transitions))) for j in state.junctions),
        )  # fmt: skip

    return chart.with_root(walk(chart.root))


def _acts(actions: tuple[Action, ...], change: Callable[[Expr], Expr]) -> tuple[Action, ...]:
    out: list[Action] = []
    for action in actions:
        if isinstance(action, Assign):
            value = change(action.value)
            same = value.sort == action.value.sort
            new = Assign(action.var, value) if same else assign(action.var, value)
            out.append(kept(action, new))
        elif isinstance(action, If):
            then, otherwise = _acts(action.then, change), _acts(action.otherwise, change)
            out.append(kept(action, If(change(action.condition), then, otherwise)))
        else:
            out.append(action)
    return tuple(out)


def entry(chart: Chart, name: str, change: Callable[[tuple[Action, ...]], tuple[Action, ...]]) -> Chart:
    """The entry actions of a state changed."""
    return edit_state(chart, name, lambda s: replace(s, entry=change(s.entry)))


def in_block(block: Block, change: Callable[[Expr], Expr]) -> Block:
    """A change made in every expression of a function block."""
    return Block(block.name, _acts(block.do, change), text=block.text, place=block.place)


def in_system(system: System, part: str, change: Callable[[Chart | Block], Chart | Block]) -> System:
    """The system with the chart or block of that name changed."""
    hits = 0

    def walk(component: Component) -> Component:
        nonlocal hits
        if isinstance(component, Enabled):
            inside = (walk(c) for c in component.components)
            return Enabled(component.by, *inside, name=component.name)
        if component.name == part:
            hits += 1
            return change(component)
        return component

    changed = replace(system, components=tuple(walk(c) for c in system.components))
    if hits != 1:
        raise ModelError(f"{system.name} has {hits} parts named {part!r}; name one of its charts or blocks.")
    return changed


# The names that these had: what imports them keeps working.
arrow, arrows = edit_transition, edit_transitions
