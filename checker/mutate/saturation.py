"""Counters that a chart keeps at the number that they are compared with: there it stands for more, too.

A gap of four steps is four or more where the chart asks only for fewer.  With another limit that is another
chart: one that counts on.
"""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial

from rovercheck.checker.mutate.rewrites import mapped
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.domain import Domain, Num
from rovercheck.spec_model.lang.edit import everywhere, in_actions, in_system
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import nodes


def counted_on(system: System, compared: Iterable[Expr], limit: Const) -> System:
    """The system with each counter that ends at its drawn limit counted on, to about twice as much."""
    for one in compared:
        if isinstance(one, Var) and isinstance(one.sort, Num) and one.sort == limit.sort:
            end = one.domain.high
            if end == limit.value and any(_is_kept(part, one) for part in parts(system.components)):
                new = replace(one, domain=Domain(one.sort, range(one.domain.low, 2 * end + 2)))
                for part in parts(system.components):
                    system = in_system(system, part.name, partial(_with, old=one, new=new))
    return system


def _is_kept(part: Chart | Block, counter: Var) -> bool:
    """Whether a part assigns a counter no more than its end."""
    found: list[Expr] = []

    def note(action: Action) -> Action:
        match action:
            case Assign(var, value) if var.name == counter.name:
                found.extend(node for node in nodes(value) if _ends(node, counter))
            case If(_, then, otherwise):
                for one in (*then, *otherwise):
                    note(one)
        return action

    _in_actions(part, note)
    return bool(found)


def _ends(node: Expr, counter: Var) -> bool:
    """Whether a node is the smaller of a sum and the end of the counter."""
    match node:
        case Apply(Op.MIN, (_, Const(value, sort))):
            return sort == counter.sort and value == counter.domain.high
    return False


def _with(part: Chart | Block, old: Var, new: Var) -> Chart | Block:
    end = Const(new.domain.high, new.sort)

    def higher(node: Expr) -> Expr:
        ends = isinstance(node, Apply) and _ends(node, old)
        return replace(node, args=(node.args[0], end)) if isinstance(node, Apply) and ends else node

    def act(action: Action) -> Action:
        match action:
            case Assign(var, value) if var.name == old.name:
                return Assign(new, everywhere(value, higher))
            case If(condition, then, otherwise):
                return If(condition, tuple(map(act, then)), tuple(map(act, otherwise)))
        return action

    def read(node: Expr) -> Expr:
        return new if isinstance(node, Var) and node.name == old.name else node

    return _in_actions(mapped(part, read), act)


def _in_actions(part: Chart | Block, change: Callable[[Action], Action]) -> Chart | Block:
    if isinstance(part, Block):
        return Block(part.name, tuple(map(change, part.do)), text=part.text, place=part.place)
    return in_actions(part, change)


__all__ = ["counted_on"]
