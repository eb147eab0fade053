"""What a person chose so far: inputs that stand, inputs that run free, where to stop, what to watch."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import TYPE_CHECKING

from rovercheck.checker.explore.by_hand.admissible_inputs import KEPT, assumed, broken, drawn
from rovercheck.checker.explore.by_hand.condition import condition
from rovercheck.checker.explore.by_hand.names import Names
from rovercheck.checker.explore.by_hand.simulation import HandSimulation
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput, value, variable
from rovercheck.checker.verify.runs.replay import ReplayError, transition_of
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:  # it loads a solver
    from rovercheck.checker.explore.by_hand.next_steps import NextSteps, PossibleStep, StepFinder

MOST_TICKS = 20_000
"""Ticks that one command executes at most; it says so when it stops there."""


@dataclass(frozen=True)
class ExecutedTicks:
    """Ticks ``first`` to ``last`` were executed, and ``forgotten`` others dropped for them.

    ``stopped`` says why there, if it was not asked for; ``met`` is whether the condition became true.
    """

    first: int
    last: int
    forgotten: int = 0
    stopped: str = ""
    met: bool = True


class Session:
    """A simulation with the choices for its next ticks."""

    def __init__(self, system: System) -> None:
        self.simulation = HandSimulation(system)
        self.free: set[str] = set()
        self.chosen: set[str] = set()
        self.breaks: list[tuple[str, Expr]] = []
        self.watched: list[str] = []
        self.seed = 0
        self._random = Random(0)
        self._finder: StepFinder | None = None
        self.standing = self._first()

    @property
    def names(self) -> Names:
        """What conditions may speak of."""
        return Names(self.simulation.variables, {c.name: c for c in self.simulation.system.charts})

    def _first(self) -> dict[str, int]:
        """Initial values of the inputs, changed where an assumption forbids them."""
        sim = self.simulation
        initial = {n: v.init for n, v in sim.inputs.items()}
        return drawn(sim.lowered, sim.before, initial, sim.inputs, Random(0), keep=1) or initial

    # --- choosing inputs ---

    def set(self, assignments: Iterable[tuple[str, str]]) -> dict[str, int]:
        """Let inputs stand at values from now on.  Raises ``RefusedInput`` for values that are impossible."""
        sim = self.simulation
        new = {n: value(variable(n, sim.inputs, "input"), written) for n, written in assignments}
        wanted, free = self.standing | new, self.free - new.keys()
        against = [
            one for one in broken(sim.lowered, sim.state(), wanted) if not new.keys().isdisjoint(one.names)
        ]
        if against and drawn(sim.lowered, sim.state(), wanted, free, Random(0), keep=1) is None:
            together = " Set what belongs together in one line, or let other inputs go with free."
            raise RefusedInput(against[0].said + together)
        self.standing, self.free, self.chosen = wanted, free, self.chosen | new.keys()
        return new

    def let_run(self, names: Collection[str], seed: int | None = None) -> None:
        """Draw these inputs at random from now on.  Raises ``RefusedInput`` for what is no input."""
        for name in names:
            variable(name, self.simulation.inputs, "input")
        self.free |= set(names)
        self.chosen -= set(names)
        if seed is not None:
            self.seed = seed
            self._random = Random(seed)

    def hold(self) -> None:
        """Let all inputs stand as they are."""
        self.free.clear()

    def fix(self, name: str, written: str) -> int:
        """Choose a frozen value.  Raises ``RefusedInput``."""
        sim = self.simulation
        known = {v.name: v for v in sim.lowered.frozen}
        raw = value(variable(name, known, "frozen variable"), written)
        sim.fix(name, raw)
        return raw

    # --- moving ---

    def advance(self, ticks: int, until: Expr | None = None) -> ExecutedTicks:
        """Execute ticks, up to a condition or a break.  Raises as ``Simulation.step`` does."""
        sim = self.simulation
        first, forgotten = sim.at + 1, len(sim) - sim.at
        held = [self.holds(formula) for _, formula in self.breaks]
        for _ in range(min(ticks, MOST_TICKS)):
            self._tick()
            if until is not None and self.holds(until):
                return ExecutedTicks(first, sim.at, forgotten)
            now = [self.holds(formula) for _, formula in self.breaks]
            risen = [text for (text, _), was, is_ in zip(self.breaks, held, now, strict=True) if is_ > was]
            if risen:
                return ExecutedTicks(first, sim.at, forgotten, f"break: {'; '.join(risen)}", until is None)
            held = now
        stopped = f"stopped after {MOST_TICKS:,} ticks" if ticks > MOST_TICKS else ""
        return ExecutedTicks(first, sim.at, forgotten, stopped, until is None)

    def _tick(self) -> None:
        sim = self.simulation
        inputs: Mapping[str, int] | None = self.standing
        if self.free:
            inputs = drawn(sim.lowered, sim.state(), self.standing, self.free, self._random, KEPT)
        if inputs is None or broken(sim.lowered, sim.state(), inputs):
            inputs = self._followed()
        sim.step(inputs)
        self.standing = dict(inputs)

    def _followed(self) -> Mapping[str, int]:
        """The standing inputs, those that nobody set changed where an assumption asks for it."""
        sim = self.simulation
        others = sim.inputs.keys() - self.chosen
        return drawn(sim.lowered, sim.state(), self.standing, others, Random(sim.at), keep=1) or self.standing

    def next_steps(self, required: Sequence[str] = ()) -> "NextSteps":
        """What can happen in the next tick, of ``required`` keys only what can happen together with them."""
        if self._finder is None:
            from rovercheck.checker.explore.by_hand.next_steps import StepFinder

            self._finder = StepFinder(self.simulation.system)
        sim = self.simulation
        return self._finder.find(sim.state(), self.standing, required, first=not sim.at)

    def take(self, step: "PossibleStep", together: Sequence["PossibleStep"] = ()) -> ExecutedTicks:
        """Execute the next tick with the inputs of a possible step, which then stand.

        ``together`` are further steps that these inputs lead to.  Raises as ``Simulation.step`` does, and
        ``ReplayError`` when the interpreter does something else than the steps say.
        """
        ran = self.follow(step.frozen, [step.inputs])
        sim = self.simulation
        for one in (step, *together):
            says = {(t.source, t.target) for t in one.transitions}
            taken = {transition_of(fired) for fired in sim.fired() if fired.chart == one.of}
            if one.becomes is None and {(t.source, t.target) for t in taken} != says:
                raise ReplayError(f"tick {sim.at}: {one.of} was to take {says}, but it took {taken}.")
            if one.becomes is not None and sim.state()[one.of] != one.becomes[1]:
                raise ReplayError(f"tick {sim.at}: {one.of} was to become {one.becomes[1]}.")
        return ran

    def both(self, steps: Sequence["PossibleStep"]) -> "PossibleStep":
        """A tick in which several possible steps happen.  Raises ``RefusedInput`` if there is none."""
        found = self.next_steps([step.key for step in steps]).of(steps[0].key)
        if found is None:
            listed = " and ".join(step.title for step in steps)
            raise RefusedInput(f"No inputs lead to {listed} in one tick.")
        return found

    def follow(self, frozen: Mapping[str, int], inputs: Iterable[Mapping[str, int]]) -> ExecutedTicks:
        """Execute ticks with given inputs from the tick that is looked at; the last inputs then stand.

        ``frozen`` values count before the first tick only.  Raises as ``Simulation.step`` does.
        """
        sim = self.simulation
        first, forgotten = sim.at + 1, len(sim) - sim.at
        if not sim.at:
            for name, raw in frozen.items():
                sim.fix(name, raw)
        for given in inputs:
            sim.step({name: given.get(name, self.standing[name]) for name in sim.inputs})
            self.standing = sim.given()
        return ExecutedTicks(first, sim.at, forgotten)

    def goto(self, tick: int) -> None:
        """Look at another tick; inputs stand as in it.  Raises ``RefusedInput``."""
        self.simulation.goto(tick)
        if tick:
            self.standing = self.simulation.given()

    def play(self, frozen: Mapping[str, int], inputs: Iterable[Mapping[str, int]]) -> None:
        """Execute a recorded run from the start.  Raises as ``Simulation.step`` does."""
        self.simulation.goto(0)
        for name in self.simulation.frozen:
            self.simulation.fix(name, frozen[name])
        for given in inputs:
            self.simulation.step({name: given[name] for name in self.simulation.inputs})
        self.goto(len(self.simulation))

    # --- looking ---

    def condition(self, written: str) -> Expr:
        """The formula that is meant.  Raises ``RefusedInput``."""
        return condition(written, self.names)

    def holds(self, formula: Expr) -> bool:
        """Whether a condition is true at the tick that is looked at."""
        sim = self.simulation
        inputs = sim.given() if sim.at else {n: v.init for n, v in sim.inputs.items()}
        return bool(evaluate(formula, {**sim.state(), **inputs}))

    def requires(self) -> list[str]:
        """What is assumed of the inputs, a sentence each."""
        return [one.said for one in assumed(self.simulation.lowered)]

    def script(self) -> str:
        """Commands that make the run again, up to the tick that is looked at."""
        sim = self.simulation
        lines = [f"# rovercheck explore {sim.system.name} --script THIS_FILE"]
        lines += [f"fixed {_assigned(sim, {n: v})}" for n, v in sim.frozen.items()]
        last: dict[str, int] = {}
        quiet = 0
        for number in range(1, sim.at + 1):
            given = sim.given(number)
            changed = {n: v for n, v in given.items() if last.get(n) != v}
            if changed and quiet:
                lines.append(f"step {quiet}")
                quiet = 0
            lines += [f"set {_assigned(sim, changed)}"] if changed else []
            last, quiet = given, quiet + 1
        return "\n".join([*lines, *([f"step {quiet}"] if quiet else [])]) + "\n"


def _assigned(sim: HandSimulation, values: Mapping[str, int]) -> str:
    """``a=1 "two words"=true``."""
    pairs = (f"{n}={sim.variables[n].domain.show(v)}" for n, v in values.items())
    return " ".join(f'"{p}"' if " " in p or "'" in p else p for p in pairs)
