"""The lanes of a property: when each of its conjuncts is true."""

from collections.abc import Iterator

from checker.render.lanes import Tone
from checker.render.timeline.model import Lane, LaneGroup, LaneKind, TimelineRun
from checker.render.timeline.runs import Values, stretches
from checker.results.trace import Trace
from spec_model.lang.evaluate import evaluate
from spec_model.lang.expr import Expr, Named, Temporal
from spec_model.lang.label import text
from spec_model.lang.walk import nodes, variables


def parts(trace: Trace) -> Iterator[Lane]:
    """The conjuncts of the property that are false in some tick, those false at the end first."""
    ended = {id(expr) for expr in trace.false_parts}
    others = [e for e, v in zip(trace.parts, trace.truths, strict=False) if id(e) not in ended and not all(v)]
    for expr in (*trace.false_parts, *others):
        truths = _truths(trace, expr)
        runs = [
            TimelineRun(first + 1, last + 1, "true" if truths[first] else "false",
                tone=Tone.OK if truths[first] else Tone.CRITICAL)
            for first, last in stretches(truths, steady=False)
            if truths[first] is not None
        ]  # fmt: skip
        name = expr.name if isinstance(expr, Named) else text(expr)
        yield Lane(name, LaneKind.TRUTH, LaneGroup.PROPERTY, tuple(runs), doc=text(expr, unfold=True))


def _truths(trace: Trace, expr: Expr) -> Values:
    """Whether a conjunct is true after each tick.

    None where that is not known: where a variable has no value, or, in a trace without ``truths``, before
    the last tick if the conjunct speaks of the past.
    """
    for part, known in zip(trace.parts, trace.truths, strict=False):
        if part is expr:
            return [int(value) for value in known]
    if any(isinstance(node, Temporal) for node in nodes(expr)):
        return [*[None] * (len(trace) - 1), 0][: len(trace)]
    needs, found = variables(expr), list[int | None]()
    for tick in trace.ticks:
        at = {**trace.before, **tick.after, **tick.inputs}
        found.append(int(bool(evaluate(expr, at))) if needs.keys() <= at.keys() else None)
    return found
