"""slow2 with the gaps of a time stamp in milliseconds, for stamps that lie anywhere between two steps.

What ``spec_model.board2.slow2`` counts in ticks is here the difference of two stamps (E26).
"""

from rovercheck.spec_model.board2.slow2 import GAPS, Slow2, enough
from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Expr, Var, const, flag, var
from rovercheck.spec_model.lang.words import minimum
from rovercheck.spec_model.signals.board2_supervisor import COUNT, SourceSignals

MILLISECONDS = integer(0, 1 << 40, "ms")


def advance(source: SourceSignals) -> Var:
    """By how much the stamp has advanced since the step before."""
    return var(
        f"{source.name}_advance", MILLISECONDS, doc=f"by how much the stamp of {source.region} advanced"
    )


def record_of_gaps(source: SourceSignals) -> Slow2:
    """The record with its ten gaps; a question adds the time from the stamp at the latest question.

    Every question is answered anew, as firmware does: where two monitors share a record, gaps of one change
    the mean of the other.
    """
    pending = _kept(f"{source.name}_pending_ms")
    last = [_kept(f"{source.name}_gap{i}_ms") for i in range(1, GAPS + 1)]
    gaps = var(f"{source.name}_gaps", COUNT, hidden=True)
    asked = flag(f"{source.name}_asked", hidden=True)
    total: Expr = last[0]
    for gap in last[1:]:
        total = total + gap
    shift = [assign(older, newer) for newer, older in zip(last[-2::-1], last[:0:-1], strict=True)]
    at_gap: list[Action] = [
        *shift,
        assign(last[0], pending),
        assign(gaps, minimum(gaps + 1, GAPS)),
    ]
    answer = assign(source.deg, enough(gaps) & (total > gaps * const(source.mean, "ms")))
    note = Block(f"{source.name}.note", [assign(pending, pending + advance(source))])
    at_question = when(asked & (pending > 0), at_gap), assign(pending, 0), assign(asked, True), answer
    return Slow2(note, at_question)


def _kept(name: str) -> Var:
    return var(name, MILLISECONDS, hidden=True)
