"""Which values variables take inside a tick, as intervals, statement by statement (abstract interpretation).

Patrick Cousot, Radhia Cousot: Abstract Interpretation, POPL 1977.  A step has no loops: one pass is exact
enough to choose machine types.
"""

from dataclasses import dataclass

from rovercheck.checker.system.intervals import Interval, interval, postorder
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem

TYPES = (("byte", Interval(0, 255)), ("short", Interval(-(1 << 15), (1 << 15) - 1)))
INT = Interval(-(1 << 31), (1 << 31) - 1)
ZERO = Interval(0, 0)


@dataclass
class ExportFlow:
    """The interval of every variable at a place in the program."""

    at: dict[str, Interval]

    def copy(self) -> "ExportFlow":
        return ExportFlow(dict(self.at))

    def join(self, one: "ExportFlow", other: "ExportFlow") -> None:
        """Become what is so after either of two branches."""
        self.at = {name: one.at[name] | other.at[name] for name in one.at}

    def within(self, var: Var) -> bool:
        """Whether a variable is sure to lie between the ends of its domain."""
        return self.at[var.name].within(Interval(var.domain.low, var.domain.high))


class ExportReach:
    """What every variable and formula of a step can be; collects the hulls for whole variables."""

    def __init__(self, system: TransitionSystem) -> None:
        ours = (*system.frozen, *system.inputs, *system.variables)
        self._start = {v.name: ZERO for v in system.temps}
        self._start |= {v.name: Interval(v.domain.low, v.domain.high) for v in ours}
        self._hull = {name: ends | ZERO for name, ends in self._start.items()}

    def start(self) -> ExportFlow:
        """What is so before a tick: variables lie in their domains, and what passes with a tick is 0."""
        return ExportFlow(dict(self._start))

    def intervals(self, expr: Expr, flow: ExportFlow) -> dict[int, Interval]:
        """The interval of every node of a formula, by ``id``.  Raises ``ModelError`` past 32 bits."""
        known: dict[int, Interval] = {}
        for node in postorder(expr):
            known[id(node)] = flow.at[node.name] if isinstance(node, Var) else interval(node, known)
            if not known[id(node)].within(INT):
                raise ModelError(
                    f"`{node}` takes values of more than 32 bits, which Promela does not have; "
                    "export to btor2 or aiger."
                )
        return known

    def assign(self, var: Var, value: Interval, flow: ExportFlow) -> None:
        """Note that a variable gets a value."""
        flow.at[var.name] = value
        self._hull[var.name] |= value

    def type(self, var: Var) -> str:
        """The narrowest type that holds every value the variable gets, also within a tick."""
        if isinstance(var.sort, Bool):
            return "bool"
        return next((name for name, range in TYPES if self._hull[var.name].within(range)), "int")
