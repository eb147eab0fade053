"""A trace as a value change dump, for GTKWave and other wave viewers.

The valuation before the first tick is at time 0; the inputs and results of tick k are at k ticks.
Enumerations are strings (GTKWave shows them), booleans wires, numbers integers in raw steps.
"""

import re
from io import StringIO
from typing import Any

from vcd import VCDWriter

from checker.trace import Trace
from spec_model.lang.domain import Bool, Enum, show
from spec_model.lang.expr import Var

NAME = "vcd"
KIND = "trace"
SUFFIX = ".vcd"
SUMMARY = "value change dump for wave viewers, time in ms"


def render(trace: Trace) -> str:
    """The dump as text."""
    out = StringIO()
    comment = "\n".join([f"rovercheck trace of {trace.system}", *_scales(trace)])
    with VCDWriter(out, timescale="1 ms", date="", version="rovercheck", comment=comment) as writer:
        waves = {n: _register(writer, trace, n, v) for n, v in trace.variables.items()}
        for tick in trace.ticks:
            for name, raw in {**tick.inputs, **tick.after}.items():
                if name in waves:
                    writer.change(waves[name], tick.number * trace.tick_ms, _value(trace, name, raw))
        writer.close((len(trace) + 1) * trace.tick_ms)
    return out.getvalue()


def _scales(trace: Trace) -> list[str]:
    """What one raw step of each number that is no whole number means."""
    found = []
    for name, variable in trace.variables.items():
        sort = variable.sort
        if not isinstance(sort, Bool | Enum) and (sort.resolution != 1 or str(sort.unit)):
            found.append(f"{name}: steps of {show(sort.resolution)} {sort.unit}".rstrip())
    return found


def _register(writer: VCDWriter, trace: Trace, name: str, variable: Var) -> Any:
    place, leaf = _place(name)
    place = ".".join(filter(None, ("inputs" if name in trace.inputs else "rover", place)))
    start = _value(trace, name, trace.before[name]) if name in trace.before else None
    match variable.sort:
        case Enum():
            return writer.register_var(place, leaf, "string", init=start if start is not None else "")
        case Bool():
            return writer.register_var(place, leaf, "wire", size=1, init="x" if start is None else start)
        case _:
            return writer.register_var(place, leaf, "integer", size=64, init="x" if start is None else start)


def _place(name: str) -> tuple[str, str]:
    """The scope and the leaf of a name; what is no identifier, such as ``previous(x > 3)``, is one leaf."""
    if re.fullmatch(r"[\w.]+", name):
        scope, _, leaf = name.rpartition(".")
        return scope, leaf
    return "", re.sub(r"\W+", "_", name)


def _value(trace: Trace, name: str, raw: int) -> str | int:
    return trace.show(name, raw) if isinstance(trace.variables[name].sort, Enum) else raw
