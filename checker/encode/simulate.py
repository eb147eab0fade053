"""Random runs of a slice, hundreds at once: what they visit suggests what might always be true.

Formulas are evaluated on arrays, one place per run.  No proof rests on it; a run that is found is replayed.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count, islice

import numpy as np

from rovercheck.checker.encode.cone import Slice
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.arrays import ArrayProgram, Column, Columns, column, element
from rovercheck.checker.system.intervals import Interval, postorder
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import variables

HOLD = (1, 1, 2, 5, 12, 40, 160, 480)
"""Ticks for which a random input keeps its value: long enough for timers of ten seconds to run out."""
_FEW = 16
_SMALL = 1 << 30
_MANY = 1 << 16
_BLOCK = 32
_TRIES = 12
"""Attempts to draw inputs that satisfy the assumption; a run that has none waits for a tick."""


def _storage(var: Var) -> type:
    """The type in which values are kept; differences and sums of two fit in it, too."""
    small = Interval(var.domain.low, var.domain.high).within(Interval(-_SMALL, _SMALL - 1))
    return np.int32 if small and not isinstance(var.sort, Bool) else element(var)


@dataclass
class _Input:
    """The values an input is drawn from, with numbers the formulas compare it with among them."""

    var: Var
    values: Column


@dataclass
class Trail:
    """Runs: the states before the first and after every tick, the inputs of each tick, and where it
    took place (not where no inputs were found that satisfy the assumption)."""

    states: list[dict[str, Column]]
    inputs: list[dict[str, Column]]
    moved: list[Column]

    def samples(self, every: int = 1) -> dict[str, Column]:
        """The states of all runs, of every so many ticks and the last ones, one after the other."""
        return _joined(self.states[::every] + self.states[-1:])

    def blocks(self) -> Iterator[dict[str, Column]]:
        """All the states, some ticks at a time."""
        for first in range(0, len(self.states), _BLOCK):
            yield _joined(self.states[first : first + _BLOCK])

    def first(self, goal: str) -> tuple[int, int] | None:
        """The least tick after which the goal is true in some run, and the number of the run."""
        for tick, (state, moved) in enumerate(zip(self.states[1:], self.moved, strict=True), 1):
            lanes = np.flatnonzero(state[goal] & moved)
            if len(lanes):
                return tick, int(lanes[0])
        return None

    def extract(self, ticks: int, lane: int, frozen: Sequence[str]) -> Run:
        """One run up to a tick."""
        taken = [at for at, moved in zip(self.inputs[:ticks], self.moved, strict=False) if moved[lane]]
        inputs = tuple({name: int(values[lane]) for name, values in at.items()} for at in taken)
        return Run({name: int(self.states[0][name][lane]) for name in frozen}, inputs)


def _joined(states: Sequence[Columns]) -> dict[str, Column]:
    return {name: np.concatenate([state[name] for state in states]) for name in states[0]}


class Simulator:
    """Runs of a slice with random inputs that are held for random times; reproducible.

    ``never`` are conditions on a tick, as are conjuncts of the assumption: a run takes none that meets one.
    ``hold`` are the ticks for which an input keeps its value, one of them drawn for each value.
    """

    def __init__(
        self,
        part: Slice,
        never: Sequence[Expr] = (),
        *,
        lanes: int = 256,
        seed: int = 0,
        hold: Sequence[int] = HOLD,
    ) -> None:
        self.part, self.lanes = part, lanes
        self._hold = np.asarray(hold)
        self._random = np.random.default_rng(seed)
        self._names = [v.name for v in part.variables]
        self._kept = {v.name: _storage(v) for v in (*part.variables, *part.frozen)}
        self._step = ArrayProgram([part.next[n] for n in self._names])
        mentioned = _constants([*part.next.values(), *part.assume])
        drawn = {v.name: _allowed(v, _interesting(v, mentioned), _alone(part, v)) for v in part.inputs}
        self._inputs = [_Input(v, drawn[v.name]) for v in part.inputs]
        assumed = [*part.assume, *(Apply(Op.NOT, (e,), Bool()) for e in never)]
        self._assume = ArrayProgram(assumed)
        self._about = [[i for i in self._inputs if i.var.name in variables(e)] for e in assumed]

    def start(self) -> dict[str, Column]:
        """The initial state in every run, with frozen values drawn at random."""
        fixed = {v.name: column(v, [v.init] * self.lanes) for v in self.part.variables}
        return {**fixed, **{v.name: self._anything(v) for v in self.part.frozen}}

    def _anything(self, var: Var) -> Column:
        """A value of the whole domain for each run."""
        values = var.domain.values
        chosen = self._random.integers(0, len(values), self.lanes)
        return column(var, [values[int(index)] for index in chosen])

    def everywhere(self, valuation: Mapping[str, int]) -> dict[str, Column]:
        """One state in every run."""
        of = (*self.part.variables, *self.part.frozen)
        return {v.name: column(v, [valuation[v.name]] * self.lanes) for v in of}

    def run(self, start: Columns, ticks: int, first: Mapping[str, int] | None = None) -> "Trail":
        """Go on for some ticks in every run.  ``first`` gives inputs of the first tick in half of them."""
        trail = Trail([self._stored(start)], [], [])
        for at, inputs, possible in islice(self.steps(start, first), ticks):
            trail.states.append(self._stored(at))
            trail.inputs.append(dict(inputs))
            trail.moved.append(possible)
        return trail

    def steps(
        self, start: Columns, first: Mapping[str, int] | None = None, *, resting: bool = False
    ) -> Iterator[tuple[Columns, Columns, Column]]:
        """States after each tick, its inputs, and where it took place, for ever.

        ``resting``: half of the runs begin with all inputs but one at their initial values.
        """
        at, inputs = dict(start), {i.var.name: self._drawn(i, self.lanes) for i in self._inputs}
        left = {name: self._patience(self.lanes) for name in inputs}
        if resting:
            self._rest(inputs)
        for tick in count():
            self._renew(inputs, left, first if tick == 0 else None)
            possible = self._admissible(at, inputs)
            at = self._after(at, inputs, possible)
            yield at, inputs, possible

    def _rest(self, inputs: dict[str, Column]) -> None:
        """Put the inputs of half of the runs to rest: all of the first run, all but one of the others."""
        half = self.lanes // 2
        moving = np.arange(half) % (len(self._inputs) + 1) - 1
        for number, source in enumerate(self._inputs):
            if source.var.init in source.values:
                inputs[source.var.name][:half][moving != number] = source.var.init

    def _stored(self, at: Columns) -> dict[str, Column]:
        """A copy that takes half the room where the numbers are small."""
        return {name: values.astype(self._kept[name]) for name, values in at.items()}

    def _renew(
        self, inputs: dict[str, Column], left: dict[str, Column], given: Mapping[str, int] | None
    ) -> None:
        for source in self._inputs:
            name = source.var.name
            left[name] -= 1
            over = np.flatnonzero(left[name] < 0)
            if len(over):
                inputs[name] = inputs[name].copy()
                inputs[name][over] = self._drawn(source, len(over))
                left[name][over] = self._patience(len(over))
            if given is not None:
                inputs[name] = inputs[name].copy()
                inputs[name][: self.lanes // 2] = given[name]

    def _after(self, at: Columns, inputs: Columns, possible: Column) -> dict[str, Column]:
        results = self._step({**at, **inputs})
        moved = dict(at)
        for name, value in zip(self._names, results, strict=True):
            moved[name] = np.where(possible, value, at[name])
        return moved

    def _admissible(self, at: Columns, inputs: dict[str, Column]) -> Column:
        """Where the inputs satisfy the assumption, after drawing those that do not again."""
        fine = np.ones(self.lanes, dtype=np.bool_)
        for _ in range(_TRIES):
            each = [np.broadcast_to(holds, self.lanes) for holds in self._assume({**at, **inputs})]
            fine = np.logical_and.reduce(each, initial=True, axis=0) if each else fine
            if fine.all():
                break
            for holds, sources in zip(each, self._about, strict=True):
                self._draw_again(np.flatnonzero(~holds), sources, inputs)
        return fine

    def _draw_again(self, lanes: Column, sources: Sequence[_Input], inputs: dict[str, Column]) -> None:
        for source in sources:
            inputs[source.var.name] = inputs[source.var.name].copy()
            inputs[source.var.name][lanes] = self._drawn(source, len(lanes))

    def _drawn(self, source: _Input, count: int) -> Column:
        return self._random.choice(source.values, count)

    def _patience(self, count: int) -> Column:
        return self._random.choice(self._hold, count)


def _constants(roots: Sequence[Expr]) -> dict[str, set[int]]:
    """The constants that each variable is compared with, also after something was added to it."""
    found: dict[str, set[int]] = {}
    for node in postorder(*roots):
        match node:
            case Apply(Op.EQ | Op.LE, (left, Const(value)), _):
                for leaf in postorder(left):
                    if isinstance(leaf, Var):
                        found.setdefault(leaf.name, set()).add(value)
    return found


def _alone(part: Slice, var: Var) -> list[Expr]:
    """The conjuncts of the assumption on one input alone."""
    return [conjunct for conjunct in part.assume if list(variables(conjunct)) == [var.name]]


def _allowed(var: Var, values: Sequence[int], conditions: Sequence[Expr]) -> Column:
    """Those of the values, or else of the domain, that satisfy the conditions; all if none does."""
    for tried in (values, var.domain.values[:_MANY]):
        drawn = column(var, tried)
        fine = np.ones(len(drawn), dtype=np.bool_)
        for holds in ArrayProgram(conditions)({var.name: drawn}):
            fine &= holds
        if fine.any():
            return drawn[fine]
    return column(var, values)


def _interesting(var: Var, mentioned: Mapping[str, set[int]]) -> list[int]:
    if len(var.domain) <= _FEW:
        return list(var.domain.values)
    near = {c + d for c in mentioned.get(var.name, ()) for d in (-1, 0, 1)}
    spread = [var.domain.values[i * (len(var.domain) - 1) // 7] for i in range(8)]
    return sorted({*spread, *(v for v in near if v in var.domain)})
