"""Fixing variables of a model to constants, and what becomes simpler by it.

A model may hold alternatives that a variable chooses between.  Once the variable is fixed, guards
and actions fold, a transition whose guard is false disappears, and the chart is drawn as if the other
alternatives had never been written.  States stay, so that locations mean the same in every variant.
"""

from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

from rovercheck.spec_model.lang.action import Action, Assign, If, kept
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
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.evaluate import operate
from rovercheck.spec_model.lang.expr import (
    FALSE,
    TRUE,
    Apply,
    Const,
    Expr,
    Named,
    Temporal,
    Var,
    When,
    all_of,
    any_of,
)
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import variables

T = TypeVar("T")


class Specialiser:
    """Replaces variables by constants in formulas, charts and systems; what does not change stays itself.

    A variable may also be replaced by another, of another domain or name, wherever it is read or written.
    """

    def __init__(self, values: Mapping[str, Const | Var]) -> None:
        self.values = dict(values)
        self._done: dict[int, tuple[Expr, Expr]] = {}
        self._charts: dict[int, tuple[Chart, Chart]] = {}

    # --- formulas ------------------------------------------------------------------------------

    def expr(self, expr: Expr) -> Expr:
        """The formula with the variables fixed, folded where that makes it constant."""
        known = self._done.get(id(expr))
        if known is None:
            known = self._done[id(expr)] = (expr, self._expr(expr))
        return known[1]

    def _expr(self, expr: Expr) -> Expr:
        match expr:
            case Var(name):
                return self.values.get(name, expr)
            case Named(name, body):
                inside = self.expr(body)
                if inside is body or isinstance(inside, Const):
                    return expr if inside is body else inside
                return Named(name, inside)
            case Temporal(_, arg, _, _) if arg is not None:
                inside = self.expr(arg)
                return expr if inside is arg else _temporal(replace(expr, arg=inside))
            case Apply(_, args, _):
                changed = tuple(self.expr(a) for a in args)
                same = all(a is b for a, b in zip(args, changed, strict=True))
                return expr if same else _fold(replace(expr, args=changed))
        return expr

    # --- actions and transitions ----------------------------------------------------------------------

    def actions(self, actions: Sequence[Action]) -> tuple[Action, ...]:
        return tuple(made for action in actions for made in self._action(action))

    def _action(self, action: Action) -> tuple[Action, ...]:
        match action:
            case Assign(var, value):
                return (kept(action, Assign(self._declared(var), self.expr(value))),)
            case If(condition, then, otherwise):
                test = self.expr(condition)
                if isinstance(test, Const) and test is not condition:
                    return self.actions(then if test.value else otherwise)
                branches = self.actions(then), self.actions(otherwise)
                return (kept(action, If(test, *branches)),) if any(branches) else ()
        return (action,)

    def _declared(self, var: Var) -> Var:
        """What is written in place of a variable: itself, also where its value is fixed."""
        found = self.values.get(var.name)
        return found if isinstance(found, Var) else var

    def transitions(self, transitions: Sequence[Transition]) -> tuple[Transition, ...]:
        """The transitions that can still be taken."""
        made = (self._transition(transition) for transition in transitions)
        return tuple(transition for transition in made if transition is not None)

    def _transition(self, transition: Transition) -> Transition | None:
        guard = None if transition.guard is None else self.expr(transition.guard)
        if guard is not transition.guard and isinstance(guard, Const):
            if not guard.value:
                return None
            guard = None
        return replace(
            transition, guard=guard, do=self.actions(transition.do), then=self.actions(transition.then)
        )

    # --- components --------------------------------------------------------------------------------

    def component(self, component: Component) -> Component | None:
        """The component, or nothing when nothing is left of a block or of an enabled subsystem."""
        match component:
            case Chart():
                occur = self._occur(component.expressions) or self._written(component.written)
                return self.chart(component) if occur else component
            case Block():
                occur = not self.values.keys().isdisjoint(component.read) or self._written(component.written)
                if component.do and not occur:
                    return component
                do = self.actions(component.do)
                return Block(component.name, do, text=component.text) if do else None
            case Enabled():
                return self._enabled(component)

    def components(self, components: Sequence[Component]) -> tuple[Component, ...]:
        made = (self.component(component) for component in components)
        return tuple(component for component in made if component is not None)

    def _enabled(self, enabled: Enabled) -> Component | None:
        by, inside = self.expr(enabled.by), self.components(enabled.components)
        never, always = (isinstance(by, Const) and bool(by.value) is known for known in (False, True))
        if never or not inside:
            return None
        if always and len(inside) == 1 and not enabled.name:
            return inside[0]
        return Enabled(by, *inside, name=enabled.name)

    def chart(self, chart: Chart) -> Chart:
        """The chart with the variables fixed: one chart for one chart, whatever systems hold it."""
        known = self._charts.get(id(chart))
        if known is None:
            known = self._charts[id(chart)] = (chart, self._chart(chart))
        return known[1]

    def _chart(self, chart: Chart) -> Chart:
        local = [(self._declared(data), owners) for data, owners in chart.local_to]
        made = _chart(chart, self._state(chart.root), local)
        return _chart(chart, _without(made.root, _reached(chart) - _reached(made)), local)

    def _state(self, state: State) -> State:
        return State(
            state.name,
            entry=self.actions(state.entry),
            during=self.actions(state.during),
            exit=self.actions(state.exit),
            states=[self._state(inner) for inner in state.states],
            transitions=self.transitions(state.transitions),
            junctions=[Junction(j.name, self.transitions(j.transitions)) for j in state.junctions],
            default=self.transitions(state.default),
            parallel=state.parallel,
            place=state.place,
        )

    def _occur(self, exprs: Sequence[Expr]) -> bool:
        return not self.values.keys().isdisjoint(variables(*exprs))

    def _written(self, written: Mapping[str, Var]) -> bool:
        return any(isinstance(self.values.get(name), Var) for name in written)

    def system(self, system: System) -> System:
        """The system with the variables fixed; they are no longer frozen variables of it."""
        fixed = {name for name, value in self.values.items() if isinstance(value, Const)}
        return replace(
            system,
            components=self.components(system.components),
            frozen=tuple(self._declared(v) for v in system.frozen if v.name not in fixed),
            elapsed=None if system.elapsed is None else self._declared(system.elapsed),
            assume=self.expr(system.assume),
            assumptions=tuple(replace(a, formula=self.expr(a.formula)) for a in system.assumptions),
        )

    def parts_of(self, record: T) -> T:
        """A frozen dataclass with every formula in its fields fixed (a form of a property, say)."""
        if not is_dataclass(record) or isinstance(record, type):
            return record
        changed: dict[str, Any] = {}
        for field in fields(record):
            value = getattr(record, field.name)
            changed[field.name] = self._part(value)
        return replace(record, **changed)

    def _part(self, value: object) -> object:
        if isinstance(value, Expr):
            return self.expr(value)
        if isinstance(value, tuple) and any(isinstance(v, Expr) for v in value):
            return tuple(self._part(v) for v in value)
        return value


def _chart(chart: Chart, root: State, local: Sequence[tuple[Var, Sequence[str]]]) -> Chart:
    """The chart with another outermost level; data that no longer occur are forgotten."""
    made = Chart(
        chart.name,
        root.states,
        default=root.default,
        junctions=root.junctions,
        parallel=root.parallel,
        text=chart.text,
        place=root.place,
    )
    used = made.read | made.written
    return made.with_local_data([(data, owners) for data, owners in local if data.name in used])


def _reached(chart: Chart) -> set[Path]:
    """The junctions that some transition from a state, or from another such junction, leads to."""
    found: set[Path] = set()
    stack = [
        (level, t)
        for path, state in chart.states.items()
        for level, transitions in ((path[:-1], state.transitions), (path, state.default))
        for t in transitions
    ]
    while stack:
        level, transition = stack.pop()
        target = chart.resolve(level, transition.target)
        if target in chart.junctions and target not in found:
            found.add(target)
            stack += [(target[:-1], t) for t in chart.junctions[target].transitions]
    return found


def _without(state: State, dead: set[Path], path: Path = ()) -> State:
    """The state without some junctions in it."""
    return State(
        state.name,
        entry=state.entry,
        during=state.during,
        exit=state.exit,
        states=[_without(inner, dead, (*path, inner.name)) for inner in state.states],
        transitions=state.transitions,
        junctions=[j for j in state.junctions if (*path, j.name) not in dead],
        default=state.default,
        parallel=state.parallel,
        place=state.place,
    )


def _temporal(word: Temporal) -> Expr:
    """``held(false)`` and the like never come true; ``once(true)`` always is."""
    if isinstance(word.arg, Const) and isinstance(word.arg.sort, Bool):
        if not word.arg.value and word.when in (When.HELD, When.DURATION, When.RISING, When.ONCE):
            return FALSE
        if word.arg.value and word.when is When.ONCE:
            return TRUE
    return word


def _fold(apply: Apply) -> Expr:
    """An operator some of whose arguments may have become constants."""
    args = apply.args
    match apply.op:
        case Op.AND | Op.OR:
            return _junction(apply.op, args)
        case Op.ITE if isinstance(args[0], Const):
            return args[1] if args[0].value else args[2]
    if all(isinstance(a, Const) for a in args):
        return Const(operate(apply.op, *(a.value for a in args if isinstance(a, Const))), apply.sort)
    return apply


def _junction(op: Op, args: Sequence[Expr]) -> Expr:
    """A conjunction or disjunction without the constants in it."""
    absorbing = 0 if op is Op.AND else 1
    if any(isinstance(a, Const) and a.value == absorbing for a in args):
        return FALSE if op is Op.AND else TRUE
    rest = [a for a in args if not isinstance(a, Const)]
    return all_of(*rest) if op is Op.AND else any_of(*rest)
