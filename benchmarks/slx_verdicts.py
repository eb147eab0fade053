"""The rover's charts written as models of Simulink and read again: do its properties get the same verdicts?

    python -m benchmarks.slx_verdicts [--seconds SECONDS] [--within MINUTES] [SYSTEM ...]

Every system is written, what is read of its file is run beside it in both readings, and then its properties
are decided on that.  Each search gets as many seconds; after as many minutes no further system is begun.  A
line for each property says what came of it, after how many seconds, and why nothing did.  The exit code is 1
if a run or a verdict differs.
"""

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from time import monotonic

from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.engines import Limits
from rovercheck.checker.export.slx import SlxModel, simulink_of
from rovercheck.checker.model.drawn import read_simulink
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.chart import NOWHERE, Chart
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var, all_of, any_of
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.specialise import Specialiser
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems
from tests.export.slx_runs import differences

ROWS = 30
"""Steps that each system is run for."""


class ReadAgain(Specialiser):
    """The system ``read`` of the file written of one of the rover; its properties in words of the file.

    One with more runs than the rover stands for itself: it names no other in which a run is looked for.
    """

    def __init__(self, system: System, folder: Path) -> None:
        super().__init__({})
        made = simulink_of(system, "" if system.elapsed is None else "slx_")
        path = folder / f"{made.name}.slx"
        made.save(path)
        self._model = read_simulink(path)
        known = {one.name: one for one in (*system.inputs.values(), *system.frozen, *system.written.values())}
        self.inside = {name: _as(var, self._model[made.names[name]]) for name, var in known.items()}
        given = {name: _as(known[name], self._model[own]) for name, own in made.inputs.items()}
        self.inside |= {name: expr for name, expr in given.items() if name in system.inputs}
        self.active = dict(self._places(system, made))
        given = {name: _declared(expr, self._model[made.inputs[name]]) for name, expr in given.items()}
        self.given = given
        assumed = _Given(given, self).expr(system.assumed)
        if system.elapsed is not None:  # it has a unit, which nothing has in a file
            self.inside[system.elapsed.name] = system.elapsed
            assumed = all_of(assumed, Apply(Op.EQ, (system.elapsed, given[system.elapsed.name]), Bool()))
        self.read = replace(
            self._model.system, name=system.name, place=system.place, step_ms=system.step_ms,
            tick_ms=system.tick_ms, assume=assumed, under=system.under,
            frozen=tuple(one for v in system.frozen if isinstance(one := given[v.name], Var)),
            elapsed=system.elapsed,
        )  # fmt: skip

    def property(self, one: Property) -> Property:
        """A property of the rover as one of the file."""
        return replace(one, form=self.parts_of(one.form))

    def _places(self, system: System, made: SlxModel) -> Iterator[tuple[tuple[str, int], Expr]]:
        """The conditions that states are active, by the variables that say it in the rover."""
        charts = {one.name: one for one in self._model.system.charts}
        for chart in system.charts:
            whole = charts[made.charts[chart.name]]

            def active(*path: str, own: Chart = chart, drawn: Chart = whole) -> Expr:
                return drawn.active_path(tuple(made.states[own.name, path].split(".")))

            for path, state in chart.states.items():
                if state.states and not state.parallel:
                    place = chart.location(path)
                    inside = [active(*path, child.name) for child in state.states]
                    yield (place.name, place.domain.raw(NOWHERE)), ~any_of(*inside)
                    for child, condition in zip(state.states, inside, strict=True):
                        yield (place.name, place.domain.raw(child.name)), condition
            for word, condition in (("yes", active()), ("no", ~active())):
                yield (chart.entered.name, chart.entered.domain.raw(word)), condition

    def state(self, expr: Expr) -> Expr | None:
        """For ``the place of a chart is a state``, or is not, the condition that says so of the file."""
        if isinstance(expr, Apply) and expr.op in (Op.EQ, Op.NE):
            for one, other in (expr.args, expr.args[::-1]):
                if isinstance(one, Var) and isinstance(other, Const):
                    found = self.active.get((one.name, other.value))
                    if found is not None:
                        return found if expr.op is Op.EQ else ~found
        return None

    def _expr(self, expr: Expr) -> Expr:
        found = self.state(expr)
        if found is not None:
            return found
        if isinstance(expr, Var):
            assert expr.name in self.inside, f"{expr.name} is not in the file"
            return self.inside[expr.name]
        return super()._expr(expr)


class _Given(Specialiser):
    """What is assumed of the inputs of the rover as a condition on those of the file."""

    def __init__(self, given: Mapping[str, Expr], inside: ReadAgain) -> None:
        super().__init__({})
        self._given, self._known = given, inside

    def _expr(self, expr: Expr) -> Expr:
        if isinstance(expr, Var):
            return self._given[expr.name] if expr.name in self._given else self._known.expr(expr)
        return super()._expr(expr)


def _declared(expr: Expr, own: Expr) -> Expr:
    """A variable of the file as the file has it, whatever it begins with in the rover."""
    return own if isinstance(expr, Var) else expr


def _as(var: Var, expr: Expr) -> Expr:
    """What is read of a file, in the steps that a variable of the rover has, and beginning as it does."""
    if not isinstance(var.sort, Num) or not isinstance(expr.sort, Num):
        return replace(expr, init=var.init) if isinstance(expr, Var) else expr
    own, new = expr.sort.resolution, var.sort.resolution
    if own == new:
        return replace(expr, init=var.init) if isinstance(expr, Var) else expr
    if (own / new).denominator == 1:
        return Apply(Op.SCALE, (expr, Const(int(own / new), Num())), var.sort)
    assert (new / own).denominator == 1, f"{var.name}: steps of {own} and {new}"
    return Apply(Op.DIV, (expr, Const(int(new / own), Num())), var.sort)


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
            told += _run(system, Path(folder))
            told += _decided(system, by_system[name], Path(folder), asked.seconds)
            print(f"  {name}: so far {_summary(told)}", flush=True)
    print(_summary(told))
    return 1 if told["differs"] or told["runs that differ"] else 0


def _run(system: System, folder: Path) -> Counter[str]:
    """Whether what is read of the file does the same as the system, in both readings."""
    try:
        rows = differences(system, folder, 1, ROWS)
    except (AssertionError, ModelError) as error:
        print(f"{system.name}: {error}", flush=True)
        return Counter({"runs that differ": 1})
    print(f"  {system.name}: {rows} steps alike in both readings", flush=True)
    return Counter({"runs alike": 1})


def _decided(system: System, properties: list[Property], folder: Path, seconds: float) -> Counter[str]:
    """How many verdicts of the properties of one system are the same, differ, or are not known."""
    try:
        again = ReadAgain(system, folder)
    except ModelError as error:
        print(f"{system.name}: {str(error).splitlines()[0][:300]}")
        return Counter({"refused": len(properties)})
    return compared(system, again, properties, SearchSettings(limits=Limits(seconds=seconds), jobs=1))


def compared(
    system: System, again: ReadAgain, properties: Sequence[Property], search: SearchSettings
) -> Counter[str]:
    """How many verdicts of properties are the same on what is read of a file, differ, or are not known."""
    told, since = Counter[str](), monotonic()
    try:
        asked = [again.property(one) for one in properties]
        for result in results(asked, {system.name: again.read}, search, quiet=True):
            word = _compared(result, "read again" if system.concrete else "")
            told[word] += 1
            said = f"{result.property.id:24} {system.name:32} {word:12} {result.verdict.word:10}"
            why = result.verdict.reason[:90] if isinstance(result.verdict, Unknown) else ""
            print(f"{said} {monotonic() - since:7.1f} s  {why}".rstrip(), flush=True)
            since = monotonic()
    except ModelError as error:
        if len(properties) > 1:
            return sum((compared(system, again, [one], search) for one in properties), Counter())
        print(f"{properties[0].id:24} {system.name:32} not asked: {str(error).splitlines()[0]}", flush=True)
        return Counter({"not asked": 1})
    return told


def _compared(result: Result, apart: str) -> str:
    """Whether a verdict is that of the rover's charts; ``apart``: its kept run is one of another system.

    A run that an engine did not search for a shortest one may be longer than the kept one.
    """
    if isinstance(result.verdict, Unknown):
        return "not decided"
    because = result.verdict.because
    if isinstance(because, Trace) and not because.shortest:
        apart = "not a shortest run"
    return "same" if CheckedProperty(result, expected(result.property.id), apart).as_expected else "differs"


def _summary(told: Counter[str]) -> str:
    return ", ".join(f"{count} {word}" for word, count in told.items()) or "nothing"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
