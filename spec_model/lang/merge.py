"""Two forms of a chart in one: as it was changed where a condition holds, as it was drawn elsewhere.

Where the forms agree the drawing stays as it is.  The rest is told apart as close to the difference as
it can be: at the argument of an operator, the guard of a transition, one action of a list.  Once the
condition is fixed, ``specialise`` leaves one form and no trace of the other.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from difflib import SequenceMatcher
from operator import is_
from typing import TypeVar

from rovercheck.spec_model.lang.action import Action, Assign, If, Send, kept, when
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, Junction, State, Transition
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Named, Temporal, all_of, any_of, ite
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import Shapes

T = TypeVar("T")
Key = tuple[object, ...]

shape = Shapes()
"""What is compared of formulas."""


class Merge:
    """Parts that were changed where ``condition`` holds, each merged with the part as drawn."""

    def __init__(self, condition: Expr) -> None:
        self.condition = condition

    # --- formulas ------------------------------------------------------------------------------------

    def formula(self, changed: Expr, drawn: Expr) -> Expr:
        """``drawn`` itself where both mean the same."""
        if changed is drawn or shape(changed) == shape(drawn):
            return drawn
        match changed, drawn:
            case Named(name, new), Named(same, old) if name == same:
                return Named(name, self.formula(new, old))
            case Temporal(arg=Expr() as new), Temporal(arg=Expr() as old) if _counts_alike(changed, drawn):
                return replace(drawn, arg=self.formula(new, old))
        for op in (Op.AND, Op.OR):
            new_args, old_args = _args(op, changed), _args(op, drawn)
            if not set(map(shape, new_args)).isdisjoint(map(shape, old_args)):
                return self._joined(op, new_args, old_args)
        if isinstance(changed, Apply) and isinstance(drawn, Apply) and _built_alike(changed, drawn):
            return replace(drawn, args=tuple(map(self.formula, changed.args, drawn.args)))
        return ite(self.condition, changed, drawn)

    def _joined(self, op: Op, changed: Sequence[Expr], drawn: Sequence[Expr]) -> Expr:
        """Conditions joined by ``op``; one that a single form has is neutral in the other."""
        merged: list[Expr] = []
        for new, old in _aligned(changed, drawn, shape):
            if len(new) == len(old):
                merged += map(self.formula, new, old)
            elif op is Op.AND:
                merged += [any_of(~self.condition, n) for n in new]
                merged += [any_of(self.condition, o) for o in old]
            else:
                merged += [all_of(self.condition, n) for n in new]
                merged += [all_of(~self.condition, o) for o in old]
        if op is Op.AND:
            return all_of(*(m for m in merged if m is not TRUE))
        return any_of(*merged)

    # --- actions and transitions --------------------------------------------------------------------------

    def actions(self, changed: Sequence[Action], drawn: Sequence[Action]) -> tuple[Action, ...]:
        """``drawn``, with what differs in conditional actions."""
        if changed is drawn or [*map(_action_key, changed)] == [*map(_action_key, drawn)]:
            return tuple(drawn)
        merged: list[Action] = []
        for new, old in _aligned(changed, drawn, _action_key):
            if len(new) == len(old) and all(map(_writes_alike, new, old)):
                merged += map(self._action, new, old)
            elif new:
                merged.append(when(self.condition, new, old))
            else:
                merged.append(when(~self.condition, old))
        return tuple(merged)

    def _action(self, changed: Action, drawn: Action) -> Action:
        match changed, drawn:
            case Assign(_, new), Assign(var, old):
                return kept(drawn, Assign(var, self.formula(new, old)))
            case If(new, then, other), If(old, inside, outside):
                branches = self.actions(then, inside), self.actions(other, outside)
                return kept(drawn, If(self.formula(new, old), *branches))
        return drawn

    def arrows(self, changed: Sequence[Transition], drawn: Sequence[Transition]) -> tuple[Transition, ...]:
        """``drawn``; a transition that only one form has, has the condition in its guard, or its negation."""
        if changed is drawn or [*map(_arrow_key, changed)] == [*map(_arrow_key, drawn)]:
            return tuple(drawn)
        merged: list[Transition] = []
        for new, old in _aligned(changed, drawn, _arrow_key):
            if len(new) == len(old) and all(map(_leads_alike, new, old)):
                merged += map(self._arrow, new, old)
            else:
                merged += [_only_if(self.condition, arrow) for arrow in new]
                merged += [_only_if(~self.condition, arrow) for arrow in old]
        return tuple(merged)

    def _arrow(self, changed: Transition, drawn: Transition) -> Transition:
        if changed is drawn or _arrow_key(changed) == _arrow_key(drawn):
            return drawn
        guard = self.formula(_guard(changed), _guard(drawn))
        return replace(
            drawn,
            guard=None if guard is TRUE else guard,
            do=self.actions(changed.do, drawn.do),
            then=self.actions(changed.then, drawn.then),
        )

    # --- states, charts and blocks -------------------------------------------------------------------

    def state(self, changed: State, drawn: State) -> State:
        """``drawn`` with what differs.  Raises ``ModelError`` for other states inside: no form adds any."""
        if changed is drawn:
            return drawn
        if [s.name for s in changed.states] != [s.name for s in drawn.states]:
            raise ModelError(
                f"{drawn.name} would have other states; change its transitions and actions only."
            )
        before = {j.name: j for j in drawn.junctions}
        junctions = [
            Junction(j.name, self.arrows(j.transitions, before.pop(j.name, j).transitions))
            for j in changed.junctions
        ]
        merged = replace(
            drawn,
            entry=self.actions(changed.entry, drawn.entry),
            during=self.actions(changed.during, drawn.during),
            exit=self.actions(changed.exit, drawn.exit),
            states=tuple(map(self.state, changed.states, drawn.states)),
            transitions=self.arrows(changed.transitions, drawn.transitions),
            junctions=(*junctions, *before.values()),
            default=self.arrows(changed.default, drawn.default),
        )
        return drawn if _is_same(merged, drawn) else merged

    def components(self, changed: Component | Sequence[Component], drawn: Component) -> tuple[Component, ...]:
        """What becomes of a part: itself changed, in a subsystem of its own, or with blocks beside it.

        Raises ``ModelError`` where it would become something else.
        """
        match changed, drawn:
            case (Chart(), Chart()) | (Block(), Block()) | (Enabled(), Enabled()) if changed is drawn:
                return (drawn,)
            case Chart(), Chart():
                root = self.state(changed.root, drawn.root)
                return (drawn if root is drawn.root else drawn.with_root(root),)
            case Block(), Block() if changed.name == drawn.name:
                do = self.actions(changed.do, drawn.do)
                same = do is drawn.do
                return (drawn if same else Block(drawn.name, do, text=drawn.text, place=drawn.place),)
            case Enabled(), Enabled() if changed.components == drawn.components:
                by = self.formula(changed.by, drawn.by)
                made = Enabled(by, *drawn.components, name=drawn.name, place=drawn.place)
                return (drawn if by is drawn.by else made,)
            case Enabled(components=(inside,)), _ if inside is drawn:
                return (Enabled(any_of(~self.condition, changed.by), drawn, place=changed.place),)
            case Block(), _:
                do = (when(self.condition, changed.do),)
                return (Block(changed.name, do, text=changed.text, place=changed.place),)
            case tuple(), _:
                return tuple(made for part in changed for made in self.components(part, drawn))
        raise ModelError(f"{drawn} would become {changed}; change what is inside it, or add a block.")


def _aligned(
    changed: Sequence[T], drawn: Sequence[T], key: Callable[[T], object]
) -> Iterator[tuple[Sequence[T], Sequence[T]]]:
    """Both lists in pieces: what they have in common, one by one, and what differs."""
    matcher = SequenceMatcher(None, [*map(key, changed)], [*map(key, drawn)], autojunk=False)
    for how, new, new_end, old, old_end in matcher.get_opcodes():
        if how == "equal":
            yield from (((c,), (d,)) for c, d in zip(changed[new:new_end], drawn[old:old_end], strict=True))
        else:
            yield changed[new:new_end], drawn[old:old_end]


def _is_same(one: State, other: State) -> bool:
    """Whether nothing in them is another object, names aside."""
    lists = ("entry", "during", "exit", "states", "transitions", "default")
    pairs = [(getattr(one, name), getattr(other, name)) for name in lists]
    pairs += [(a.transitions, b.transitions) for a, b in zip(one.junctions, other.junctions, strict=False)]
    return len(one.junctions) == len(other.junctions) and all(
        len(a) == len(b) and all(map(is_, a, b)) for a, b in pairs
    )


def _args(op: Op, expr: Expr) -> tuple[Expr, ...]:
    """The conditions that ``op`` joins in it: itself, where it is built otherwise."""
    return expr.args if isinstance(expr, Apply) and expr.op is op else (expr,)


def _counts_alike(one: Temporal, other: Temporal) -> bool:
    return (one.when, one.span, one.strict) == (other.when, other.span, other.strict)


def _built_alike(one: Apply, other: Apply) -> bool:
    """Whether they differ inside their arguments only: none is another constant, or of another sort."""
    if one.op is not other.op or one.op in (Op.AND, Op.OR) or len(one.args) != len(other.args):
        return False
    pairs = [(a, b) for a, b in zip(one.args, other.args, strict=True) if shape(a) != shape(b)]
    return all(a.sort == b.sort and not (isinstance(a, Const) and isinstance(b, Const)) for a, b in pairs)


def _guard(arrow: Transition) -> Expr:
    return TRUE if arrow.guard is None else arrow.guard


def _only_if(condition: Expr, arrow: Transition) -> Transition:
    return replace(arrow, guard=condition if arrow.guard is None else all_of(condition, arrow.guard))


def _action_key(action: Action) -> Key:
    match action:
        case Assign(var, value):
            return (var.name, shape(value))
        case If(condition, then, otherwise):
            return (shape(condition), *map(_action_key, then), None, *map(_action_key, otherwise))
        case Send(event, receiver):
            return ("send", event, receiver)


def _writes_alike(one: Action, other: Action) -> bool:
    """Whether both are the same kind of action, an assignment one to the same variable."""
    match one, other:
        case Assign(var), Assign(same):
            return var.name == same.name
        case Send(), Send():
            return one == other
    return isinstance(one, If) and isinstance(other, If)


def _arrow_key(arrow: Transition) -> Key:
    actions = (*map(_action_key, arrow.do), None, *map(_action_key, arrow.then))
    return (arrow.target, arrow.event, shape(_guard(arrow)), *actions)


def _leads_alike(one: Transition, other: Transition) -> bool:
    return (one.target, one.event) == (other.target, other.event)
