"""Monitors of Board 2: does each of its four sources still deliver, and often enough [spec §3.1].

The document gives no limits; these are the design's.  A region returns only after its stamp has come
often enough for a while (E29), and its critical state does not look at the age.
"""

from collections.abc import Sequence

from rovercheck.spec_model.board2.slow2 import Record, Slow2, exact
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart, State, to
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.time import Span, sec
from rovercheck.spec_model.lang.words import duration, named
from rovercheck.spec_model.signals.board2_supervisor import SOURCES, SUP, SourceSignals


def silent(source: SourceSignals) -> Expr:
    """The stamp is older than the limit (strict)."""
    return named(f"now_ms - ts > {source.limit} ms", source.age > source.limit)


def recovered(source: SourceSignals, rest: Span) -> Expr:
    """The gaps have been short enough for longer than ``rest`` (E29)."""
    return duration(~source.deg) > rest


def from_critical(source: SourceSignals) -> Span:
    """How long a critical source must deliver: 2 s for the supervisor of Board 1, otherwise 1 s."""
    return 2 * sec if source.region == SUP.region else 1 * sec


def _region(source: SourceSignals, slow2: Slow2) -> State:
    ok, degraded, critical = source.levels
    return State(source.region, default="OK", states=[
        State("OK", entry=[assign(source.status, ok)], during=slow2.ask, transitions=[
            to("DEG", when=source.deg),
            to("CRIT", when=silent(source)),
        ]),
        State("DEG", entry=[assign(source.status, degraded)], during=slow2.ask, transitions=[
            to("OK", when=recovered(source, 1 * sec)),
            to("CRIT", when=silent(source)),
        ]),
        State("CRIT", entry=[assign(source.status, critical)], during=slow2.ask, transitions=[
            to("OK", when=recovered(source, from_critical(source))),
        ]),
    ])  # fmt: skip


def monitors(
    record: Record = exact, sources: Sequence[SourceSignals] = SOURCES, name: str = "Monitors_2"
) -> tuple[tuple[Block, ...], Chart]:
    """What the records note in every step, and the chart with a region for each source.

    ``record`` is the record of gaps, exact or one of the over-approximations of ``slow2``.
    """
    records = [record(source) for source in sources]
    regions = [_region(source, slow2) for source, slow2 in zip(sources, records, strict=True)]
    chart = Chart(name, regions, parallel=True, text="Statuses of the four sources of Board 2.")
    return tuple(slow2.note for slow2 in records), chart


RECORDS, monitor_sources = monitors()
"""The exact records, and the chart as drawn."""
