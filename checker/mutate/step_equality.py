"""Whether a mutant does in every tick what the original does, from any valuation: one query, no search.

What hardware engineers call combinational equivalence: it speaks of no run, so that timers and counters,
which a search over the product has to count through, cost nothing.  It proves less than the product, too:
two systems that differ only where no run leads are not equal in this sense.
"""

from checker.encode.symbolic import transition
from checker.encode.unrolling import model_of
from checker.mutate.product import described
from spec_model.lang.expr import Expr, Var
from spec_model.lang.system import TransitionSystem
from spec_model.lang.walk import variables

PATIENCE = 3_000_000
"""Steps of Z3 that the query may take, a second or two; a hard one is left to the product."""


def equal_in_every_step(original: TransitionSystem, mutant: TransitionSystem) -> bool:
    """Whether both begin alike, allow the same inputs, and take every valuation to the same one.

    False also where the solver gives up.
    """
    if described(original.variables) != described(mutant.variables):
        return False
    if described((*original.inputs, *original.frozen)) != described((*mutant.inputs, *mutant.frozen)):
        return False
    one = transition(original)
    other = transition(mutant, one.terms)
    terms = one.terms
    allowed = terms.conjunction(one.assume), terms.conjunction(other.assume)
    pairs = [allowed, *((one.next[name], other.next[name]) for name in one.next)]
    unlike = [terms.negation(terms.equal(a, b)) for a, b in pairs if a is not b]
    if not unlike:
        return True
    conditions = [terms.disjunction(allowed), terms.disjunction(unlike)]
    try:
        return model_of(conditions, _named(original, conditions), PATIENCE) is None
    except ArithmeticError:
        return False


def _named(system: TransitionSystem, conditions: list[Expr]) -> list[Var]:
    names = variables(*conditions)
    return [v for v in (*system.variables, *system.inputs, *system.frozen) if v.name in names]


__all__ = ["equal_in_every_step"]
