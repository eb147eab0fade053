"""In which order regions are entered where that matters.

SCXML enters all regions at once, and chooses among default transitions with guards afterwards.  Where a later
region has to do with what is chosen, it waits: its first state is one that is not drawn, and is left without
an event when no region before it waits any more.
"""

from dataclasses import dataclass

from rovercheck.checker.export.scxml.paths import within
from rovercheck.spec_model.lang.action import Action, reads, writes
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.lang.wellformed.places import legs


@dataclass(frozen=True)
class Waiting:
    """A region that is entered after others: these, and the entry actions that it begins with."""

    after: tuple[Path, ...]
    entry: tuple[Action, ...]


class EntryOrder:
    """The regions of a chart that wait, and those whose entry actions run only when they have waited.

    Raises ``ModelError`` for a transition from elsewhere into one of them.
    """

    def __init__(self, chart: Chart) -> None:
        self._chart, self._legs = chart, legs(chart)
        self.waiting: dict[Path, Waiting] = {}
        self.late: set[Path] = set()
        for path, state in chart.states.items():
            if state.parallel and path not in self.late:
                self._order([(*path, one.name) for one in state.states])
        for leg in self._legs:
            for region in self.waiting:
                into = leg.complete and within(leg.end, region) and leg.end != region
                if into and not within(leg.source, region):
                    self._refuse(leg.where, region)

    def _order(self, regions: list[Path]) -> None:
        first = next((n for n, one in enumerate(regions) if self._chooses(one)), len(regions))
        later = regions[first + 1 :]
        if any(self._have_to_do(one, other) for n, one in enumerate(regions[first:]) for other in later[n:]):
            for number, region in enumerate(later, first + 1):
                self._wait(region, tuple(regions[:number]), ())

    def _wait(self, region: Path, after: tuple[Path, ...], entry: tuple[Action, ...]) -> None:
        state = self._chart.states[region]
        self.late.add(region)
        entry = (*entry, *state.entry)
        if not state.parallel:
            self.waiting[region] = Waiting(after, entry)
            return
        inner = tuple((*region, one.name) for one in state.states)
        for number, one in enumerate(inner):
            self._wait(one, (*after, *inner[:number]), () if number else entry)

    def _chooses(self, region: Path) -> bool:
        """Whether a composite in a region has default transitions with guards."""
        choices = (leg.source for leg in self._legs if leg.default and leg.segment.guard is not None)
        return any(within(path, region) for path in choices)

    def _have_to_do(self, one: Path, other: Path) -> bool:
        """Whether it matters which of two regions is entered first."""
        read, written = self._entering(one)
        read_there, written_there = self._entering(other)
        return bool(written & (read_there | written_there) or read & written_there)

    def _entering(self, region: Path) -> tuple[set[str], set[str]]:
        """The names of what is read and written when a region is entered; active states count as written."""
        inside = {p: s for p, s in self._chart.states.items() if within(p, region)}
        segments = [leg.segment for leg in self._legs if leg.default and leg.source in inside]
        actions: list[Action] = [a for s in inside.values() for a in s.entry]
        actions += [a for s in segments for a in (*s.do, *s.then)]
        read = reads(actions) | variables(*(s.guard for s in segments if s.guard is not None))
        places = {self._chart.location(p).name for p, s in inside.items() if s.states and not s.parallel}
        return {*read}, {*writes(actions), *places}

    def _refuse(self, where: str, region: Path) -> None:
        raise ModelError(
            f"{self._chart.name}: {where} leads into {'.'.join(region)}, which begins when regions before it "
            "have chosen among default transitions with guards; SCXML enters all of them at once. Let it "
            f"lead to {'.'.join(region[:-1]) or self._chart.name}, and choose inside."
        )


__all__ = ["EntryOrder", "Waiting"]
