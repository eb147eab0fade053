"""Slips in lists of actions: one that is missing, a wrong value, a wrong field, a slip in a formula."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from checker.mutate.formulas import other, slips
from spec_model.lang.action import Action, Assign, If, each_action
from spec_model.lang.domain import Bool
from spec_model.lang.expr import Apply, Const, Expr, Var
from spec_model.lang.operators import Op
from spec_model.lang.walk import plain

Actions = tuple[Action, ...]


@dataclass(frozen=True)
class ActionSlip:
    """Actions with a fault in one of them: the operator, the fault in words, and all the actions."""

    operator: str
    text: str
    whole: Actions


def paired(actions: Sequence[Action]) -> dict[int, Var]:
    """For assignments of a variable to a variable, by ``id``, what the next such one of their domain assigns.

    These are fields of frames that may be taken for each other.
    """
    copies = [
        (a, value)
        for a in each_action(actions)
        if isinstance(a, Assign) and isinstance(value := plain(a.value), Var)
    ]
    found: dict[int, Var] = {}
    for place, (action, value) in enumerate(copies):
        for _, candidate in (*copies[place + 1 :], *copies[:place]):
            if candidate.name != value.name and candidate.domain == value.domain:
                found[id(action)] = candidate
                break
    return found


def action_slips(actions: Sequence[Action], step_ms: int, fields: Mapping[int, Var]) -> Iterator[ActionSlip]:
    """Every slip in actions; ``fields`` as ``paired`` tells them."""
    for place, action in enumerate(actions):
        before, after = tuple(actions[:place]), tuple(actions[place + 1 :])
        yield ActionSlip("action-missing", f"`{action}` is missing", (*before, *after))
        for operator, text, changed in _of_one(action, step_ms, fields):
            yield ActionSlip(operator, text, (*before, changed, *after))


def _of_one(action: Action, step_ms: int, fields: Mapping[int, Var]) -> Iterator[tuple[str, str, Action]]:
    if isinstance(action, Assign):
        for value in _values(action, fields):
            operator, new = value
            changed = replace(action, value=new)
            yield operator, f"`{action}` is `{changed}`", changed
        for slip in slips(action.value, step_ms):
            yield slip.operator, f"in `{action}`, {slip.text}", replace(action, value=slip.whole)
    elif isinstance(action, If):
        negated = Apply(Op.NOT, (action.condition,), Bool())
        yield "condition-negated", f"`if {action.condition}` is negated", replace(action, condition=negated)
        for slip in slips(action.condition, step_ms):
            yield slip.operator, f"in an `if`, {slip.text}", replace(action, condition=slip.whole)
        for inner in action_slips(action.then, step_ms, fields):
            yield inner.operator, inner.text, replace(action, then=inner.whole)
        for inner in action_slips(action.otherwise, step_ms, fields):
            yield inner.operator, inner.text, replace(action, otherwise=inner.whole)


def _values(action: Assign, fields: Mapping[int, Var]) -> Iterator[tuple[str, Expr]]:
    value = plain(action.value)
    if isinstance(value, Const):
        changed = other(value)
        if changed is not None and changed.value not in action.var.domain:
            changed = Const(value.value - 1, value.sort)
        if changed is not None and changed.value in action.var.domain:
            yield "value", changed
    elif isinstance(value.sort, Bool):
        yield "value", Apply(Op.NOT, (value,), Bool())
    if id(action) in fields:
        yield "field", fields[id(action)]


__all__ = ["ActionSlip", "Actions", "action_slips", "paired"]
