"""A random system of charts, and the model of Simulink that is written of it, run beside each other."""

from collections.abc import Mapping
from pathlib import Path
from random import Random

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.domains import domains_path, read_domains
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.export.slx import SlxModel, simulink_of
from rovercheck.checker.simulink.model import read_model
from rovercheck.spec_model.lang.chart import Chart, Component
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.wellformed import check_system
from tests.random_charts import charts
from tests.random_formulas import DOMAINS, Source
from tests.strategies import FROZEN, INPUTS

ROWS = 60


class SeededChoices:
    """The choices of random systems, from a seed."""

    def __init__(self, seed: int) -> None:
        self._random = Random(seed)

    def below(self, n: int) -> int:
        return self._random.randrange(256) % n

    def chance(self, one_in: int) -> bool:
        return self.below(one_in) == 1 % one_in

    def pick(self, options):  # type: ignore[no-untyped-def]
        return options[self.below(len(options))]


def random_system(seed: int) -> System:
    """One to three random charts and blocks, in order."""
    from tests.strategies import _datum, _part

    choices = SeededChoices(seed)
    count = 1 + choices.below(3)
    data = [[_datum(choices, f"d{c}{i}") for i in range(1 + choices.below(3))] for c in range(count)]
    places: list[Expr] = []
    made: list[Component] = []
    for number in range(count):
        others = [v for other, owned in enumerate(data) if other != number for v in owned]
        steady = [*INPUTS, *others, *FROZEN]
        part = _part(Source(choices, [*data[number], *data[number], *steady], steady, places), number, data[number])
        if isinstance(part, Chart):
            places += [part.active_path(p) for p in part.states if p]
        made.append(part)
    return in_order("Random", *made, frozen=FROZEN)


def differences(system: System, folder: Path, seed: int, rows: int = ROWS) -> int:
    """Run the system and what is read of its file, in both readings; the answer is how many rows were alike.

    Raises ``AssertionError`` where they differ, ``ModelError`` for a system that is refused.
    """
    made = simulink_of(system)
    path = folder / "random.slx"
    made.save(path)
    model, said = read_model(path), read_domains(domains_path(path))
    lowered = lowered_model(model, path.name, said.domains)
    runs = LoweredRun(lowered), ModelRunner(model)
    random = Random(seed)
    frozen = {v.name: random.choice(list(v.domain.values)) for v in system.frozen}
    own = Interpreter(system, frozen)
    now = {n: random.choice(list(v.domain.values)) for n, v in system.inputs.items()}
    every = {**system.inputs, **{v.name: v for v in system.frozen}}
    for row in range(rows):
        for name, var in system.inputs.items():
            if random.random() < 0.3:
                now[name] = random.choice(list(var.domain.values))
        own.step(now)
        raw = {**now, **frozen}
        given = {made.inputs[n]: _number(every[n], raw[n]) for n in made.inputs}
        at = own.valuation()
        expected = {made.names[n]: _number(v, at[n]) for n, v in system.written.items() if not v.hidden}
        places = {
            made.states[c.name, p]: bool(_holds(c, p, at)) for c in system.charts for p in c.states if p
        }
        for run in runs:
            found = run.step(given)
            assert found == expected, f"seed {seed}, row {row}, {type(run).__name__}: {given} gives { {n: (found[n], expected[n]) for n in found if found[n] != expected[n]} }"
        active = {n.path.split("/", 1)[1].replace("/", ".") for m in runs[1].machines for n in m.active if n.parent is not None}
        wrong = [n for n, on in places.items() if on != (n in active)]
        assert not wrong, f"seed {seed}, row {row}: {wrong}, active {active}"
    return rows


def _holds(chart: Chart, path, at) -> int:  # type: ignore[no-untyped-def]
    from rovercheck.spec_model.lang.evaluate import evaluate

    return evaluate(chart.active_path(path), at)


def _number(var: Var, raw: int) -> float:
    return float(raw * var.sort.resolution) if isinstance(var.sort, Num) else raw
