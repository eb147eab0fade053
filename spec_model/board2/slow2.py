"""slow2: whether the latest gaps of a time stamp are too long on average, asked only now and then.

A monitor of Board 2 asks in its during action, so not in a step in which its region takes an arrow.
The record knows the stamp at the latest question, ``prev``.  At each later one a changed stamp adds
the gap since ``prev``, in which stamps of steps without a question vanish; the first question only
sets ``prev``, to the power-up value if no stamp came yet (contrast S66).  The answer is the mean of
at most ten gaps against the limit, the open gap not counted, and needs no ten of them (E26).

Gaps are counted in ticks of 20 ms, up to a number that stands for all longer ones.
"""

from collections.abc import Callable
from dataclasses import dataclass

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.array import array
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Const, Expr, Var, const, flag, ite, var
from rovercheck.spec_model.lang.system import TICK_MS
from rovercheck.spec_model.lang.words import maximum, minimum
from rovercheck.spec_model.signals.board2_supervisor import COUNT, SourceSignals

GAPS = 10
"""The mean is over the latest ten gaps."""


@dataclass(frozen=True)
class Slow2:
    """The record of one source: what it notes in every step, and what a question does."""

    note: Block
    ask: tuple[Action, ...]


Record = Callable[[SourceSignals], Slow2]


def enough(gaps: Expr) -> Expr:
    """Whether so many gaps have a mean: one does (E26)."""
    return gaps >= 1


def exact(source: SourceSignals) -> Slow2:
    """The record as it is written, with its ten gaps."""
    most = source.mean // TICK_MS
    # With nine other positive gaps the sum exceeds ten times ``most``, with fewer gaps all the more.
    pending, note = _pending(source, (most - 1) * GAPS + 2)
    return _ten(source, most, pending, note)


def exact_ms(step: Expr) -> Record:
    """The record with its ten gaps to the ms, for steps that last ``step``.

    The ``phase`` of the source is how long before the step that sees it a stamp is set.
    """

    def record(source: SourceSignals) -> Slow2:
        # With fewer gaps than ten the sum exceeds the mean of as many all the more.
        pending, note = _pending_ms(source, source.mean * GAPS + 1, step)
        return _ten(source, source.mean, pending, note)

    return record


def _ten(source: SourceSignals, most: int, pending: Var, note: Block) -> Slow2:
    last = array(
        f"{source.name}_gap", range(1, GAPS + 1), pending.domain, doc="gap {key}, latest first", hidden=True
    )
    gaps, one_more = _count(source)
    slow = last.sum() > gaps * Const(most, pending.sort)
    answer = assign(source.deg, enough(gaps) & slow)
    return Slow2(note, _question(source, pending, [*last.push(pending), one_more, answer]))


def runs(source: SourceSignals) -> Slow2:
    """Over-approximation: only how many of the latest gaps in a row were all long, or all short.

    The answer is yes if all gaps of the record exceed the limit, no if none does, else the free
    input ``<name>_mean_slow``.
    """
    most = source.mean // TICK_MS
    pending, note = _pending(source, most + 1)
    row = var(
        f"{source.name}_row",
        integer(-GAPS, GAPS),
        0,
        "latest gaps in a row: n long ones, -n short ones",
        hidden=True,
    )
    gaps, one_more = _count(source)
    longer, shorter = minimum(maximum(row, 0) + 1, GAPS), maximum(minimum(row, 0) - 1, -GAPS)
    return Slow2(note, _question(source, pending, [
        assign(row, ite(pending > most, longer, shorter)),
        one_more,
        assign(source.deg, enough(gaps) & ((row >= gaps) | ((row + gaps > 0) & mean_slow(source)))),
    ]))  # fmt: skip


def forgotten(source: SourceSignals) -> Slow2:
    """Over-approximation: at each new gap the free input ``<name>_mean_slow`` is the answer."""
    pending = flag(f"{source.name}_fresh", "the stamp changed since the latest question", hidden=True)
    note = Block(f"{source.name}.note", [when(source.update, [assign(pending, True)])],
                 text="Over-approximation: the gaps are forgotten.")  # fmt: skip
    asked = _asked(source)
    return Slow2(note, (
        when(asked & pending, [assign(source.deg, mean_slow(source))]),
        assign(pending, False),
        assign(asked, True),
    ))  # fmt: skip


def mean_slow(source: SourceSignals) -> Var:
    """Free in every step: what the mean is where an over-approximation does not know."""
    return flag(f"{source.name}_mean_slow", f"free: whether the mean exceeds {source.mean} ms at this gap")


def _pending(source: SourceSignals, longest: int) -> tuple[Var, Block]:
    """The ticks from ``prev`` to the stamp, 0 while they are equal, and the block that counts them."""
    ticks = integer(0, longest)
    since = var(f"{source.name}_since", ticks, doc="ticks since the stamp", hidden=True)
    pending = var(
        f"{source.name}_pending",
        ticks,
        doc="ticks from the stamp at the latest question to the stamp",
        hidden=True,
    )
    note = Block(
        f"{source.name}.note",
        [
            when(
                source.update,
                [assign(pending, minimum(pending + since + 1, longest)), assign(since, 0)],
                [assign(since, minimum(since + 1, longest))],
            )
        ],
        text="The gap that the next question of slow2 will find.",
    )
    return pending, note


def _pending_ms(source: SourceSignals, longest: int, step: Expr) -> tuple[Var, Block]:
    """The same in ms, of a source with a phase."""
    if source.phase is None:
        raise ModelError(f"{source.name} has no phase; its gaps are counted in ticks.")
    milliseconds, most = integer(0, longest, "ms"), const(longest, "ms")
    since = var(f"{source.name}_since_ms", milliseconds, doc="ms since the stamp, at the step", hidden=True)
    pending = var(
        f"{source.name}_pending_ms",
        milliseconds,
        doc="ms from the stamp at the latest question to the stamp",
        hidden=True,
    )
    note = Block(
        f"{source.name}.note",
        [
            when(
                source.update,
                [
                    assign(pending, minimum(pending + since + step - source.phase, most)),
                    assign(since, source.phase),
                ],
                [assign(since, minimum(since + step, most))],
            )
        ],
        text="The gap that the next question of slow2 will find, to the ms.",
    )
    return pending, note


def gaps_of(source: SourceSignals) -> Var:
    """How many gaps the record holds."""
    return var(f"{source.name}_gaps", COUNT, doc="gaps in the record", hidden=True)


def _count(source: SourceSignals) -> tuple[Var, Action]:
    gaps = gaps_of(source)
    return gaps, assign(gaps, minimum(gaps + 1, GAPS))


def _asked(source: SourceSignals) -> Var:
    return flag(f"{source.name}_asked", "slow2 has been asked before, so that prev has a value", hidden=True)


def _question(source: SourceSignals, pending: Var, at_gap: list[Action]) -> tuple[Action, ...]:
    asked = _asked(source)
    return when(asked & (pending > 0), at_gap), assign(pending, 0), assign(asked, True)
