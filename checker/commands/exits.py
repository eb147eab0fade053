"""Writing a trace in a format: what the format asks for beside the trace, and files that go together."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from checker.commands.output import write
from checker.render import Renderer, renderers
from checker.trace import Trace
from spec_model.lang.system import System


def exit_written(
    renderer: Renderer, trace: Trace, systems: Mapping[str, System], output: Path | None
) -> list[Path]:
    """Write the trace to a file or to standard output; the further files that this made, if any.

    A format with ``CONCRETE`` is given the run as the boards see it, one with ``BESIDE`` writes a file of
    that format under the same name.  Raises ``ModelError`` for a run that the format cannot show.
    """
    if getattr(renderer, "CONCRETE", False):
        from checker.commands.concrete import concrete

        trace = concrete(trace, systems[trace.system])
    other = renderers("trace").get(getattr(renderer, "BESIDE", ""))
    if other is None or output is None:
        write(renderer.render(trace), output)
        return []
    beside = output.with_suffix(other.SUFFIX)
    if beside == output:
        beside = output.with_name(output.name + other.SUFFIX)
    render: Any = renderer.render
    write(other.render(trace), beside)
    write(render(trace, dump=beside.name), output)
    return [beside]
