"""The slice that the verdict on a property depends on, as text that is equal where it is written alike."""

from functools import lru_cache

from rovercheck.checker.encode.dead_branches import narrowed
from rovercheck.checker.system.lowering_cache import ByIdentity, lowered
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.system.text import SystemText
from rovercheck.checker.system.width import WIDE, bits_of, driven
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System, TransitionSystem


def slice_text(prop: Property, system: System) -> str | None:
    """The key of the slice; None of a system that is not well formed, or has not all that is named.

    What may be checked of domains is part of it: nothing is proved of a system that leaves one.
    """
    try:
        question = reduce(_without_dead_branches(system), [prop])
    except (ModelError, KeyError):
        return None
    whole = question.system
    goals = [v for goal in question.goals for v in (goal.var, *goal.recurs)]
    checks = [check for check, _ in whole.checks]
    text = SystemText()
    text.add(system.name, system.over, system.under, system.concrete, whole.tick_ms, whole.elapsed)
    text.add("goals", *map(text.expr, goals))
    text.add("checks", *map(text.expr, checks))
    text.system(sliced(whole, [*goals, *checks]))
    return text.digest


def _without_dead_branches(system: System) -> TransitionSystem:
    """The transition system; of a scene, in which little is chosen, only what it makes the system do."""
    whole = lowered(system)
    return _least(ByIdentity(system)) if driven(whole) and bits_of(whole.variables) > WIDE else whole


@lru_cache(maxsize=2)
def _least(key: ByIdentity) -> TransitionSystem:
    return narrowed(lowered(key.system)).system
