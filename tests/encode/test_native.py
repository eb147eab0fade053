"""Native code for formulas, and packing, against the reference semantics."""

import ctypes
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from llvmlite import ir

from rovercheck.checker.encode.native import OutsideDomain, TooWide, layout
from rovercheck.checker.encode.native.expressions import BIT, INT, Expressions, Slot
from rovercheck.checker.encode.native.jit import NativeLibrary
from rovercheck.checker.encode.native.table import WORDS, function
from rovercheck.checker.system.intervals import Interval
from rovercheck.spec_model.lang.domain import Bool, Num, chosen, integer
from rovercheck.spec_model.lang.evaluate import evaluate, operate
from rovercheck.spec_model.lang.expr import Apply, Expr, Var, flag, var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.walk import variables
from tests.strategies_ts import MODE, booleans, integers, number

SCOPE = (
    flag("p"),
    flag("q"),
    var("a", integer(-9, 9)),
    var("b", integer(0, 7)),
    var("c", chosen([-70, 3, 400])),
    var("m", MODE),
)


def compiled(expr: Expr) -> Callable[[dict[str, int]], int]:
    """The formula as a native function of a state of its variables."""
    used = list(variables(expr).values())
    module = ir.Module("formula")
    _, a, build = function(module, "formula", INT, {"at": WORDS})
    slots = {}
    for i, v in enumerate(used):
        raw = build.load(build.gep(a["at"], [INT(i)]))
        code = build.trunc(raw, BIT) if isinstance(v.sort, Bool) else raw
        place = build.alloca(code.type)
        build.store(code, place)
        slots[v.name] = Slot(place, Interval(v.domain.low, v.domain.high))
    emit = Expressions(build, slots)
    build.ret(emit.as_int(emit.value(expr)))
    library = NativeLibrary.of(module)
    call = library.function("formula", ctypes.c_int64, [ctypes.c_void_p])

    def run(at: dict[str, int]) -> int:
        values = np.array([at[v.name] for v in used] or [0], dtype=np.int64)
        return int(call(values.ctypes.data)) + 0 * id(library)

    return run


def points(used: Sequence[Var]) -> list[dict[str, int]]:
    """States that meet the ends of every domain and what lies between."""
    longest = max([len(v.domain) for v in used], default=1)
    return [
        {v.name: v.domain.values[(i * (k + 1)) % len(v.domain)] for k, v in enumerate(used)}
        for i in range(7 * longest)
    ]


BINARY = {*COMPARISONS, Op.ADD, Op.SUB, Op.MUL, Op.MIN, Op.MAX}


@pytest.mark.parametrize("op", sorted(BINARY))
def test_a_binary_operator(op: Op) -> None:
    a, b = var("a", integer(-9, 9)), var("b", integer(-5, 12))
    run = compiled(Apply(op, (a, b), Bool() if op in COMPARISONS else Num()))
    for x in a.domain.values:
        for y in b.domain.values:
            assert run({"a": x, "b": y}) == operate(op, x, y)


@pytest.mark.parametrize("op", [Op.DIV, Op.MOD, Op.SCALE])
@pytest.mark.parametrize("by", [1, 2, 3, 7, 8, 20])
def test_rounding_down_by_a_constant(op: Op, by: int) -> None:
    for low, high in ((-50, 50), (0, 50), (-50, -20)):
        a = var("a", integer(low, high))
        run = compiled(Apply(op, (a, number(by)), Num()))
        assert all(run({"a": x}) == operate(op, x, by) for x in a.domain.values)


@pytest.mark.parametrize("op", [Op.NEG, Op.ABS])
def test_a_unary_operator(op: Op) -> None:
    a = var("a", integer(-9, 9))
    run = compiled(Apply(op, (a,), Num()))
    assert all(run({"a": x}) == operate(op, x) for x in a.domain.values)


@pytest.mark.parametrize("index", [0, 3, 5, 62, 63, 70])
def test_a_bit(index: int) -> None:
    a = var("a", integer(0, 60))
    run = compiled(Apply(Op.BIT, (a, number(index)), Bool()))
    assert all(run({"a": x}) == operate(Op.BIT, x, index) for x in a.domain.values)


@st.composite
def expressions(draw: st.DrawFn) -> Expr:
    make = draw(st.sampled_from([integers, booleans]))
    return make(draw, SCOPE, 4)


@given(st.data())
def test_random_formulas(data: st.DataObject) -> None:
    expr = data.draw(expressions())
    run = compiled(expr)
    for at in points(list(variables(expr).values())):
        assert run(at) == evaluate(expr, at)


def test_a_formula_that_may_leave_64_bits_is_refused() -> None:
    a = var("a", integer(0, 1 << 40))
    with pytest.raises(TooWide):
        compiled(Apply(Op.MUL, (a, a), Num()))


@given(st.lists(st.sampled_from([*SCOPE, var("z", integer(-(1 << 50), 1 << 50))]), unique_by=id), st.data())
def test_packing_is_invertible(used: list[Var], data: st.DataObject) -> None:
    packing = layout(used)
    at = {v.name: data.draw(st.sampled_from([v.domain.low, v.domain.high])) for v in used}
    words = packing.pack(at)
    assert packing.unpack(words) == at
    assert all(0 <= word < 1 << 63 for word in words)


def test_no_value_is_truncated_by_packing() -> None:
    with pytest.raises(OutsideDomain, match="a becomes 10"):
        layout(SCOPE).pack({"p": 0, "q": 0, "a": 10, "b": 0, "c": 3, "m": 2})
