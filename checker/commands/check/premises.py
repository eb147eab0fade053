"""Whether the cases occur that proofs speak of: recorded runs first, then a search."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.output import write
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.model import Model
from rovercheck.checker.model.kept_runs import INVARIANTS, PREMISES, KeptRun, file_of, read, text
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.results.trace import counted_ticks
from rovercheck.checker.results.verdict import Proved, Run, StoredRun, Unknown
from rovercheck.checker.verify.checked import CheckedProperty, PremiseCase
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.forms import Property
from rovercheck.properties.premise import premise
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.store.verdicts import VerdictStore

PATIENCE = 5.0
"""Seconds for each search for a case where verdicts are what is asked for."""
LONG = 60.0
"""Seconds for each where the cases are: a witness may be hard to find."""
UNDECIDED = re.compile(r"(not reproduced on [\w.]+): .*", re.DOTALL)


def cases(
    found: Sequence[CheckedProperty],
    systems: Mapping[str, System],
    search: SearchSettings,
    known: Mapping[str, KeptRun],
    quiet: bool = False,
    shown: Mapping[str, PremiseCase] | None = None,
) -> dict[str, PremiseCase]:
    """For each proof that speaks of a case, by id, whether it occurs on its system.

    A ``known`` run is gone through again on the charts as they are now, unless that was done and it is among
    those ``shown``; only where it does not show the case any more a run is searched for.
    """
    wanted, before = _wanted(found), shown or {}
    found_out = {id: before[id] for id in wanted if id in before}
    again = KnownCases(known, systems, search.store)
    found_out |= again.shown(c for c in found if c.result.property.id not in before)
    left = [case for id, case in wanted.items() if id not in found_out]
    for one in _searched(left, systems, search, quiet):
        found_out[one.property.id] = premise_case(one, systems)
    return found_out


def patient(search: SearchSettings, seconds: float) -> SearchSettings:
    """The same for cases: so many seconds for each at most, and nothing is certified."""
    limits = replace(search.limits, seconds=min(seconds, search.limits.seconds or seconds))
    return SearchSettings(search.engine, limits, search.jobs, store=search.store, traces=False)


@dataclass
class PremiseSearch:
    """Asks of each proof whether its case occurs; ``keep``: for longer, and the runs that show it are kept.

    Recorded runs are replayed as soon as a proof is reported, while the other searches go on.
    """

    model: Model
    systems: Mapping[str, System]
    known: Mapping[str, KeptRun]
    search: SearchSettings
    quiet: bool
    keep: bool
    _told: dict[str, PremiseCase] = field(default_factory=dict)

    def on_result(self, one: CheckedProperty) -> None:
        """Go through the recorded run of a proof that speaks of a case."""
        store = self.search.store
        self._told |= KnownCases(self.known, self.systems, store, replayed=self.keep).shown([one])

    def __call__(self, found: Sequence[CheckedProperty]) -> Mapping[str, PremiseCase]:
        """For each proof that speaks of a case, by id, whether it occurs on its system."""
        search = patient(self.search, LONG if self.keep else PATIENCE)
        told = cases(found, self.systems, search, self.known, self.quiet, self._told)
        if self.keep:
            record(told, self.model)
        return told


def record(known: Mapping[str, PremiseCase], model: Model) -> None:
    """Keep the runs that show the cases; those of properties that were not asked for stay as they are.

    Raises ``UsageError`` where the file cannot be written.
    """
    file = file_of(model)
    others = {id: kept for id, kept in read(file).items() if id in model.properties and id not in known}
    new = {id: case.kept for id, case in known.items() if case.kept is not None}
    write(text({**others, **new}), file)


def recordable(model: Model, variant: str, kind: str = PREMISES) -> None:
    """Raises ``UsageError`` where none of that kind can be kept, before anything is searched."""
    if variant:
        what = "invariants" if kind == INVARIANTS else "runs"
        raise UsageError(
            f"--record-{kind} keeps {what} of the charts as they are, not {variant}. Leave one of them out."
        )
    file = file_of(model, kind)
    if not file.parent.is_dir() or file.is_dir():
        raise UsageError(f"Cannot write {whole(file)}: it is no file in a folder that exists.")


def _wanted(found: Sequence[CheckedProperty]) -> dict[str, Property]:
    """The cases that proofs speak of, by id."""
    proved = (c.result.property for c in found if isinstance(c.verdict, Proved))
    return {prop.id: case for prop in proved if (case := premise(prop)) is not None}


@dataclass(frozen=True)
class KnownCases:
    """Cases of which runs are recorded.  ``replayed``: the runs are wanted, so that all are gone through."""

    known: Mapping[str, KeptRun]
    systems: Mapping[str, System]
    store: "VerdictStore | None"
    replayed: bool = False

    def shown(self, found: Iterable[CheckedProperty]) -> Iterator[tuple[str, PremiseCase]]:
        """The cases that recorded runs still show, by id."""
        for one in found:
            for id, case in _wanted([one]).items():
                kept = self.known.get(id)
                if kept is not None and kept.system in self.systems:
                    run = self._shown(case, kept, one.result)
                    if run is not None:
                        said = _occurs(len(run), self.systems[kept.system])
                        yield id, PremiseCase(True, said, replace(kept, run=run))

    def _shown(self, case: Property, kept: KeptRun, of: Result) -> Run | None:
        """The part of a run up to a case, if it shows that; one that did before is not gone through again."""
        if self.store is None:
            return self._gone_through(case, kept)
        names = self._names(self.store, case, kept, of)
        before = () if self.store.recheck or self.replayed else tuple(map(self.store.read, names))
        runs = (one.verdict.because for one in before if one is not None)
        known = next((one.run for one in runs if isinstance(one, StoredRun)), None)
        found = self._gone_through(case, kept) if known is None else known
        if found is not None and (known is None or None in before):
            shown = Proved(StoredRun(found, len(found) * self.systems[kept.system].tick_ms), "replay")
            self.store.write_under(names, shown, kept.system)
        return found

    def _gone_through(self, case: Property, kept: KeptRun) -> Run | None:
        """What the run shows; of a long one compiled Python says it alone where what is kept is believed."""
        from rovercheck.checker.verify.runs.known_runs import reached_by

        confirmed = self.store is None or self.store.recheck or self.replayed
        asked = replace(case, on=kept.system)
        return reached_by(kept.run, self.systems[kept.system], asked, confirmed=confirmed)

    def _names(self, store: "VerdictStore", case: Property, kept: KeptRun, of: Result) -> list[str]:
        """The names to keep it under: by the slices that the proof depends on, which hold all of the case."""
        about = kept.system in (of.property.on, self.systems[of.property.on].concrete)
        by = of.same_under if about else ()
        whole = (self.systems[kept.system],) if not by else ()
        names = (store.about("case", case, one, kept.run) for one in (*by, *whole))
        return [name for name in names if name is not None]


def _searched(
    asked: Sequence[Property], systems: Mapping[str, System], search: SearchSettings, quiet: bool
) -> Iterator[Result]:
    """What came of searching for cases; where none is found on the rover, on the system that was searched."""
    named = dict.fromkeys(name for case in asked for name in (case.on, systems[case.on].concrete) if name)
    wanted = {name: systems[name] for name in named}
    free = {name: replace(system, over=False, concrete="") for name, system in wanted.items()}
    first = {name: system if system.concrete else free[name] for name, system in wanted.items()}
    again = list[Property]()
    for one in results(asked, first, search, quiet) if asked else ():
        if not isinstance(one.verdict, Proved) and first[one.property.on].over:
            again.append(one.property)
        else:
            yield one
    if again:
        yield from results(again, free, search, quiet)


def premise_case(one: Result, systems: Mapping[str, System]) -> PremiseCase:
    """What came of the search for a case."""
    from rovercheck.checker.verify.runs.known_runs import run_of

    match one.verdict:
        case Unknown(reason):
            return PremiseCase(None, "not known: " + UNDECIDED.sub(r"\1 within the limits", reason))
        case Proved() as verdict:
            run = run_of(verdict)
            assert run is not None, "what is reached is reached by a run"
            return PremiseCase(True, _occurs(len(run), systems[one.system]), KeptRun(one.system, run))
    part = ", as far as was searched" if one.in_part else ""
    return PremiseCase(False, f"it NEVER occurs, so the proof is vacuous{part}: {evidence(one)}")


def _occurs(ticks: int, system: System) -> str:
    more = ", which has more runs than it should" if system.over else ""
    return f"it occurs: after {counted_ticks(ticks)} of {system.name}{more}"


__all__ = ["LONG", "PATIENCE", "PremiseSearch", "cases", "premise_case", "record", "recordable"]
