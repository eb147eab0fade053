"""Lowering against the reference interpreter: the same valuation after every tick of random systems."""

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from spec_model.lang.evaluate import step
from spec_model.lang.interpret import Interpreter
from spec_model.lang.lower import lower
from tests.strategies import frozen_values, input_blocks, systems


@settings(max_examples=2000, suppress_health_check=list(HealthCheck))
@given(st.data())
def test_lowered_systems_step_as_the_interpreter_does(data: st.DataObject) -> None:
    system = data.draw(systems())
    frozen = data.draw(frozen_values(system))
    interpreter, lowered = Interpreter(system, frozen), lower(system)
    shared = interpreter.valuation().keys() & {v.name for v in lowered.variables}
    assert shared >= system.written.keys()
    at = {**lowered.init, **frozen}
    for number, inputs in enumerate(data.draw(input_blocks(system)), start=1):
        fired = interpreter.step(inputs)
        at = step(lowered, at, inputs)
        expected = interpreter.valuation()
        assert {n: at[n] for n in shared} == {n: expected[n] for n in shared}, (number, fired)
        assert not any(at[check.name] for check, _ in lowered.checks)
