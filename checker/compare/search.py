"""The search for mismatches: fixed runs, recorded runs, then random ones that Hypothesis draws."""

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from random import SystemRandom

from rovercheck.checker.adapters.implementation import Implementation, notes
from rovercheck.checker.compare.beside import ComparedStep, Run, StepMismatch, differing, rerun
from rovercheck.checker.compare.coverage import TransitionCoverage
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.evidence_runs import EvidenceRuns
from rovercheck.checker.compare.known_changes import KnownChanges
from rovercheck.checker.compare.notable_runs import NotableRuns
from rovercheck.checker.compare.result import (
    ALLOWED,
    DECIDING,
    FIXED,
    RANDOM,
    Allowance,
    CompareResult,
    CompareStage,
    Failure,
)
from rovercheck.checker.compare.run_follower import RecordedRun, RunFollower
from rovercheck.checker.compare.smaller import Budget, mismatch_of, smaller
from rovercheck.checker.compare.tried_runs import (
    SHARE,
    RunCoverage,
    RunsLost,
    RunTrier,
    Share,
    TriedRun,
    shares,
)
from rovercheck.checker.conformance.deviations import Deviation, DeviationTally, WholeEvidence
from rovercheck.checker.conformance.follower import Situation
from rovercheck.checker.conformance.recording import Recording
from rovercheck.spec_model.lang.errors import ModelError

CI_SEED = 5
NIGHTLY = 20
"""Nightly examples for each one in CI."""


CI_EXAMPLES = SHARE


@dataclass(frozen=True)
class CompareEffort:
    """How many random runs, and from which seed they are drawn."""

    examples: int
    seed: int


def effort(profile: str, examples: int | None = None, seed: int | None = None) -> CompareEffort:
    """The effort of a profile, ``ci`` or ``nightly``, changed as told.  CI draws the same runs every time."""
    ci = profile == "ci"
    drawn = CI_SEED if ci else SystemRandom().getrandbits(32)
    return CompareEffort(
        examples=examples if examples is not None else CI_EXAMPLES * (1 if ci else NIGHTLY),
        seed=seed if seed is not None else drawn,
    )


CI = effort("ci")


Progress = Callable[["CompareSearch"], None]
Elsewhere = Callable[[Sequence[Share]], Iterable[TriedRun]]
"""Tries the random runs of some shares, and says what came of each, in their order.  Raises ``RunsLost``."""
Leading = Callable[[Sequence[Deviation], EvidenceRuns], Sequence[Deviation]]
"""Says which deviations are to be told in full, the first ones first, from all of them and their runs."""


class Enough(BaseException):
    """Nothing more is to be tried; Hypothesis lets it through at once."""


@dataclass
class CompareSearch:
    """One cross-check under way.

    ``record`` is given what the charts do in each run, ``deviating`` each run of the implementation that is
    not theirs.  ``watched``: whether the result says what was put to the test.  ``leading`` is asked once all
    runs are done.  ``known``: runs are followed beside the changes that explain what is known, too.
    ``elsewhere`` tries the random runs, if not this process.
    """

    env: Environment
    implementation: Implementation
    effort: CompareEffort
    stop_early: bool = False
    allowance: Allowance = ALLOWED
    progress: Progress = lambda search: None
    record: Callable[[str, list[ComparedStep]], None] = lambda origin, steps: None
    coverage: TransitionCoverage = field(init=False)
    watched: bool = False
    deviating: Callable[[RecordedRun], None] = lambda run: None
    leading: Leading = lambda found, runs: found
    known: KnownChanges | None = None
    elsewhere: Elsewhere | None = None
    tally: DeviationTally = field(default_factory=DeviationTally)
    notable: NotableRuns = field(default_factory=NotableRuns)
    failures: list[Failure] = field(default_factory=list)
    doing: str = FIXED
    tried: dict[str, int] = field(default_factory=lambda: {FIXED: 0, RANDOM: 0})
    compared: int = 0
    interrupted: bool = False

    def __post_init__(self) -> None:
        self.coverage = TransitionCoverage(self.env.board)
        self._seen: set[str] = set()
        self._complete, self._lost = False, ""
        self._small: list[StepMismatch] = []
        self._trier = RunTrier(self.env.board, self.implementation, self.watched)
        self._follower = RunFollower(self.env.board, self.watched)
        self._runs: dict[tuple[str, int], RecordedRun] = {}
        self._undecided = Counter[tuple[str, str]]()
        self._situations = set[Situation]()
        self._evidence = EvidenceRuns()
        self._times, self._more = Counter[str](), DeviationTally()

    def run(self, runs: Iterable[Run] = ()) -> CompareResult:
        """Try these runs, then random ones; what was found so far also after Ctrl-C."""
        try:
            with suppress(Enough):
                self._try_all(runs)
                self._random()
            if not self.stop_early:
                self._make_small()
        except KeyboardInterrupt:
            self.interrupted = True
        return self._result()

    def _result(self) -> CompareResult:
        told = {one.key for one in self._small}
        others = [one for one in self._mismatches() if one.key not in told]
        return CompareResult(
            self.env.board,
            self.coverage,
            (*self._small, *others),
            len(self._small),
            tuple(sorted(self.failures, key=lambda f: f.tick)),
            tuple(o.name for o in self.env.board.outputs if o.name not in self._seen),
            notes(self.implementation),
            self.effort.examples,
            self.effort.seed,
            self.interrupted,
            self._stages(),
            self.compared,
            self.allowance,
            dict(self._undecided),
            frozenset(self._situations),
            self.tally,
            self.notable,
            bool(self._lost),
        )

    def _mismatches(self) -> list[StepMismatch]:
        """The distinct mismatches so far, what explains most first."""
        return [self._mismatch(one) for one in self._deviations()]

    def _deviations(self) -> Sequence[Deviation]:
        found = self.tally.deviations()
        return found if self.known is None else self.known.told(found)

    def _mismatch(self, deviation: Deviation) -> StepMismatch:
        """A deviation in the run in which it is met first; on top of causes found, in one that is kept."""
        key = deviation.origin, deviation.first.tick
        if key not in self._runs:
            self._runs[key] = self._evidence.run(self.env.board, deviation.origin)[1].up_to(key[1])
        return mismatch_of(self._runs[key], deviation)

    def _stages(self) -> tuple[CompareStage, ...]:
        """How much of each kind of runs was tried, and why not all of it."""
        if self.interrupted:
            why = "interrupted"
        elif self._hopeless:
            why = f"given up after {len(self.failures)} run{'s' * (len(self.failures) != 1)} not survived"
        else:
            why = "only the first mismatch was wanted" if self.stop_early else "no more could be drawn"
            why = self._lost or why
        drawn = self.tried[RANDOM]
        stages = (
            CompareStage(FIXED, self.tried[FIXED], None, "" if self._complete else why),
            CompareStage(RANDOM, drawn, self.effort.examples, "" if drawn >= self.effort.examples else why),
        )
        if DECIDING not in self.tried:
            return stages
        cut = "interrupted" if self.interrupted and self.doing == DECIDING else ""
        return (*stages, CompareStage(DECIDING, self.tried[DECIDING], None, cut))

    @property
    def _hopeless(self) -> bool:
        return len(self.failures) >= self.allowance.failures

    def _make_small(self) -> None:
        """Make the mismatches small that are told in full, what explains most first."""
        self.doing = "looking for causes"
        first = self.leading(self._deviations(), self._evidence)
        while self._decided():
            first = self.leading(self._deviations(), self._evidence)
        for one in () if self.known is None else self.known.further():
            self.tally.add([one], self.tally.evidence or WholeEvidence())
            self.notable.more(*self._evidence.run(self.env.board, one.origin), [one])
        for origin, on_top in ({} if self.known is None else self.known.left).items():
            self.notable.more(*self._evidence.run(self.env.board, origin), on_top)
        todo = [self._mismatch(one) for one in first[: self.allowance.mismatches]]
        left = self.allowance.total
        for number, mismatch in enumerate(todo, 1):
            self.doing = f"making mismatch {number} of {len(todo)} small"
            self.progress(self)
            budget = Budget(min(left, self.allowance.budget))
            before = budget.left
            follower = self._follower_of(mismatch)
            self._small.append(smaller(self.env, mismatch, self.implementation, budget, follower))
            left -= min(before, before - budget.left)

    def _follower_of(self, mismatch: StepMismatch) -> RunFollower:
        scope = mismatch.deviation and mismatch.deviation.scope
        if self.known is not None and scope and scope.on_top:
            return self.known.follower(scope.part)
        return self._follower

    def _try_all(self, runs: Iterable[Run]) -> None:
        for origin, steps in runs:
            self._try(self._origin(origin), steps)
        self._complete = True

    def _origin(self, label: str) -> str:
        """Several runs are made for one purpose: what is told of one must be of this one."""
        self._times[label] += 1
        return label if self._times[label] == 1 else f"{label} ({self._times[label]})"

    def _try(self, origin: str, steps: list[ComparedStep]) -> None:
        """Compare one run to its end.  Raises ``Enough`` when the search is over."""
        self.record(origin, steps)
        self._take(self._trier.tried(origin, steps))

    def _take(self, run: TriedRun) -> None:
        """What came of a run.  Raises ``Enough`` when the search is over."""
        self._count(run)
        if run.steps or self.watched:
            self._follow(RecordedRun(self.env.board, run.origin, run.steps, run.outputs))
        if self._hopeless or (self.stop_early and (self.failures or self.tally.groups)):
            raise Enough
        self.progress(self)

    def _count(self, run: TriedRun) -> None:
        self.tried[self.doing] += 1
        self.coverage.add(run.met)
        if run.failed is not None:
            failed, number = run.failed, self.coverage.runs
            self.failures.append(Failure(self.env.board, run.origin, failed.because, failed.steps, number))
        self._seen |= run.seen
        self.compared += run.answered

    def _follow(self, run: RecordedRun) -> None:
        """Part by part through the charts, to the end."""
        found = self._follower.behaviour(run)
        self._situations |= found.situations
        groups, evidence = found.tally.groups, found.tally.evidence
        if not groups and not found.undecided:
            return
        undecided, on_top = (found.undecided, ()) if self.known is None else self.known.followed(run, found)
        for part in undecided:
            self._undecided[part.part, part.because] += 1
        self.deviating(run)
        self._evidence.add(self.coverage.runs, run, groups, (one.part for one in found.undecided))
        every = [*groups.values(), *on_top]
        if every:
            self.notable.add(self.coverage.runs, run, every)
        for one in every:
            self._runs[run.origin, one.first.tick] = run.up_to(one.first.tick)
        self.tally.add(groups.values(), evidence or WholeEvidence(), run.origin)

    def _decided(self) -> bool:
        """Whether some run that is chosen for the causes found shows that they are others, or not all.

        Only such runs are evidence, of the parts in which they show it: the causes explain the others.
        """
        effort = self.effort
        more = None if self.known is None else self.known.deciding(effort.examples, effort.seed)
        if self.known is None or more is None:
            return False
        self.doing = DECIDING
        self.tried.setdefault(DECIDING, 0)
        trier, follower = RunTrier(more.board, self.implementation, always=True), RunFollower(more.board)
        shown, explained = set[str](), list[Recording]()
        for origin, steps in more.runs():
            try:
                drawn = tuple(rerun(self.env.board, (step.inputs for step in steps)))
            except ModelError:  # the charts as drawn assume that such inputs do not come
                continue
            run = replace(trier.tried(self._origin(origin), steps), met=RunCoverage.of(more.board, drawn))
            if run.failed is not None:
                run = replace(run, failed=replace(run.failed, steps=drawn[: len(run.failed.steps)]))
            self._count(run)
            own = RecordedRun(self.env.board, run.origin, drawn[: len(run.outputs)], run.outputs)
            left = self._parts_beside(follower, run) & more.parts
            if left:
                shown |= left
                self._chosen(own, left)
            elif own.steps:
                explained.append(own.recording)
            self.progress(self)
            if self._hopeless:
                break
        self.known.shown(frozenset(shown), self._more.deviations(), explained)
        return bool(shown)

    @staticmethod
    def _parts_beside(follower: RunFollower, run: TriedRun) -> frozenset[str]:
        """The parts in which a run differs from what is followed, or may do so as they are not decided."""
        if not differing(run.steps, run.outputs):
            return frozenset()
        found = follower.behaviour(RecordedRun(follower.board, run.origin, run.steps, run.outputs))
        differ = frozenset(scope.part for scope in found.tally.groups)
        return differ or frozenset(one.part for one in found.undecided)

    def _chosen(self, run: RecordedRun, parts: Collection[str]) -> None:
        found = self._follower.behaviour(run).tally
        self._evidence.choose(self.coverage.runs, run)
        own = [one for scope, one in found.groups.items() if scope.part in parts]
        self._more.add(own, found.evidence or WholeEvidence(), run.origin)

    def _random(self) -> None:
        """Random runs: all that were asked for, whatever is found in them."""
        self.doing = RANDOM
        some = shares(self.effort.examples, self.effort.seed)
        if self.elsewhere is None:
            for share in some:
                share.each(self.env, lambda steps: self._try(self._drawn, steps))
        elif some:
            try:
                for run in self.elsewhere(some):
                    self._take(replace(run, origin=self._drawn))
            except RunsLost as lost:
                self._lost = str(lost)

    @property
    def _drawn(self) -> str:
        return f"random run {self.tried[RANDOM] + 1}"
