"""Changes of a chart or block that say what they replace, and raise ``ModelError`` where that is gone.

Each is made with what it changes, then applied to the part: ``guards("decide", "Temp_CRIT", wider)(chart)``.
A transition is known by its ends, an assignment by its variable and a formula by itself, so that changes can
follow each other: none counts the transitions that another one may have added.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar, cast

from rovercheck.spec_model.lang.action import Action, Assign, If, assign, expressions, kept
from rovercheck.spec_model.lang.chart import Block, Chart, State, Transition
from rovercheck.spec_model.lang.edit import (
    begin,
    edit_state,
    edit_transitions,
    in_actions,
    in_block,
    in_expressions,
)
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import TRUE, Apply, Expr, Named, Operand, Temporal, Var, When
from rovercheck.spec_model.lang.walk import Shapes, nodes

Part = TypeVar("Part", bound=Chart | Block)
Rule = Callable[[Expr], Expr]
Rewrite = Callable[[tuple[Action, ...]], tuple[Action, ...]]

_shape = Shapes()

ENTERED = ""
"""The source of the transition that a chart takes in its first execution."""


def formula(old: Expr | str, new: Expr | Rule) -> Callable[[Part], Part]:
    """Another formula wherever ``old`` occurs; see ``formulas``."""
    return formulas((old, new))


def formulas(*pairs: tuple[Expr | str, Expr | Rule]) -> Callable[[Part], Part]:
    """Other formulas wherever the first of a pair occurs, all at once, in guards and actions.

    A named formula is known by its name, which is enough to write, any other by how it is built.  The new
    one may be a rule that gets the old one as it stands there.
    """

    def change(part: Part) -> Part:
        swap = _Swap(pairs)
        changed = in_expressions(part, swap) if isinstance(part, Chart) else in_block(part, swap)
        swap.check(part.name)
        return cast(Part, changed)

    return change


def inside(old: Expr | str, new: Expr | Rule) -> Rule:
    """The same change as a rule, for one guard or value."""

    def rule(expr: Expr) -> Expr:
        swap = _Swap([(old, new)])
        changed = swap(expr)
        swap.check(f"`{expr}`")
        return changed

    return rule


def constantly(new: Expr) -> Rule:
    """This formula, whatever stands there."""
    return lambda _: new


def at_once(wait: Expr) -> Expr:
    """The condition of a duration without the time that it must last."""
    condition = _duration(wait).arg
    assert condition is not None
    return condition


def lasting(change: Rule) -> Rule:
    """Another condition that must last as long."""
    return lambda wait: replace(_duration(wait), arg=change(at_once(wait)))


def _duration(wait: Expr) -> Temporal:
    if isinstance(wait, Temporal) and wait.when is When.DURATION:
        return wait
    raise ModelError(f"`{wait}` is no duration.")


class _Swap:
    """A rule that puts other formulas in place of some, and knows which of them it met."""

    def __init__(self, pairs: Sequence[tuple[Expr | str, Expr | Rule]]) -> None:
        self._pairs = {_key(old): (old, new) for old, new in pairs}
        self._met: set[object] = set()

    def __call__(self, expr: Expr) -> Expr:
        key = _key(expr)
        if key in self._pairs:
            self._met.add(key)
            _, new = self._pairs[key]
            return new if isinstance(new, Expr) else new(expr)
        match expr:
            case Named(name, body) if (inside := self(body)) is not body:
                return Named(name, inside)
            case Temporal(arg=Expr() as arg) if (inside := self(arg)) is not arg:
                return replace(expr, arg=inside)
            case Apply(args=args):
                changed = tuple(map(self, args))
                if any(a is not b for a, b in zip(args, changed, strict=True)):
                    return replace(expr, args=_as_before(expr, changed))
        return expr

    def check(self, where: str) -> None:
        """Raises ``ModelError`` for a formula that was not met."""
        for key, (old, _) in self._pairs.items():
            if key not in self._met:
                raise ModelError(f"{where} has no formula `{old}` any more.")


def _key(expr: Expr | str) -> object:
    match expr:
        case str():
            return expr
        case Named(name):
            return name
    return _shape(expr)


def _as_before(apply: Apply, args: tuple[Expr, ...]) -> tuple[Expr, ...]:
    for old, new in zip(apply.args, args, strict=True):
        if old.sort != new.sort:
            raise ModelError(f"`{new}` is counted in other steps than `{old}`; change all of `{apply}`.")
    return args


def guards(source: str, target: str, change: Rule) -> Callable[[Chart], Chart]:
    """Another guard on every transition from a state or junction to the target; one without has TRUE.

    ``ENTERED`` is the source of the default transitions of the outermost level.
    """

    def guarded(found: list[Transition]) -> list[Transition]:
        _one_of(found, source, target)
        return [replace(t, guard=change(_guard(t))) if t.target == target else t for t in found]

    def changed(chart: Chart) -> Chart:
        if source == ENTERED:
            return begin(chart, guarded(list(chart.root.default)))
        return edit_transitions(chart, source, guarded)

    return changed


def guard_of(chart: Chart, source: str, target: str) -> Expr:
    """The guard of the transition from a state or junction to the target."""
    return _guard(transition_of(chart, source, target))


def transition_of(chart: Chart, source: str, target: str) -> Transition:
    """The transition from a state or junction to the target."""
    found: list[Transition] = []

    def look(drawn: list[Transition]) -> list[Transition]:
        found.extend(drawn)
        return drawn

    edit_transitions(chart, source, look)
    return _one_of(found, source, target)


def _guard(transition: Transition) -> Expr:
    return TRUE if transition.guard is None else transition.guard


def _one_of(found: Sequence[Transition], source: str, target: str) -> Transition:
    for transition in found:
        if transition.target == target:
            return transition
    raise ModelError(f"No transition leads from {source or 'outside'} to {target} any more.")


def without(source: str, target: str) -> Callable[[Chart], Chart]:
    """No transition from a state or junction to the target."""

    def others(found: list[Transition]) -> list[Transition]:
        _one_of(found, source, target)
        return [t for t in found if t.target != target]

    return lambda chart: edit_transitions(chart, source, others)


def doing(source: str, target: str, change: Rewrite) -> Callable[[Chart], Chart]:
    """Other condition actions on every transition from a state or junction to the target."""

    def changed(found: list[Transition]) -> list[Transition]:
        _one_of(found, source, target)
        return [replace(t, do=change(t.do)) if t.target == target else t for t in found]

    return lambda chart: edit_transitions(chart, source, changed)


def in_state(
    name: str, *, entry: Rewrite | None = None, during: Rewrite | None = None, exit: Rewrite | None = None
) -> Callable[[Chart], Chart]:
    """Other actions of a state: ``in_state("MoveToS2", entry=then(note), exit=then(forget))``."""

    def change(state: State) -> State:
        return replace(
            state,
            entry=state.entry if entry is None else entry(state.entry),
            during=state.during if during is None else during(state.during),
            exit=state.exit if exit is None else exit(state.exit),
        )

    return lambda chart: edit_state(chart, name, change)


def then(*more: Action) -> Rewrite:
    """More actions after those drawn."""
    return lambda drawn: (*drawn, *more)


def before(*more: Action) -> Rewrite:
    """More actions before those drawn."""
    return lambda drawn: (*more, *drawn)


def assigned(var: Var, change: Callable[[Expr], Operand]) -> Callable[[Part], Part]:
    """Another value wherever ``var`` is assigned, given the present one."""

    def changed(part: Part) -> Part:
        def action(old: Action) -> Action:
            match old:
                case Assign(Var(name), value) if name == var.name:
                    return assign(var, change(value))
                case If(condition, inside, outside):
                    return kept(old, If(condition, tuple(map(action, inside)), tuple(map(action, outside))))
            return old

        if var.name not in part.written:
            raise ModelError(f"{part.name} does not assign {var.name} any more.")
        if isinstance(part, Chart):
            return cast(Part, in_actions(part, action))
        return cast(Part, Block(part.name, [*map(action, part.do)], text=part.text, place=part.place))

    return changed


def formula_of(part: Chart | Block, name: str) -> Named:
    """The named formula as it stands in the part."""
    roots = part.expressions if isinstance(part, Chart) else expressions(part.do)
    for node in nodes(*roots):
        if isinstance(node, Named) and node.name == name:
            return node
    raise ModelError(f"{part.name} has no formula `{name}` any more.")
