"""Every formula of a chart or block with its place, and the part with another formula in it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from rovercheck.checker.mutate.charts import TransitionList, transition_lists
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart, Path
from rovercheck.spec_model.lang.edit import edit_at
from rovercheck.spec_model.lang.expr import Apply, Expr, Named, Temporal

Put = Callable[[Any], Chart | Block]
"""Makes the part with something else in one place."""


@dataclass(frozen=True)
class FormulaPlace:
    """A guard, a condition or an assigned value.

    ``site`` is named as in the ids of mutants; ``put`` makes the part with another formula there.
    """

    site: str
    role: str
    formula: Expr
    put: Put


def formula_places(part: Chart | Block) -> Iterator[FormulaPlace]:
    """Every formula of a part, in the order in which it is drawn."""
    if isinstance(part, Block):
        yield from _in_actions("block", part.do, partial(_block, part))
        return
    for one in transition_lists(part):
        for number, segment in enumerate(one.segments):
            put, site = partial(_segment, one, number), f"{one.site}.{number + 1}"
            if segment.guard is not None:
                yield FormulaPlace(site, "guard", segment.guard, _with(put, segment, "guard"))
            yield from _in_actions(site, segment.do, _with(put, segment, "do"))
            yield from _in_actions(site, segment.then, _with(put, segment, "then"))
    for path, state in part.states.items():
        for kind in ("entry", "during", "exit"):
            site = f"state/{'.'.join(path)}/{kind}"
            yield from _in_actions(site, getattr(state, kind), partial(_state, part, path, kind))


def _with(put: Put, thing: Any, name: str) -> Put:
    """Puts something in place of a field of a thing."""
    return lambda new: put(replace(thing, **{name: new}))


def _block(part: Block, new: tuple[Action, ...]) -> Block:
    return Block(part.name, new, text=part.text, place=part.place)


def _segment(one: TransitionList, number: int, new: Any) -> Chart:
    return one.changed([new if i == number else s for i, s in enumerate(one.segments)])


def _state(chart: Chart, path: Path, kind: str, new: tuple[Action, ...]) -> Chart:
    changed: dict[str, Any] = {kind: new}
    return edit_at(chart, path, lambda state: replace(state, **changed))


def _in_actions(site: str, actions: tuple[Action, ...], put: Put) -> Iterator[FormulaPlace]:
    for number, action in enumerate(actions):
        one = partial(_nth, actions, number, put)
        if isinstance(action, Assign):
            yield FormulaPlace(site, action.var.name, action.value, _with(one, action, "value"))
        elif isinstance(action, If):
            yield FormulaPlace(site, "if", action.condition, _with(one, action, "condition"))
            yield from _in_actions(site, action.then, _with(one, action, "then"))
            yield from _in_actions(site, action.otherwise, _with(one, action, "otherwise"))


def _nth(actions: tuple[Action, ...], number: int, put: Put, new: Action) -> Chart | Block:
    return put((*actions[:number], new, *actions[number + 1 :]))


Node = tuple[Expr, Callable[[Expr], Expr]]
"""A node of a formula, and what makes the formula with another node there."""


def nodes_in(formula: Expr) -> Iterator[Node]:
    """Every node of a formula, parents first."""
    if not isinstance(formula, Named):
        yield formula, _itself
    match formula:
        case Apply(_, args, _):
            for number, arg in enumerate(args):
                for node, put in nodes_in(arg):
                    yield node, partial(_in_apply, formula, number, put)
        case Named(_, body):
            yield from nodes_in(body)  # what is changed is no longer what the name says
        case Temporal(_, arg, _, _) if arg is not None:
            for node, put in nodes_in(arg):
                yield node, partial(_in_temporal, formula, put)


def _itself(new: Expr) -> Expr:
    return new


def _in_apply(formula: Apply, number: int, put: Callable[[Expr], Expr], new: Expr) -> Expr:
    return replace(formula, args=(*formula.args[:number], put(new), *formula.args[number + 1 :]))


def _in_temporal(formula: Temporal, put: Callable[[Expr], Expr], new: Expr) -> Expr:
    return replace(formula, arg=put(new))


__all__ = ["FormulaPlace", "Node", "formula_places", "nodes_in"]
