"""One tick as formulas: every variable after it, written over the state before it and the inputs.

Plain symbolic execution.  Nothing is simplified, so that nothing can be simplified wrongly; nodes built
alike are one node, so that formulas stay as long as the program.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.system.intervals import postorder
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import plain, variables

Store = dict[str, Expr]


@dataclass(frozen=True)
class CertifiedTick:
    """One tick of the part of a system that some variables depend on (their cone of influence).

    ``next`` gives each of ``variables`` after the tick, by name; ``assume`` are the conjuncts of the
    assumption that count.  Every symbol in them is one of ``inputs``, ``frozen`` and ``variables``.
    """

    inputs: tuple[Var, ...]
    frozen: tuple[Var, ...]
    variables: tuple[Var, ...]
    next: Mapping[str, Expr]
    assume: tuple[Expr, ...]


@dataclass(frozen=True)
class SymbolicStep:
    """The step of a whole system as formulas: all its variables, all conjuncts of its assumption."""

    system: TransitionSystem
    next: Mapping[str, Expr]
    assume: tuple[Expr, ...]

    def cone(self, roots: Iterable[str], kept: Sequence[int]) -> CertifiedTick:
        """The part that the named variables, and the kept conjuncts of the assumption, depend on.

        Raises ``KeyError`` for a variable that the system does not have, ``IndexError`` for a conjunct.
        """
        assume = tuple(self.assume[i] for i in kept)
        found = set(variables(*assume))
        fresh = {*roots, *found}
        while fresh:
            found |= fresh
            own = [self.next[n] for n in fresh if n in self.next or not self._given(n)]
            fresh = variables(*own).keys() - found
        own_variables = tuple(v for v in self.system.variables if v.name in found)
        return CertifiedTick(
            tuple(v for v in self.system.inputs if v.name in found),
            tuple(v for v in self.system.frozen if v.name in found),
            own_variables,
            {v.name: self.next[v.name] for v in own_variables},
            assume,
        )

    def _given(self, name: str) -> bool:
        return any(v.name == name for v in (*self.system.inputs, *self.system.frozen))


def conjuncts(expr: Expr) -> tuple[Expr, ...]:
    """The parts of a conjunction, from left to right; none for ``TRUE``."""
    body = plain(expr)
    if isinstance(body, Const) and body.value:
        return ()
    if isinstance(body, Apply) and body.op is Op.AND:
        return tuple(part for arg in body.args for part in conjuncts(arg))
    return (expr,)


def executed(system: TransitionSystem) -> SymbolicStep:
    """The step executed on symbols.  Raises ``ModelError`` on a word that lowering removes."""
    nodes = _Nodes()
    store: Store = {v.name: v for v in (*system.variables, *system.inputs, *system.frozen)}
    # A temporary is written before it is read; where a branch leaves it out, nobody looks at it.
    store |= {v.name: Const(v.init, v.sort) for v in system.temps if v.name not in store}
    assume = tuple(nodes.value(part, store) for part in conjuncts(system.assume))
    _run(system.step, store, nodes)
    return SymbolicStep(system, {v.name: store[v.name] for v in system.variables}, assume)


def _run(program: Sequence[Action], store: Store, nodes: "_Nodes") -> None:
    for statement in program:
        if isinstance(statement, Assign):
            store[statement.var.name] = nodes.value(statement.value, store)
        elif isinstance(statement, If):
            _branch(statement, store, nodes)
        else:
            raise ModelError(f"`{statement}` is left in the step; lower the chart first.")


def _branch(statement: If, store: Store, nodes: "_Nodes") -> None:
    test = nodes.value(statement.condition, store)
    then, other = dict(store), dict(store)
    _run(statement.then, then, nodes)
    _run(statement.otherwise, other, nodes)
    for name, value in then.items():
        if value is not other[name]:
            value = nodes.apply(Op.ITE, (test, value, other[name]), like=value)
        store[name] = value


class _Nodes:
    """Makes formulas; two built alike are one."""

    def __init__(self) -> None:
        self._known: dict[tuple[object, ...], Expr] = {}

    def apply(self, op: Op, args: tuple[Expr, ...], like: Expr) -> Expr:
        """The operator applied; of the sort of a formula."""
        key = (op, *(id(a) for a in args))
        return self._known.setdefault(key, Apply(op, args, like.sort))

    def value(self, expr: Expr, store: Store) -> Expr:
        """The expression with what each variable holds in its place."""
        done: dict[int, Expr] = {}
        for node in postorder(expr):
            done[id(node)] = self._node(node, store, done)
        return done[id(expr)]

    def _node(self, node: Expr, store: Store, done: Mapping[int, Expr]) -> Expr:
        match node:
            case Const(value, sort):
                return self._known.setdefault(("const", value, sort), node)
            case Var(name):
                return store[name]
            case Named(_, body):
                return done[id(body)]
            case Apply(op, args, _):
                return self.apply(op, tuple(done[id(a)] for a in args), like=node)
        raise ModelError(f"`{node}` speaks of the past; lower the chart or reduce the property first.")
