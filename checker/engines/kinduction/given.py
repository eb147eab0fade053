"""An invariant of candidates that are given, such as the conjuncts of a proof on record."""

from collections.abc import Iterable, Sequence

from checker.encode.invariants import Cube
from checker.engines.kinduction.houdini import Consecution, initially
from checker.engines.kinduction.ticks import Scope
from spec_model.lang.expr import Expr
from spec_model.lang.walk import variables


class Given:
    """The greatest inductive subset of the candidates that speak of the scope only; it does not grow."""

    def __init__(self, scope: Scope, candidates: Sequence[Expr]) -> None:
        spoken = {v.name for v in (*scope.part.frozen, *scope.part.variables)}
        inside = [c for c in candidates if variables(c).keys() <= spoken]
        self._consecution = Consecution(scope)
        self._consecution.grow(initially(scope, inside))

    @property
    def known(self) -> list[Expr]:
        """The invariant."""
        return self._consecution.known

    def support(self, needed: Iterable[Expr]) -> list[Expr]:
        """The conjuncts that make the needed ones inductive, themselves included."""
        return self._consecution.support(needed)

    def note(self, cube: Cube) -> None:
        """A goal is reached from this cube: nothing more is known that might exclude it."""
