"""Faults of a formula that a part contains several times, in all of these places: faults of a function."""

from collections.abc import Iterator
from functools import partial

from rovercheck.checker.mutate.formulas import slips
from rovercheck.checker.mutate.places import formula_places
from rovercheck.checker.mutate.rewrites import Rewrite, everywhere_in
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.expr import Apply, Expr
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import children, plain, structure

WITHIN = ("comparison", "and-or", "dropped", "bit", "member", "value")
"""The operators of mutants that change a function; limits and times are tried with many values instead."""


def function_rewrites(part: Chart | Block, step_ms: int) -> Iterator[Rewrite]:
    """Every fault of a formula that occurs several times; of many conditions, also that one counts alone."""
    for body in _repeated(part):
        if isinstance(body, Apply) and body.op in (Op.AND, Op.OR) and len(body.args) > 2:
            for one in body.args:
                yield _everywhere(part, "only", body, one)
        for slip in slips(body, step_ms):
            if slip.operator in WITHIN:
                yield _everywhere(part, slip.operator, body, slip.whole)


def _everywhere(part: Chart | Block, kind: str, body: Expr, new: Expr) -> Rewrite:
    return Rewrite(kind, "everywhere", str(body), str(new), partial(everywhere_in, part, body, new))


def _repeated(part: Chart | Block) -> list[Expr]:
    """The largest formulas with an operator that occur in several places."""
    found: dict[object, list[Expr]] = {}
    for place in formula_places(part):
        stack = [place.formula]
        while stack:
            node = plain(stack.pop())
            if isinstance(node, Apply):
                found.setdefault(structure(node), []).append(node)
            stack += children(node)
    several = [some for some in found.values() if len(some) > 1]
    inside = {id(plain(arg)) for some in several for node in some for arg in children(node)}
    return [some[0] for some in several if not all(id(node) in inside for node in some)]


__all__ = ["function_rewrites"]
