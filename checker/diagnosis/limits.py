"""Numbers of a chart with other values: it is lowered once with a number left open, then values are tried.

Values come from the recordings: a limit lies between two values that were met, of which one was on the other
side than drawn.  Of all numbers in between the one with the fewest digits is told.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from math import ceil, floor, log10

from rovercheck.checker.conformance.numbers import number_between, open_number
from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.diagnosis.change import ChangeKind, ChartChange, place_text
from rovercheck.checker.diagnosis.met_values import MetValues
from rovercheck.checker.mutate.formulas import BESIDE
from rovercheck.checker.mutate.places import FormulaPlace
from rovercheck.checker.mutate.rewrites import mapped, numbers_in, same_shape
from rovercheck.checker.mutate.saturation import counted_on
from rovercheck.checker.mutate.wiring import kept
from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.domain import show as number_text
from rovercheck.spec_model.lang.edit import in_system
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, aligned
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import nodes, structure

_SIDES = {Op.LT: Op.GT, Op.GT: Op.LT, Op.LE: Op.GE, Op.GE: Op.LE}
CLOSED = (Op.LE, Op.GE)
OPPOSITE = {Op.LT: Op.GE, Op.GE: Op.LT, Op.LE: Op.GT, Op.GT: Op.LE}
EQUALITY = 3.05
"""How near another code lies that something is equal to: behind another member."""

Gap = tuple[Fraction, Fraction]
"""Two successive values that were met, raw."""


@dataclass(frozen=True)
class NumberSlot:
    """A number of a chart that may have another value.

    ``left`` and ``op`` are those of the comparison that it is the limit of.  ``part`` makes the chart with
    another operator and number, in one place or everywhere that ``left``, or all, is compared with it.
    """

    chart: str
    at: str
    old: Const
    op: Op | None
    left: Expr | None
    part: Callable[[Op | None, Expr], Chart | Block]
    system: System
    beside: tuple[Expr, ...] = ()
    """What else is compared with it."""

    @property
    def sort(self) -> Num:
        assert isinstance(self.old.sort, Num)
        return self.old.sort

    @property
    def drawn(self) -> Fraction:
        """The number as drawn, raw."""
        return Fraction(self.old.value)

    @property
    def of_equality(self) -> bool:
        """Whether it is a code that something is or is not, and no limit."""
        return self.op in (Op.EQ, Op.NE)

    def opened(self, op: Op | None) -> System:
        """The system with the number left open, as an input."""
        return self._with(op, open_number(self.sort))

    def change(self, op: Op | None, raw: Raw, between: Gap | None = None) -> ChartChange:
        """The number as another one; ``between``: the values met between which it lies."""
        value = raw * self.sort.resolution
        drawn = self.drawn * self.sort.resolution
        new, old = self._named(op, value), self._named(self.op, drawn)
        kind: ChangeKind = "constant" if self.op is None else "limit" if raw != self.drawn else "comparison"
        where = "" if self.at == "everywhere" else f", {place_text(self.at)}"
        limit = op is not None and not self.of_equality
        text = f"a limit of {new}, instead of {old}{where}" if limit else f"{new} instead of {old}{where}"
        span = between and (between[0] * self.sort.resolution, between[1] * self.sort.resolution)
        # a digit more, another operator, one place of several: each makes it less likely
        moved = abs(value - drawn) / max(abs(value), abs(drawn), Fraction(1, 10**6))
        far = digits(value) + float(moved) * 0.6 + (op is not self.op) / 4 if raw != self.drawn else 0.0
        far += (not self.at.startswith("everywhere")) / 8
        return ChartChange(
            kind, self.chart, self.at, self._formula(self.op, self.drawn), self._formula(op, raw), text,
            lambda: self._with(op, self._number(op, raw)), far / 100, _between(span),
            tier=EQUALITY if self.of_equality else None, span=span,
        )  # fmt: skip

    def _named(self, op: Op | None, value: Fraction) -> str:
        unit = f" {self.sort.unit}" if self.sort.unit else ""
        if op is None or self.of_equality:
            return f"{number_text(value)}{unit}"
        return f"{number_text(value)}{unit}, {'closed' if op in CLOSED else 'open'}"

    def _formula(self, op: Op | None, raw: Raw) -> str:
        value = number_text(Fraction(raw) * self.sort.resolution)
        if op is None or self.left is None:
            return value
        return f"{', '.join(map(str, (self.left, *self.beside)))} {op.value} {value}"

    def _number(self, op: Op | None, raw: Raw) -> Expr:
        exact = Fraction(raw)
        if op is None and exact.denominator > 1:
            return number_between(exact, self.sort)
        sort = Num(self.sort.resolution / exact.denominator, self.sort.unit)
        return Const(exact.numerator, sort) if exact.denominator > 1 else Const(int(exact), self.sort)

    def _with(self, op: Op | None, number: Expr) -> System:
        part = self.part(op, number)
        changed = in_system(self.system, self.chart, lambda _: part)
        compared = () if self.left is None else (self.left, *self.beside)
        return kept(self.system, counted_on(changed, compared, self.old))


def _between(span: tuple[Fraction, Fraction] | None) -> str:
    if span is None:
        return ""
    low, high = (f"{float(end):.6g}" for end in span)
    return f"any limit between {low} and {high} explains the same" if low != high else ""


def number_slots(system: System, only: frozenset[str]) -> Iterator[NumberSlot]:
    """Every number of a system: those that occur in several places also as one."""
    for part in parts(system.components):
        if part.name in only:
            yield from _of_part(system, part)


def _not_written(formula: Expr) -> set[int]:
    """The places of bits, and each 1 and 0 of a formula that counts four conditions or more."""
    counts, bits = list[int](), set[int]()
    for node in nodes(formula):
        match node:
            case Apply(Op.ITE, (_, Const(1, Num()) as one, Const(0, Num()) as none)):
                counts += id(one), id(none)
            case Apply(Op.BIT, (_, place)):
                bits.add(id(place))
    return bits | set(counts if len(counts) >= 8 else ())


def _of_part(system: System, part: Chart | Block) -> Iterator[NumberSlot]:
    given: dict[int, set[int]] = {}
    same: dict[object, list[NumberSlot]] = {}
    repeated: dict[object, list[NumberSlot]] = {}
    for place, node, put, limit in numbers_in(part):
        at = f"{place.site} {place.role}"
        if id(place.formula) not in given:
            given[id(place.formula)] = _not_written(place.formula)
        if limit is None and id(node) in given[id(place.formula)]:
            continue
        if limit is None:
            assert isinstance(node, Const)
            yield NumberSlot(part.name, at, node, None, None, partial(_plain, place, put), system)
            if place.role not in ("guard", "if"):
                key = place.role, structure(place.formula), structure(put(Const(node.value + 1, node.sort)))
                every = partial(_in_each, part, place.formula, put)
                slot = NumberSlot(part.name, f"everywhere {place.role}", node, None, None, every, system)
                repeated.setdefault(key, []).append(slot)
            continue
        left, old, op = _normal(limit)
        slot = NumberSlot(part.name, at, old, op, left, partial(_compared_at, place, put, left), system)
        yield slot
        if op in OPPOSITE:
            same.setdefault((structure(left), old.value, old.sort), []).append(slot)
    alike: dict[object, list[NumberSlot]] = {}
    for found in same.values():
        if len(found) > 1:
            yield _everywhere(system, part, found[:1])
        alike.setdefault((found[0].old.value, found[0].old.sort), []).append(found[0])
    yield from (_everywhere(system, part, found) for found in alike.values() if len(found) > 1)
    yield from (found[0] for found in repeated.values() if len(found) > 1)


def _plain(place: FormulaPlace, put: Callable[[Expr], Expr], _: Op | None, new: Expr) -> Chart | Block:
    return place.put(put(new))


def _in_each(
    part: Chart | Block, formula: Expr, put: Callable[[Expr], Expr], _: Op | None, new: Expr
) -> Chart | Block:
    """A number in a formula that is assigned in several places, as in all states of a monitor."""
    changed = put(new)
    return mapped(part, lambda node: changed if same_shape(node, formula) else node)


def _compared_at(
    place: FormulaPlace, put: Callable[[Expr], Expr], left: Expr, op: Op | None, new: Expr
) -> Chart | Block:
    return place.put(put(_compared(op, left, new)))


def _normal(limit: Apply) -> tuple[Expr, Const, Op]:
    left, right = limit.args
    if isinstance(right, Const):
        return left, right, limit.op
    assert isinstance(left, Const)
    return right, left, _SIDES.get(limit.op, limit.op)


def _compared(op: Op | None, left: Expr, number: Expr) -> Expr:
    assert op is not None
    args, _ = aligned(op.value, left, number)
    return Apply(op, args, Bool())


def _everywhere(system: System, part: Chart | Block, slots: Sequence[NumberSlot]) -> NumberSlot:
    """All comparisons of some formulas with one number; those with ``<`` and ``>=`` stay opposites."""
    lefts = [slot.left for slot in slots if slot.left is not None]
    old, drawn = slots[0].old, slots[0].op
    assert drawn is not None

    def changed(op: Op | None, new: Expr) -> Chart | Block:
        assert op is not None
        turned = (op is not drawn) and op is BESIDE[drawn]

        def change(node: Expr) -> Expr:
            if not (isinstance(node, Apply) and node.op in COMPARISONS and len(node.args) == 2):
                return node
            if sum(isinstance(a, Const) for a in node.args) != 1:
                return node
            here, number, found = _normal(node)
            if found not in OPPOSITE or number.value != old.value or number.sort != old.sort:
                return node
            if not any(same_shape(here, left) for left in lefts):
                return node
            return _compared(BESIDE[found] if turned else found, here, new)

        return mapped(part, change)

    return NumberSlot(part.name, "everywhere", old, drawn, lefts[0], changed, system, tuple(lefts[1:]))


# --- values ------------------------------------------------------------------------------------------------


def digits(value: Fraction) -> float:
    """How long a number is to say: its significant digits, half of one less for a 5 at the end."""
    if value == 0:
        return 0.5
    scaled, places = abs(value), 0
    while scaled.denominator > 1 and places < 9:
        scaled, places = scaled * 10, places + 1
    if scaled.denominator > 1:
        return 12.0
    text = str(int(scaled)).rstrip("0")
    return len(text) - (0.5 if text.endswith("5") and len(text) > 1 else 0) + places / 2


def simplest(low: Fraction, high: Fraction, closed_low: bool, closed_high: bool) -> Fraction | None:
    """The number with the fewest digits from ``low`` to ``high``, an end itself only where it is closed."""
    if low > high or (low == high and not (closed_low and closed_high)):
        return None
    width = high - low
    power = ceil(log10(width)) if width > 0 else -6
    best: Fraction | None = None
    for exponent in range(power + 1, power - 4, -1):
        for unit in (Fraction(10) ** exponent, Fraction(5) * Fraction(10) ** (exponent - 1)):
            first = ceil(low / unit)
            for k in range(first, min(first + 12, floor(high / unit) + 1)):
                value = k * unit
                inside = (low < value or closed_low) and (value < high or closed_high)
                if inside and low <= value <= high and (best is None or digits(value) < digits(best)):
                    best = value
        if best is not None:
            return best
    ends = [end for end, is_in in ((low, closed_low), (high, closed_high)) if is_in]
    return min(ends, key=digits) if ends else (low + high) / 2


def values_of(
    slot: NumberSlot, met: MetValues, factors: Iterable[Fraction]
) -> Mapping[tuple[Op | None, Fraction], Gap | None]:
    """Operators and raw values for a number, the likeliest first, with the values met on both sides."""
    found: dict[tuple[Op | None, Fraction], Gap | None] = {}
    if slot.op is None or slot.left is None:
        for value in _constants(slot, factors):
            found[None, value] = None
    elif slot.of_equality and slot.op is not None:
        for value in (slot.drawn + 1, slot.drawn - 1, *met.of(slot.left)[1][:20]):
            found[slot.op, value] = None
    else:
        found[BESIDE[slot.op], slot.drawn] = None
        for op, value, gap in _limits(slot, met):
            found.setdefault((op, value), gap)
    found.pop((slot.op, slot.drawn), None)
    return found


def _limits(slot: NumberSlot, met: MetValues) -> Iterator[tuple[Op, Fraction, Gap | None]]:
    assert slot.left is not None and slot.op is not None
    every, recent = met.of_all((slot.left, *slot.beside))
    size = slot.sort.resolution
    seen: set[tuple[Fraction, Fraction]] = set()
    for value in recent:
        gaps = _gaps(every, value, slot.drawn)
        for low, high in gaps:
            if (low, high) in seen:
                continue
            seen.add((low, high))
            for op in (slot.op, BESIDE[slot.op]):
                # which end belongs to the side of the limit itself
                upper = op in (Op.LT, Op.GE)
                nice = simplest(low * size, high * size, not upper, upper)
                if nice is not None:
                    yield op, nice / size, (low, high)
    if not every:  # a formula of what nothing tells: timers and counters
        for value in _constants(slot, ()):
            for op in (slot.op, BESIDE[slot.op]):
                yield op, value, None


def _gaps(every: Sequence[Fraction], value: Fraction, drawn: Fraction) -> list[tuple[Fraction, Fraction]]:
    """The gaps beside a value that was met, or to the drawn limit where nothing lies between."""
    at = bisect_left(every, value)
    after = bisect_right(every, value)
    step = max(abs(drawn) / 4, Fraction(1))
    below = every[at - 1] if at > 0 else value - step
    above = every[after] if after < len(every) else value + step
    return [(below, value), (value, above)]


_TIMES = ".1 .2 .25 .3 .4 .5 .6 .7 .75 .8 .9 1.1 1.2 1.25 1.5 1.75 2 2.5 3 4 5 10 0 -1"
NICE = tuple(map(Fraction, _TIMES.split()))
"""By what a number may have been multiplied."""


def _constants(slot: NumberSlot, factors: Iterable[Fraction]) -> Iterator[Fraction]:
    """Other numbers: a step or two beside, multiples, what the recordings suggest as a factor."""
    drawn = slot.drawn
    for factor in factors:
        yield drawn * factor
    for distance in (1, 2, 5, 10):
        yield drawn + distance
        yield drawn - distance
    for factor in NICE:
        yield drawn * factor
    unit = 1 / slot.sort.resolution
    for whole in (1, 2, 3, 5, 10):
        yield whole * unit
        yield -whole * unit


__all__ = ["NumberSlot", "digits", "number_slots", "simplest", "values_of"]
