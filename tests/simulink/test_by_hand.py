"""Models with a simulation by hand give the same as that in both readings, in every layout of a package."""

from pathlib import Path
from random import Random

import pytest

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.simulink.writer.packages import Layout
from tests.drawn.two_readings import Row, compared
from tests.simulink.by_hand.models import ByHand
from tests.simulink.packages import MODELS

LAYOUTS: tuple[Layout, ...] = ("parts", "inline")
ROWS = 200


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("one", MODELS, ids=lambda one: one.name)
def test_a_model_gives_what_its_simulation_by_hand_gives(tmp_path: Path, one: ByHand, layout: Layout) -> None:
    read = one.read(tmp_path, layout)
    given = [one.inputs[0]] * 2 + Random(one.name).choices(one.inputs, k=ROWS - 2)
    runner = ModelRunner(read)
    for number, (u, expected) in enumerate(zip(given, one.simulate(given), strict=True)):
        assert tuple(runner.step({"u": u}).values()) == expected, f"row {number}: {given[: number + 1][-5:]}"
    rows: list[Row] = [{"u": u} for u in given]
    found = compared(read, rows)
    assert (found.rows, found.refused, found.fault) == (ROWS, "", "")
