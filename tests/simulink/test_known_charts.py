"""Charts that papers and manuals on Stateflow made known give what a simulation by hand of each gives."""

from pathlib import Path
from random import Random

import pytest

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.spec_model.lang.errors import ModelError
from tests.drawn.two_readings import compared
from tests.simulink.known.models import Known
from tests.simulink.known.packages import ChartText, Layout
from tests.simulink.packages import CHARTS

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


def test_a_transition_that_stands_elsewhere_is_held_by_what_is_around_its_ends(tmp_path: Path) -> None:
    """It was an internal error, as its scope was the state that it stands in."""
    lines = "in u int8\nout y int8\n-> P\nstate P: ex: y = y + 10;\n  -> A\n  state A: ex: y = y + 1;\n"
    lines += "{}state B\n{}"
    found = []
    for number, places in enumerate((("  A -> B: [u > 0]\n", ""), ("", "A -> B: [u > 0]\n"))):
        (tmp_path / str(number)).mkdir()
        runner = ModelRunner(ChartText("one", lines.format(*places)).read(tmp_path / str(number)))
        found.append([tuple(runner.step({"u": u}).values()) for u in (0, 0, 1)])
    assert found == [[(0,), (0,), (11,)]] * 2


def test_a_default_transition_that_leads_out_is_refused(tmp_path: Path) -> None:
    text = "in u int8\nout y int8\n-> A\nstate A\n  -> B\nstate B"
    with pytest.raises(ModelError, match="in C/A: it leads out of that, as no default transition does"):
        ModelRunner(ChartText("one", text).read(tmp_path))
