"""What is told of the cause of deviations: what explains them, in which ways they show."""

from collections.abc import Iterator
from dataclasses import replace

from rovercheck.checker.commands.shared.deviation_text import headline
from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.diagnosis.causes import CauseGroups, DeviationCause
from rovercheck.checker.diagnosis.sentences import behaves_like, like
from rovercheck.checker.results.campaign import CampaignFinding


def says(cause: DeviationCause) -> str:
    """What explains the deviations of a cause; empty where nothing does."""
    if cause.change is not None and cause.other_places:
        return behaves_like(cause.change, *cause.other_places)
    if cause.change is not None and len(cause.parts) > 1:
        return f"{' and '.join(cause.parts)} behave {like(cause.change)}"
    if cause.change is not None:
        return behaves_like(cause.change)
    return f"{cause.part} behaves as if it had other values of {cause.input}" if cause.input else ""


def with_cause(found: CampaignFinding, cause: DeviationCause) -> CampaignFinding:
    """A finding with what explains it, in words and as data."""
    return replace(
        found,
        cause=says(cause),
        change=cause.change.told if cause.change else (),
        other_places=tuple(change.told for change in cause.other_places),
        rivals=tuple(change.told for change in cause.rivals),
    )


def untold(cause: DeviationCause, recordings: str) -> str:
    """What explains a cause's deviations as well; empty where nothing that was tried does."""
    others = " or ".join(map(behaves_like, cause.rivals))
    apart = f"{others}: nothing in these {recordings} tells it apart" if others else ""
    return "; ".join(filter(None, (cause.change.note if cause.change else "", apart)))


def also(other: Deviation, one: DeviationCause, recordings: tuple[str, str]) -> str:
    """Another way in which a finding shows: what differs, where the charts are, in how many of those."""
    moves = [move.removeprefix(f"{one.part}: ") for move in other.scope.charts]
    told = headline(other).removeprefix(f"{one.part}: ")
    where = f" ({'; '.join(moves)})" if moves else ""
    return f"{told}{where}, in {counted(other.runs, *recordings)}"


def cut_short(groups: CauseGroups) -> Iterator[str]:
    """Where the time ended the search."""
    for cut in groups.cut:
        yield (
            f"Causes in {cut.part}: {cut.tried:,} changes tried in {cut.seconds:.0f} s, not all; more with "
            "--seconds S. Deviations of one cause may be told as several there."
        )
