"""Models with a simulation by hand give the same as that in both readings, in every layout of a package."""

from pathlib import Path
from random import Random

import pytest

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import Layout
from tests.drawn.two_readings import Row, compared
from tests.simulink.by_hand.calls import CALLS
from tests.simulink.by_hand.machines import MACHINES
from tests.simulink.by_hand.models import ByHand
from tests.simulink.by_hand.numbers import NUMBERS
from tests.simulink.by_hand.resets import RESETS
from tests.simulink.by_hand.states import STATES
from tests.simulink.by_hand.stores import STORES
from tests.simulink.by_hand.times import TIMES

MODELS = (*STATES, *TIMES, *NUMBERS, *CALLS, *STORES, *MACHINES, *RESETS)
LAYOUTS: tuple[Layout, ...] = ("parts", "inline")
ROWS = 200


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("one", MODELS, ids=lambda one: one.name)
def test_a_model_gives_what_its_simulation_by_hand_gives(tmp_path: Path, one: ByHand, layout: Layout) -> None:
    model = one.draw()
    model.layout = layout
    read = read_model(model.save(tmp_path / "one.slx"))
    given = [one.inputs[0]] * 2 + Random(one.name).choices(one.inputs, k=ROWS - 2)
    runner = ModelRunner(read)
    for number, (u, expected) in enumerate(zip(given, one.simulate(given), strict=True)):
        assert tuple(runner.step({"u": u}).values()) == expected, f"row {number}: {given[: number + 1][-5:]}"
    rows: list[Row] = [{"u": u} for u in given]
    found = compared(read, rows)
    assert (found.rows, found.refused, found.fault) == (ROWS, "", "")


def test_each_rule_is_pinned_by_a_model() -> None:
    """The rules by their names, each with the models that rest on it."""
    pinned = {rule for one in MODELS for rule in one.pins}
    assert len({one.name for one in MODELS}) == len(MODELS)
    assert all(one.pins for one in MODELS) and pinned
