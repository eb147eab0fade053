"""What the blocks of a diagram compute from their inputs in a step, as formulas."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

from rovercheck.checker.drawn.lower.arithmetic import binary, scalar_of, unary
from rovercheck.checker.drawn.lower.builtins import greatest, least
from rovercheck.checker.drawn.lower.conversions import (
    IntegerRules,
    as_condition,
    as_number,
    converted,
    each_converted,
    in_range,
)
from rovercheck.checker.drawn.lower.kinds import KindTable
from rovercheck.checker.drawn.lower.rounding import ceiling_of, floor_of, nearest_of, toward_zero
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    SymbolicStructure,
    chosen,
    filled,
    flat,
    folded,
    leaves,
    matrix,
    number,
    single_of,
    size_of,
    truth,
)
from rovercheck.checker.drawn.records import DrawnBlock
from rovercheck.spec_model.lang.expr import Expr, all_of, any_of

Inputs = Sequence[Symbolic]
ROUNDINGS: Mapping[str, Callable[[Expr], Expr]] = {
    "Floor": floor_of, "Ceiling": ceiling_of, "Zero": toward_zero, "Nearest": nearest_of, "Round": nearest_of
}  # fmt: skip


@dataclass(frozen=True)
class BlockTypes:
    """What a block needs beside its inputs: the types of the model, and the values of its parameters."""

    kinds: KindTable
    value_of: Callable[[str], Symbolic]

    def rules(self, block: DrawnBlock) -> IntegerRules:
        """Whether the integers of a block stop at their ends; they wrap unless it says so."""
        return IntegerRules(False, block.parameters.get("SaturateOnIntegerOverflow") == "on")

    def typed(self, block: DrawnBlock, value: Symbolic) -> Symbolic:
        """A value in the type that a block says, if it says one."""
        text = block.parameters.get("OutDataTypeStr", "Inherit")
        kind = "" if text.startswith(("Inherit", "Bus")) else self.kinds.kind(text)
        return each_converted(value, kind, self.rules(block), self.kinds) if kind else value


BlockFormula = Callable[[DrawnBlock, Inputs, BlockTypes], list[Symbolic]]
WRAPS = IntegerRules(False, False)


def _constant(block: DrawnBlock, _: Inputs, types: BlockTypes) -> list[Symbolic]:
    return [types.typed(block, types.value_of(block.parameters.get("Value", "1")))]


def _logic(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    operator = block.parameters.get("Operator", "AND")
    every = [as_condition(one) for value in inputs for one in flat(value)]
    ways: Mapping[str, Callable[[], Expr]] = {
        "AND": lambda: all_of(*every), "OR": lambda: any_of(*every), "NOT": lambda: ~every[0],
        "NAND": lambda: ~all_of(*every), "NOR": lambda: ~any_of(*every),
        "XOR": lambda: reduce(_either, every), "NXOR": lambda: ~reduce(_either, every),
    }  # fmt: skip
    if operator not in ways:
        raise NotLowered(f"the operator {operator} of a Logic block")
    return [truth(folded(ways[operator]()))]


def _either(one: Expr, other: Expr) -> Expr:
    return folded(any_of(all_of(one, ~other), all_of(~one, other)))


def _relation(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    sign = block.parameters.get("Operator", "<=").replace("~=", "!=")
    return [binary(sign, inputs[0], inputs[1], WRAPS)]


def _signs(text: str, sign: str) -> str:
    """The signs of inputs: as written, or as many as there are."""
    plain = text.replace("|", "").strip()
    return sign * int(plain) if plain.isdigit() else plain


def _sum(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    signs, rules = _signs(block.parameters.get("Inputs", "++"), "+"), types.rules(block)
    first = inputs[0] if signs[0] == "+" else unary("-", inputs[0], rules)
    for sign, value in zip(signs[1:], inputs[1:], strict=True):
        first = binary(sign, first, value, rules)
    return [types.typed(block, first)]


def _product(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    signs, rules = _signs(block.parameters.get("Inputs", "2"), "*"), types.rules(block)
    first = inputs[0] if signs[0] == "*" else binary("./", number("double", 1), inputs[0], rules)
    for sign, value in zip(signs[1:], inputs[1:], strict=True):
        first = binary(f".{sign}", first, value, rules)
    return [types.typed(block, first)]


def _gain(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    factor = types.value_of(block.parameters.get("Gain", "1"))
    return [types.typed(block, binary(".*", inputs[0], factor, types.rules(block)))]


def _switch(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    criteria = block.parameters.get("Criteria", "u2 >= Threshold")
    threshold = types.value_of(block.parameters.get("Threshold", "0"))
    sign = ">=" if ">=" in criteria else ">" if ">" in criteria else "!="
    control = binary(sign, inputs[1], threshold if sign != "!=" else number("double", 0), WRAPS)
    return [types.typed(block, either(single_of(control).expr, inputs[0], inputs[2], types.kinds))]


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
    kind, rounding = types.kinds.kind(text), block.parameters.get("RndMeth", "Floor")
    if kind not in INTEGERS:
        return [each_converted(inputs[0], kind, types.rules(block), types.kinds)]
    if rounding not in ROUNDINGS:
        raise NotLowered(f"the rounding {rounding}: Floor, Ceiling, Zero, Nearest or Round are known")
    saturates = types.rules(block).saturates
    made = (
        SymbolicScalar(kind, in_range(ROUNDINGS[rounding](as_number(one)), kind, saturates))
        for one in flat(inputs[0])
    )
    return [matrix(list(made), *size_of(inputs[0]))]


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


def _demux(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    return list(flat(inputs[0]))


def _extreme(block: DrawnBlock, inputs: Inputs, types: BlockTypes) -> list[Symbolic]:
    join = least if block.parameters.get("Function", "min") == "min" else greatest
    every = [one for value in inputs for one in flat(value)]

    def better(one: SymbolicScalar, other: SymbolicScalar) -> SymbolicScalar:
        kind = scalar_of("+", one, other, WRAPS).kind
        return SymbolicScalar(kind, join(as_number(one), as_number(other)))

    return [types.typed(block, reduce(better, every))]


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
        below = single_of(unary("-", one, rules))
        made.append(SymbolicScalar(one.kind, chosen(folded(as_number(one) < 0), below.expr, one.expr)))
    return [matrix(made, *size_of(inputs[0]))]


BLOCKS: Mapping[str, BlockFormula] = {
    "Constant": _constant, "Ground": lambda block, inputs, types: [number("double", 0)], "Logic": _logic,
    "RelationalOperator": _relation, "Sum": _sum, "Product": _product, "Gain": _gain, "Switch": _switch,
    "DataTypeConversion": _conversion, "BusSelector": _selected, "BusCreator": _bus, "Mux": _mux,
    "Demux": _demux, "MinMax": _extreme, "Saturate": _saturated, "Abs": _magnitude, "RateTransition": _same,
    "ZeroOrderHold": _same, "SignalConversion": _same, "SignalSpecification": _same, "Terminator": _nothing,
    "Scope": _nothing, "Display": _nothing, "ToWorkspace": _nothing,
}  # fmt: skip
"""What each kind of block gives; those with a memory are lowered elsewhere."""

__all__ = ["BLOCKS", "BlockTypes", "either"]
