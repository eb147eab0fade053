"""What the blocks of a diagram compute from their inputs in a step."""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import reduce

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, Expression
from rovercheck.checker.drawn.interpret.functions import BUILTINS
from rovercheck.checker.drawn.interpret.memory import BUS, TypeTable
from rovercheck.checker.drawn.interpret.operations import binary, unary
from rovercheck.checker.drawn.interpret.values import (
    ArrayOf,
    MatlabValue,
    NumberRules,
    Scalar,
    Structure,
    array,
    double,
    each_converted,
    logical,
    scalar,
    scalars,
    shape,
)
from rovercheck.checker.drawn.records import DrawnBlock

Inputs = Sequence[MatlabValue]
ValueOf = Callable[[str], MatlabValue]
"""The value of an expression of MATLAB in a parameter of a block."""
BlockStep = Callable[[DrawnBlock, Inputs, TypeTable, ValueOf], list[MatlabValue]]
WRAPS = NumberRules(False, False)
SATURATES = NumberRules(False, True)


def rules_of(block: DrawnBlock) -> NumberRules:
    """Whether the integers of a block stop at their ends."""
    return SATURATES if block.parameters.get("SaturateOnIntegerOverflow") == "on" else WRAPS


def typed(block: DrawnBlock, value: MatlabValue, types: TypeTable) -> MatlabValue:
    """A value in the type that a block says, if it says one."""
    text = block.parameters.get("OutDataTypeStr", "Inherit")
    kind = "" if text.startswith(("Inherit", "Bus")) else types.kind(text)
    return each_converted(value, kind, rules_of(block)) if kind else value


def _constant(block: DrawnBlock, _: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    return [typed(block, value_of(block.parameters.get("Value", "1")), types)]


def _ground(block: DrawnBlock, _: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    return [double(0)]


def _logic(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    operator = block.parameters.get("Operator", "AND")
    truths = [one.truth for value in inputs for one in scalars(value)]
    ways: Mapping[str, Callable[[Sequence[bool]], bool]] = {
        "AND": all, "OR": any, "NOT": lambda some: not some[0], "NAND": lambda some: not all(some),
        "NOR": lambda some: not any(some), "XOR": lambda some: sum(some) % 2 == 1,
        "NXOR": lambda some: sum(some) % 2 == 0,
    }  # fmt: skip
    if operator not in ways:
        raise DrawnFault(f"the operator {operator} of a Logic block is not known")
    return [logical(ways[operator](truths))]


def _relation(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    sign = block.parameters.get("Operator", "<=").replace("~=", "!=")
    return [binary(sign, inputs[0], inputs[1], WRAPS)]


def _sum(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    signs = _signs(block.parameters.get("Inputs", "++"), "+")
    rules = rules_of(block)
    first = inputs[0] if signs[0] == "+" else unary("-", inputs[0], rules)
    pairs = zip(signs[1:], inputs[1:], strict=True)
    return [
        typed(block, reduce(lambda sofar, one: binary(one[0], sofar, one[1], rules), pairs, first), types)
    ]


def _product(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    signs = _signs(block.parameters.get("Inputs", "2"), "*")
    rules = rules_of(block)
    first = inputs[0] if signs[0] == "*" else binary("./", double(1), inputs[0], rules)
    pairs = zip(signs[1:], inputs[1:], strict=True)
    found = reduce(lambda sofar, one: binary(f".{one[0]}", sofar, one[1], rules), pairs, first)
    return [typed(block, found, types)]


def _signs(text: str, sign: str) -> str:
    """The signs of inputs: as written, or as many as there are."""
    plain = text.replace("|", "").strip()
    return sign * int(plain) if plain.isdigit() else plain


def _gain(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    factor = value_of(block.parameters.get("Gain", "1"))
    return [typed(block, binary(".*", inputs[0], factor, rules_of(block)), types)]


def _switch(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    criteria = block.parameters.get("Criteria", "u2 >= Threshold")
    threshold = value_of(block.parameters.get("Threshold", "0"))
    sign = ">=" if ">=" in criteria else ">" if ">" in criteria else "!="
    control = binary(sign, inputs[1], threshold if sign != "!=" else double(0), WRAPS)
    assert not isinstance(control, Structure)
    return [typed(block, inputs[0] if control.truth else inputs[2], types)]


def _conversion(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    text = block.parameters.get("OutDataTypeStr", "Inherit")
    if text.startswith("Inherit"):
        return [inputs[0]]
    kind, rounding = types.kind(text), block.parameters.get("RndMeth", "Floor")
    if kind.endswith(("int8", "int16", "int32", "int64")):
        ways = {"Floor": "floor", "Ceiling": "ceil", "Zero": "fix", "Nearest": "round", "Round": "round"}
        if rounding not in ways:
            raise DrawnFault(f"the rounding {rounding} is not known: Floor, Ceiling, Zero, Nearest or Round")
        return [each_converted(BUILTINS[ways[rounding]]([inputs[0]], WRAPS), kind, rules_of(block))]
    return [each_converted(inputs[0], kind, rules_of(block))]


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


def _demux(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    return list(scalars(inputs[0]))


def _extreme(block: DrawnBlock, inputs: Inputs, types: TypeTable, value_of: ValueOf) -> list[MatlabValue]:
    sign = "<" if block.parameters.get("Function", "min") == "min" else ">"
    every = [one for value in inputs for one in scalars(value)]

    def better(one: Scalar, other: Scalar) -> Scalar:
        return other if scalar(binary(sign, other, one, WRAPS)).truth else one

    return [typed(block, reduce(better, every), types)]


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
    "Product": _product, "Gain": _gain, "Switch": _switch, "DataTypeConversion": _conversion,
    "BusSelector": _selected, "BusCreator": _bus, "Mux": _mux, "Demux": _demux, "MinMax": _extreme,
    "Saturate": _saturated, "Abs": _magnitude, "RateTransition": _same, "ZeroOrderHold": _same,
    "SignalConversion": _same, "SignalSpecification": _same, "Terminator": _nothing, "Scope": _nothing,
    "Display": _nothing, "ToWorkspace": _nothing,
}  # fmt: skip
"""What each kind of block gives; those with a memory are executed elsewhere."""

_NAME = re.compile(r"[A-Za-z]\w*")


def parameter(text: str, named: Mapping[str, str]) -> str:
    """A parameter with its name, if it is one, replaced by its value as written."""
    return named.get(text.strip(), text) if _NAME.fullmatch(text.strip()) else text


def parsed_value(text: str) -> Expression:
    """The tree of a parameter.  Raises ``DrawnFault``."""
    try:
        return parse_expression(text, ActionLanguage.MATLAB)
    except GrammarError as error:
        raise DrawnFault(f"the parameter {text!r}: {error}") from error


__all__ = ["BLOCKS", "BlockStep", "parameter", "parsed_value", "typed"]
