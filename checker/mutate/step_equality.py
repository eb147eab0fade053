"""Whether a mutant does in every tick what the original does, from any state: one query, no search.

What hardware engineers call combinational equivalence: it speaks of no run, so that timers and counters,
which a search over the product has to count through, cost nothing.  It proves less than the product, too:
two systems that differ only where no run leads are not equal in this sense.
"""

from collections.abc import Sequence

from rovercheck.checker.encode.cone import with_values
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.encode.terms import Terms
from rovercheck.checker.encode.unrolling import model_of
from rovercheck.checker.mutate.product import described
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables

PATIENCE = 3_000_000
"""Steps of Z3 that the query may take, a second or two; a hard one is left to the product."""


def equal_in_every_step(original: TransitionSystem, mutant: TransitionSystem) -> bool:
    """Whether both allow the same inputs and take every state to the same one.

    Where they begin with other values, the first tick must overwrite them: it takes both beginnings to the
    same state.  False also where the solver gives up.
    """
    if not _alike(original, mutant):
        return False
    one = transition(original)
    other = transition(mutant, one.terms)
    terms = one.terms
    allowed = terms.conjunction(one.assume), terms.conjunction(other.assume)
    pairs = [allowed, *((one.next[name], other.next[name]) for name in one.next)]
    begins = _values(original), _values(mutant)
    if not _equal(terms, original, pairs):
        return False
    if begins[0] == begins[1]:
        return True
    first = [tuple(with_values(terms, at, f) for at, f in zip(begins, pair, strict=True)) for pair in pairs]
    return _equal(terms, original, first)


def _alike(original: TransitionSystem, mutant: TransitionSystem) -> bool:
    """Whether both have the same variables with the same domains, inputs and frozen variables included."""
    domains = [{v.name: v.domain for v in (*s.variables, *s.inputs, *s.frozen)} for s in (original, mutant)]
    begun = [described((*s.inputs, *s.frozen)) for s in (original, mutant)]
    return domains[0] == domains[1] and begun[0] == begun[1]


def _values(system: TransitionSystem) -> dict[str, int]:
    return {v.name: v.init for v in system.variables}


def _equal(terms: Terms, system: TransitionSystem, pairs: Sequence[tuple[Expr, ...]]) -> bool:
    """Whether the formulas of each pair are equal where one of the first pair, the assumptions, is true."""
    unlike = [terms.negation(terms.equal(a, b)) for a, b in pairs if a is not b]
    if not unlike:
        return True
    conditions = [terms.disjunction(pairs[0]), terms.disjunction(unlike)]
    try:
        return model_of(conditions, _named(system, conditions), PATIENCE) is None
    except ArithmeticError:
        return False


def _named(system: TransitionSystem, conditions: list[Expr]) -> list[Var]:
    names = variables(*conditions)
    return [v for v in (*system.variables, *system.inputs, *system.frozen) if v.name in names]


__all__ = ["equal_in_every_step"]
