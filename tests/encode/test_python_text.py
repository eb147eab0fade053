"""Formulas as Python text mean what the reference evaluation says."""

from hypothesis import given
from hypothesis import strategies as st
from hypothesis.strategies import DataObject

from rovercheck.checker.encode.python_text import text_of
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Var, flag, var
from tests.strategies_ts import booleans, integers

SCOPE: tuple[Var, ...] = (
    flag("on"),
    flag("off"),
    var("low", integer(-4, 4)),
    var("many", integer(0, 9)),
    var("gaps", chosen([-7, 0, 30])),
)


@given(st.data())
def test_by_definition(data: DataObject) -> None:
    expr = data.draw(st.composite(lambda draw: booleans(draw, SCOPE, 4))() | _numbers)
    at = {v.name: data.draw(st.sampled_from(list(v.domain.values))) for v in SCOPE}
    assert eval(text_of(expr, lambda read: f"at[{read.name!r}]"), {"at": at}) == evaluate(expr, at)


_numbers = st.composite(lambda draw: integers(draw, SCOPE, 4))()
