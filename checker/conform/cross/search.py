"""The search for mismatches: fixed runs, recorded runs, then random ones by Hypothesis."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from random import SystemRandom

from hypothesis import HealthCheck, Phase, given, seed, settings

from checker.conform.cross.beside import Mismatch, Step, compared, played
from checker.conform.cross.coverage import Coverage
from checker.conform.cross.environment import Environment
from checker.conform.cross.result import SHOWN, Failure, Result
from checker.conform.cross.smaller import BUDGET, Budget, smaller
from checker.conform.cross.stimulus import Stimulus
from checker.conform.cross.strategy import stimuli
from checker.conform.implementation import Implementation, ImplementationError, Values, notes, run

CI_SEED = 5
NIGHTLY = 20
"""Nightly examples for each one in CI."""
SHRINKING = 20_000
"""Steps of the charts that Hypothesis may spend after the first new mismatch."""
FAILURES = 3
"""Runs that an implementation may fail to survive before the search gives it up."""


@dataclass(frozen=True)
class Effort:
    """How many random runs, and from which seed they are drawn."""

    examples: int
    seed: int


def effort(profile: str, examples: int | None = None, seed: int | None = None) -> Effort:
    """The effort of a profile, ``ci`` or ``nightly``, changed as told.  CI draws the same runs every time."""
    ci = profile == "ci"
    drawn = CI_SEED if ci else SystemRandom().getrandbits(32)
    return Effort(
        examples=examples if examples is not None else CI_EXAMPLES * (1 if ci else NIGHTLY),
        seed=seed if seed is not None else drawn,
    )


CI_EXAMPLES = 240

Run = tuple[str, list[Step]]
Progress = Callable[["Search"], None]


class Enough(BaseException):
    """Nothing more is to be tried; Hypothesis lets it through at once."""


class _Found(Exception):
    """A mismatch, for Hypothesis; each key has a class of its own, so that each is shrunk by itself."""


@dataclass
class Search:
    """One cross-check under way."""

    env: Environment
    implementation: Implementation
    effort: Effort
    stop_early: bool = False
    budget: int = BUDGET
    progress: Progress = lambda search: None
    record: Callable[[str, list[Step]], None] = lambda origin, steps: None
    coverage: Coverage = field(init=False)
    found: dict[tuple[object, ...], Mismatch] = field(default_factory=dict)
    failures: list[Failure] = field(default_factory=list)
    doing: str = ""
    tried: int = 0
    interrupted: bool = False

    def __post_init__(self) -> None:
        self.coverage = Coverage(self.env.board)
        self._seen: set[str] = set()
        self._classes: dict[tuple[object, ...], type[_Found]] = {}
        self._failing: dict[Stimulus, _Found] = {}
        self._shrinking = Budget(min(SHRINKING, self.budget))

    def run(self, runs: Iterable[Run] = ()) -> Result:
        """Try these runs, then random ones; what was found so far also after Ctrl-C."""
        try:
            with suppress(Enough):
                self._try_all("fixed runs", runs)
                self._random()
            shown = [] if self.stop_early else list(self._small())
        except KeyboardInterrupt:
            self.interrupted, shown = True, list(self.found.values())
        return self._result(shown or list(self.found.values()))

    def _result(self, shown: list[Mismatch]) -> Result:
        shown.sort(key=lambda m: (m.tick, str(m.key)))
        return Result(
            self.env.board,
            self.coverage,
            tuple(shown[:SHOWN]),
            len(self.found),
            tuple(sorted(self.failures, key=lambda f: f.tick)),
            tuple(o.name for o in self.env.board.outputs if o.name not in self._seen),
            notes(self.implementation),
            self.effort.examples,
            self.effort.seed,
            self.interrupted,
        )

    def _small(self) -> Iterator[Mismatch]:
        """The mismatches to be shown, made small; the shortest first."""
        todo = sorted(self.found.values(), key=lambda m: (m.tick, str(m.key)))[:SHOWN]
        for number, mismatch in enumerate(todo, 1):
            self.doing = f"making mismatch {number} of {len(todo)} small"
            self.progress(self)
            yield smaller(self.env, mismatch, self.implementation, Budget(self.budget))

    def _try_all(self, doing: str, runs: Iterable[Run]) -> None:
        self.doing = doing
        for origin, steps in runs:
            self.attempt(origin, steps)
            self.progress(self)

    def attempt(self, origin: str, steps: list[Step]) -> Mismatch | None:
        """Compare one run.  Raises ``Enough`` when the search is over."""
        self.coverage.add(steps)
        self.record(origin, steps)
        try:
            mismatch = self._compared(steps)
        except ImplementationError as error:
            mismatch = self._failed(origin, steps, error)
        if mismatch is not None:
            mismatch = self._keep(replace(mismatch, origin=origin))
        if len(self.failures) >= FAILURES or (self.stop_early and (self.failures or self.found)):
            raise Enough
        return mismatch

    def _compared(self, steps: list[Step]) -> Mismatch | None:
        return compared(self.env.board, steps, _Listening(self.implementation, self._seen))

    def _failed(self, origin: str, steps: list[Step], error: ImplementationError) -> Mismatch | None:
        """Keep the failure; what differs in the steps before it, whose outputs were lost."""
        failed = tuple(steps[: error.step])
        self.failures.append(Failure(self.env.board, origin, str(error), failed))
        with suppress(ImplementationError):  # it failed earlier this time
            return self._compared(steps[: error.step - 1]) if error.step > 1 else None
        return None

    def _keep(self, mismatch: Mismatch) -> Mismatch:
        known = self.found.get(mismatch.key)
        if known is None or mismatch.tick < known.tick:
            self.found[mismatch.key] = mismatch
        return mismatch

    # --- by Hypothesis ---

    def _random(self) -> None:
        """Random runs; those with a new mismatch are shrunk as long as the budget lasts."""
        self.doing = "random runs"
        if not self.effort.examples:
            return
        before = frozenset(self.found)

        def one(stimulus: Stimulus) -> None:
            self._example(stimulus, before)

        phases = (Phase.generate,) if self.stop_early else (Phase.generate, Phase.shrink)
        drawing = settings(
            max_examples=self.effort.examples,
            deadline=None,
            database=None,
            phases=phases,
            print_blob=False,
            suppress_health_check=list(HealthCheck),
        )
        test = seed(self.effort.seed)(drawing(given(stimuli(self.env))(one)))
        try:
            test()
        except* _Found:
            pass

    def _example(self, stimulus: Stimulus, before: frozenset[tuple[object, ...]]) -> None:
        if stimulus in self._failing:
            raise self._failing[stimulus]
        if self._failing and not self._shrinking.take(len(stimulus)):
            return
        if not self._failing:
            self.tried += 1
        steps = played(self.env.board, self.env.fields, stimulus)
        mismatch = self.attempt(f"random run {self.tried}", steps)
        self.progress(self)
        if mismatch is not None and mismatch.key not in before:
            kind = self._classes.setdefault(mismatch.key, type("Found", (_Found,), {}))
            self._failing[stimulus] = kind()
            raise self._failing[stimulus]


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
