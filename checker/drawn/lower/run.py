"""A lowered model run tick by tick on numbers, beside which the direct interpreter is run."""

from collections.abc import Mapping
from fractions import Fraction

from rovercheck.checker.drawn.lower.lowered import LoweredModel
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.interpret import Interpreter


class LoweredRun:
    """A run from power-up.  Inputs and outputs have flat names, as those of the direct interpreter."""

    def __init__(self, lowered: LoweredModel) -> None:
        self._lowered, self._run = lowered, Interpreter(lowered.system)
        self._inputs = {name: var for name, var in lowered.inputs.items() if isinstance(var, Var)}

    def step(self, given: Mapping[str, float]) -> dict[str, float]:
        """One step.  Raises ``ModelError`` for an input outside its domain, or a step without a meaning."""
        read = self._run.system.inputs
        raw = {var.name: _raw(var, given[name]) for name, var in self._inputs.items()}
        self._run.step({name: value for name, value in raw.items() if name in read})
        at = {**self._run.valuation(), **raw}
        return {name: _value(expr, at) for name, expr in self._lowered.outputs.items()}

    def active(self) -> dict[str, int]:
        """The values of all variables after the last step."""
        return self._run.valuation()


def _raw(var: Var, value: float) -> int:
    exact = Fraction(str(value)) if isinstance(value, float) else Fraction(value)
    raw = exact / var.sort.resolution if isinstance(var.sort, Num) else exact
    if raw.denominator != 1 or int(raw) not in var.domain:
        raise ModelError(f"{var.name} = {value:g} is outside its domain, {var.domain}.")
    return int(raw)


def _value(expr: Expr, at: Mapping[str, int]) -> float:
    raw = evaluate(expr, at)
    return float(raw * expr.sort.resolution) if isinstance(expr.sort, Num) else raw


__all__ = ["LoweredRun"]
