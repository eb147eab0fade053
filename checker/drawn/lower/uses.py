"""What the variables of a lowered model are compared with, and whether they are used otherwise."""

from collections.abc import Iterator
from fractions import Fraction

from rovercheck.checker.drawn.lower.lowered import LoweredModel
from rovercheck.spec_model.lang.action import expressions
from rovercheck.spec_model.lang.chart import Block, parts
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import nodes


def uses_of(lowered: LoweredModel) -> dict[str, tuple[set[Fraction], bool]]:
    """Of each variable the constants that it is compared with, and whether it is used otherwise, too."""
    return constants_of(lowered.system)


def constants_of(system: System) -> dict[str, tuple[set[Fraction], bool]]:
    """The same of a system."""
    found: dict[str, tuple[set[Fraction], bool]] = {}
    for formula in _formulas(system):
        for name, constant in _used(formula):
            constants, otherwise = found.get(name, (set(), False))
            found[name] = (
                constants | ({constant} if constant is not None else set()),
                otherwise or constant is None,
            )
    return found


def _formulas(system: System) -> Iterator[Expr]:
    for part in parts(system.components):
        if isinstance(part, ProgrammedChart):
            yield from expressions(part.program.statements)
        else:
            yield from expressions(part.do) if isinstance(part, Block) else part.expressions


def _used(formula: Expr) -> Iterator[tuple[str, Fraction | None]]:
    """The variables of a formula with the constant that each is compared with; ``None``: used otherwise."""
    compared = set[int]()
    for node in nodes(formula):
        if not isinstance(node, Apply) or node.op not in COMPARISONS:
            continue
        for one, other in (node.args, node.args[::-1]):
            var, constant = _plain(one), _plain(other)
            if isinstance(var, Var) and isinstance(constant, Const) and isinstance(constant.sort, Num):
                compared.add(id(one))
                compared.add(id(var))
                yield var.name, constant.value * constant.sort.resolution
    for node in _below(formula, compared):
        if isinstance(node, Var):
            yield node.name, None


def _below(formula: Expr, left_out: set[int]) -> Iterator[Expr]:
    """The nodes of a formula, without some sides of comparisons."""
    waiting = [formula]
    while waiting:
        node = waiting.pop()
        yield node
        match node:
            case Apply(op, args):
                sides = args if op not in COMPARISONS else [a for a in args if id(a) not in left_out]
                waiting += sides
            case Named(_, body):
                waiting.append(body)


def _plain(side: Expr) -> Expr:
    """A side of a comparison without names, and without the change of its resolution."""
    while isinstance(side, Named) or (isinstance(side, Apply) and side.op is Op.SCALE):
        side = side.body if isinstance(side, Named) else side.args[0]
    return side


__all__ = ["constants_of", "uses_of"]
