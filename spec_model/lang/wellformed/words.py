"""Temporal words where they have a meaning, and conditions where a condition is needed."""

from collections.abc import Iterator

from rovercheck.spec_model.lang.action import Send, each_action, expressions
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.errors import ModelError, with_article
from rovercheck.spec_model.lang.expr import Expr, Temporal, When
from rovercheck.spec_model.lang.walk import nodes, variables
from rovercheck.spec_model.lang.wellformed.places import ActionPlace, conditions, legs, places

_OF_A_STATE = (When.AFTER, When.DURATION)
_OF_PROPERTIES = (When.PREVIOUS, When.ONCE)


def word_faults(chart: Chart, tick_ms: int) -> Iterator[str]:
    """Guards and actions of a chart."""
    own = set(chart.written) | {v.name for v in (*chart.locations, chart.entered)}
    for leg in legs(chart):
        if leg.segment.guard is not None:
            what = f"the guard of {leg.where}"
            yield from _sort_faults(what, leg.segment.guard)
            for word in _words(leg.segment.guard):
                if leg.default and word.when in _OF_A_STATE:
                    yield f"{what}: `{word}` counts from a state's entry, but a default path leaves none."
                yield from _faults_of(what, word, own, tick_ms)
    for place in places(chart):
        yield from _place_faults(place, own, tick_ms)


def _place_faults(place: ActionPlace, own: set[str], tick_ms: int) -> Iterator[str]:
    for condition in conditions(place.actions):
        yield from _sort_faults(f"a condition in {place.where}", condition)
    for expr in expressions(place.actions):
        for word in _words(expr):
            if word.when in _OF_A_STATE:
                yield f"{place.where}: `{word}` belongs in a guard of a transition that leaves a state."
            yield from _faults_of(place.where, word, own, tick_ms)


def _faults_of(what: str, word: Temporal, own: set[str], tick_ms: int) -> Iterator[str]:
    if word.when in _OF_PROPERTIES:
        yield f"{what}: `{word}` belongs in properties; in a chart, keep the past in a datum."
    if word.arg is not None and _words(word.arg):
        yield f"{what}: `{word}` has a temporal word inside another; keep the inner one in a datum."
    yield from _span_faults(what, word, tick_ms)
    if word.when in (When.RISING, When.HELD) and word.arg is not None:
        for name in variables(word.arg):
            if name in own:
                yield (
                    f"{what}: `{word}` is read at the start of the step, but the chart itself writes {name}; "
                    "use data of earlier components."
                )


def _span_faults(what: str, word: Temporal, tick_ms: int) -> Iterator[str]:
    if word.span is None:
        return
    try:
        count = word.span.ticks(tick_ms)
    except ModelError as error:
        yield f"{what}: `{word}`: {error}"
        return
    if count == 0 and (word.when is When.AFTER or (word.when is When.DURATION and not word.strict)):
        yield f"{what}: `{word}` is always true; remove it or give it a time."


def _sort_faults(what: str, expr: Expr) -> Iterator[str]:
    if not isinstance(expr.sort, Bool):
        yield f"{what}, `{expr}`, is {with_article(expr.sort)}; write a condition, such as a comparison."


def _words(*exprs: Expr) -> list[Temporal]:
    return [n for n in nodes(*exprs) if isinstance(n, Temporal)]


def no_words(what: str, expr: Expr) -> Iterator[str]:
    """Faults of a formula outside charts."""
    for word in _words(expr):
        yield f"{what}: `{word}` has no meaning outside a chart; compute it in one that runs before."


def block_word_faults(block: Block) -> Iterator[str]:
    """A block has actions only: no sends, no temporal words."""
    for action in each_action(block.do):
        if isinstance(action, Send):
            yield f"`{action}`: a block has no states to send to; use a chart."
    for condition in conditions(block.do):
        yield from _sort_faults("a condition", condition)
    for expr in expressions(block.do):
        yield from no_words(f"`{expr}`", expr)
