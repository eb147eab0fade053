"""A limit of a counter that the charts keep at this limit: firmware with another one counts on."""

import pytest

from rovercheck.checker.diagnosis.limits import NumberSlot, number_slots
from rovercheck.checker.diagnosis.variant import WrittenChange, found_change
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System, in_order

BOARD2 = boards()["board2"]
GAPS = {"coherence_wheel_gap", "coherence_imu_gap"}


def slot_of_both() -> NumberSlot:
    """The number 4 with which the gaps of wheels and IMU are compared."""
    slots = number_slots(BOARD2.system, frozenset({"Coherence.rotation"}))
    return next(s for s in slots if GAPS == {str(one) for one in (s.left, *s.beside)})


def added(system: System, gap: int) -> bool:
    """Whether the wheels add to the rotation after so many steps without new data."""
    names = ("Coherence.rotation", "Coherence.stamps")
    every = {part.name: part for part in parts(system.components)}
    run = Interpreter(in_order("gaps", *(every[name] for name in names)))
    given = {name: int(var.init) for name, var in run.system.inputs.items()}
    wheel = next(name for name in given if name.endswith("wheel_speed_rpm_FL"))
    fast = run.system.inputs[wheel].domain.high
    update = next(name for name in given if "b1_sup_update" in name)
    run.step({**given, update: True})
    for _ in range(gap - 1):
        run.step({**given, update: False, wheel: fast})
    before = run.data["odo_fast"]
    run.step({**given, update: True, wheel: fast})
    return bool(run.data["odo_fast"] != before)


@pytest.mark.parametrize(("limit", "most"), [(None, 4), (4, 5), (5, 6), (7, 8)])
def test_gaps_of_up_to_another_limit_count(limit: int | None, most: int) -> None:
    """100 ms were four steps or more: `<= 4` counted every gap, and 0.9 in place of 1 was told."""
    changed = BOARD2.system if limit is None else slot_of_both().change(Op.LE, limit).make()
    assert [added(changed, gap) for gap in range(1, 10)] == [gap <= most for gap in range(1, 10)]


def test_such_a_limit_is_made_anew_from_a_variant() -> None:
    change = slot_of_both().change(Op.LE, 4)
    made = found_change(BOARD2, BOARD2.system, WrittenChange(*change.key)).make()
    wheel = made.written["coherence_wheel_gap"]
    assert wheel.domain.high > BOARD2.system.written["coherence_wheel_gap"].domain.high
    assert added(made, 5) and not added(made, 6)
