"""What the blocks of a diagram compute from their inputs in a step."""

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from math import ceil, floor, isfinite, trunc

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, Expression
from rovercheck.checker.drawn.interpret.memory import BUS, TypeTable
from rovercheck.checker.drawn.interpret.operations import binary, unary
from rovercheck.checker.drawn.interpret.values import (
    FLOATS,
    LITERAL,
    WHOLE,
    ArrayOf,
    MatlabValue,
    NumberRules,
    Scalar,
    Structure,
    array,
    double,
    each_converted,
    in_range,
    logical,
    scalar,
    scalars,
    shape,
)
from rovercheck.checker.drawn.records import DrawnBlock
from rovercheck.checker.drawn.refused import selector_refused

Inputs = Sequence[MatlabValue]
ValueOf = Callable[[str], MatlabValue]
"""The value of an expression of MATLAB in a parameter of a block."""
BlockStep = Callable[[DrawnBlock, Inputs, TypeTable, ValueOf], list[MatlabValue]]
WRAPS = NumberRules(False, False)
SATURATES = NumberRules(False, True)
ROUNDINGS: Mapping[str, Callable[[Fraction], int]] = {
    "Floor": floor, "Ceiling": ceil, "Zero": trunc, "Nearest": lambda one: floor(one + Fraction(1, 2)),
    "Round": lambda one: floor(abs(one) + Fraction(1, 2)) * (1 if one > 0 else -1),
}  # fmt: skip
"""How a block rounds; of two whole numbers that are as near, Nearest takes the greater one."""
SAY_TYPE = "give the block an output type, as int32 or double"


def rules_of(block: DrawnBlock) -> NumberRules:
    """Whether the integers of a block stop at their ends."""
    return SATURATES if block.parameters.get("SaturateOnIntegerOverflow") == "on" else WRAPS


def typed(block: DrawnBlock, value: MatlabValue, types: TypeTable) -> MatlabValue:
    """A value in the type that a block says, if it says one."""
    text = block.parameters.get("OutDataTypeStr", "Inherit")
    kind = "" if text.startswith(("Inherit", "Bus")) else types.kind(text)
    return as_said(block, value, kind) if kind else value


def as_said(block: DrawnBlock, value: MatlabValue, kind: str) -> MatlabValue:
    """A value in a type, rounded as the block says: down if it says nothing."""
    if kind not in WHOLE or isinstance(value, Structure):
        return each_converted(value, kind, rules_of(block))
    return array([_in_integers(block, one, kind) for one in scalars(value)], *shape(value), kind)


def _in_integers(block: DrawnBlock, one: Scalar, kind: str) -> Scalar:
    if not isfinite(one.value):
        return scalar(each_converted(one, kind, rules_of(block)))
    return _rounded(block, Fraction(one.value), kind)


def _rounded(block: DrawnBlock, exact: Fraction, kind: str) -> Scalar:
    way = block.parameters.get("RndMeth", "Floor")
    if way not in ROUNDINGS:
        raise DrawnFault(f"the rounding {way} is not known: {', '.join(ROUNDINGS)} are")
    return Scalar(kind, in_range(ROUNDINGS[way](exact), kind, rules_of(block).saturates))


def _together(block: DrawnBlock, inputs: Inputs) -> Inputs:
    """What is computed with: integers are real numbers beside one, and where a type is said."""
    kinds = {one.kind for one in inputs}
    said = kinds & {"int64", "uint64"} or block.parameters.get("OutDataTypeStr", "Inherit").startswith("Inh")
    real = next((kind for kind in FLOATS if kind in kinds), "" if said else "double")
    return [each_converted(one, real, WRAPS) if real and one.kind in WHOLE else one for one in inputs]


def _beside(inputs: Inputs) -> tuple[list[tuple[Scalar, ...]], tuple[int, int]]:
    """The scalars of inputs that are of one place, of which one may be a scalar for all, and their size."""
    sizes = {shape(one) for one in inputs} - {(1, 1)} or {(1, 1)}
    if len(sizes) > 1:
        told = " and ".join(f"{rows}x{columns}" for rows, columns in sorted(sizes))
        raise DrawnFault(f"its inputs are matrices of {told}")
    [(rows, columns)] = sizes
    count = rows * columns
    every = [tuple(scalars(one)) * (count if shape(one) == (1, 1) else 1) for one in inputs]
    return list(zip(*every, strict=True)), (rows, columns)


def _constant(block: DrawnBlock, _: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    text, value = block.parameters.get("OutDataTypeStr", "Inherit"), block.parameters.get("Value", "1")
    kind = "" if text.startswith(("Inherit", "Bus")) else types.kind(text)
    return [each_converted(value_of(value), kind, rules_of(block)) if kind else value_of(value)]


def _ground(block: DrawnBlock, _: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    """0 in the type of what it is computed with."""
    return [Scalar(LITERAL, 0)]


def _logic(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    operator = block.parameters.get("Operator", "AND")
    ways: Mapping[str, Callable[[Sequence[bool]], bool]] = {
        "AND": all, "OR": any, "NOT": lambda some: not some[0], "NAND": lambda some: not all(some),
        "NOR": lambda some: not any(some), "XOR": lambda some: sum(some) % 2 == 1,
        "NXOR": lambda some: sum(some) % 2 == 0,
    }  # fmt: skip
    if operator not in ways:
        raise DrawnFault(f"the operator {operator} of a Logic block is not known")
    if len(inputs) == 1 and operator != "NOT":
        return [typed(block, logical(ways[operator]([one.truth for one in scalars(inputs[0])])), types)]
    places, size = _beside(inputs)
    return [
        typed(block, array([logical(ways[operator]([o.truth for o in p])) for p in places], *size), types)
    ]


def _relation(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    sign = block.parameters.get("Operator", "<=").replace("~=", "!=")
    return [binary(sign, inputs[0], inputs[1], WRAPS)]


def _compared(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    """A comparison with a constant, which has the type of the input."""
    written = block.parameters.get("const", "3.0") if block.kind == "CompareToConstant" else "0"
    constant, kind = value_of(written), inputs[0].kind
    if kind in WHOLE or kind in FLOATS:
        found = each_converted(constant, kind, SATURATES)
        if kind in WHOLE and [v.value for v in scalars(found)] != [v.value for v in scalars(constant)]:
            raise DrawnFault(f"it compares {kind} with {written}: write a number of that type")
        constant = found
    sign = block.parameters.get("relop", "<=").replace("~=", "!=")
    return [typed(block, binary(sign, inputs[0], constant, WRAPS), types)]


def _sum(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    signs, rules = _signs(block.parameters.get("Inputs", "++"), "+"), rules_of(block)
    inputs = scalars(inputs[0]) if len(inputs) == 1 else _together(block, inputs)
    signs = signs * len(inputs) if len(signs) == 1 else signs
    first = inputs[0] if signs[0] == "+" else unary("-", inputs[0], rules)
    pairs = zip(signs[1:], inputs[1:], strict=True)
    return [
        typed(block, reduce(lambda sofar, one: binary(one[0], sofar, one[1], rules), pairs, first), types)
    ]


def _product(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    signs, rules = _signs(block.parameters.get("Inputs", "2"), "*"), rules_of(block)
    inputs = scalars(inputs[0]) if len(inputs) == 1 else _together(block, inputs)
    signs = signs * len(inputs) if len(signs) == 1 else signs
    found = inputs[0] if signs[0] == "*" else _quotient(block, double(1), inputs[0])
    for sign, one in zip(signs[1:], inputs[1:], strict=True):
        found = _quotient(block, found, one) if sign == "/" else binary(".*", found, one, rules)
    return [typed(block, found, types)]


def _quotient(block: DrawnBlock, one: MatlabValue, other: MatlabValue) -> MatlabValue:
    """A quotient; one of integers is rounded as the block says."""
    found = binary("./", one, other, rules_of(block))
    if found.kind not in WHOLE:
        return found
    places, size = _beside([found, one, other])
    made = [f if b.value == 0 else _rounded(block, Fraction(a.value) / Fraction(b.value), f.kind)
            for f, a, b in places]  # fmt: skip
    return array(made, *size)


def _signs(text: str, sign: str) -> str:
    """The signs of inputs: as written, or as many as there are."""
    plain = text.replace("|", "").strip()
    return sign * int(plain) if plain.isdigit() else plain


def _gain(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    value, factor = inputs[0], value_of(block.parameters.get("Gain", "1"))
    if value.kind in FLOATS or (value.kind == LITERAL and _is_whole(factor)):
        factor = each_converted(factor, value.kind, WRAPS)
    said = block.parameters.get("OutDataTypeStr", "Inherit: Inherit via internal rule")
    whole = _is_whole(factor)
    if value.kind in WHOLE and not whole and "internal rule" in said:
        raise DrawnFault(f"an integer times a fraction is a fixed-point number: {SAY_TYPE}")
    if value.kind not in WHOLE or (whole and said.startswith("Inherit")):
        return [typed(block, binary(".*", value, factor, rules_of(block)), types)]
    real, by = (each_converted(one, "double", WRAPS) for one in (value, factor))
    exact = binary(".*", real, by, WRAPS)
    return [as_said(block, exact, value.kind if said.startswith("Inherit") else types.kind(said))]


def _is_whole(value: MatlabValue) -> bool:
    return all(one.value == int(one.value) for one in scalars(value))


def _switch(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    criteria = block.parameters.get("Criteria", "u2 >= Threshold")
    threshold = value_of(block.parameters.get("Threshold", "0"))
    sign = ">=" if ">=" in criteria else ">" if ">" in criteria else "!="
    control = binary(sign, inputs[1], threshold if sign != "!=" else double(0), WRAPS)
    first, _, third = inputs if any(isinstance(v, Structure) for v in inputs) else _together(block, inputs)
    return [typed(block, first if scalar(control).truth else third, types)]


def _conversion(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    text = block.parameters.get("OutDataTypeStr", "Inherit")
    if text.startswith("Inherit"):
        return [inputs[0]]
    return [as_said(block, inputs[0], types.kind(text))]


def _same(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    return [inputs[0]]


def _nothing(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    return []


def _selected(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    found = []
    for name in block.parameters.get("OutputSignals", "").split(","):
        value: MatlabValue = inputs[0]
        for part in name.strip().split("."):
            if not isinstance(value, Structure) or part not in value.elements:
                raise DrawnFault(f"the bus has no element {name.strip()}")
            value = value.elements[part]
        found.append(value)
    return found


def _bus(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    text = block.parameters.get("OutDataTypeStr", "")
    if not text.startswith(BUS):
        raise DrawnFault("a bus without a type: give the BusCreator one, Bus: NAME")
    bus = types.buses[types.kind(text).removeprefix(BUS).strip()]
    pairs = zip(bus.elements, inputs, strict=True)
    made = {one.name: each_converted(value, types.kind(one.type), WRAPS) for one, value in pairs}
    return [Structure(types.kind(text), made)]


def _mux(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    every = [one for value in inputs for one in scalars(value)]
    return [array(every, 1, len(every))]


def _selected_elements(
    block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf
) -> list[MatlabValue]:
    """The elements of a vector that a Selector names by their numbers."""
    if reason := selector_refused(block):
        raise DrawnFault(reason)
    first = 0 if block.parameters.get("IndexMode") == "Zero-based" else 1
    every = scalars(inputs[0])
    places = [one.value - first for one in scalars(value_of(block.parameters.get("Indices", "1")))]
    if not all(place in range(len(every)) for place in places):
        raise DrawnFault(f"it names an element that is not among the {len(every)} of its input")
    made = [every[int(place)] for place in places]
    return [array(made, *((1, len(made)) if shape(inputs[0])[0] == 1 else (len(made), 1)))]


def _demux(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    return list(scalars(inputs[0]))


def _extreme(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    sign = "<" if block.parameters.get("Function", "min") == "min" else ">"
    inputs = scalars(inputs[0]) if len(inputs) == 1 else _together(block, inputs)

    def better(one: Scalar, other: Scalar) -> Scalar:
        return other if scalar(binary(sign, other, one, WRAPS)).truth else one

    places, size = _beside(inputs)
    return [typed(block, array([reduce(better, place) for place in places], *size), types)]


def _saturated(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    low = scalar(value_of(block.parameters.get("LowerLimit", "-0.5")))
    high = scalar(value_of(block.parameters.get("UpperLimit", "0.5")))
    made = [_between(one, low, high) for one in scalars(inputs[0])]
    return [array(made, *shape(inputs[0])) if isinstance(inputs[0], ArrayOf) else made[0]]


def _between(one: Scalar, low: Scalar, high: Scalar) -> Scalar:
    end = low if one.value < low.value else high if one.value > high.value else one
    found = each_converted(end, one.kind, SATURATES)
    assert isinstance(found, Scalar)
    return found


def _magnitude(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    rules = rules_of(block)
    made = [unary("-", one, rules) if one.value < 0 else one for one in scalars(inputs[0])]
    return [array([scalar(one) for one in made], *shape(inputs[0]))]


BLOCKS: Mapping[str, BlockStep] = {
    "Constant": _constant, "Ground": _ground, "Logic": _logic, "RelationalOperator": _relation, "Sum": _sum,
    "CompareToConstant": _compared, "CompareToZero": _compared,
    "Product": _product, "Gain": _gain, "Switch": _switch, "DataTypeConversion": _conversion,
    "BusSelector": _selected, "BusCreator": _bus, "Mux": _mux, "Demux": _demux,
    "Selector": _selected_elements, "MinMax": _extreme,
    "Saturate": _saturated, "Abs": _magnitude, "RateTransition": _same, "ZeroOrderHold": _same,
    "SignalConversion": _same, "SignalSpecification": _same, "Terminator": _nothing, "Scope": _nothing,
    "Display": _nothing, "ToWorkspace": _nothing,
}  # fmt: skip
"""What each kind of block gives; those with a memory are executed elsewhere."""


def parsed_value(text: str) -> Expression:
    """The tree of a parameter.  Raises ``DrawnFault``."""
    try:
        return parse_expression(text, ActionLanguage.MATLAB)
    except GrammarError as error:
        raise DrawnFault(f"the parameter {text!r}: {error}") from error


__all__ = ["BLOCKS", "BlockStep", "parsed_value", "typed"]
