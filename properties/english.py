"""Properties in structured English, made from form and formula alone, so that the two cannot drift apart.

The sentence of a property says what people mean; this one says, in words, what is checked.
"""

from collections.abc import Iterator
from dataclasses import fields

from rovercheck.properties.forms import (
    Always,
    EntersOnlyIf,
    Form,
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
from rovercheck.properties.phrases import (
    Voice,
    as_implication,
    begins,
    clause,
    ends,
    final,
    part,
    quoted,
    term,
)
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Apply, Expr, Named
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.walk import nodes

HOW_TO_READ = (
    "A step is one tick of the system; formulas are read at its end. Milliseconds run from the end of "
    "the first step that is meant to the end of the last. What is true in the first step becomes true "
    "in it. “...” names a formula, spelled out below the sentence."
)


def sentence(prop: Property, tick_ms: int, measured: bool = False) -> str:
    """What is checked, in one sentence; ``tick_ms`` is the length of a step of the system.

    ``measured``: its steps last unlike times, and lengths in ms are measured (``System.elapsed``).
    Raises ``ModelError`` for a time that is no whole number of steps.
    """
    said = _form(prop.form, Voice(tick_ms, measured=measured))
    if prop.from_tick > 1:
        return f"From step {prop.from_tick} on, {said}."
    return f"{said[0].upper()}{said[1:]}."


def definitions(prop: Property, tick_ms: int, measured: bool = False) -> tuple[str, ...]:
    """One sentence for each name that the sentence, or a definition before, quotes."""
    voice, said = Voice(tick_ms, measured=measured), sentence(prop, tick_ms, measured)
    found: dict[str, str] = {}
    for formula in _names(prop.form):
        if formula.name not in found and quoted(formula.name) in said:
            found[formula.name] = _definition(formula, voice)
            said += found[formula.name]
    return tuple(found.values())


def _definition(formula: Named, voice: Voice) -> str:
    if isinstance(formula.sort, Bool):
        return f"{quoted(formula.name)} means: {clause(formula.body, voice)}."
    return f"{quoted(formula.name)} is {term(formula.body, voice)}."


def _names(form: Form) -> Iterator[Named]:
    """The named formulas, those inside others after them."""
    for field in fields(form):
        value = getattr(form, field.name)
        formulas = value if isinstance(value, tuple) else (value,)
        yield from (n for f in formulas if isinstance(f, Expr) for n in nodes(f) if isinstance(n, Named))


def _form(form: Form, v: Voice) -> str:
    match form:
        case Always(that):
            return _always(that, v)
        case Never(that):
            return f"there is no step in which {clause(that, v)}"
        case Reachable(that):
            return f"some run has a step in which {clause(that, v)}"
        case Responds(trigger, response, within):
            return f"whenever {clause(trigger, v)}, then {_within(within, v)}{final(response, v)}"
        case HoldsAfter(premise, for_, then):
            return f"whenever {_throughout(premise, for_, v)}{final(then, v)}"
        case HoldsFor(start, that, for_):
            return f"whenever {begins(start, v)}, then {_from_then(for_, v)}{final(that, v)}"
        case LeavesOnlyIf(leaving, only_if):
            return f"whenever {ends(leaving, v)}, then in that step{final(only_if, v)}"
        case EntersOnlyIf(entering, only_if):
            return f"whenever {begins(entering, v)}, then in that step{final(only_if, v)}"
        case Precedes(first, then):
            return f"whenever {clause(then, v)}, then in that step or some step before{final(first, v)}"
        case Until(start, holds, release):
            stretch = "in every step from that one on, up to but not including the first in which"
            return f"whenever {clause(start, v)}, then {stretch} {clause(release, v)}: {clause(holds, v)}"
        case LeadsTo(trigger, response, _, fair):
            later = f"then in that step or some later one, without a limit,{final(response, v)}"
            return f"{_fair(fair, v)}whenever {clause(trigger, v)}, {later}"
        case Settles(premise, then, _, fair):
            return (
                f"{_fair(fair, v)}if from some step on in every step {part(premise, v)}, "
                f"then from some step on in every step{final(then, v)}"
            )
        case Recoverable(to):
            return f"from wherever a run is, some continuation has a step in which {clause(to, v)}"


def _always(that: Expr, v: Voice) -> str:
    implication = as_implication(that.args) if isinstance(that, Apply) and that.op is Op.OR else None
    if implication is None:
        return f"in every step{final(that, v)}"
    premise, conclusions = implication
    # A single conclusion may be a conjunction: nothing follows it, so it needs no brackets.
    said = (
        clause(conclusions[0], v) if len(conclusions) == 1 else " or ".join(part(c, v) for c in conclusions)
    )
    return f"in every step in which {clause(premise, v)}, {said}"


def _within(span: Span, v: Voice) -> str:
    if v.in_ms(span):
        return f"in that step or a later one at most {span} after it"
    steps = v.steps(span)
    if steps == 0:
        return "in that step"
    later = "the next" if steps == 1 else f"one of the next {steps}"
    return f"in that step or {later} ({v.ms(steps)})"


def _throughout(premise: Expr, span: Span, v: Voice) -> str:
    if v.in_ms(span):
        stretch = f"in each of successive steps, the first and the last at least {span} apart,"
        return f"{stretch} {part(premise, v)}, then in the last of them"
    steps = v.steps(span)
    if steps == 0:
        return f"{clause(premise, v)}, then in that step"
    stretch = f"in each of {steps + 1} successive steps ({v.ms(steps)}, ends included)"
    return f"{stretch} {part(premise, v)}, then in the last of them"


def _from_then(span: Span, v: Voice) -> str:
    if v.in_ms(span):
        return f"in that step and each later one at most {span} after it"
    steps = v.steps(span)
    if steps == 0:
        return "in that step"
    later = "the next" if steps == 1 else f"each of the next {steps}"
    return f"in that step and {later} ({v.ms(steps)})"


def _fair(conditions: tuple[Expr, ...], v: Voice) -> str:
    """The runs that are spoken of: those in which each condition is true again and again."""
    if not conditions:
        return ""
    often = " and ".join(f"again and again {part(c, v)}" for c in conditions)
    return f"in every run in which {often}: "
