"""Tries odd runs on an implementation; what breaks a rule is made as short as it can be, once a cause."""

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rovercheck.checker.adapters.implementation import KEPT, Implementation, ImplementationError, Values
from rovercheck.checker.robustness.odd_inputs import Moment, started_inputs
from rovercheck.checker.robustness.rules import RobustnessRules, RuleBreach, breaches
from rovercheck.checker.robustness.sanitizers import said_by
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.stamps import NOW


@dataclass(frozen=True)
class RobustnessFinding:
    """A breach, and the shortest run found that shows it in its last step."""

    breach: RuleBreach
    origin: str
    start: int
    moments: tuple[Moment, ...]
    inputs: tuple[Values, ...]


@dataclass
class RobustnessResult:
    """What was tried, and what was found."""

    board: Board
    findings: list[RobustnessFinding] = field(default_factory=list)
    runs: int = 0
    steps: int = 0
    met: dict[tuple[str, str], int] = field(default_factory=dict)
    """In how many runs each finding was met."""
    compared: set[str] = field(default_factory=set)
    interrupted: bool = False


class RobustnessSearch:
    """One implementation under odd inputs."""

    def __init__(
        self, board: Board, implementation: Implementation, rules: RobustnessRules, logs: Path | None = None
    ) -> None:
        self._board, self._implementation, self._rules, self._logs = board, implementation, rules, logs
        self.result = RobustnessResult(board)

    def run(
        self,
        runs: Iterable[tuple[str, int, tuple[Moment, ...]]],
        progress: Callable[[RobustnessResult], None] = lambda result: None,
    ) -> RobustnessResult:
        """Try them all; Ctrl-C ends the search with what was found."""
        result = self.result
        try:
            for origin, start, moments in runs:
                progress(result)
                result.runs += 1
                for breach in self._first_of_each(self._tried(start, moments)):
                    key = breach.kind, breach.where
                    if key not in result.met:
                        result.findings.append(self._shortened(breach, origin, start, moments))
                    result.met[key] = result.met.get(key, 0) + 1
        except KeyboardInterrupt:
            result.interrupted = True
        return result

    def _tried(self, start: int, moments: Sequence[Moment]) -> list[RuleBreach]:
        """All that a run breaks."""
        return self.broken(started_inputs(self._board, moments, start))

    def broken(self, inputs: Sequence[Values]) -> list[RuleBreach]:
        """All that does not hold in these steps from power-up."""
        outputs: list[Values] = []
        given: list[Values] = []
        before: Values = started_inputs(self._board, [{}])[0]
        ended: list[RuleBreach] = []
        try:
            self._implementation.reset()
            for at in inputs:
                answered = dict(self._implementation.step(at))
                kept = {name.removeprefix(KEPT) for name in answered if name.startswith(KEPT)}
                given.append({**at, **{name: before[name] for name in kept}})
                before = given[-1]
                outputs.append({name: value for name, value in answered.items() if not name.startswith(KEPT)})
        except ImplementationError as error:
            ended.append(self._ended(error))
        self.result.steps += len(outputs)
        self.result.compared.update(*outputs)
        return [*breaches(self._board, self._rules, given, outputs), *ended]

    def _ended(self, error: ImplementationError) -> RuleBreach:
        """A crash or a hang: where a sanitizer says, else how the process ended."""
        told = said_by(self._logs, str(error)) if self._logs is not None else None
        first = str(error).splitlines()[0].partition(": ")[2].partition(": ")[2] or str(error)
        hang = "did not answer within" in first
        kind = "hang" if hang else "crash"
        if told is not None:
            return RuleBreach(
                kind, f"{told[0]}: {_without_numbers(told[1])}", f"{told[0]}: {told[1]}", error.step
            )
        return RuleBreach(kind, first, first, error.step)

    def _first_of_each(self, found: Iterable[RuleBreach]) -> list[RuleBreach]:
        return list({(b.kind, b.where): b for b in reversed(list(found))}.values())

    def _shows(self, wanted: RuleBreach, start: int, moments: Sequence[Moment]) -> RuleBreach | None:
        if not moments:
            return None
        same = (b for b in self._tried(start, moments) if (b.kind, b.where) == (wanted.kind, wanted.where))
        return min(same, key=lambda b: b.step, default=None)

    def _shortened(
        self, breach: RuleBreach, origin: str, start: int, moments: Sequence[Moment]
    ) -> RobustnessFinding:
        """Fewer steps, fewer inputs that are not at rest, a clock that begins at 0; the same breach."""
        small, run, begin = breach, list(moments[: max(1, breach.step)]), start

        def accepts(other: list[Moment], at: int) -> bool:
            nonlocal small, run, begin
            found = self._shows(breach, at, other)
            if found is None:
                return False
            small, run, begin = found, other[: max(1, found.step)], at
            return True

        if begin:
            accepts(run, 0)
        size = max(1, len(run) // 2)
        while size:
            first = 0
            while first < len(run) and len(run) > 1:
                if not accepts(_without(run, first, size), begin):
                    first += size
            size //= 2
        for number in range(len(run)):
            for name in [*run[number]] if number < len(run) else []:
                accepts(
                    [{k: v for k, v in m.items() if k != name or n != number} for n, m in enumerate(run)],
                    begin,
                )
        return RobustnessFinding(
            small, origin, begin, tuple(run), tuple(started_inputs(self._board, run, begin))
        )


def _without(run: Sequence[Moment], first: int, count: int) -> list[Moment]:
    """Steps left out; what they changed is changed in the step after them."""
    gone: Moment = {}
    for moment in run[first : first + count]:
        gone |= {name: value for name, value in moment.items() if name != NOW}
    rest = run[first + count :]
    if not rest:
        return [*run[:first]]
    return [*run[:first], {**gone, **rest[0]}, *rest[1:]]


def _without_numbers(text: str) -> str:
    """What a sanitizer says without the values of one run: one fault is one finding."""
    return re.sub(r"(?<!\w)[-+]?(?:0x[0-9a-f]+|\d[\d.e+-]*)", "N", text.partition(":")[0])
