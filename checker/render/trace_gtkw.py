"""A save file for GTKWave, which shows the dump of a trace (``--format vcd``) in groups, marked at its end.

First the property, then the charts, inputs, timers (as ramps) and values that it depends on; the rest is
in closed groups.  The marker stands where the property is broken, marker A where a loop begins.
"""

import math
import re
from io import StringIO

from vcd.gtkw import GTKWColor, GTKWFlag, GTKWSave

from rovercheck.checker.render.trace_vcd import about
from rovercheck.checker.render.waves import Sort, Wave, WaveGroup, outcome, waves
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Trace

FORMAT = Format(
    "gtkw",
    "trace",
    ".gtkw",
    "save file that shows the dump (vcd) in GTKWave, grouped and marked",
    beside="vcd",
)

_WIDTH = 1200
"""Pixels that the whole run shall take at first sight."""
_FORMATS = {Sort.WIRE: "bin", Sort.TEXT: "ascii", Sort.NUMBER: "real"}
_FILTERED = WaveGroup.CHARTS, WaveGroup.INPUTS, WaveGroup.TIMERS, WaveGroup.VALUES


def render(trace: Trace, dump: str = "") -> str:
    """The save file for a dump in the file ``dump``; by default named as the property."""
    out = StringIO()
    save = GTKWSave(out)
    end = trace.ms(len(trace))
    save.dumpfile(dump or f"{_plain(trace.property.id or trace.system.name)}.vcd", abspath=False)
    for told in about(trace):
        save.comment(told)
    save.timestart(0)
    loop = {"a": trace.ms(trace.loop + 1)} if trace.loop is not None else {}
    save.zoom_markers(min(0.0, -math.log2(max(1, end) / _WIDTH)), end, **loop)
    _property(save, trace)
    found = waves(trace)
    for group in _FILTERED:
        _group(save, group.value, [w for w in found if w.group is group and _matters(trace, w)])
    rest = [w for w in found if w.group is WaveGroup.HIDDEN or not _matters(trace, w)]
    _group(save, "not of the property", rest, closed=True)
    return out.getvalue()


def _property(save: GTKWSave, trace: Trace) -> None:
    with save.group(_plain(trace.property.id) or WaveGroup.PROPERTY.value):
        colour = GTKWColor.red if outcome(trace) == "violated" else GTKWColor.green
        save.trace(f"{WaveGroup.PROPERTY}.{outcome(trace)}", color=colour, datafmt="bin")
        if trace.loop is not None:
            save.trace(f"{WaveGroup.PROPERTY}.repeats", color=GTKWColor.orange, datafmt="bin")


def _group(save: GTKWSave, name: str, found: list[Wave], closed: bool = False) -> None:
    if not found:
        return
    with save.group(name, closed=closed):
        for wave in found:
            ramp = wave.sort is Sort.NUMBER and not closed
            flags = GTKWFlag.analog_step if ramp else GTKWFlag.none
            save.trace(wave.full, datafmt=_FORMATS[wave.sort], extraflags=flags)
            if ramp:
                save.blank(analog_extend=True)


def _matters(trace: Trace, wave: Wave) -> bool:
    return not trace.property.relevant or wave.name in trace.property.relevant


def _plain(name: str) -> str:
    """A name that stands in a file name and on a line of its own."""
    return re.sub(r"[^\w.-]+", "_", name)
