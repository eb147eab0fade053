"""Which values of an input are alike: the step of a part only compares it, with the same results."""

from collections.abc import Callable, Iterator, Sequence

from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.encode.python_text import text_of
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Apply, Expr, Var
from rovercheck.spec_model.lang.walk import children, variables

MOST_VALUES = 50_000
"""Values of an input that are remembered."""


class ValueLikes(dict[Raw, Raw]):
    """To each value one of which the same is true, in all that expressions ask about the variable alone.

    They must ask nothing else about it (``computed_with``).
    """

    def __init__(self, var: Var, roots: Sequence[Expr]) -> None:
        super().__init__()
        asked = {text_of(e, lambda _: "x"): None for root in roots for e in _alone(root, var.name)}
        self._asked: Callable[[Raw], object] = eval(f"lambda x: ({''.join(f'{t}, ' for t in asked)})")
        self._first: dict[object, Raw] = {}

    def __missing__(self, value: Raw) -> Raw:
        if len(self) >= MOST_VALUES:
            self.clear()
        try:
            like = self._first.setdefault(self._asked(value), value)
        except TypeError:  # a fraction has no bits; whoever asks for them says so
            like = value
        self[value] = like
        return like


def _alone(expr: Expr, name: str) -> Iterator[Expr]:
    """The largest truth values about the variable alone."""
    if _of_one(expr):
        if name in variables(expr):
            yield expr
        return
    for child in children(expr):
        yield from _alone(child, name)


def _of_one(expr: Expr) -> bool:
    return isinstance(expr, Apply) and isinstance(expr.sort, Bool) and len(variables(expr)) == 1


def computed_with(expr: Expr, found: set[str]) -> None:
    """Add the variables of which more is asked than what is true of them alone."""
    if isinstance(expr, Var):
        found.add(expr.name)
        return
    if _of_one(expr):
        return
    for child in children(expr):
        computed_with(child, found)
