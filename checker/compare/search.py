"""The search for mismatches: fixed runs, recorded runs, then random ones that Hypothesis draws."""

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from random import SystemRandom

from hypothesis import HealthCheck, Phase, given, seed, settings

from rovercheck.checker.adapters.implementation import Implementation, ImplementationError, Values, notes, run
from rovercheck.checker.compare.beside import ComparedStep, StepMismatch, compared, played
from rovercheck.checker.compare.coverage import TransitionCoverage
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.result import (
    ALLOWED,
    FIXED,
    RANDOM,
    Allowance,
    CompareResult,
    CompareStage,
    Failure,
)
from rovercheck.checker.compare.smaller import Budget, smaller
from rovercheck.checker.compare.stimulus import Stimulus
from rovercheck.checker.compare.strategy import stimuli

CI_SEED = 5
NIGHTLY = 20
"""Nightly examples for each one in CI."""


CI_EXAMPLES = 240


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


Run = tuple[str, list[ComparedStep]]
Progress = Callable[["CompareSearch"], None]


class Enough(BaseException):
    """Nothing more is to be tried; Hypothesis lets it through at once."""


@dataclass
class CompareSearch:
    """One cross-check under way."""

    env: Environment
    implementation: Implementation
    effort: CompareEffort
    stop_early: bool = False
    allowance: Allowance = ALLOWED
    progress: Progress = lambda search: None
    record: Callable[[str, list[ComparedStep]], None] = lambda origin, steps: None
    coverage: TransitionCoverage = field(init=False)
    found: dict[tuple[object, ...], StepMismatch] = field(default_factory=dict)
    failures: list[Failure] = field(default_factory=list)
    doing: str = FIXED
    tried: dict[str, int] = field(default_factory=lambda: {FIXED: 0, RANDOM: 0})
    compared: int = 0
    interrupted: bool = False

    def __post_init__(self) -> None:
        self.coverage = TransitionCoverage(self.env.board)
        self._seen: set[str] = set()
        self._complete = False
        self._small: dict[tuple[object, ...], StepMismatch] = {}

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
        small = sorted(self._small.values(), key=_length)
        others = sorted((m for key, m in self.found.items() if key not in self._small), key=_length)
        return CompareResult(
            self.env.board,
            self.coverage,
            (*small, *others),
            len(small),
            tuple(sorted(self.failures, key=lambda f: f.tick)),
            tuple(o.name for o in self.env.board.outputs if o.name not in self._seen),
            notes(self.implementation),
            self.effort.examples,
            self.effort.seed,
            self.interrupted,
            self._stages(),
            self.compared,
            self.allowance,
        )

    def _stages(self) -> tuple[CompareStage, ...]:
        """How much of each kind of runs was tried, and why not all of it."""
        if self.interrupted:
            why = "interrupted"
        elif self._hopeless:
            why = f"given up after {len(self.failures)} run{'s' * (len(self.failures) != 1)} not survived"
        else:
            why = "only the first mismatch was wanted" if self.stop_early else "no more could be drawn"
        drawn = self.tried[RANDOM]
        return (
            CompareStage(FIXED, self.tried[FIXED], None, "" if self._complete else why),
            CompareStage(RANDOM, drawn, self.effort.examples, "" if drawn >= self.effort.examples else why),
        )

    @property
    def _hopeless(self) -> bool:
        return len(self.failures) >= self.allowance.failures

    def _make_small(self) -> None:
        """Make the mismatches small that are told in full, the shortest first."""
        todo = sorted(self.found.items(), key=lambda item: _length(item[1]))[: self.allowance.mismatches]
        for number, (key, mismatch) in enumerate(todo, 1):
            self.doing = f"making mismatch {number} of {len(todo)} small"
            self.progress(self)
            self._small[key] = smaller(self.env, mismatch, self.implementation, Budget(self.allowance.budget))

    def _try_all(self, runs: Iterable[Run]) -> None:
        for origin, steps in runs:
            self._try(origin, steps)
        self._complete = True

    def _try(self, origin: str, steps: list[ComparedStep]) -> None:
        self.tried[self.doing] += 1
        self.attempt(origin, steps)
        self.progress(self)

    def attempt(self, origin: str, steps: list[ComparedStep]) -> StepMismatch | None:
        """Compare one run.  Raises ``Enough`` when the search is over."""
        self.coverage.add(steps)
        self.record(origin, steps)
        answered = len(steps)
        try:
            mismatch = self._compared(steps)
        except ImplementationError as error:
            mismatch, answered = self._failed(origin, steps, error), max(0, error.step - 1)
        self.compared += answered if mismatch is None else mismatch.tick
        if mismatch is not None:
            mismatch = self._keep(replace(mismatch, origin=origin))
        if self._hopeless or (self.stop_early and (self.failures or self.found)):
            raise Enough
        return mismatch

    def _compared(self, steps: list[ComparedStep]) -> StepMismatch | None:
        return compared(self.env.board, steps, _Listening(self.implementation, self._seen))

    def _failed(
        self, origin: str, steps: list[ComparedStep], error: ImplementationError
    ) -> StepMismatch | None:
        """Keep the failure; what differs in the steps before it, whose outputs were lost."""
        failed = tuple(steps[: error.step])
        self.failures.append(Failure(self.env.board, origin, str(error), failed))
        with suppress(ImplementationError):  # it failed earlier this time
            return self._compared(steps[: error.step - 1]) if error.step > 1 else None
        return None

    def _keep(self, mismatch: StepMismatch) -> StepMismatch:
        known = self.found.get(mismatch.key)
        if known is None or mismatch.tick < known.tick:
            self.found[mismatch.key] = mismatch
        return mismatch

    # --- by Hypothesis ---

    def _random(self) -> None:
        """Random runs: all that were asked for, whatever is found in them."""
        self.doing = RANDOM
        if not self.effort.examples:
            return

        def one(stimulus: Stimulus) -> None:
            steps = played(self.env.board, self.env.fields, stimulus)
            self._try(f"random run {self.tried[RANDOM] + 1}", steps)

        drawing = settings(
            max_examples=self.effort.examples,
            deadline=None,
            database=None,
            phases=(Phase.generate,),
            print_blob=False,
            suppress_health_check=list(HealthCheck),
        )
        seed(self.effort.seed)(drawing(given(stimuli(self.env))(one)))()


def _length(mismatch: StepMismatch) -> tuple[int, str]:
    """The order in which mismatches are told."""
    return mismatch.tick, str(mismatch.key)


@dataclass
class _Listening:
    """An implementation whose outputs are noted by name."""

    implementation: Implementation
    seen: set[str]

    def reset(self) -> None:
        self.implementation.reset()

    def step(self, inputs: Values) -> Values:
        return self.run([inputs])[0]

    def run(self, inputs: Sequence[Values]) -> list[Values]:
        found = list(run(self.implementation, inputs))
        self.seen.update(*found)
        return found

    def close(self) -> None:
        self.implementation.close()
