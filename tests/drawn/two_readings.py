"""One model run in both ways: by the direct interpreter, and lowered to a system."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from random import Random

from rovercheck.checker.drawn.faults import BY_ZERO, DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.lowered import LoweredModel
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.spec_model.lang.domain import Domain, Num, fixed
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate, step
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.lower.whole import lower

Row = Mapping[str, float]
VALUES: Mapping[str, Sequence[float]] = {
    "u": (-2, -1, 0, 1, 2, 1, 0, 127, -128), "k": (0, 1, 2, 3, 4, 1, 2, 255), "on": (0, 1),
    "x": (-1.5, -0.25, 0, 0.25, 1, 2),
}  # fmt: skip
DOMAINS: Mapping[str, Domain] = {"x": fixed(-2, 2, "0.25")}


@dataclass(frozen=True)
class Compared:
    """What became of a model: ``rows`` that were alike, the fault that ended them, or why it is refused."""

    rows: int
    refused: str = ""
    fault: str = ""


def random_rows(random: Random, count: int) -> list[Row]:
    """Inputs that are held for some steps; ``turn`` is another one in each step."""
    rows: list[Row] = []
    now = {name: values[random.randrange(len(values))] for name, values in VALUES.items()}
    for number in range(count):
        for name, values in VALUES.items():
            if random.random() < 0.3:
                now[name] = random.choice(values)
        rows.append({**now, "turn": number % 4})
    return rows


class SteppedSystem:
    """A lowered model stepped as a transition system.  Raises ``ModelError`` for a step without a meaning."""

    def __init__(self, lowered: LoweredModel) -> None:
        self._lowered, self.system = lowered, lower(lowered.system)
        self._at: dict[str, int] = self.system.init

    def step(self, given: Row) -> dict[str, float]:
        """One step."""
        raw = {
            var.name: _raw(var, given[name])
            for name, var in self._lowered.inputs.items()
            if isinstance(var, Var)
        }
        self._at = step(self.system, self._at, raw)
        for check, said in self.system.checks:
            if self._at[check.name]:
                raise ModelError(said)
        return {name: _value(expr, self._at) for name, expr in self._lowered.outputs.items()}


def compared(
    model: DrawnModel, rows: Sequence[Row], told: str = "", domains: Mapping[str, Domain] = DOMAINS
) -> Compared:
    """Run a model both ways, and as a transition system.  Raises ``AssertionError`` where they differ."""
    try:
        lowered = lowered_model(model, "one.slx", domains)
    except NotLowered as error:
        return Compared(0, refused=str(error))
    run, system = LoweredRun(lowered), SteppedSystem(lowered)
    try:
        direct = ModelRunner(model)
    except DrawnFault as error:  # as it is entered before its first step
        assert _stepped(run, rows[0])[0] is None, f"{told}: {error}"
        return Compared(0, fault=str(error))
    for number, row in enumerate(rows):
        expected: dict[str, float] | None
        try:
            expected = dict(direct.step(row))
            fault = ""
        except DrawnFault as error:
            expected, fault = None, str(error)
        found, said = _stepped(run, row)
        if BY_ZERO in said and _stepped(system, row)[0] is None:
            return Compared(number, fault=said)  # the interpreter goes on with Inf, as MATLAB does
        assert found == expected, (
            f"{told}, row {number}, {row}: {found} ({said}) in place of {expected} ({fault})"
        )
        other, said = _stepped(system, row)
        assert other == found, (
            f"{told}, row {number}, {row}: as a system {other} ({said}) in place of {found}"
        )
        if expected is None:
            return Compared(number, fault=fault)
    return Compared(len(rows))


def _stepped(run: LoweredRun | SteppedSystem, row: Row) -> tuple[dict[str, float] | None, str]:
    try:
        return run.step(row), ""
    except ModelError as error:
        return None, str(error)


def _raw(var: Var, value: float) -> int:
    return int(value / var.sort.resolution) if isinstance(var.sort, Num) else int(value)


def _value(expr: Expr, at: Mapping[str, int]) -> float:
    raw = evaluate(expr, at)
    return float(raw * expr.sort.resolution) if isinstance(expr.sort, Num) else raw


__all__ = ["DOMAINS", "Compared", "Row", "SteppedSystem", "compared", "random_rows"]
