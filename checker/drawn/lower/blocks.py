"""What the blocks of a diagram compute from their inputs in a step, as formulas."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial, reduce

from rovercheck.checker.drawn.lower.arithmetic import binary, kind_of_both, unary, zeros_of
from rovercheck.checker.drawn.lower.builtins import greatest, least
from rovercheck.checker.drawn.lower.conversions import (
    WRAPS,
    IntegerRules,
    as_condition,
    as_number,
    converted,
    each_converted,
    in_range,
)
from rovercheck.checker.drawn.lower.kinds import KindTable
from rovercheck.checker.drawn.lower.rounding import (
    by_cases,
    ceiling_of,
    floor_of,
    nearest_of,
    sum_of,
    toward_zero,
)
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    REALS,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    SymbolicStructure,
    chosen,
    filled,
    flat,
    folded,
    least_and_greatest,
    leaves,
    matrix,
    number,
    single_of,
    size_of,
    truth,
)
from rovercheck.checker.drawn.records import DrawnBlock
from rovercheck.checker.drawn.refused import selector_refused
from rovercheck.spec_model.lang.expr import Expr, all_of, any_of, const

Inputs = Sequence[Symbolic]
ROUNDINGS: Mapping[str, Callable[[Expr], Expr]] = {
    "Floor": floor_of, "Ceiling": ceiling_of, "Zero": toward_zero,
    "Nearest": lambda one: floor_of(sum_of(one, const(Fraction(1, 2)))), "Round": nearest_of,
}  # fmt: skip


@dataclass(frozen=True)
class BlockTypes:
    """What a block needs beside its inputs: the types of the model, and the values of its parameters."""

    kinds: KindTable
    value_of: Callable[[str], Symbolic]
    zeros: list[Expr] = field(default_factory=list)
    """The conditions under which blocks divide by 0 that were not taken yet."""
    outside: list[tuple[str, Expr]] = field(default_factory=list)
    """The types that numbers did not fit, each with the condition of it, that were not taken yet."""

    def take_zeros(self) -> list[Expr]:
        """The conditions under which the block that was computed last divides by 0."""
        found = self.zeros[:]
        self.zeros.clear()
        return found

    def take_outside(self) -> dict[str, Expr]:
        """The types that numbers of the block that was computed last do not fit, and when."""
        found = dict.fromkeys(kind for kind, _ in self.outside)
        made = {kind: folded(any_of(*(c for of, c in self.outside if of == kind))) for kind in found}
        self.outside.clear()
        return made

    def rules(self, block: DrawnBlock) -> IntegerRules:
        """Whether the integers of a block stop at their ends; they wrap unless it says so."""
        saturates = block.parameters.get("SaturateOnIntegerOverflow") == "on"
        return IntegerRules(False, saturates, True, lambda *left: self.outside.append(left))

    def typed(self, block: DrawnBlock, value: Symbolic) -> Symbolic:
        """A value in the type that a block says, if it says one."""
        text = block.parameters.get("OutDataTypeStr", "Inherit")
        kind = "" if text.startswith(("Inherit", "Bus")) else self.kinds.kind(text)
        return self.rounded(block, value, kind) if kind else value

    def rounded(self, block: DrawnBlock, value: Symbolic, kind: str) -> Symbolic:
        """A value in a type, rounded as the block says."""
        if kind not in INTEGERS or isinstance(value, SymbolicStructure):
            return each_converted(value, kind, self.rules(block), self.kinds)
        round_ = rounding_of(block)
        made = (
            SymbolicScalar(kind, in_range(round_(as_number(one)), kind, self.rules(block)))
            for one in flat(value)
        )
        return matrix(list(made), *size_of(value))


def rounding_of(block: DrawnBlock) -> Callable[[Expr], Expr]:
    """How a block rounds: down if it says nothing.  Raises ``NotLowered``."""
    way = block.parameters.get("RndMeth", "Floor")
    if way not in ROUNDINGS:
        raise NotLowered(f"the rounding {way}: {', '.join(ROUNDINGS)} are known")
    return ROUNDINGS[way]


BlockFormula = Callable[[DrawnBlock, Inputs, BlockTypes], list[Symbolic]]


def _constant(block: DrawnBlock, _: Inputs, types: BlockTypes) -> list[Symbolic]:
    value = types.value_of(block.parameters.get("Value", "1"))
    text = block.parameters.get("OutDataTypeStr", "Inherit")
    kind = "" if text.startswith(("Inherit", "Bus")) else types.kinds.kind(text)
    return [each_converted(value, kind, types.rules(block), types.kinds) if kind else value]


def _in_places(inputs: Inputs) -> tuple[list[tuple[SymbolicScalar, ...]], tuple[int, int]]:
    """The elements of inputs place by place, where a scalar stands for all, and the size of them."""
    wide = [one for one in inputs if size_of(one) != (1, 1)]
    size = size_of(wide[0]) if wide else (1, 1)
    if any(size_of(one) != size for one in wide):
        raise NotLowered("its inputs are matrices of several sizes")
    columns = [
        tuple(flat(one)) if size_of(one) == size else tuple(flat(one)) * size[0] * size[1] for one in inputs
    ]
    return list(zip(*columns, strict=True)), size


def _said(block: DrawnBlock) -> str:
    """The output type that a block says, or how it inherits one."""
    return block.parameters.get("OutDataTypeStr", "Inherit: Inherit via internal rule")


def _operands(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> Inputs:
    """What a block computes with: integers as real numbers beside one, and for a type that is said."""
    kinds = [one.kind for one in inputs]
    real = "double" if "double" in kinds else "single" if "single" in kinds else ""
    if not real and not _said(block).startswith("Inherit") and not {"int64", "uint64"} & set(kinds):
        real = "double"
    return [
        each_converted(one, real, WRAPS, types.kinds) if real and one.kind in INTEGERS else one
        for one in inputs
    ]


def _logic(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    operator = block.parameters.get("Operator", "AND")
    ways: Mapping[str, Callable[[Sequence[Expr]], Expr]] = {
        "AND": lambda every: all_of(*every), "OR": lambda every: any_of(*every),
        "NOT": lambda every: ~every[0],
        "NAND": lambda every: ~all_of(*every), "NOR": lambda every: ~any_of(*every),
        "XOR": lambda every: reduce(_either, every), "NXOR": lambda every: ~reduce(_either, every),
    }  # fmt: skip
    if operator not in ways:
        raise NotLowered(f"the operator {operator} of a Logic block")
    if len(inputs) == 1 and operator != "NOT":
        return [types.typed(block, truth(folded(ways[operator]([as_condition(v) for v in flat(inputs[0])]))))]
    places, size = _in_places(inputs)
    made = [truth(folded(ways[operator]([as_condition(one) for one in place]))) for place in places]
    return [types.typed(block, matrix(made, *size))]


def _either(one: Expr, other: Expr) -> Expr:
    return folded(any_of(all_of(one, ~other), all_of(~one, other)))


def _relation(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    sign = block.parameters.get("Operator", "<=").replace("~=", "!=")
    return [binary(sign, inputs[0], inputs[1], WRAPS)]


def _compared(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    """A comparison with a constant, which has the type of the input."""
    written = block.parameters.get("const", "3.0") if block.kind == "CompareToConstant" else "0"
    constant, kind = types.value_of(written), inputs[0].kind
    if kind in INTEGERS:
        low, high = INTEGERS[kind]
        values = [one.constant for one in flat(constant)]
        if any(one is None or one.denominator != 1 or not low <= one <= high for one in values):
            raise NotLowered(f"it compares {kind} with {written}: write a number of that type")
    if kind in INTEGERS or kind in REALS:
        constant = each_converted(constant, kind, WRAPS, types.kinds)
    sign = block.parameters.get("relop", "<=").replace("~=", "!=")
    return [types.typed(block, binary(sign, inputs[0], constant, WRAPS))]


def _signs(text: str, sign: str) -> str:
    """The signs of inputs: as written, or as many as there are."""
    plain = text.replace("|", "").strip()
    return sign * int(plain) if plain.isdigit() else plain


def _sum(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    signs, rules = _signs(block.parameters.get("Inputs", "++"), "+"), types.rules(block)
    inputs = flat(inputs[0]) if len(inputs) == 1 else _operands(block, inputs, types)
    signs = signs * len(inputs) if len(signs) == 1 else signs
    first = inputs[0] if signs[0] == "+" else unary("-", inputs[0], rules)
    for sign, value in zip(signs[1:], inputs[1:], strict=True):
        first = binary(sign, first, value, rules)
    return [types.typed(block, first)]


def _product(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    signs, rules = _signs(block.parameters.get("Inputs", "2"), "*"), types.rules(block)
    inputs = flat(inputs[0]) if len(inputs) == 1 else _operands(block, inputs, types)
    signs = signs * len(inputs) if len(signs) == 1 else signs
    first = inputs[0] if signs[0] == "*" else _quotient(block, number("double", 1), inputs[0], types)
    for sign, value in zip(signs[1:], inputs[1:], strict=True):
        divides = sign == "/"
        first = _quotient(block, first, value, types) if divides else binary(".*", first, value, rules)
    return [types.typed(block, first)]


def _quotient(block: DrawnBlock, one: Symbolic, other: Symbolic, types: BlockTypes) -> Symbolic:
    """A quotient; one of integers is rounded as the block says, and by 0 it is an end of its type.

    Raises ``NotLowered`` for a constant divisor of 0.
    """
    rules = types.rules(block)
    types.zeros.extend(zeros_of("./", one, other, rules))
    found = binary("./", one, other, replace(rules, outside=None))
    if found.kind not in INTEGERS:
        return found
    round_, (low, high) = rounding_of(block), INTEGERS[found.kind]
    places, size = _in_places([one, other])

    def divided(value: Expr, divisor: Fraction) -> Expr:
        if divisor:
            return round_(folded(value / divisor))
        return chosen(folded(value > 0), const(high), chosen(folded(value < 0), const(low), const(0)))

    exact = [by_cases(as_number(b), partial(divided, as_number(a))) for a, b in places]
    return matrix([SymbolicScalar(found.kind, in_range(e, found.kind, rules)) for e in exact], *size)


def _gain(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    value, factor = inputs[0], types.value_of(block.parameters.get("Gain", "1"))
    numbers, said = [one.constant for one in flat(factor)], _said(block)
    whole = all(one is not None and one.denominator == 1 for one in numbers)
    if value.kind not in INTEGERS:
        if value.kind in REALS or (value.kind == UNTYPED and whole):
            factor = each_converted(factor, value.kind, WRAPS, types.kinds)
        return [types.typed(block, binary(".*", value, factor, types.rules(block)))]
    if whole and said.startswith("Inherit"):
        return [binary(".*", value, factor, types.rules(block))]
    if "internal rule" in said:
        raise NotLowered(
            "an integer times a fraction is a fixed-point number: give the block an output type, as int32"
        )
    real, by = (each_converted(one, "double", WRAPS, types.kinds) for one in (value, factor))
    exact = binary(".*", real, by, WRAPS)
    return [types.rounded(block, exact, value.kind if said.startswith("Inherit") else types.kinds.kind(said))]


def _switch(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    criteria = block.parameters.get("Criteria", "u2 >= Threshold")
    threshold = types.value_of(block.parameters.get("Threshold", "0"))
    sign = ">=" if ">=" in criteria else ">" if ">" in criteria else "!="
    control = binary(sign, inputs[1], threshold if sign != "!=" else number("double", 0), WRAPS)
    first, _, third = inputs
    if not isinstance(first, SymbolicStructure):
        first, _, third = _operands(block, inputs, types)
    return [types.typed(block, either(single_of(control).expr, first, third, types.kinds))]


def either(condition: Expr, one: Symbolic, other: Symbolic, kinds: KindTable) -> Symbolic:
    """One of two values of one shape; the second takes the type of the first."""
    pairs = zip(leaves(one, ""), leaves(other, ""), strict=True)
    made = [
        SymbolicScalar(a.kind, chosen(condition, a.expr, converted(b, a.kind, WRAPS, kinds).expr))
        for (_, a), (_, b) in pairs
    ]
    return filled(one, iter(made))


def _conversion(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    text = block.parameters.get("OutDataTypeStr", "Inherit")
    if text.startswith("Inherit"):
        return [inputs[0]]
    return [types.rounded(block, inputs[0], types.kinds.kind(text))]


def _same(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    return [inputs[0]]


def _nothing(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    return []


def _selected(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    found = []
    for name in block.parameters.get("OutputSignals", "").split(","):
        value: Symbolic = inputs[0]
        for part in name.strip().split("."):
            if not isinstance(value, SymbolicStructure) or part not in value.elements:
                raise NotLowered(f"the bus has no element {name.strip()}")
            value = value.elements[part]
        found.append(value)
    return found


def _bus(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    kind = types.kinds.kind(block.parameters.get("OutDataTypeStr", ""))
    if not kind.startswith("Bus: "):
        raise NotLowered("a bus without a type: give the BusCreator one, Bus: NAME")
    bus = types.kinds.buses[kind.removeprefix("Bus: ")]
    made = {
        one.name: value
        if isinstance(value, SymbolicStructure)
        else each_converted(value, types.kinds.kind(one.type), WRAPS, types.kinds)
        for one, value in zip(bus.elements, inputs, strict=True)
    }
    return [SymbolicStructure(kind, made)]


def _mux(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    every = [one for value in inputs for one in flat(value)]
    return [matrix(every, 1, len(every))]


def _selected_elements(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    """The elements of a vector that a Selector names by their numbers."""
    if reason := selector_refused(block):
        raise NotLowered(reason)
    first = 0 if block.parameters.get("IndexMode") == "Zero-based" else 1
    every, made = flat(inputs[0]), list[SymbolicScalar]()
    for one in flat(types.value_of(block.parameters.get("Indices", "1"))):
        place = one.constant
        if place is None or place - first not in range(len(every)):
            raise NotLowered(f"it names an element that is not among the {len(every)} of its input")
        made.append(every[int(place) - first])
    return [matrix(made, *((1, len(made)) if size_of(inputs[0])[0] == 1 else (len(made), 1)))]


def _demux(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    return list(flat(inputs[0]))


def _extreme(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    join = least if block.parameters.get("Function", "min") == "min" else greatest
    inputs = flat(inputs[0]) if len(inputs) == 1 else _operands(block, inputs, types)

    def better(one: SymbolicScalar, other: SymbolicScalar) -> SymbolicScalar:
        kind = kind_of_both("+", one, other, WRAPS)
        return SymbolicScalar(kind, join(as_number(one), as_number(other)))

    places, size = _in_places(inputs)
    return [types.typed(block, matrix([reduce(better, place) for place in places], *size))]


def _saturated(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    low = as_number(single_of(types.value_of(block.parameters.get("LowerLimit", "-0.5"))))
    high = as_number(single_of(types.value_of(block.parameters.get("UpperLimit", "0.5"))))
    made = []
    for one in flat(inputs[0]):
        held = SymbolicScalar("double", least(greatest(as_number(one), low), high))
        made.append(converted(held, one.kind, IntegerRules(False, True), types.kinds))
    return [matrix(made, *size_of(inputs[0]))]


def _magnitude(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    rules, made = types.rules(block), []
    for one in flat(inputs[0]):
        if least_and_greatest(as_number(one))[0] >= 0:
            made.append(one)
            continue
        below = single_of(unary("-", one, rules))
        made.append(SymbolicScalar(one.kind, chosen(folded(as_number(one) < 0), below.expr, one.expr)))
    return [matrix(made, *size_of(inputs[0]))]


BLOCKS: Mapping[str, BlockFormula] = {
    "Constant": _constant, "Ground": lambda block, inputs, types: [number(UNTYPED, 0)], "Logic": _logic,
    "RelationalOperator": _relation, "CompareToConstant": _compared, "CompareToZero": _compared,
    "Sum": _sum, "Product": _product, "Gain": _gain, "Switch": _switch,
    "DataTypeConversion": _conversion, "BusSelector": _selected, "BusCreator": _bus, "Mux": _mux,
    "Demux": _demux, "Selector": _selected_elements, "MinMax": _extreme, "Saturate": _saturated,
    "Abs": _magnitude, "RateTransition": _same,
    "ZeroOrderHold": _same, "SignalConversion": _same, "SignalSpecification": _same, "Terminator": _nothing,
    "Scope": _nothing, "Display": _nothing, "ToWorkspace": _nothing,
}  # fmt: skip
"""What each kind of block gives; those with a memory are lowered elsewhere."""

__all__ = ["BLOCKS", "BlockTypes", "either"]
