"""How mutants are judged: by runs that are known first, at home and nearby, then by searches."""

from collections.abc import Collection, Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace

from rovercheck.checker.commands.mutate.results import MutationResults
from rovercheck.checker.commands.shared.output import err
from rovercheck.checker.commands.shared.progress import Watch
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.model import Model
from rovercheck.checker.model.kept_runs import KILLS, MUTANTS, PREMISES, KeptRun, file_of, read
from rovercheck.checker.mutate.fate import DOMAINS, NOT_SEARCHED, REFUSED, Fate, MutantFate
from rovercheck.checker.mutate.mutants import Mutant
from rovercheck.checker.mutate.plan import Plan, PlannedMutant, rounds
from rovercheck.checker.mutate.relevance import as_it_is
from rovercheck.checker.mutate.workers import MutantJudged, MutantProgress, fates
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.forms import Property, Reachable, Unbounded

UNKILLED = (Fate.SURVIVOR, Fate.NOTICED, Fate.UNKNOWN)
"""What a mutant may be in its own system that properties of other systems may still kill."""
WORTH_RUNS = 40
"""Such mutants from which on the runs of other systems are searched once, to be tried on each of them."""
OPEN = MutantFate(Fate.UNKNOWN, why=NOT_SEARCHED)


def judge(
    model: Model,
    properties: Sequence[Property],
    todo: Sequence[tuple[str, Mutant]],
    search: SearchSettings,
    alone: bool,
    found: MutationResults,
) -> None:
    """Judge the mutants, each first in its own system; what is found goes to ``found`` at once.

    ``alone``: properties of other systems do not count.
    """
    at = {mutant.id: name for name, mutant in todo}
    recorded = {p.id: _on_record(model, p.id) for p in properties}
    known = [read(file_of(model, kind), kind) for kind in (PREMISES, KILLS, MUTANTS)]
    plan = Plan(model.systems, properties, recorded, on_record=_runs(known))
    stages = _Stages(plan, at, search, found)
    own = [p for p in properties if p.on in set(at.values())]
    stages.decide(own)
    found.undecided += [p.id for p in own if p.id not in plan.proved]
    try:
        left = stages.by_runs([mutant for _, mutant in todo])
        if not alone:
            left = stages.by_runs_nearby(left, {id: kept.system for id, kept in known[-1].items()})
        unkilled = stages.at_home(left, alone)
        stages.elsewhere([mutant for mutant in left if mutant.id in unkilled], unkilled)
    finally:
        order = {mutant.id: number for number, (_, mutant) in enumerate(todo)}
        found.judged.sort(key=lambda one: order[one[1].id])


@dataclass
class _Stages:
    """Stages of judging mutants, each with the system that it is at home in by its id (``at``)."""

    plan: Plan
    at: Mapping[str, str]
    search: SearchSettings
    found: MutationResults
    _asked: set[str] = field(default_factory=set)

    def decide(self, asked: Sequence[Property]) -> None:
        """Let the plan know the verdicts on the originals, in which every run counts."""
        own = {name: as_it_is(self.plan.systems[name]) for name in {p.on for p in asked}}
        self._asked |= {p.id for p in asked}
        for result in results(asked, own, self.search):
            self.plan.learn(result)

    def by_runs(self, todo: Sequence[Mutant]) -> list[Mutant]:
        """Judge by runs that are known and by one query, without a search; the mutants that are left."""
        left = []
        planned = [self.plan.own(mutant, self.at[mutant.id]) for mutant in todo]
        for told in self._fates(planned, {}, search=False):
            if told.judged.fate is Fate.UNKNOWN:
                left.append(told.mutant)
            else:
                self._keep(told.mutant, told.judged)
        return left

    def by_runs_nearby(self, todo: Sequence[Mutant], where: Mapping[str, str]) -> list[Mutant]:
        """The same in other small systems, one after the other, and of mutants that were killed once in those
        ``where`` they were; the mutants that are left.

        What kills counts once it is found out that the original has it.
        """
        left = {mutant.id: mutant for mutant in todo}
        small = self.plan.nearby()
        for name in (*small, *sorted(set(where.values()) & self.plan.systems.keys() - set(small))):
            here = [m for id, m in left.items() if name in small or where.get(id) == name]
            planned = [one for m in here if (one := self.plan.tried_in(name, m, self.at[m.id]))]
            told = list(self._fates(planned, dict.fromkeys(left, OPEN), search=False, drawn=False))
            kills = {one.mutant.id: one.judged for one in told if one.judged.fate is Fate.KILLED}
            self._find_out({judged.killer for judged in kills.values()})
            for id, judged in kills.items():
                if judged.killer in (DOMAINS, REFUSED) or self.plan.proved.get(judged.killer):
                    self._keep(left.pop(id), judged)
        return list(left.values())

    def _find_out(self, ids: Collection[str]) -> None:
        asked = [p for p in self.plan.properties if p.id in ids and p.id not in self._asked]
        if asked:
            self.decide(asked)

    def at_home(self, todo: Sequence[Mutant], alone: bool) -> dict[str, MutantFate]:
        """Search the systems that they are at home in; what is not killed, unless it is judged ``alone``."""
        unkilled: dict[str, MutantFate] = {}
        planned = [self.plan.own(mutant, self.at[mutant.id]) for mutant in todo]
        try:
            for told in self._fates(planned, {}):
                if told.judged.fate in UNKILLED and not alone:
                    unkilled[told.mutant.id] = told.judged
                else:
                    self._keep(told.mutant, told.judged, searched=True)
        except KeyboardInterrupt:
            self._interrupted(todo, unkilled)
            raise
        return unkilled

    def elsewhere(self, todo: Sequence[Mutant], unkilled: dict[str, MutantFate]) -> None:
        """Search the other systems for what kills them after all."""
        try:
            again = [self.plan.elsewhere(mutant, self.at[mutant.id]) for mutant in todo]
            for one in again:
                if not one.cases:
                    self._keep(one.mutant, unkilled.pop(one.mutant.id))
            again = [one for one in again if one.cases]
            if len(again) >= WORTH_RUNS:
                asked = {p.id: p for one in again for case in one.cases for p in case.properties}
                self.decide([p for p in asked.values() if p.id not in self._asked and self._has_run(p)])
            for told in self._fates(again, unkilled, drawn=False):
                unkilled.pop(told.mutant.id)
                self._keep(told.mutant, told.judged, searched=True)
        except KeyboardInterrupt:
            self._interrupted(todo, unkilled)
            raise

    def _interrupted(self, todo: Sequence[Mutant], unkilled: Mapping[str, MutantFate]) -> None:
        why = "interrupted before other systems were looked at"
        for mutant in todo:
            if mutant.id in unkilled:
                judged = unkilled[mutant.id]
                self._keep(mutant, replace(judged, fate=Fate.UNKNOWN, why=judged.why or why))

    def _keep(self, mutant: Mutant, judged: MutantFate, searched: bool = False) -> None:
        self.found.judged.append((self.at[mutant.id], mutant, judged))
        if searched:
            self.found.searched.add(mutant.id)

    def _has_run(self, prop: Property) -> bool:
        """Whether the expected verdict rests on a finite run."""
        if isinstance(prop.form, Unbounded):
            return False
        return self.plan.recorded[prop.id] is isinstance(prop.form, Reachable)

    def _fates(
        self,
        planned: Sequence[PlannedMutant],
        before: Mapping[str, MutantFate],
        search: bool = True,
        drawn: bool = True,
    ) -> Generator[MutantJudged, None, None]:
        """The fates of mutants, round by round, while it is said what is being done."""
        if not planned:
            return
        with Watch(err, len(planned), of="mutants") as watch:
            for some in rounds(planned):
                known = [self.plan.with_runs(one, drawn) for one in some]
                with closing(fates(known, self.search.limits, self.search.jobs, before, search)) as heard:
                    for one in heard:
                        match one:
                            case MutantProgress(mutant, line):
                                watch.say(mutant.id, line)
                            case MutantJudged():
                                watch.finished(one.mutant.id)
                                self.plan.kills(one.judged)
                                yield one


def _runs(known: Sequence[Mapping[str, KeptRun]]) -> dict[str, list[Run]]:
    """The recorded runs, by system, each once."""
    found: dict[str, dict[str, Run]] = {}
    for kept in (one for rows in known for one in rows.values()):
        found.setdefault(kept.system, {}).setdefault(repr(kept.run), kept.run)
    return {name: list(runs.values()) for name, runs in found.items()}


def _on_record(model: Model, id: str) -> bool | None:
    verdict = model.expected(id).verdict
    return None if verdict == "unknown" else verdict == "proved"


__all__ = ["judge"]
