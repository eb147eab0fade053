"""Actions: assignments, conditionals and directed sends of local events."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Union

from rovercheck.spec_model.lang.domain import Bool, Num, in_resolution, show
from rovercheck.spec_model.lang.errors import ModelError, brief, several, with_article
from rovercheck.spec_model.lang.expr import Const, Expr, Operand, Var, lift, rescale
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.walk import variables


@dataclass(frozen=True)
class Assign:
    """``var := value``, done at once; later actions see the new value."""

    var: Var
    value: Expr

    @cached_property
    def read(self) -> frozenset[str]:
        """The names of the variables that its value speaks of."""
        return frozenset(variables(self.value))

    @property
    def read_inside(self) -> frozenset[str]:
        """The same: it has no actions inside."""
        return self.read

    @cached_property
    def written(self) -> frozenset[str]:
        """The name of its variable."""
        return frozenset({self.var.name})

    def __str__(self) -> str:
        return f"{self.var.name} := {text(self.value)}"


@dataclass(frozen=True)
class If:
    """Run ``then`` where the condition holds now, ``otherwise`` elsewhere."""

    condition: Expr
    then: tuple["Action", ...]
    otherwise: tuple["Action", ...] = ()

    @cached_property
    def read(self) -> frozenset[str]:
        """The names of the variables that its condition speaks of, without those of its actions."""
        return frozenset(variables(self.condition))

    @cached_property
    def read_inside(self) -> frozenset[str]:
        """The names of the variables that it or its actions may read."""
        return self.read.union(*(a.read_inside for a in self._inner))

    @cached_property
    def written(self) -> frozenset[str]:
        """The names of all variables that its actions may write."""
        return frozenset[str]().union(*(a.written for a in self._inner))

    @property
    def _inner(self) -> Iterator["Assign | If"]:
        return (a for a in (*self.then, *self.otherwise) if not isinstance(a, Send))

    def __str__(self) -> str:
        shown = f"if {text(self.condition)} {{{'; '.join(map(str, as_calls(self.then)))}}}"
        if not self.otherwise:
            return shown
        return f"{shown} else {{{'; '.join(map(str, as_calls(self.otherwise)))}}}"


@dataclass(frozen=True)
class Send:
    """``send(event, receiver)``: the receiving state is executed at once with the event (rule G10)."""

    event: str
    receiver: str

    def __str__(self) -> str:
        return f"send({self.event}, {self.receiver})"


Action = Union[Assign, If, Send]


def assign(var: Var, value: Operand | str) -> Assign:
    """``assign(v_ref, 0)``.  Raises ``ModelError`` where the sorts do not fit."""
    if not isinstance(var, Var):
        raise ModelError(f"assign() takes a variable, made with var() or flag(), and not {brief(var)}.")
    expr = lift(value, var.sort)
    fits = type(expr.sort) is type(var.sort) and (isinstance(expr.sort, Num | Bool) or expr.sort == var.sort)
    if not fits:
        raise ModelError(
            f"{var.name} is {with_article(var.sort)} and cannot take `{expr}`, {with_article(expr.sort)}."
        )
    if isinstance(expr.sort, Num) and isinstance(var.sort, Num) and expr.sort.unit != var.sort.unit:
        raise ModelError(
            f"{var.name} is in {var.sort.unit or 'no unit'} and `{expr}` in "
            f"{expr.sort.unit or 'no unit'}; convert with a factor that has a unit."
        )
    return Assign(var, _in_steps_of(var, expr))


def _in_steps_of(var: Var, expr: Expr) -> Expr:
    if not (isinstance(expr.sort, Num) and isinstance(var.sort, Num)):
        return expr
    raw = expr.value if isinstance(expr, Const) else 1
    if in_resolution(raw, expr.sort.resolution, var.sort.resolution) is None:
        raise ModelError(
            f"{var.name} has steps of {show(var.sort.resolution)} and `{expr}` steps of "
            f"{show(expr.sort.resolution)}; give {var.name} a resolution that divides both."
        )
    return rescale(expr, var.sort)


def when(condition: Expr, then: Sequence[Action], otherwise: Sequence[Action] = ()) -> If:
    """A conditional action."""
    return If(condition, several("when()", "then", then), several("when()", "otherwise", otherwise))


def send(event: str, receiver: str) -> Send:
    """A directed send of a local event to a state of the same chart, by name."""
    return Send(event, receiver)


@dataclass(frozen=True, eq=False)
class ActionCall:
    """Actions that a chart shows as one, under the name of what does them."""

    name: str
    actions: tuple[Action, ...]

    def __str__(self) -> str:
        return self.name


_CALL = "call"
"""Where an action keeps the call that it is part of: nobody but printers reads it."""


def shared_actions(name: str, actions: Sequence[Action]) -> tuple[Action, ...]:
    """Actions that several places of a chart share, which it shows as ``name``, such as ``reset(timer)``.

    They do what they do without the name; where only some of them are left, they are shown one by one.
    """
    made = tuple(replace(action) for action in several(f"shared_actions({name!r}, ...)", "actions", actions))
    call = ActionCall(name, made)
    for number, action in enumerate(made):
        action.__dict__[_CALL] = call, number
    return made


def call_of(action: Action) -> ActionCall | None:
    """The shared actions that an action is part of."""
    call: ActionCall | None = action.__dict__.get(_CALL, (None, 0))[0]
    return call


def kept(old: Action, new: Action) -> Action:
    """What a change has made of an action: still part of what is shared, if a chart shows it as before."""
    if _CALL in old.__dict__ and str(new) == str(old):
        new.__dict__[_CALL] = old.__dict__[_CALL]
    return new


def as_calls(actions: Sequence[Action]) -> tuple["Action | ActionCall", ...]:
    """The actions as they are shown: what is shared, and is there as a whole, under its name."""
    shown, at = list[Action | ActionCall](), 0
    while at < len(actions):
        call = call_of(actions[at])
        count = len(call.actions) if call else 1
        part = [action.__dict__.get(_CALL) for action in actions[at : at + count]]
        whole = call is not None and part == [(call, number) for number in range(count)]
        shown.append(call if call and whole else actions[at])
        at += count if whole else 1
    return tuple(shown)


def each_action(actions: Sequence[Action]) -> Iterator[Action]:
    """Every action, inside conditionals too."""
    for action in actions:
        yield action
        if isinstance(action, If):
            yield from each_action(action.then)
            yield from each_action(action.otherwise)


def reads(actions: Sequence[Action]) -> dict[str, Var]:
    """Variables read by the actions, by name."""
    found: dict[str, Var] = {}
    for action in each_action(actions):
        if isinstance(action, Assign):
            found |= variables(action.value)
        elif isinstance(action, If):
            found |= variables(action.condition)
    return found


def writes(actions: Sequence[Action]) -> dict[str, Var]:
    """Variables written by the actions, by name."""
    return {a.var.name: a.var for a in each_action(actions) if isinstance(a, Assign)}


def expressions(actions: Sequence[Action]) -> Iterator[Expr]:
    """Every expression that occurs in the actions."""
    for action in each_action(actions):
        if isinstance(action, Assign):
            yield action.value
        elif isinstance(action, If):
            yield action.condition
