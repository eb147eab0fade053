"""Whether the case that a property speaks of ever occurs: if not, the property holds for an empty reason."""

from dataclasses import replace

from rovercheck.properties.forms import (
    Always,
    EntersOnlyIf,
    HoldsAfter,
    HoldsFor,
    LeadsTo,
    LeavesOnlyIf,
    Never,
    Precedes,
    Property,
    Reachable,
    Recoverable,
    Responds,
    Settles,
    Until,
)
from rovercheck.properties.phrases import as_implication
from rovercheck.spec_model.lang.expr import Apply, Expr
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.words import held, previous


def premise(prop: Property) -> Property | None:
    """That its case occurs, as a property of the same id; None where it speaks of every tick.

    Kupferman, Vardi, *Vacuity Detection in Temporal Model Checking*, CHARME 1999: what fails here is passed
    vacuously.  Of "settles" the premise has to hold in some tick only, which is necessary and not enough.
    """
    case = _case(prop)
    return None if case is None else replace(prop, form=Reachable(case), costly=False)


def _case(prop: Property) -> Expr | None:
    match prop.form:
        case Always(that):
            return _implied(that)
        case Responds(trigger) | LeadsTo(trigger):
            return trigger
        case HoldsAfter(condition, for_):
            return held(condition, for_)
        case HoldsFor(start) | Until(start):
            return start
        case LeavesOnlyIf(leaving):
            return previous(leaving) & ~leaving
        case EntersOnlyIf(entering):
            return entering
        case Precedes(_, then):
            return then
        case Settles(condition):
            return condition
        case Never() | Reachable() | Recoverable():
            return None


def _implied(that: Expr) -> Expr | None:
    """The premise of "whenever p, then q", which is written ``~p | q``."""
    found = as_implication(that.args) if isinstance(that, Apply) and that.op is Op.OR else None
    return None if found is None else found[0]
