"""A random system of charts, and the model of Simulink that is written of it, run beside each other."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from rovercheck.checker.commands.import_.written import written_model
from rovercheck.checker.drawn.charts.system import charts_of_model
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.domains import domains_path, read_domains
from rovercheck.checker.drawn.lower.lowered import LoweredModel
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.export.slx import simulink_of
from rovercheck.checker.model.load import load
from rovercheck.checker.simulink.model import read_model
from rovercheck.spec_model.lang.chart import Chart, Component
from rovercheck.spec_model.lang.chart import Path as Path_
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import System, in_order
from tests.random_formulas import Choices, Source, T
from tests.strategies import FROZEN, INPUTS, a_datum, a_part

ROWS = 60


class SeededChoices(Choices):
    """The choices of random systems, from a seed."""

    def __init__(self, seed: int) -> None:
        self._random = Random(seed)

    def below(self, n: int) -> int:
        return self._random.randrange(256) % n

    def chance(self, one_in: int) -> bool:
        return self.below(one_in) == 1 % one_in

    def pick(self, options: Sequence[T]) -> T:
        return options[self.below(len(options))]


def random_system(seed: int) -> System:
    """One to three random charts and blocks, in order."""
    choices = SeededChoices(seed)
    count = 1 + choices.below(3)
    data = [[a_datum(choices, f"d{c}{i}") for i in range(1 + choices.below(3))] for c in range(count)]
    places: list[Expr] = []
    made: list[Component] = []
    for number in range(count):
        others = [v for other, owned in enumerate(data) if other != number for v in owned]
        steady = [*INPUTS, *others, *FROZEN]
        part = a_part(
            Source(choices, [*data[number], *data[number], *steady], steady, places), number, data[number]
        )
        if isinstance(part, Chart):
            places += [part.active_path(p) for p in part.states if p]
        made.append(part)
    return in_order("Random", *made, frozen=FROZEN)


def differences(system: System, folder: Path, seed: int, rows: int = ROWS, written: bool = False) -> int:
    """Run the system and what is read of its file, in both readings; the answer is how many rows were alike.

    ``written``: what is read is written as charts in Python and loaded, too.
    Raises ``AssertionError`` where they differ, ``ModelError`` for a system that is refused.
    """
    made = simulink_of(system)
    path = folder / "random.slx"
    made.save(path)
    model, said = read_model(path), read_domains(domains_path(path))
    lowered = lowered_model(model, path.name, said.domains)
    direct = ModelRunner(model)
    runs: list[LoweredRun | ModelRunner] = [LoweredRun(lowered), direct]
    if written:
        runs.append(LoweredRun(written_again(lowered, path)))
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
            unlike = {n: (found[n], expected[n]) for n in found if found[n] != expected[n]}
            assert not unlike, f"seed {seed}, row {row}, {type(run).__name__}: {given} gives {unlike}"
        active = {
            n.path.split("/", 1)[1].replace("/", ".")
            for m in direct.machines
            for n in m.active
            if n.parent is not None
        }
        wrong = [n for n, on in places.items() if on != (n in active)]
        assert not wrong, f"seed {seed}, row {row}: {wrong}, active {active}"
    return rows


def written_again(lowered: LoweredModel, path: Path) -> LoweredModel:
    """A model as it is loaded from the charts in Python that are written of it."""
    try:
        drawn = charts_of_model(lowered, path.name)
    except NotLowered as error:
        raise ModelError(str(error)) from error
    with TemporaryDirectory(dir=path.parent) as folder:
        for name, text in written_model(path, drawn).files.items():
            (Path(folder) / name).write_text(text, encoding="utf-8")
        system = load(Path(folder)).systems[drawn.model.system.name]
    return replace(drawn.model, system=system)


def _holds(chart: Chart, path: Path_, at: Mapping[str, int]) -> int:
    return evaluate(chart.active_path(path), at)


def _number(var: Var, raw: int) -> float:
    return float(raw * var.sort.resolution) if isinstance(var.sort, Num) else raw
