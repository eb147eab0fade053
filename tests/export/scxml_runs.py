"""A system of charts run in the interpreter: what its machine of SCXML must show under the same inputs."""

from collections.abc import Mapping
from dataclasses import dataclass
from random import Random

from rovercheck.checker.export.scxml import ScxmlMachine, scxml_of
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.evaluate import admissible, evaluate
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System
from tests.export.slx_runs import AssumedInputs

Data = dict[str, bool | int]
USUAL, LONG = 8, 160
"""Steps for which inputs stay as they are, at most: timers are seldom met by inputs that always change, and
those of 3 s only where they stay for long."""


@dataclass(frozen=True)
class ScxmlStep:
    """The data of an event ``tick``, then the active states, by their ids, and the data after the step."""

    given: Data
    active: frozenset[str]
    data: Data


class Charts:
    """The charts of a system at work, and their machine, which must show what they do.

    Raises ``ModelError`` for a system that is refused.
    """

    def __init__(self, system: System, frozen: Mapping[str, int] = {}, *, measured: bool = False) -> None:
        self.system, self.machine = system, scxml_of(system)
        self.interpreter = Interpreter(system, frozen, measured=measured)
        self._charts = {c.name: c for c in system.charts}
        self._given = {**system.inputs, **{v.name: v for v in system.frozen}}

    def step(self, inputs: Mapping[str, int]) -> ScxmlStep:
        """One step."""
        self.interpreter.step(inputs)
        at = self.interpreter.valuation()
        places = ((self._charts[c].active_path(p), name) for (c, p), name in self.machine.states.items() if p)
        active = frozenset(name for condition, name in places if evaluate(condition, at))
        return ScxmlStep(self._named(at, self._given), active, self._named(at, self.system.written))

    def _named(self, raw: Mapping[str, int], of: Mapping[str, Var]) -> Data:
        names = self.machine.names
        return {names[n]: bool(raw[n]) if isinstance(v.sort, Bool) else raw[n] for n, v in of.items()}


def scxml_run(system: System, seed: int, rows: int) -> tuple[ScxmlMachine, list[ScxmlStep]]:
    """The machine of a system, and a run under random inputs as the system assumes them.

    Raises ``ModelError`` for a system that is refused.
    """
    random, inputs, lowered = Random(seed), AssumedInputs(system), lower(system)
    now, held, steps = inputs.first(random), 0, list[ScxmlStep]()
    charts = Charts(system, {v.name: now[v.name] for v in system.frozen})
    for row in range(rows):
        at = charts.interpreter.valuation()
        if row and held and admissible(lowered, at, {name: now[name] for name in system.inputs}):
            held -= 1
        elif row:
            held = random.randint(0, LONG if random.randrange(12) == 0 else USUAL)
            now = inputs.further(random, at, now)
        steps.append(charts.step({name: now[name] for name in system.inputs}))
    return charts.machine, steps


def unlike(machine: ScxmlMachine, step: ScxmlStep, active: set[str], data: Mapping[str, object]) -> str:
    """How a step differs from what it must show; empty if it does not."""
    drawn = {name for (_, path), name in machine.states.items() if path}
    found = (
        [f"active {sorted(active & drawn)} for {sorted(step.active)}"]
        if active & drawn != step.active
        else []
    )
    found += [
        f"{name} = {data.get(name)} for {value}"
        for name, value in step.data.items()
        if (type(data.get(name)), data.get(name)) != (type(value), value)
    ]
    return ", ".join(found)
