"""A trace as a value change dump, for GTKWave and other wave viewers.

The state before the first tick is at time 0; the inputs and results of tick k are at k ticks.
Enumerations are texts, truth values wires, numbers are in their units.  ``property.violated`` rises where
the property is broken; ``property.repeats`` marks ticks that repeat for ever.
"""

import math
import re
from io import StringIO
from unicodedata import normalize

from vcd import VCDWriter

from rovercheck.checker.render.reasons import determined_by
from rovercheck.checker.render.waves import Sort, Wave, WaveGroup, outcome, waves
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.domain import Num

FORMAT = Format("vcd", "trace", ".vcd", "value change dump for wave viewers, time in ms")

_UNKNOWN: dict[Sort, str | float] = {Sort.WIRE: "x", Sort.TEXT: "?", Sort.NUMBER: math.nan}
"""What stands before the first tick for an input, which has no value yet."""
_SIGNS = str.maketrans({"$": "S", "°": "deg", "≤": "<=", "≥": ">=", "→": "->", "–": "-", "µ": "u", "²": "^2"})


def render(trace: Trace) -> str:
    """The dump as text."""
    out = StringIO()
    end = trace.ms(len(trace))
    with VCDWriter(out, timescale="1 ms", date="", version="rovercheck", comment=_comment(trace)) as writer:
        found = [(w, writer.register_var(w.path[:-1], w.path[-1], w.sort.value, size=_size(w),
                                         init=_first(trace, w))) for w in waves(trace)]  # fmt: skip
        mark = writer.register_var(WaveGroup.PROPERTY.value, outcome(trace), "wire", size=1, init=0)
        again = None
        if trace.loop is not None:
            again = writer.register_var(WaveGroup.PROPERTY.value, "repeats", "wire", size=1, init=0)
        for tick in trace.ticks:
            now = trace.ms(tick.number)
            at = {**tick.inputs, **tick.after}
            for wave, variable in found:
                if wave.name in at:
                    writer.change(variable, now, _value(trace, wave, at[wave.name]))
            if again is not None and tick.number - 1 == trace.loop:
                writer.change(again, now, 1)
        if trace.ticks:
            writer.change(mark, end, 1)
        writer.close(end + trace.system.tick_ms)
    return out.getvalue()


def _comment(trace: Trace) -> str:
    """What the dump shows, why it is so, and the units of its numbers."""
    sorts = {wave.full: trace.system.variables[wave.name].sort for wave in waves(trace)}
    units = [f"{name} in {s.unit}" for name, s in sorts.items() if isinstance(s, Num) and str(s.unit)]
    return "\n".join((*about(trace), *map(_ascii, units)))


def about(trace: Trace) -> list[str]:
    """Lines for a comment: what the run is of, why its property is violated, which inputs determine that."""
    told = [f"rovercheck trace of {trace.system.name}", f"{trace.property.id}: {trace.property.text}"]
    told = told if trace.property.id else told[:1]
    why = [f"Why: {trace.property.because}"] if trace.property.because else []
    cause = [said] if (said := determined_by(trace)) else []
    return [_ascii(line) for line in (*told, *why, *cause)]


def _ascii(text: str) -> str:
    """Text that can stand in a comment: readers take ASCII only, and ``$`` begins a word of the format."""
    plain = normalize("NFKD", text.translate(_SIGNS)).encode("ascii", "replace").decode()
    return re.sub(r"[^ -~]", " ", plain)


def _size(wave: Wave) -> int | None:
    return 1 if wave.sort is Sort.WIRE else None


def _first(trace: Trace, wave: Wave) -> str | float:
    return _value(trace, wave, trace.before[wave.name]) if wave.name in trace.before else _UNKNOWN[wave.sort]


def _value(trace: Trace, wave: Wave, raw: int) -> str | float:
    match trace.system.variables[wave.name].sort:
        case Num(resolution, _):
            return float(raw * resolution)
    if wave.sort is Sort.WIRE:
        return raw
    return re.sub(r"[^!-~]+", "_", trace.show(wave.name, raw)) or "_"
