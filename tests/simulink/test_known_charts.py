"""Charts that papers and manuals on Stateflow made known give what a simulation by hand of each gives."""

from pathlib import Path
from random import Random

import pytest

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from tests.drawn.two_readings import compared
from tests.simulink.known.appliances import APPLIANCES
from tests.simulink.known.events import EVENTS
from tests.simulink.known.machines import MACHINES
from tests.simulink.known.models import Known
from tests.simulink.known.packages import Layout
from tests.simulink.known.semantics import SEMANTICS
from tests.simulink.known.supervisors import SUPERVISORS

CHARTS = (*SEMANTICS, *EVENTS, *MACHINES, *SUPERVISORS, *APPLIANCES)
LAYOUTS: tuple[Layout, ...] = ("R2015a", "R2024a")


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("one", CHARTS, ids=lambda one: one.chart.name)
def test_a_known_chart_gives_what_its_simulation_by_hand_gives(
    tmp_path: Path, one: Known, layout: Layout
) -> None:
    read = one.chart.read(tmp_path, layout)
    random = Random(one.chart.name)
    rows = [{name: random.choice(values) for name, values in one.given.items()} for _ in range(one.rows)]
    runner = ModelRunner(read)
    for number, (row, expected) in enumerate(zip(rows, one.simulate(rows), strict=True)):
        assert tuple(runner.step(row).values()) == expected, f"row {number}: {rows[: number + 1][-4:]}"
    if layout == "R2015a":
        return  # lowering begins with what was read
    found = compared(read, rows, domains=one.domains)
    assert (found.rows, found.refused, found.fault) == (one.rows, "", "")
