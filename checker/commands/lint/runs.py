"""A run that shows something, in a few lines: the inputs of each tick in which one of them changes."""

from collections.abc import Iterator, Mapping, Sequence

from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.expr import Var


def run_of(trace: Trace) -> list[str]:
    """The lines of a run, with what the question depends on."""
    shown = trace.focused()
    return list(input_lines([tick.inputs for tick in shown.ticks], shown.system.variables))


def input_lines(inputs: Sequence[Mapping[str, int]], variables: Mapping[str, Var]) -> Iterator[str]:
    """``tick 3: u = 4, stop = true``; of the last tick, which shows what is asked, all inputs."""
    before: Mapping[str, int] = {}
    for number, now in enumerate(inputs, 1):
        last = number == len(inputs)
        told = {name: raw for name, raw in now.items() if last or before.get(name) != raw}
        if told or last:
            values = ", ".join(f"{name} = {variables[name].domain.show(raw)}" for name, raw in told.items())
            yield f"tick {number}: {values or 'any inputs'}"
        before = now


__all__ = ["input_lines", "run_of"]
