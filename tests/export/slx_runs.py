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
from rovercheck.checker.explore.by_hand.admissible_inputs import drawn
from rovercheck.checker.export.slx import simulink_of
from rovercheck.checker.model.load import load
from rovercheck.checker.simulink.model import read_model
from rovercheck.spec_model.lang.chart import Chart, Component, Enabled
from rovercheck.spec_model.lang.chart import Path as Path_
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import TICK_MS, System, TransitionSystem, in_order
from tests.random_formulas import Choices, Source, T
from tests.strategies import FROZEN, INPUTS, a_datum, a_part

ROWS = 60
ROUNDED = 1e-9
"""By how much the interpreter, which computes as MATLAB does, may miss a decimal number."""


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
    """One to four random charts and blocks, in order; half of them in enabled subsystems, nested ones too.

    Some write what another one writes, and in some systems the timers count every second step.
    """
    choices = SeededChoices(seed)
    count = 1 + choices.below(4)
    data = [[a_datum(choices, f"d{c}{i}") for i in range(1 + choices.below(3))] for c in range(count)]
    places: list[Expr] = []
    made: list[Component] = []
    for number in range(count):
        own = list(data[number])
        if number and choices.chance(3):
            own.append(data[choices.below(number)][0])
        names = {v.name for v in own}
        others = [v for owned in data for v in owned if v.name not in names]
        steady = [*INPUTS, *others, *FROZEN]
        part = a_part(Source(choices, [*own, *own, *steady], steady, places), number, own)
        if isinstance(part, Chart):
            places += [part.active_path(p) for p in part.states if p]
        made.append(part)
    scope = [*INPUTS, *(v for owned in data for v in owned)]
    parts_ = _in_subsystems(choices, made, Source(choices, scope, scope, places))
    tick_ms = TICK_MS // 2 if choices.chance(4) else TICK_MS
    return in_order("Random", *parts_, frozen=FROZEN, tick_ms=tick_ms, step_ms=TICK_MS)


def _in_subsystems(choices: SeededChoices, parts: Sequence[Component], source: Source) -> list[Component]:
    """Some runs of components in enabled subsystems."""
    found, rest = list[Component](), list(parts)
    while rest:
        size = 1 + choices.below(len(rest))
        some, rest = rest[:size], rest[size:]
        if choices.chance(2):
            inner = _in_subsystems(choices, some, source) if size > 1 else some
            some = [Enabled(source.condition(source.scope, 1), *inner)]
        found += some
    return found


def differences(system: System, folder: Path, seed: int, rows: int = ROWS, written: bool = False) -> int:
    """Run the system and what is read of its file, in both readings; the answer is how many rows were alike.

    Inputs are as the system assumes them; ``written``: what is read is written as charts in Python and
    loaded, too.  Raises ``AssertionError`` where they differ, ``ModelError`` for a system that is refused.
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
    random, inputs = Random(seed), AssumedInputs(system)
    now = inputs.first(random)
    frozen = {v.name: now[v.name] for v in system.frozen}
    own, every = Interpreter(system, frozen), {**system.inputs, **{v.name: v for v in system.frozen}}
    for row in range(rows):
        if row:
            now = inputs.further(random, {**own.valuation(), **frozen}, now)
        own.step({name: now[name] for name in system.inputs})
        raw = {**now, **frozen}
        given = {made.inputs[n]: _number(every[n], raw[n]) for n in made.inputs}
        at = own.valuation()
        expected = {made.names[n]: _number(v, at[n]) for n, v in system.written.items()}
        places = {
            made.states[c.name, p]: bool(_holds(c, p, at)) for c in system.charts for p in c.states if p
        }
        for run in runs:
            found = run.step(given)
            unlike = {n: (found[n], expected[n]) for n in found if abs(found[n] - expected[n]) > ROUNDED}
            assert not unlike, f"seed {seed}, row {row}, {type(run).__name__}: {given} gives {unlike}"
        active = {
            n.path.removeprefix(f"{m.chart.drawn.path}/").replace("/", ".")
            for m in direct.machines
            for n in m.active
            if n.parent is not None
        }
        wrong = [n for n, on in places.items() if on != (n in active)]
        assert not wrong, f"seed {seed}, row {row}: {wrong}, active {active}"
    return rows


class AssumedInputs:
    """Random inputs and frozen values as a system assumes them.  Raises ``LookupError`` if none are found."""

    def __init__(self, system: System) -> None:
        made = lower(system)
        self._system, self._frozen = made, made.frozen
        self._first = replace(made, inputs=(*made.inputs, *made.frozen), frozen=())

    def first(self, random: Random) -> dict[str, int]:
        """Those of the first step."""
        some = {v.name: random.choice(v.domain.values) for v in self._first.inputs}
        return self._drawn(self._first, random, self._first.init, some)

    def further(self, random: Random, at: Mapping[str, int], now: Mapping[str, int]) -> dict[str, int]:
        """Those of a step after others."""
        return self._drawn(self._system, random, at, now)

    @staticmethod
    def _drawn(
        system: TransitionSystem, random: Random, at: Mapping[str, int], now: Mapping[str, int]
    ) -> dict[str, int]:
        found = drawn(system, at, now, [v.name for v in system.inputs], random)
        if found is None:
            raise LookupError(f"{system.name}: no inputs are found as it assumes them")
        return found


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
