"""Whether the case that a property speaks of ever occurs: if not, the property holds for an empty reason."""

from dataclasses import replace

from rovercheck.properties.forms import Always, Form, LeadsTo, Property, Reachable, Recoverable, Settles
from rovercheck.properties.phrases import as_implication
from rovercheck.spec_model.lang.expr import Apply, Expr
from rovercheck.spec_model.lang.operators import Op


def premise(prop: Property) -> Property | None:
    """That its case occurs, as a property of the same id; None where it speaks of every tick.

    Kupferman, Vardi, *Vacuity Detection in Temporal Model Checking*, CHARME 1999: what fails here is passed
    vacuously.  Of "settles" the premise has to hold in some tick only, which is necessary and not enough.
    """
    case = _case(prop.form)
    return None if case is None else replace(prop, form=Reachable(case), costly=False)


def _case(form: Form) -> Expr | None:
    match form:
        case Always(that):
            return _implied(that)
        case LeadsTo(case) | Settles(case):
            return case
        case Recoverable():
            return None
        case bounded:
            return bounded.case


def _implied(that: Expr) -> Expr | None:
    """The premise of "whenever p, then q", which is written ``~p | q``."""
    found = as_implication(that.args) if isinstance(that, Apply) and that.op is Op.OR else None
    return None if found is None else found[0]
