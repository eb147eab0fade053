"""No result of an operator lies outside the interval that lowering expects, however wide its arguments."""

from hypothesis import given
from hypothesis import strategies as st
from hypothesis.strategies import DataObject

from rovercheck.spec_model.lang.evaluate import operate
from rovercheck.spec_model.lang.lower.ranges import OPERATIONS
from rovercheck.spec_model.lang.operators import Op
from tests.profiles import examples

BIT, WIDE, FROM_1 = (0, 1), (-5000, 5000), (1, 400)
ARGUMENTS: dict[Op, tuple[tuple[int, int], ...]] = {
    Op.NOT: (BIT,), Op.AND: (BIT, BIT), Op.OR: (BIT, BIT), Op.ITE: (BIT, WIDE, WIDE),
    Op.NEG: (WIDE,), Op.ABS: (WIDE,), Op.SCALE: (WIDE, FROM_1), Op.DIV: (WIDE, FROM_1),
    Op.MOD: (WIDE, FROM_1), Op.BIT: ((0, 5000), (0, 12)),
}  # fmt: skip
"""What the arguments of an operator may be; of those that are not named, any two numbers."""


def arguments(op: Op) -> tuple[tuple[int, int], ...]:
    return ARGUMENTS.get(op, (WIDE, WIDE))


@examples(400)
@given(st.sampled_from(list(Op)), st.data())
def test_results_lie_within_the_interval(op: Op, data: DataObject) -> None:
    ends, values = [], []
    for low, high in arguments(op):
        pair = sorted(data.draw(st.tuples(st.integers(low, high), st.integers(low, high))))
        ends.append((pair[0], pair[1]))
        values.append(data.draw(st.integers(*pair)))
    if op in (Op.SCALE, Op.DIV, Op.MOD):  # by a constant
        ends[1] = (values[1], values[1])
    low, high = OPERATIONS[op](op, ends)
    assert low <= operate(op, *values) <= high


@given(st.integers(1, 9))
def test_an_interval_that_is_too_small_would_be_seen(below: int) -> None:
    """ABS with the row of an operator that takes its extremes at the ends: its least value lies outside."""
    low, _ = OPERATIONS[Op.NEG](Op.ABS, [(-below, below)])
    assert low > operate(Op.ABS, 0)
