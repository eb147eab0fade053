"""The cone of influence of a property: what of its system the verdict on it can depend on."""

from collections.abc import Collection
from dataclasses import dataclass

from rovercheck.checker.system.slice import names, sliced
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.system import System, TransitionSystem


def depends_on(system: TransitionSystem, prop: Property) -> TransitionSystem:
    """The slice that the verdict on a property rests on, its monitor included."""
    question = reduce(system, [prop])
    return sliced(question.system, [v for goal in question.goals for v in (goal.var, *goal.recurs)])


@dataclass(frozen=True)
class Dependencies:
    """What a verdict depends on: ids of interpretations and of assumptions, in the order of the system."""

    interpretations: tuple[str, ...] = ()
    assumptions: tuple[str, ...] = ()


def dependencies(
    system: System, lowered: TransitionSystem, prop: Property, interpretations: Collection[str] = ()
) -> Dependencies:
    """What of a system, which ``lowered`` is, a property can depend on.

    ``interpretations`` are frozen variables of it.  An assumption is one of these where it restricts an input
    that the cone reads.
    """
    part = depends_on(lowered, prop)
    open_ = tuple(v.name for v in part.frozen if v.name in interpretations)
    inputs = {v.name for v in part.inputs}
    assumed = tuple(a.id for a in system.assumptions if not names([a.formula]).isdisjoint(inputs))
    return Dependencies(open_, assumed)
