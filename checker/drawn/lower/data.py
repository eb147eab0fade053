"""The variables that hold the data of a model, and what is learned of their ranges while it is lowered.

A real number has a range that no file holds: it is given, or else it is learned from all that is assigned.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from rovercheck.checker.drawn.lower.kinds import KindTable
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.rounding import nearest_of
from rovercheck.checker.drawn.lower.symbols import (
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    SymbolicStructure,
    filled,
    folded,
    least_and_greatest,
    leaves,
    single_of,
    size_of,
)
from rovercheck.spec_model.lang.domain import Domain, Num, common_resolution, fixed, in_resolution
from rovercheck.spec_model.lang.expr import Const, Expr, Var, rescale

FINEST = Fraction(1, 10**9)
"""Real numbers of a finer resolution need a domain that the user gives."""
MOST_VALUES = 1 << 53


@dataclass
class LearnedRange:
    """The least and the greatest value of a datum so far, all of them multiples of ``resolution``."""

    low: Fraction
    high: Fraction
    resolution: Fraction
    grown: int = 0
    """In how many attempts it became wider."""

    def widened(self, low: Fraction, high: Fraction, resolution: Fraction) -> bool:
        """Take in further values; whether any of them is new."""
        finer = common_resolution(self.resolution, resolution)
        new = min(self.low, low), max(self.high, high), finer
        if new == (self.low, self.high, self.resolution):
            return False
        self.low, self.high, self.resolution = new
        return True

    @property
    def domain(self) -> Domain:
        """All multiples of the resolution between the ends."""
        step = self.resolution
        return fixed((self.low // step) * step, -(-self.high // step) * step, step)


class SizeLearned(Exception):
    """A datum has another size than this attempt began with."""


@dataclass
class DataTable:
    """What is known of the data of a model, over all attempts to lower it.

    ``given`` are domains by the names of data; ``kinds_of`` and ``ranges`` are learned, and once nothing of
    them changes any more in an attempt, that one is right.
    """

    kinds: KindTable
    given: Mapping[str, Domain] = field(default_factory=dict)
    ranges: dict[str, LearnedRange] = field(default_factory=dict)
    kinds_of: dict[str, tuple[str, int, int]] = field(default_factory=dict)
    structures: dict[str, Symbolic] = field(default_factory=dict)
    counters: dict[tuple[str, str], int] = field(default_factory=dict)
    """Counters of states, by the state's path and what is counted, with the steps up to which it matters."""
    watched: dict[str, dict[str, int]] = field(default_factory=dict)
    """Of each chart the data whose changes it sees, by name, with their SSIDs."""
    nested: int = 3
    """How often one state answers an event within itself, which is more than charts do that end."""
    visits: int = 16
    """Times that a path goes through one junction, where a guard may end it."""
    turns: int = 32
    """Turns of a loop that may end before each of them."""
    met: set[str] = field(default_factory=set)
    """Which of these limits there were in this attempt."""
    starting: dict[str, int] = field(default_factory=dict)
    """Raw values that variables have when the first step begins, where initialization changes them."""
    at_rest: dict[str, int] = field(default_factory=dict)
    """Raw values of data before that."""
    delays: set[str] = field(default_factory=set)
    """Delays of which the type is known."""
    waiting: dict[str, tuple[int, int]] = field(default_factory=dict)
    """The sizes of those of which it was not in this attempt."""
    settled: bool = False
    """Whether some became known in this attempt, and were without a type until then."""
    declared_names: set[str] = field(default_factory=set)
    """Every variable that a domain could be given to."""
    free: dict[str, Var] = field(default_factory=dict)
    """The variables that stand for the values of functions and expressions that are free, by name."""
    free_texts: Mapping[str, str] = field(default_factory=dict)
    """These names, by the functions and expressions as they are written."""
    free_met: set[str] = field(default_factory=set)
    """Those that something computes."""
    changed: set[str] = field(default_factory=set)
    notes: dict[str, str] = field(default_factory=dict)
    remarks: dict[str, str] = field(default_factory=dict)
    """What is to be known of a model, and changes nothing of what a verdict says."""

    def declared(self, name: str, value: Symbolic, hidden: bool = False, doc: str = "") -> Symbolic:
        """Variables for a datum that begins as ``value``."""
        made = (self._variable(leaf, one, hidden, doc) for leaf, one in leaves(value, name))
        return filled(value, iter(list(made)))

    def _variable(self, name: str, first: SymbolicScalar, hidden: bool, doc: str) -> SymbolicScalar:
        if not isinstance(first.expr, Const):
            raise NotLowered(f"{name} begins as `{first.expr}`, which is no constant")
        self.declared_names.add(name)
        domain = self.given.get(name) or self.kinds.domain(first.kind)
        if domain is None:
            value = first.constant
            assert value is not None
            learned = self.ranges.get(name)
            if learned is None:
                resolution = Fraction(1, value.denominator)
                learned = self.ranges[name] = LearnedRange(value, value, resolution)
            domain = learned.domain
        sort, raw = domain.sort, first.expr.value
        if isinstance(sort, Num):
            assert isinstance(first.expr.sort, Num)
            found = in_resolution(raw, first.expr.sort.resolution, sort.resolution)
            if found is None or found not in domain:
                raise NotLowered(f"{name} begins as {first.expr}, which is outside its domain, {domain}")
            raw = found
        self.at_rest[name] = raw
        begun = self.starting.get(name, raw)
        if begun not in domain:
            if name in self.given:
                raise NotLowered(f"{name} begins outside its domain, {domain}, once it is initialized")
            begun = raw  # its range was another one in the attempt before
        return SymbolicScalar(first.kind, Var(name, domain, begun, doc, hidden))

    def write(self, writer: ProgramWriter, target: SymbolicScalar, value: Expr) -> None:
        """Assign a value of the right kind to a variable."""
        var = target.expr
        assert isinstance(var, Var)
        if isinstance(var.sort, Num):
            value = self.fitted(var, value)
        writer.assign(var, value)

    def fitted(self, var: Var, value: Expr) -> Expr:
        """A number in the resolution of a variable; in a coarser one the nearest multiple."""
        assert isinstance(var.sort, Num) and isinstance(value.sort, Num)
        if var.name in self.ranges:
            low, high = least_and_greatest(value)
            if self.ranges[var.name].widened(low, high, value.sort.resolution):
                self.changed.add(var.name)
        own, new = value.sort.resolution, var.sort.resolution
        if (own / new).denominator == 1 or (
            isinstance(value, Const) and (value.value * own / new).denominator == 1
        ):
            return rescale(value, Num(new))
        if var.name not in self.ranges:
            self.notes.setdefault(
                var.name, f"{var.name} is rounded to the nearest multiple of {float(new):g} in every step."
            )
        steps = nearest_of(folded(value / new))
        return rescale(folded(steps * Const(1, Num(new))), Num(new))

    def kind_of(self, name: str) -> tuple[str, int, int] | None:
        """The type, rows and columns that a datum without a type was seen to have."""
        return self.kinds_of.get(name)

    def saw(self, name: str, kind: str, rows: int, columns: int) -> None:
        """A value of that type was written to a datum without one: it keeps the first."""
        if name not in self.kinds_of:
            self.kinds_of[name] = kind, rows, columns
            self.changed.add(name)

    def saw_delay(self, name: str, kind: str, size: tuple[int, int], untyped: bool) -> None:
        """A value of that type came into a delay, which has begun without one if it was ``untyped``."""
        if kind == UNTYPED:
            self.waiting[name] = size
        else:
            self.settled |= untyped and name not in self.kinds_of
            self.delays.add(name)
            self.saw(name, kind, *size)

    def settle(self) -> None:
        """Once types of delays are known, those of other data follow anew; what nothing tells is double."""
        if not self.settled and self.changed <= self.ranges.keys():
            for name, size in self.waiting.items():
                self.saw_delay(name, "double", size, True)
        if self.settled:
            self.kinds_of = {name: kind for name, kind in self.kinds_of.items() if name in self.delays}
            self.ranges, self.structures, self.starting = {}, {}, {}

    def saw_value(self, name: str, value: Symbolic) -> None:
        """A value was written to a persistent variable; a structure that a script makes has elements."""
        if not isinstance(value, SymbolicStructure):
            self.saw(name, "double" if value.kind == UNTYPED else value.kind, *size_of(value))
        elif name not in self.structures:
            kinds = ("double" if one.kind == UNTYPED else one.kind for _, one in leaves(value, ""))
            zeros = [single_of(self.kinds.first_value(one)) for one in kinds]
            self.structures[name] = filled(value, iter(zeros))
            self.changed.add(name)

    def begin(self) -> None:
        """A new attempt."""
        self.changed, self.met, self.free_met = set(), set(), set()
        self.waiting, self.settled = {}, False
        self.notes, self.remarks = {}, {}

    def shortened(self) -> bool:
        """Have less of what makes a step long: those in which more happens have no meaning then."""
        if "nested" in self.met and self.nested > 1:
            self.nested -= 1
            return True
        if "visits" in self.met and self.visits > 6:
            self.visits = 6
            return True
        if "turns" in self.met and self.turns > 8:
            self.turns = 8
            return True
        return False

    @property
    def endless(self) -> list[str]:
        """The data whose ranges became wider in this attempt, or that are too fine or wide for one."""
        return sorted(name for name in self.changed if name in self.ranges)

    def too_fine(self) -> list[str]:
        """Data of which the range is no domain: too fine, or too wide."""
        return [
            name
            for name, one in self.ranges.items()
            if one.resolution < FINEST or (one.high - one.low) / one.resolution > MOST_VALUES
        ]


__all__ = ["DataTable", "SizeLearned"]
