"""The rover's charts written as models of Simulink and read again: do its properties get the same verdicts?

    python -m benchmarks.slx_verdicts [--seconds SECONDS] [--within MINUTES] [SYSTEM ...]

Every system without enabled subsystems is written, and its properties are decided on what is read from
its file.  Each gets as many seconds; after as many minutes no further system is begun.  The exit code is 1
if a verdict differs.
"""

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from time import monotonic

from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.engines import Limits
from rovercheck.checker.export.slx import SlxModel, simulink_of
from rovercheck.checker.model.drawn import SimulinkModel, read_simulink
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.chart import NOWHERE, Block, Chart
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var, ite
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems

PREFIX = "slx_"
"""What names in Simulink begin with, so that they stand beside those of the rover."""


def read_again(system: System, folder: Path) -> System:
    """The system of the file that is written of it, with the variables of the rover beside those of the file.

    One with more runs than the rover stands for itself: it names no other in which a run is looked for.
    """
    made = simulink_of(system, PREFIX)
    path = folder / f"{made.name}.slx"
    made.save(path)
    model = read_simulink(path)
    known = {one.name: one for one in (*system.inputs.values(), *system.frozen, *system.written.values())}
    inside = {name: _as(var, _of_file(model, made.names[name])) for name, var in known.items()}
    given = {name: _as(known[name], _of_file(model, own)) for name, own in made.inputs.items()}
    copies = [Assign(var, inside[name]) for name, var in known.items()]
    for chart in system.charts:
        copies += _places(chart, made, model)
    begun = [given[one.name] for one in system.frozen]
    return replace(
        model.system, name=system.name, place=system.place, step_ms=system.step_ms, tick_ms=system.tick_ms,
        components=(*model.system.components, Block("as specified", copies)),
        assume=_instead(system.assumed, given), under=system.under,
        frozen=tuple(one for one in begun if isinstance(one, Var)),
        elapsed=None if system.elapsed is None else _var(given[system.elapsed.name]),
    )  # fmt: skip


def _of_file(model: SimulinkModel, name: str) -> Expr:
    return model[name]


def _var(expr: Expr) -> Var:
    assert isinstance(expr, Var)
    return expr


def _as(var: Var, expr: Expr) -> Expr:
    """What is read of a file, in the steps that a variable of the rover has."""
    if not isinstance(var.sort, Num) or not isinstance(expr.sort, Num):
        return expr
    own, new = expr.sort.resolution, var.sort.resolution
    if own == new:
        return expr
    if (own / new).denominator == 1:
        return Apply(Op.SCALE, (expr, Const(int(own / new), Num())), var.sort)
    assert (new / own).denominator == 1, f"{var.name}: steps of {own} and {new}"
    return Apply(Op.DIV, (expr, Const(int(new / own), Num())), var.sort)


def _places(chart: Chart, made: SlxModel, model: SimulinkModel) -> Iterator[Assign]:
    """Where a chart of the rover is, by the states that are active in the file."""
    [whole] = model.system.charts

    def active(path: tuple[str, ...]) -> Expr:
        return whole.active_path(tuple(made.states[chart.name, path].split(".")))

    for path, state in chart.states.items():
        if not state.states or state.parallel:
            continue
        place = chart.location(path)
        value: Expr = Const(place.domain.raw(NOWHERE), place.sort)
        for child in reversed(state.states):
            here = Const(place.domain.raw(child.name), place.sort)
            value = ite(active((*path, child.name)), here, value)
        yield Assign(place, value)
    entered = chart.entered
    yes, no = (Const(entered.domain.raw(one), entered.sort) for one in ("yes", "no"))
    yield Assign(entered, ite(active(()), yes, no))


def _instead(expr: Expr, known: Mapping[str, Expr]) -> Expr:
    match expr:
        case Var(name):
            return known.get(name, expr)
        case Named(name, body):
            return Named(name, _instead(body, known))
        case Apply(op, args, sort):
            return Apply(op, tuple(_instead(one, known) for one in args), sort)
    return expr


def main(arguments: list[str]) -> int:
    """Decide, and print what differs; the exit code."""
    parser = argparse.ArgumentParser(prog="benchmarks.slx_verdicts")
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--within", type=float, default=600.0)
    parser.add_argument("systems", nargs="*")
    asked = parser.parse_args(arguments)
    by_system: dict[str, list[Property]] = {}
    for prop in catalogue().values():
        by_system.setdefault(prop.on, []).append(prop)
    told, start = Counter[str](), monotonic()
    with tempfile.TemporaryDirectory() as folder:
        for name, system in systems().items():
            if (asked.systems and name not in asked.systems) or name not in by_system:
                continue
            if monotonic() - start > asked.within * 60:
                told["not begun"] += len(by_system[name])
                continue
            told += _decided(system, by_system[name], Path(folder), asked.seconds)
            print(f"  {name}: so far {_summary(told)}", flush=True)
    print(_summary(told))
    return 1 if told["differs"] else 0


def _decided(system: System, properties: list[Property], folder: Path, seconds: float) -> Counter[str]:
    """How many verdicts of the properties of one system are the same, differ, or are not known."""
    told = Counter[str]()
    try:
        again = read_again(system, folder)
    except ModelError as error:
        kind = "enabled subsystem" if "executes only while" in str(error) else "refused"
        print(
            f"{system.name}: {str(error).splitlines()[0][:300]}"
            if kind == "refused"
            else f"{system.name}: {kind}"
        )
        return Counter({kind: len(properties)})
    search = SearchSettings(limits=Limits(seconds=seconds), jobs=1)
    since = monotonic()
    try:
        for result in results(properties, {system.name: again}, search, quiet=True):
            word = _compared(result, "read again" if system.concrete else "")
            told[word] += 1
            said = f"{result.property.id:24} {system.name:32} {word:12} {result.verdict.word:10}"
            print(f"{said} {monotonic() - since:7.1f} s", flush=True)
            since = monotonic()
    except ModelError as error:
        if len(properties) > 1:
            return sum((_decided(system, [one], folder, seconds) for one in properties), Counter())
        print(f"{properties[0].id:24} {system.name:32} not asked: {str(error).splitlines()[0]}", flush=True)
        return Counter({"not asked": 1})
    return told


def _compared(result: Result, apart: str) -> str:
    """Whether a verdict is that of the rover's charts; ``apart``: its kept run is one of another system."""
    if isinstance(result.verdict, Unknown):
        return "not decided"
    return "same" if CheckedProperty(result, expected(result.property.id), apart).as_expected else "differs"


def _summary(told: Counter[str]) -> str:
    return ", ".join(f"{count} {word}" for word, count in told.items()) or "nothing"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
