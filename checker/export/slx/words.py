"""Temporal words of one chart: Stateflow's own where they mean the same, and else counters that are drawn.

Stateflow's ``duration(c)`` restarts when a guard that asks for it is evaluated, here when its state is
executed: that is the same where ``c`` does not change from then to the end of the step.  ``held`` and
``rising`` are seen at the start of the chart's step, before which other charts may write.
"""

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial

from rovercheck.checker.export.slx.formulas import FormulaWriter, Word
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.domain import Domain, boolean, integer, show
from rovercheck.spec_model.lang.expr import Expr, Temporal, Var, When
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.walk import structure, variables


@dataclass
class ChartWords:
    """The words of one chart.

    ``changing`` are the variables that it or what follows it in a step writes.  ``before`` and ``after`` are
    statements for the start and the end of each of its steps, ``data`` what they need.
    """

    chart: Chart
    formulas: FormulaWriter
    step_ms: int
    changing: Collection[str]
    elapsed: Var | None = None
    tick_ms: int = 0
    """How long a step of the model is, where the chart is executed in few of them."""
    data: dict[str, tuple[Domain, int]] = field(default_factory=dict)
    before: list[str] = field(default_factory=list)
    after: list[str] = field(default_factory=list)
    executed: dict[Path, list[str]] = field(default_factory=dict)
    entered: dict[Path, list[str]] = field(default_factory=dict)
    _known: dict[object, str] = field(default_factory=dict)

    def of(self, source: Path | None) -> Word:
        """What is written for words on a way from a state; in actions and on default ways from none."""
        return lambda word: self._written(word, source)

    def counts(self, word: Temporal) -> bool:
        """Whether the word is a duration that needs a counter of its own."""
        assert word.arg is not None or word.when is not When.DURATION
        if word.when is not When.DURATION or word.arg is None:
            return False
        return self._sparse or not self._steady(word.arg)

    @property
    def _sparse(self) -> bool:
        """Whether its timers count steps longer than those of the model, which Stateflow would count."""
        return bool(self.tick_ms) and self.tick_ms != self.step_ms

    def _steady(self, condition: Expr) -> bool:
        return not variables(condition).keys() & self.changing

    def _written(self, word: Temporal, source: Path | None) -> str:
        match word.when:
            case When.AFTER if word.span is not None:
                if word.span.unit == "ticks" or self._sparse:
                    return f"after({word.span.ticks(self.step_ms)}, tick)"
                return f"after({self._seconds(word.span)}, sec)"
            case When.DURATION if word.span is not None and word.arg is not None:
                sign = ">" if word.strict else ">="
                if not self.counts(word):
                    return f"(duration({self.formulas(word.arg)}) {sign} {self._seconds(word.span)})"
                assert source is not None
                key = (source, structure(word))
                counter = self._once(key, partial(self._duration, word, word.arg, source))
                return f"({counter} {sign} {word.span.ticks(self.step_ms)})"
            case When.RISING if word.arg is not None:
                return self._once(structure(word), partial(self._rising, word.arg))
            case When.HELD if word.arg is not None and word.span is not None:
                measured = word.span.measured(self.elapsed)
                top = word.span.ticks(1 if measured else self.step_ms) + 1
                counter = self._once(structure(word), partial(self._held, word.arg, top, measured))
                return f"({counter} >= {top})"
        raise AssertionError(word)

    def _seconds(self, span: Span) -> str:
        return show(Fraction(span.ticks(self.step_ms) * self.step_ms, 1000))

    def _once(self, key: object, make: Callable[[], str]) -> str:
        if key not in self._known:
            self._known[key] = make()
        return self._known[key]

    def _datum(self, kind: str, domain: Domain, init: int = 0) -> str:
        name = f"{self.chart.name}.{kind}{1 + len(self.data)}"
        self.data[name] = domain, init
        return self.formulas.names(name)

    def _rising(self, condition: Expr) -> str:
        memory, found = self._datum("was", boolean, 1), self._datum("rising", boolean)
        shown = self.formulas(condition)
        self.before += [f"{found} = ({shown}) && ~{memory};", f"{memory} = {shown};"]
        return found

    def _held(self, condition: Expr, top: int, measured: bool) -> str:
        counter = self._datum("held", integer(0, top))
        more = [f"{counter} = min({counter} + 1, {top});"]
        if measured and self.elapsed is not None:
            longer = f"{counter} = min({counter} + {self.formulas(self.elapsed)}, {top});"
            more = [f"if {counter} > 0", f"    {longer}", "else", f"    {counter} = 1;", "end"]
        self.before += _if(self.formulas(condition), more, [f"{counter} = 0;"])
        return counter

    def _duration(self, word: Temporal, condition: Expr, source: Path) -> str:
        assert word.span is not None
        top = word.span.ticks(self.step_ms) + 1
        counter, shown = self._datum("duration", integer(0, top)), self.formulas(condition)
        self.executed.setdefault(source, []).extend(_if(f"~({shown})", [f"{counter} = 0;"]))
        self.entered.setdefault(source, []).append(f"{counter} = 0;")
        count = _if(shown, [f"{counter} = min({counter} + 1, {top});"], [f"{counter} = 0;"])
        self.after += _if(f"in({self.formulas.states[self.chart.name, source]})", list(count))
        return counter


def _if(condition: str, then: list[str], otherwise: list[str] | None = None) -> Iterator[str]:
    yield f"if {condition}"
    yield from (f"    {line}" for line in then)
    if otherwise:
        yield "else"
        yield from (f"    {line}" for line in otherwise)
    yield "end"


__all__ = ["ChartWords"]
