"""A run that a person makes, tick by tick: forward, back, and on from there with other inputs."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rovercheck.checker.explore.by_hand.admissible_inputs import broken, conjuncts
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput, outside
from rovercheck.checker.results.trace import Tick, Trace, TracedProperty, TracedSystem
from rovercheck.checker.verify.runs.replay import ReplayError, ends, transition_of
from rovercheck.spec_model.lang.chart import Path, Transition
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.interpret import FiredTransition, Interpreter
from rovercheck.spec_model.lang.interpret.run import Testing, ValueOf
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class TestedTransition:
    """A transition that was tested in a tick: whether it was valid, and the truth of each conjunct of its
    guard.

    ``source`` is the state that is left, None for a default transition.
    """

    chart: str
    source: Path | None
    segment: Transition
    valid: bool
    conjuncts: tuple[tuple[Expr, bool], ...]


@dataclass(frozen=True)
class _Moment:
    """A tick that was executed; its states as tuples, for a run may be long."""

    inputs: tuple[int, ...]
    after: tuple[int, ...]
    fired: tuple[FiredTransition, ...]


class HandSimulation:
    """A system, the ticks executed so far, and the tick that is looked at (0: before the first).

    Each tick is executed by the chart interpreter and by the lowered system, which must agree.
    """

    def __init__(self, system: System) -> None:
        self.system = system
        self.lowered = lower(system)
        self.variables = {
            v.name: v for v in (*self.lowered.frozen, *self.lowered.variables, *self.lowered.inputs)
        }
        self.inputs = {v.name: v for v in self.lowered.inputs}
        self.frozen = {v.name: v.init for v in self.lowered.frozen}
        self.at = 0
        self._written = tuple(v.name for v in self.lowered.variables)
        self._moments: list[_Moment] = []
        self._ahead = Interpreter(system, self.frozen)
        self._executed = 0

    def __len__(self) -> int:
        """The number of ticks executed, those after the one that is looked at included."""
        return len(self._moments)

    @property
    def before(self) -> dict[str, int]:
        """The state before the first tick, frozen values included."""
        return {**self.lowered.init, **self.frozen}

    def state(self, tick: int | None = None) -> dict[str, int]:
        """Frozen and written values after a tick, by default the one that is looked at."""
        tick = self.at if tick is None else tick
        if not tick:
            return self.before
        return {**self.frozen, **dict(zip(self._written, self._moments[tick - 1].after, strict=True))}

    def given(self, tick: int | None = None) -> dict[str, int]:
        """The inputs of a tick, by default of the one that is looked at; before the first there are none."""
        tick = self.at if tick is None else tick
        if not tick:
            return {}
        return dict(zip(self.inputs, self._moments[tick - 1].inputs, strict=True))

    # --- moving ---

    def step(self, inputs: Mapping[str, int]) -> None:
        """Execute a tick after the one that is looked at; ticks executed after it before are forgotten.

        Raises ``RefusedInput`` for inputs that an assumption forbids, ``ModelError`` for a value that leaves
        its domain, and ``ReplayError`` when interpreter and lowered system disagree.
        """
        before = self.state()
        if against := broken(self.lowered, before, inputs):
            raise RefusedInput(f"In tick {self.at + 1} these inputs are not possible: {against[0].said}")
        interpreter = self._interpreter()
        self._executed = -1  # until the tick is over: an interpreter that raised is of no more use
        fired = interpreter.step(inputs)
        after = step(self.lowered, before, inputs)
        _agree(interpreter.valuation(), after, self.at + 1)
        del self._moments[self.at :]
        raw = tuple(inputs[n] for n in self.inputs)
        self._moments.append(_Moment(raw, tuple(after[n] for n in self._written), fired))
        self.at += 1
        self._executed = self.at

    def goto(self, tick: int) -> None:
        """Look at a tick that was executed.  Raises ``RefusedInput`` for another."""
        if not 0 <= tick <= len(self):
            raise RefusedInput(
                f"There is no tick {tick}; the run has {len(self)}. Write goto 0 to goto {len(self)}."
            )
        self.at = tick

    def fix(self, name: str, raw: int) -> None:
        """Choose a frozen value, before the first tick.  Raises ``RefusedInput`` afterwards."""
        if self.at:
            raise RefusedInput("Frozen values are chosen before the first tick; write goto 0 first.")
        if raw not in self.variables[name].domain:
            raise RefusedInput(outside(self.variables[name], str(raw)))
        self.frozen[name] = raw
        self._moments.clear()
        self._executed = -1

    def _interpreter(self) -> Interpreter:
        """The interpreter after the tick that is looked at."""
        if self._executed != self.at:
            self._ahead = self._replayed(self.at)
            self._executed = self.at
        return self._ahead

    def _replayed(self, ticks: int, tested: list[TestedTransition] | None = None) -> Interpreter:
        interpreter = Interpreter(self.system, self.frozen, tested=None if tested is None else _into(tested))
        for number in range(1, ticks + 1):
            if tested is not None:
                tested.clear()
            interpreter.step(self.given(number))
        return interpreter

    # --- looking ---

    @property
    def ms(self) -> int:
        """The time at the end of the tick that is looked at."""
        measured = ends(self.lowered, tuple(self._ticks(1)))
        return measured[-1] if measured else self.at * self.lowered.tick_ms

    def tested(self) -> tuple[TestedTransition, ...]:
        """Every transition that was tested in the tick that is looked at, in order."""
        found: list[TestedTransition] = []
        self._replayed(self.at, found)
        return tuple(found)

    def fired(self, tick: int | None = None) -> tuple[FiredTransition, ...]:
        """The transitions taken in a tick, by default in the one that is looked at; before the first none."""
        tick = self.at if tick is None else tick
        return self._moments[tick - 1].fired if tick else ()

    def trace(self, first: int = 1) -> Trace:
        """The ticks from ``first`` up to the one that is looked at, as a trace of nothing in particular."""
        drawn = {c.name: c for c in self.system.charts}
        before = self.state(first - 1) | (self.given(first - 1) if first > 1 else {})
        of = TracedSystem(
            self.system.name,
            self.lowered.tick_ms,
            self.variables,
            tuple(self.inputs),
            statecharts=drawn,
            components=self.system.components,
        )
        none = TracedProperty(relevant=frozenset(self.variables), charts=frozenset(drawn))
        every = tuple(self._ticks(1))
        return Trace(of, before, tuple(self._ticks(first)), none, ends(self.lowered, every))

    def _ticks(self, first: int) -> Iterator[Tick]:
        for number in range(first, self.at + 1):
            transitions = tuple(map(transition_of, self._moments[number - 1].fired))
            yield Tick(number, self.given(number), self.state(number), transitions)


def _agree(read: Mapping[str, int], lowered: Mapping[str, int], tick: int) -> None:
    for name, raw in read.items():
        if name in lowered and lowered[name] != raw:
            raise ReplayError(
                f"tick {tick}: {name} is {raw} in the interpreter and {lowered[name]} when lowered."
            )


def _into(found: list[TestedTransition]) -> Testing:
    """Keeps every transition that an interpreter tests, with the truth of its conjuncts at that moment."""

    def keep(chart: str, source: Path | None, segment: Transition, valid: bool, value: ValueOf) -> None:
        truths = tuple((part, bool(value(part))) for part in conjuncts(segment.guard))
        found.append(TestedTransition(chart, source, segment, valid, truths))

    return keep
