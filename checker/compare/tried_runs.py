"""Runs of an implementation beside the charts, tried by themselves: here, or where they are sent to."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256

from hypothesis import HealthCheck, Phase, given, seed, settings

from rovercheck.checker.adapters.implementation import Implementation, ImplementationError, Values, run
from rovercheck.checker.compare.beside import ComparedStep, answers, differing, played
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.stimulus import Stimulus
from rovercheck.checker.compare.strategy import stimuli
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.interpret import FiredTransition

SHARE = 240
"""Random runs that are drawn from one seed."""


@dataclass(frozen=True)
class RunCoverage:
    """What a run of the charts meets: how many steps, transitions that they take, and values of inputs."""

    steps: int
    fired: frozenset[FiredTransition]
    values: Mapping[str, frozenset[float]]

    @staticmethod
    def of(board: Board, steps: Sequence[ComparedStep]) -> "RunCoverage":
        names = [signal.name for signal in board.inputs if not signal.stamp]
        return RunCoverage(
            len(steps),
            frozenset(fired for step in steps for fired in step.fired),
            {name: frozenset(step.inputs[name] for step in steps) for name in names},
        )


@dataclass(frozen=True)
class FailedRun:
    """A run that the implementation did not survive: why, and its steps up to that one."""

    because: str
    steps: tuple[ComparedStep, ...]


class RunsLost(Exception):
    """No more random runs can be tried elsewhere; the message says why."""


@dataclass(frozen=True)
class TriedRun:
    """A run, and what the implementation made of it.

    ``answered`` is in how many steps, ``seen`` are the names of its outputs; ``steps`` and ``outputs`` are
    there where it differs from the charts, or wherever they are wanted.
    """

    origin: str
    met: RunCoverage
    answered: int
    seen: frozenset[str]
    steps: tuple[ComparedStep, ...] = ()
    outputs: tuple[Values, ...] = ()
    failed: FailedRun | None = None


@dataclass(frozen=True)
class RunTrier:
    """Tries runs; ``always``: what was answered is wanted of every run."""

    board: Board
    implementation: Implementation
    always: bool = False

    def tried(self, origin: str, steps: Sequence[ComparedStep]) -> TriedRun:
        """One run to its end, or to where the implementation fails."""
        seen, failed = set[str](), None
        try:
            outputs = self._answers(steps, seen)
        except ImplementationError as error:
            failed = FailedRun(str(error), tuple(steps[: error.step]))
            outputs = ()
            with suppress(ImplementationError):  # it failed earlier this time
                outputs = self._answers(steps[: error.step - 1], seen) if error.step > 1 else ()
        answered = tuple(steps[: len(outputs)])
        met = RunCoverage.of(self.board, steps)
        if self.always or differing(answered, outputs):
            return TriedRun(origin, met, len(outputs), frozenset(seen), answered, outputs, failed)
        return TriedRun(origin, met, len(outputs), frozenset(seen), failed=failed)

    def _answers(self, steps: Sequence[ComparedStep], seen: set[str]) -> tuple[Values, ...]:
        return answers([step.inputs for step in steps], _Listening(self.implementation, seen))


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


# --- by Hypothesis ---


@dataclass(frozen=True)
class Share:
    """Random runs that are drawn one after the other, from a seed of their own."""

    examples: int
    seed: int

    def each(self, env: Environment, one: Callable[[list[ComparedStep]], None]) -> None:
        """Draw the runs, and play the charts through each.  Raises what ``one`` raises."""

        def tried(stimulus: Stimulus) -> None:
            one(played(env.board, env.fields, stimulus))

        drawing = settings(
            max_examples=self.examples,
            deadline=None,
            database=None,
            phases=(Phase.generate,),
            print_blob=False,
            suppress_health_check=list(HealthCheck),
        )
        seed(self.seed)(drawing(given(stimuli(env))(tried)))()


def shares(examples: int, seed: int) -> list[Share]:
    """So many random runs in shares, the first one of this very seed."""
    sizes = [min(SHARE, examples - begin) for begin in range(0, examples, SHARE)]
    return [Share(size, _seed(seed, number)) for number, size in enumerate(sizes)]


def _seed(first: int, number: int) -> int:
    made = sha256(f"{first}/{number}".encode()).digest()
    return int.from_bytes(made[:4], "big") if number else first


__all__ = ["SHARE", "FailedRun", "RunCoverage", "RunTrier", "RunsLost", "Share", "TriedRun", "shares"]
