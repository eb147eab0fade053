"""Deviations as findings of a campaign, whether logs or runs of an implementation show them."""

from collections.abc import Iterable, Iterator, Sequence

from rovercheck.checker.commands.shared.deviation_text import headline
from rovercheck.checker.conformance.deviations import Deviation, whole_of
from rovercheck.checker.conformance.excerpt import MOST_LANES
from rovercheck.checker.conformance.known import KnownJudgement
from rovercheck.checker.results.campaign import (
    CampaignFinding,
    CampaignOccurrence,
    CampaignSighting,
    CampaignWords,
    KnownTerms,
)


def deviation_finding(
    board: str,
    one: Deviation,
    judgement: KnownJudgement,
    words: CampaignWords,
    met: Iterable[CampaignSighting],
    more: Iterable[tuple[str, str]] = (),
) -> CampaignFinding:
    """A deviation with its evidence, and with ``more`` of it; without a timeline."""
    judged = judgement.of(one)
    terms = [KnownTerms(k.reason, k.owner, k.until) for k, _ in judgement.known if k.id == judged.id]
    return CampaignFinding(
        judged.id, board, judged.word, headline(one), (*_evidence(one, words), *more), tuple(met),
        more_lanes=max(0, len(one.outputs) - MOST_LANES), terms=terms[0] if terms else None,
        key=one.scope.id(board),
    )  # fmt: skip


def sightings(
    group: Sequence[Deviation],
    recordings: Iterable[tuple[str, Iterable[Deviation]]],
    every: Sequence[Deviation],
    tick_ms: int,
    lines: bool = False,
) -> tuple[CampaignSighting, ...]:
    """Where some deviation of a group, of ``every``, is met; of each recording its name and groups are given.

    Ticks are those of the deviation that is met in most, as several may be met in one.  ``lines``: whether
    the recordings have lines.
    """
    found = []
    for name, groups in recordings:
        own: dict[int, list[Deviation]] = {}
        for g in groups:
            whole = whole_of(every, g.scope, g.outputs)
            if any(whole is one for one in group):
                own.setdefault(id(whole), []).append(g)
        if own:
            found.append(_sighting(name, list(own.values()), tick_ms, lines))
    return tuple(found) or (_sighting(group[0].origin, [group[:1]], tick_ms, lines),)


def _sighting(name: str, own: Sequence[Sequence[Deviation]], tick_ms: int, lines: bool) -> CampaignSighting:
    first = min((g.first for one in own for g in one), key=lambda m: m.tick)
    worst = max((g.worst for one in own for g in one), key=lambda w: (w.ticks, -w.tick))
    return CampaignSighting(
        name,
        CampaignOccurrence(name, first.tick, first.tick * tick_ms, first.line * lines),
        CampaignOccurrence(name, worst.tick, worst.tick * tick_ms, worst.line * lines, worst.ticks),
        max(sum(g.count for g in one) for one in own),
        max(sum(g.times for g in one) for one in own),
    )


def _evidence(one: Deviation, words: CampaignWords) -> Iterator[tuple[str, str]]:
    for d in one.differences[:MOST_LANES]:
        expected, given = d.values()
        wanted = " or ".join(expected) or "a value"
        yield "expected", f"{d.output.name}: {wanted}; {words.recorded}: {given}"
    if len(one.differences) > MOST_LANES:
        yield "and", f"{len(one.differences) - MOST_LANES} more pairs of values"
    if one.first.moves:
        yield "charts", "; ".join(one.first.moves)
    if one.first.inputs:
        yield "inputs", ", ".join(f"{n} = {v}" for n, v in one.first.inputs.items())


__all__ = ["deviation_finding", "sightings"]
