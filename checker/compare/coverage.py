"""What a set of runs has exercised: the transitions of the charts, and the sides of their boundaries."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache

from rovercheck.checker.compare.aims import aims
from rovercheck.checker.compare.tried_runs import RunCoverage
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.chart import Chart, Path, Transition
from rovercheck.spec_model.lang.expr import Const
from rovercheck.spec_model.lang.fired_transition import path_label
from rovercheck.spec_model.lang.interpret import FiredTransition

NEAR_SHARE = Fraction(1, 100)
"""The share of a signal's range within which a value counts as beside a boundary."""


@dataclass(frozen=True, order=True)
class CoveredTransition:
    """A complete path of a chart from state to state, with its label as drawn.

    ``order`` is that of ``FiredTransition``.
    """

    chart: str
    source: Path
    order: int
    target: Path
    label: str

    def __str__(self) -> str:
        start = f"{'.'.join(self.source)} -> " if self.source else "default -> "
        number = f" (transition {self.order})" if self.order else ""
        return f"{self.chart}: {start}{'.'.join(self.target)}{number}{' ' + self.label if self.label else ''}"


def taken(fired: FiredTransition) -> CoveredTransition:
    """The transition that fired."""
    return CoveredTransition(fired.chart, fired.source, fired.order, fired.target, fired.label)


def transitions(board: Board) -> frozenset[CoveredTransition]:
    """All transitions of a board, those left out that no interpretation of a sentence lets fire."""
    return _transitions(board.name, board)


@cache
def _transitions(name: str, board: Board) -> frozenset[CoveredTransition]:
    return frozenset(a for chart in board.system.charts for a in _of(chart))


def _of(chart: Chart) -> Iterator[CoveredTransition]:
    for path, state in chart.states.items():
        for target, segments in _paths(chart, path, state.default):
            yield CoveredTransition(chart.name, (), 0, target, path_label(segments))
        for order, transition in enumerate(state.transitions, 1):
            for target, segments in _paths(chart, path[:-1], (transition,)):
                yield CoveredTransition(chart.name, path, order, target, path_label(segments))


def _paths(
    chart: Chart, level: Path, segments: tuple[Transition, ...], so_far: tuple[Transition, ...] = ()
) -> Iterator[tuple[Path, tuple[Transition, ...]]]:
    """Complete paths; what comes after a segment that is always valid is never reached."""
    for segment in segments:
        if isinstance(segment.guard, Const) and not segment.guard.value:
            continue
        target = chart.resolve(level, segment.target)
        assert target is not None
        junction = chart.junctions.get(target)
        if junction is None:
            yield target, (*so_far, segment)
            if segment.guard is None and segment.event is None:
                return
        else:
            yield from _paths(chart, target[:-1], junction.transitions, (*so_far, segment))


@dataclass
class TransitionCoverage:
    """Transitions and values met so far."""

    board: Board
    taken: set[CoveredTransition] = field(default_factory=set)
    steps: int = 0
    runs: int = 0
    _fired: set[FiredTransition] = field(default_factory=set)
    _values: dict[str, set[float]] = field(default_factory=dict)

    def add(self, run: RunCoverage) -> None:
        """A run."""
        self.runs += 1
        self.steps += run.steps
        self._fired |= run.fired
        for name, values in run.values.items():
            self._values.setdefault(name, set()).update(values)
        self.taken = {taken(fired) for fired in self._fired}

    @property
    def missing(self) -> tuple[CoveredTransition, ...]:
        """The transitions that no run took."""
        return tuple(sorted(transitions(self.board) - self.taken))

    def boundaries(self) -> tuple[int, int]:
        """How many sides of boundaries were met, of how many: at it, just below it and just above it."""
        met = every = 0
        for signal in self.board.inputs:
            low, high = Fraction(str(signal.low)), Fraction(str(signal.high))
            near = max((high - low) * NEAR_SHARE, Fraction(1))
            values = {Fraction(str(float(v))) for v in self._values.get(signal.name, ())}
            for b in aims(self.board).boundaries:
                if b.signal == signal.name and not b.datum and not b.source:
                    sides = [b.value in values]
                    sides += [any(b.value - near <= v < b.value for v in values)] if b.value > low else []
                    sides += [any(b.value < v <= b.value + near for v in values)] if b.value < high else []
                    met, every = met + sum(sides), every + len(sides)
        return met, every
