"""The states of a part of a board that explain a log so far, and how they go on."""

from collections import Counter, deque
from collections.abc import Iterator, Mapping, Sequence

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.program import BeliefOutcome, Known, NeededInputs
from rovercheck.checker.conformance.recording import Raw
from rovercheck.spec_model.lang.domain import Num

MOST_VALUATIONS = 512
"""States that are followed at a time."""

FIRST_RUNS, MORE_RUNS = 4_000, 30
"""Steps that may be tried at first, and how many more for each tick of the log."""

MOST_REMEMBERED = 50_000

NEARLY = 1e-6
"""How far numbers may lie apart for the rounding of a 32-bit float, in parts of their size or in units."""


class TooMany(Exception):
    """More states than are followed; the message names what multiplies them."""


class StateEstimator:
    """Takes the steps of one part of a board, from sets of states."""

    def __init__(self, cone: LogCone, tolerance: Mapping[str, float]) -> None:
        self.cone = cone
        self.incomplete: set[str] = set()
        self.runs_left = FIRST_RUNS
        self._step = cone.step
        self._state = {v.name: at for at, v in enumerate(cone.system.variables)}
        self._inputs = {v.name: at for at, v in enumerate(cone.system.inputs)}
        self.apart = [_apart(o.signal.domain.sort, tolerance.get(o.name)) for o in cone.outputs]
        self._remembered: dict[tuple[Known, Known], tuple[tuple[BeliefOutcome, ...], frozenset[str]]] = {}
        self._asked: Counter[str] = Counter()
        self._guessed: set[str] = set()

    def power_up(self) -> tuple[Known, ...]:
        """The state before the first tick."""
        return (tuple(v.init for v in self.cone.system.variables),)

    def anything(self, told: Mapping[str, Raw | None]) -> tuple[Known, ...]:
        """Every state in which these variables have these values."""
        return (tuple(told.get(name) for name in self._state),)

    def outcomes(self, valuations: Sequence[Known], inputs: Known) -> list[BeliefOutcome]:
        """What one step may lead to.  Raises ``TooMany``."""
        return [outcome for v in valuations for outcome in self._after(v, inputs)]

    def explains(self, outcome: BeliefOutcome, logged: Known) -> bool:
        """Whether the outputs are those of the log; what is not logged may be anything."""
        if outcome.outputs == logged:
            return True
        return self.agrees(outcome.outputs, logged)

    def agrees(self, required: Known, logged: Known) -> bool:
        """Whether no output is another than the one required."""
        if required == logged:
            return True
        return not any(map(differs, required, logged, self.apart))

    def differing(self, outcome: BeliefOutcome, logged: Known) -> list[int]:
        """Positions of the outputs that are not as the charts require."""
        return self.others(outcome.outputs, logged)

    def others(self, required: Known, logged: Known) -> list[int]:
        """Positions of the outputs that are others than those required."""
        rows = zip(required, logged, self.apart, strict=True)
        return [i for i, (wanted, got, apart) in enumerate(rows) if differs(wanted, got, apart)]

    def kept(self, outcomes: Sequence[BeliefOutcome]) -> tuple[Known, ...]:
        """The states after the step, each once.  Raises ``TooMany``."""
        found = tuple(dict.fromkeys(o.after for o in outcomes))
        if len(found) > MOST_VALUATIONS:
            raise self._too_many()
        return found

    def _after(self, valuation: Known, inputs: Known) -> tuple[BeliefOutcome, ...]:
        key = (valuation, inputs)
        if key not in self._remembered:
            if len(self._remembered) > MOST_REMEMBERED:
                self._remembered.clear()
            self._guessed = set[str]()
            found = tuple(self._tried(valuation, inputs))
            self._remembered[key] = found, frozenset(self._guessed)
        found, guessed = self._remembered[key]
        self.incomplete |= guessed
        return found

    def _tried(self, valuation: Known, inputs: Known) -> Iterator[BeliefOutcome]:
        """Steps with values for what they turn out to need, breadth first: so it shows soon if too many."""
        waiting, seen = deque([(valuation, inputs)]), set[tuple[Known, Known]]()
        while waiting:
            before, given = waiting.popleft()
            self.runs_left -= 1
            if self.runs_left < len(waiting):
                raise self._exhausted()
            try:
                after, outputs = self._step(before, given)
            except NeededInputs as needed:
                waiting += self._with_values(needed.name, before, given, len(waiting))
                continue
            if (after, outputs) not in seen:
                seen.add((after, outputs))
                yield BeliefOutcome(before, after, outputs)

    def _with_values(self, name: str, before: Known, given: Known, waiting: int) -> list[tuple[Known, Known]]:
        values = self.cone.values(name)
        self._asked[name] += len(values)
        if self.runs_left < waiting + len(values):
            raise self._exhausted()
        if not self.cone.complete(name):
            self._guessed.add(name)
        if name in self._inputs:
            return [(before, row) for row in _rows(given, self._inputs[name], values)]
        return [(row, given) for row in _rows(before, self._state[name], values)]

    def _exhausted(self) -> TooMany:
        """Every step that waits would be one: they are not begun where they cannot be ended."""
        self.runs_left = -1
        return self._too_many()

    def _too_many(self) -> TooMany:
        most = [name for name, _ in self._asked.most_common(3)]
        return TooMany(", ".join(most) or "what is not logged")


def _rows(known: Known, index: int, values: Sequence[Raw]) -> list[Known]:
    """The same with each of the values at a place."""
    before, after = known[:index], known[index + 1 :]
    return [(*before, value, *after) for value in values]


def _apart(sort: object, tolerance: float | None) -> float | None:
    """How far a number of this sort may lie from the one required, in raw units; ``None``: not at all."""
    if not isinstance(sort, Num):
        return None
    if tolerance is not None:
        return float(tolerance / sort.resolution)
    return None if sort.resolution == 1 else float(NEARLY / sort.resolution)


def differs(wanted: Raw | None, got: Raw | None, apart: float | None) -> bool:
    """Whether a logged value is another than the one required; ``None``: not logged, not required."""
    if wanted is None or got is None or wanted == got:
        return False
    return apart is None or abs(float(wanted) - float(got)) > max(apart, NEARLY * abs(float(wanted)))
