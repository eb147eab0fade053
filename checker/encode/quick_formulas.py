"""Formulas that are asked for often as Python functions: their value is had in a tenth of the time.

The reference is ``spec_model.lang.evaluate``, which goes through a formula each time.
"""

from collections.abc import Callable, Mapping

from rovercheck.checker.encode.python_text import text_of
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr

OFTEN = 30
"""How often a formula is asked for before it is compiled, which takes as long as that."""
MOST = 20_000
"""Formulas that are kept."""


class QuickFormulas:
    """The raw value of formulas without temporal words in a state, as ``evaluate`` has it."""

    def __init__(self) -> None:
        self._compiled: dict[int, Callable[[Mapping[str, int]], int]] = {}
        self._asked: dict[int, tuple[Expr, int]] = {}  # what is known by its id must stay

    def __call__(self, expr: Expr, at: Mapping[str, int]) -> int:
        known = self._compiled.get(id(expr))
        return self._counted(expr, at) if known is None else known(at)

    def _counted(self, expr: Expr, at: Mapping[str, int]) -> int:
        _, times = self._asked.get(id(expr), (expr, 0))
        if len(self._asked) >= MOST:
            self._compiled.clear()
            self._asked.clear()
        self._asked[id(expr)] = expr, times + 1
        if times == OFTEN:
            self._compiled[id(expr)] = _function(expr)
        return evaluate(expr, at)


def _function(expr: Expr) -> Callable[[Mapping[str, int]], int]:
    text = text_of(expr, lambda var: f"a[{var.name!r}]")
    try:
        made: Callable[[Mapping[str, int]], int] = eval(
            f"lambda a: {f'1 if {text} else 0' if isinstance(expr.sort, Bool) else text}"
        )
    except (SyntaxError, RecursionError, MemoryError):  # nested more deeply than Python reads
        return lambda at: evaluate(expr, at)
    return made


QUICK = QuickFormulas()
"""Those of this process."""


__all__ = ["QUICK", "QuickFormulas"]
