"""A run whose steps last unlike times is told with the time as it was."""

import csv
from functools import cache
from io import StringIO

import pytest

from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.commands.trace.board_steps import concrete
from rovercheck.checker.render import trace_csv, trace_json, trace_svg, trace_table, trace_vcd
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.rover import systems


@cache
def run() -> Trace:
    """Four steps, after which the reception of Board 2 is degraded without a loss."""
    (result,) = results([catalogue()["PB2-60m"]], systems())
    assert isinstance(result.verdict, Violated)
    assert isinstance(result.verdict.because, Trace)
    return result.verdict.because


def test_the_times_are_the_sums_of_the_steps() -> None:
    lengths = [tick.inputs["step_ms"] for tick in run().ticks]
    assert list(run().ends) == [sum(lengths[: i + 1]) for i in range(len(lengths))]
    assert any(length != 20 for length in lengths)
    assert [run().ms(tick) for tick in range(5)] == [0, *run().ends]


def test_every_format_tells_them() -> None:
    ends = [str(ms) for ms in run().ends]
    rows = list(csv.DictReader(StringIO(trace_csv.render(run()))))
    assert [row["time_ms"] for row in rows] == ["0", *ends]
    assert [str(s["#meta"]["ms"]) for s in trace_json.document(run())["states"]] == ends
    assert [line[1:] for line in trace_vcd.render(run()).splitlines() if line.startswith("#")][1:5] == ends
    assert f"frames_2_jitter: 4 ticks, {ends[-1]} ms" in trace_table.render(run())
    assert "Ticks of unlike lengths are drawn alike" in trace_svg.render(run())


def test_a_test_of_a_supervisor_has_steps_of_one_length() -> None:
    with pytest.raises(ModelError, match="has steps that last unlike times"):
        concrete(run(), systems()[run().system.name])
