"""Actions as statements of MATLAB's action language, a line each."""

from collections.abc import Iterator, Sequence

from rovercheck.checker.export.slx.formulas import FormulaWriter, Word, no_words
from rovercheck.spec_model.lang.action import Action, Assign, If, Send
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.domain import Enum
from rovercheck.spec_model.lang.expr import Apply, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op


class ActionWriter:
    """Actions of one chart, or of a block."""

    def __init__(self, formulas: FormulaWriter, chart: Chart | None, word: Word = no_words) -> None:
        self.formulas, self._chart, self._word = formulas, chart, word

    def lines(self, actions: Sequence[Action]) -> Iterator[str]:
        """Statements in order."""
        for action in actions:
            match action:
                case Assign(var, value):
                    yield from self._assigned(var, value)
                case If(condition, then, otherwise):
                    yield f"if {self.formulas(condition, self._word)}"
                    yield from (f"    {line}" for line in self.lines(then))
                    if otherwise:
                        yield "else"
                        yield from (f"    {line}" for line in self.lines(otherwise))
                    yield "end"
                case Send(event, receiver):
                    assert self._chart is not None
                    state = self.formulas.states[self._chart.name, self._chart.path(receiver)]
                    yield f"send({self.formulas.names(event_name(self._chart, event))}, {state});"

    def _assigned(self, var: Var, value: Expr) -> Iterator[str]:
        while isinstance(value, Named):
            value = value.body
        if isinstance(value, Apply) and value.op is Op.ITE and isinstance(value.sort, Enum):
            test, then, other = value.args
            yield from self.lines([If(test, (Assign(var, then),), (Assign(var, other),))])
            return
        yield f"{self.formulas.names(var.name)} = {self.formulas(value, self._word)};"


def event_name(chart: Chart, event: str) -> str:
    """Events of charts that stand in one have the chart in their name."""
    return f"{chart.name}.{event}"


__all__ = ["ActionWriter", "event_name"]
