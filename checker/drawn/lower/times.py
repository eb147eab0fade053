"""Times of a chart as counters of its steps, each of which stops where more makes no difference."""

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from fractions import Fraction

from rovercheck.checker.drawn.calls import refuse_seconds
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.syntax import Applied, BinaryOperation, Expression, Name
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import NotLowered, chosen, folded, least_and_greatest
from rovercheck.checker.drawn.parsed import StateNode
from rovercheck.checker.drawn.records import DrawnEvent
from rovercheck.spec_model.lang.domain import Num, integer
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var, const
from rovercheck.spec_model.lang.operators import Op

UNITS = {"sec": Fraction(1), "msec": Fraction(1, 1000), "usec": Fraction(1, 10**6)}
LIMITS: Mapping[str, Callable[[Expr, Expr], Expr]] = {
    "after": lambda count, limit: count >= limit,
    "before": lambda count, limit: count < limit,
    "at": lambda count, limit: count == limit,
}
COUNTED = ("temporalCount", "elapsed", "count", "duration")
LONGEST = 1_000_000
"""Steps that are counted at most."""
UNBOUNDED = 10_000
"""Steps that are counted where a count is computed with, so that no limit of it is known."""


class ChartTimes:
    """The counters of one chart.  Which there are is learned while it is lowered, as ranges of data are."""

    def __init__(
        self, name: str, step: str, table: DataTable, writer: ProgramWriter, events: Iterable[DrawnEvent] = ()
    ) -> None:
        self._name, self._table, self._writer, self._events = name, table, writer, tuple(events)
        self._step: Fraction | None = None
        with suppress(ValueError, ZeroDivisionError):  # as ``auto``
            self._step = Fraction(step.strip())
        self._vars: dict[tuple[str, str], Var] = {}
        self._numbers: dict[int, int] = {}

    # --- what is counted -----------------------------------------------------------------------------------

    def _counter(self, node: StateNode, what: str, limit: int) -> Var:
        """The counter of a state, which goes on to ``limit`` at least."""
        if limit > LONGEST:
            raise NotLowered(f"a time of {limit:,} steps: {LONGEST:,} are counted at most")
        key = (node.path, what)
        known = self._table.counters.get(key, 0)
        if max(limit, 1) > known:
            self._table.counters[key] = max(limit, 1)
            self._table.changed.add(f"{node.path}.{what}")
        return self._var(key)

    def _var(self, key: tuple[str, str]) -> Var:
        if key not in self._vars:
            path, what = key
            inside = path.removeprefix(self._name).strip("/").replace("/", ".")
            name = ".".join(filter(None, (self._writer.name, inside, what)))
            doc = f"steps, {what} of {inside}"
            self._vars[key] = Var(name, integer(0, self._table.counters[key]), 0, doc, hidden=True)
        return self._vars[key]

    def of(self, node: StateNode) -> list[tuple[str, Var]]:
        """The counters of a state with what they count."""
        return [(what, self._var((path, what))) for path, what in self._table.counters if path == node.path]

    def entered(self, node: StateNode) -> None:
        """A state is entered: its counters begin."""
        for _, var in self.of(node):
            self._writer.assign(var, const(0))

    def begin(self, node: StateNode, active: Expr) -> None:
        """A step begins: a state that is active has been so for one more."""
        for what, var in self.of(node):
            if what == "steps" or (what.startswith("every") and what.count(" ") == 1):  # else of an event
                self._writer.assign(var, chosen(active, self._more(what, var), const(0)))

    @staticmethod
    def _more(what: str, var: Var) -> Expr:
        last = const(var.domain.high)
        if what.startswith("every"):
            return Apply(Op.MOD, (var, last), Num()) + 1
        return Apply(Op.MIN, (var + 1, last), Num())

    def saw(self, event: str, node: StateNode, active: Expr) -> None:
        """An event was sent: states that are active have seen it once more."""
        for what, var in self.of(node):
            if (what.startswith("every") and what.endswith(f" {event}")) or what == f"seen {event}":
                self._writer.assign(var, chosen(active, self._more(what, var), var))

    def end(self, node: StateNode, active: Expr, conditions: Mapping[str, Callable[[], Expr]]) -> None:
        """A step ends: conditions that hold now have done so for one more."""
        for what, var in self.of(node):
            if what in conditions:
                holds = folded(active & conditions[what]())
                self._writer.assign(var, chosen(holds, self._more(what, var), const(0)))

    # --- what is asked -------------------------------------------------------------------------------------

    def seconds(self, unit: str) -> Fraction:
        """A step in a unit of time.  Raises ``NotLowered``."""
        if unit not in UNITS:
            raise NotLowered(f"{unit} is no unit of time: write sec, msec or usec")
        if self._step is None:
            raise NotLowered("the length of a step is not known, and a time in seconds is asked for")
        try:
            refuse_seconds(unit, self._events)
        except DrawnFault as fault:
            raise NotLowered(str(fault)) from fault
        return self._step / UNITS[unit]

    def limit(self, name: str, limit: Expr, unit: str, node: StateNode, event: str) -> Expr:
        """``after``, ``before``, ``at`` and ``every``: whether a state has been active for so long."""
        steps, unit = limit, "tick" if unit == "wakeup" else unit
        if unit in UNITS:
            steps = folded(limit / self.seconds(unit))
        most = -(-least_and_greatest(steps)[1] // 1)
        counts_steps = unit in UNITS or unit == "tick"
        if not counts_steps and event != unit:
            return const(False)
        if unit in UNITS and isinstance(steps, Const) and least_and_greatest(steps)[1] != most:
            asked = f"{name}({limit}, {unit}) in {node.path}"
            self._table.remarks[asked] = f"{asked} is no whole number of steps: it counts {most} of them."
        if name == "every":
            if not isinstance(steps, Const) or most < 1 or least_and_greatest(steps)[0] != most:
                raise NotLowered("`every` so many steps, and their number is no whole constant")
            what = f"every {most}" + ("" if counts_steps else f" {unit}")
            var = self._counter(node, what, int(most))
            return folded(self._writer.read(var) == int(most))
        what = "steps" if counts_steps else f"seen {unit}"
        var = self._counter(node, what, int(most) + (name == "at"))
        return folded(LIMITS[name](self._writer.read(var), steps))

    def count(self, unit: str, node: StateNode, most: int | None) -> Expr:
        """How many steps a state has been active, or how often it has seen an event."""
        what = "steps" if unit in (*UNITS, "tick", "wakeup") else f"seen {unit}"
        return self._counted(self._counter(node, what, UNBOUNDED if most is None else most), most)

    def held(self, operator: Expression, condition: Expr, node: StateNode, most: int | None) -> Expr:
        """For how many steps a condition has held; once it is seen not to, they begin anew."""
        what = self.name_of(operator)
        var = self._counter(node, what, UNBOUNDED if most is None else most)
        self._writer.choose(condition, lambda: None, lambda: self._writer.assign(var, const(0)))
        return self._counted(var, most)

    def _counted(self, var: Var, most: int | None) -> Expr:
        value = self._writer.read(var)
        if most is None:
            full = folded(value == const(var.domain.high))
            said = f"{var.name}, which is computed with, is counted up to {var.domain.high:,} steps"
            self._writer.choose(full, lambda: self._writer.fault(said))
        return value

    def name_of(self, operator: Expression) -> str:
        """A name for what measures how long a condition holds: each place where it is written has its own."""
        number = self._numbers.setdefault(id(operator), len(self._numbers) + 1)
        return f"held {number}"


def compared_limit(
    expression: Expression, value: Callable[[Expression], Expr], seconds: Callable[[str], Fraction]
) -> tuple[Applied, int] | None:
    """A count that is compared with a constant, and up to how many steps it matters then."""
    signs = ("<", "<=", ">", ">=", "==", "!=")
    if not isinstance(expression, BinaryOperation) or expression.operator not in signs:
        return None
    for one, other in ((expression.left, expression.right), (expression.right, expression.left)):
        match one:
            case Applied(Name(name), arguments) if name in COUNTED:
                limit = value(other)
                if not isinstance(limit, Const):
                    return None
                most = least_and_greatest(limit)[1]
                unit = _unit(name, arguments)
                steps = most / seconds(unit) if unit in UNITS else most
                return one, max(0, int(steps // 1)) + 1
    return None


def _unit(name: str, arguments: tuple[Expression, ...]) -> str:
    """The unit in which a word counts."""
    if name == "count":
        return "tick"
    given = arguments[1:] if name == "duration" else arguments
    if not given:
        return "sec"
    if isinstance(given[0], Name):
        return given[0].name
    raise NotLowered("times are counted in sec, msec, usec, tick or in an event")


__all__ = ["COUNTED", "LIMITS", "UNITS", "ChartTimes", "compared_limit"]
