"""Waking up the chart of a block, and what it then gives."""

from collections.abc import Sequence

from rovercheck.checker.drawn.interpret.machine import ChartMachine
from rovercheck.checker.drawn.interpret.values import MatlabValue


def woken(machine: ChartMachine, events: Sequence[str] | None) -> list[MatlabValue]:
    """Wake up a chart by some events, or ``None``: by the step; the answer are its outputs."""
    if machine.chart.drawn.is_function:
        for _ in [""] if events is None else events:
            machine.run_block()
    elif events is None:
        machine.step()
    elif events:
        machine.step(events)
    return outputs_of(machine)


def outputs_of(machine: ChartMachine) -> list[MatlabValue]:
    """The values of a chart's outputs, in the order of their ports; those of events are the last."""
    data = machine.chart.root.data.values()
    found = [machine.memory.values[one.ssid] for one in data if one.scope == "output"]
    return [*found, *machine.output_events.signals()]


__all__ = ["outputs_of", "woken"]
