"""Systems over wider domains: the values that a scenario names, where the model keeps representatives."""

import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from rovercheck.spec_model.lang.action import Action, Assign, If, assign
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.domain import Domain
from rovercheck.spec_model.lang.edit import in_expressions
from rovercheck.spec_model.lang.expr import Apply, Expr, Named, Temporal, Var, all_of, any_of, ite
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.lang.words import minimum

WRITTEN: Mapping[Op, Callable[..., Any]] = {
    Op.AND: all_of, Op.OR: any_of, Op.NOT: operator.invert, Op.ITE: ite, Op.EQ: operator.eq,
    Op.LT: operator.lt, Op.LE: operator.le, Op.GT: operator.gt, Op.GE: operator.ge,
    Op.ADD: operator.add, Op.SUB: operator.sub, Op.MUL: operator.mul, Op.MIN: minimum,
}  # fmt: skip
"""How a person writes an operator; written again, the resolutions of its arguments are aligned anew."""


def widened(system: System, domains: Mapping[str, Domain]) -> System:
    """The system with some variables over other domains, of any resolution."""
    wide = _Wide(domains)
    return replace(system, components=wide.components(system.components), assume=wide.expr(system.assume))


class _Wide:
    def __init__(self, domains: Mapping[str, Domain]) -> None:
        self.domains = domains

    def var(self, v: Var) -> Var:
        if v.name not in self.domains:
            return v
        wide = self.domains[v.name]
        return replace(v, domain=wide, init=wide.raw(v.domain.show(v.init)))

    def expr(self, expr: Expr) -> Expr:
        if self.domains.keys().isdisjoint(variables(expr)):
            return expr
        match expr:
            case Var():
                return self.var(expr)
            case Named(name, body):
                return Named(name, self.expr(body))
            case Temporal(_, Expr() as arg):
                return replace(expr, arg=self.expr(arg))
            case Apply(Op.SCALE, (inner, _)):
                return self.expr(inner)
            case Apply(op, args):
                written: Expr = WRITTEN[op](*(self.expr(a) for a in args))
                return written
        raise AssertionError(f"{expr!r} reads a variable and is no formula of one")

    def actions(self, actions: Sequence[Action]) -> list[Action]:
        return [self._action(action) for action in actions]

    def _action(self, action: Action) -> Action:
        match action:
            case Assign(data, value):
                return assign(self.var(data), self.expr(value))
            case If(condition, then, otherwise):
                return If(self.expr(condition), tuple(self.actions(then)), tuple(self.actions(otherwise)))
        return action

    def components(self, components: Sequence[Component]) -> tuple[Component, ...]:
        return tuple(self._component(component) for component in components)

    def _component(self, component: Component) -> Component:
        match component:
            case Chart():
                return in_expressions(component, self.expr)
            case Block():
                return Block(component.name, self.actions(component.do), text=component.text)
            case Enabled():
                return Enabled(self.expr(component.by), *self.components(component.components))
